#ifndef GAZEBO_TRANSPORT_SUBSCRIBER_HH_
#define GAZEBO_TRANSPORT_SUBSCRIBER_HH_
#include <gazebo/transport/Node.hh>
#endif
