#include <gazebo_ros_control/default_robot_hw_sim.h>

#include <limits>

namespace gazebo_ros_control {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// Register a joint's limits with soft ones, if it has any, else without.
template <class Saturation, class Soft, class SaturationInterface, class SoftInterface>
void registerLimits(const hardware_interface::JointHandle& joint, const joint_limits_interface::JointLimits& limits,
                    const joint_limits_interface::SoftJointLimits* soft, SaturationInterface& saturation,
                    SoftInterface& soft_limits) {
  if (soft) soft_limits.registerHandle(Soft(joint, limits, *soft));
  else saturation.registerHandle(Saturation(joint, limits));
}

}  // namespace

bool DefaultRobotHWSim::initSim(const std::string& robot_namespace, ros::NodeHandle model_nh,
                                gazebo::physics::ModelPtr parent_model, const urdf::Model* const urdf_model,
                                std::vector<transmission_interface::TransmissionInfo> transmissions) {
  const ros::NodeHandle joint_limit_nh(model_nh);
  n_dof_ = static_cast<unsigned int>(transmissions.size());
  for (std::vector<double>* const values :
       {&joint_lower_limits_, &joint_upper_limits_, &joint_effort_limits_, &joint_position_, &joint_velocity_,
        &joint_effort_, &joint_effort_command_, &joint_position_command_, &joint_velocity_command_})
    values->assign(n_dof_, 0.0);
  joint_names_.resize(n_dof_);
  joint_types_.resize(n_dof_);
  joint_control_methods_.resize(n_dof_, EFFORT);
  pid_controllers_.resize(n_dof_);
  joint_effort_.assign(n_dof_, 0.0);
  unsigned int count = 0;
  for (const transmission_interface::TransmissionInfo& transmission : transmissions) {
    if (transmission.joints_.size() != 1) {
      ROS_WARN_STREAM_NAMED("default_robot_hw_sim", "Transmission " << transmission.name_ << " has "
                                                                    << transmission.joints_.size()
                                                                    << " joints; one is driven. It is left out.");
      continue;
    }
    const transmission_interface::JointInfo& info = transmission.joints_[0];
    std::vector<std::string> interfaces = info.hardware_interfaces_;
    if (interfaces.empty() && !transmission.actuators_.empty())
      interfaces = transmission.actuators_[0].hardware_interfaces_;
    if (interfaces.empty()) {
      ROS_WARN_STREAM_NAMED("default_robot_hw_sim",
                            "Joint " << info.name_ << " names no hardware interface; it is left out.");
      continue;
    }
    const gazebo::physics::JointPtr joint = parent_model->GetJoint(info.name_);
    if (!joint) {
      ROS_ERROR_STREAM_NAMED("default_robot_hw_sim",
                             "This robot has a joint named \"" << info.name_ << "\" which is not in the gazebo model.");
      return false;
    }
    const unsigned int j = count++;
    std::string kind = interfaces.front();
    if (kind.rfind("hardware_interface/", 0) == 0) kind = kind.substr(kind.find('/') + 1);
    joint_names_[j] = info.name_;
    joint_position_[j] = joint_position_command_[j] = joint->Position(0);
    const hardware_interface::JointStateHandle state(info.name_, &joint_position_[j], &joint_velocity_[j],
                                                     &joint_effort_[j]);
    js_interface_.registerHandle(state);
    hardware_interface::JointHandle handle;
    if (kind == "EffortJointInterface") {
      joint_control_methods_[j] = EFFORT;
      handle = hardware_interface::JointHandle(state, &joint_effort_command_[j]);
      ej_interface_.registerHandle(handle);
    } else if (kind == "PositionJointInterface") {
      joint_control_methods_[j] = POSITION;
      handle = hardware_interface::JointHandle(state, &joint_position_command_[j]);
      pj_interface_.registerHandle(handle);
    } else if (kind == "VelocityJointInterface") {
      joint_control_methods_[j] = VELOCITY;
      handle = hardware_interface::JointHandle(state, &joint_velocity_command_[j]);
      vj_interface_.registerHandle(handle);
    } else {
      ROS_FATAL_STREAM_NAMED("default_robot_hw_sim", "No matching hardware interface found for '"
                                                         << interfaces.front() << "' of joint " << info.name_ << ".");
      return false;
    }
    sim_joints_.push_back(joint);
    registerJointLimits(info.name_, handle, joint_control_methods_[j], joint_limit_nh, urdf_model, &joint_types_[j],
                        &joint_lower_limits_[j], &joint_upper_limits_[j], &joint_effort_limits_[j]);
    if (joint_control_methods_[j] == EFFORT) continue;
    const ros::NodeHandle gains(robot_namespace + "/gazebo_ros_control/pid_gains/" + info.name_);
    if (pid_controllers_[j].init(gains, true))
      joint_control_methods_[j] = joint_control_methods_[j] == POSITION ? POSITION_PID : VELOCITY_PID;
    else if (joint_effort_limits_[j] < kInfinite) joint->SetParam("fmax", 0, joint_effort_limits_[j]);
  }
  n_dof_ = count;
  registerInterface(&js_interface_);
  registerInterface(&ej_interface_);
  registerInterface(&pj_interface_);
  registerInterface(&vj_interface_);
  last_joint_position_command_ = joint_position_command_;
  return true;
}

