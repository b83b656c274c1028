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
/** A client has connected: answer its header. */
bool acceptClient(const std::shared_ptr<net::FrameConnection>& connection, const M_string& header);
void shutdown();

}  // namespace services
}  // namespace ros
