#pragma once

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/ros.h>

#include <boost/function.hpp>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>

namespace dynamic_reconfigure {

/** Reads and sets the parameters that a node's Server offers; its callbacks run where the node's others do. */
template <class ConfigType>
class Client {
 public:
  typedef boost::function<void(const ConfigType&)> ConfigurationCallback;
  typedef boost::function<void(const ConfigDescription&)> DescriptionCallback;

  /** `name`: name of the node, in the node's namespace. */
  explicit Client(const std::string& name, const ConfigurationCallback& config_callback = ConfigurationCallback(),
                  const DescriptionCallback& description_callback = DescriptionCallback())
      : Client(name, ros::NodeHandle(name), config_callback, description_callback) {}
  /** `nh`: handle of the namespace with the server's service. */
  Client(const std::string& name, const ros::NodeHandle& nh,
         const ConfigurationCallback& config_callback = ConfigurationCallback(),
         const DescriptionCallback& description_callback = DescriptionCallback())
      : name_(name), node_(nh), on_config_(config_callback), on_description_(description_callback) {
    service_ = node_.serviceClient<Reconfigure>("set_parameters");
    configs_ = node_.subscribe("parameter_updates", 1, &Client::takeConfig, this);
    descriptions_ = node_.subscribe("parameter_descriptions", 1, &Client::takeDescription, this);
  }

  void setConfigurationCallback(const ConfigurationCallback& callback) {
    const Lock lock(mutex_);
    on_config_ = callback;
  }
  void setDescriptionCallback(const DescriptionCallback& callback) {
    const Lock lock(mutex_);
    on_description_ = callback;
  }

  /** Set the node's parameters; `configuration` gets the values that it has then. False if the call failed. */
  bool setConfiguration(ConfigType& configuration) {
    Reconfigure call;
    configuration.__toMessage__(call.request.config);
    if (!service_.call(call)) return false;
    configuration.__fromMessage__(call.response.config);
    const Lock lock(mutex_);
    config_.reset(new ConfigType(configuration));
    arrival_.notify_all();
    return true;
  }
  bool setConfiguration(const ConfigType& configuration) {
    ConfigType copy = configuration;
    return setConfiguration(copy);
  }
  /** The node's values: those of the last setConfiguration, or, beside a spinner, what the node has told since. Wait
   * for them; `timeout` 0: for ever. */
  bool getCurrentConfiguration(ConfigType& configuration, const ros::Duration& timeout = ros::Duration(0)) {
    return wait(config_, configuration, timeout);
  }
  bool getDefaultConfiguration(ConfigType& configuration, const ros::Duration& timeout = ros::Duration(0)) {
    return wait(default_, configuration, timeout);
  }
  bool getMinConfiguration(ConfigType& configuration, const ros::Duration& timeout = ros::Duration(0)) {
    return wait(min_, configuration, timeout);
  }
  bool getMaxConfiguration(ConfigType& configuration, const ros::Duration& timeout = ros::Duration(0)) {
    return wait(max_, configuration, timeout);
  }
  std::string getName() const { return name_; }

 private:
  typedef std::unique_lock<std::mutex> Lock;

  static std::unique_ptr<ConfigType> configOf(const Config& message) {
    std::unique_ptr<ConfigType> config(new ConfigType);
    config->__fromMessage__(message);
    return config;
  }
  void takeConfig(const Config& message) {
    ConfigurationCallback callback;
    std::unique_ptr<ConfigType> config = configOf(message);
    const ConfigType copy = *config;
    {
      const Lock lock(mutex_);
      config_ = std::move(config);
      callback = on_config_;
    }
    arrival_.notify_all();
    if (callback) callback(copy);
  }
  void takeDescription(const ConfigDescription& message) {
    DescriptionCallback callback;
    {
      const Lock lock(mutex_);
      default_ = configOf(message.dflt);
      min_ = configOf(message.min);
      max_ = configOf(message.max);
      callback = on_description_;
    }
    arrival_.notify_all();
    if (callback) callback(message);
  }
  bool wait(const std::unique_ptr<ConfigType>& value, ConfigType& result, const ros::Duration& timeout) {
    const std::chrono::milliseconds step(50);  // between looks at ros::ok()
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(timeout.toSec());
    Lock lock(mutex_);
    while (!value && ros::ok() && (timeout.isZero() || ros::WallTime::now() < end)) arrival_.wait_for(lock, step);
    if (value) result = *value;
    return value != nullptr;
  }

  std::string name_;
  ros::NodeHandle node_;
  ConfigurationCallback on_config_;
  DescriptionCallback on_description_;
  std::mutex mutex_;
  std::condition_variable arrival_;
  std::unique_ptr<ConfigType> config_, default_, min_, max_;
  ros::ServiceClient service_;
  ros::Subscriber configs_, descriptions_;
};

}  // namespace dynamic_reconfigure
