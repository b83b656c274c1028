#pragma once

#include <boost/shared_ptr.hpp>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <typeinfo>
#include <vector>

#include "loop.h"
#include "ros/advertise_options.h"
#include "ros/callback_queue_interface.h"
#include "ros/serialized_message.h"
#include "ros/subscribe_options.h"
#include "xmlrpcpp/XmlRpcValue.h"

namespace ros {

class Subscription;

/** One subscriber of a publication: in another process, or in this one. */
class SubscriberLink {
 public:
  /** Link within this process; `local` is to be set. */
  SubscriberLink() = default;
  /** Link to another process. */
  SubscriberLink(std::shared_ptr<net::Connection> connection, const char* transport)
      : is_remote(true), transport(transport), connection_(std::move(connection)) {}

  void send(const SerializedMessage& message);
  void close(bool after_sending = false);
  /** Give up the connection, which has ended; another thread may be sending. */
  void release() { std::atomic_store(&connection_, std::shared_ptr<net::Connection>()); }

  const bool is_remote = false;
  const char* const transport = "INTRAPROCESS";
  std::string topic, subscriber;
  /** Host and port to which datagrams go; "" for a stream. */
  std::string address;
  std::weak_ptr<Subscription> local;
  boost::shared_ptr<M_string> local_header;
  size_t queue_size = 0;

 private:
  std::shared_ptr<net::Connection> connection_;
};

/** A topic that this node publishes, by one or several publishers. */
class Publication {
 public:
  /** What one publisher of the topic has of its own. */
  struct Callbacks {
    SubscriberStatusCallback connect, disconnect;
    CallbackQueueInterface* queue = nullptr;
    boost::weak_ptr<void const> tracked;
    bool is_tracked = false, is_latched = false;
    /** Last message of a latched publisher; it has no bytes before the first message. */
    SerializedMessage last;
  };

  explicit Publication(const AdvertiseOptions& options);

  void publish(const boost::shared_ptr<Callbacks>& publisher, const std::function<SerializedMessage()>& serialize,
               SerializedMessage& message);
  void addCallbacks(const boost::shared_ptr<Callbacks>& callbacks);
  void removeCallbacks(const boost::shared_ptr<Callbacks>& callbacks);
  /** Add a subscriber, which gets the header first, if there is one, then the last messages of latched publishers. */
  void addLink(const boost::shared_ptr<SubscriberLink>& link,
               const std::function<void()>& send_header = std::function<void()>());
  void removeLink(const boost::shared_ptr<SubscriberLink>& link);
  void closeLinks();
  /** True if one of the publishers is latched. */
  bool isLatched() const;
  /** Last messages of the latched publishers. */
  std::vector<SerializedMessage> latched() const;
  size_t linkCount() const;
  std::vector<boost::shared_ptr<SubscriberLink>> links() const;

  const std::string topic, md5sum, datatype, definition;
  const size_t queue_size;
  const bool has_header;
  /** Number of publishers, and of the topics that were advertised before. */
  int owners = 0;
  uint64_t order = 0;

 private:
  void notify(const boost::shared_ptr<Callbacks>& callbacks, const boost::shared_ptr<SubscriberLink>& link,
              bool is_new);
  mutable std::mutex mutex_;
  std::vector<boost::shared_ptr<SubscriberLink>> links_;
  std::vector<boost::shared_ptr<Callbacks>> callbacks_;
  uint32_t sequence_ = 0;
};

/** Messages that wait for one callback. */
class SubscriptionQueue;
class TopicStatistics;

/** A topic that this node subscribes to, by one or several subscribers. */
class Subscription : public std::enable_shared_from_this<Subscription> {
 public:
  Subscription(const SubscribeOptions& options, const std::shared_ptr<TopicStatistics>& statistics)
      : topic(options.topic),
        datatype(options.datatype),
        md5sum_(options.md5sum),
        hints_(options.transport_hints),
        statistics_(statistics) {}

  /** Add a subscriber's callback; it gets the last messages of latched publishers. */
  void addCallback(const SubscribeOptions& options);
  /** Remove the callback of a helper; true if none is left. */
  bool removeCallback(const SubscriptionCallbackHelperPtr& helper);
  /** Connect to new publishers, and drop those that are gone: not for an answer that may be older than an update. */
  void setPublishers(const std::vector<std::string>& uris, bool is_update);
  void connectLocally(const std::shared_ptr<Publication>& publication);
  /** End the connections to publishers; with `retries` they are made again. */
  void dropConnections(bool retries);
  void handleMessage(const SerializedMessage& message, const boost::shared_ptr<M_string>& header);
  void close();
  size_t publisherCount() const;
  /** Fields for the header of a connection to a publisher. */
  M_string header() const;
  std::string md5sum() const;
  /** True if a callback gets messages of another C++ class, which has to be made from bytes. */
  bool needsBytes(const std::type_info& sent) const;
  bool accepts(const std::string& md5sum) const;
  struct ConnectionState {
    std::string uri;
    const char* transport;
    bool is_open;
  };
  std::vector<ConnectionState> connections() const;

