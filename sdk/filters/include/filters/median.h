#pragma once

#include <filters/median.hpp>
