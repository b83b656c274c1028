#pragma once

#include "ros/common.h"
#include "ros/forwards.h"

namespace ros {

struct TimerOptions {
  TimerOptions() {}
  TimerOptions(Duration period_, const TimerCallback& callback_, CallbackQueueInterface* queue, bool oneshot_ = false,
               bool autostart_ = true)
      : period(period_), callback(callback_), callback_queue(queue), oneshot(oneshot_), autostart(autostart_) {}

  Duration period = Duration(0.1);
  TimerCallback callback;
  CallbackQueueInterface* callback_queue = nullptr;
  VoidConstPtr tracked_object;
  bool oneshot = false;
  bool autostart = true;
};

}  // namespace ros
