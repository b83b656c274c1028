#include "rosbag/bag_player.h"

#include <vector>

namespace rosbag {

BagPlayer::BagPlayer(const std::string& filename) {
  bag.open(filename, bagmode::Read);
  View all(bag);
  if (all.size() == 0) return;
  start_ = last_ = all.getBeginTime();
  end_ = all.getEndTime();
}

void BagPlayer::set_playback_speed(double scale) {
  if (scale > 0.0) speed_ = scale;
}

void BagPlayer::start_play() {
  std::vector<std::string> topics;
  for (const auto& entry : callbacks_) topics.push_back(entry.first);
  View view(bag, TopicQuery(topics), start_, end_);
  const ros::WallTime begin = ros::WallTime::now();
  for (const MessageInstance& message : view) {
    const auto callback = callbacks_.find(message.getTopic());
    if (callback == callbacks_.end()) continue;  // a callback has ended it
    const double since = (message.getTime() - start_).toSec() / speed_;
    if (since > 0.0) ros::WallTime::sleepUntil(begin + ros::WallDuration(since));
    last_ = message.getTime();
    const boost::shared_ptr<BagCallback> kept = callback->second;
    kept->call(message);
  }
}

}  // namespace rosbag
