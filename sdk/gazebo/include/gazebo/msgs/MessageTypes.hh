#ifndef GAZEBO_MSGS_MESSAGETYPES_HH_
#define GAZEBO_MSGS_MESSAGETYPES_HH_
#include <gazebo/msgs/msgs.hh>
#endif
