#include "plugin_host.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

#ifndef _WIN32
#include <dlfcn.h>
#endif

#include "crash_report.h"

namespace trundle {

namespace {

PluginWorld& world_at(void* self) { return *static_cast<PluginWorld*>(self); }

int find(void* self, int kind, const char* name) { return world_at(self).find(kind, name); }
int read(void* self, int value, int number, int axis, double* out, int capacity) {
  return world_at(self).read(value, number, axis, out, capacity);
}
int write(void* self, int command, int number, int axis, const double* values, int count) {
  return world_at(self).write(command, number, axis, values, count);
}
void request(void* self, const char* const* words, int word_count, const double* numbers, int number_count) {
  world_at(self).request({{words, words + word_count}, {numbers, numbers + number_count}});
}
std::int64_t time_ns(void* self) { return world_at(self).time_ns(); }
std::int64_t step_ns(void* self) { return world_at(self).step_ns(); }
int contacts(void* self, TrundleGazeboContact* out, int capacity) { return world_at(self).contacts(out, capacity); }
void warn(void* self, const char* text) { world_at(self).warn(text); }
void enter(void*, const char* plugin) { set_running_plugin(plugin); }
void begin_call(void* self) { world_at(self).begin_call(); }
void end_call(void* self) { world_at(self).end_call(); }

// What ends the nodes of libraries, and the number of hosts that have plugins.
std::set<void (*)()> stop_functions;
int hosts_with_plugins = 0;

struct Call {
  explicit Call(PluginWorld& of) : world(of) { world.enter_call(); }
  ~Call() { world.leave_call(); }
  PluginWorld& world;
};

#ifdef _WIN32
[[noreturn]] void* open_library(const char*) { throw std::runtime_error("compiled plugins are not run on Windows"); }
void* symbol(void*, const char*) { return nullptr; }
#else
void* open_library(const char* file) {
  void* library = ::dlopen(file, RTLD_NOW | RTLD_LOCAL);
  if (library) return library;
  const char* error = ::dlerror();
  throw std::runtime_error(error ? error : "it cannot be opened");
}
void* symbol(void* library, const char* name) { return ::dlsym(library, name); }
#endif

}  // namespace

PluginHost::PluginHost(const Kinematics& kinematics, std::string world_name, std::string world_elements)
    : world_(kinematics),
      host_{TRUNDLE_GAZEBO_ABI, &world_,  find, read,  write,      request, trundle::time_ns,
            trundle::step_ns,   contacts, warn, enter, begin_call, end_call},
      world_name_(std::move(world_name)),
      world_elements_(std::move(world_elements)),
      start_(std::chrono::steady_clock::now()) {}

std::int64_t PluginHost::real_ns() const {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now() - start_).count();
}

void PluginHost::add_model(const std::string& name, const std::string& elements) {
  const Call call(world_);
  if (models_.emplace(name, elements).second) model_order_.push_back(name);
  for (Kit& kit : kits_)
    kit.functions->add_model(kit.world, name.c_str(), elements.data(), static_cast<std::int64_t>(elements.size()));
}

void PluginHost::remove_model(const std::string& name) {
  const Call call(world_);
  models_.erase(name);
  std::erase(model_order_, name);
  for (Kit& kit : kits_) kit.functions->remove_model(kit.world, name.c_str());
}

std::uintptr_t PluginHost::open(const std::string& file) {
  return reinterpret_cast<std::uintptr_t>(open_library(file.c_str()));
}

void PluginHost::start_ros(std::uintptr_t address, const std::string& master_uri, const std::string& node) {
#ifndef _WIN32
  void* library = reinterpret_cast<void*>(address);
  void* used = symbol(library, "_ZN3ros2okEv");  // ros::ok()
  Dl_info where;
  if (!used || !::dladdr(used, &where) || !where.dli_fname) return;
  const std::string roscpp = where.dli_fname;
  const std::size_t slash = roscpp.rfind('/');
  if (slash == std::string::npos) return;
  const std::size_t dot = roscpp.rfind('.');
  void* starter = open_library((roscpp.substr(0, slash) + "/libgazebo_ros" + roscpp.substr(dot)).c_str());
  if (void* start = symbol(starter, "trundle_gazebo_start_ros"))
    reinterpret_cast<void (*)(const char*, const char*)>(start)(master_uri.c_str(), node.c_str());
  if (void* stop = symbol(starter, "trundle_gazebo_stop_ros"))
    stop_functions.insert(reinterpret_cast<void (*)()>(stop));
#endif
}

