#pragma once

#include <string>

#include "ros/common.h"
#include "ros/message.h"
#include "ros/node_handle.h"
#include "ros/service_traits.h"

namespace ros {

/** Calls of services without a ServiceClient. */
namespace service {

template <class MReq, class MRes>
bool call(const std::string& name, MReq& req, MRes& res) {
  NodeHandle handle;
  ServiceClientOptions options(names::resolve(name), service_traits::md5sum(req), false, M_string());
  return handle.serviceClient(options).call(req, res);
}
template <class Service>
bool call(const std::string& name, Service& service) {
  NodeHandle handle;
  ServiceClientOptions options(names::resolve(name), service_traits::md5sum(service), false, M_string());
  return handle.serviceClient(options).call(service.request, service.response);
}
/** Wait for a service; a timeout of -1 ms means no limit. */
bool waitForService(const std::string& name, int32_t timeout_ms);
bool waitForService(const std::string& name, ros::Duration timeout = ros::Duration(-1));
bool exists(const std::string& name, bool print_failure_reason);
template <class MReq, class MRes>
ServiceClient createClient(const std::string& name, bool persistent = false, const M_string& header = M_string()) {
  NodeHandle handle;
  return handle.serviceClient<MReq, MRes>(names::resolve(name), persistent, header);
}
template <class Service>
ServiceClient createClient(const std::string& name, bool persistent = false, const M_string& header = M_string()) {
  NodeHandle handle;
  return handle.serviceClient<Service>(names::resolve(name), persistent, header);
}

}  // namespace service
}  // namespace ros
