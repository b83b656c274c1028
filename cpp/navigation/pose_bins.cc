#include "pose_bins.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trundle::navigation {

namespace {

constexpr double kBinSize = 0.5;  // [m]
constexpr int kYawBins = 36;
constexpr double kMaxPosition = 1e9;  // [m]

// Poses that are not finite or farther than any map have a bin, too.
std::int64_t bin_of(double position) {
  return static_cast<std::int64_t>(std::floor(std::min(std::max(-kMaxPosition, position), kMaxPosition) / kBinSize));
}

}  // namespace

std::size_t PoseBins::Hash::operator()(const Key& key) const {
  auto hash = static_cast<std::uint64_t>(key.x) * 0x9e3779b97f4a7c15u;
  hash = (hash ^ static_cast<std::uint64_t>(key.y)) * 0xbf58476d1ce4e5b9u;
  hash = (hash ^ static_cast<std::uint64_t>(key.yaw)) * 0x94d049bb133111ebu;
  return static_cast<std::size_t>(hash ^ (hash >> 31));
}

PoseBins::Key PoseBins::key_of(const PlanarPose& pose) {
  const double turn = std::isfinite(pose.yaw) ? normalized_angle(pose.yaw) / (2.0 * std::numbers::pi) : 0.0;
  const int yaw = static_cast<int>(std::floor(turn * kYawBins));
  return {bin_of(pose.x), bin_of(pose.y), (yaw + kYawBins) % kYawBins};
}

int PoseBins::add(const PlanarPose& pose) {
  const Key key = key_of(pose);
  const auto [place, is_new] = numbers_.try_emplace(key, count());
  if (is_new) keys_.push_back(key);
  return place->second;
}

std::vector<int> PoseBins::clusters() const {
  std::vector<int> clusters(keys_.size(), -1);
  std::vector<std::size_t> pending;
  int cluster = 0;
  for (std::size_t seed = 0; seed < keys_.size(); ++seed) {
    if (clusters[seed] >= 0) continue;
    clusters[seed] = cluster;
    pending.push_back(seed);
    while (!pending.empty()) {
      const Key key = keys_[pending.back()];
      pending.pop_back();
      for (int i = 0; i < 27; ++i) {
        const Key neighbor{key.x + i % 3 - 1, key.y + i / 3 % 3 - 1, (key.yaw + i / 9 - 1 + kYawBins) % kYawBins};
        const auto found = numbers_.find(neighbor);
        if (found == numbers_.end()) continue;
        const auto number = static_cast<std::size_t>(found->second);
        if (clusters[number] >= 0) continue;
        clusters[number] = cluster;
        pending.push_back(number);
      }
    }
    ++cluster;
  }
  return clusters;
}

}  // namespace trundle::navigation
