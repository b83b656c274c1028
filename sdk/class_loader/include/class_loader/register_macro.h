#pragma once

#include "class_loader/register_macro.hpp"
