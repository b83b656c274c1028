#pragma once

#include <ros/time.h>

#include <string>

namespace tf2 {

/** Value with a time and a frame. */
template <typename T>
class Stamped : public T {
 public:
  ros::Time stamp_;
  std::string frame_id_;

  Stamped() : frame_id_("NO_ID_STAMPED_DEFAULT_CONSTRUCTION") {}
  Stamped(const T& input, const ros::Time& timestamp, const std::string& frame_id)
      : T(input), stamp_(timestamp), frame_id_(frame_id) {}
  void setData(const T& input) { *static_cast<T*>(this) = input; }
};
template <typename T>
bool operator==(const Stamped<T>& a, const Stamped<T>& b) {
  return a.frame_id_ == b.frame_id_ && a.stamp_ == b.stamp_ && static_cast<const T&>(a) == static_cast<const T&>(b);
}

}  // namespace tf2
