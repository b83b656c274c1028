// A robot of one joint that follows its velocity command at once, with a controller manager and a loop at 100 Hz.
#include <controller_manager/controller_manager.h>
#include <hardware_interface/joint_command_interface.h>
#include <hardware_interface/joint_state_interface.h>
#include <hardware_interface/robot_hw.h>
#include <ros/ros.h>

class Arm : public hardware_interface::RobotHW {
 public:
  Arm() {
    const hardware_interface::JointStateHandle state("shoulder", &position_, &velocity_, &effort_);
    states_.registerHandle(state);
    registerInterface(&states_);
    velocities_.registerHandle(hardware_interface::JointHandle(state, &command_));
    registerInterface(&velocities_);
  }
  void read(const ros::Time&, const ros::Duration& period) override {
    velocity_ = command_;
    position_ += velocity_ * period.toSec();
  }

 private:
  hardware_interface::JointStateInterface states_;
  hardware_interface::VelocityJointInterface velocities_;
  double position_ = 0.0, velocity_ = 0.0, effort_ = 0.0, command_ = 0.0;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "arm");
  ros::NodeHandle nh;
  Arm arm;
  controller_manager::ControllerManager manager(&arm, nh);
  ros::AsyncSpinner spinner(1);
  spinner.start();
  ros::Time before = ros::Time::now();
  for (ros::Rate rate(100); ros::ok(); rate.sleep()) {
    const ros::Time now = ros::Time::now();
    const ros::Duration period = now - before;
    before = now;
    arm.read(now, period);
    manager.update(now, period);
    arm.write(now, period);
  }
}
