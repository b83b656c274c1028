#pragma once

#include <tf2_ros/message_filter.h>

#include "tf/transform_listener.h"

namespace tf {

namespace filter_failure_reasons = tf2_ros::filter_failure_reasons;
typedef tf2_ros::FilterFailureReason FilterFailureReason;
typedef tf2_ros::MessageFilterBase MessageFilterBase;

/** Filter that passes messages on once their frame can be transformed to all target frames at their stamp: those that
are ready when they come in that thread, which tf2's never does if it has a queue. */
template <class M>
class MessageFilter : public tf2_ros::MessageFilter<M> {
 public:
  /** `queue_size`: messages that wait; the oldest is dropped. The time between tests is of no use: transforms wake it.
   */
  MessageFilter(Transformer& tf, const std::string& target_frame, uint32_t queue_size,
                ros::NodeHandle nh = ros::NodeHandle(), ros::Duration = ros::Duration(0.01))
      : tf2_ros::MessageFilter<M>(*tf.getTF2BufferPtr(), target_frame, queue_size, nh) {
    this->runAtAdd();
  }
  template <class F>
  MessageFilter(F& f, Transformer& tf, const std::string& target_frame, uint32_t queue_size,
                ros::NodeHandle nh = ros::NodeHandle(), ros::Duration = ros::Duration(0.01))
      : MessageFilter(tf, target_frame, queue_size, nh) {
    this->connectInput(f);
  }
};

}  // namespace tf
