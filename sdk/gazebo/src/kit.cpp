#include "kit.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <set>

#include <dlfcn.h>
#include <boost/make_shared.hpp>

#include <gazebo/common/common.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/rendering/Visual.hh>
#include <gazebo/sensors/sensors.hh>

#include "builder.h"
#include "world_topics.h"

namespace gazebo {

// A loaded plugin, of any kind.
struct LoadedPlugin {
  // A destructor is the plugin's code, too.
  ~LoadedPlugin() {
    const event::internal::Running running(owner);
    reset = nullptr;
    object.reset();
  }

  event::internal::Owner owner;
  std::string model;
  int number;
  boost::shared_ptr<void> object;
  sensors::SensorPtr sensor;
  rendering::VisualPtr visual;
  std::function<void()> reset;
};

struct OpenWorld {
  TrundleGazeboHost host;
  physics::WorldPtr world;
  std::unique_ptr<physics::WorldTopics> topics;
  std::vector<std::unique_ptr<LoadedPlugin>> plugins;
  int last_number = 0;
};

namespace {

std::mutex worlds_mutex;
std::vector<OpenWorld*> worlds;
thread_local event::internal::Owner current = {nullptr, nullptr, nullptr};
// By the Load of the plugin that is destroyed for it; else empty.
thread_local std::string thrown;

// A text that is never freed: connections name their plugin after its end.
const char* kept(const char* text) {
  static std::set<std::string> texts;
  return texts.insert(text).first->c_str();
}

OpenWorld* world_of(const void* world) {
  const std::lock_guard<std::mutex> lock(worlds_mutex);
  for (OpenWorld* open : worlds)
    if (open->world.get() == world) return open;
  return nullptr;
}

std::string describe_exception() {
  try {
    throw;
  } catch (const common::Exception& error) {
    return error.GetErrorStr();
  } catch (const std::exception& error) {
    return error.what();
  } catch (const std::string& text) {
    return text;
  } catch (const char* text) {
    return text;
  } catch (...) {
    return "an exception of an unknown type";
  }
}

void* open_world(const TrundleGazeboHost* host, const char* name, const char* elements, int64_t size) {
  OpenWorld* open = new OpenWorld;
  open->host = *host;
  open->world = boost::make_shared<physics::World>(name);
  physics::Builder::SetHost(open->world, &open->host, physics::read_elements(elements, size));
  {
    const std::lock_guard<std::mutex> lock(worlds_mutex);
    worlds.push_back(open);
  }
  open->topics.reset(new physics::WorldTopics(*open->world));
  return open;
}

void close_world(void* self) {
  OpenWorld* open = static_cast<OpenWorld*>(self);
  open->plugins.clear();
  open->topics.reset();
  const std::lock_guard<std::mutex> lock(worlds_mutex);
  worlds.erase(std::remove(worlds.begin(), worlds.end(), open), worlds.end());
}

void add_model(void* self, const char* name, const char* elements, int64_t size) {
  OpenWorld* open = static_cast<OpenWorld*>(self);
  const sdf::ElementPtr sdf = physics::read_elements(elements, size);
  if (!sdf) return;
  physics::Builder::AddModel(open->world, name, sdf);
  event::Events::addEntity.SignalIn(open->world.get(), name);
}

void remove_model(void* self, const char* name) {
  OpenWorld* open = static_cast<OpenWorld*>(self);
  event::Events::deleteEntity.SignalIn(open->world.get(), name);
  open->plugins.erase(std::remove_if(open->plugins.begin(), open->plugins.end(),
                                     [name](const std::unique_ptr<LoadedPlugin>& p) { return p->model == name; }),
                      open->plugins.end());
  sensors::SensorManager::Instance()->Remove(open->world.get(), name);
  physics::Builder::RemoveModel(open->world, name);
}

// The plugin of a kind, with the two functions that all kinds have.
template <typename T>
T* hold(LoadedPlugin& loaded, void* made, const char* file, const char* name) {
  const boost::shared_ptr<T> plugin(static_cast<T*>(made));
  plugin->SetName(file, name);
  loaded.object = plugin;
  loaded.reset = [plugin] { plugin->Reset(); };
  return plugin.get();
}

// Sensor of a name as `model::link::sensor`; null if there is none.
sensors::SensorPtr find_sensor(const OpenWorld& open, const std::string& name) {
  const std::size_t last = name.rfind("::");
  if (last == std::string::npos) return sensors::SensorPtr();
  const physics::BasePtr parent = open.world->BaseByName(name.substr(0, last));
  if (!parent || !parent->GetSDF()) return sensors::SensorPtr();
  for (sdf::ElementPtr e = parent->GetSDF()->FindElement("sensor"); e; e = e->GetNextElement("sensor"))
    if (e->Get<std::string>("name") == name.substr(last + 2))
      return sensors::SensorManager::Instance()->Make(open.world, parent, e);
  return sensors::SensorPtr();
}

// Visual of a name as `model::link::visual`; null if there is none.
rendering::VisualPtr find_visual(const OpenWorld& open, const std::string& name) {
  const std::size_t last = name.rfind("::");
  if (last == std::string::npos) return rendering::VisualPtr();
  const auto link = boost::dynamic_pointer_cast<physics::Link>(open.world->BaseByName(name.substr(0, last)));
  if (!link) return rendering::VisualPtr();
  for (sdf::ElementPtr e = link->GetSDF()->FindElement("visual"); e; e = e->GetNextElement("visual"))
    if (e->Get<std::string>("name") == name.substr(last + 2)) return std::make_shared<rendering::Visual>(link, e);
  return rendering::VisualPtr();
}

std::string load_plugin(OpenWorld& open, LoadedPlugin& loaded, void* library, const char* parent, const char* file,
                        const sdf::ElementPtr& sdf) {
  const auto kind = reinterpret_cast<int (*)()>(dlsym(library, "TrundleGazeboPluginKind"));
  const auto make = reinterpret_cast<void* (*)()>(dlsym(library, "TrundleGazeboMakePlugin"));
  if (!kind || !make) return "it registers no plugin; GZ_REGISTER_MODEL_PLUGIN(…) does";
  const char* name = loaded.owner.plugin;
  switch (kind()) {
    case MODEL_PLUGIN: {
      const physics::ModelPtr model = open.world->ModelByName(parent);
      if (!model) return "it is a model's plugin, and belongs into a <model>";
      ModelPlugin* plugin = hold<ModelPlugin>(loaded, make(), file, name);
      physics::Builder::CountPlugin(model);
      plugin->Load(model, sdf);
      plugin->Init();
      return "";
    }
    case WORLD_PLUGIN: {
      if (open.world->Name() != parent) return "it is a world's plugin, and belongs into the <world>";
      WorldPlugin* plugin = hold<WorldPlugin>(loaded, make(), file, name);
      plugin->Load(open.world, sdf);
      plugin->Init();
      return "";
    }
    case SENSOR_PLUGIN: {
      loaded.sensor = find_sensor(open, parent);
      if (!loaded.sensor) return "it is a sensor's plugin, and belongs into a <sensor> of a kind that the kit has";
      const std::string name_of_parent = loaded.sensor->ParentName();
      loaded.model = name_of_parent.substr(0, name_of_parent.find("::"));
      SensorPlugin* plugin = hold<SensorPlugin>(loaded, make(), file, name);
      plugin->Load(loaded.sensor, sdf);
      plugin->Init();
      return "";
    }
    case SYSTEM_PLUGIN: {
      SystemPlugin* plugin = hold<SystemPlugin>(loaded, make(), file, name);
      static char program[] = "gzserver";
      static char* arguments[] = {program, nullptr};
      plugin->Load(1, arguments);
      plugin->Init();
      for (const physics::ModelPtr& model : open.world->Models())
        event::Events::addEntity.SignalTo(loaded.owner, model->GetName());
      event::Events::worldCreated.SignalTo(loaded.owner, open.world->Name());
      return "";
    }
    case VISUAL_PLUGIN: {
      loaded.visual = find_visual(open, parent);
      if (!loaded.visual) return "it is a visual's plugin, and belongs into a <visual>";
      loaded.model = loaded.visual->Name().substr(0, loaded.visual->Name().find("::"));
      VisualPlugin* plugin = hold<VisualPlugin>(loaded, make(), file, name);
      plugin->Load(loaded.visual, sdf);
      plugin->Init();
      return "";
    }
    default: return "it is a plugin of the window, which is the page here";
  }
}

int load(void* self, void* library, const char* parent, const char* name, const char* file, const char* elements,
         int64_t size, char* reason, int reason_size) {
  OpenWorld& open = *static_cast<OpenWorld*>(self);
  std::unique_ptr<LoadedPlugin> loaded(new LoadedPlugin);
  loaded->owner = {kept(name), open.world.get(), &open.host};
  loaded->model = parent;
  std::string fault;
  {
    const event::internal::Running running(loaded->owner);
    try {
      fault = load_plugin(open, *loaded, library, parent, file, physics::read_elements(elements, size));
    } catch (...) {
      fault = thrown = describe_exception();
    }
  }
  std::snprintf(reason, static_cast<std::size_t>(reason_size), "%s", fault.c_str());
  open.world->ConnectJoints();
  if (!fault.empty()) {
    loaded.reset();
    thrown.clear();
    return 0;
  }
  open.plugins.push_back(std::move(loaded));
  return open.plugins.back()->number = ++open.last_number;
}

void before_step(void* self, int64_t time_ns, int64_t real_ns) {
  const OpenWorld& open = *static_cast<OpenWorld*>(self);
  open.world->BeforeStep(time_ns, real_ns);
  for (const std::unique_ptr<LoadedPlugin>& plugin : open.plugins)
    if (plugin->visual) plugin->visual->Send(common::Time::FromNanoseconds(time_ns));
}

void after_step(void* self, int64_t time_ns, int64_t real_ns) {
  OpenWorld* open = static_cast<OpenWorld*>(self);
  open->world->AfterStep(time_ns, real_ns);
  if (open->topics) open->topics->Update(common::Time::FromNanoseconds(time_ns));
}

void reset(void* self, int number) {
  OpenWorld& open = *static_cast<OpenWorld*>(self);
  if (number == 0) event::Events::worldReset.SignalIn(open.world.get());
  for (const std::unique_ptr<LoadedPlugin>& plugin : open.plugins) {
    if (plugin->number != number || !plugin->reset) continue;
    const event::internal::Running running(plugin->owner);
    try {
      plugin->reset();
    } catch (...) {
      event::internal::ReportException(plugin->owner);
    }
  }
}

LoadedPlugin* plugin_of(void* self, int number) {
  for (const std::unique_ptr<LoadedPlugin>& plugin : static_cast<OpenWorld*>(self)->plugins)
    if (plugin->number == number) return plugin.get();
  return nullptr;
}

int wants_reading(void* self, int number) {
  const LoadedPlugin* const plugin = plugin_of(self, number);
  return plugin && plugin->sensor && plugin->sensor->IsWanted();
}

void take_reading(void* self, int number, int64_t time_ns, const TrundleGazeboReading* reading) {
  LoadedPlugin* const plugin = plugin_of(self, number);
  if (plugin && plugin->sensor) plugin->sensor->Take(static_cast<OpenWorld*>(self)->world.get(), time_ns, *reading);
}

const char* hint() {
  static thread_local std::string text;
  if (!thrown.empty()) text = "its Load threw: " + thrown;
  else if (!(text = sdf::LastMissingElement()).empty()) text.insert(0, "it looked for a parameter that is missing: ");
  return text.c_str();
}

const TrundleGazeboKit kit = {TRUNDLE_GAZEBO_ABI, open_world, close_world,   add_model,    remove_model, load,
                              before_step,        after_step, wants_reading, take_reading, reset,        hint};

}  // namespace

OpenWorld* find_world(const std::string& name) {
  if (name.empty() && current.world) return world_of(current.world);
  const std::lock_guard<std::mutex> lock(worlds_mutex);
  for (auto open = worlds.rbegin(); open != worlds.rend(); ++open)
    if (name.empty() || (*open)->world->Name() == name) return *open;
  return nullptr;
}

namespace event {
namespace internal {

const Owner& CurrentOwner() { return current; }

Owner Enter(const Owner& owner) {
  const Owner before = current;
  current = owner;
  const TrundleGazeboHost* host = owner.host ? owner.host : before.host;
  if (host) host->enter(host->self, owner.plugin);
  return before;
}

void ReportException(const Owner& owner) {
  const std::string text = std::string("plugin '") + (owner.plugin ? owner.plugin : "C++") +
                           "': " + describe_exception() + "; the run goes on without this function of it";
  if (owner.host) owner.host->warn(owner.host->self, text.c_str());
  else gzerr << text << std::endl;
}

}  // namespace internal
}  // namespace event

namespace physics {

WorldPtr get_world(const std::string& name) {
  OpenWorld* open = find_world(name);
  if (!open) gzthrow("there is no world '" << name << "'");
  return open->world;
}

bool has_world(const std::string& name) { return find_world(name) != nullptr; }

}  // namespace physics
}  // namespace gazebo

extern "C" const TrundleGazeboKit* trundle_gazebo_kit(void) { return &gazebo::kit; }
