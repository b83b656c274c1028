#pragma once

#include <moveit/macros/class_forward.h>
