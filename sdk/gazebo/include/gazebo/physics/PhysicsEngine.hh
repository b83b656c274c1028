#ifndef GAZEBO_PHYSICS_PHYSICSENGINE_HH_
#define GAZEBO_PHYSICS_PHYSICSENGINE_HH_

#include <string>

#include <boost/any.hpp>
#include <boost/thread/recursive_mutex.hpp>

#include <gazebo/math/Vector3.hh>
#include <gazebo/physics/PhysicsTypes.hh>

namespace gazebo {
namespace physics {

class PhysicsEngine {
 public:
  explicit PhysicsEngine(World* world);
  ~PhysicsEngine();
  // "ode", whose files the simulator follows.
  std::string GetType() const { return "ode"; }
  double GetMaxStepSize() const;
  void SetMaxStepSize(double step_s);
  double GetRealTimeUpdateRate() const { return update_rate_; }
  double GetUpdatePeriod() { return update_rate_ > 0 ? 1.0 / update_rate_ : 0.0; }
  double GetTargetRealTimeFactor() const { return real_time_factor_; }
  math::Vector3 GetGravity() const;
  void SetGravity(const ignition::math::Vector3d& gravity);
  // Parameters by their names in SDF: max_step_size and gravity, which are set from the next step on, real_time_factor,
  // real_time_update_rate and type. The others are of Gazebo's engines: false, with a warning.
  bool SetParam(const std::string& key, const boost::any& value);
  bool GetParam(const std::string& key, boost::any& value) const;
  boost::any GetParam(const std::string& key) const;
  // Not locked by the simulation: what plugins read and write is consistent from any thread.
  boost::recursive_mutex* GetPhysicsUpdateMutex() const { return &mutex_; }
  ContactManager* GetContactManager() const { return contacts_; }
  // Joint that Load or Attach connects.
  JointPtr CreateJoint(const std::string& type, ModelPtr model = ModelPtr());

 private:
  friend struct Builder;
  PhysicsEngine(const PhysicsEngine&);
  World* world_;
  double update_rate_, real_time_factor_;
  mutable boost::recursive_mutex mutex_;
  ContactManager* contacts_;
};

}  // namespace physics
}  // namespace gazebo

#endif
