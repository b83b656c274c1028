#include "topics.h"

#include <algorithm>

#include "node.h"
#include "ros/exceptions.h"
#include "ros/init.h"
#include "ros/this_node.h"
#include "topic_statistics.h"

namespace ros {
namespace topics {
namespace {

struct State {
  std::mutex mutex;
  std::map<std::string, std::shared_ptr<Publication>> publications;
  std::map<std::string, std::shared_ptr<Subscription>> subscriptions;
  /** Number of topics that were ever advertised. */
  uint64_t advertised = 0;
  /** Held while a topic is registered, so that calls reach the master in the order of the changes. */
  std::mutex registering;
};

State& state() {
  static State* const instance = new State;
  return *instance;
}

template <class Topic>
std::shared_ptr<Topic> find(std::map<std::string, std::shared_ptr<Topic>>& topics, const std::string& name) {
  const std::lock_guard<std::mutex> lock(state().mutex);
  const auto found = topics.find(name);
  return found == topics.end() ? nullptr : found->second;
}

bool callMaster(const char* method, const std::string& topic, const std::string* type, XmlRpc::XmlRpcValue& payload) {
  XmlRpc::XmlRpcValue arguments;
  int count = 0;
  arguments[count++] = topic;
  if (type) arguments[count++] = *type;
  arguments[count] = node::uri();
  return node::callMaster(method, arguments, payload, type != nullptr);
}

/** Refuse options without a type of messages, as those of a message that is filled by hand may be. */
void checkType(const std::string& topic, const std::string& datatype, const std::string& md5sum, bool is_any_allowed) {
  for (const std::string& value : {datatype, md5sum})
    if (value.empty() || (value == "*" && !is_any_allowed))
      throw InvalidParameterException("topic [" + topic + "] needs a datatype and an md5sum, not [" + datatype +
                                      "] and [" + md5sum + "]");
}

std::vector<std::string> texts(const XmlRpc::XmlRpcValue& list) {
  std::vector<std::string> result;
  if (list.getType() != XmlRpc::XmlRpcValue::TypeArray) return result;
  for (int i = 0; i < list.size(); ++i)
    if (list[i].getType() == XmlRpc::XmlRpcValue::TypeString) result.push_back(list[i]);
  return result;
}

}  // namespace

std::shared_ptr<Publication> advertise(const AdvertiseOptions& options,
                                       const boost::shared_ptr<Publication::Callbacks>& callbacks) {
  checkType(options.topic, options.datatype, options.md5sum, false);
  State& s = state();
  const std::lock_guard<std::mutex> registering(s.registering);
  std::shared_ptr<Publication> publication = find(s.publications, options.topic);
  if (publication && publication->md5sum != options.md5sum) {
    ROS_ERROR(
        "Tried to advertise on topic [%s] with md5sum [%s] and datatype [%s], but the topic is already advertised "
        "as md5sum [%s] and datatype [%s]",
        options.topic.c_str(), options.md5sum.c_str(), options.datatype.c_str(), publication->md5sum.c_str(),
        publication->datatype.c_str());
    return nullptr;
  }
  if (publication) {
    ++publication->owners;
    publication->addCallbacks(callbacks);
    return publication;
  }
  publication = std::make_shared<Publication>(options);
  publication->owners = 1;
  publication->addCallbacks(callbacks);
  std::shared_ptr<Subscription> own;
  {
    const std::lock_guard<std::mutex> lock(s.mutex);
    publication->order = ++s.advertised;
    s.publications[options.topic] = publication;
    const auto found = s.subscriptions.find(options.topic);
    if (found != s.subscriptions.end()) own = found->second;
  }
  if (own && own->accepts(publication->md5sum)) own->connectLocally(publication);
  XmlRpc::XmlRpcValue payload;
  callMaster("registerPublisher", options.topic, &options.datatype, payload);
  return publication;
}

void unadvertise(const std::shared_ptr<Publication>& publication,
                 const boost::shared_ptr<Publication::Callbacks>& callbacks) {
  publication->removeCallbacks(callbacks);
  State& s = state();
  const std::lock_guard<std::mutex> registering(s.registering);
  if (--publication->owners > 0) return;
  {
    const std::lock_guard<std::mutex> lock(s.mutex);
    const auto found = s.publications.find(publication->topic);
    if (found == s.publications.end() || found->second != publication) return;
    s.publications.erase(found);
  }
  publication->closeLinks();
  XmlRpc::XmlRpcValue payload;
  callMaster("unregisterPublisher", publication->topic, nullptr, payload);
}

std::shared_ptr<Subscription> subscribe(const SubscribeOptions& options) {
  checkType(options.topic, options.datatype, options.md5sum, true);
  if (!options.helper)
    throw InvalidParameterException("the subscriber of topic [" + options.topic + "] has no callback");
  const auto statistics = TopicStatistics::create(options.topic, options.helper->hasHeader());
  State& s = state();
  const std::lock_guard<std::mutex> registering(s.registering);
  std::shared_ptr<Subscription> subscription = find(s.subscriptions, options.topic);
  if (subscription) {
    if (!subscription->accepts(options.md5sum))
      throw ConflictingSubscriptionException(
          "Tried to subscribe to a topic with the same name but different md5sum as a "
          "topic that was already subscribed [" +
          options.datatype + "/" + options.md5sum + " vs. " + subscription->md5sum() + "]");
    subscription->addCallback(options);
    return subscription;
  }
  subscription = std::make_shared<Subscription>(options, statistics);
  subscription->addCallback(options);
  std::shared_ptr<Publication> own;
  {
    const std::lock_guard<std::mutex> lock(s.mutex);
    s.subscriptions[options.topic] = subscription;
    const auto found = s.publications.find(options.topic);
    if (found != s.publications.end()) own = found->second;
  }
  if (own && subscription->accepts(own->md5sum)) subscription->connectLocally(own);
  XmlRpc::XmlRpcValue payload;
  if (callMaster("registerSubscriber", options.topic, &options.datatype, payload))
    subscription->setPublishers(texts(payload), false);
  return subscription;
}

void unsubscribe(const std::shared_ptr<Subscription>& subscription, const SubscriptionCallbackHelperPtr& helper) {
  if (!subscription->removeCallback(helper)) return;
  State& s = state();
  const std::lock_guard<std::mutex> registering(s.registering);
  {
    const std::lock_guard<std::mutex> lock(s.mutex);
    const auto found = s.subscriptions.find(subscription->topic);
    if (found == s.subscriptions.end() || found->second != subscription || subscription->hasCallbacks()) return;
    s.subscriptions.erase(found);
  }
  subscription->close();
  XmlRpc::XmlRpcValue payload;
  callMaster("unregisterSubscriber", subscription->topic, nullptr, payload);
}

void publisherUpdate(const std::string& topic, const std::vector<std::string>& uris) {
  if (const std::shared_ptr<Subscription> subscription = find(state().subscriptions, topic))
    subscription->setPublishers(uris, true);
}

std::shared_ptr<Publication> publication(const std::string& topic) { return find(state().publications, topic); }
std::shared_ptr<Subscription> subscription(const std::string& topic) { return find(state().subscriptions, topic); }

void dropConnections(bool retries) {
  State& s = state();
  std::vector<std::shared_ptr<Publication>> publications;
  std::vector<std::shared_ptr<Subscription>> subscriptions;
  {
    const std::lock_guard<std::mutex> lock(s.mutex);
    for (const auto& entry : s.publications) publications.push_back(entry.second);
    for (const auto& entry : s.subscriptions) subscriptions.push_back(entry.second);
  }
  for (const auto& publication : publications)
    for (const auto& link : publication->links()) link->close();
  for (const auto& subscription : subscriptions) subscription->dropConnections(retries);
}

V_string advertised() {
  const std::lock_guard<std::mutex> lock(state().mutex);
  std::map<uint64_t, std::string> by_order;
  for (const auto& entry : state().publications) by_order[entry.second->order] = entry.first;
  V_string names;
  for (const auto& entry : by_order) names.push_back(entry.second);
  return names;
}

V_string subscribed() {
  const std::lock_guard<std::mutex> lock(state().mutex);
  V_string names;
  for (const auto& entry : state().subscriptions) names.push_back(entry.first);
  return names;
}

XmlRpc::XmlRpcValue busInfo() {
  XmlRpc::XmlRpcValue rows;
  rows.setSize(0);
  const auto add = [&rows](const std::string& peer, const char* direction, const char* transport,
                           const std::string& topic, bool is_open) {
    XmlRpc::XmlRpcValue row;
    row[0] = rows.size();
    row[1] = peer;
    row[2] = std::string(direction);
    row[3] = std::string(transport);
    row[4] = topic;
    row[5] = is_open;
    rows[rows.size()] = row;
  };
  const std::lock_guard<std::mutex> lock(state().mutex);
  for (const auto& entry : state().publications)
    for (const auto& link : entry.second->links()) add(link->subscriber, "o", link->transport, entry.first, true);
  for (const auto& entry : state().subscriptions)
    for (const auto& link : entry.second->connections()) add(link.uri, "i", link.transport, entry.first, link.is_open);
  return rows;
}

namespace {

template <class Topic>
XmlRpc::XmlRpcValue typed(const std::map<std::string, std::shared_ptr<Topic>>& topics) {
  XmlRpc::XmlRpcValue rows;
  rows.setSize(0);
  const std::lock_guard<std::mutex> lock(state().mutex);
  for (const auto& entry : topics) {
    XmlRpc::XmlRpcValue row;
    row[0] = entry.first;
    row[1] = entry.second->datatype;
    rows[rows.size()] = row;
  }
  return rows;
}

}  // namespace

XmlRpc::XmlRpcValue publications() { return typed(state().publications); }
XmlRpc::XmlRpcValue subscriptions() { return typed(state().subscriptions); }

void shutdown() {
  State& s = state();
  std::map<std::string, std::shared_ptr<Publication>> publications;
  std::map<std::string, std::shared_ptr<Subscription>> subscriptions;
  {
    const std::lock_guard<std::mutex> lock(s.mutex);
    publications.swap(s.publications);
    subscriptions.swap(s.subscriptions);
  }
  XmlRpc::XmlRpcValue payload;
  for (const auto& entry : publications) {
    callMaster("unregisterPublisher", entry.first, nullptr, payload);
    entry.second->closeLinks();
  }
  for (const auto& entry : subscriptions) {
    callMaster("unregisterSubscriber", entry.first, nullptr, payload);
    entry.second->close();
  }
}

}  // namespace topics
}  // namespace ros
