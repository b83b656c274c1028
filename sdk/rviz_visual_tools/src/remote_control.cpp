#include "rviz_visual_tools/remote_control.h"

#include <poll.h>
#include <unistd.h>

#include <iostream>

namespace rviz_visual_tools {
namespace {

constexpr int kLook = 50;  // [ms] between two looks at the terminal and the buttons

/** True if a line was entered in the program's terminal within a time [ms]. */
bool isLineEntered(int wait) {
  pollfd input = {STDIN_FILENO, POLLIN, 0};
  if (!isatty(STDIN_FILENO) || tcgetpgrp(STDIN_FILENO) != getpgrp()) {
    poll(nullptr, 0, wait);
    return false;
  }
  if (poll(&input, 1, wait) <= 0 || !(input.revents & POLLIN)) return false;
  std::string line;
  return static_cast<bool>(std::getline(std::cin, line));
}

}  // namespace

RemoteControl::RemoteControl(const ros::NodeHandle& node) : node_(node) {
  node_.setCallbackQueue(&queue_);
  buttons_ = node_.subscribe("/rviz_visual_tools_gui", 10, &RemoteControl::onButtons, this);
  spinner_.reset(new ros::AsyncSpinner(1, &queue_));
  spinner_->start();
}

void RemoteControl::onButtons(const sensor_msgs::JoyConstPtr& joy) {
  const auto isPressed = [&joy](std::size_t button) {
    return button < joy->buttons.size() && joy->buttons[button] != 0;
  };
  if (isPressed(1)) setReadyForNextStep();
  if (isPressed(2)) setAutonomous();
  if (isPressed(3)) setFullAutonomous();
  if (isPressed(4)) setStop();
}

bool RemoteControl::setReadyForNextStep() {
  is_stopped_ = false;
  if (is_waiting_) is_ready_ = true;
  return true;
}

void RemoteControl::setFullAutonomous(bool autonomous) {
  is_fully_autonomous_ = autonomous;
  is_autonomous_ = autonomous;
}

void RemoteControl::setStop(bool stop) {
  is_stopped_ = stop;
  if (stop) setFullAutonomous(false);
}

bool RemoteControl::wait(const std::string& caption, const std::atomic<bool>& goes_on) {
  if (goes_on) return true;
  is_ready_ = false;
  is_waiting_ = true;
  std::cout << "\nWaiting to continue: " << caption << std::flush;
  while (!is_ready_ && !goes_on && ros::ok())
    if (isLineEntered(kLook)) is_ready_ = true;
  std::cout << "... continuing" << std::endl;
  is_waiting_ = false;
  return ros::ok();
}

}  // namespace rviz_visual_tools
