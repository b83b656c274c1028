// Base of plugins that publish a camera's pictures and camera_info.
#ifndef GAZEBO_ROS_CAMERA_UTILS_HH
#define GAZEBO_ROS_CAMERA_UTILS_HH

#include <memory>
#include <string>

#include <boost/thread.hpp>
#include <boost/thread/mutex.hpp>

#include <camera_info_manager/camera_info_manager.h>
#include <dynamic_reconfigure/server.h>
#include <image_transport/image_transport.h>
#include <ros/advertise_options.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud.h>
#include <std_msgs/Empty.h>
#include <std_msgs/Float64.h>

#include <gazebo_plugins/GazeboRosCameraConfig.h>
#include <gazebo_plugins/gazebo_ros_utils.h>
#include <gazebo/common/Time.hh>
#include <gazebo/msgs/MessageTypes.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/rendering/Camera.hh>
#include <gazebo/sensors/SensorTypes.hh>
#include <gazebo/transport/TransportTypes.hh>

namespace gazebo {

// A plugin sets parentSensor_, camera_, width_, height_, depth_ and format_, then calls Load, and PutCameraData and
// PublishCameraInfo with each picture. Topics are in the namespace ROBOT/CAMERA, and have their callbacks in a thread.
class GazeboRosCameraUtils {
 public:
  GazeboRosCameraUtils();
  virtual ~GazeboRosCameraUtils();

  // Read <cameraName>, <imageTopicName> and what else gazebo_ros' cameras have; the suffix is appended to the name.
  void Load(sensors::SensorPtr parent, sdf::ElementPtr sdf, const std::string& camera_name_suffix = "");
  void Load(sensors::SensorPtr parent, sdf::ElementPtr sdf, const std::string& camera_name_suffix,
            double hack_baseline);
  // Function that Load calls when there is a node to advertise with.
  event::ConnectionPtr OnLoad(const boost::function<void()>& function);

 protected:
  // Publish a picture of the time sensor_update_time_, or the one given, if there are subscribers.
  void PutCameraData(const unsigned char* image);
  void PutCameraData(const unsigned char* image, common::Time& time);
  // Publish camera_info no more often than <updateRate>.
  void PublishCameraInfo();
  void PublishCameraInfo(common::Time& time);
  void PublishCameraInfo(ros::Publisher publisher);
  // Count a subscriber: with the first one the sensor becomes active.
  void ImageConnect();
  void ImageDisconnect();
  void CameraQueueThread();
  // What a message of <triggerTopicName> does, if it can.
  virtual void TriggerCamera() {}
  virtual bool CanTriggerCamera() { return false; }

  boost::shared_ptr<int> image_connect_count_;
  boost::shared_ptr<boost::mutex> image_connect_count_lock_;
  boost::shared_ptr<bool> was_active_;

  ros::NodeHandle* rosnode_;
  image_transport::Publisher image_pub_;
  sensor_msgs::Image image_msg_;
  std::string image_topic_name_;
  ros::Publisher camera_info_pub_;
  std::string camera_info_topic_name_;
  common::Time last_info_update_time_;

  std::string frame_name_;
  double update_rate_, update_period_;
  common::Time last_update_time_;

  double cx_prime_, cx_, cy_, focal_length_, hack_baseline_;
  double distortion_k1_, distortion_k2_, distortion_k3_, distortion_t1_, distortion_t2_;
  bool auto_distortion_, border_crop_;
  boost::shared_ptr<camera_info_manager::CameraInfoManager> camera_info_manager_;

  boost::mutex lock_;
  // Encoding, and bytes of a pixel.
  std::string type_;
  int skip_;

  ros::CallbackQueue camera_queue_;
  boost::thread callback_queue_thread_;

  unsigned int width_, height_, depth_;
  std::string format_;
  sensors::SensorPtr parentSensor_;
  rendering::CameraPtr camera_;
  physics::WorldPtr world_, world;
  common::Time sensor_update_time_;
  std::string trigger_topic_name_;
  bool initialized_;

 private:
  friend class GazeboRosMultiCamera;
  friend class GazeboRosTriggeredMultiCamera;
  // Read the element; false without ROS.
  bool read(const sensors::SensorPtr& parent, const sdf::ElementPtr& sdf, const std::string& suffix);
  void advertise();
  sensor_msgs::CameraInfo calibration() const;
  void reconfigure(gazebo_plugins::GazeboRosCameraConfig& config, uint32_t level);

  std::string robot_namespace_, camera_name_;
  std::unique_ptr<image_transport::ImageTransport> transport_;
  std::unique_ptr<dynamic_reconfigure::Server<gazebo_plugins::GazeboRosCameraConfig> > options_;
  ros::Subscriber field_of_view_, rate_, trigger_;
  event::EventT<void()> loaded_;
};

}  // namespace gazebo

#endif
