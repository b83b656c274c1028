#include <algorithm>

#include "connection_header.h"
#include "datagrams.h"
#include "node.h"
#include "ros/init.h"
#include "ros/network.h"
#include "ros/this_node.h"
#include "topics.h"
#include "xml_rpc.h"

namespace ros {

void Subscription::connectInThread(const std::shared_ptr<PublisherLink>& link) {
  const std::shared_ptr<Subscription> self = shared_from_this();
  node::runInThread([self, link] {
    for (int pause = 100;; pause = std::min(2 * pause, 20000)) {
      {
        const std::lock_guard<std::mutex> lock(self->mutex_);
        if (!link->is_wanted || self->is_closed_) return;
      }
      try {
        self->connect(link);
        return;
      } catch (const std::exception& error) {
        if (isShuttingDown()) return;
        ROS_DEBUG("Connecting to %s for [%s] failed: %s", link->uri.c_str(), self->topic.c_str(), error.what());
      }
      if (!node::waitMs(pause)) return;
    }
  });
}

void Subscription::connect(const std::shared_ptr<PublisherLink>& link) {
  std::string host;
  uint32_t port = 0;
  if (!network::splitURI(link->uri, host, port)) throw net::NetError("'" + link->uri + "' is not an address");
  XmlRpc::XmlRpcValue arguments;
  arguments[0] = this_node::getName();
  arguments[1] = topic;
  XmlRpc::XmlRpcValue& protocols = arguments[2];
  protocols.setSize(0);
  TransportHints hints = hints_;
  if (hints.getTransports().empty()) hints.reliable();
  net::Socket socket;
  bool has_stream = false;
  for (const std::string& transport : hints.getTransports()) {
    XmlRpc::XmlRpcValue entry;
    if (transport == "UDP" && !socket.isOpen()) {
      uint16_t own_port = 0;
      socket = net::bindDatagrams(net::bindAddress(network::getHost()), own_port);
      const int size = hints.getMaxDatagramSize();
      entry[0] = std::string("UDPROS");
      entry[1] = net::headerValue(header());
      entry[2] = network::getHost();
      entry[3] = static_cast<int>(own_port);
      entry[4] = size > 0 ? std::min(std::max(size, net::kMinDatagramSize), net::kMaxDatagramSize) : net::kDatagramSize;
    } else if (transport == "TCP" && !has_stream) {
      has_stream = true;
      entry[0] = std::string("TCPROS");
    } else {
      continue;
    }
    protocols[protocols.size()] = entry;
  }
  if (!has_stream) protocols[protocols.size()][0] = std::string("TCPROS");  // publishers of rospy have nothing else
  const XmlRpc::XmlRpcValue answer = net::callXmlRpc(host, static_cast<uint16_t>(port), "requestTopic", arguments);
  if (static_cast<int>(answer[0]) != 1) throw net::NetError("the publisher refuses");
  const XmlRpc::XmlRpcValue& protocol = answer[2];
  if (protocol[0] == XmlRpc::XmlRpcValue("UDPROS") && socket.isOpen())
    return connectByDatagrams(link, protocol, std::move(socket));
  if (!has_stream)
    ROS_WARN("The publisher %s of topic [%s] does not speak UDPROS; its messages come by TCPROS", link->uri.c_str(),
             topic.c_str());
  connectByStream(link, protocol);
}

void Subscription::connectByStream(const std::shared_ptr<PublisherLink>& link, const XmlRpc::XmlRpcValue& protocol) {
  const int port = protocol[2];
  if (port <= 0 || port > 65535) throw net::NetError("the publisher names no port");
  net::Socket socket = net::Socket::connect(static_cast<std::string>(protocol[1]), static_cast<uint16_t>(port));
  M_string fields;
  try {
    fields = net::exchangeHeaders(socket, header());
  } catch (const net::NetError& error) {
    if (!isShuttingDown())
      ROS_ERROR("Connection to the publisher %s of topic [%s] is refused: %s", link->uri.c_str(), topic.c_str(),
                error.what());
    throw;
  }
  check(*link, fields);
  const auto connection = std::make_shared<net::FrameConnection>(std::move(socket));
  connection->max_frame = net::kMaxMessage;
  connection->on_frame = receiver(link, fields);
  watch(link, connection, "TCPROS");
}

void Subscription::connectByDatagrams(const std::shared_ptr<PublisherLink>& link, const XmlRpc::XmlRpcValue& protocol,
                                      net::Socket socket) {
  const XmlRpc::XmlRpcValue::BinaryData& bytes = protocol[5];
  const M_string fields = net::decodeHeader(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
  check(*link, fields);
  const uint32_t id = static_cast<uint32_t>(static_cast<int>(protocol[3]));
  const auto connection = std::make_shared<net::DatagramReceiver>(std::move(socket), id);
  connection->on_message = receiver(link, fields);
  watch(link, connection, "UDPROS");
}

void Subscription::check(const PublisherLink& link, const M_string& fields) const {
  if (accepts(net::field(fields, "md5sum"))) return;
  const std::string error = "md5sum is " + net::field(fields, "md5sum") + ", not " + md5sum();
  if (!isShuttingDown())
    ROS_ERROR("Connection to the publisher %s of topic [%s] is refused: %s", link.uri.c_str(), topic.c_str(),
              error.c_str());
  throw net::NetError(error);
}

Subscription::Receiver Subscription::receiver(const std::shared_ptr<PublisherLink>& link, const M_string& fields) {
  const auto header = boost::make_shared<M_string>(fields);
  const bool is_latched = net::field(fields, "latching") == "1";
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    link->header = header;
    link->is_latched = is_latched;
  }
  const std::weak_ptr<Subscription> weak = shared_from_this();
  return [weak, link, header, is_latched](const boost::shared_array<uint8_t>& bytes, uint32_t size) {
    const std::shared_ptr<Subscription> self = weak.lock();
    if (!self) return false;
    const SerializedMessage message(bytes, size);
    if (is_latched) {
      const std::lock_guard<std::mutex> lock(self->mutex_);
      link->last = message;
    }
    self->handleMessage(message, header);
    return true;
  };
}

void Subscription::watch(const std::shared_ptr<PublisherLink>& link, const std::shared_ptr<net::Connection>& connection,
                         const char* transport) {
  const std::weak_ptr<Subscription> weak = shared_from_this();
  connection->on_closed = [weak, link] {
    const std::shared_ptr<Subscription> self = weak.lock();
    if (!self) return;
    {
      const std::lock_guard<std::mutex> lock(self->mutex_);
      link->connection.reset();
      if (!link->is_wanted || self->is_closed_) return;
    }
    if (!isShuttingDown()) self->connectInThread(link);
  };
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!link->is_wanted || is_closed_) return;
    link->connection = connection;
    link->transport = transport;
  }
  if (net::Loop::instance().add(connection)) return;
  connection->on_closed = nullptr;
  const std::lock_guard<std::mutex> lock(mutex_);
  link->connection.reset();
  throw net::NetError("this node has too many connections");
}

}  // namespace ros
