// Part of the Python module `_mapping`.
#pragma once

#include <nanobind/nanobind.h>

namespace trundle::navigation {

void bind_hector(nanobind::module_& module);

}  // namespace trundle::navigation
