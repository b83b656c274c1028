#include "image_transport/image_transport.h"

#include "transports.h"

namespace image_transport {

std::vector<std::string> ImageTransport::getDeclaredTransports() const {
  std::vector<std::string> names = declaredTransports();
  for (std::string& name : names) name = "image_transport/" + name;
  return names;
}

std::vector<std::string> ImageTransport::getLoadableTransports() const {
  std::vector<std::string> names;
  for (const std::string& name : declaredTransports()) try {
      createSubscriber(name);
      names.push_back("image_transport/" + name);
    } catch (const TransportLoadException&) {
      continue;
    }
  return names;
}

}  // namespace image_transport
