#pragma once

#include <string>
#include <vector>

#include <transmission_interface/transmission_info.h>

namespace transmission_interface {

/** Reads the <transmission> elements of a URDF. */
class TransmissionParser {
 public:
  /** Add the transmissions of a robot; one without a name, type, joint or actuator is left out, and the log says so.
      False if the text is not a URDF, or has no transmission. */
  static bool parse(const std::string& urdf_string, std::vector<TransmissionInfo>& transmissions);
};

}  // namespace transmission_interface
