#include "ros/node_handle.h"

#include <atomic>
#include <mutex>

#include "node.h"
#include "ros/callback_queue.h"
#include "ros/this_node.h"
#include "ros/topic.h"
#include "service_client_impl.h"
#include "services.h"
#include "topics.h"

namespace ros {
namespace {

std::mutex counting;
int handle_count = 0;
bool is_started_by_handle = false;
/** The last handle ended the node, and the next one starts it again; after shutdown(), init() comes first. */
bool is_ended_by_handle = false;

}  // namespace

/** Publisher, subscriber or server. Its last copy or its NodeHandle ends it; until then the node runs. */
struct Publisher::Impl {
  std::shared_ptr<Publication> publication;
  boost::shared_ptr<Publication::Callbacks> callbacks;
  std::string topic;
  NodeHandle node;
  bool is_ended = false;
  ~Impl() { end(); }
  void end() {
    if (!is_ended) topics::unadvertise(publication, callbacks);
    is_ended = true;
  }
};

struct Subscriber::Impl {
  std::shared_ptr<Subscription> subscription;
  SubscriptionCallbackHelperPtr helper;
  std::string topic;
  NodeHandle node;
  bool is_ended = false;
  ~Impl() { end(); }
  void end() {
    if (!is_ended) topics::unsubscribe(subscription, helper);
    is_ended = true;
  }
};

struct ServiceServer::Impl {
  std::shared_ptr<services::Offer> offer;
  std::string service;
  NodeHandle node;
  bool is_ended = false;
  ~Impl() { end(); }
  void end() {
    if (!is_ended) services::unadvertise(offer);
    is_ended = true;
  }
};

struct NodeHandle::Endpoints {
  std::mutex mutex;
  std::vector<std::function<bool(bool)>> parts;  // ends a part, if asked to; false once it is gone
  std::atomic<bool> is_shut_down{false};

