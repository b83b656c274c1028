#ifndef GAZEBO_TRANSPORT_TRANSPORTTYPES_HH_
#define GAZEBO_TRANSPORT_TRANSPORTTYPES_HH_

#include <boost/shared_ptr.hpp>

#include <gazebo/msgs/msgs.hh>

namespace gazebo {
namespace transport {

class Node;
class Publisher;
class Subscriber;
typedef boost::shared_ptr<Node> NodePtr;
typedef boost::shared_ptr<Publisher> PublisherPtr;
typedef boost::shared_ptr<Subscriber> SubscriberPtr;

}  // namespace transport
}  // namespace gazebo

#endif
