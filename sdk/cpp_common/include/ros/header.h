#pragma once

#include "ros/datatypes.h"
