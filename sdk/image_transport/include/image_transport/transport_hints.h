#pragma once

#include <ros/node_handle.h>
#include <ros/transport_hints.h>

#include <string>

namespace image_transport {

/** Name of a subscriber's transport, which the parameter ~image_transport replaces. */
class TransportHints {
 public:
  TransportHints(const std::string& default_transport = "raw",
                 const ros::TransportHints& ros_hints = ros::TransportHints(),
                 const ros::NodeHandle& parameter_nh = ros::NodeHandle("~"),
                 const std::string& parameter_name = "image_transport")
      : ros_hints_(ros_hints), parameter_nh_(parameter_nh) {
    parameter_nh_.param(parameter_name, transport_, default_transport);
  }
  const std::string& getTransport() const { return transport_; }
  const ros::TransportHints& getRosHints() const { return ros_hints_; }
  const ros::NodeHandle& getParameterNH() const { return parameter_nh_; }

 private:
  std::string transport_;
  ros::TransportHints ros_hints_;
  ros::NodeHandle parameter_nh_;
};

}  // namespace image_transport