PluginHost::Kit& PluginHost::kit_of(void* library) {
  const auto get = reinterpret_cast<const TrundleGazeboKit* (*)()>(symbol(library, "trundle_gazebo_kit"));
  if (!get) throw std::runtime_error("it is not linked with the kit's Gazebo library; ${GAZEBO_LIBRARIES} names it");
  const TrundleGazeboKit* functions = get();
  if (functions->abi != TRUNDLE_GAZEBO_ABI)
    throw std::runtime_error("it was compiled with another release of Trundle; compile it again");
  for (Kit& kit : kits_)
    if (kit.functions == functions) return kit;
  install_crash_report();
  set_crash_hint(functions);
  void* world = functions->open(&host_, world_name_.c_str(), world_elements_.data(),
                                static_cast<std::int64_t>(world_elements_.size()));
  for (const std::string& name : model_order_) {
    const std::string& elements = models_[name];
    functions->add_model(world, name.c_str(), elements.data(), static_cast<std::int64_t>(elements.size()));
  }
  if (kits_.empty()) ++hosts_with_plugins;
  kits_.push_back({functions, world});
  return kits_.back();
}

int PluginHost::load(std::uintptr_t address, const std::string& parent, const std::string& name,
                     const std::string& file, const std::string& elements) {
  void* library = reinterpret_cast<void*>(address);
  const Call call(world_);
  const Kit& kit = kit_of(library);
  char reason[1024] = "";
  const int number =
      kit.functions->load(kit.world, library, parent.c_str(), name.c_str(), file.c_str(), elements.data(),
                          static_cast<std::int64_t>(elements.size()), reason, sizeof(reason));
  if (number == 0) throw std::runtime_error(reason);
  plugins_.emplace_back(kit, number);
  return static_cast<int>(plugins_.size());
}

void PluginHost::reset(int plugin) {
  const Call call(world_);
  if (plugin > 0) {
    const auto& [kit, number] = plugins_.at(static_cast<std::size_t>(plugin) - 1);
    kit.functions->reset(kit.world, number);
    return;
  }
  world_.clear_commands();
  has_stepped_ = false;
  for (Kit& kit : kits_) kit.functions->reset(kit.world, 0);
}

bool PluginHost::wants_reading(int plugin) const {
  const auto& [kit, number] = plugins_.at(static_cast<std::size_t>(plugin) - 1);
  return kit.functions->wants_reading(kit.world, number) != 0;
}

void PluginHost::take_reading(int plugin, std::int64_t time_ns, const TrundleGazeboReading& reading) {
  const auto& [kit, number] = plugins_.at(static_cast<std::size_t>(plugin) - 1);
  world_.begin_call();
  kit.functions->take_reading(kit.world, number, time_ns, &reading);
  world_.end_call();
}

void PluginHost::close() {
  if (!kits_.empty() && --hosts_with_plugins == 0)
    for (const auto stop : std::exchange(stop_functions, {})) stop();
  const Call call(world_);
  for (Kit& kit : kits_) kit.functions->close(kit.world);
  kits_.clear();
  plugins_.clear();
}

bool PluginHost::act(std::int64_t time_ns, std::int64_t step_ns) {
  if (is_replay_) return true;
  const std::int64_t real = real_ns();
  world_.begin(time_ns, step_ns);
  for (Kit& kit : kits_) {
    if (has_stepped_) kit.functions->after_step(kit.world, time_ns, real);
    kit.functions->before_step(kit.world, time_ns, real);
  }
  world_.end();
  has_stepped_ = true;
  return !world_.needs_python();
}

}  // namespace trundle