void DefaultRobotHWSim::readSim(ros::Time, ros::Duration) {
  for (unsigned int j = 0; j < n_dof_; ++j) {
    const double position = sim_joints_[j]->Position(0);
    if (joint_types_[j] == urdf::Joint::PRISMATIC) joint_position_[j] = position;
    else joint_position_[j] += angles::shortest_angular_distance(joint_position_[j], position);
    joint_velocity_[j] = sim_joints_[j]->GetVelocity(0);
    joint_effort_[j] = sim_joints_[j]->GetForce(0);
  }
}

void DefaultRobotHWSim::writeSim(ros::Time, ros::Duration period) {
  if (!e_stop_active_) last_joint_position_command_ = joint_position_;
  else joint_position_command_ = last_joint_position_command_;
  last_e_stop_active_ = e_stop_active_;
  ej_sat_interface_.enforceLimits(period);
  ej_limits_interface_.enforceLimits(period);
  pj_sat_interface_.enforceLimits(period);
  pj_limits_interface_.enforceLimits(period);
  vj_sat_interface_.enforceLimits(period);
  vj_limits_interface_.enforceLimits(period);
  for (unsigned int j = 0; j < n_dof_; ++j) {
    const gazebo::physics::JointPtr& joint = sim_joints_[j];
    const double most = joint_effort_limits_[j];
    switch (joint_control_methods_[j]) {
      case EFFORT: joint->SetForce(0, e_stop_active_ ? 0.0 : joint_effort_command_[j]); break;
      case POSITION: joint->SetPosition(0, joint_position_command_[j], true); break;
      case VELOCITY: joint->SetVelocity(0, e_stop_active_ ? 0.0 : joint_velocity_command_[j]); break;
      case POSITION_PID: {
        const double target = joint_position_command_[j];
        double error = target - joint_position_[j];
        if (joint_types_[j] == urdf::Joint::CONTINUOUS)
          error = angles::shortest_angular_distance(joint_position_[j], target);
        else if (joint_types_[j] == urdf::Joint::REVOLUTE)
          angles::shortest_angular_distance_with_limits(joint_position_[j], target, joint_lower_limits_[j],
                                                        joint_upper_limits_[j], error);
        const double effort = pid_controllers_[j].computeCommand(error, period);
        joint->SetForce(0, joint_limits_interface::internal::saturate(effort, -most, most));
        break;
      }
      case VELOCITY_PID: {
        const double target = e_stop_active_ ? 0.0 : joint_velocity_command_[j];
        const double effort = pid_controllers_[j].computeCommand(target - joint_velocity_[j], period);
        joint->SetForce(0, joint_limits_interface::internal::saturate(effort, -most, most));
        break;
      }
    }
  }
}

void DefaultRobotHWSim::eStopActive(const bool active) { e_stop_active_ = active; }

void DefaultRobotHWSim::registerJointLimits(const std::string& joint_name,
                                            const hardware_interface::JointHandle& joint_handle,
                                            const ControlMethod ctrl_method, const ros::NodeHandle& joint_limit_nh,
                                            const urdf::Model* const urdf_model, int* const joint_type,
                                            double* const lower_limit, double* const upper_limit,
                                            double* const effort_limit) {
  *joint_type = urdf::Joint::UNKNOWN;
  *lower_limit = -kInfinite;
  *upper_limit = *effort_limit = kInfinite;
  joint_limits_interface::JointLimits limits;
  joint_limits_interface::SoftJointLimits soft;
  bool has_limits = false, has_soft_limits = false;
  if (const urdf::JointConstSharedPtr joint = urdf_model ? urdf_model->getJoint(joint_name) : nullptr) {
    *joint_type = joint->type;
    has_limits = joint_limits_interface::getJointLimits(joint, limits);
    has_soft_limits = joint_limits_interface::getSoftJointLimits(joint, soft);
  }
  has_limits = joint_limits_interface::getJointLimits(joint_name, joint_limit_nh, limits) || has_limits;
  if (!has_limits) return;
  if (*joint_type == urdf::Joint::UNKNOWN)
    *joint_type = limits.has_position_limits
                      ? urdf::Joint::REVOLUTE
                      : (limits.angle_wraparound ? urdf::Joint::CONTINUOUS : urdf::Joint::PRISMATIC);
  if (limits.has_position_limits) {
    *lower_limit = limits.min_position;
    *upper_limit = limits.max_position;
  }
  if (limits.has_effort_limits) *effort_limit = limits.max_effort;
  const joint_limits_interface::SoftJointLimits* const used = has_soft_limits ? &soft : nullptr;
  try {
    using namespace joint_limits_interface;
    switch (ctrl_method) {
      case EFFORT:
        registerLimits<EffortJointSaturationHandle, EffortJointSoftLimitsHandle>(
            joint_handle, limits, used, ej_sat_interface_, ej_limits_interface_);
        break;
      case POSITION:
        registerLimits<PositionJointSaturationHandle, PositionJointSoftLimitsHandle>(
            joint_handle, limits, used, pj_sat_interface_, pj_limits_interface_);
        break;
      default:
        registerLimits<VelocityJointSaturationHandle, VelocityJointSoftLimitsHandle>(
            joint_handle, limits, used, vj_sat_interface_, vj_limits_interface_);
    }
  } catch (const joint_limits_interface::JointLimitsInterfaceException& error) {
    ROS_WARN_STREAM_NAMED("default_robot_hw_sim", error.what());
  }
}

}  // namespace gazebo_ros_control

PLUGINLIB_EXPORT_CLASS(gazebo_ros_control::DefaultRobotHWSim, gazebo_ros_control::RobotHWSim)
