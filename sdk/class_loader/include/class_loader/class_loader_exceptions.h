#pragma once

#include "class_loader/exceptions.hpp"
