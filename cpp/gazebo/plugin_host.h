// Compiled plugins of Gazebo: their libraries, and what they do before each step.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "contact/step_action.h"
#include "plugin_world.h"

namespace trundle {

class PluginHost : public StepAction {
 public:
  PluginHost(const Kinematics& kinematics, std::string world_name, std::string world_elements);

  PluginWorld& world() { return world_; }

  // Add a model, for the plugins; again under the same name after it was removed.
  void add_model(const std::string& name, const std::string& elements);
  void remove_model(const std::string& name);

  // Open a plugin's library. Throws std::runtime_error with the reason.
  std::uintptr_t open(const std::string& file);
  // Start the nodes of a library that uses roscpp, unless they run. Throws std::runtime_error.
  static void start_ros(std::uintptr_t library, const std::string& master_uri, const std::string& node);
  // Load an opened plugin, and return its number. Throws std::runtime_error with the reason.
  int load(std::uintptr_t library, const std::string& parent, const std::string& name, const std::string& file,
           const std::string& elements);
  // Call a plugin's Reset; 0: forget the last step's commands, before all of them.
  void reset(int plugin);
  // Whether a plugin has connected to its sensor; the next reading of the sensor, between two steps.
  bool wants_reading(int plugin) const;
  void take_reading(int plugin, std::int64_t time_ns, const TrundleGazeboReading& reading);
  void close();

  bool act(std::int64_t time_ns, std::int64_t step_ns) override;
  std::function<void()> checkpoint() override {
    return [this] { is_replay_ = true; };
  }
  // A stride has ended, which may have stepped without physics.
  void finish_stride() { world_.restore_rest(); }
  // A new stride begins: what it steps is not a repetition.
  void begin_stride() { is_replay_ = false; }

 private:
  struct Kit {
    const TrundleGazeboKit* functions;
    void* world;
  };
  Kit& kit_of(void* library);
  std::int64_t real_ns() const;

  PluginWorld world_;
  TrundleGazeboHost host_;
  std::string world_name_, world_elements_;
  std::map<std::string, std::string> models_;
  std::vector<std::string> model_order_;
  std::vector<Kit> kits_;
  std::vector<std::pair<Kit, int>> plugins_;  // each with its number in its kit
  std::chrono::steady_clock::time_point start_;
  bool is_replay_ = false, has_stepped_ = false;
};

}  // namespace trundle
