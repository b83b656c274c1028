#include "control_kit.h"

#include <cstdio>
#include <cstring>
#include <map>
#include <mutex>
#include <vector>

#include <controller_interface/controller_base.h>
#include <hardware_interface/joint_command_interface.h>
#include <hardware_interface/joint_state_interface.h>
#include <hardware_interface/robot_hw.h>
#include <ros/ros.h>
#include <class_loader/registry.hpp>

namespace {

using controller_interface::ControllerBase;
using trundle::Robot;

// Joints of the simulator, as gazebo_ros_control's default hardware shows them.
class SimulatedHW : public hardware_interface::RobotHW {
 public:
  SimulatedHW(const TrundleControlJoint* joints, int count) {
    for (int i = 0; i < count; ++i) {
      const TrundleControlJoint& joint = joints[i];
      const hardware_interface::JointStateHandle state(joint.name, joint.position, joint.velocity, joint.effort);
      states_.registerHandle(state);
      const hardware_interface::JointHandle handle(state, joint.command);
      switch (joint.interface) {
        case TRUNDLE_EFFORT: efforts_.registerHandle(handle); break;
        case TRUNDLE_VELOCITY: velocities_.registerHandle(handle); break;
        default: positions_.registerHandle(handle);
      }
    }
    registerInterface(&states_);
    registerInterface(&efforts_);
    registerInterface(&velocities_);
    registerInterface(&positions_);
  }

