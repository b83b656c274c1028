#pragma once

#include <ros/console.h>

#include <string>

#include <controller_interface/controller_base.h>
#include <hardware_interface/internal/demangle_symbol.h>
#include <hardware_interface/internal/interface_manager.h>

namespace controller_interface {

namespace internal {

/** What is done for each interface of a list. */
template <class... Interfaces>
struct ForEach {
  static bool has(hardware_interface::RobotHW*) { return true; }
  static void copy(hardware_interface::RobotHW*, hardware_interface::RobotHW*) {}
  static void clear(hardware_interface::RobotHW*) {}
  static void claims(hardware_interface::RobotHW*, ControllerBase::ClaimedResources&) {}
};
template <class First, class... Rest>
struct ForEach<First, Rest...> {
  typedef ForEach<Rest...> Others;

  static std::string name() { return hardware_interface::internal::demangledTypeName<First>(); }
  static bool has(hardware_interface::RobotHW* robot_hw) {
    if (robot_hw->get<First>()) return Others::has(robot_hw);
    ROS_ERROR_STREAM("This controller requires a hardware interface of type '"
                     << name() << "'. Make sure this is registered in the hardware_interface::RobotHW class.");
    return false;
  }
  static void copy(hardware_interface::RobotHW* from, hardware_interface::RobotHW* to) {
    if (First* const interface = from->get<First>()) to->registerInterface(interface);
    Others::copy(from, to);
  }
  static void clear(hardware_interface::RobotHW* robot_hw) {
    if (First* const interface = robot_hw->get<First>()) interface->clearClaims();
    Others::clear(robot_hw);
  }
  static void claims(hardware_interface::RobotHW* robot_hw, ControllerBase::ClaimedResources& claimed) {
    if (First* const interface = robot_hw->get<First>())
      claimed.push_back(hardware_interface::InterfaceResources(name(), interface->getClaims()));
    Others::claims(robot_hw, claimed);
  }
};

}  // namespace internal

/** Controller of several interfaces of a robot; it sees these alone. */
template <class... Interfaces>
class MultiInterfaceController : public ControllerBase {
 public:
  /** `allow_optional_interfaces`: a robot without some of the interfaces will do. */
  explicit MultiInterfaceController(bool allow_optional_interfaces = false)
      : allow_optional_interfaces_(allow_optional_interfaces) {}
  virtual ~MultiInterfaceController() {}

  /** One of both is overridden: get handles, and read parameters; false if the controller cannot be used. */
  virtual bool init(hardware_interface::RobotHW*, ros::NodeHandle&) { return true; }
  virtual bool init(hardware_interface::RobotHW*, ros::NodeHandle&, ros::NodeHandle&) { return true; }

 protected:
  virtual bool initRequest(hardware_interface::RobotHW* robot_hw, ros::NodeHandle& root_nh,
                           ros::NodeHandle& controller_nh, ClaimedResources& claimed_resources) {
    if (state_ != ControllerState::CONSTRUCTED) {
      ROS_ERROR("Cannot initialize this controller because it failed to be constructed");
      return false;
    }
    if (!allow_optional_interfaces_ && !hasRequiredInterfaces(robot_hw)) return false;
    hardware_interface::RobotHW* const own = &robot_hw_ctrl_;
    extractInterfaceResources(robot_hw, own);
    clearClaims(own);
    if (!init(own, controller_nh) || !init(own, root_nh, controller_nh)) {
      ROS_ERROR("Failed to initialize the controller");
      return false;
    }
    claimed_resources.clear();
    populateClaimedResources(own, claimed_resources);
    clearClaims(own);
    state_ = ControllerState::INITIALIZED;
    return true;
  }

  static bool hasRequiredInterfaces(hardware_interface::RobotHW* robot_hw) {
    return internal::ForEach<Interfaces...>::has(robot_hw);
  }
  static void extractInterfaceResources(hardware_interface::RobotHW* robot_hw_in,
                                        hardware_interface::RobotHW* robot_hw_out) {
    internal::ForEach<Interfaces...>::copy(robot_hw_in, robot_hw_out);
  }
  static void clearClaims(hardware_interface::RobotHW* robot_hw) { internal::ForEach<Interfaces...>::clear(robot_hw); }
  static void populateClaimedResources(hardware_interface::RobotHW* robot_hw, ClaimedResources& claimed_resources) {
    internal::ForEach<Interfaces...>::claims(robot_hw, claimed_resources);
  }

  hardware_interface::RobotHW robot_hw_ctrl_;
  bool allow_optional_interfaces_;
};

}  // namespace controller_interface
