// Joint behind a hardware interface of ros_control: a state to read, and a command to write.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "contact/motor_bank.h"
#include "toolbox_pid.h"

namespace trundle {

enum class Interface { kEffort = 0, kVelocity = 1, kPosition = 2 };

// Limits and kind of a joint; infinite limits are none.
struct JointTraits {
  double lower, upper;           // [rad or m]
  double max_effort, max_speed;  // [N·m or N], [rad/s or m/s]
  bool is_continuous;            // revolute without limits
  bool is_prismatic;
};

// Axis of an engine, with the addresses of its position and velocity; `sign` is the sign of both.
struct ServoAxis {
  std::shared_ptr<MotorBank> bank;
  int axis, qpos, dof;
  double sign;
};

// Numbers of a joint that are elsewhere, as in the hardware of a compiled library.
struct JointNumbers {
  const double *position = nullptr, *velocity = nullptr, *effort = nullptr;
  double* command = nullptr;
};

class ServoJoint {
 public:
  // pid: efforts from position or velocity errors; null: position or velocity is driven directly.
  // lag_s: time constant of driven positions [s].
  ServoJoint(ServoAxis axis, Interface interface, std::shared_ptr<ToolboxPid> pid, const JointTraits& traits,
             double lag_s);

  // Use another engine's axis. Throws std::invalid_argument if it does not exist.
  void bind(ServoAxis axis);

  // Read the state from these numbers, and write the command there, in place of the engine's; they have to exist as
  // long as the joint, or until they are unset.
  void set_numbers(const JointNumbers& numbers) { numbers_ = numbers; }

  // Take over a command that was written to these numbers.
  void take_command() {
    if (numbers_.command) command = *numbers_.command;
  }

  // Read position, velocity and effort.
  void read();

  // A position minus the joint's; the shorter way round if the joint is continuous.
  double error(double position) const;

  // A position minus the joint's; the shorter way round unless the joint is prismatic, as in
  // joint_trajectory_controller.
  double shortest_error(double position) const;

  // Time for a driven position to settle; gazebo_ros_control sets the position at once.
  std::int64_t settling_ns() const;

  // Command that holds the position read last, or zero effort or velocity.
  double resting_command() const { return interface_ == Interface::kPosition ? position : 0.0; }

  // Command zero effort, zero velocity, or the last position.
  void stop();

  // Command the current position, or zero, until the controller writes.
  void start();

  // Apply the command for a control period [s].
  void write(double dt);

  // Return a function that restores the joint, but not the engine.
  std::function<void()> checkpoint();

  const JointTraits& traits() const { return traits_; }

  double command = 0.0;  // [N·m or N], [rad or m] or [rad/s or m/s], by the interface
  double position = 0.0, velocity = 0.0, effort = 0.0;
  double lag_s;

 private:
  void write_velocity(double dt);
  void write_position(double dt);

  Interface interface_;
  std::shared_ptr<ToolboxPid> pid_;
  JointTraits traits_;
  bool is_at_rest_ = true;
  ServoAxis axis_;
  JointNumbers numbers_;
};

}  // namespace trundle
