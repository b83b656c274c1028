#pragma once

#include <filters/param_test.hpp>
