// All of gazebo::transport.
#ifndef GAZEBO_TRANSPORT_TRANSPORT_HH_
#define GAZEBO_TRANSPORT_TRANSPORT_HH_

#include <gazebo/msgs/msgs.hh>
#include <gazebo/transport/Node.hh>
#include <gazebo/transport/TransportTypes.hh>

#endif
