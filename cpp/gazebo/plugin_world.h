// The world as compiled plugins of Gazebo see it: names, states and commands, through the C interface of
// sdk/gazebo/include/gazebo/trundle_host.h.
//
// On the simulation's thread, inside a plugin's call, reads and writes go to MuJoCo's data. Other threads read a copy
// that is made before each step from their first reading on, and their writes wait for the coming step.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <mujoco/mujoco.h>

#include "contact/motor_bank.h"
#include "gazebo/trundle_host.h"

namespace trundle {

// MuJoCo's functions, of the library that Python has loaded.
struct Kinematics {
  decltype(&mj_kinematics) positions = nullptr;
  decltype(&mj_comPos) centers = nullptr;
  decltype(&mj_comVel) velocities = nullptr;
  decltype(&mj_contactForce) contact_force = nullptr;
  decltype(&mj_rnePostConstraint) forces = nullptr;
};

// Axis of a joint: its index in the bank, its addresses, and the sign of both. Motor -1: of a ball joint.
struct BoundAxis {
  int index, qpos, dof;
  double sign;
  bool is_driven;
};

// Joint with its axes. Its link: the one that moves with it in MuJoCo's tree, with its place there [m]; -1: none.
struct BoundJoint {
  std::string name;
  std::vector<BoundAxis> axes;
  int link;
  std::array<double, 3> anchor;
  double sign;  // -1: the link is the joint's parent
};

struct PluginRequest {
  std::vector<std::string> words;
  std::vector<double> numbers;
};

class PluginWorld {
 public:
  explicit PluginWorld(const Kinematics& kinematics) : kinematics_(kinematics) {}

  // Use these arrays from now on. Links and joints keep their numbers by name; those that are not named are gone.
  void bind(mjModel* m, mjData* d, std::shared_ptr<MotorBank> bank,
            const std::vector<std::pair<std::string, int>>& links, const std::vector<BoundJoint>& joints,
            std::vector<std::string> collisions);

  // Begin and end what the plugins do before a step.
  void begin(std::int64_t time_ns, std::int64_t step_ns);
  void end();
  // After the steps of a stride: without physics, what they moved is where it was.
  void restore_rest();
  // Within a plugin's call outside of a step, such as its Load.
  void enter_call();
  void leave_call();
  // Within what a plugin does before a step, but outside of `begin` and `end`.
  void begin_call();
  void end_call();

  int find(int kind, const std::string& name) const;
  int read(int value, int number, int axis, double* out, int capacity);
  bool write(int command, int number, int axis, const double* values, int count);
  int contacts(TrundleGazeboContact* out, int capacity) const;
  void request(PluginRequest request);
  void warn(const std::string& text);

  bool needs_python();
  std::vector<PluginRequest> take_requests();
  std::vector<std::string> take_warnings();
  // Whether positions or velocities were written since the last call, and whether links were moved.
  std::pair<bool, bool> take_changes() {
    return {std::exchange(has_changed_, false), std::exchange(has_moved_, false)};
  }
  // Forget forces and speeds of the last step, after a reset.
  void clear_commands();

  std::int64_t time_ns() const { return time_ns_; }
  std::int64_t step_ns() const { return step_ns_; }

 private:
  using Wrench = std::array<double, 6>;  // force, torque

  struct Link {
    int body = -1;
    Wrench pending{}, base{}, written{};
    bool is_applied = false, collides = true;
  };
  enum class Mode { kNone, kDrive, kSpeed };
  struct Axis {
    BoundAxis bound;
    Mode mode = Mode::kNone;
    std::int64_t stamp = -1;  // act for which its speed was set last
    double effort = 0.0, last_effort = 0.0;
  };
  struct Joint {
    bool exists = false;
    std::vector<Axis> axes;
    int body = -1;
    std::array<double, 3> anchor{};
    double sign = 1.0;
    Wrench wrench{};
  };
  struct Write {
    int command, number, axis;
    std::array<double, 7> values;
    int count;
  };

  // What a step without physics does not change: positions, velocities and the times of these.
  struct Rest {
    std::vector<double> qpos, qvel, times;
    bool has_stepped = false;
  };

  bool is_inside() const;
  int free_joint(int body) const;
  Axis* axis_of(int number, int axis);
  int read_now(int value, int number, int axis, double* out);
  bool write_now(const Write& write);
  bool write_physics(bool is_on);
  void keep_rest();
  bool write_link(Link& link, const Write& write);
  void apply_collides();
  void restore_collides();
  bool write_axis(Axis& axis, const Write& write);
  void synchronize(int dof);
  void moved(int dof);
  void update_poses();
  void update_twists();
  void update_wrenches();
  void apply_wrench(Link& link);
  void apply_efforts(Axis& axis);
  void copy_values();

  Kinematics kinematics_;
  mjModel* m_ = nullptr;
  mjData* d_ = nullptr;
  std::shared_ptr<MotorBank> bank_;
  std::unordered_map<std::string, int> link_numbers_, joint_numbers_;
  std::vector<Link> links_;
  std::vector<Joint> joints_;
  std::vector<std::string> collisions_;           // `model::link::collision` of each geom
  std::vector<int> geom_links_;                   // number of each geom's link, -1: none
  std::unordered_map<int, double> pair_margins_;  // of pairs that do not touch, as they were
  std::vector<int> touched_links_;
  std::vector<std::pair<int, int>> touched_axes_;
  std::vector<double> qvel_;
  std::optional<Rest> rest_;
  bool has_poses_ = false, has_twists_ = false, has_changed_ = false, has_moved_ = false, is_acting_ = false;
  std::int64_t acts_ = 0;
  std::atomic<std::int64_t> time_ns_{0}, step_ns_{1000000};

  mutable std::mutex names_mutex_, queue_mutex_, copies_mutex_;
  std::vector<Write> waiting_;
  std::vector<PluginRequest> requests_;
  std::vector<std::string> warnings_;
  std::atomic<bool> has_queued_{false}, has_waiting_{false}, wants_copies_{false}, wants_wrenches_{false};
  std::vector<std::array<double, 13>> copied_links_;  // pose, twist
  std::vector<std::vector<std::array<double, 3>>> copied_joints_;
  std::vector<Wrench> copied_wrenches_;
  std::array<double, 3> copied_gravity_{};
};

}  // namespace trundle
