#include "ros/service_client.h"

#include <algorithm>
#include <mutex>

#include "connection_header.h"
#include "node.h"
#include "ros/init.h"
#include "ros/network.h"
#include "ros/service.h"
#include "ros/this_node.h"
#include "service_client_impl.h"

namespace ros {
namespace {

/** Address of a service; false if none is registered. */
bool lookUp(const std::string& name, std::string& host, uint32_t& port) {
  XmlRpc::XmlRpcValue arguments, payload;
  arguments[0] = name;
  return node::callMaster("lookupService", arguments, payload, false) &&
         payload.getType() == XmlRpc::XmlRpcValue::TypeString &&
         network::splitURI(static_cast<std::string&>(payload), host, port);
}

net::Socket connectTo(const std::string& name, M_string fields) {
  std::string host;
  uint32_t port = 0;
  if (!lookUp(name, host, port)) throw net::NetError("service [" + name + "] is not advertised");
  net::Socket socket = net::Socket::connect(host, static_cast<uint16_t>(port));
  fields["callerid"] = this_node::getName();
  fields["service"] = name;
  net::exchangeHeaders(socket, fields);
  return socket;
}

}  // namespace

bool ServiceClient::call(const SerializedMessage& request, SerializedMessage& response, const std::string& md5sum) {
  if (!impl_ || impl_->is_shut_down) {
    ROS_ERROR("Call to a service with an invalid client");
    return false;
  }
  if (md5sum != impl_->md5sum) {
    ROS_ERROR("Call to service [%s] with md5sum [%s] does not match md5sum when the handle was created ([%s])",
              impl_->name.c_str(), md5sum.c_str(), impl_->md5sum.c_str());
    return false;
  }
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  try {
    if (impl_->socket.isOpen() && impl_->socket.isStale()) {
      impl_->socket.close();
      throw net::NetError("the persistent connection is closed; make a new client");
    }
    if (!impl_->socket.isOpen()) {
      if (impl_->is_persistent && impl_->was_connected) return false;
      M_string fields = impl_->header;
      fields["md5sum"] = impl_->md5sum;
      if (impl_->is_persistent) fields["persistent"] = "1";
      impl_->socket = connectTo(impl_->name, fields);
      impl_->was_connected = true;
    }
    net::Socket& socket = impl_->socket;
    socket.write(request.buf.get(), request.num_bytes);
    uint8_t head[5];
    socket.read(head, sizeof(head));
    const uint32_t size = head[1] | static_cast<uint32_t>(head[2]) << 8 | static_cast<uint32_t>(head[3]) << 16 |
                          static_cast<uint32_t>(head[4]) << 24;
    if (size > net::kMaxMessage) throw net::NetError("the response is longer than 1 GB");
    std::vector<uint8_t> body;
    for (size_t at = 0; at < size; at = body.size()) {  // memory grows with what arrives, not with `size`
      body.resize(at + std::min<size_t>(size - at, std::max<size_t>(at, 1 << 20)));
      socket.read(body.data() + at, body.size() - at);
    }
    if (!impl_->is_persistent) socket.close();
    if (head[0] == 0) {
      ROS_ERROR("Service call failed: service [%s] responded with an error: %s", impl_->name.c_str(),
                std::string(body.begin(), body.end()).c_str());
      return false;
    }
    boost::shared_array<uint8_t> bytes(new uint8_t[std::max<size_t>(size, 1)]);
    std::copy(body.begin(), body.end(), bytes.get());
    response = SerializedMessage(bytes, size);
    return true;
  } catch (const net::NetError& error) {
    impl_->socket.close();
    if (!isShuttingDown()) ROS_ERROR("Call of service [%s] failed: %s", impl_->name.c_str(), error.what());
    return false;
  }
}

void ServiceClient::deserializeFailed(const std::exception& error) {
  ROS_ERROR("Exception thrown while deserializing the response of service [%s]: %s", getService().c_str(),
            error.what());
}

bool ServiceClient::isValid() const {
  if (!impl_ || impl_->is_shut_down) return false;
  if (!impl_->is_persistent) return true;
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  return !impl_->was_connected || (impl_->socket.isOpen() && !impl_->socket.isStale());
}

bool ServiceClient::isPersistent() const { return impl_ && impl_->is_persistent; }

void ServiceClient::shutdown() {
  if (!impl_) return;
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  impl_->is_shut_down = true;
  impl_->socket.close();
}

bool ServiceClient::waitForExistence(Duration timeout) {
  return impl_ && service::waitForService(impl_->name, timeout);
}
bool ServiceClient::exists() { return impl_ && service::exists(impl_->name, false); }
std::string ServiceClient::getService() { return impl_ ? impl_->name : ""; }

namespace service {

bool exists(const std::string& service_name, bool print_failure_reason) {
  const std::string name = names::resolve(service_name);
  try {
    connectTo(name, {{"md5sum", "*"}, {"probe", "1"}});
    return true;
  } catch (const net::NetError& error) {
    if (print_failure_reason && !isShuttingDown())
      ROS_INFO("waitForService: Service [%s] could not connect: %s", name.c_str(), error.what());
    return false;
  }
}

bool waitForService(const std::string& name, int32_t timeout_ms) {
  return waitForService(name, timeout_ms < 0 ? Duration(-1) : Duration(timeout_ms / 1000.0));
}

bool waitForService(const std::string& service_name, Duration timeout) {
  const std::string name = names::resolve(service_name);
  const SteadyTime start = SteadyTime::now();
  bool is_reported = false;
  while (ok()) {
    if (exists(name, false)) {
      if (is_reported) ROS_INFO("waitForService: Service [%s] is now available.", name.c_str());
      return true;
    }
    const double waited = (SteadyTime::now() - start).toSec();
    if (timeout >= Duration(0) && waited >= timeout.toSec()) return false;
    if (!is_reported) ROS_INFO("waitForService: Service [%s] has not been advertised, waiting...", name.c_str());
    is_reported = true;
    WallDuration(0.02).sleep();
  }
  return false;
}

}  // namespace service
}  // namespace ros
