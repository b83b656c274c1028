#pragma once

#include <boost/lexical_cast.hpp>  // programs use it without including it

#include "ros/common.h"

namespace ros {

/** Preferred transports of a subscriber, best first. Publishers of rospy have TCPROS alone, which is then used. */
class TransportHints {
 public:
  TransportHints& reliable() { return add("TCP"); }
  TransportHints& unreliable() { return add("UDP"); }
  TransportHints& tcp() { return add("TCP"); }
  TransportHints& udp() { return add("UDP"); }
  TransportHints& tcpNoDelay(bool nodelay = true) {
    options_["tcp_nodelay"] = nodelay ? "true" : "false";
    return *this;
  }
  bool getTCPNoDelay() {
    const M_string::const_iterator found = options_.find("tcp_nodelay");
    return found != options_.end() && found->second == "true";
  }
  TransportHints& maxDatagramSize(int size) {
    max_datagram_size_ = size;
    return *this;
  }
  int getMaxDatagramSize() { return max_datagram_size_; }
  const V_string& getTransports() { return transports_; }
  const M_string& getOptions() { return options_; }

 private:
  TransportHints& add(const char* transport) {
    transports_.push_back(transport);
    return *this;
  }
  V_string transports_;
  M_string options_;
  int max_datagram_size_ = 0;
};

}  // namespace ros
