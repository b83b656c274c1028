#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/Joy.h>

#include <atomic>
#include <memory>
#include <string>

namespace rviz_visual_tools {

/**
 * Steps of a program that a person starts: by the topic /rviz_visual_tools_gui (sensor_msgs/Joy, with the buttons 1
 * next, 2 continue, 3 continue through everything, 4 stop), or by Enter where the program has a terminal.
 */
class RemoteControl {
 public:
  explicit RemoteControl(const ros::NodeHandle& node = ros::NodeHandle());

  bool setReadyForNextStep();
  /** Let waitForNextStep return at once, without a button or Enter. */
  void setAutonomous(bool autonomous = true) { is_autonomous_ = autonomous; }
  /** As setAutonomous; waitForNextFullStep returns at once, too. */
  void setFullAutonomous(bool autonomous = true);
  bool getAutonomous() const { return is_autonomous_; }
  bool getFullAutonomous() const { return is_fully_autonomous_; }
  /** Wait at the next step again, whatever was set. */
  void setStop(bool stop = true);
  bool getStop() const { return is_stopped_; }

  /** Wait for a person; false if the node is shut down meanwhile. */
  bool waitForNextStep(const std::string& caption = "go to next step") { return wait(caption, is_autonomous_); }
  bool waitForNextFullStep(const std::string& caption = "go to next full step") {
    return wait(caption, is_fully_autonomous_);
  }
  bool isWaiting() const { return is_waiting_; }

 private:
  void onButtons(const sensor_msgs::JoyConstPtr& joy);
  bool wait(const std::string& caption, const std::atomic<bool>& goes_on);

  ros::NodeHandle node_;
  ros::CallbackQueue queue_;
  ros::Subscriber buttons_;
  std::unique_ptr<ros::AsyncSpinner> spinner_;
  std::atomic<bool> is_ready_{false}, is_autonomous_{false}, is_fully_autonomous_{false}, is_stopped_{false},
      is_waiting_{false};
};

typedef std::shared_ptr<RemoteControl> RemoteControlPtr;
typedef std::shared_ptr<const RemoteControl> RemoteControlConstPtr;

}  // namespace rviz_visual_tools
