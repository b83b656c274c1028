// A compiled controller of ros_control as a law of the servo.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "compiled_robot.h"
#include "servo/servo_laws.h"

namespace trundle {

class CompiledLaw : public ServoLaw {
 public:
  // Make and initialize a controller of an opened library's class. Throws std::runtime_error with the reason.
  CompiledLaw(std::shared_ptr<CompiledRobot> robot, const std::string& class_name, const std::string& root,
              const std::string& name);
  ~CompiledLaw() override;
  CompiledLaw(const CompiledLaw&) = delete;
  CompiledLaw& operator=(const CompiledLaw&) = delete;

  // Claimed interfaces and resources.
  const std::vector<std::pair<std::string, std::string>>& claims() const { return claims_; }

  // Both return the reason for a failure, "" if there was none.
  std::string start(std::int64_t time_ns);
  std::string stop(std::int64_t time_ns);

  // After an exception the controller is not called again.
  bool update(std::int64_t time_ns, double dt) override;
  std::function<void()> checkpoint() override;
  // What comes is not a repetition.
  void begin_stride();

  const std::string& failure() const { return failure_; }

 private:
  struct Record {
    std::int64_t time_ns;
    std::vector<double> commands;
  };
  bool replay(std::int64_t time_ns);

  std::shared_ptr<CompiledRobot> robot_;
  std::string name_, failure_;
  void* controller_ = nullptr;
  std::vector<std::pair<std::string, std::string>> claims_;
  std::vector<std::shared_ptr<ServoJoint>> joints_;
  std::vector<Record> records_;  // commands since the last checkpoint: a controller's own state cannot be restored
  bool is_replay_ = false;
};

}  // namespace trundle
