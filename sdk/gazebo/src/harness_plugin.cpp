#include <gazebo/plugins/HarnessPlugin.hh>

#include <algorithm>
#include <cmath>

namespace gazebo {

namespace {

constexpr double kStill = 1e-6;  // [m/s]

void read_pid(const sdf::ElementPtr& sdf, common::PID& pid) {
  const auto number = [&sdf](const char* name) { return sdf ? sdf->Get<double>(name, 0.0).first : 0.0; };
  pid.Init(number("p"), number("i"), number("d"), number("i_max"), number("i_min"), number("cmd_max"),
           number("cmd_min"));
}

}  // namespace

void HarnessPlugin::Load(physics::ModelPtr model, sdf::ElementPtr sdf) {
  for (sdf::ElementPtr e = sdf->FindElement("joint"); e; e = e->GetNextElement("joint")) Attach(model, e);
  if (joints_.empty()) gzthrow("a harness needs a <joint>");
  const sdf::ElementPtr winch = sdf->FindElement("winch");
  winch_ = Find(winch ? winch->Get<std::string>("joint") : std::string());
  detached_ = Find(sdf->Get<std::string>("detach"));
  read_pid(winch ? winch->FindElement("pos_pid") : winch, position_pid_);
  read_pid(winch ? winch->FindElement("vel_pid") : winch, velocity_pid_);
  last_ = model->GetWorld()->SimTime();
  connection_ = event::Events::ConnectWorldUpdateBegin([this](const common::UpdateInfo& info) { Update(info); });
}

void HarnessPlugin::Attach(const physics::ModelPtr& model, const sdf::ElementPtr& sdf) {
  const std::string name = sdf->Get<std::string>("name"), parent = sdf->Get<std::string>("parent");
  const physics::LinkPtr child = model->GetLink(sdf->Get<std::string>("child"));
  const physics::LinkPtr base = parent == "world" ? physics::LinkPtr() : model->GetLink(parent);
  if (!child || (!base && parent != "world"))
    gzthrow("<joint> " << name << ": its parent and child are links of " << model->GetName()
                       << "; the parent may be the world");
  const physics::JointPtr joint = model->CreateJoint(name, sdf->Get<std::string>("type"), base, child);
  if (!joint) gzthrow("<joint> " << name << ": the model has one of this name");
  joint->Load(base, child,
              sdf->HasElement("pose") ? sdf->Get<ignition::math::Pose3d>("pose") : ignition::math::Pose3d());
  if (const sdf::ElementPtr axis = sdf->FindElement("axis")) {
    joint->SetAxis(0, axis->Get<ignition::math::Vector3d>("xyz", ignition::math::Vector3d::UnitZ).first);
    if (const sdf::ElementPtr limit = axis->FindElement("limit")) {
      joint->SetLowerLimit(0, limit->Get<double>("lower", -1e16).first);
      joint->SetUpperLimit(0, limit->Get<double>("upper", 1e16).first);
    }
  }
  joint->Init();
  joints_.push_back(joint);
}

physics::JointPtr HarnessPlugin::Find(const std::string& name) const {
  for (const physics::JointPtr& joint : joints_)
    if (joint->GetName() == name) return joint;
  gzwarn << "harness: it has no joint '" << name << "'; the first one is used\n";
  return joints_.front();
}

double HarnessPlugin::WinchVelocity() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return winch_ ? winch_->GetVelocity(0) : 0.0;
}

void HarnessPlugin::SetWinchVelocity(const float velocity) {
  const std::lock_guard<std::mutex> lock(mutex_);
  velocity_ = velocity;
  if (std::abs(velocity_) >= kStill || !winch_) return;
  position_ = winch_->Position(0);
  position_pid_.Reset();
}

void HarnessPlugin::Detach() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!detached_) return;
  detached_->Detach();
  detached_.reset();
  winch_.reset();
}

// The velocity's effort pulls up alone, as in the original.
void HarnessPlugin::Update(const common::UpdateInfo& info) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const common::Time dt = info.simTime - last_;
  last_ = info.simTime;
  if (!winch_) return;
  const double pull = std::max(velocity_pid_.Update(winch_->GetVelocity(0) - velocity_, dt), 0.0);
  const double error = std::abs(velocity_) < kStill ? winch_->Position(0) - position_ : 0.0;
  winch_->SetForce(0, pull + position_pid_.Update(error, dt));
}

}  // namespace gazebo
