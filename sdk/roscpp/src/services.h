#pragma once

#include <memory>

#include "loop.h"
#include "ros/advertise_service_options.h"

namespace ros {
/** Services of this node. */
namespace services {

class Offer;

std::shared_ptr<Offer> advertise(const AdvertiseServiceOptions& options);
void unadvertise(const std::shared_ptr<Offer>& offer);
/** Answer the header of a client that has connected. */
bool acceptClient(const std::shared_ptr<net::FrameConnection>& connection, const M_string& header);
void shutdown();

}  // namespace services
}  // namespace ros
