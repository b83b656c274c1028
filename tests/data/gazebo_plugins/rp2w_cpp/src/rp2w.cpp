// A model plugin with a node and a queue of its own, as gazebo_ros' are.
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <ros/subscribe_options.h>
#include <geometry_msgs/Twist.h>
#include <nav_msgs/Odometry.h>
#include <boost/thread.hpp>
#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>

namespace gazebo
{
class Rp2wRos : public ModelPlugin
{
public:
  ~Rp2wRos()
  {
    this->update.reset();
    this->queue.clear();
    this->queue.disable();
    if (this->node)
      this->node->shutdown();
    this->node.reset();  // before its thread has ended, as in many plugins
    this->thread.join();
  }

  void Load(physics::ModelPtr _model, sdf::ElementPtr _sdf)
  {
    this->model = _model;
    if (!ros::isInitialized())
    {
      ROS_FATAL_STREAM("A ROS node for Gazebo has not been initialized, unable to load plugin.");
      return;
    }
    this->node.reset(new ros::NodeHandle(_sdf->Get<std::string>("robotNamespace")));
    ros::SubscribeOptions options = ros::SubscribeOptions::create<geometry_msgs::Twist>(
        "cmd_vel", 1, boost::bind(&Rp2wRos::OnCommand, this, _1), ros::VoidPtr(), &this->queue);
    this->subscriber = this->node->subscribe(options);
    this->odometry = this->node->advertise<nav_msgs::Odometry>("odom_cpp", 1);
    this->thread = boost::thread(boost::bind(&Rp2wRos::QueueThread, this));
    this->joints[0] = _model->GetJoint("chassis_left_wheel");
    this->joints[1] = _model->GetJoint("chassis_right_wheel");
    for (const physics::JointPtr& joint : this->joints)
      joint->SetParam("fmax", 0, 2.0);
    this->update = event::Events::ConnectWorldUpdateBegin(boost::bind(&Rp2wRos::OnUpdate, this));
  }

private:
  void OnCommand(const geometry_msgs::Twist::ConstPtr& _command)
  {
    boost::mutex::scoped_lock lock(this->mutex);
    this->forward = _command->linear.x;
  }

  void QueueThread()
  {
    while (this->node->ok())
      this->queue.callAvailable(ros::WallDuration(0.01));
  }

  void OnUpdate()
  {
    boost::mutex::scoped_lock lock(this->mutex);
    for (const physics::JointPtr& joint : this->joints)
      joint->SetParam("vel", 0, this->forward / 0.0635);
    common::Time now = this->model->GetWorld()->SimTime();
    if ((now - this->last).Double() < 0.05)
      return;
    this->last = now;
    nav_msgs::Odometry message;
    message.header.stamp = ros::Time(now.sec, now.nsec);
    message.header.frame_id = "odom";
    ignition::math::Pose3d pose = this->model->WorldPose();
    message.pose.pose.position.x = pose.Pos().X();
    message.pose.pose.position.y = pose.Pos().Y();
    message.pose.pose.orientation.w = pose.Rot().W();
    message.pose.pose.orientation.z = pose.Rot().Z();
    message.twist.twist.linear.x = this->model->RelativeLinearVel().Y();
    this->odometry.publish(message);
  }

  physics::ModelPtr model;
  physics::JointPtr joints[2];
  event::ConnectionPtr update;
  boost::shared_ptr<ros::NodeHandle> node;
  ros::Subscriber subscriber;
  ros::Publisher odometry;
  ros::CallbackQueue queue;
  boost::thread thread;
  boost::mutex mutex;
  double forward = 0.0;
  common::Time last;
};

GZ_REGISTER_MODEL_PLUGIN(Rp2wRos)
}
