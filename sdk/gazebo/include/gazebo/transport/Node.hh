// Topics between the plugins of this process. Messages are delivered in `Publish`, in the publisher's thread.
#ifndef GAZEBO_TRANSPORT_NODE_HH_
#define GAZEBO_TRANSPORT_NODE_HH_

#include <functional>
#include <memory>
#include <string>
#include <typeindex>
#include <typeinfo>
#include <vector>

#include <boost/enable_shared_from_this.hpp>
#include <boost/make_shared.hpp>

#include <gazebo/common/Event.hh>
#include <gazebo/common/Time.hh>
#include <gazebo/transport/TransportTypes.hh>

namespace gazebo {
namespace transport {

// Topic of one name, shared by its publishers and subscribers.
struct Topic;
std::shared_ptr<Topic> OpenTopic(const std::string& name);
void Deliver(Topic& topic, std::type_index type, const boost::shared_ptr<const void>& message);
bool HasSubscribers(const Topic& topic);

class Publisher {
 public:
  Publisher(const std::string& name, std::type_index type) : name_(name), type_(type), topic_(OpenTopic(name)) {}
  std::string GetTopic() const { return name_; }
  bool HasConnections() const { return HasSubscribers(*topic_); }
  // Messages reach whoever subscribes in this process; nobody else can, so nothing is waited for.
  void WaitForConnection() const {}
  bool WaitForConnection(const common::Time&) const { return HasConnections(); }
  template <typename M>
  void Publish(const M& message, bool block = false) {
    (void)block;
    if (type_ == typeid(M)) Deliver(*topic_, type_, boost::make_shared<const M>(message));
  }
  void SendMessage() {}
  void Fini() {}

 private:
  std::string name_;
  std::type_index type_;
  std::shared_ptr<Topic> topic_;
};

// Ends with its last pointer, or by Unsubscribe.
class Subscriber {
 public:
  typedef std::function<void(const boost::shared_ptr<const void>&)> Function;
  Subscriber(const std::string& name, std::type_index type, const Function& function);
  ~Subscriber() { Unsubscribe(); }
  std::string GetTopic() const { return name_; }
  void Unsubscribe();

 private:
  Subscriber(const Subscriber&);
  std::string name_;
  std::shared_ptr<Topic> topic_;
  int id_;
};

class Node : public boost::enable_shared_from_this<Node> {
 public:
  // Name of the world, which `~` in topics stands for; "": the plugin's.
  void Init(const std::string& space = "");
  bool TryInit(const common::Time& = common::Time()) {
    Init();
    return true;
  }
  bool IsInitialized() const { return !space_.empty(); }
  void Fini() {}
  std::string GetTopicNamespace() const { return space_; }
  std::string DecodeTopicName(const std::string& topic) const;
  std::string EncodeTopicName(const std::string& topic) const;

  template <typename M>
  PublisherPtr Advertise(const std::string& topic, unsigned int queue_limit = 1000, double rate = 0) {
    (void)queue_limit;
    (void)rate;
    return boost::make_shared<Publisher>(DecodeTopicName(topic), std::type_index(typeid(M)));
  }
  template <typename M, typename T>
  SubscriberPtr Subscribe(const std::string& topic, void (T::*function)(const boost::shared_ptr<const M>&), T* object,
                          bool latching = false) {
    (void)latching;
    return boost::make_shared<Subscriber>(DecodeTopicName(topic), std::type_index(typeid(M)),
                                          [function, object](const boost::shared_ptr<const void>& message) {
                                            (object->*function)(boost::static_pointer_cast<const M>(message));
                                          });
  }
  template <typename M>
  SubscriberPtr Subscribe(const std::string& topic, void (*function)(const boost::shared_ptr<const M>&),
                          bool latching = false) {
    (void)latching;
    return boost::make_shared<Subscriber>(DecodeTopicName(topic), std::type_index(typeid(M)),
                                          [function](const boost::shared_ptr<const void>& message) {
                                            function(boost::static_pointer_cast<const M>(message));
                                          });
  }

 private:
  std::string space_;
};

}  // namespace transport
}  // namespace gazebo

#endif
