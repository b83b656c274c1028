#include "compiled_robot.h"

#include <stdexcept>

namespace trundle {

CompiledRobot::CompiledRobot(const TrundleControlKit* kit, std::vector<NamedJoint> joints)
    : kit_(kit), joints_(std::move(joints)) {
  std::vector<TrundleControlJoint> shown;
  for (const NamedJoint& named : joints_) {
    ServoJoint& joint = *named.joint;
    shown.push_back(
        {named.name.c_str(), named.interface, &joint.position, &joint.velocity, &joint.effort, &joint.command});
  }
  robot_ = kit_->open_robot(shown.data(), static_cast<int>(shown.size()));
}

CompiledRobot::CompiledRobot(const TrundleControlKit* kit, const std::string& model)
    : kit_(kit), robot_(kit->find_robot(model.c_str())) {
  if (!robot_) throw std::invalid_argument("the model has no hardware");
}

CompiledRobot::~CompiledRobot() {
  for (const NamedJoint& named : joints_) named.joint->set_numbers({});
  kit_->close_robot(robot_);
}

std::vector<std::pair<std::string, int>> CompiledRobot::names() const {
  std::vector<std::pair<std::string, int>> names;
  TrundleControlJoint joint;
  for (int i = 0; kit_->joint(robot_, i, &joint); ++i) names.emplace_back(joint.name, joint.interface);
  return names;
}

void CompiledRobot::connect(const std::string& name, std::shared_ptr<ServoJoint> joint) {
  TrundleControlJoint found;
  for (int i = 0; kit_->joint(robot_, i, &found); ++i) {
    if (found.name != name) continue;
    joint->set_numbers({found.position, found.velocity, found.effort, found.command});
    joints_.push_back({name, found.interface, std::move(joint)});
    return;
  }
  throw std::invalid_argument("no such joint");
}

std::shared_ptr<ServoJoint> CompiledRobot::joint(const std::string& name) const {
  for (const NamedJoint& named : joints_)
    if (named.name == name) return named.joint;
  return nullptr;
}

void CompiledRobot::stop(bool is_active) { kit_->stop_robot(robot_, is_active); }

void CompiledRobot::read(std::int64_t time_ns, std::int64_t period_ns) {
  if (!is_replay_) kit_->read(robot_, time_ns, period_ns);
}
void CompiledRobot::write(std::int64_t time_ns, std::int64_t period_ns) {
  if (!is_replay_) kit_->write(robot_, time_ns, period_ns);
}

}  // namespace trundle
