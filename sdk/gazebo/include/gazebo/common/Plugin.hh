// Base classes of plugins, and the macros that register one in its library.
#ifndef GAZEBO_COMMON_PLUGIN_HH_
#define GAZEBO_COMMON_PLUGIN_HH_

#include <memory>
#include <string>

#include <boost/enable_shared_from_this.hpp>
#include <boost/shared_ptr.hpp>

#include <sdf/sdf.hh>

#include <gazebo/trundle_host.h>
#include <gazebo/common/CommonTypes.hh>
#include <gazebo/common/Console.hh>
#include <gazebo/common/Events.hh>
#include <gazebo/common/Exception.hh>
#include <gazebo/physics/PhysicsTypes.hh>
#include <gazebo/rendering/RenderTypes.hh>
#include <gazebo/sensors/SensorTypes.hh>
#include <gazebo/util/system.hh>

namespace gazebo {

enum PluginType { WORLD_PLUGIN, MODEL_PLUGIN, SENSOR_PLUGIN, SYSTEM_PLUGIN, VISUAL_PLUGIN, GUI_PLUGIN };

// What all kinds have; their libraries are opened by the simulator.
template <class T>
class PluginT : public boost::enable_shared_from_this<T> {
 public:
  typedef boost::shared_ptr<T> TPtr;

  virtual ~PluginT() {}
  std::string GetFilename() const { return filename; }
  std::string GetHandle() const { return handleName; }
  PluginType GetType() const { return type; }
  void SetName(const std::string& file, const std::string& name) {
    filename = file;
    handleName = name;
  }

 protected:
  explicit PluginT(PluginType kind) : type(kind) {}

  PluginType type;
  std::string filename;
  std::string handleName;
};

class WorldPlugin : public PluginT<WorldPlugin> {
 public:
  WorldPlugin() : PluginT<WorldPlugin>(WORLD_PLUGIN) {}
  virtual ~WorldPlugin() {}
  virtual void Load(physics::WorldPtr world, sdf::ElementPtr sdf) = 0;
  virtual void Init() {}
  virtual void Reset() {}
};

class ModelPlugin : public PluginT<ModelPlugin> {
 public:
  ModelPlugin() : PluginT<ModelPlugin>(MODEL_PLUGIN) {}
  virtual ~ModelPlugin() {}
  virtual void Load(physics::ModelPtr model, sdf::ElementPtr sdf) = 0;
  virtual void Init() {}
  virtual void Reset() {}
};

class SensorPlugin : public PluginT<SensorPlugin> {
 public:
  SensorPlugin() : PluginT<SensorPlugin>(SENSOR_PLUGIN) {}
  virtual ~SensorPlugin() {}
  virtual void Load(sensors::SensorPtr sensor, sdf::ElementPtr sdf) = 0;
  virtual void Init() {}
  virtual void Reset() {}
};

class SystemPlugin : public PluginT<SystemPlugin> {
 public:
  SystemPlugin() : PluginT<SystemPlugin>(SYSTEM_PLUGIN) {}
  virtual ~SystemPlugin() {}
  virtual void Load(int argc = 0, char** argv = nullptr) = 0;
  virtual void Init() {}
  virtual void Reset() {}
};

class VisualPlugin : public PluginT<VisualPlugin> {
 public:
  VisualPlugin() : PluginT<VisualPlugin>(VISUAL_PLUGIN) {}
  virtual ~VisualPlugin() {}
  virtual void Load(rendering::VisualPtr visual, sdf::ElementPtr sdf) = 0;
  virtual void Init() {}
  virtual void Reset() {}
};

}  // namespace gazebo

// The simulator opens only libraries with this text: others are for Gazebo itself.
#define TRUNDLE_GAZEBO_MARK "trundle gazebo plugin, interface 1"

// TrundleGazeboLink links a plugin that uses nothing else of the library, which the linker would leave out.
#define TRUNDLE_REGISTER_PLUGIN(classname, base, kind)                                            \
  extern "C" GZ_PLUGIN_VISIBLE const char* TrundleGazeboMark() { return TRUNDLE_GAZEBO_MARK; }    \
  extern "C" GZ_PLUGIN_VISIBLE const void* TrundleGazeboLink() { return ::trundle_gazebo_kit(); } \
  extern "C" GZ_PLUGIN_VISIBLE int TrundleGazeboPluginKind() { return ::gazebo::kind; }           \
  extern "C" GZ_PLUGIN_VISIBLE void* TrundleGazeboMakePlugin() { return static_cast<::gazebo::base*>(new classname()); }

#define GZ_REGISTER_WORLD_PLUGIN(classname) TRUNDLE_REGISTER_PLUGIN(classname, WorldPlugin, WORLD_PLUGIN)
#define GZ_REGISTER_MODEL_PLUGIN(classname) TRUNDLE_REGISTER_PLUGIN(classname, ModelPlugin, MODEL_PLUGIN)
#define GZ_REGISTER_SENSOR_PLUGIN(classname) TRUNDLE_REGISTER_PLUGIN(classname, SensorPlugin, SENSOR_PLUGIN)
#define GZ_REGISTER_SYSTEM_PLUGIN(classname) TRUNDLE_REGISTER_PLUGIN(classname, SystemPlugin, SYSTEM_PLUGIN)
#define GZ_REGISTER_VISUAL_PLUGIN(classname) TRUNDLE_REGISTER_PLUGIN(classname, VisualPlugin, VISUAL_PLUGIN)

#endif
