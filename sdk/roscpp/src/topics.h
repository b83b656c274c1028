#pragma once

#include <boost/shared_ptr.hpp>
#include <deque>
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
  std::string topic, subscriber;
  /** Connection to another process; null if `local` is set. */
  std::shared_ptr<net::FrameConnection> connection;
  std::weak_ptr<Subscription> local;
  boost::shared_ptr<M_string> local_header;
  size_t queue_size = 0;

  void send(const SerializedMessage& message);
};

/** A topic that this node publishes, by one or several publishers. */
class Publication {
 public:
  /** What one publisher of the topic has of its own. */
  struct Callbacks {
    SubscriberStatusCallback connect, disconnect;
    CallbackQueueInterface* queue;
    boost::weak_ptr<void const> tracked;
    bool is_tracked, is_latched;
    /** Last message of a latched publisher; it has no bytes before the first message. */
    SerializedMessage last;
  };

  explicit Publication(const AdvertiseOptions& options);

  void publish(const boost::shared_ptr<Callbacks>& publisher, const std::function<SerializedMessage()>& serialize,
               SerializedMessage& message);
  void addCallbacks(const boost::shared_ptr<Callbacks>& callbacks);
  void removeCallbacks(const boost::shared_ptr<Callbacks>& callbacks);
  void addLink(const boost::shared_ptr<SubscriberLink>& link);
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

/** A topic that this node subscribes to, by one or several subscribers. */
class Subscription : public std::enable_shared_from_this<Subscription> {
 public:
  Subscription(const std::string& topic, const std::string& md5sum, const std::string& datatype)
      : topic(topic), datatype(datatype), md5sum_(md5sum) {}

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
  /** Address, publisher's name and state of each connection. */
  std::vector<std::pair<std::string, bool>> connections() const;

  bool hasCallbacks() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return !queues_.empty();
  }

  const std::string topic, datatype;

 private:
  /** Connection to one publisher. */
  struct PublisherLink {
    std::string uri;
    std::shared_ptr<net::FrameConnection> connection;
    boost::shared_ptr<M_string> header;
    SerializedMessage last;
    bool is_latched = false, is_wanted = true;
  };
  void connectInThread(const std::shared_ptr<PublisherLink>& link);
  /** Connect to a publisher; throws net::NetError. */
  void connect(const std::shared_ptr<PublisherLink>& link);

  mutable std::mutex mutex_;
  std::string md5sum_;
  std::map<std::string, std::shared_ptr<PublisherLink>> links_;
  std::vector<boost::shared_ptr<SubscriptionQueue>> queues_;
  bool is_closed_ = false, is_updated_ = false, has_no_delay_ = false;
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
