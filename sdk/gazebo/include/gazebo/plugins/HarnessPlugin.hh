// Joints that hold a model to the world, one of which is a winch, until the model is detached.
#ifndef GAZEBO_PLUGINS_HARNESSPLUGIN_HH_
#define GAZEBO_PLUGINS_HARNESSPLUGIN_HH_

#include <mutex>
#include <string>
#include <vector>

#include <boost/thread.hpp>  // as the original brings it

#include <gazebo/common/Events.hh>
#include <gazebo/common/PID.hh>
#include <gazebo/common/Plugin.hh>
#include <gazebo/physics/physics.hh>

namespace gazebo {

// Parameters: any number of <joint>, as in a model, with the world or a link of the model as parent; <winch> with
// <joint>, <pos_pid> and <vel_pid> (p, i, d, i_max, i_min, cmd_max, cmd_min); <detach>: the joint that is removed.
class HarnessPlugin : public ModelPlugin {
 public:
  void Load(physics::ModelPtr model, sdf::ElementPtr sdf) override;
  // Of the winch [m/s]; 0 holds its position.
  double WinchVelocity() const;

 protected:
  void SetWinchVelocity(const float velocity);
  // Once; the winch stops for good.
  void Detach();

 private:
  void Attach(const physics::ModelPtr& model, const sdf::ElementPtr& sdf);
  physics::JointPtr Find(const std::string& name) const;
  void Update(const common::UpdateInfo& info);

  mutable std::mutex mutex_;
  std::vector<physics::JointPtr> joints_;
  physics::JointPtr winch_, detached_;
  common::PID position_pid_, velocity_pid_;
  double position_ = 0.0, velocity_ = 0.0;
  common::Time last_;
  event::ConnectionPtr connection_;
};

}  // namespace gazebo

#endif
