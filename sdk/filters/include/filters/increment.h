#pragma once

#include <filters/increment.hpp>
