#include <algorithm>
#include <boost/enable_shared_from_this.hpp>

#include "connection_header.h"
#include "node.h"
#include "ros/this_node.h"
#include "topic_statistics.h"
#include "topics.h"

namespace ros {
namespace {

/** A received message, which is deserialized at most once for all callbacks of a type. */
class LazyMessage {
 public:
  LazyMessage(const SubscriptionCallbackHelperPtr& helper, const SerializedMessage& message,
              const boost::shared_ptr<M_string>& header)
      : helper_(helper), serialized_(message), header_(header) {}

  VoidConstPtr get() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (message_ || is_broken_) return message_;
    if (serialized_.message && *serialized_.type_info == helper_->getTypeInfo()) return message_ = serialized_.message;
    if (!serialized_.buf) return VoidConstPtr();
    SubscriptionCallbackHelperDeserializeParams params;
    params.buffer = serialized_.message_start;
    params.length = static_cast<uint32_t>(serialized_.num_bytes -
                                          static_cast<size_t>(serialized_.message_start - serialized_.buf.get()));
    params.connection_header = header_;
    try {
      message_ = helper_->deserialize(params);
    } catch (const std::exception& error) {
      is_broken_ = true;
      ROS_ERROR("Exception thrown when deserializing message of length [%u] from [%s]: %s", params.length,
                net::field(*header_, "callerid").c_str(), error.what());
    }
    serialized_ = SerializedMessage();
    return message_;
  }

 private:
  std::mutex mutex_;
  SubscriptionCallbackHelperPtr helper_;
  SerializedMessage serialized_;
  boost::shared_ptr<M_string> header_;
  VoidConstPtr message_;
  bool is_broken_ = false;
};

Time nowOrZero() { return Time::isValid() ? Time::now() : Time(); }

}  // namespace

class SubscriptionQueue : public CallbackInterface, public boost::enable_shared_from_this<SubscriptionQueue> {
 public:
  explicit SubscriptionQueue(const SubscribeOptions& options)
      : helper(options.helper),
        queue(options.callback_queue),
        tracked_(options.tracked_object),
        is_tracking_(options.tracked_object),
        limit_(options.queue_size),
        is_concurrent_(options.allow_concurrent_callbacks) {}

  /** Add a message; true if the oldest one is dropped for it. */
  bool push(const std::shared_ptr<LazyMessage>& message, const boost::shared_ptr<M_string>& header, bool copies) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (limit_ > 0 && items_.size() >= limit_) {
        items_.pop_front();
        items_.push_back({message, header, copies, nowOrZero()});
        return true;  // the queued call for the dropped message is now for this one
      }
      items_.push_back({message, header, copies, nowOrZero()});
    }
    queue->addCallback(shared_from_this(), reinterpret_cast<uint64_t>(helper.get()));
    return false;
  }

  bool ready() override {
    const std::lock_guard<std::mutex> lock(mutex_);
    return is_concurrent_ || !is_called_;
  }

  CallResult call() override {
    Item item;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (is_called_ && !is_concurrent_) return TryAgain;
      if (items_.empty()) return Invalid;
      item = items_.front();
      items_.pop_front();
      is_called_ = true;
    }
    const std::shared_ptr<void> finish(nullptr, [this](void*) {
      const std::lock_guard<std::mutex> lock(mutex_);
      is_called_ = false;
    });
    const VoidConstPtr tracked = tracked_.lock();
    if (is_tracking_ && !tracked) return Invalid;
    const VoidConstPtr message = item.message->get();
    if (!message) return Invalid;
    SubscriptionCallbackHelperCallParams params;
    params.event = MessageEvent<void const>(message, item.header, item.received, item.copies,
                                            MessageEvent<void const>::CreateFunction());
    helper->call(params);
    return Success;
  }

  const SubscriptionCallbackHelperPtr helper;
  CallbackQueueInterface* const queue;

 private:
  struct Item {
    std::shared_ptr<LazyMessage> message;
    boost::shared_ptr<M_string> header;
    bool copies = true;
    Time received;
  };
  std::mutex mutex_;
  std::deque<Item> items_;
  boost::weak_ptr<void const> tracked_;
  const bool is_tracking_;
  const size_t limit_;
  const bool is_concurrent_;
  bool is_called_ = false;
};

void Subscription::addCallback(const SubscribeOptions& options) {
  const auto queue = boost::make_shared<SubscriptionQueue>(options);
  std::vector<std::shared_ptr<PublisherLink>> latched;
  std::shared_ptr<Publication> local;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    queues_.push_back(queue);
    has_no_delay_ |= TransportHints(options.transport_hints).getTCPNoDelay();
    if (md5sum_ == "*") md5sum_ = options.md5sum;
    for (const auto& entry : links_)
      if (entry.second->is_latched && entry.second->last.buf) latched.push_back(entry.second);
    local = local_publication_.lock();
  }
  for (const auto& link : latched)
    queue->push(std::make_shared<LazyMessage>(options.helper, link->last, link->header), link->header, true);
  for (const SerializedMessage& last : local ? local->latched() : std::vector<SerializedMessage>())
    queue->push(std::make_shared<LazyMessage>(options.helper, last, local_header_), local_header_, true);
}

