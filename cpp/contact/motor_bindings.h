// Motors in the Python module `_contact_laws`.
#pragma once

#include <nanobind/nanobind.h>

namespace trundle {

void bind_motors(nanobind::module_& module);

}  // namespace trundle
