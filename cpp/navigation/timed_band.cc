#include "timed_band.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

namespace trundle::navigation {

namespace {

constexpr double kShortest = 1e-3;     // [s]
constexpr std::size_t kSearched = 10;  // poses in which the robot's place is searched
constexpr int kPasses = 100;

BandPose middle(const BandPose& a, const BandPose& b) {
  return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), a[2] + 0.5 * angle_between(a[2], b[2])};
}

auto place(std::size_t i) { return static_cast<std::ptrdiff_t>(i); }

}  // namespace

double angle_between(double from, double to) { return std::remainder(to - from, 2.0 * std::numbers::pi); }

void TimedBand::set(std::vector<BandPose> path, const BandSettings& settings) {
  poses = std::move(path);
  steps.clear();
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    const BandPose &a = poses[i], &b = poses[i + 1];
    const double drive = std::hypot(b[0] - a[0], b[1] - a[1]) / std::max(settings.max_vel_x, 1e-3);
    const double turn = std::abs(angle_between(a[2], b[2])) / std::max(settings.max_vel_theta, 1e-3);
    steps.push_back(std::max({drive, turn, kShortest}));
  }
  while (static_cast<int>(poses.size()) < settings.min_samples) {
    const auto longest = std::max_element(steps.begin(), steps.end());
    const std::size_t i = static_cast<std::size_t>(longest - steps.begin());
    poses.insert(poses.begin() + place(i + 1), middle(poses[i], poses[i + 1]));
    steps[i] *= 0.5;
    steps.insert(steps.begin() + place(i), steps[i]);
  }
}

void TimedBand::move_ends(const BandPose& start, const BandPose& goal) {
  const auto distance = [&](std::size_t i) { return std::hypot(poses[i][0] - start[0], poses[i][1] - start[1]); };
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < std::min(kSearched, poses.size() - 2); ++i)
    if (distance(i) < distance(nearest)) nearest = i;
  poses.erase(poses.begin(), poses.begin() + place(nearest));
  steps.erase(steps.begin(), steps.begin() + place(nearest));
  poses.front() = start;
  poses.back() = goal;
}

void TimedBand::resize(const BandSettings& settings) {
  const auto count = [&] { return static_cast<int>(poses.size()); };
  for (int pass = 0; pass < kPasses; ++pass) {
    bool is_changed = false;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      if (steps[i] > settings.dt_ref + settings.dt_hysteresis && count() < settings.max_samples) {
        poses.insert(poses.begin() + place(i + 1), middle(poses[i], poses[i + 1]));
        steps[i] *= 0.5;
        steps.insert(steps.begin() + place(i), steps[i]);
        ++i;
        is_changed = true;
      } else if (steps[i] < settings.dt_ref - settings.dt_hysteresis && count() > settings.min_samples) {
        if (i + 1 < steps.size()) {
          steps[i + 1] += steps[i];
          poses.erase(poses.begin() + place(i + 1));
        } else {
          steps[i - 1] += steps[i];
          poses.erase(poses.begin() + place(i));
        }
        steps.erase(steps.begin() + place(i));
        is_changed = true;
      }
    }
    if (!is_changed) return;
  }
}

}  // namespace trundle::navigation
