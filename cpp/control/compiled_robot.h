// Joints as compiled controllers of ros_control see them: those of the simulator, or of a compiled RobotHWSim.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "controller_interface/trundle_control.h"
#include "servo/servo.h"

namespace trundle {

struct NamedJoint {
  std::string name;
  int interface;
  std::shared_ptr<ServoJoint> joint;
};

class CompiledRobot : public ServoHardware {
 public:
  // Robot of the simulator's joints, which stay where they are.
  CompiledRobot(const TrundleControlKit* kit, std::vector<NamedJoint> joints);
  // Robot of a model's RobotHWSim. Throws std::invalid_argument if none was made.
  CompiledRobot(const TrundleControlKit* kit, const std::string& model);
  ~CompiledRobot() override;

  // Names and interfaces of a RobotHWSim's joints.
  std::vector<std::pair<std::string, int>> names() const;
  // Connect a joint with the RobotHWSim's numbers of this name.
  void connect(const std::string& name, std::shared_ptr<ServoJoint> joint);
  void stop(bool is_active);

  void read(std::int64_t time_ns, std::int64_t period_ns) override;
  void write(std::int64_t time_ns, std::int64_t period_ns) override;
  std::function<void()> checkpoint() override {
    return [this] { is_replay_ = true; };
  }
  // What comes is not a repetition.
  void begin_stride() { is_replay_ = false; }

  const TrundleControlKit* kit() const { return kit_; }
  void* robot() const { return robot_; }
  std::shared_ptr<ServoJoint> joint(const std::string& name) const;

 private:
  const TrundleControlKit* kit_;
  std::vector<NamedJoint> joints_;
  void* robot_;
  bool is_replay_ = false;
};

}  // namespace trundle
