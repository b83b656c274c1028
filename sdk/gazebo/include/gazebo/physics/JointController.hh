#ifndef GAZEBO_PHYSICS_JOINTCONTROLLER_HH_
#define GAZEBO_PHYSICS_JOINTCONTROLLER_HH_

#include <map>
#include <string>

#include <gazebo/common/PID.hh>
#include <gazebo/physics/Joint.hh>

namespace gazebo {
namespace physics {

// PID loops of a model's joints; names are `model::joint`. They run before each step once they have a target.
class JointController {
 public:
  explicit JointController(ModelPtr model) : model_(model.get()) {}
  void AddJoint(JointPtr joint);
  void RemoveJoint(Joint* joint);
  void Reset();
  void SetPositionPID(const std::string& joint, const common::PID& pid) { position_pids_[joint] = pid; }
  void SetVelocityPID(const std::string& joint, const common::PID& pid) { velocity_pids_[joint] = pid; }
  bool SetPositionTarget(const std::string& joint, double target);
  bool SetVelocityTarget(const std::string& joint, double target);
  bool SetForce(const std::string& joint, double effort);
  void SetJointPosition(const std::string& joint, double position, int axis = 0);
  void SetJointPosition(JointPtr joint, double position, int axis = 0);
  void SetJointPositions(const std::map<std::string, double>& positions);
  std::map<std::string, JointPtr> GetJoints() const;
  std::map<std::string, common::PID> GetPositionPIDs() const { return position_pids_; }
  std::map<std::string, common::PID> GetVelocityPIDs() const { return velocity_pids_; }
  std::map<std::string, double> GetForces() const { return forces_; }
  std::map<std::string, double> GetPositions() const { return positions_; }
  std::map<std::string, double> GetVelocities() const { return velocities_; }
  void Update();

 private:
  friend class World;
  JointPtr Find(const std::string& name) const;

  Model* model_;
  double step_s_ = 0.0;
  std::map<std::string, common::PID> position_pids_, velocity_pids_;
  std::map<std::string, double> positions_, velocities_, forces_;
};

}  // namespace physics
}  // namespace gazebo

#endif
