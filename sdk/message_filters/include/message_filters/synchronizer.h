#pragma once

#include <ros/message_event.h>
#include <boost/thread/mutex.hpp>
#include <boost/tuple/tuple.hpp>
#include <string>
#include <vector>

#include "message_filters/null_types.h"
#include "message_filters/signal.h"

namespace message_filters {

/** What policies have in common: their messages' types, and the callbacks of complete sets. */
template <class... M>
class PolicyBase {
 public:
  typedef std::tuple<M...> Messages;
  typedef std::tuple<ros::MessageEvent<M const>...> Events;
  static const size_t kCount = sizeof...(M);
  static_assert(kCount >= 2 && kCount <= 9, "a synchronizer has 2 to 9 inputs");

 protected:
  template <size_t i>
  static ros::Time stamp(const typename std::tuple_element<i, Events>::type& event) {
    typedef typename std::tuple_element<i, Messages>::type Message;
    return ros::message_traits::TimeStamp<Message>::value(*event.getMessage());
  }
  void signal(const Events& events) { signal_.call(events); }

  Signal<M...> signal_;
};

/** Passes on sets of messages of several inputs, which a policy puts together by their stamps. */
template <class Policy>
class Synchronizer : public Policy {
 public:
  typedef typename Policy::Messages Messages;
  typedef typename Policy::Events Events;

  Synchronizer() {}
  explicit Synchronizer(const Policy& policy) : Policy(policy) {}
  template <class F0, class F1, class... F,
            typename = typename std::enable_if<!std::is_base_of<Policy, typename std::decay<F0>::type>::value>::type>
  Synchronizer(F0& f0, F1& f1, F&... f) {
    connectInput(f0, f1, f...);
  }
  template <class F0, class F1, class... F>
  Synchronizer(const Policy& policy, F0& f0, F1& f1, F&... f) : Policy(policy) {
    connectInput(f0, f1, f...);
  }
  Synchronizer(const Synchronizer&) = delete;
  Synchronizer& operator=(const Synchronizer&) = delete;
  ~Synchronizer() { disconnectAll(); }

  /** Take messages of these filters, instead of those before. */
  template <class... F>
  void connectInput(F&... f) {
    static_assert(sizeof...(F) == Policy::kCount, "a filter for each message's type");
    disconnectAll();
    connect(typename IndicesUpTo<sizeof...(F)>::type(), f...);
  }
  template <class C>
  Connection registerCallback(const C& callback) {
    return this->signal_.addCallback(callback);
  }
  template <class C, class T>
  Connection registerCallback(C callback, T* object) {
    return this->signal_.addCallback(callback, object);
  }

  /** Add a message by hand. */
  template <int i>
  void add(const boost::shared_ptr<typename std::tuple_element<i, Messages>::type const>& message) {
    Policy::template add<i>(typename std::tuple_element<i, Events>::type(message));
  }
  template <int i>
  void add(const typename std::tuple_element<i, Events>::type& event) {
    Policy::template add<i>(event);
  }
  Policy* getPolicy() { return this; }
  void setName(const std::string& name) { name_ = name; }
  const std::string& getName() { return name_; }

 private:
  template <size_t... i, class... F>
  void connect(Indices<i...>, F&... f) {
    const std::vector<Connection> made{connectOne<i>(f)...};
    connections_ = made;
  }
  template <size_t i, class F>
  Connection connectOne(F& f) {
    typedef typename std::tuple_element<i, Events>::type Event;
    return f.registerCallback(
        boost::function<void(const Event&)>([this](const Event& event) { Policy::template add<i>(event); }));
  }
  void disconnectAll() {
    for (Connection& connection : connections_) connection.disconnect();
    connections_.clear();
  }

  std::vector<Connection> connections_;
  std::string name_;
};

}  // namespace message_filters
