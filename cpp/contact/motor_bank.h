// Commands of joint motors: effort, velocity and position within limits, direct ones combined with those of hardware
// interfaces. A motor is a velocity constraint with bounded force; see velocity_motor.h.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "law_tables.h"

namespace trundle {

// Command of one axis.
struct MotorCommand {
  double target;      // [rad/s or m/s]; with a rate [rad or m]
  double max_effort;  // limit of the motor [N·m or N]; 0: the motor is off
  double rate;        // rate of the approach [1/s]; 0: the target is a speed; < 0: kinematic
  double effort;      // constant effort in addition to the motor [N·m or N]

  // True if the motor keeps a speed or position; else the command is an effort.
  bool is_drive() const { return max_effort > 0.0 && effort == 0.0; }

  // Commanded effort, of which a motor may exert half; 0 for a drive.
  double whole_effort() const;
};

struct MotorAxis {
  double dof, actuator;             // actuator -1: none, for a ball joint
  double max_effort, max_velocity;  // [N·m or N], [rad/s or m/s]
};

// Last commands of a motor; rows of an array of physics/step/motors.py.
struct MotorState {
  double is_valid;  // 1: the next three equal the motor's settings
  double target, max_effort, rate;
  double is_shared;                 // 1: a hardware interface has commanded the axis
  MotorCommand direct, interface_;  // commands of a shared axis
};

// Wake the tree of a degree of freedom after a command.
void wake_tree(const mjModel* m, mjData* d, int dof);

class MotorBank {
 public:
  // states: one per actuator; they outlive the bank, as model and data do. Throws std::invalid_argument.
  MotorBank(mjModel* m, mjData* d, std::vector<MotorAxis> axes, std::span<MotorState> states);

  // Apply an effort within the axis' limits, and switch its motor off.
  //
  // As in Gazebo, an axis beyond its velocity limit is not accelerated further: with such a limit the effort comes from
  // a motor with that target speed, which acts in one direction only.
  void command_effort(int axis, double effort, bool hardware);

  // Drive at a speed with limited effort.
  void command_velocity(int axis, double velocity, double max_effort, bool hardware);

  // Drive to a position at a rate of approach [1/s], and hold it.
  void command_position(int axis, double position, double max_effort, double rate);

  // Drive at a speed that the axis reaches at once; only its child links feel a reaction.
  //
  // Its effort limit applies to obstacles, not to its own weight; no limit or zero is unlimited. An axis held back by
  // an obstacle is accelerated by the motor only.
  void drive_kinematically(int axis, double velocity, bool hardware);

  // Set an axis' command to an earlier one.
  void repeat(int axis, const MotorCommand& command) { send(axis, command, false); }

  // Current direct command of an axis.
  MotorCommand command_of(int axis) const;

  // Number of times that a motor was switched on or off.
  std::size_t switches() const { return switches_; }

  const mjModel* model() const { return m_; }
  mjData* data() const { return d_; }
  int axis_count() const { return static_cast<int>(axes_.size()); }

 private:
  const MotorAxis& axis_at(int axis) const { return axes_.at(static_cast<std::size_t>(axis)); }
  double& rate_of(int actuator) const {
    return const_cast<MotorRow&>(motors_[static_cast<std::size_t>(actuator)]).rate;
  }
  MotorCommand effort_command(const MotorAxis& axis, double effort) const;
  void send(int axis, MotorCommand command, bool hardware);
  MotorCommand superpose(int axis, const MotorCommand& command, bool hardware);
  double below_velocity_limit(const MotorAxis& axis, double effort) const;

  mjModel* m_;
  mjData* d_;
  std::span<const MotorRow> motors_;
  std::vector<MotorAxis> axes_;
  std::span<MotorState> states_;
  std::size_t switches_ = 0;
};

}  // namespace trundle
