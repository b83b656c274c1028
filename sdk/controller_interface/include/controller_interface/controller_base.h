#pragma once

#include <ros/node_handle.h>

#include <boost/shared_ptr.hpp>
#include <memory>
#include <vector>

#include <hardware_interface/interface_resources.h>
#include <hardware_interface/robot_hw.h>

namespace controller_interface {

/** Controller as its manager sees it: states, and the requests that change them. */
class ControllerBase {
 public:
  enum class ControllerState { CONSTRUCTED, INITIALIZED, RUNNING, STOPPED, WAITING, ABORTED };
  typedef std::vector<hardware_interface::InterfaceResources> ClaimedResources;

  ControllerBase() {}
  virtual ~ControllerBase() {}
  ControllerBase(const ControllerBase&) = delete;
  ControllerBase& operator=(const ControllerBase&) = delete;

  /** In the loop, before the first update. */
  virtual void starting(const ros::Time&) {}
  /** In the loop: read states, and write commands. */
  virtual void update(const ros::Time& time, const ros::Duration& period) = 0;
  /** In the loop, after the last update. */
  virtual void stopping(const ros::Time&) {}
  /** While the hardware is not ready for the start. */
  virtual void waiting(const ros::Time&) {}
  virtual void aborting(const ros::Time&) {}

  bool isInitialized() const { return state_ == ControllerState::INITIALIZED; }
  bool isRunning() const { return state_ == ControllerState::RUNNING; }
  bool isStopped() const { return state_ == ControllerState::STOPPED; }
  bool isWaiting() const { return state_ == ControllerState::WAITING; }
  bool isAborted() const { return state_ == ControllerState::ABORTED; }

  void updateRequest(const ros::Time& time, const ros::Duration& period) {
    if (isRunning()) update(time, period);
    else if (isWaiting()) waiting(time);
  }
  bool startRequest(const ros::Time& time) { return change(ControllerState::RUNNING, &ControllerBase::starting, time); }
  bool stopRequest(const ros::Time& time) {
    return isInitialized() ? false : change(ControllerState::STOPPED, &ControllerBase::stopping, time);
  }
  bool waitRequest(const ros::Time& time) { return change(ControllerState::WAITING, &ControllerBase::waiting, time); }
  bool abortRequest(const ros::Time& time) { return change(ControllerState::ABORTED, &ControllerBase::aborting, time); }

  /** Initialize from a robot; the resources that are used come back. */
  virtual bool initRequest(hardware_interface::RobotHW* robot_hw, ros::NodeHandle& root_nh,
                           ros::NodeHandle& controller_nh, ClaimedResources& claimed_resources) = 0;

  ControllerState state_ = ControllerState::CONSTRUCTED;

 private:
  bool change(ControllerState state, void (ControllerBase::*call)(const ros::Time&), const ros::Time& time) {
    if (state_ == ControllerState::CONSTRUCTED) return false;
    state_ = state;
    (this->*call)(time);
    return true;
  }
};
typedef std::shared_ptr<ControllerBase> ControllerBaseSharedPtr;

}  // namespace controller_interface
