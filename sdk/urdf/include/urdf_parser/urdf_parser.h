#pragma once

#include <string>

#include "urdf_model/model.h"

namespace urdf {

/** Read a robot; null if it is invalid, which is logged. */
ModelInterfaceSharedPtr parseURDF(const std::string& xml_string);
ModelInterfaceSharedPtr parseURDFFile(const std::string& filename);

}  // namespace urdf
