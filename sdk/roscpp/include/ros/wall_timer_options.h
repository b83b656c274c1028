#pragma once

#include "ros/common.h"
#include "ros/forwards.h"

namespace ros {

struct WallTimerOptions {
  WallTimerOptions() {}
  WallTimerOptions(WallDuration period_, const WallTimerCallback& callback_, CallbackQueueInterface* queue,
                   bool oneshot_ = false, bool autostart_ = true)
      : period(period_), callback(callback_), callback_queue(queue), oneshot(oneshot_), autostart(autostart_) {}

  WallDuration period = WallDuration(0.1);
  WallTimerCallback callback;
  CallbackQueueInterface* callback_queue = nullptr;
  VoidConstPtr tracked_object;
  bool oneshot = false;
  bool autostart = true;
};

}  // namespace ros
