// Opened libraries of controllers, and the kit's library that they are compiled with.
#pragma once

#include <cstdint>
#include <string>

#include "controller_interface/trundle_control.h"

namespace trundle {

// Open a user's library. Throws std::runtime_error with the reason.
std::uintptr_t open_control_library(const std::string& file);

// Functions of the kit that an opened library was compiled with, and the kit's folder. Throws std::runtime_error.
const TrundleControlKit* control_kit_of(std::uintptr_t library);
std::string kit_folder_of(std::uintptr_t library);

}  // namespace trundle
