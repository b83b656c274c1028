#pragma once

#include <ros/console.h>
#include <ros/duration.h>
#include <ros/node_handle.h>
#include <ros/time.h>

#include <list>
#include <map>
#include <string>

#include <hardware_interface/controller_info.h>
#include <hardware_interface/hardware_interface.h>
#include <hardware_interface/internal/interface_manager.h>

namespace hardware_interface {

/** Robot: its interfaces, and the reading and writing behind them. */
class RobotHW : public InterfaceManager {
 public:
  enum class SwitchState { DONE, ONGOING, ERROR };

  RobotHW() {}
  virtual ~RobotHW() {}

  /** Prepare the robot; false if it cannot be used. */
  virtual bool init(ros::NodeHandle&, ros::NodeHandle&) { return true; }

  /** True if two controllers would use a resource that is claimed for one alone; a line of the log names it. */
  virtual bool checkForConflict(const std::list<ControllerInfo>& info) const {
    std::map<std::string, std::list<ControllerInfo> > users;
    for (const ControllerInfo& controller : info)
      for (const InterfaceResources& claimed : controller.claimed_resources)
        for (const std::string& resource : claimed.resources) users[resource].push_back(controller);
    bool in_conflict = false;
    for (const auto& entry : users) {
      if (entry.second.size() < 2) continue;
      std::string names;
      for (const ControllerInfo& controller : entry.second) names += (names.empty() ? "" : ", ") + controller.name;
      ROS_WARN_STREAM("Resource conflict on [" << entry.first << "]. Controllers = [" << names << "]");
      in_conflict = true;
    }
    return in_conflict;
  }

  /** Prepare a change of controllers, outside of the loop; false forbids it. */
  virtual bool prepareSwitch(const std::list<ControllerInfo>&, const std::list<ControllerInfo>&) { return true; }
  /** Change controllers, in the loop. */
  virtual void doSwitch(const std::list<ControllerInfo>&, const std::list<ControllerInfo>&) {}
  virtual SwitchState switchResult() const { return SwitchState::DONE; }
  virtual SwitchState switchResult(const ControllerInfo&) const { return SwitchState::DONE; }

  virtual void read(const ros::Time&, const ros::Duration&) {}
  virtual void write(const ros::Time&, const ros::Duration&) {}
};
typedef std::shared_ptr<RobotHW> RobotHWSharedPtr;

}  // namespace hardware_interface
