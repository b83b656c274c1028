#ifndef GAZEBO_PHYSICS_MODEL_HH_
#define GAZEBO_PHYSICS_MODEL_HH_

#include <map>
#include <string>

#include <gazebo/physics/Entity.hh>
#include <gazebo/physics/Joint.hh>
#include <gazebo/physics/JointController.hh>
#include <gazebo/physics/Link.hh>

namespace gazebo {
namespace physics {

class Model : public Entity {
 public:
  explicit Model(BasePtr parent);

  LinkPtr GetLink(const std::string& name = "canonical") const;
  LinkPtr GetLinkById(unsigned int id) const;
  const Link_V& GetLinks() const { return links_; }
  JointPtr GetJoint(const std::string& name);
  const Joint_V& GetJoints() const { return joints_; }
  unsigned int GetJointCount() const { return static_cast<unsigned int>(joints_.size()); }
  JointControllerPtr GetJointController();
  unsigned int GetSensorCount() const;
  bool GetSelfCollide() const { return self_collide_; }
  bool GetAutoDisable() const { return true; }
  void SetAutoDisable(bool) {}
  void SetEnabled(bool) {}
  unsigned int GetPluginCount() const { return plugin_count_; }

  virtual ignition::math::Pose3d RelativePose() const { return WorldPose(); }
  virtual ignition::math::Pose3d WorldPose() const;
  virtual void SetWorldPose(const ignition::math::Pose3d& pose, bool notify = true, bool publish = true);
  void SetLinkWorldPose(const ignition::math::Pose3d& pose, std::string link);
  void SetLinkWorldPose(const ignition::math::Pose3d& pose, const LinkPtr& link);
  virtual ignition::math::Vector3d WorldLinearVel() const;
  virtual ignition::math::Vector3d WorldAngularVel() const;
  virtual ignition::math::Vector3d WorldLinearAccel() const;
  virtual ignition::math::Vector3d WorldAngularAccel() const;
  // Every link that no joint holds gets this velocity.
  void SetLinearVel(const ignition::math::Vector3d& velocity);
  void SetAngularVel(const ignition::math::Vector3d& velocity);
  void SetWorldTwist(const ignition::math::Vector3d& linear, const ignition::math::Vector3d& angular,
                     bool update_children = true);
  void SetJointPosition(const std::string& joint, double position, int axis = 0);
  void SetJointPositions(const std::map<std::string, double>& positions);
  // Move joints by their names, each along an animation of its own; `finished` is called at the end of those that are
  // no loops.
  void SetJointAnimation(const std::map<std::string, common::NumericAnimationPtr>& animations,
                         boost::function<void()> finished = boost::function<void()>());
  virtual void StopAnimation();
  void ResetPhysicsStates();
  // Return to the initial state.
  virtual void Reset();

  JointPtr CreateJoint(const std::string& name, const std::string& type, LinkPtr parent, LinkPtr child);
  bool RemoveJoint(const std::string& name);
  void AttachStaticModel(ModelPtr& model, ignition::math::Pose3d offset);
  void DetachStaticModel(const std::string& model);

  // Of all links; see Link.
  void SetCollideMode(const std::string& mode);

 private:
  friend struct Builder;
  friend class World;
  friend class JointController;
  virtual void Animate(const common::Time& time);

  Link_V links_;
  Joint_V joints_;
  std::map<std::string, common::NumericAnimationPtr> joint_animations_;
  boost::function<void()> joint_animations_finished_;
  JointControllerPtr controller_;
  bool self_collide_;
  unsigned int plugin_count_;
};

}  // namespace physics
}  // namespace gazebo

#endif
