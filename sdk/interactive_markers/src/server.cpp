#include "interactive_markers/interactive_marker_server.h"

namespace interactive_markers {
namespace {

using visualization_msgs::InteractiveMarkerUpdate;

constexpr double kKeepAlive = 0.5;     // [s]
constexpr double kHeldByClient = 0.5;  // [s] for which others' feedback is ignored

}  // namespace

InteractiveMarkerServer::InteractiveMarkerServer(const std::string& topic_ns, const std::string& server_id,
                                                 bool spin_thread)
    : node_(topic_ns), server_id_(ros::this_node::getName() + (server_id.empty() ? "" : "/" + server_id)) {
  if (spin_thread) node_.setCallbackQueue(&queue_);
  update_ = node_.advertise<InteractiveMarkerUpdate>("update", 100);
  init_ = node_.advertise<visualization_msgs::InteractiveMarkerInit>("update_full", 100, true);
  feedback_ = node_.subscribe("feedback", 100, &InteractiveMarkerServer::onFeedback, this);
  timer_ = node_.createTimer(ros::Duration(kKeepAlive), [this](const ros::TimerEvent&) { keepAlive(); });
  if (spin_thread) {
    spinner_.reset(new ros::AsyncSpinner(1, &queue_));
    spinner_->start();
  }
  applyChanges();
}

InteractiveMarkerServer::~InteractiveMarkerServer() {
  if (spinner_) spinner_->stop();
  timer_.stop();
  feedback_.shutdown();
  if (!node_.ok()) return;
  clear();
  applyChanges();
}

void InteractiveMarkerServer::insert(const visualization_msgs::InteractiveMarker& int_marker) {
  const std::lock_guard<std::recursive_mutex> lock(mutex_);
  markers_[int_marker.name].message = int_marker;
  changed_.insert(int_marker.name);
  moved_.erase(int_marker.name);
  erased_.erase(int_marker.name);
}

void InteractiveMarkerServer::insert(const visualization_msgs::InteractiveMarker& int_marker,
                                     FeedbackCallback feedback_cb, uint8_t feedback_type) {
  insert(int_marker);
  setCallback(int_marker.name, feedback_cb, feedback_type);
}

bool InteractiveMarkerServer::setPose(const std::string& name, const geometry_msgs::Pose& pose,
                                      const std_msgs::Header& header) {
  const std::lock_guard<std::recursive_mutex> lock(mutex_);
  const auto found = markers_.find(name);
  if (found == markers_.end()) return false;
  found->second.message.pose = pose;
  if (!header.frame_id.empty()) found->second.message.header = header;
  if (!changed_.count(name)) moved_.insert(name);
  return true;
}

bool InteractiveMarkerServer::erase(const std::string& name) {
  const std::lock_guard<std::recursive_mutex> lock(mutex_);
  if (!markers_.erase(name)) return false;
  changed_.erase(name);
  moved_.erase(name);
  erased_.insert(name);
  return true;
}

void InteractiveMarkerServer::clear() {
  const std::lock_guard<std::recursive_mutex> lock(mutex_);
  while (!markers_.empty()) erase(std::string(markers_.begin()->first));
}

std::size_t InteractiveMarkerServer::size() const {
  const std::lock_guard<std::recursive_mutex> lock(mutex_);
  return markers_.size();
}

bool InteractiveMarkerServer::setCallback(const std::string& name, FeedbackCallback feedback_cb,
                                          uint8_t feedback_type) {
  const std::lock_guard<std::recursive_mutex> lock(mutex_);
  const auto found = markers_.find(name);
  if (found == markers_.end()) return false;
  if (feedback_cb) found->second.callbacks[feedback_type] = feedback_cb;
  else found->second.callbacks.erase(feedback_type);
  return true;
}

bool InteractiveMarkerServer::get(std::string name, visualization_msgs::InteractiveMarker& int_marker) const {
  const std::lock_guard<std::recursive_mutex> lock(mutex_);
  const auto found = markers_.find(name);
  if (found == markers_.end()) return false;
  int_marker = found->second.message;
  return true;
}

void InteractiveMarkerServer::applyChanges() {
  const std::lock_guard<std::recursive_mutex> lock(mutex_);
  if (seq_num_ > 0 && changed_.empty() && moved_.empty() && erased_.empty()) return;
  ++seq_num_;
  InteractiveMarkerUpdate update;
  update.type = InteractiveMarkerUpdate::UPDATE;
  update.server_id = server_id_;
  update.seq_num = seq_num_;
  for (const std::string& name : changed_) update.markers.push_back(markers_[name].message);
  for (const std::string& name : moved_) {
    const visualization_msgs::InteractiveMarker& marker = markers_[name].message;
    visualization_msgs::InteractiveMarkerPose pose;
    pose.header = marker.header;
    pose.pose = marker.pose;
    pose.name = name;
    update.poses.push_back(pose);
  }
  update.erases.assign(erased_.begin(), erased_.end());
  changed_.clear();
  moved_.clear();
  erased_.clear();
  update_.publish(update);
  visualization_msgs::InteractiveMarkerInit init;
  init.server_id = server_id_;
  init.seq_num = seq_num_;
  for (const auto& entry : markers_) init.markers.push_back(entry.second.message);
  init_.publish(init);
}

void InteractiveMarkerServer::keepAlive() {
  const std::lock_guard<std::recursive_mutex> lock(mutex_);
  InteractiveMarkerUpdate alive;
  alive.type = InteractiveMarkerUpdate::KEEP_ALIVE;
  alive.server_id = server_id_;
  alive.seq_num = seq_num_;
  update_.publish(alive);
}

void InteractiveMarkerServer::onFeedback(const FeedbackConstPtr& feedback) {
  FeedbackCallback callback;
  {
    const std::lock_guard<std::recursive_mutex> lock(mutex_);
    const auto found = markers_.find(feedback->marker_name);
    if (found == markers_.end()) return;
    Marker& marker = found->second;
    const ros::WallTime now = ros::WallTime::now();
    if (marker.last_client != feedback->client_id && (now - marker.last_feedback).toSec() < kHeldByClient) return;
    marker.last_client = feedback->client_id;
    marker.last_feedback = now;
    if (feedback->event_type == visualization_msgs::InteractiveMarkerFeedback::POSE_UPDATE)
      setPose(marker.message.name, feedback->pose,
              marker.message.header.stamp.isZero() ? std_msgs::Header() : feedback->header);
    const auto own = marker.callbacks.find(feedback->event_type),
               all = marker.callbacks.find(static_cast<uint8_t>(DEFAULT_FEEDBACK_CB));
    if (own != marker.callbacks.end()) callback = own->second;
    else if (all != marker.callbacks.end()) callback = all->second;
  }
  if (callback) callback(feedback);
}

}  // namespace interactive_markers
