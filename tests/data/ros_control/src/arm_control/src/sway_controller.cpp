// Swings a joint: its speed is A·cos(ω·t), with A from ~command.
#include <cmath>
#include <stdexcept>

#include <controller_interface/controller.h>
#include <hardware_interface/joint_command_interface.h>
#include <pluginlib/class_list_macros.h>
#include <realtime_tools/realtime_buffer.h>
#include <realtime_tools/realtime_publisher.h>
#include <std_msgs/Float64.h>
#include <std_msgs/Float64MultiArray.h>

namespace arm_control {

class SwayController : public controller_interface::Controller<hardware_interface::VelocityJointInterface> {
 public:
  bool init(hardware_interface::VelocityJointInterface* hw, ros::NodeHandle& nh) override {
    std::string joint;
    if (!nh.getParam("joint", joint)) {
      ROS_ERROR("%s/joint is not set", nh.getNamespace().c_str());
      return false;
    }
    nh.param("frequency", frequency_, 1.0);
    joint_ = hw->getHandle(joint);
    amplitude_.initRT(0.0);
    command_ = nh.subscribe<std_msgs::Float64>(
        "command", 1, [this](const std_msgs::Float64ConstPtr& message) { amplitude_.writeFromNonRT(message->data); });
    state_.reset(new realtime_tools::RealtimePublisher<std_msgs::Float64MultiArray>(nh, "state", 4));
    return true;
  }

  void starting(const ros::Time& time) override {
    start_ = time;
    updates_ = 0;
  }

  void update(const ros::Time& time, const ros::Duration& period) override {
    ++updates_;
    const double amplitude = *amplitude_.readFromRT();
    if (amplitude < 0.0) throw std::runtime_error("the amplitude is negative");
    if (amplitude > 1e6) crash();
    joint_.setCommand(amplitude * std::cos(2.0 * M_PI * frequency_ * (time - start_).toSec()));
    if (updates_ % 10 == 0 && state_->trylock()) {
      state_->msg_.data = {static_cast<double>(updates_), (time - start_).toSec(), period.toSec(),
                           joint_.getPosition(),          joint_.getVelocity(),    joint_.getCommand()};
      state_->unlockAndPublish();
    }
  }

  void stopping(const ros::Time&) override { joint_.setCommand(0.0); }

 private:
  void crash() {
    volatile int* nowhere = nullptr;
    *nowhere = 1;
  }

  hardware_interface::JointHandle joint_;
  realtime_tools::RealtimeBuffer<double> amplitude_;
  std::unique_ptr<realtime_tools::RealtimePublisher<std_msgs::Float64MultiArray>> state_;
  ros::Subscriber command_;
  ros::Time start_;
  double frequency_ = 1.0;
  long updates_ = 0;
};

}  // namespace arm_control

PLUGINLIB_EXPORT_CLASS(arm_control::SwayController, controller_interface::ControllerBase)
