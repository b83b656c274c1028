#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <tf2_msgs/TFMessage.h>
#include <boost/thread.hpp>

#include "tf2_ros/buffer.h"

namespace tf2_ros {

/** Fills a buffer from /tf and /tf_static; by default in a thread of its own. */
class TransformListener {
 public:
  explicit TransformListener(tf2::BufferCore& buffer, bool spin_thread = true,
                             ros::TransportHints hints = ros::TransportHints());
  TransformListener(tf2::BufferCore& buffer, const ros::NodeHandle& node, bool spin_thread = true,
                    ros::TransportHints hints = ros::TransportHints());
  ~TransformListener();

 private:
  void subscribe(bool spin_thread, const ros::TransportHints& hints);
  void receive(const ros::MessageEvent<tf2_msgs::TFMessage const>& event, bool is_static);

  tf2::BufferCore& buffer_;
  ros::NodeHandle node_;
  ros::CallbackQueue queue_;
  boost::shared_ptr<ros::AsyncSpinner> spinner_;
  ros::Subscriber moving_, fixed_;
  ros::Time last_;
};

}  // namespace tf2_ros
