// Hardware of a simulated arm: its one joint gets the speed that is commanded, times `gear`.
#include <gazebo_ros_control/robot_hw_sim.h>
#include <hardware_interface/joint_command_interface.h>
#include <hardware_interface/joint_state_interface.h>
#include <pluginlib/class_list_macros.h>

namespace arm_control {

class ArmHardwareSim : public gazebo_ros_control::RobotHWSim {
 public:
  bool initSim(const std::string& robot_namespace, ros::NodeHandle model_nh, gazebo::physics::ModelPtr parent_model,
               const urdf::Model* const urdf_model,
               std::vector<transmission_interface::TransmissionInfo> transmissions) override {
    model_nh.param("gear", gear_, 1.0);
    if (transmissions.size() != 1 || !urdf_model) return false;
    const std::string name = transmissions[0].joints_[0].name_;
    joint_ = parent_model->GetJoint(name);
    if (!joint_) return false;
    const hardware_interface::JointStateHandle state(name, &position_, &velocity_, &effort_);
    states_.registerHandle(state);
    velocities_.registerHandle(hardware_interface::JointHandle(state, &command_));
    registerInterface(&states_);
    registerInterface(&velocities_);
    ROS_INFO("the arm's hardware: %s in %s, gear %g", name.c_str(), robot_namespace.c_str(), gear_);
    return true;
  }
  void readSim(ros::Time, ros::Duration) override {
    position_ = joint_->Position(0);
    velocity_ = joint_->GetVelocity(0);
    effort_ = joint_->GetForce(0);
  }
  void writeSim(ros::Time, ros::Duration) override { joint_->SetVelocity(0, is_stopped_ ? 0.0 : gear_ * command_); }
  void eStopActive(const bool active) override { is_stopped_ = active; }

 private:
  gazebo::physics::JointPtr joint_;
  hardware_interface::JointStateInterface states_;
  hardware_interface::VelocityJointInterface velocities_;
  double position_ = 0.0, velocity_ = 0.0, effort_ = 0.0, command_ = 0.0, gear_ = 1.0;
  bool is_stopped_ = false;
};

}  // namespace arm_control

PLUGINLIB_EXPORT_CLASS(arm_control::ArmHardwareSim, gazebo_ros_control::RobotHWSim)
