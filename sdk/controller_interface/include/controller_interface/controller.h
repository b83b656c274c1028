#pragma once

#include <ros/console.h>

#include <string>

#include <controller_interface/controller_base.h>
#include <hardware_interface/internal/demangle_symbol.h>

namespace controller_interface {

/** Controller of one interface of a robot. */
template <class T>
class Controller : public ControllerBase {
 public:
  /** One of both is overridden: get handles, and read parameters; false if the controller cannot be used. */
  virtual bool init(T*, ros::NodeHandle&) { return true; }
  virtual bool init(T*, ros::NodeHandle&, ros::NodeHandle&) { return true; }

 protected:
  virtual bool initRequest(hardware_interface::RobotHW* robot_hw, ros::NodeHandle& root_nh,
                           ros::NodeHandle& controller_nh, ClaimedResources& claimed_resources) {
    if (state_ != ControllerState::CONSTRUCTED) {
      ROS_ERROR("Cannot initialize this controller because it failed to be constructed");
      return false;
    }
    T* const hw = robot_hw->get<T>();
    if (!hw) {
      ROS_ERROR(
          "This controller requires a hardware interface of type '%s'. Make sure this is registered in the "
          "hardware_interface::RobotHW class.",
          getHardwareInterfaceType().c_str());
      return false;
    }
    hw->clearClaims();
    if (!init(hw, controller_nh) || !init(hw, root_nh, controller_nh)) {
      ROS_ERROR("Failed to initialize the controller");
      return false;
    }
    claimed_resources.assign(1, hardware_interface::InterfaceResources(getHardwareInterfaceType(), hw->getClaims()));
    hw->clearClaims();
    state_ = ControllerState::INITIALIZED;
    return true;
  }

  std::string getHardwareInterfaceType() const { return hardware_interface::internal::demangledTypeName<T>(); }
};

}  // namespace controller_interface
