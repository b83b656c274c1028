#pragma once

#include <memory>

#include <controller_interface/controller_base.h>
#include <hardware_interface/controller_info.h>

namespace controller_manager {

/** Loaded controller. */
struct ControllerSpec {
  hardware_interface::ControllerInfo info;
  std::shared_ptr<controller_interface::ControllerBase> c;
};

}  // namespace controller_manager
