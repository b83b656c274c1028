// Profiles of the physics: a world's <physics> elements by their names, one of which is current.
#ifndef GAZEBO_PHYSICS_PRESETMANAGER_HH_
#define GAZEBO_PHYSICS_PRESETMANAGER_HH_

#include <map>
#include <string>
#include <vector>

#include <boost/any.hpp>
#include <sdf/sdf.hh>

#include <gazebo/physics/PhysicsTypes.hh>

namespace gazebo {
namespace physics {

// Parameters by the names of their elements: a number is a double, or an int where it counts; gravity is a Vector3d.
class Preset {
 public:
  Preset() {}
  Preset(const std::string& name) : name_(name) {}

  std::string Name() const { return name_; }
  bool HasParam(const std::string& key) const { return values_.count(key) != 0; }
  bool GetParam(const std::string& key, boost::any& value) const;
  bool SetParam(const std::string& key, const boost::any& value);
  // Set all in the engine; return whether each has an effect.
  bool SetAllPhysicsParameters(PhysicsEnginePtr engine) const;
  // Add the values of a <physics> element.
  bool SetAllParamsFromSDF(const sdf::ElementPtr element);
  // As given, without what was set since; null where nothing was given.
  sdf::ElementPtr SDF() const { return sdf_; }
  bool SDF(const sdf::ElementPtr element);

 private:
  std::string name_;
  sdf::ElementPtr sdf_;
  std::map<std::string, boost::any> values_;
};

class PresetManager {
 public:
  PresetManager(PhysicsEnginePtr engine, const sdf::ElementPtr world);

  // Without a current profile "".
  std::string CurrentProfile() const { return current_; }
  // Set the parameters of a profile in the engine, those that have an effect; false if there is no such profile.
  bool CurrentProfile(const std::string& name);
  std::vector<std::string> AllProfiles() const;
  bool HasProfile(const std::string& name) const { return presets_.count(name) != 0; }

  // A profile with the engine's parameters.
  bool CreateProfile(const std::string& name);
  // A profile with these in addition, of the element's name; return the name, or "" if there is none.
  std::string CreateProfile(const sdf::ElementPtr element);
  void RemoveProfile(const std::string& name);

  // False if there is no such profile, or it does not have the parameter.
  bool GetProfileParam(const std::string& name, const std::string& key, boost::any& value) const;
  bool GetCurrentProfileParam(const std::string& key, boost::any& value) const;
  // Of the current profile in the engine as well, whose answer is returned.
  bool SetProfileParam(const std::string& name, const std::string& key, const boost::any& value);
  bool SetCurrentProfileParam(const std::string& key, const boost::any& value);

  // <physics> as it was given; null if there is no such profile.
  sdf::ElementPtr ProfileSDF(const std::string& name) const;
  bool ProfileSDF(const std::string& name, const sdf::ElementPtr element);
  // <physics> with what was set since.
  void GenerateSDFFromPreset(const std::string& name, sdf::ElementPtr& element) const;

 private:
  Preset* Find(const std::string& name);
  const Preset* Find(const std::string& name) const;
  PhysicsEnginePtr engine_;
  std::map<std::string, Preset> presets_;
  std::string current_;
};

}  // namespace physics
}  // namespace gazebo

#endif
