#pragma once

#include "ros/common.h"
#include "ros/forwards.h"

namespace ros {

struct SteadyTimerOptions {
  SteadyTimerOptions() {}
  SteadyTimerOptions(WallDuration period_, const SteadyTimerCallback& callback_, CallbackQueueInterface* queue,
                     bool oneshot_ = false, bool autostart_ = true)
      : period(period_), callback(callback_), callback_queue(queue), oneshot(oneshot_), autostart(autostart_) {}

  WallDuration period = WallDuration(0.1);
  SteadyTimerCallback callback;
  CallbackQueueInterface* callback_queue = nullptr;
  VoidConstPtr tracked_object;
  bool oneshot = false;
  bool autostart = true;
};

}  // namespace ros
