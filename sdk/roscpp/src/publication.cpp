#include <algorithm>
#include <cstring>

#include "ros/single_subscriber_publisher.h"
#include "ros/this_node.h"
#include "topics.h"

namespace ros {
namespace {

/** Calls a publisher's callback for a new subscriber, or for one that has left. */
class StatusCall : public CallbackInterface {
 public:
  StatusCall(const boost::shared_ptr<Publication::Callbacks>& callbacks, const boost::shared_ptr<SubscriberLink>& link,
             bool is_new)
      : callbacks_(callbacks), link_(link), is_new_(is_new) {}
  CallResult call() override {
    const VoidConstPtr tracked = callbacks_->tracked.lock();
    if (callbacks_->is_tracked && !tracked) return Invalid;
    const SingleSubscriberPublisher publisher(link_);
    (is_new_ ? callbacks_->connect : callbacks_->disconnect)(publisher);
    return Success;
  }

 private:
  boost::shared_ptr<Publication::Callbacks> callbacks_;
  boost::shared_ptr<SubscriberLink> link_;
  bool is_new_;
};

}  // namespace

Publication::Publication(const AdvertiseOptions& options)
    : topic(options.topic),
      md5sum(options.md5sum),
      datatype(options.datatype),
      definition(options.message_definition),
      queue_size(options.queue_size),
      has_header(options.has_header) {}

void Publication::publish(const boost::shared_ptr<Callbacks>& publisher,
                          const std::function<SerializedMessage()>& serialize, SerializedMessage& message) {
  std::vector<boost::shared_ptr<SubscriberLink>> links;
  uint32_t sequence = 0;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    sequence = ++sequence_;
    links = links_;
  }
  const bool has_remote = std::any_of(links.begin(), links.end(), [](const auto& link) { return link->is_remote; });
  const bool needs_bytes = std::any_of(links.begin(), links.end(), [&message](const auto& link) {
    const std::shared_ptr<Subscription> subscription = link->local.lock();
    return subscription && (!message.message || subscription->needsBytes(*message.type_info));
  });
  if (has_remote || publisher->is_latched || needs_bytes) {
    const SerializedMessage bytes = serialize();
    message.buf = bytes.buf;
    message.num_bytes = bytes.num_bytes;
    message.message_start = bytes.message_start;
    if (has_header && message.num_bytes >= 8) std::memcpy(message.message_start, &sequence, sizeof(sequence));
  }
  if (publisher->is_latched) {
    const std::lock_guard<std::mutex> lock(mutex_);
    publisher->last = message;
    publisher->last.message.reset();  // the program may change the object
    publisher->last.type_info = nullptr;
    links = links_;  // whoever connects from here on gets the message as the last one
  }
  for (const auto& link : links) link->send(message);
}

void Publication::notify(const boost::shared_ptr<Callbacks>& callbacks, const boost::shared_ptr<SubscriberLink>& link,
                         bool is_new) {
  if (!(is_new ? callbacks->connect : callbacks->disconnect)) return;
  callbacks->queue->addCallback(boost::make_shared<StatusCall>(callbacks, link, is_new),
                                reinterpret_cast<uint64_t>(callbacks.get()));
}

void Publication::addCallbacks(const boost::shared_ptr<Callbacks>& callbacks) {
  const std::vector<boost::shared_ptr<SubscriberLink>> present = links();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    callbacks_.push_back(callbacks);
  }
  for (const auto& link : present) notify(callbacks, link, true);
}

void Publication::removeCallbacks(const boost::shared_ptr<Callbacks>& callbacks) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    callbacks_.erase(std::remove(callbacks_.begin(), callbacks_.end(), callbacks), callbacks_.end());
  }
  if (CallbackQueueInterface::exists(callbacks->queue))
    callbacks->queue->removeByID(reinterpret_cast<uint64_t>(callbacks.get()));
}

void Publication::addLink(const boost::shared_ptr<SubscriberLink>& link, const std::function<void()>& send_header) {
  std::vector<boost::shared_ptr<Callbacks>> callbacks;
  {
    // Locked while the header is sent: what the peer's answer makes other threads publish has to reach it.
    const std::lock_guard<std::mutex> lock(mutex_);
    if (send_header) send_header();
    links_.push_back(link);
    callbacks = callbacks_;
    for (const auto& entry : callbacks_)
      if (link->is_remote && entry->last.buf) link->send(entry->last);
  }
  for (const SerializedMessage& last : link->is_remote ? std::vector<SerializedMessage>() : latched()) link->send(last);
  for (const auto& entry : callbacks) notify(entry, link, true);
}

void Publication::removeLink(const boost::shared_ptr<SubscriberLink>& link) {
  std::vector<boost::shared_ptr<Callbacks>> callbacks;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = std::find(links_.begin(), links_.end(), link);
    if (found == links_.end()) return;
    links_.erase(found);
    callbacks = callbacks_;
  }
  for (const auto& entry : callbacks) notify(entry, link, false);
}

void Publication::closeLinks() {
  for (const auto& link : links())
    if (link->is_remote) link->close(true);
    else removeLink(link);
}

bool Publication::isLatched() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::any_of(callbacks_.begin(), callbacks_.end(), [](const auto& entry) { return entry->is_latched; });
}

std::vector<SerializedMessage> Publication::latched() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<SerializedMessage> messages;
  for (const auto& entry : callbacks_)
    if (entry->last.buf) messages.push_back(entry->last);
  return messages;
}

size_t Publication::linkCount() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return links_.size();
}

std::vector<boost::shared_ptr<SubscriberLink>> Publication::links() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return links_;
}

}  // namespace ros
