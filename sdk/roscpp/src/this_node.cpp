#include "ros/this_node.h"

#include <unistd.h>

#include <cstdlib>

#include "node.h"
#include "ros/init.h"
#include "ros/master.h"
#include "ros/names.h"
#include "ros/network.h"
#include "socket.h"

namespace ros {
namespace this_node {
namespace {

std::string& name() {
  static std::string value = "empty";
  return value;
}
std::string& space() {
  static std::string value;
  return value;
}

}  // namespace

const std::string& getName() { return name(); }
const std::string& getNamespace() { return space(); }

void init(const std::string& wanted, const M_string& remappings, uint32_t options) {
  const char* const ns = std::getenv("ROS_NAMESPACE");
  std::string own = wanted, own_space = ns ? ns : "";
  if (own.empty()) throw InvalidNameException("The node name must not be empty");
  bool is_anonymous = options & init_options::AnonymousName;
  const auto named = remappings.find("__name"), spaced = remappings.find("__ns");
  if (named != remappings.end()) {
    own = named->second;
    is_anonymous = false;
  }
  if (spaced != remappings.end()) own_space = spaced->second;
  own_space = names::clean("/" + own_space);
  if (own_space.empty()) own_space = "/";
  std::string error;
  if (!names::validate(own_space, error))
    throw InvalidNameException("Namespace [" + own_space + "] is invalid: " + error);
  space() = own_space;
  name() = own;  // remappings are resolved with the name so far
  names::init(remappings);
  if (own.find('/') != std::string::npos) throw InvalidNodeNameException("[" + own + "]: node names cannot contain /");
  if (own.find('~') != std::string::npos) throw InvalidNodeNameException("[" + own + "]: node names cannot contain ~");
  own = names::resolve(own_space, own);
  if (is_anonymous) own += "_" + std::to_string(getpid()) + "_" + std::to_string(WallTime::now().toNSec());
  name() = own;
  names::init(remappings);  // again, as private names such as ~scan need the full name
  console::setFixedFilterToken("node", own);
}

}  // namespace this_node

namespace network {
namespace {

std::string host = "127.0.0.1";
uint16_t tcpros_port = 0;

}  // namespace

bool splitURI(const std::string& uri, std::string& host_out, uint32_t& port) {
  const size_t scheme = uri.find("://");
  if (scheme == std::string::npos) return false;
  const std::string authority = uri.substr(scheme + 3, uri.find('/', scheme + 3) - scheme - 3);
  const size_t colon = authority.rfind(':');
  if (colon == std::string::npos || colon + 1 >= authority.size() || authority.size() - colon > 6) return false;
  const std::string digits = authority.substr(colon + 1);
  if (digits.find_first_not_of("0123456789") != std::string::npos) return false;
  host_out = authority.substr(0, colon);
  if (host_out.size() > 2 && host_out.front() == '[' && host_out.back() == ']')
    host_out = host_out.substr(1, host_out.size() - 2);
  port = static_cast<uint32_t>(std::strtoul(digits.c_str(), nullptr, 10));
  return port <= 65535;
}

const std::string& getHost() { return host; }
uint16_t getTCPROSPort() { return tcpros_port; }
void setTCPROSPort(uint16_t port) { tcpros_port = port; }

void init(const M_string& remappings) {
  const char* named = std::getenv("ROS_HOSTNAME");
  if (!named || !*named) named = std::getenv("ROS_IP");
  host = named ? named : "";
  for (const char* const word : {"__ip", "__hostname"}) {
    const auto found = remappings.find(word);
    if (found != remappings.end()) host = found->second;
  }
  if (!host.empty()) return;
  // With a master on this machine, its address suffices; with one elsewhere, other machines find this one by its name.
  char machine[256] = "localhost";
  gethostname(machine, sizeof(machine) - 1);
  const std::string master_address = net::bindAddress(master::getHost());
  host = master_address == "0.0.0.0" ? machine : master_address;
}

}  // namespace network
}  // namespace ros
