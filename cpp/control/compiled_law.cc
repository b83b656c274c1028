#include "compiled_law.h"

#include <cmath>
#include <stdexcept>

#include "gazebo/crash_report.h"

namespace trundle {

namespace {

constexpr int kReason = 1024, kClaims = 1 << 16;

// The name of the controller whose code runs, for messages after a crash.
struct Running {
  explicit Running(const std::string& name) { set_running_plugin(name.c_str()); }
  ~Running() { set_running_plugin(nullptr); }
};

}  // namespace

CompiledLaw::CompiledLaw(std::shared_ptr<CompiledRobot> robot, const std::string& class_name, const std::string& root,
                         const std::string& name)
    : robot_(std::move(robot)), name_(name) {
  install_crash_report();
  const TrundleControlKit* kit = robot_->kit();
  {
    const Running running(name_);
    char reason[kReason] = "";
    controller_ = kit->load(robot_->robot(), class_name.c_str(), root.c_str(), name.c_str(), reason, sizeof(reason));
    if (!controller_) throw std::runtime_error(reason);
  }
  std::vector<char> words(kClaims);
  const int size = kit->claims(controller_, words.data(), kClaims);
  for (const char *next = words.data(), *end = next + size; next < end;) {
    const std::string interface = next;
    next += interface.size() + 1;
    const std::string resource = next;
    next += resource.size() + 1;
    claims_.emplace_back(interface, resource);
    if (auto joint = robot_->joint(resource)) joints_.push_back(std::move(joint));
  }
}

CompiledLaw::~CompiledLaw() {
  const Running running(name_);
  robot_->kit()->close(controller_);
}

std::string CompiledLaw::start(std::int64_t time) {
  const Running running(name_);
  char reason[kReason] = "";
  failure_.clear();
  begin_stride();
  robot_->kit()->start(controller_, time, reason, sizeof(reason));
  for (const auto& joint : joints_) joint->take_command();
  return reason;
}

std::string CompiledLaw::stop(std::int64_t time) {
  const Running running(name_);
  char reason[kReason] = "";
  robot_->kit()->stop(controller_, time, reason, sizeof(reason));
  return reason;
}

void CompiledLaw::begin_stride() {
  is_replay_ = false;
  records_.clear();
}

bool CompiledLaw::replay(std::int64_t time) {
  for (const Record& record : records_) {
    if (record.time_ns != time) continue;
    for (std::size_t i = 0; i < joints_.size(); ++i) joints_[i]->command = record.commands[i];
    return true;
  }
  return false;
}

bool CompiledLaw::update(std::int64_t time, double dt) {
  mark_update(time, dt);
  if (!failure_.empty()) return true;
  if (is_replay_ && replay(time)) return true;
  const Running running(name_);
  char reason[kReason] = "";
  if (!robot_->kit()->update(controller_, time, std::llround(dt * 1e9), reason, sizeof(reason))) failure_ = reason;
  Record record{time, {}};
  for (const auto& joint : joints_) {
    joint->take_command();
    if (!std::isfinite(joint->command)) joint->command = joint->resting_command();
    record.commands.push_back(joint->command);
  }
  records_.push_back(std::move(record));
  return failure_.empty();
}

std::function<void()> CompiledLaw::checkpoint() {
  records_.clear();
  return [this] { is_replay_ = true; };
}

}  // namespace trundle
