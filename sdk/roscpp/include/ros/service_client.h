#pragma once

#include "ros/common.h"
#include "ros/forwards.h"
#include "ros/serialization.h"
#include "ros/service_traits.h"

namespace ros {

/** Calls a service. */
class ServiceClient {
 public:
  ServiceClient() {}

  /** Call the service and wait for the response; false if the service is not available or fails. */
  template <class MReq, class MRes>
  bool call(MReq& req, MRes& res) {
    return call(req, res, service_traits::md5sum(req));
  }
  template <class Service>
  bool call(Service& service) {
    return call(service.request, service.response, service_traits::md5sum(service));
  }
  template <typename MReq, typename MRes>
  bool call(const MReq& req, MRes& res, const std::string& service_md5sum) {
    SerializedMessage response;
    if (!call(serialization::serializeMessage(req), response, service_md5sum)) return false;
    try {
      serialization::deserializeMessage(response, res);
    } catch (std::exception& error) {
      deserializeFailed(error);
      return false;
    }
    return true;
  }
  bool call(const SerializedMessage& req, SerializedMessage& resp, const std::string& service_md5sum);
  /** True if a persistent connection is still open. */
  bool isValid() const;
  bool isPersistent() const;
  void shutdown();
  bool waitForExistence(ros::Duration timeout = ros::Duration(-1));
  bool exists();
  std::string getService();
  operator void*() const { return isValid() ? const_cast<ServiceClient*>(this) : nullptr; }
  bool operator<(const ServiceClient& other) const { return impl_ < other.impl_; }
  bool operator==(const ServiceClient& other) const { return impl_ == other.impl_; }
  bool operator!=(const ServiceClient& other) const { return impl_ != other.impl_; }

 private:
  friend class NodeHandle;
  struct Impl;
  explicit ServiceClient(const boost::shared_ptr<Impl>& impl) : impl_(impl) {}
  void deserializeFailed(const std::exception& error);

  boost::shared_ptr<Impl> impl_;
};
typedef boost::shared_ptr<ServiceClient> ServiceClientPtr;

}  // namespace ros
