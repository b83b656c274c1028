#pragma once

#include <image_transport/publisher_plugin.h>
#include <image_transport/subscriber_plugin.h>

#include <string>
#include <vector>

namespace image_transport {

/** Names of the transports that can be published: raw, compressed if the kit has it, those that packages export. */
std::vector<std::string> publisherTransports();
/** Names of all transports, those whose plugin is only declared among them. */
std::vector<std::string> declaredTransports();
/** Plugin of a transport. Throws TransportLoadException. */
boost::shared_ptr<PublisherPlugin> createPublisher(const std::string& transport);
boost::shared_ptr<SubscriberPlugin> createSubscriber(const std::string& transport);

}  // namespace image_transport
