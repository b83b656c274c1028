// Steps many states of one world in threads, each with its own model and data.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include <mujoco/mujoco.h>

namespace trundle {

// Arrays of `count` rows, row by row without gaps.
struct WorldRows {
  std::size_t count;
  const bool* chosen;         // rows to step; the others stay
  double* states;             // mjSTATE_INTEGRATION
  const double* max_efforts;  // effort limit of each motor, as tendon_frictionloss
  const double* rates;        // rate of each motor; see MotorRow
  bool* unstable;             // set to 1 for a row that diverged and kept its state
  double* poses;              // pose of each link: x y z qw qx qy qz in the world
  double* twists;             // twist of each link: velocity of its origin, angular velocity; world axes
};

class RowStepper {
 public:
  // Args:
  //   workers: model and data of each thread.
  //   links: body of each link.
  //   max_speed: speed from which on a state is unstable [m/s or rad/s].
  //   always_actuated: actuation stays on without a motor.
  RowStepper(std::vector<std::pair<mjModel*, mjData*>> workers, std::vector<int> links, double max_speed,
             bool always_actuated)
      : workers_(std::move(workers)), links_(std::move(links)), max_speed_(max_speed), always_(always_actuated) {}

  // Step each chosen row `steps` times, and write its poses and twists.
  void step(const WorldRows& rows, int steps) const;

 private:
  void step_row(const mjModel* m, mjData* d, const WorldRows& rows, std::size_t row, int steps) const;
  bool is_stable(const mjModel* m, const mjData* d) const;
  void write_links(const mjModel* m, mjData* d, const WorldRows& rows, std::size_t row) const;

  std::vector<std::pair<mjModel*, mjData*>> workers_;
  std::vector<int> links_;
  double max_speed_;
  bool always_;
};

}  // namespace trundle
