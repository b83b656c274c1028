#include <boost/make_shared.hpp>

#include <gazebo/common/Console.hh>
#include <gazebo/common/Events.hh>
#include <gazebo/physics/ContactManager.hh>
#include <gazebo/physics/physics.hh>

#include "kit.h"

namespace gazebo {
namespace physics {

PhysicsEngine::PhysicsEngine(World* world)
    : world_(world), update_rate_(1000.0), real_time_factor_(1.0), contacts_(new ContactManager(world)) {}

PhysicsEngine::~PhysicsEngine() { delete contacts_; }

double PhysicsEngine::GetMaxStepSize() const {
  const TrundleGazeboHost* host = world_->Host();
  return static_cast<double>(host->step_ns(host->self)) * 1e-9;
}

void PhysicsEngine::SetMaxStepSize(double step_s) { world_->Request({"step_size"}, {step_s}); }

math::Vector3 PhysicsEngine::GetGravity() const { return world_->Gravity(); }
void PhysicsEngine::SetGravity(const ignition::math::Vector3d& gravity) { world_->SetGravity(gravity); }

bool PhysicsEngine::SetParam(const std::string& key, const boost::any& value) {
  using ignition::math::Vector3d;
  if (key == "max_step_size") {
    if (const double* step_s = boost::any_cast<double>(&value)) return SetMaxStepSize(*step_s), true;
    gzerr << "max_step_size is a double\n";
  } else if (key == "gravity") {
    if (const Vector3d* gravity = boost::any_cast<Vector3d>(&value)) return SetGravity(*gravity), true;
    if (const math::Vector3* gravity = boost::any_cast<math::Vector3>(&value)) return SetGravity(gravity->Ign()), true;
    gzerr << "gravity is a vector\n";
  } else if (key == "real_time_factor" || key == "real_time_update_rate") {
    const double* number = boost::any_cast<double>(&value);
    if (number && *number == boost::any_cast<double>(GetParam(key))) return true;
    gzwarn << key << " is not set: the page and --speed set the pace\n";
  } else {
    gzwarn << key << " of the physics is not set: plugins set max_step_size and gravity; the engine is not Gazebo's\n";
  }
  return false;
}

bool PhysicsEngine::GetParam(const std::string& key, boost::any& value) const {
  if (key == "type") value = GetType();
  else if (key == "max_step_size") value = GetMaxStepSize();
  else if (key == "real_time_factor") value = GetTargetRealTimeFactor();
  else if (key == "real_time_update_rate") value = GetRealTimeUpdateRate();
  else if (key == "gravity") value = world_->Gravity();
  else return gzwarn << "the physics have no " << key << "; the engine is not Gazebo's\n", false;
  return true;
}

boost::any PhysicsEngine::GetParam(const std::string& key) const {
  boost::any value;
  GetParam(key, value);
  return value;
}

JointPtr PhysicsEngine::CreateJoint(const std::string& type, ModelPtr model) {
  const JointPtr joint = boost::make_shared<Joint>(model);
  joint->is_made_ = true;
  joint->type_name_ = type;
  joint->model_ = model;
  joint->world_ = world_->shared_from_this();
  world_->made_joints_.push_back(joint);
  return joint;
}

World::World(const std::string& name)
    : name_(name),
      host_(nullptr),
      physics_(boost::make_shared<PhysicsEngine>(this)),
      sent_surfaces_(-1, 0),
      last_time_ns_(0),
      iterations_(0),
      is_paused_(false),
      physics_enabled_(true) {
  start_time_ = common::Time::GetWallTime();
  update_info_.worldName = name;
}

World::~World() {}

common::Time World::SimTime() const { return common::Time::FromNanoseconds(host_->time_ns(host_->self)); }

ignition::math::Vector3d World::Gravity() const {
  double v[3] = {0.0, 0.0, 0.0};
  host_->read(host_->self, TRUNDLE_GRAVITY, 0, 0, v, 3);
  return ignition::math::Vector3d(v[0], v[1], v[2]);
}

void World::SetGravity(const ignition::math::Vector3d& g) { Request({"gravity"}, {g.X(), g.Y(), g.Z()}); }
void World::SetPhysicsEnabled(bool is_enabled) {
  const double value = is_enabled ? 1.0 : 0.0;
  if (host_->write(host_->self, TRUNDLE_SET_PHYSICS, 0, 0, &value, 1)) physics_enabled_ = is_enabled;
}

void World::Reset() { Request({"reset"}); }
void World::ResetTime() { Request({"reset_time"}); }
void World::ResetEntities(Base::EntityType) { Request({"reset_poses"}); }
void World::InsertModelFile(const std::string& filename) { Request({"insert_file", filename}); }
void World::InsertModelString(const std::string& sdf) { Request({"insert", sdf}); }
void World::InsertModelSDF(const sdf::SDF& sdf) { Request({"insert", sdf.ToString()}); }
void World::RemoveModel(const std::string& name) { Request({"delete", name}); }

ModelPtr World::ModelByName(const std::string& name) const {
  for (const ModelPtr& model : models_)
    if (model->GetName() == name) return model;
  return ModelPtr();
}

BasePtr World::BaseByName(const std::string& name) const {
  for (const ModelPtr& model : models_)
    if (const BasePtr found = model->GetByName(name)) return found;
  return BasePtr();
}

EntityPtr World::EntityByName(const std::string& name) const {
  return boost::dynamic_pointer_cast<Entity>(BaseByName(name));
}

void World::Request(const std::vector<std::string>& words, const std::vector<double>& numbers) const {
  std::vector<const char*> texts;
  for (const std::string& word : words) texts.push_back(word.c_str());
  host_->request(host_->self, texts.data(), static_cast<int>(texts.size()), numbers.data(),
                 static_cast<int>(numbers.size()));
}

void World::Animate() {
  const common::Time time = update_info_.simTime;
  const Entity_V animated = animated_;  // a function that is called at an end may start another
  for (const EntityPtr& entity : animated) entity->Animate(time);
}

void World::SendSurfaces() {
  constexpr double kPeriod = 0.1;  // [s]
  const common::Time time = update_info_.simTime;
  if (surfaces_.empty() || (time >= sent_surfaces_ && (time - sent_surfaces_).Double() < kPeriod)) return;
  std::vector<std::string> words = {"surfaces"};
  std::vector<double> numbers;
  for (const auto& weak : surfaces_)
    if (const auto collision = weak.lock()) collision->TakeChange(words, numbers);
  if (numbers.empty()) return;
  sent_surfaces_ = time;
  Request(words, numbers);
}

void World::BeforeStep(int64_t time_ns, int64_t real_ns) {
  if (is_paused_) gzwarn << "a plugin does not pause the simulation; the page and /gazebo/pause_physics do\n";
  is_paused_ = false;
  real_time_ = common::Time::FromNanoseconds(real_ns);
  if (time_ns < last_time_ns_) event::Events::timeReset.SignalIn(this);
  last_time_ns_ = time_ns;
  update_info_.simTime = common::Time::FromNanoseconds(time_ns);
  update_info_.realTime = real_time_;
  event::Events::worldUpdateBegin.SignalIn(this, update_info_);
  Animate();
  const double step_s = physics_->GetMaxStepSize();
  for (const ModelPtr& model : models_)
    if (const JointControllerPtr& controller = model->controller_) {
      controller->step_s_ = step_s;
      controller->Update();
    }
  event::Events::beforePhysicsUpdate.SignalIn(this, update_info_);
  event::Events::preRender.SignalIn(this);
  for (const LinkPtr& link : weight_changes_) link->ChangeWeight();
  SendSurfaces();
  ConnectJoints();
}

void World::ConnectJoints() {
  for (const JointPtr& joint : made_joints_) joint->Connect();
}

void World::AfterStep(int64_t time_ns, int64_t real_ns) {
  ++iterations_;
  real_time_ = common::Time::FromNanoseconds(real_ns);
  const double step_s = physics_->GetMaxStepSize();
  for (const ModelPtr& model : models_) {
    for (const LinkPtr& link : model->links_) link->EndStep(step_s);
    for (const JointPtr& joint : model->joints_) joint->EndStep();
  }
  physics_->GetContactManager()->Update(common::Time::FromNanoseconds(time_ns));
  event::Events::worldUpdateEnd.SignalIn(this);
}

}  // namespace physics
}  // namespace gazebo
