#ifndef GAZEBO_PHYSICS_WORLD_HH_
#define GAZEBO_PHYSICS_WORLD_HH_

#include <memory>
#include <string>
#include <vector>

#include <boost/enable_shared_from_this.hpp>

#include <sdf/sdf.hh>

#include <gazebo/trundle_host.h>
#include <gazebo/common/SphericalCoordinates.hh>
#include <gazebo/common/Time.hh>
#include <gazebo/common/UpdateInfo.hh>
#include <gazebo/physics/Model.hh>
#include <gazebo/physics/PhysicsEngine.hh>
#include <gazebo/physics/PresetManager.hh>

namespace gazebo {
namespace physics {

class World : public boost::enable_shared_from_this<World> {
 public:
  explicit World(const std::string& name);
  ~World();

  std::string Name() const { return name_; }
  common::Time SimTime() const;
  common::Time RealTime() const { return real_time_; }
  common::Time PauseTime() const { return common::Time(); }
  common::Time StartTime() const { return start_time_; }
  uint64_t Iterations() const { return iterations_; }
  // Plugins are not called while it is paused.
  bool IsPaused() const { return is_paused_; }
  // For what a plugin does at one time alone: the page and /gazebo/pause_physics pause the simulation.
  void SetPaused(bool is_paused) { is_paused_ = is_paused; }
  bool Running() const { return true; }
  PhysicsEnginePtr Physics() const { return physics_; }
  // Its <physics> elements by their names.
  PresetManagerPtr PresetMgr() const { return presets_; }
  // Without physics nothing moves but what plugins move, and time goes on.
  bool PhysicsEnabled() const { return physics_enabled_; }
  void SetPhysicsEnabled(bool is_enabled);
  ignition::math::Vector3d Gravity() const;
  void SetGravity(const ignition::math::Vector3d& gravity);

  // As in the file; null without <spherical_coordinates>.
  common::SphericalCoordinatesPtr SphericalCoords() const { return spherical_coordinates_; }

  unsigned int ModelCount() const { return static_cast<unsigned int>(models_.size()); }
  ModelPtr ModelByIndex(unsigned int index) const { return index < models_.size() ? models_[index] : ModelPtr(); }
  // Null where there is none; so are the next two.
  ModelPtr ModelByName(const std::string& name) const;
  EntityPtr EntityByName(const std::string& name) const;
  BasePtr BaseByName(const std::string& name) const;
  Model_V Models() const { return models_; }

  // Done between two steps.
  void Reset();
  void ResetTime();
  void ResetEntities(Base::EntityType type = Base::BASE);
  void InsertModelFile(const std::string& filename);
  void InsertModelString(const std::string& sdf);
  void InsertModelSDF(const sdf::SDF& sdf);
  void RemoveModel(const std::string& name);
  void RemoveModel(ModelPtr model) { RemoveModel(model->GetName()); }

  // Names up to Gazebo 8.
  std::string GetName() const { return Name(); }
  common::Time GetSimTime() const { return SimTime(); }
  common::Time GetRealTime() const { return RealTime(); }
  common::Time GetStartTime() const { return StartTime(); }
  uint32_t GetIterations() const { return static_cast<uint32_t>(Iterations()); }
  bool GetRunning() const { return Running(); }
  bool GetEnablePhysicsEngine() const { return PhysicsEnabled(); }
  void EnablePhysicsEngine(bool is_enabled) { SetPhysicsEnabled(is_enabled); }
  common::SphericalCoordinatesPtr GetSphericalCoordinates() const { return spherical_coordinates_; }
  PhysicsEnginePtr GetPhysicsEngine() const { return Physics(); }
  PresetManagerPtr GetPresetManager() const { return PresetMgr(); }
  unsigned int GetModelCount() const { return ModelCount(); }
  ModelPtr GetModel(unsigned int index) const { return ModelByIndex(index); }
  ModelPtr GetModel(const std::string& name) const { return ModelByName(name); }
  EntityPtr GetEntity(const std::string& name) const { return EntityByName(name); }
  BasePtr GetByName(const std::string& name) const { return BaseByName(name); }
  Model_V GetModels() const { return models_; }

  // For the library: the simulator's interface.
  const TrundleGazeboHost* Host() const { return host_; }
  void Request(const std::vector<std::string>& words, const std::vector<double>& numbers = {}) const;
  void BeforeStep(int64_t time_ns, int64_t real_ns);
  void AfterStep(int64_t time_ns, int64_t real_ns);
  // Connect the joints that plugins have attached.
  void ConnectJoints();

 private:
  friend struct Builder;
  friend class Collision;
  friend class Entity;
  friend class Joint;
  friend class Link;
  friend class PhysicsEngine;
  void Animate();
  void SendSurfaces();
  std::string name_;
  const TrundleGazeboHost* host_;
  PhysicsEnginePtr physics_;
  PresetManagerPtr presets_;
  Model_V models_;
  Joint_V made_joints_;
  Entity_V animated_;
  // Whose weight is added or taken before each step.
  Link_V weight_changes_;
  // Whose surface a plugin has, and may change.
  std::vector<boost::weak_ptr<const Collision>> surfaces_;
  common::Time sent_surfaces_;
  common::SphericalCoordinatesPtr spherical_coordinates_;
  common::Time real_time_, start_time_;
  common::UpdateInfo update_info_;
  int64_t last_time_ns_;
  uint64_t iterations_;
  bool is_paused_, physics_enabled_;
};

// World by name; "": the one whose plugin runs, else the last one.
WorldPtr get_world(const std::string& name = "");
bool has_world(const std::string& name = "");

}  // namespace physics
}  // namespace gazebo

#endif
