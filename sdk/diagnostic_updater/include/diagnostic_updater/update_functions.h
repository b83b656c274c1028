#pragma once

#include <algorithm>
#include <deque>
#include <limits>

#include "diagnostic_updater/diagnostic_updater.h"

namespace diagnostic_updater {

/** Bounds of a frequency [Hz], read when the check runs. */
struct FrequencyStatusParam {
  FrequencyStatusParam(double* min_freq, double* max_freq, double tolerance = 0.1, int window_size = 5)
      : min_freq_(min_freq), max_freq_(max_freq), tolerance_(tolerance), window_size_(window_size) {}
  double *min_freq_, *max_freq_;
  /** Part of the bounds by which they may be missed. */
  double tolerance_;
  /** Runs of the check over which the frequency is measured. */
  int window_size_;
};

/** Check of how often tick() is called. */
class FrequencyStatus : public DiagnosticTask {
 public:
  FrequencyStatus(const FrequencyStatusParam& params, std::string name) : DiagnosticTask(name), params_(params) {
    clear();
  }
  explicit FrequencyStatus(const FrequencyStatusParam& params) : FrequencyStatus(params, "Frequency Status") {}

  void clear() {
    const std::lock_guard<std::mutex> lock(mutex_);
    count_ = 0;
    window_.assign(static_cast<size_t>(std::max(params_.window_size_, 1)), std::make_pair(ros::Time::now(), 0));
  }
  void tick() {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++count_;
  }
  void run(DiagnosticStatusWrapper& stat) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    const ros::Time now = ros::Time::now();
    const int events = count_ - window_.front().second;
    const double span = (now - window_.front().first).toSec(), frequency = events / span;
    window_.pop_front();
    window_.emplace_back(now, count_);
    const double low = *params_.min_freq_, high = *params_.max_freq_;
    if (events == 0) stat.summary(2, "No events recorded.");
    else if (frequency < low * (1.0 - params_.tolerance_)) stat.summary(1, "Frequency too low.");
    else if (frequency > high * (1.0 + params_.tolerance_)) stat.summary(1, "Frequency too high.");
    else stat.summary(0, "Desired frequency met");
    stat.addf("Events in window", "%d", events);
    stat.addf("Events since startup", "%d", count_);
    stat.addf("Duration of window (s)", "%f", span);
    stat.addf("Actual frequency (Hz)", "%f", frequency);
    if (low == high) stat.addf("Target frequency (Hz)", "%f", low);
    if (low > 0.0) stat.addf("Minimum acceptable frequency (Hz)", "%f", low * (1.0 - params_.tolerance_));
    if (high < std::numeric_limits<double>::infinity())
      stat.addf("Maximum acceptable frequency (Hz)", "%f", high * (1.0 + params_.tolerance_));
  }

 private:
  const FrequencyStatusParam params_;
  std::mutex mutex_;
  int count_ = 0;
  std::deque<std::pair<ros::Time, int> > window_;
};

/** Bounds of the time from a stamp to its arrival [s]. */
struct TimeStampStatusParam {
  TimeStampStatusParam(const double min_acceptable = -1.0, const double max_acceptable = 5.0)
      : max_acceptable_(max_acceptable), min_acceptable_(min_acceptable) {}
  double max_acceptable_, min_acceptable_;
};

/** Check of stamps against the clock. */
class TimeStampStatus : public DiagnosticTask {
 public:
  TimeStampStatus(const TimeStampStatusParam& params, std::string name) : DiagnosticTask(name), params_(params) {}
  explicit TimeStampStatus(const TimeStampStatusParam& params) : TimeStampStatus(params, "Timestamp Status") {}
  TimeStampStatus() : TimeStampStatus(TimeStampStatusParam()) {}

  void tick(double stamp) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (stamp == 0.0) {
      has_zero_ = true;
      return;
    }
    const double delay = ros::Time::now().toSec() - stamp;
    least_ = has_stamps_ ? std::min(least_, delay) : delay;
    most_ = has_stamps_ ? std::max(most_, delay) : delay;
    has_stamps_ = true;
  }
  void tick(const ros::Time t) { tick(t.toSec()); }
  void run(DiagnosticStatusWrapper& stat) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    stat.summary(0, "Timestamps are reasonable.");
    if (!has_stamps_) stat.summary(1, "No data since last update.");
    if (has_stamps_ && least_ < params_.min_acceptable_) stat.summary(2, "Timestamps too far in future seen.");
    if (has_stamps_ && most_ > params_.max_acceptable_) stat.summary(2, "Timestamps too far in past seen.");
    if (has_zero_) stat.summary(2, "Zero timestamp seen.");
    stat.addf("Earliest timestamp delay:", "%f", least_);
    stat.addf("Latest timestamp delay:", "%f", most_);
    stat.addf("Earliest acceptable timestamp delay:", "%f", params_.min_acceptable_);
    stat.addf("Latest acceptable timestamp delay:", "%f", params_.max_acceptable_);
    has_stamps_ = has_zero_ = false;
    least_ = most_ = 0.0;
  }

 private:
  const TimeStampStatusParam params_;
  std::mutex mutex_;
  bool has_stamps_ = false, has_zero_ = false;
  double least_ = 0.0, most_ = 0.0;
};

/** Check that is always well: the node lives. */
class Heartbeat : public DiagnosticTask {
 public:
  Heartbeat() : DiagnosticTask("Heartbeat") {}
  void run(DiagnosticStatusWrapper& stat) override { stat.summary(0, "Alive"); }
};

}  // namespace diagnostic_updater
