#include <controller_manager/controller_manager.h>

#include <algorithm>
#include <chrono>
#include <functional>

namespace controller_manager {
namespace {

using controller_interface::ControllerBase;
using controller_manager_msgs::SwitchController;

typedef std::unique_lock<std::recursive_mutex> Lock;
constexpr std::chrono::milliseconds kPoll(10);

const char* stateName(const ControllerBase& controller) {
  switch (controller.state_) {
    case ControllerBase::ControllerState::INITIALIZED: return "initialized";
    case ControllerBase::ControllerState::RUNNING: return "running";
    case ControllerBase::ControllerState::STOPPED: return "stopped";
    case ControllerBase::ControllerState::WAITING: return "waiting";
    case ControllerBase::ControllerState::ABORTED: return "aborted";
    default: return "constructed";
  }
}

bool isActive(const ControllerSpec& spec) { return spec.c->isRunning() || spec.c->isWaiting(); }

bool contains(const std::vector<ControllerSpec>& specs, const std::string& name) {
  return std::any_of(specs.begin(), specs.end(), [&](const ControllerSpec& spec) { return spec.info.name == name; });
}

}  // namespace

ControllerManager::ControllerManager(hardware_interface::RobotHW* robot_hw, const ros::NodeHandle& nh)
    : robot_hw_(robot_hw), root_nh_(nh), cm_node_(nh, "controller_manager") {
  registerControllerLoader(std::make_shared<ControllerLoader<ControllerBase> >("controller_interface",
                                                                               "controller_interface::ControllerBase"));
  servers_.push_back(cm_node_.advertiseService("list_controllers", &ControllerManager::listControllers, this));
  servers_.push_back(cm_node_.advertiseService("list_controller_types", &ControllerManager::listTypes, this));
  servers_.push_back(cm_node_.advertiseService("load_controller", &ControllerManager::load, this));
  servers_.push_back(cm_node_.advertiseService("unload_controller", &ControllerManager::unload, this));
  servers_.push_back(cm_node_.advertiseService("switch_controller", &ControllerManager::change, this));
  servers_.push_back(cm_node_.advertiseService("reload_controller_libraries", &ControllerManager::reload, this));
}

ControllerManager::~ControllerManager() {
  for (ros::ServiceServer& server : servers_) server.shutdown();
}

void ControllerManager::registerControllerLoader(ControllerLoaderInterfaceSharedPtr controller_loader) {
  loaders_.push_back(controller_loader);
}

const ControllerSpec* ControllerManager::find(const std::string& name) const {
  for (const ControllerSpec& spec : controllers_)
    if (spec.info.name == name) return &spec;
  return nullptr;
}

ControllerBase* ControllerManager::getControllerByName(const std::string& name) {
  const Lock lock(list_mutex_);
  const ControllerSpec* const spec = find(name);
  return spec ? spec->c.get() : nullptr;
}

void ControllerManager::getControllerNames(std::vector<std::string>& names) {
  const Lock lock(list_mutex_);
  names.clear();
  for (const ControllerSpec& spec : controllers_) names.push_back(spec.info.name);
}

void ControllerManager::update(const ros::Time& time, const ros::Duration& period, bool reset_controllers) {
  // The list is locked by others for moments alone; controllers are loaded before they are added.
  const Lock lock(list_mutex_);
  if (reset_controllers)
    for (const ControllerSpec& spec : controllers_)
      if (spec.c->isRunning()) {
        spec.c->stopRequest(time);
        spec.c->startRequest(time);
      }
  for (const ControllerSpec& spec : controllers_) spec.c->updateRequest(time, period);
  if (switch_.is_pending) proceed(time);
}

bool ControllerManager::isReady(const ControllerSpec& spec) const {
  const hardware_interface::RobotHW::SwitchState state =
      switch_.start_asap ? robot_hw_->switchResult(spec.info) : robot_hw_->switchResult();
  return state == hardware_interface::RobotHW::SwitchState::DONE;
}

// Continue with a switch, in the loop: stop controllers, then start each whose hardware is ready.
void ControllerManager::proceed(const ros::Time& time) {
  if (!switch_.is_begun) {
    robot_hw_->doSwitch(switch_.start_infos, switch_.stop_infos);
    for (const ControllerSpec& spec : switch_.stop) spec.c->stopRequest(time);
    switch_.is_begun = true;
    switch_.begin = time;
  }
  const bool is_late = switch_.timeout > 0.0 && (time - switch_.begin).toSec() > switch_.timeout;
  const bool has_failed = robot_hw_->switchResult() == hardware_interface::RobotHW::SwitchState::ERROR;
  bool waits = false;
  for (const ControllerSpec& spec : switch_.start) {
    if (spec.c->isRunning() || spec.c->isAborted()) continue;
    if (has_failed || is_late) spec.c->abortRequest(time);
    else if (isReady(spec)) spec.c->startRequest(time);
    else {
      spec.c->waitRequest(time);
      waits = true;
    }
  }
  if (waits) return;
  switch_.is_pending = false;
  switched_.notify_all();
}

bool ControllerManager::loadController(const std::string& name) {
  const std::lock_guard<std::mutex> services(services_mutex_);
  if (getControllerByName(name)) {
    ROS_ERROR("A controller named '%s' was already loaded inside the controller manager", name.c_str());
    return false;
  }
  ros::NodeHandle c_nh;
  try {
    c_nh = ros::NodeHandle(root_nh_, name);
  } catch (const std::exception& error) {
    ROS_ERROR("Exception thrown while constructing nodehandle for controller with name '%s':\n%s", name.c_str(),
              error.what());
    return false;
  }
  std::string type;
  if (!c_nh.getParam("type", type)) {
    ROS_ERROR(
        "Could not load controller '%s' because the type was not specified. Did you load the controller "
        "configuration on the parameter server (namespace: '%s')?",
        name.c_str(), c_nh.getNamespace().c_str());
    return false;
  }
  ControllerSpec spec;
  std::string reason = "Controller type '" + type + "' does not exist";
  for (const ControllerLoaderInterfaceSharedPtr& loader : loaders_) {
    const std::vector<std::string> types = loader->getDeclaredClasses();
    if (std::find(types.begin(), types.end(), type) == types.end()) continue;
    try {
      spec.c = loader->createInstance(type);
    } catch (const std::exception& error) {
      reason = error.what();
    }
    if (spec.c) break;
  }
  if (!spec.c) {
    ROS_ERROR(
        "Could not load controller '%s': %s; the service list_controller_types lists those of the packages on "
        "ROS_PACKAGE_PATH",
        name.c_str(), reason.c_str());
    return false;
  }
  spec.info.name = name;
  spec.info.type = type;
  try {
    reason = "its init returned false";
    if (!spec.c->initRequest(robot_hw_, root_nh_, c_nh, spec.info.claimed_resources)) spec.c.reset();
  } catch (const std::exception& error) {
    reason = error.what();
    spec.c.reset();
  }
  if (!spec.c) {
    ROS_ERROR("Initializing controller '%s' failed: %s", name.c_str(), reason.c_str());
    return false;
  }
  const Lock lock(list_mutex_);
  controllers_.push_back(spec);
  return true;
}

bool ControllerManager::unloadController(const std::string& name) {
  const std::lock_guard<std::mutex> services(services_mutex_);
  ControllerSpec removed;  // destroyed after the list's lock
  const Lock lock(list_mutex_);
  const ControllerSpec* const spec = find(name);
  if (!spec) {
    ROS_ERROR("Could not unload controller with name '%s' because no controller with this name exists", name.c_str());
    return false;
  }
  if (spec->c->isRunning()) {
    ROS_ERROR("Could not unload controller with name '%s' because it is still running", name.c_str());
    return false;
  }
  removed = *spec;
  controllers_.erase(controllers_.begin() + (spec - controllers_.data()));
  return true;
}

// Add the controllers of a request to `out`; false if one is missing, or is in that state already, and all are wanted.
bool ControllerManager::collect(const std::vector<std::string>& names, bool starts, bool is_strict,
                                std::vector<ControllerSpec>& out) {
  for (const std::string& name : names) {
    const ControllerSpec* const spec = find(name);
    std::string fault;
    if (!spec) fault = "because no controller with this name exists";
    else if (!starts && !isActive(*spec)) fault = "since it is not running";
    else if (starts && isActive(*spec) && !contains(switch_.stop, name)) fault = "since it is already running";
    if (fault.empty()) {
      out.push_back(*spec);
      continue;
    }
    const char* const verb = starts ? "start" : "stop";
    if (is_strict) {
      ROS_ERROR("Could not %s controller with name '%s' %s", verb, name.c_str(), fault.c_str());
      return false;
    }
    ROS_DEBUG("Could not %s controller with name '%s' %s", verb, name.c_str(), fault.c_str());
  }
  return true;
}

bool ControllerManager::switchController(const std::vector<std::string>& start_controllers,
                                         const std::vector<std::string>& stop_controllers, const int strictness,
                                         bool start_asap, double timeout) {
  const std::lock_guard<std::mutex> services(services_mutex_);
  Lock lock(list_mutex_);
  const bool is_strict = strictness != SwitchController::Request::BEST_EFFORT;
  switch_ = Switch();
  switch_.start_asap = start_asap;
  switch_.timeout = timeout;
  if (!collect(stop_controllers, false, is_strict, switch_.stop) ||
      !collect(start_controllers, true, is_strict, switch_.start)) {
    switch_ = Switch();
    return false;
  }
  std::list<hardware_interface::ControllerInfo> afterwards;
  for (const ControllerSpec& spec : controllers_) {
    const bool stops = contains(switch_.stop, spec.info.name), starts = contains(switch_.start, spec.info.name);
    if (stops) switch_.stop_infos.push_back(spec.info);
    if (starts) switch_.start_infos.push_back(spec.info);
    if (starts || (isActive(spec) && !stops)) afterwards.push_back(spec.info);
  }
  if (robot_hw_->checkForConflict(afterwards)) {
    ROS_ERROR("Could not switch controllers, due to resource conflict");
    switch_ = Switch();
    return false;
  }
  if (!robot_hw_->prepareSwitch(switch_.start_infos, switch_.stop_infos)) {
    ROS_ERROR(
        "Could not switch controllers. The hardware interface combination for the requested controllers is "
        "unfeasible.");
    switch_ = Switch();
    return false;
  }
  if (switch_.stop.empty() && switch_.start.empty()) return true;
  switch_.is_pending = true;
  while (ros::ok() && switch_.is_pending) switched_.wait_for(lock, kPoll);
  const bool has_started = std::all_of(switch_.start.begin(), switch_.start.end(),
                                       [](const ControllerSpec& spec) { return spec.c->isRunning(); });
  const bool is_done = !switch_.is_pending;
  switch_ = Switch();
  return is_done && has_started;
}

bool ControllerManager::listControllers(controller_manager_msgs::ListControllers::Request&,
                                        controller_manager_msgs::ListControllers::Response& response) {
  const Lock lock(list_mutex_);
  for (const ControllerSpec& spec : controllers_) {
    controller_manager_msgs::ControllerState state;
    state.name = spec.info.name;
    state.type = spec.info.type;
    state.state = stateName(*spec.c);
    for (const hardware_interface::InterfaceResources& claimed : spec.info.claimed_resources) {
      controller_manager_msgs::HardwareInterfaceResources resources;
      resources.hardware_interface = claimed.hardware_interface;
      resources.resources.assign(claimed.resources.begin(), claimed.resources.end());
      state.claimed_resources.push_back(resources);
    }
    response.controller.push_back(state);
  }
  return true;
}

bool ControllerManager::listTypes(controller_manager_msgs::ListControllerTypes::Request&,
                                  controller_manager_msgs::ListControllerTypes::Response& response) {
  for (const ControllerLoaderInterfaceSharedPtr& loader : loaders_)
    for (const std::string& type : loader->getDeclaredClasses()) {
      response.types.push_back(type);
      response.base_classes.push_back(loader->getName());
    }
  return true;
}

bool ControllerManager::load(controller_manager_msgs::LoadController::Request& request,
                             controller_manager_msgs::LoadController::Response& response) {
  response.ok = loadController(request.name);
  return true;
}

bool ControllerManager::unload(controller_manager_msgs::UnloadController::Request& request,
                               controller_manager_msgs::UnloadController::Response& response) {
  response.ok = unloadController(request.name);
  return true;
}

bool ControllerManager::change(controller_manager_msgs::SwitchController::Request& request,
                               controller_manager_msgs::SwitchController::Response& response) {
  response.ok = switchController(request.start_controllers, request.stop_controllers, request.strictness,
                                 request.start_asap, request.timeout);
  return true;
}

bool ControllerManager::reload(controller_manager_msgs::ReloadControllerLibraries::Request& request,
                               controller_manager_msgs::ReloadControllerLibraries::Response& response) {
  const std::lock_guard<std::mutex> services(services_mutex_);
  const Lock lock(list_mutex_);
  const bool are_running = std::any_of(controllers_.begin(), controllers_.end(), isActive);
  response.ok = !controllers_.empty() && (are_running || !request.force_kill) ? false : true;
  if (!response.ok) {
    ROS_ERROR("Controller manager: Cannot reload controller libraries because %s",
              are_running ? "there are still controllers running" : "there are still controllers loaded");
    return true;
  }
  controllers_.clear();
  for (const ControllerLoaderInterfaceSharedPtr& loader : loaders_) loader->reload();
  return true;
}

}  // namespace controller_manager
