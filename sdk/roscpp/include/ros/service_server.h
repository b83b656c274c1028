#pragma once

#include "ros/common.h"

namespace ros {

/** Handle of an advertised service; destroying the last copy unadvertises it. */
class ServiceServer {
 public:
  ServiceServer() {}
  void shutdown();
  std::string getService() const;
  operator void*() const { return isValid() ? const_cast<ServiceServer*>(this) : nullptr; }
  bool operator<(const ServiceServer& other) const { return impl_ < other.impl_; }
  bool operator==(const ServiceServer& other) const { return impl_ == other.impl_; }
  bool operator!=(const ServiceServer& other) const { return impl_ != other.impl_; }

 private:
  friend class NodeHandle;
  struct Impl;
  explicit ServiceServer(const boost::shared_ptr<Impl>& impl) : impl_(impl) {}
  bool isValid() const;

  boost::shared_ptr<Impl> impl_;
};
typedef std::vector<ServiceServer> V_ServiceServer;

}  // namespace ros
