#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/ros.h>

#include <mutex>
#include <string>
#include <vector>

#include "diagnostic_updater/DiagnosticStatusWrapper.h"

namespace diagnostic_updater {

typedef boost::function<void(DiagnosticStatusWrapper&)> TaskFunction;

/** Check that fills a status. */
class DiagnosticTask {
 public:
  explicit DiagnosticTask(const std::string name) : name_(name) {}
  virtual ~DiagnosticTask() {}
  const std::string& getName() const { return name_; }
  virtual void run(DiagnosticStatusWrapper& stat) = 0;

 private:
  std::string name_;
};

template <class T>
class GenericFunctionDiagnosticTask : public DiagnosticTask {
 public:
  GenericFunctionDiagnosticTask(const std::string& name, boost::function<void(T&)> fn)
      : DiagnosticTask(name), fn_(fn) {}
  void run(DiagnosticStatusWrapper& stat) override { fn_(stat); }

 private:
  boost::function<void(T&)> fn_;
};
typedef GenericFunctionDiagnosticTask<diagnostic_msgs::DiagnosticStatus> FunctionDiagnosticTask;

/** Several checks with one status, whose level is the worst of theirs. */
class CompositeDiagnosticTask : public DiagnosticTask {
 public:
  explicit CompositeDiagnosticTask(const std::string name) : DiagnosticTask(name) {}
  void addTask(DiagnosticTask* task) { tasks_.push_back(task); }
  void run(DiagnosticStatusWrapper& stat) override {
    DiagnosticStatusWrapper combined, original;
    original.summary(stat);
    for (DiagnosticTask* const task : tasks_) {
      stat.summary(original);
      task->run(stat);
      combined.mergeSummary(stat);
    }
    stat.summary(combined);
  }

 private:
  std::vector<DiagnosticTask*> tasks_;
};

/** Checks by their names. */
class DiagnosticTaskVector {
 public:
  virtual ~DiagnosticTaskVector() {}
  void add(const std::string& name, TaskFunction f) { addTask(Task{name, f}); }
  void add(DiagnosticTask& task) { add(task.getName(), boost::bind(&DiagnosticTask::run, &task, _1)); }
  template <class T>
  void add(const std::string name, T* c, void (T::*f)(DiagnosticStatusWrapper&)) {
    add(name, boost::bind(f, c, _1));
  }
  bool removeByName(const std::string name) {
    const std::lock_guard<std::recursive_mutex> lock(lock_);
    for (auto task = tasks_.begin(); task != tasks_.end(); ++task)
      if (task->name == name) {
        tasks_.erase(task);
        return true;
      }
    return false;
  }

 protected:
  struct Task {
    std::string name;
    TaskFunction run;
  };
  virtual void addedTask(const Task&) {}
  void addTask(const Task& task) {
    {
      const std::lock_guard<std::recursive_mutex> lock(lock_);
      tasks_.push_back(task);
    }
    addedTask(task);
  }

  std::recursive_mutex lock_;
  std::vector<Task> tasks_;
};

/** Runs checks, and publishes their statuses on /diagnostics once in a period. */
class Updater : public DiagnosticTaskVector {
 public:
  /** True: a status that is not OK is logged, too. */
  bool verbose_ = false;

  explicit Updater(ros::NodeHandle h = ros::NodeHandle(), ros::NodeHandle ph = ros::NodeHandle("~"),
                   const std::string node_name = ros::this_node::getName())
      : private_node_(ph),
        node_name_(node_name),
        publisher_(h.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 1)) {
    private_node_.getParam("diagnostic_period", period_);
    next_ = ros::Time::now() + ros::Duration(period_);
  }

  /** Publish if the period is over; call it often. */
  void update() {
    const ros::Time now = ros::Time::now();
    if (now < next_) {
      if ((next_ - now).toSec() > period_) next_ = now + ros::Duration(period_);  // time jumped back
      return;
    }
    force_update();
  }
  void force_update() {
    private_node_.getParamCached("diagnostic_period", period_);
    next_ = ros::Time::now() + ros::Duration(period_);
    std::vector<diagnostic_msgs::DiagnosticStatus> statuses;
    const std::lock_guard<std::recursive_mutex> lock(lock_);
    for (const Task& task : tasks_) {
      DiagnosticStatusWrapper status;
      status.name = task.name;
      status.level = 2;
      status.message = "No message was set";
      status.hardware_id = hardware_id_;
      task.run(status);
      if (verbose_ && status.level)
        ROS_WARN("Non-zero diagnostic status. Name: '%s', status %i: '%s'", status.name.c_str(), status.level,
                 status.message.c_str());
      statuses.push_back(status);
    }
    if (hardware_id_.empty() && !statuses.empty()) ROS_WARN_ONCE("diagnostic_updater: No HW_ID was set.");
    publish(statuses);
  }
  double getPeriod() { return period_; }
  /** Publish one level and message for all checks. */
  void broadcast(int lvl, const std::string msg) {
    std::vector<diagnostic_msgs::DiagnosticStatus> statuses;
    for (const Task& task : tasks_) statuses.push_back(status(task.name, lvl, msg));
    publish(statuses);
  }
  void setHardwareID(const std::string& hwid) { hardware_id_ = hwid; }
  void setHardwareIDf(const char* format, ...) __attribute__((format(printf, 2, 3))) {
    char text[1000];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    hardware_id_ = text;
  }

 private:
  diagnostic_msgs::DiagnosticStatus status(const std::string& name, int level, const std::string& message) {
    DiagnosticStatusWrapper result;
    result.name = name;
    result.hardware_id = hardware_id_;
    result.summary(static_cast<unsigned char>(level), message);
    return result;
  }
  void addedTask(const Task& task) override {
    publish(std::vector<diagnostic_msgs::DiagnosticStatus>(1, status(task.name, 0, "Node starting up")));
  }
  /** Names of statuses begin with the node's. */
  void publish(std::vector<diagnostic_msgs::DiagnosticStatus> statuses) {
    diagnostic_msgs::DiagnosticArray message;
    for (diagnostic_msgs::DiagnosticStatus& status : statuses) {
      status.name = node_name_.substr(node_name_[0] == '/' ? 1 : 0) + ": " + status.name;
      message.status.push_back(status);
    }
    message.header.stamp = ros::Time::now();
    publisher_.publish(message);
  }

  ros::NodeHandle private_node_;
  std::string node_name_, hardware_id_;
  ros::Publisher publisher_;
  double period_ = 1.0;
  ros::Time next_;
};

}  // namespace diagnostic_updater