  bool hasCallbacks() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return !queues_.empty();
  }

  const std::string topic, datatype;

 private:
  /** Connection to one publisher. */
  struct PublisherLink {
    std::string uri;
    std::shared_ptr<net::Connection> connection;
    const char* transport = "TCPROS";
    boost::shared_ptr<M_string> header;
    SerializedMessage last;
    bool is_latched = false, is_wanted = true;
  };
  void connectInThread(const std::shared_ptr<PublisherLink>& link);
  /** Connect to a publisher; throws net::NetError. */
  void connect(const std::shared_ptr<PublisherLink>& link);
  /** Receive from a publisher that has answered requestTopic; throws net::NetError. */
  void connectByStream(const std::shared_ptr<PublisherLink>& link, const XmlRpc::XmlRpcValue& protocol);
  void connectByDatagrams(const std::shared_ptr<PublisherLink>& link, const XmlRpc::XmlRpcValue& protocol,
                          net::Socket socket);
  /** Check the header of a publisher; throws net::NetError. */
  void check(const PublisherLink& link, const M_string& fields) const;
  typedef std::function<bool(const boost::shared_array<uint8_t>&, uint32_t)> Receiver;
  /** Function that takes the messages of a link, for a publisher's header. */
  Receiver receiver(const std::shared_ptr<PublisherLink>& link, const M_string& fields);
  /** Watch the connection of a link. */
  void watch(const std::shared_ptr<PublisherLink>& link, const std::shared_ptr<net::Connection>& connection,
             const char* transport);

  mutable std::mutex mutex_;
  std::string md5sum_;
  std::map<std::string, std::shared_ptr<PublisherLink>> links_;
  std::vector<boost::shared_ptr<SubscriptionQueue>> queues_;
  bool is_closed_ = false, is_updated_ = false, has_no_delay_ = false;
  /** Of the first subscriber. */
  const TransportHints hints_;
  /** Statistics of its messages; null without the parameter /enable_statistics. */
  const std::shared_ptr<TopicStatistics> statistics_;
  std::weak_ptr<Publication> local_publication_;
  boost::shared_ptr<M_string> local_header_;
};

/** Topics of this node. */
namespace topics {

std::shared_ptr<Publication> advertise(const AdvertiseOptions& options,
                                       const boost::shared_ptr<Publication::Callbacks>& callbacks);
void unadvertise(const std::shared_ptr<Publication>& publication,
                 const boost::shared_ptr<Publication::Callbacks>& callbacks);
std::shared_ptr<Subscription> subscribe(const SubscribeOptions& options);
void unsubscribe(const std::shared_ptr<Subscription>& subscription, const SubscriptionCallbackHelperPtr& helper);
/** Answer the header of a subscriber of another process; false closes the connection. */
bool acceptSubscriber(const std::shared_ptr<net::FrameConnection>& connection, const M_string& header);
/** Send a topic by datagrams, to a subscriber's entry of UDPROS in requestTopic; returns the answer's parameters.
 *
 * Throws net::NetError, or XmlRpc::XmlRpcException. */
XmlRpc::XmlRpcValue acceptDatagramSubscriber(const XmlRpc::XmlRpcValue& protocol);
/** Fields for the header of a connection to a subscriber. */
M_string publicationHeader(const Publication& publication);
/** Handle the master's list of a topic's publishers. */
void publisherUpdate(const std::string& topic, const std::vector<std::string>& uris);
/** A topic of this node; null if there is none. */
std::shared_ptr<Publication> publication(const std::string& topic);
std::shared_ptr<Subscription> subscription(const std::string& topic);
/** End the connections to other nodes; a subscription with `retries` connects again. */
void dropConnections(bool retries);
V_string advertised();
V_string subscribed();
XmlRpc::XmlRpcValue busInfo();
XmlRpc::XmlRpcValue publications();
XmlRpc::XmlRpcValue subscriptions();
/** Unregister everything and close all connections. */
void shutdown();

}  // namespace topics
}  // namespace ros
