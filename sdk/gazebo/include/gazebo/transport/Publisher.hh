#ifndef GAZEBO_TRANSPORT_PUBLISHER_HH_
#define GAZEBO_TRANSPORT_PUBLISHER_HH_
#include <gazebo/transport/Node.hh>
#endif
