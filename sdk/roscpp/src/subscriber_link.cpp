#include <algorithm>
#include <random>

#include "connection_header.h"
#include "datagrams.h"
#include "node.h"
#include "ros/init.h"
#include "ros/network.h"
#include "ros/single_subscriber_publisher.h"
#include "ros/this_node.h"
#include "topics.h"

namespace ros {

std::string SingleSubscriberPublisher::getTopic() const { return link_->topic; }
std::string SingleSubscriberPublisher::getSubscriberName() const { return link_->subscriber; }
void SingleSubscriberPublisher::send(const SerializedMessage& message) const { link_->send(message); }

void SubscriberLink::send(const SerializedMessage& message) {
  if (is_remote) {
    if (const std::shared_ptr<net::Connection> open = std::atomic_load(&connection_))
      open->send(message.buf, message.num_bytes, queue_size);
  } else if (const std::shared_ptr<Subscription> subscription = local.lock()) {
    subscription->handleMessage(message, local_header);
  }
}

void SubscriberLink::close(bool after_sending) {
  if (const std::shared_ptr<net::Connection> open = std::atomic_load(&connection_)) open->close(after_sending);
}

namespace topics {
namespace {

/** Reason to refuse the header of a subscriber; "" if there is none. */
std::string refusal(const std::shared_ptr<Publication>& publication, const M_string& header) {
  const std::string &topic = net::field(header, "topic"), &md5sum = net::field(header, "md5sum");
  const std::string &type = net::field(header, "type"), &caller = net::field(header, "callerid");
  if (!publication) return "received a connection for a nonexistent topic [" + topic + "] from [" + caller + "]";
  if (md5sum.empty() || type.empty()) return "the header of a subscriber needs md5sum and type";
  if (md5sum != "*" && publication->md5sum != "*" && md5sum != publication->md5sum)
    return "Client [" + caller + "] wants topic " + topic + " to have datatype/md5sum [" + type + "/" + md5sum +
           "], but our version has [" + publication->datatype + "/" + publication->md5sum + "]. Dropping connection.";
  return "";
}

boost::shared_ptr<SubscriberLink> makeLink(const std::shared_ptr<Publication>& publication, const M_string& header,
                                           const std::shared_ptr<net::Connection>& connection, const char* transport) {
  const auto link = boost::make_shared<SubscriberLink>(connection, transport);
  link->topic = publication->topic;
  link->subscriber = net::field(header, "callerid");
  link->queue_size = publication->queue_size;
  const std::weak_ptr<Publication> weak = publication;
  connection->on_closed = [weak, link] {
    if (const std::shared_ptr<Publication> owner = weak.lock()) owner->removeLink(link);
    link->release();
  };
  return link;
}

/** Send a topic to the host and port that a subscriber has named; the host's name may take long to resolve. */
void sendDatagrams(const std::shared_ptr<Publication>& publication, const M_string& header, net::Socket socket,
                   const std::string& host, uint16_t port, uint32_t id, int size) {
  try {
    net::connectDatagrams(socket, host, port);
    if (topics::publication(publication->topic) != publication) return;
    const auto sender = std::make_shared<net::DatagramSender>(std::move(socket), id, size);
    const auto link = makeLink(publication, header, sender, "UDPROS");
    link->address = host + ":" + std::to_string(port);
    for (const auto& other : publication->links())
      if (other->address == link->address) other->close();
    if (!net::Loop::instance().add(sender)) {
      sender->on_closed = nullptr;
      throw net::NetError("this node has too many connections");
    }
    publication->addLink(link);
  } catch (const net::NetError& error) {
    if (!isShuttingDown())
      ROS_ERROR("Sending topic [%s] to [%s] by UDPROS failed: %s", publication->topic.c_str(),
                net::field(header, "callerid").c_str(), error.what());
  }
}

}  // namespace

M_string publicationHeader(const Publication& publication) {
  return {{"callerid", this_node::getName()}, {"latching", publication.isLatched() ? "1" : "0"},
          {"md5sum", publication.md5sum},     {"message_definition", publication.definition},
          {"topic", publication.topic},       {"type", publication.datatype}};
}

bool acceptSubscriber(const std::shared_ptr<net::FrameConnection>& connection, const M_string& header) {
  const std::shared_ptr<Publication> publication = topics::publication(net::field(header, "topic"));
  const std::string error = refusal(publication, header);
  if (!error.empty()) {
    if (!isShuttingDown()) ROS_ERROR("%s", error.c_str());
    connection->send(net::encodeHeader({{"error", error}}));
    connection->close(true);
    return true;
  }
  connection->max_frame = 0;  // after its header, a subscriber sends nothing
  connection->on_frame = nullptr;
  const std::vector<uint8_t> own_header = net::encodeHeader(publicationHeader(*publication));
  publication->addLink(makeLink(publication, header, connection, "TCPROS"), [&] { connection->send(own_header); });
  return true;
}

XmlRpc::XmlRpcValue acceptDatagramSubscriber(const XmlRpc::XmlRpcValue& protocol) {
  const XmlRpc::XmlRpcValue::BinaryData& bytes = protocol[1];
  const M_string header = net::decodeHeader(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
  const std::shared_ptr<Publication> publication = topics::publication(net::field(header, "topic"));
  const std::string error = refusal(publication, header);
  if (!error.empty()) throw net::NetError(error);
  const std::string host = protocol[2];
  const int port = protocol[3];
  const int size = std::min(static_cast<int>(protocol[4]), net::kMaxDatagramSize);
  if (port < 1 || port > 65535) throw net::NetError("UDPROS: " + std::to_string(port) + " is not a port");
  if (size < net::kMinDatagramSize)
    throw net::NetError("UDPROS: datagrams have at least " + std::to_string(net::kMinDatagramSize) + " bytes, not " +
                        std::to_string(size));
  uint16_t own_port = 0;
  const auto socket = std::make_shared<net::Socket>(net::bindDatagrams(net::bindAddress(network::getHost()), own_port));
  const uint32_t id = std::random_device()() & 0x7fffffff;
  node::runInThread(
      [=] { sendDatagrams(publication, header, std::move(*socket), host, static_cast<uint16_t>(port), id, size); });
  XmlRpc::XmlRpcValue answer;
  answer[0] = std::string("UDPROS");
  answer[1] = network::getHost();
  answer[2] = static_cast<int>(own_port);
  answer[3] = static_cast<int>(id);
  answer[4] = size;
  answer[5] = net::headerValue(publicationHeader(*publication));
  return answer;
}

}  // namespace topics
}  // namespace ros
