// Bindings of the pose graph's mapper, for mapping_module.cc.
#pragma once

#include <nanobind/nanobind.h>

namespace trundle::navigation {

void bind_graph_slam(nanobind::module_& module);

}  // namespace trundle::navigation
