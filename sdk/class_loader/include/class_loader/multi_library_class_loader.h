#pragma once

#include "class_loader/multi_library_class_loader.hpp"
