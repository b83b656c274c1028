#pragma once

#include "actionlib/client/simple_client_goal_state.h"
