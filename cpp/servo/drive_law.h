// Law of diff_drive_controller: wheel speeds from a body twist, and odometry from wheel positions.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "servo_laws.h"

namespace trundle {

// Limits of one direction of motion; infinite ones are none.
struct SpeedLimit {
  double min_velocity, max_velocity;          // [m/s or rad/s]
  double min_acceleration, max_acceleration;  // [m/s² or rad/s²]
  double min_jerk, max_jerk;                  // [m/s³ or rad/s³]

  // Allowed velocity nearest to a target, from the last two, each dt [s] apart.
  double limit(double target, double last, double before_last, double dt) const;
};

struct DriveGeometry {
  double wheel_radius, separation;   // [m]
  double left_radius, right_radius;  // effective radii [m]
};

class DiffDriveLaw : public ServoLaw {
 public:
  using Joints = std::vector<std::shared_ptr<ServoJoint>>;

  struct Twist {
    double linear, angular;  // [m/s], [rad/s]
  };

  struct Pose {
    double x, y, yaw;  // [m], [rad]
  };

  // window: number of speeds kept. open_loop: odometry is from the commands.
  DiffDriveLaw(Joints left, Joints right, const DriveGeometry& geometry, const std::array<SpeedLimit, 2>& limits,
               std::int64_t timeout_ns, bool open_loop, std::size_t window);

  // Stop, and integrate odometry from the current wheel positions.
  void start();

  // Drive until the command is older than the timeout.
  void set_command(std::int64_t stamp_ns, const Twist& twist) { command_ = {stamp_ns, twist}; }

  const Pose& pose() const { return pose_; }
  const std::deque<Twist>& speeds() const { return speeds_; }
  Twist limited() const { return {history_[0].last, history_[1].last}; }

  bool update(std::int64_t time_ns, double dt) override;
  std::function<void()> checkpoint() override {
    return [this, saved = *this] { *this = saved; };
  }

 private:
  struct History {
    double last = 0.0, before = 0.0;
  };

  std::pair<double, double> turns() const;
  void count(double dt);
  Twist current_command() const;

  Joints left_, right_;
  DriveGeometry geometry_;
  std::array<SpeedLimit, 2> limits_;
  std::int64_t timeout_ns_;
  bool open_loop_;
  std::size_t window_;
  std::optional<std::pair<std::int64_t, Twist>> command_;
  std::array<History, 2> history_;
  Pose pose_{};
  std::pair<double, double> wheel_angles_;
  std::deque<Twist> speeds_;
};

}  // namespace trundle
