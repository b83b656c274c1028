#include "services.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <mutex>
#include <set>

#include "connection_header.h"
#include "node.h"
#include "ros/callback_queue_interface.h"
#include "ros/init.h"
#include "ros/network.h"
#include "ros/this_node.h"

namespace ros {
namespace services {

/** A service that this node offers. */
class Offer {
 public:
  explicit Offer(const AdvertiseServiceOptions& given)
      : options(given), tracked(given.tracked_object), is_tracking(given.tracked_object) {
    options.tracked_object.reset();
  }
  AdvertiseServiceOptions options;
  boost::weak_ptr<void const> tracked;
  const bool is_tracking;
  std::mutex mutex;
  std::set<std::shared_ptr<net::FrameConnection>> clients;
};

namespace {

struct State {
  std::mutex mutex;
  std::map<std::string, std::shared_ptr<Offer>> offers;
};

State& state() {
  static State* const instance = new State;
  return *instance;
}

SerializedMessage failure(const std::string& text) {
  SerializedMessage m;
  m.num_bytes = text.size() + 5;
  m.buf.reset(new uint8_t[m.num_bytes]);
  m.buf[0] = 0;
  const uint32_t size = static_cast<uint32_t>(text.size());
  std::memcpy(m.buf.get() + 1, &size, sizeof(size));
  std::copy(text.begin(), text.end(), m.buf.get() + 5);
  return m;
}

/** Call of a service by a client. */
class ServiceCall : public CallbackInterface {
 public:
  ServiceCall(const std::shared_ptr<Offer>& offer, const std::shared_ptr<net::FrameConnection>& client,
              const SerializedMessage& request, const boost::shared_ptr<M_string>& header, bool is_persistent)
      : offer_(offer), client_(client), is_persistent_(is_persistent) {
    params_.request = request;
    params_.connection_header = header;
  }
  CallResult call() override {
    const VoidConstPtr tracked = offer_->tracked.lock();
    SerializedMessage response;
    CallResult result = Success;
    if (client_->isClosed() || (offer_->is_tracking && !tracked)) {
      response = failure("service [" + offer_->options.service + "] is gone");
      result = Invalid;
    } else {
      try {
        response = offer_->options.helper->call(params_) ? params_.response : failure("");
      } catch (const std::exception& error) {
        ROS_ERROR("Service [%s] threw an exception while it was called: %s", offer_->options.service.c_str(),
                  error.what());
        response = failure(error.what());
      }
    }
    client_->send(response.buf, response.num_bytes);
    if (!is_persistent_) client_->close(true);
    return result;
  }

 private:
  std::shared_ptr<Offer> offer_;
  std::shared_ptr<net::FrameConnection> client_;
  ServiceCallbackHelperCallParams params_;
  bool is_persistent_;
};

void callMaster(const char* method, const std::string& service, bool is_new) {
  XmlRpc::XmlRpcValue arguments, payload;
  arguments[0] = service;
  arguments[1] = "rosrpc://" + network::getHost() + ":" + std::to_string(network::getTCPROSPort());
  if (is_new) arguments[2] = node::uri();
  node::callMaster(method, arguments, payload, is_new);
}

void closeClients(const std::shared_ptr<Offer>& offer) {
  std::set<std::shared_ptr<net::FrameConnection>> clients;
  {
    const std::lock_guard<std::mutex> lock(offer->mutex);
    clients.swap(offer->clients);
  }
  for (const auto& client : clients) client->close(true);
}

}  // namespace

std::shared_ptr<Offer> advertise(const AdvertiseServiceOptions& options) {
  const auto offer = std::make_shared<Offer>(options);
  {
    const std::lock_guard<std::mutex> lock(state().mutex);
    if (!state().offers.emplace(options.service, offer).second) {
      ROS_ERROR("Tried to advertise a service that is already advertised in this node [%s]", options.service.c_str());
      return nullptr;
    }
  }
  callMaster("registerService", options.service, true);
  return offer;
}

void unadvertise(const std::shared_ptr<Offer>& offer) {
  {
    const std::lock_guard<std::mutex> lock(state().mutex);
    const auto found = state().offers.find(offer->options.service);
    if (found == state().offers.end() || found->second != offer) return;
    state().offers.erase(found);
  }
  if (CallbackQueueInterface::exists(offer->options.callback_queue))
    offer->options.callback_queue->removeByID(reinterpret_cast<uint64_t>(offer.get()));
  closeClients(offer);
  callMaster("unregisterService", offer->options.service, false);
}

bool acceptClient(const std::shared_ptr<net::FrameConnection>& connection, const M_string& header) {
  const std::string service = net::field(header, "service"), md5sum = net::field(header, "md5sum");
  std::shared_ptr<Offer> offer;
  {
    const std::lock_guard<std::mutex> lock(state().mutex);
    const auto found = state().offers.find(service);
    if (found != state().offers.end()) offer = found->second;
  }
  std::string error;
  if (!offer) error = "received a tcpros connection for a nonexistent service [" + service + "]";
  else if (md5sum.empty()) error = "the header of a client needs md5sum";
  else if (md5sum != "*" && offer->options.md5sum != "*" && md5sum != offer->options.md5sum)
    error = "client wants service " + service + " to have md5sum " + md5sum + ", but it has " + offer->options.md5sum +
            ". Dropping connection.";
  if (!error.empty()) {
    if (!isShuttingDown()) ROS_ERROR("%s", error.c_str());
    connection->send(net::encodeHeader({{"error", error}}));
    connection->close(true);
    return true;
  }
  const AdvertiseServiceOptions& options = offer->options;
  connection->send(net::encodeHeader({{"callerid", this_node::getName()},
                                      {"md5sum", options.md5sum},
                                      {"request_type", options.req_datatype},
                                      {"response_type", options.res_datatype},
                                      {"service", service},
                                      {"type", options.datatype}}));
  if (net::field(header, "probe") == "1") {
    connection->close(true);
    return true;
  }
  const std::string persistent = net::field(header, "persistent");
  const bool is_persistent = persistent == "1" || persistent == "true";
  const auto shared_header = boost::make_shared<M_string>(header);
  const std::weak_ptr<net::FrameConnection> weak = connection;
  {
    const std::lock_guard<std::mutex> lock(offer->mutex);
    offer->clients.insert(connection);
  }
  connection->max_frame = net::kMaxMessage;
  connection->on_frame = [offer, weak, shared_header, is_persistent](const boost::shared_array<uint8_t>& bytes,
                                                                     uint32_t size) {
    const std::shared_ptr<net::FrameConnection> client = weak.lock();
    if (!client) return false;
    offer->options.callback_queue->addCallback(
        boost::make_shared<ServiceCall>(offer, client, SerializedMessage(bytes, size), shared_header, is_persistent),
        reinterpret_cast<uint64_t>(offer.get()));
    return true;
  };
  connection->on_closed = [offer, weak] {
    const std::lock_guard<std::mutex> lock(offer->mutex);
    offer->clients.erase(weak.lock());
  };
  return true;
}

void shutdown() {
  std::map<std::string, std::shared_ptr<Offer>> offers;
  {
    const std::lock_guard<std::mutex> lock(state().mutex);
    offers.swap(state().offers);
  }
  for (const auto& entry : offers) {
    closeClients(entry.second);
    callMaster("unregisterService", entry.first, false);
  }
}

}  // namespace services
}  // namespace ros
