#include "server.h"

#include <rosgraph_msgs/Clock.h>
#include <unistd.h>

#include <map>
#include <memory>
#include <mutex>

#include "connection_header.h"
#include "node.h"
#include "ros/init.h"
#include "ros/master.h"
#include "ros/names.h"
#include "ros/network.h"
#include "ros/this_node.h"
#include "services.h"
#include "topics.h"
#include "xml_rpc.h"

namespace ros {
namespace {

using XmlRpc::XmlRpcValue;

std::string own_uri;
std::shared_ptr<Subscription> clock_subscription;
SubscriptionCallbackHelperPtr clock_helper;

/** Runs each call at once, on the loop's thread. */
class ImmediateQueue : public CallbackQueueInterface {
 public:
  void addCallback(const CallbackInterfacePtr& callback, uint64_t) override { callback->call(); }
  void removeByID(uint64_t) override {}
};

XmlRpcValue answer(int code, const std::string& message, const XmlRpcValue& value) {
  XmlRpcValue result;
  result[0] = code;
  result[1] = message;
  result[2] = value;
  return result;
}
XmlRpcValue success(const XmlRpcValue& value) { return answer(1, "", value); }

XmlRpcValue requestTopic(const XmlRpcValue& parameters) {
  const std::string topic = names::clean(parameters[1]);
  if (!topics::publication(topic)) return answer(0, "requestTopic: topic [" + topic + "] is not published", 0);
  const XmlRpcValue& protocols = parameters[2];
  for (int i = 0; i < protocols.size(); ++i) {
    if (protocols[i][0] == XmlRpcValue("UDPROS")) try {
        return success(topics::acceptDatagramSubscriber(protocols[i]));
      } catch (const net::NetError& error) {
        return answer(0, std::string("requestTopic: ") + error.what(), 0);
      } catch (const XmlRpc::XmlRpcException&) {
        return answer(0, "requestTopic: UDPROS needs a header, a host, a port and a size of datagrams", 0);
      }
    if (protocols[i][0] != XmlRpcValue("TCPROS")) continue;
    XmlRpcValue protocol;
    protocol[0] = std::string("TCPROS");
    protocol[1] = network::getHost();
    protocol[2] = static_cast<int>(network::getTCPROSPort());
    return success(protocol);
  }
  return answer(0, "requestTopic: the protocols are TCPROS and UDPROS", 0);
}

XmlRpcValue publisherUpdate(const XmlRpcValue& parameters) {
  std::vector<std::string> uris;
  for (int i = 0; i < parameters[2].size(); ++i) uris.push_back(parameters[2][i]);
  topics::publisherUpdate(names::clean(parameters[1]), uris);
  return success(0);
}

struct Methods {
  std::mutex mutex;
  std::map<std::string, net::XmlRpcMethod> by_name;
};

Methods& methods() {
  static Methods* const all = new Methods{
      {},
      {
          {"requestTopic", requestTopic},
          {"publisherUpdate", publisherUpdate},
          {"paramUpdate",
           [](const XmlRpcValue& parameters) {
             param::update(parameters[1], parameters[2]);
             return success(0);
           }},
          {"shutdown",
           [](const XmlRpcValue& parameters) {
             const std::string reason = parameters.size() > 1 ? static_cast<std::string>(parameters[1]) : "";
             ROS_WARN("Shutdown request received.\nReason given for shutdown: [%s]", reason.c_str());
             requestShutdown();
             return success(0);
           }},
          {"getPid", [](const XmlRpcValue&) { return success(static_cast<int>(getpid())); }},
          {"getMasterUri", [](const XmlRpcValue&) { return success(master::getURI()); }},
          {"getBusInfo", [](const XmlRpcValue&) { return success(topics::busInfo()); }},
          {"getBusStats",
           [](const XmlRpcValue&) {
             XmlRpcValue none;
             none[2].setSize(0);
             none[1].setSize(0);
             none[0].setSize(0);
             return success(none);
           }},
          {"getPublications", [](const XmlRpcValue&) { return success(topics::publications()); }},
          {"getSubscriptions", [](const XmlRpcValue&) { return success(topics::subscriptions()); }},
      }};
  return *all;
}

net::XmlRpcMethod findMethod(const std::string& name) {
  const std::lock_guard<std::mutex> lock(methods().mutex);
  const auto found = methods().by_name.find(name);
  return found == methods().by_name.end() ? net::XmlRpcMethod() : found->second;
}

/** Read the header of a peer that has connected, which names a topic or a service, and pass the peer on. */
void acceptPeer(net::Socket socket) {
  const auto connection = std::make_shared<net::FrameConnection>(std::move(socket));
  const std::weak_ptr<net::FrameConnection> weak = connection;
  connection->max_frame = net::kMaxHeader;
  connection->on_frame = [weak](const boost::shared_array<uint8_t>& bytes, uint32_t size) {
    const std::shared_ptr<net::FrameConnection> peer = weak.lock();
    if (!peer) return false;
    try {
      const M_string header = net::decodeHeader(bytes.get(), size);
      if (header.count("topic")) return topics::acceptSubscriber(peer, header);
      if (header.count("service")) return services::acceptClient(peer, header);
      peer->send(net::encodeHeader({{"error", "a connection header names a topic or a service"}}));
      peer->close(true);
      return true;
    } catch (const net::NetError& error) {
      ROS_DEBUG("Connection dropped: %s", error.what());
      return false;
    }
  };
  net::Loop::instance().add(connection);
}

}  // namespace

namespace node {
const std::string& uri() { return own_uri; }
}  // namespace node

namespace server {

void start() {
  const std::string& host = network::getHost();
  const std::string address = net::bindAddress(host);
  uint16_t xml_port = 0, data_port = 0;
  net::Socket xml = net::Socket::listen(address, xml_port);
  net::Socket data = net::Socket::listen(address, data_port);
  network::setTCPROSPort(data_port);
  own_uri = "http://" + (host.find(':') != std::string::npos ? "[" + host + "]" : host) + ":" +
            std::to_string(xml_port) + "/";
  net::Loop& loop = net::Loop::instance();
  loop.start();
  loop.accept(std::move(xml),
              [&loop](net::Socket socket) { loop.add(net::serveXmlRpc(std::move(socket), findMethod)); });
  loop.accept(std::move(data), acceptPeer);
}

bool bind(const std::string& method, const net::XmlRpcMethod& answer) {
  const std::lock_guard<std::mutex> lock(methods().mutex);
  return methods().by_name.emplace(method, answer).second;
}

void unbind(const std::string& method) {
  const std::lock_guard<std::mutex> lock(methods().mutex);
  methods().by_name.erase(method);
}

void stop() {
  clock_subscription.reset();
  clock_helper.reset();
  net::Loop::instance().stop();
}

void followClock() {
  static ImmediateQueue* const queue = new ImmediateQueue;
  SubscribeOptions options;
  options.init<rosgraph_msgs::Clock>("/clock", 1,
                                     [](const rosgraph_msgs::ClockConstPtr& message) { Time::setNow(message->clock); });
  options.callback_queue = queue;
  clock_helper = options.helper;
  clock_subscription = topics::subscribe(options);
}

}  // namespace server
}  // namespace ros
