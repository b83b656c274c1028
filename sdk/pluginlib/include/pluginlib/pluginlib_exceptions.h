#pragma once

#include "pluginlib/exceptions.hpp"
