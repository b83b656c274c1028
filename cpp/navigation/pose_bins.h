// Bins of poses, 0.5 m by 0.5 m by 10 degrees as in amcl: KLD sampling counts them, and adjacent bins form a cluster.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "planar_pose.h"

namespace trundle::navigation {

class PoseBins {
 public:
  // Adds a pose, and returns the number of its bin, in the order of their first poses.
  int add(const PlanarPose& pose);
  int count() const { return static_cast<int>(keys_.size()); }
  // The number of each bin's cluster, in the order of their first bins.
  std::vector<int> clusters() const;

 private:
  struct Key {
    std::int64_t x, y;
    int yaw;
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Key& key) const;
  };
  static Key key_of(const PlanarPose& pose);

  std::vector<Key> keys_;
  std::unordered_map<Key, int, Hash> numbers_;
};

}  // namespace trundle::navigation
