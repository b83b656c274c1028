#pragma once

#include <ros/message_event.h>
#include <ros/parameter_adapter.h>

#include <boost/array.hpp>  // which programs take from here
#include <boost/bind.hpp>
#include <boost/function.hpp>
#include <boost/make_shared.hpp>
#include <map>
#include <mutex>
#include <tuple>
#include <vector>

#include "message_filters/connection.h"

namespace message_filters {

/** Numbers 0 … n - 1 as a type. */
template <size_t... i>
struct Indices {};
template <size_t n, size_t... i>
struct IndicesUpTo : IndicesUpTo<n - 1, n - 1, i...> {};
template <size_t... i>
struct IndicesUpTo<0, i...> {
  typedef Indices<i...> type;
};

/** Callbacks that get an event of each message's type. They may connect and disconnect while they are called. */
template <class... M>
class Signal {
 public:
  typedef std::tuple<ros::MessageEvent<M const>...> Events;

  Signal() : state_(boost::make_shared<State>()) {}

  /** Connect a callback with parameters of any kinds that subscribers' callbacks have; it may take fewer than there
   * are. */
  template <class... P>
  Connection addCallback(const boost::function<void(P...)>& callback) {
    return add([callback](const Events& events, bool is_shared) {
      call<P...>(callback, events, is_shared, typename IndicesUpTo<sizeof...(P)>::type());
    });
  }
  template <class... P>
  Connection addCallback(void (*callback)(P...)) {
    return addCallback(boost::function<void(P...)>(callback));
  }
  template <class T, class... P>
  Connection addCallback(void (T::*callback)(P...), T* object) {
    return addCallback(
        boost::function<void(P...)>([callback, object](P... message) { (object->*callback)(message...); }));
  }
  template <class T, class... P>
  Connection addCallback(void (T::*callback)(P...) const, T* object) {
    return addCallback(
        boost::function<void(P...)>([callback, object](P... message) { (object->*callback)(message...); }));
  }
  /** Connect what boost::bind() returns, or a class with operator(); it gets pointers. */
  template <class C>
  Connection addCallback(const C& callback) {
    return addCallback(boost::function<void(const boost::shared_ptr<M const>&...)>(callback));
  }

  void call(const Events& events) const {
    std::vector<Callback> callbacks;
    {
      const std::lock_guard<std::mutex> lock(state_->mutex);
      for (const auto& entry : state_->callbacks) callbacks.push_back(entry.second);
    }
    for (const Callback& callback : callbacks) callback(events, callbacks.size() > 1);
  }

 private:
  typedef boost::function<void(const Events& events, bool is_shared)> Callback;
  struct State {
    std::mutex mutex;
    size_t next = 0;
    std::map<size_t, Callback> callbacks;
  };

  Connection add(const Callback& callback) {
    const std::lock_guard<std::mutex> lock(state_->mutex);
    const size_t number = state_->next++;
    state_->callbacks[number] = callback;
    const boost::weak_ptr<State> weak = state_;
    return Connection([weak, number] {
      const boost::shared_ptr<State> state = weak.lock();
      if (!state) return;
      const std::lock_guard<std::mutex> lock(state->mutex);
      state->callbacks.erase(number);
    });
  }

  template <class... P, size_t... i>
  static void call(const boost::function<void(P...)>& callback, const Events& events, bool is_shared, Indices<i...>) {
    callback(ros::ParameterAdapter<P>::getParameter(event<P>(std::get<i>(events), is_shared))...);
  }
  /** An event whose message is copied for a callback that changes it, if others get it, too. */
  template <class P, class E>
  static typename ros::ParameterAdapter<P>::Event event(const E& e, bool is_shared) {
    typedef typename ros::ParameterAdapter<P>::Event Event;
    return Event(e.getConstMessage(), e.getConnectionHeaderPtr(), e.getReceiptTime(), is_shared || e.nonConstWillCopy(),
                 e.getMessageFactory());
  }

  boost::shared_ptr<State> state_;
};

}  // namespace message_filters
