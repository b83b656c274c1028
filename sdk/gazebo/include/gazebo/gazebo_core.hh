// All that plugins may use.
#ifndef GAZEBO_GAZEBO_CORE_HH_
#define GAZEBO_GAZEBO_CORE_HH_

#include <gazebo/common/common.hh>
#include <gazebo/msgs/msgs.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/sensors/sensors.hh>
#include <gazebo/transport/transport.hh>

#endif
