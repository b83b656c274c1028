#include "ros/connection_manager.h"
#include "ros/network.h"
#include "ros/topic_manager.h"
#include "topics.h"

namespace ros {

const TopicManagerPtr& TopicManager::instance() {
  static const TopicManagerPtr* const manager = new TopicManagerPtr(new TopicManager);
  return *manager;
}

void TopicManager::getAdvertisedTopics(V_string& names) { names = topics::advertised(); }
void TopicManager::getSubscribedTopics(V_string& names) { names = topics::subscribed(); }

size_t TopicManager::getNumSubscribers(const std::string& topic) {
  const std::shared_ptr<Publication> publication = topics::publication(topic);
  return publication ? publication->linkCount() : 0;
}

size_t TopicManager::getNumPublishers(const std::string& topic) {
  const std::shared_ptr<Subscription> subscription = topics::subscription(topic);
  return subscription ? subscription->publisherCount() : 0;
}

bool TopicManager::isLatched(const std::string& topic) {
  const std::shared_ptr<Publication> publication = topics::publication(topic);
  return publication && publication->isLatched();
}

const ConnectionManagerPtr& ConnectionManager::instance() {
  static const ConnectionManagerPtr* const manager = new ConnectionManagerPtr(new ConnectionManager);
  return *manager;
}

void ConnectionManager::clear(Connection::DropReason reason) {
  topics::dropConnections(reason == Connection::TransportDisconnect);
}

uint16_t ConnectionManager::getTCPPort() const { return network::getTCPROSPort(); }

}  // namespace ros