  template <class Impl>
  void add(const boost::shared_ptr<Impl>& impl) {
    const boost::weak_ptr<Impl> weak = impl;
    const std::lock_guard<std::mutex> lock(mutex);
    std::vector<std::function<bool(bool)>> present;
    for (auto& part : parts)
      if (part(false)) present.push_back(std::move(part));
    parts.swap(present);
    parts.emplace_back([weak](bool ends) {
      const boost::shared_ptr<Impl> part = weak.lock();
      if (part && ends) part->end();
      return static_cast<bool>(part);
    });
  }
};

NodeHandle::NodeHandle(const std::string& ns, const M_string& remappings) : namespace_(this_node::getNamespace()) {
  construct(!ns.empty() && ns[0] == '~' ? names::resolve(ns) : ns);
  initRemappings(remappings);
  unresolved_namespace_ = ns;
}

NodeHandle::NodeHandle(const NodeHandle& parent, const std::string& ns) : NodeHandle(parent, ns, M_string()) {}

NodeHandle::NodeHandle(const NodeHandle& parent, const std::string& ns, const M_string& remappings)
    : namespace_(parent.namespace_),
      remappings_(parent.remappings_),
      unresolved_remappings_(parent.unresolved_remappings_),
      queue_(parent.queue_) {
  // Within another namespace, a name may begin with a digit.
  construct(ns.empty() || ns[0] == '/' || ns[0] == '~' ? ns : names::append(namespace_, ns));
  initRemappings(remappings);
  unresolved_namespace_ = ns;
}

NodeHandle::NodeHandle(const NodeHandle& rhs)
    : namespace_(rhs.namespace_),
      remappings_(rhs.remappings_),
      unresolved_remappings_(rhs.unresolved_remappings_),
      queue_(rhs.queue_) {
  construct(rhs.namespace_);
  unresolved_namespace_ = rhs.unresolved_namespace_;
}

NodeHandle& NodeHandle::operator=(const NodeHandle& rhs) {
  namespace_ = rhs.namespace_;
  unresolved_namespace_ = rhs.unresolved_namespace_;
  remappings_ = rhs.remappings_;
  unresolved_remappings_ = rhs.unresolved_remappings_;
  queue_ = rhs.queue_;
  return *this;
}

NodeHandle::~NodeHandle() {
  bool is_last = false;
  {
    const std::lock_guard<std::mutex> lock(counting);
    is_last = --handle_count == 0 && is_started_by_handle;
    if (is_last && ros::isStarted() && !ros::isShuttingDown()) is_ended_by_handle = true;
  }
  if (is_last) ros::shutdown();
}

void NodeHandle::construct(const std::string& ns) {
  if (!ros::isInitialized()) {
    ROS_FATAL("You must call ros::init() before creating the first NodeHandle");
    ROS_BREAK();
  }
  namespace_ = resolveName(ns, true);
  endpoints_ = boost::make_shared<Endpoints>();
  bool starts = false;
  {
    const std::lock_guard<std::mutex> lock(counting);
    starts = handle_count++ == 0 && !ros::isStarted() && (is_ended_by_handle || !ros::isShuttingDown());
    if (starts) is_ended_by_handle = false;
    is_started_by_handle |= starts;
  }
  if (starts) ros::start();
}

void NodeHandle::initRemappings(const M_string& remappings) {
  for (const auto& entry : remappings) {
    remappings_[resolveName(entry.first, false)] = resolveName(entry.second, false);
    unresolved_remappings_[entry.first] = entry.second;
  }
}

CallbackQueueInterface* NodeHandle::globalQueue() { return getGlobalCallbackQueue(); }

std::string NodeHandle::resolveName(const std::string& name, bool remap) const {
  std::string error;
  if (!names::validate(name, error)) throw InvalidNameException(error);
  if (name.empty()) return namespace_;
  if (name[0] == '~')
    throw InvalidNameException(
        "Using ~ names with NodeHandle methods is not allowed.  If you want to use private names "
        "with the NodeHandle interface, construct a NodeHandle using a private name as its "
        "namespace. e.g. ros::NodeHandle nh(\"~\");  nh.getParam(\"my_private_name\"); (name = [" +
        name + "])");
  const std::string absolute = names::clean(name[0] == '/' ? name : names::append(namespace_, name));
  if (!remap) return names::resolve(absolute, false);
  const M_string::const_iterator found = remappings_.find(absolute);
  return found != remappings_.end() ? found->second : names::resolve(names::remap(absolute), false);
}

Publisher NodeHandle::advertise(AdvertiseOptions& options) {
  options.topic = resolveName(options.topic);
  if (!options.callback_queue) options.callback_queue = getCallbackQueue();
  const auto callbacks = boost::make_shared<Publication::Callbacks>();
  callbacks->connect = options.connect_cb;
  callbacks->disconnect = options.disconnect_cb;
  callbacks->queue = options.callback_queue;
  callbacks->tracked = options.tracked_object;
  callbacks->is_tracked = static_cast<bool>(options.tracked_object);
  callbacks->is_latched = options.latch;
  const std::shared_ptr<Publication> publication = topics::advertise(options, callbacks);
  if (!publication) return Publisher();
  const auto impl = boost::make_shared<Publisher::Impl>();
  impl->publication = publication;
  impl->callbacks = callbacks;
  impl->topic = options.topic;
  endpoints_->add(impl);
  return Publisher(impl);
}

Subscriber NodeHandle::subscribe(SubscribeOptions& options) {
  options.topic = resolveName(options.topic);
  if (!options.callback_queue) options.callback_queue = getCallbackQueue();
  const auto impl = boost::make_shared<Subscriber::Impl>();
  impl->helper = options.helper;
  impl->topic = options.topic;
  impl->is_ended = true;  // nothing to end until subscribe returns: it may throw
  impl->subscription = topics::subscribe(options);
  impl->is_ended = false;
  endpoints_->add(impl);
  return Subscriber(impl);
}

ServiceServer NodeHandle::advertiseService(AdvertiseServiceOptions& options) {
  options.service = resolveName(options.service);
  if (!options.callback_queue) options.callback_queue = getCallbackQueue();
  const std::shared_ptr<services::Offer> offer = services::advertise(options);
  if (!offer) return ServiceServer();
  const auto impl = boost::make_shared<ServiceServer::Impl>();
  impl->offer = offer;
  impl->service = options.service;
  endpoints_->add(impl);
  return ServiceServer(impl);
}

ServiceClient NodeHandle::serviceClient(ServiceClientOptions& options) {
  options.service = resolveName(options.service);
  const auto impl = boost::make_shared<ServiceClient::Impl>();
  impl->name = options.service;
  impl->md5sum = options.md5sum;
  impl->is_persistent = options.persistent;
  impl->header = options.header;
  return ServiceClient(impl);
}

Timer NodeHandle::createTimer(TimerOptions& options) const {
  if (!options.callback_queue) options.callback_queue = getCallbackQueue();
  return Timer(options);
}
WallTimer NodeHandle::createWallTimer(WallTimerOptions& options) const {
  if (!options.callback_queue) options.callback_queue = getCallbackQueue();
  return WallTimer(options);
}
SteadyTimer NodeHandle::createSteadyTimer(SteadyTimerOptions& options) const {
  if (!options.callback_queue) options.callback_queue = getCallbackQueue();
  return SteadyTimer(options);
}

void NodeHandle::shutdown() {
  endpoints_->is_shut_down = true;
  std::vector<std::function<bool(bool)>> parts;
  {
    const std::lock_guard<std::mutex> lock(endpoints_->mutex);
    parts.swap(endpoints_->parts);
  }
  for (const auto& part : parts) part(true);
}

bool NodeHandle::ok() const { return ros::ok() && !endpoints_->is_shut_down; }

// Handles

void Publisher::shutdown() {
  if (impl_) impl_->end();
}
bool Publisher::isValid() const { return impl_ && !impl_->is_ended; }
std::string Publisher::getTopic() const { return impl_ ? impl_->topic : ""; }
uint32_t Publisher::getNumSubscribers() const {
  return isValid() ? static_cast<uint32_t>(impl_->publication->linkCount()) : 0;
}
bool Publisher::isLatched() const { return isValid() && impl_->callbacks->is_latched; }

bool Publisher::accepts(const char* md5sum, const char* datatype) const {
  if (!isValid()) {
    ROS_ERROR_ONCE("Call to publish() on an invalid Publisher (topic [%s])", getTopic().c_str());
    return false;
  }
  const Publication& publication = *impl_->publication;
  if (publication.md5sum == "*" || std::string("*") == md5sum || publication.md5sum == md5sum) return true;
  ROS_ERROR_ONCE("Trying to publish message of type [%s/%s] on a publisher with type [%s/%s]", datatype, md5sum,
                 publication.datatype.c_str(), publication.md5sum.c_str());
  return false;
}

void Publisher::publish(const std::function<SerializedMessage()>& serialize, SerializedMessage& message) const {
  impl_->publication->publish(impl_->callbacks, serialize, message);
}

void Subscriber::shutdown() {
  if (impl_) impl_->end();
}
bool Subscriber::isValid() const { return impl_ && !impl_->is_ended; }
std::string Subscriber::getTopic() const { return impl_ ? impl_->topic : ""; }
uint32_t Subscriber::getNumPublishers() const {
  return isValid() ? static_cast<uint32_t>(impl_->subscription->publisherCount()) : 0;
}

void ServiceServer::shutdown() {
  if (impl_) impl_->end();
}
bool ServiceServer::isValid() const { return impl_ && !impl_->is_ended; }
std::string ServiceServer::getService() const { return impl_ ? impl_->service : ""; }

namespace this_node {
void getAdvertisedTopics(V_string& topics) { topics = topics::advertised(); }
void getSubscribedTopics(V_string& topics) { topics = topics::subscribed(); }
}  // namespace this_node

namespace topic {

void waitForMessageImpl(SubscribeOptions& options, const boost::function<bool()>& received, NodeHandle& handle,
                        Duration timeout) {
  CallbackQueue queue;
  options.callback_queue = &queue;
  const Subscriber subscriber = handle.subscribe(options);
  const Time end = Time::now() + timeout;
  while (!received() && handle.ok()) {
    if (timeout > Duration::ZERO && Time::now() >= end) return;
    queue.callAvailable(WallDuration(timeout.isZero() ? 0.1 : 0.01));
  }
}

}  // namespace topic
}  // namespace ros
