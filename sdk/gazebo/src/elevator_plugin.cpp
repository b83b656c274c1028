#include <gazebo/plugins/ElevatorPlugin.hh>

#include <cmath>
#include <cstdlib>

namespace gazebo {

namespace {

constexpr double kDoorReached = 0.05, kFloorReached = 0.15;  // [m]

physics::JointPtr joint_of(const physics::ModelPtr& model, const sdf::ElementPtr& sdf, const char* name) {
  if (!sdf->HasElement(name)) gzthrow("an elevator needs a <" << name << ">");
  const std::string joint = sdf->Get<std::string>(name);
  const physics::JointPtr found = model->GetJoint(joint);
  if (!found) gzthrow("<" << name << ">: model " << model->GetName() << " has no joint " << joint);
  return found;
}

}  // namespace

void ElevatorPlugin::Load(physics::ModelPtr model, sdf::ElementPtr sdf) {
  lift_ = joint_of(model, sdf, "lift_joint");
  door_ = joint_of(model, sdf, "door_joint");
  floor_height_ = sdf->Get<double>("floor_height", floor_height_).first;
  wait_s_ = sdf->Get<double>("door_wait_time", wait_s_).first;
  lift_pid_.Init(100000.0, 0.0, 100000.0);
  door_pid_.Init(2.0, 0.0, 0.0);
  node_ = transport::NodePtr(new transport::Node());
  node_->Init(model->GetWorld()->Name());
  commands_ = node_->Subscribe(sdf->Get<std::string>("topic", "~/elevator").first, &ElevatorPlugin::OnElevator, this);
  last_ = model->GetWorld()->SimTime();
  connection_ = event::Events::ConnectWorldUpdateBegin([this](const common::UpdateInfo& info) { Update(info); });
}

void ElevatorPlugin::MoveToFloor(const int floor) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (phase_ != RESTING) {
    gzwarn << "the elevator is moving; floor " << floor << " is not gone to\n";
    return;
  }
  floor_ = floor;
  is_open_ = false;
  phase_ = SHUTTING;
}

void ElevatorPlugin::OnElevator(const boost::shared_ptr<const msgs::GzString>& message) {
  char* end = nullptr;
  const long floor = std::strtol(message->data().c_str(), &end, 10);
  if (end == message->data().c_str()) gzerr << "an elevator's floor is a number, not '" << message->data() << "'\n";
  else MoveToFloor(static_cast<int>(floor));
}

void ElevatorPlugin::Update(const common::UpdateInfo& info) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const common::Time dt = info.simTime - last_;
  last_ = info.simTime;
  const double door_error = door_->Position(0) - (is_open_ ? 1.0 : 0.0);
  const double lift_error = lift_->Position(0) - floor_ * floor_height_;
  if (phase_ != RESTING && !(dt < common::Time(0.0))) {
    const bool has_reached_door = std::abs(door_error) < kDoorReached;
    if ((phase_ == SHUTTING || phase_ == SHUTTING_AGAIN) && has_reached_door) {
      phase_ = phase_ == SHUTTING ? LIFTING : RESTING;
    } else if (phase_ == LIFTING && std::abs(lift_error) < kFloorReached) {
      phase_ = OPENING;
      is_open_ = true;
    } else if (phase_ == OPENING && has_reached_door) {
      phase_ = WAITING;
      since_ = info.simTime;
    } else if (phase_ == WAITING && (info.simTime - since_).Double() >= wait_s_) {
      phase_ = SHUTTING_AGAIN;
      is_open_ = false;
    }
  }
  door_->SetForce(0, door_pid_.Update(door_error, dt));
  lift_->SetForce(0, lift_pid_.Update(lift_error, dt));
}

}  // namespace gazebo
