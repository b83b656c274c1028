// A transport of images, and a part of a robot, as plugins; CMakeLists.txt does not name control_toolbox, as happens.
#include <control_toolbox/pid.h>
#include <hardware_interface/joint_command_interface.h>
#include <hardware_interface/joint_state_interface.h>
#include <hardware_interface/robot_hw.h>
#include <image_transport/simple_publisher_plugin.h>
#include <image_transport/simple_subscriber_plugin.h>
#include <pluginlib/class_list_macros.h>

namespace cpp_images {

sensor_msgs::Image inverted(sensor_msgs::Image image) {
  for (uint8_t& value : image.data) value = 255 - value;
  return image;
}

class InvertedPublisher : public image_transport::SimplePublisherPlugin<sensor_msgs::Image> {
 public:
  std::string getTransportName() const { return "inverted"; }

 protected:
  void publish(const sensor_msgs::Image& message, const PublishFn& publish_fn) const { publish_fn(inverted(message)); }
};

class InvertedSubscriber : public image_transport::SimpleSubscriberPlugin<sensor_msgs::Image> {
 public:
  std::string getTransportName() const { return "inverted"; }

 protected:
  void internalCallback(const sensor_msgs::ImageConstPtr& message, const Callback& user_cb) {
    user_cb(boost::make_shared<sensor_msgs::Image>(inverted(*message)));
  }
};

/** A joint that goes where it is commanded to be. */
class Part : public hardware_interface::RobotHW {
 public:
  bool init(ros::NodeHandle&, ros::NodeHandle& nh) {
    if (!nh.getParam("joint", name_)) return false;
    hardware_interface::JointStateHandle state(name_, &position_, &velocity_, &effort_);
    states_.registerHandle(state);
    commands_.registerHandle(hardware_interface::JointHandle(state, &command_));
    registerInterface(&states_);
    registerInterface(&commands_);
    return true;
  }
  void read(const ros::Time&, const ros::Duration& period) {
    position_ += pid_.computeCommand(command_ - position_, period);  // a gain of 1 reaches it at once
  }
  bool prepareSwitch(const std::list<hardware_interface::ControllerInfo>& start,
                     const std::list<hardware_interface::ControllerInfo>&) {
    for (const hardware_interface::ControllerInfo& controller : start)
      for (const hardware_interface::InterfaceResources& claimed : controller.claimed_resources)
        if (claimed.resources.size() != 1 || !claimed.resources.count(name_)) return false;
    return true;
  }

 private:
  control_toolbox::Pid pid_{1.0, 0.0, 0.0, 0.0, 0.0};
  std::string name_;
  double position_ = 0, velocity_ = 0, effort_ = 0, command_ = 0;
  hardware_interface::JointStateInterface states_;
  hardware_interface::PositionJointInterface commands_;
};

}  // namespace cpp_images

PLUGINLIB_EXPORT_CLASS(cpp_images::InvertedPublisher, image_transport::PublisherPlugin)
PLUGINLIB_EXPORT_CLASS(cpp_images::InvertedSubscriber, image_transport::SubscriberPlugin)
PLUGINLIB_EXPORT_CLASS(cpp_images::Part, hardware_interface::RobotHW)
