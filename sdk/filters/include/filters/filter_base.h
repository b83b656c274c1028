#pragma once

#include <filters/filter_base.hpp>
