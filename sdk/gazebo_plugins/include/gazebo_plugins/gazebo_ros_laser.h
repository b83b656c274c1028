// Plugin of a laser scanner that publishes sensor_msgs/LaserScan, to be derived from.
#ifndef GAZEBO_ROS_LASER_HH
#define GAZEBO_ROS_LASER_HH

#include <gazebo_plugins/PubQueue.h>
#include <gazebo_plugins/gazebo_ros_utils.h>
#include <sensor_msgs/LaserScan.h>

#include <string>

#include <gazebo/plugins/RayPlugin.hh>
#include <gazebo/sensors/SensorTypes.hh>
#include <gazebo/transport/transport.hh>
#include <sdf/sdf.hh>

namespace gazebo {

// Parameters: <robotNamespace>, <frameName> (/world), <topicName> (/world).
class GazeboRosLaser : public RayPlugin {
 public:
  void Load(sensors::SensorPtr parent, sdf::ElementPtr sdf) override {
    RayPlugin::Load(parent, sdf);
    node_.reset(new ros::NodeHandle(GetRobotNamespace(parent, sdf, "Laser")));
    if (sdf->HasElement("frameName")) frame_name_ = sdf->Get<std::string>("frameName");
    if (sdf->HasElement("topicName")) topic_name_ = sdf->Get<std::string>("topicName");
    if (!ros::isInitialized()) {
      ROS_FATAL_STREAM_NAMED("laser", "the laser's plugin needs a node of ROS; run without --no-ros");
      return;
    }
    publisher_ = node_->advertise<sensor_msgs::LaserScan>(topic_name_, 1);
    parentSensor->SetActive(true);
  }
  void OnNewLaserScans() override {
    if (!publisher_ || publisher_.getNumSubscribers() == 0) return;
    sensor_msgs::LaserScan scan;
    const common::Time time = parentSensor->LastMeasurementTime();
    scan.header.stamp = ros::Time(time.sec, time.nsec);
    scan.header.frame_id = frame_name_;
    scan.angle_min = parentSensor->AngleMin().Radian();
    scan.angle_max = parentSensor->AngleMax().Radian();
    scan.angle_increment = parentSensor->AngleResolution();
    scan.range_min = parentSensor->RangeMin();
    scan.range_max = parentSensor->RangeMax();
    std::vector<double> ranges;
    parentSensor->Ranges(ranges);
    scan.ranges.assign(ranges.begin(), ranges.end());
    for (unsigned int ray = 0; ray < ranges.size(); ++ray) scan.intensities.push_back(parentSensor->Retro(ray));
    publisher_.publish(scan);
  }

 private:
  std::string frame_name_ = "/world", topic_name_ = "/world";
  boost::shared_ptr<ros::NodeHandle> node_;
  ros::Publisher publisher_;
};

}  // namespace gazebo

#endif