bool Subscription::removeCallback(const SubscriptionCallbackHelperPtr& helper) {
  boost::shared_ptr<SubscriptionQueue> removed;
  bool is_last = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found =
        std::find_if(queues_.begin(), queues_.end(), [&](const auto& queue) { return queue->helper == helper; });
    if (found == queues_.end()) return false;
    removed = *found;
    queues_.erase(found);
    is_last = queues_.empty();
  }
  if (CallbackQueueInterface::exists(removed->queue))
    removed->queue->removeByID(reinterpret_cast<uint64_t>(helper.get()));
  return is_last;
}

void Subscription::handleMessage(const SerializedMessage& message, const boost::shared_ptr<M_string>& header) {
  std::vector<boost::shared_ptr<SubscriptionQueue>> queues;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    queues = queues_;
  }
  // Callbacks that may change the message get copies, unless there is one: it gets a publisher's own object, as in
  // roscpp.
  const bool copies = queues.size() > 1;
  bool is_dropped = false;
  std::vector<std::pair<const std::type_info*, std::shared_ptr<LazyMessage>>> by_type;
  for (const auto& queue : queues) {
    const std::type_info& type = queue->helper->getTypeInfo();
    auto found = std::find_if(by_type.begin(), by_type.end(), [&](const auto& entry) { return *entry.first == type; });
    if (found == by_type.end())
      found = by_type.insert(found, {&type, std::make_shared<LazyMessage>(queue->helper, message, header)});
    is_dropped |= queue->push(found->second, header, copies);
  }
  if (statistics_) statistics_->count(net::field(*header, "callerid"), message, is_dropped);
}

void Subscription::setPublishers(const std::vector<std::string>& uris, bool is_update) {
  std::vector<std::shared_ptr<PublisherLink>> added;
  std::vector<std::shared_ptr<net::Connection>> dropped;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (is_closed_) return;
    const bool drops = is_update || !is_updated_;
    is_updated_ |= is_update;
    for (auto entry = links_.begin(); entry != links_.end();) {
      if (!drops || std::find(uris.begin(), uris.end(), entry->first) != uris.end()) {
        ++entry;
        continue;
      }
      entry->second->is_wanted = false;
      if (entry->second->connection) dropped.push_back(entry->second->connection);
      entry = links_.erase(entry);
    }
    for (const std::string& uri : uris) {
      if (uri == node::uri() || links_.count(uri)) continue;
      auto link = std::make_shared<PublisherLink>();
      link->uri = uri;
      links_[uri] = link;
      added.push_back(link);
    }
  }
  for (const auto& connection : dropped) connection->close();
  for (const auto& link : added) connectInThread(link);
}

void Subscription::connectLocally(const std::shared_ptr<Publication>& publication) {
  const auto link = boost::make_shared<SubscriberLink>();
  link->topic = topic;
  link->subscriber = this_node::getName();
  link->local = shared_from_this();
  link->local_header = boost::make_shared<M_string>(topics::publicationHeader(*publication));
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (local_publication_.lock() == publication) return;
    local_publication_ = publication;
    local_header_ = link->local_header;
  }
  publication->addLink(link);
}

void Subscription::dropConnections(bool retries) {
  std::vector<std::shared_ptr<net::Connection>> connections;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& entry : links_) {
      entry.second->is_wanted = retries;
      if (entry.second->connection) connections.push_back(entry.second->connection);
    }
  }
  for (const auto& connection : connections) connection->close();
}

void Subscription::close() {
  std::vector<std::shared_ptr<net::Connection>> connections;
  std::shared_ptr<Publication> local;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_closed_ = true;
    for (const auto& entry : links_) {
      entry.second->is_wanted = false;
      if (entry.second->connection) connections.push_back(entry.second->connection);
    }
    links_.clear();
    local = local_publication_.lock();
  }
  for (const auto& connection : connections) connection->close();
  if (!local) return;
  for (const auto& link : local->links())
    if (link->local.lock().get() == this) local->removeLink(link);
}

size_t Subscription::publisherCount() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto count = std::count_if(links_.begin(), links_.end(), [](const auto& e) { return e.second->connection; });
  return static_cast<size_t>(count) + (local_publication_.expired() ? 0 : 1);
}

M_string Subscription::header() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return {{"callerid", this_node::getName()},
          {"md5sum", md5sum_},
          {"tcp_nodelay", has_no_delay_ ? "1" : "0"},
          {"topic", topic},
          {"type", datatype}};
}

std::string Subscription::md5sum() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return md5sum_;
}

bool Subscription::needsBytes(const std::type_info& sent) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::any_of(queues_.begin(), queues_.end(),
                     [&](const auto& queue) { return queue->helper->getTypeInfo() != sent; });
}

bool Subscription::accepts(const std::string& md5sum) const {
  const std::string own = this->md5sum();
  return own == "*" || md5sum == "*" || own == md5sum;
}

std::vector<Subscription::ConnectionState> Subscription::connections() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<ConnectionState> all;
  for (const auto& entry : links_)
    all.push_back({entry.first, entry.second->transport, static_cast<bool>(entry.second->connection)});
  return all;
}

}  // namespace ros
