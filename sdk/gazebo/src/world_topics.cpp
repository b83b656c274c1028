#include "world_topics.h"

#include <atomic>

#include <boost/make_shared.hpp>

#include <gazebo/common/Console.hh>
#include <gazebo/physics/physics.hh>

namespace gazebo {

namespace msgs {

Request* CreateRequest(const std::string& request, const std::string& data) {
  static std::atomic<int32_t> last{0};
  Request* const made = new Request;
  made->set_id(++last);
  made->set_request(request);
  made->set_data(data);
  return made;
}

}  // namespace msgs

namespace physics {

namespace {

constexpr double kStatisticsPeriod = 0.2, kPosesPeriod = 1.0 / 60.0;  // of simulated time [s]

// True if it is due, which it is next after its period.
bool is_due(common::Time& due, const common::Time& time, double period) {
  if (time < due && due - time <= common::Time(period)) return false;
  due = time + common::Time(period);
  return true;
}

}  // namespace

WorldTopics::WorldTopics(World& world) : world_(world), node_(boost::make_shared<transport::Node>()) {
  node_->Init(world.Name());
  subscribers_.push_back(node_->Subscribe("~/factory", &WorldTopics::OnFactory, this));
  subscribers_.push_back(node_->Subscribe("~/physics", &WorldTopics::OnPhysics, this));
  subscribers_.push_back(node_->Subscribe("~/world_control", &WorldTopics::OnControl, this));
  subscribers_.push_back(node_->Subscribe("~/request", &WorldTopics::OnRequest, this));
  subscribers_.push_back(node_->Subscribe("~/visual", &WorldTopics::OnVisual, this));
  statistics_ = node_->Advertise<msgs::WorldStatistics>("~/world_stats");
  poses_ = node_->Advertise<msgs::PosesStamped>("~/pose/info");
}

void WorldTopics::OnFactory(ConstFactoryPtr& message) {
  std::vector<double> pose;
  if (message->has_pose()) {
    const ignition::math::Pose3d p = msgs::ConvertIgn(message->pose());
    pose = {p.Pos().X(), p.Pos().Y(), p.Pos().Z(), p.Rot().W(), p.Rot().X(), p.Rot().Y(), p.Rot().Z()};
  }
  if (!message->sdf().empty()) world_.Request({"insert", message->sdf()}, pose);
  else if (!message->sdf_filename().empty()) world_.Request({"insert_file", message->sdf_filename()}, pose);
  else if (!message->clone_model_name().empty()) world_.Request({"clone", message->clone_model_name()}, pose);
}

void WorldTopics::OnPhysics(ConstPhysicsPtr& message) {
  if (message->has_gravity()) world_.SetGravity(msgs::ConvertIgn(message->gravity()));
  if (message->has_max_step_size()) world_.Request({"step_size"}, {message->max_step_size()});
}

void WorldTopics::OnControl(ConstWorldControlPtr& message) {
  if (message->has_pause() || message->has_step() || message->has_multi_step())
    gzwarn << "~/world_control resets, and neither pauses nor steps\n";
  if (!message->has_reset()) return;
  const msgs::WorldReset& reset = message->reset();
  world_.Request({reset.all() ? "reset" : reset.time_only() ? "reset_time" : "reset_poses"});
}

void WorldTopics::OnRequest(ConstRequestPtr& message) {
  if (message->request() == "entity_delete") world_.RemoveModel(message->data());
}

void WorldTopics::OnVisual(ConstVisualPtr&) {
  if (!warned_of_visuals_)
    gzwarn << "nothing draws the messages on ~/visual; markers of rviz show what a plugin draws\n";
  warned_of_visuals_ = true;
}

void WorldTopics::Update(const common::Time& time) {
  if (statistics_->HasConnections() && is_due(statistics_due_, time, kStatisticsPeriod)) PublishStatistics(time);
  if (poses_->HasConnections() && is_due(poses_due_, time, kPosesPeriod)) PublishPoses(time);
}

void WorldTopics::PublishStatistics(const common::Time& time) {
  msgs::WorldStatistics message;
  msgs::Set(message.mutable_sim_time(), time);
  msgs::Set(message.mutable_real_time(), world_.RealTime());
  msgs::Set(message.mutable_pause_time(), world_.PauseTime());
  message.set_paused(false);
  message.set_iterations(world_.Iterations());
  message.set_model_count(static_cast<int32_t>(world_.ModelCount()));
  statistics_->Publish(message);
}

void WorldTopics::PublishPoses(const common::Time& time) {
  msgs::PosesStamped message;
  msgs::Set(message.mutable_time(), time);
  const auto add = [&message](const EntityPtr& entity, const ignition::math::Pose3d& pose) {
    msgs::Pose* const added = message.add_pose();
    added->set_name(entity->GetScopedName());
    added->set_id(entity->GetId());
    msgs::Set(added, pose);
  };
  for (const ModelPtr& model : world_.Models()) {
    add(model, model->WorldPose());
    for (const LinkPtr& link : model->GetLinks()) add(link, link->RelativePose());
  }
  poses_->Publish(message);
}

}  // namespace physics
}  // namespace gazebo
