#pragma once

#include <string>
#include <vector>

#include <angles/angles.h>
#include <control_toolbox/pid.h>
#include <gazebo_ros_control/robot_hw_sim.h>
#include <hardware_interface/joint_command_interface.h>
#include <hardware_interface/joint_state_interface.h>
#include <joint_limits_interface/joint_limits.h>
#include <joint_limits_interface/joint_limits_interface.h>
#include <joint_limits_interface/joint_limits_rosparam.h>
#include <joint_limits_interface/joint_limits_urdf.h>
#include <pluginlib/class_list_macros.h>

namespace gazebo_ros_control {

/** Joints of the transmissions, by effort, velocity or position; the last two by gains, if there are any in
    `gazebo_ros_control/pid_gains`. */
class DefaultRobotHWSim : public RobotHWSim {
 public:
  virtual bool initSim(const std::string& robot_namespace, ros::NodeHandle model_nh,
                       gazebo::physics::ModelPtr parent_model, const urdf::Model* const urdf_model,
                       std::vector<transmission_interface::TransmissionInfo> transmissions);
  virtual void readSim(ros::Time time, ros::Duration period);
  virtual void writeSim(ros::Time time, ros::Duration period);
  virtual void eStopActive(const bool active);

 protected:
  enum ControlMethod { EFFORT, POSITION, POSITION_PID, VELOCITY, VELOCITY_PID };

  /** Register a joint's limits, of the URDF and of the parameters, and return them. */
  void registerJointLimits(const std::string& joint_name, const hardware_interface::JointHandle& joint_handle,
                           const ControlMethod ctrl_method, const ros::NodeHandle& joint_limit_nh,
                           const urdf::Model* const urdf_model, int* const joint_type, double* const lower_limit,
                           double* const upper_limit, double* const effort_limit);

  unsigned int n_dof_ = 0;
  hardware_interface::JointStateInterface js_interface_;
  hardware_interface::EffortJointInterface ej_interface_;
  hardware_interface::PositionJointInterface pj_interface_;
  hardware_interface::VelocityJointInterface vj_interface_;
  joint_limits_interface::EffortJointSaturationInterface ej_sat_interface_;
  joint_limits_interface::EffortJointSoftLimitsInterface ej_limits_interface_;
  joint_limits_interface::PositionJointSaturationInterface pj_sat_interface_;
  joint_limits_interface::PositionJointSoftLimitsInterface pj_limits_interface_;
  joint_limits_interface::VelocityJointSaturationInterface vj_sat_interface_;
  joint_limits_interface::VelocityJointSoftLimitsInterface vj_limits_interface_;
  std::vector<std::string> joint_names_;
  std::vector<int> joint_types_;
  std::vector<double> joint_lower_limits_, joint_upper_limits_, joint_effort_limits_;
  std::vector<ControlMethod> joint_control_methods_;
  std::vector<control_toolbox::Pid> pid_controllers_;
  std::vector<double> joint_position_, joint_velocity_, joint_effort_;
  std::vector<double> joint_effort_command_, joint_position_command_, last_joint_position_command_,
      joint_velocity_command_;
  std::vector<gazebo::physics::JointPtr> sim_joints_;
  std::string physics_type_;
  bool e_stop_active_ = false, last_e_stop_active_ = false;
};
typedef boost::shared_ptr<DefaultRobotHWSim> DefaultRobotHWSimPtr;

}  // namespace gazebo_ros_control
