// Worlds that the simulator has opened, with their plugins.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <boost/shared_ptr.hpp>

#include <gazebo/physics/World.hh>

namespace gazebo {

struct OpenWorld;
OpenWorld* find_world(const std::string& name);

}  // namespace gazebo
