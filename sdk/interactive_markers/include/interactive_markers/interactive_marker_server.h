#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <visualization_msgs/InteractiveMarker.h>
#include <visualization_msgs/InteractiveMarkerFeedback.h>
#include <visualization_msgs/InteractiveMarkerInit.h>
#include <visualization_msgs/InteractiveMarkerUpdate.h>

#include <map>
#include <mutex>
#include <set>
#include <string>

namespace interactive_markers {

/** Offers interactive markers to rviz; changes are collected until applyChanges(). */
class InteractiveMarkerServer {
 public:
  typedef visualization_msgs::InteractiveMarkerFeedbackConstPtr FeedbackConstPtr;
  typedef boost::function<void(const FeedbackConstPtr&)> FeedbackCallback;
  static const uint8_t DEFAULT_FEEDBACK_CB = 255;

  /** With `spin_thread`, callbacks run in a thread of the server, else where the node spins. */
  InteractiveMarkerServer(const std::string& topic_ns, const std::string& server_id = "", bool spin_thread = false);
  ~InteractiveMarkerServer();
  InteractiveMarkerServer(const InteractiveMarkerServer&) = delete;
  InteractiveMarkerServer& operator=(const InteractiveMarkerServer&) = delete;

  /** Add a marker, or replace the one of its name, which keeps its callbacks. */
  void insert(const visualization_msgs::InteractiveMarker& int_marker);
  /** As above, with a callback for one type of events, or for all that have none of their own. */
  void insert(const visualization_msgs::InteractiveMarker& int_marker, FeedbackCallback feedback_cb,
              uint8_t feedback_type = DEFAULT_FEEDBACK_CB);
  /** Move a marker; false if there is none. A header without frame leaves the marker's. */
  bool setPose(const std::string& name, const geometry_msgs::Pose& pose,
               const std_msgs::Header& header = std_msgs::Header());
  bool erase(const std::string& name);
  void clear();
  bool empty() const { return size() == 0; }
  std::size_t size() const;
  /** Set the callback for one type of events; an empty one removes it. False if there is no such marker. */
  bool setCallback(const std::string& name, FeedbackCallback feedback_cb, uint8_t feedback_type = DEFAULT_FEEDBACK_CB);
  /** Send what was changed to all clients. */
  void applyChanges();
  /** Marker with the changes to come; false if there is none. */
  bool get(std::string name, visualization_msgs::InteractiveMarker& int_marker) const;

 private:
  struct Marker {
    visualization_msgs::InteractiveMarker message;
    std::map<uint8_t, FeedbackCallback> callbacks;
    std::string last_client;
    ros::WallTime last_feedback;
  };
  void onFeedback(const FeedbackConstPtr& feedback);
  void keepAlive();

  mutable std::recursive_mutex mutex_;
  ros::NodeHandle node_;
  ros::CallbackQueue queue_;
  std::string server_id_;
  uint64_t seq_num_ = 0;
  std::map<std::string, Marker> markers_;
  std::set<std::string> changed_, moved_, erased_;
  ros::Publisher init_, update_;
  ros::Subscriber feedback_;
  ros::Timer timer_;
  boost::shared_ptr<ros::AsyncSpinner> spinner_;
};

}  // namespace interactive_markers
