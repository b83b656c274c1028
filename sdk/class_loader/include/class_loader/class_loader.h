#pragma once

#include "class_loader/class_loader.hpp"