 private:
  hardware_interface::JointStateInterface states_;
  hardware_interface::EffortJointInterface efforts_;
  hardware_interface::VelocityJointInterface velocities_;
  hardware_interface::PositionJointInterface positions_;
};

struct OpenRobot {
  std::shared_ptr<Robot> robot;
  std::vector<TrundleControlJoint> joints;
  std::vector<std::string> names;
};

struct LoadedController {
  std::shared_ptr<Robot> robot;
  std::unique_ptr<ControllerBase> controller;
  ControllerBase::ClaimedResources claims;
};

std::mutex robots_mutex;
std::map<std::string, std::shared_ptr<Robot>>& robots() {
  static auto* const robots = new std::map<std::string, std::shared_ptr<Robot>>;
  return *robots;
}

ros::Time time_of(int64_t ns) {
  ros::Time time;
  time.fromNSec(static_cast<uint64_t>(std::max<int64_t>(ns, 0)));
  return time;
}
ros::Duration duration_of(int64_t ns) {
  ros::Duration duration;
  duration.fromNSec(ns);
  return duration;
}

void tell(const std::string& text, char* reason, int size) {
  std::snprintf(reason, static_cast<std::size_t>(size), "%s", text.c_str());
}

// Call a function; tell of an exception, or of what a false result means.
template <typename Function>
int attempt(const Function& function, const char* refusal, char* reason, int size) {
  try {
    if (function()) return 1;
    tell(refusal, reason, size);
  } catch (const std::exception& error) {
    tell(error.what(), reason, size);
  } catch (...) {
    tell("it threw an exception of an unknown type", reason, size);
  }
  return 0;
}

void* open_robot(const TrundleControlJoint* joints, int count) {
  OpenRobot* const open = new OpenRobot;
  open->robot = std::make_shared<Robot>();
  open->robot->hardware = std::make_shared<SimulatedHW>(joints, count);
  return open;
}

// Joints of a robot's interface of commands: each with the addresses behind its handle.
template <typename Interface>
void add_joints(OpenRobot& open, int number) {
  Interface* const interface = open.robot->hardware->get<Interface>();
  if (!interface) return;
  for (const std::string& name : interface->getNames()) {
    bool is_known = false;
    for (const std::string& known : open.names) is_known = is_known || known == name;
    if (is_known) continue;
    const hardware_interface::JointHandle handle = interface->getHandle(name);
    open.names.push_back(name);
    open.joints.push_back({nullptr, number, const_cast<double*>(handle.getPositionPtr()),
                           const_cast<double*>(handle.getVelocityPtr()), const_cast<double*>(handle.getEffortPtr()),
                           const_cast<double*>(handle.getCommandPtr())});
  }
  interface->clearClaims();
}

void* find_robot(const char* model) {
  const std::lock_guard<std::mutex> lock(robots_mutex);
  const auto found = robots().find(model);
  if (found == robots().end()) return nullptr;
  OpenRobot* const open = new OpenRobot;
  open->robot = found->second;
  add_joints<hardware_interface::EffortJointInterface>(*open, TRUNDLE_EFFORT);
  add_joints<hardware_interface::VelocityJointInterface>(*open, TRUNDLE_VELOCITY);
  add_joints<hardware_interface::PositionJointInterface>(*open, TRUNDLE_POSITION);
  for (std::size_t i = 0; i < open->joints.size(); ++i) open->joints[i].name = open->names[i].c_str();
  return open;
}

int joint(void* self, int number, TrundleControlJoint* out) {
  const OpenRobot& open = *static_cast<OpenRobot*>(self);
  if (number < 0 || number >= static_cast<int>(open.joints.size())) return 0;
  *out = open.joints[static_cast<std::size_t>(number)];
  return 1;
}

void read(void* self, int64_t time_ns, int64_t period_ns) {
  const Robot& robot = *static_cast<OpenRobot*>(self)->robot;
  if (robot.read) robot.read(time_of(time_ns), duration_of(period_ns));
}
void write(void* self, int64_t time_ns, int64_t period_ns) {
  const Robot& robot = *static_cast<OpenRobot*>(self)->robot;
  if (robot.write) robot.write(time_of(time_ns), duration_of(period_ns));
}
void stop_robot(void* self, int is_active) {
  const Robot& robot = *static_cast<OpenRobot*>(self)->robot;
  if (robot.stop) robot.stop(is_active != 0);
}
void close_robot(void* self) { delete static_cast<OpenRobot*>(self); }

void* load(void* self, const char* class_name, const char* root, const char* name, char* reason, int size) {
  std::unique_ptr<LoadedController> loaded(new LoadedController);
  loaded->robot = static_cast<OpenRobot*>(self)->robot;
  const auto initialize = [&] {
    const class_loader::impl::Create create = class_loader::impl::findClass("", class_name, typeid(ControllerBase));
    if (!create)
      throw std::runtime_error(std::string("it does not export class ") + class_name +
                               "; PLUGINLIB_EXPORT_CLASS(…, controller_interface::ControllerBase) does");
    loaded->controller.reset(static_cast<ControllerBase*>(create()));
    ros::NodeHandle root_node(root), node(root_node, name);
    return loaded->controller->initRequest(loaded->robot->hardware.get(), root_node, node, loaded->claims);
  };
  if (!attempt(initialize, "its init returned false", reason, size)) return nullptr;
  return loaded.release();
}

int claims(void* self, char* out, int size) {
  std::string text;
  for (const auto& claimed : static_cast<LoadedController*>(self)->claims)
    for (const std::string& resource : claimed.resources)
      (text += claimed.hardware_interface) += '\0', (text += resource) += '\0';
  if (static_cast<int>(text.size()) > size) return 0;
  std::memcpy(out, text.data(), text.size());
  return static_cast<int>(text.size());
}

int start(void* self, int64_t time_ns, char* reason, int size) {
  ControllerBase& controller = *static_cast<LoadedController*>(self)->controller;
  return attempt([&] { return controller.startRequest(time_of(time_ns)); }, "it cannot be started", reason, size);
}
int stop(void* self, int64_t time_ns, char* reason, int size) {
  ControllerBase& controller = *static_cast<LoadedController*>(self)->controller;
  return attempt([&] { return controller.stopRequest(time_of(time_ns)); }, "it cannot be stopped", reason, size);
}
int update(void* self, int64_t time_ns, int64_t period_ns, char* reason, int size) {
  ControllerBase& controller = *static_cast<LoadedController*>(self)->controller;
  const auto call = [&] {
    controller.updateRequest(time_of(time_ns), duration_of(period_ns));
    return true;
  };
  return attempt(call, "", reason, size);
}
void close(void* self) { delete static_cast<LoadedController*>(self); }

}  // namespace

extern "C" {

void trundle_control_set_robot(const char* model, std::shared_ptr<trundle::Robot>* robot) {
  const std::lock_guard<std::mutex> lock(robots_mutex);
  if (robot) robots()[model] = *robot;
  else robots().erase(model);
}

const TrundleControlKit* trundle_control_kit(void) {
  static const TrundleControlKit kit = {TRUNDLE_CONTROL_ABI, open_robot, find_robot, joint, read,   write, stop_robot,
                                        close_robot,         load,       claims,     start, update, stop,  close};
  return &kit;
}

}  // extern "C"
