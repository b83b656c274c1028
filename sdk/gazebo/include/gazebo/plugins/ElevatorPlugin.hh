// Elevator with a lift and a door, each moved by a prismatic joint.
#ifndef GAZEBO_PLUGINS_ELEVATORPLUGIN_HH_
#define GAZEBO_PLUGINS_ELEVATORPLUGIN_HH_

#include <mutex>
#include <string>

#include <boost/thread.hpp>  // as the original brings it

#include <gazebo/common/Events.hh>
#include <gazebo/common/PID.hh>
#include <gazebo/common/Plugin.hh>
#include <gazebo/msgs/msgs.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/transport/transport.hh>

namespace gazebo {

// Parameters: <lift_joint>, <door_joint>, whose position is 0 where it is shut and 1 m where it is open, <floor_height>
// (3 m), <door_wait_time> (5 s), <topic> (~/elevator: msgs::GzString with the number of a floor).
class ElevatorPlugin : public ModelPlugin {
 public:
  void Load(physics::ModelPtr model, sdf::ElementPtr sdf) override;
  // Shut the door, go to a floor, from 0 on, open the door, and shut it after a while.
  void MoveToFloor(const int floor);

 private:
  enum Phase { RESTING, SHUTTING, LIFTING, OPENING, WAITING, SHUTTING_AGAIN };

  void Update(const common::UpdateInfo& info);
  void OnElevator(const boost::shared_ptr<const msgs::GzString>& message);

  std::mutex mutex_;
  physics::JointPtr lift_, door_;
  common::PID lift_pid_, door_pid_;
  double floor_height_ = 3.0, wait_s_ = 5.0;
  int floor_ = 0;
  bool is_open_ = false;
  Phase phase_ = RESTING;
  common::Time since_, last_;
  transport::NodePtr node_;
  transport::SubscriberPtr commands_;
  event::ConnectionPtr connection_;
};

}  // namespace gazebo

#endif
