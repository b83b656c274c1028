#pragma once

#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/ros.h>
#include <boost/thread.hpp>

#include <boost/thread/recursive_mutex.hpp>

#include "dynamic_reconfigure/config.h"

namespace dynamic_reconfigure {

/** Offers a node's parameters to others, who may change them while the node runs. */
template <class ConfigType>
class Server {
 public:
  typedef boost::function<void(ConfigType& config, uint32_t level)> CallbackType;

  explicit Server(const ros::NodeHandle& nh = ros::NodeHandle("~")) : node_(nh), mutex_(own_mutex_) { start(); }
  /** With the program's mutex, which is locked while the callback runs, and around updateConfig(). */
  explicit Server(boost::recursive_mutex& mutex, const ros::NodeHandle& nh = ros::NodeHandle("~"))
      : node_(nh), mutex_(mutex) {
    start();
  }

  /** Set the callback, and call it with the present values and all levels. */
  void setCallback(const CallbackType& callback) {
    const Lock lock(mutex_);
    callback_ = callback;
    call(config_, ~0u);
    store(config_);
  }
  void clearCallback() {
    const Lock lock(mutex_);
    callback_.clear();
  }
  /** Publish values that the program itself changed; the callback is not called. */
  void updateConfig(const ConfigType& config) {
    const Lock lock(mutex_);
    store(config);
  }
  void getConfigMax(ConfigType& max) const { max = max_; }
  void getConfigMin(ConfigType& min) const { min = min_; }
  void getConfigDefault(ConfigType& config) const { config = default_; }
  void setConfigMax(const ConfigType& max) {
    max_ = max;
    describe();
  }
  void setConfigMin(const ConfigType& min) {
    min_ = min;
    describe();
  }
  void setConfigDefault(const ConfigType& config) {
    default_ = config;
    describe();
  }

 private:
  typedef boost::unique_lock<boost::recursive_mutex> Lock;

  void start() {
    const Lock lock(mutex_);
    // Before the values, as clients that get them set others at once.
    service_ = node_.advertiseService("set_parameters", &Server::set, this);
    config_.__fromServer__(node_);
    config_.__clamp__(min_, max_);
    descriptions_ = node_.advertise<ConfigDescription>("parameter_descriptions", 1, true);
    updates_ = node_.advertise<Config>("parameter_updates", 1, true);
    describe();
    store(config_);
  }
  void describe() {
    ConfigDescription message = ConfigType::__getDescriptionMessage__();
    max_.__toMessage__(message.max);
    min_.__toMessage__(message.min);
    default_.__toMessage__(message.dflt);
    descriptions_.publish(message);
  }

  bool set(Reconfigure::Request& request, Reconfigure::Response& response) {
    const Lock lock(mutex_);
    ConfigType config = config_;
    if (!config.__fromMessage__(request.config))
      ROS_WARN("%s: a parameter to set is none of the node's, or has another type", service_.getService().c_str());
    config.__clamp__(min_, max_);
    call(config, config_.__level__(config));
    store(config);
    config_.__toMessage__(response.config);
    return true;
  }

  void call(ConfigType& config, uint32_t level) {
    if (!callback_) return;
    try {
      callback_(config, level);
    } catch (const std::exception& error) {
      ROS_WARN("Reconfigure callback failed with exception %s: ", error.what());
    }
  }
  void store(const ConfigType& config) {
    config_ = config;
    config_.__toServer__(node_);
    Config message;
    config_.__toMessage__(message);
    updates_.publish(message);
  }

  ros::NodeHandle node_;
  ros::ServiceServer service_;
  ros::Publisher updates_, descriptions_;
  CallbackType callback_;
  ConfigType config_ = ConfigType::__getDefault__(), min_ = ConfigType::__getMin__(), max_ = ConfigType::__getMax__(),
             default_ = ConfigType::__getDefault__();
  boost::recursive_mutex own_mutex_;
  boost::recursive_mutex& mutex_;
};

}  // namespace dynamic_reconfigure
