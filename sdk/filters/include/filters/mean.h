#pragma once

#include <filters/mean.hpp>
