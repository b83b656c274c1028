#pragma once

#include <boost/function.hpp>

namespace message_filters {

/** Connection of a callback with a filter. */
class Connection {
 public:
  typedef boost::function<void()> VoidDisconnectFunction;

  Connection() {}
  explicit Connection(const VoidDisconnectFunction& disconnect) : disconnect_(disconnect) {}
  void disconnect() {
    if (disconnect_) disconnect_();
    disconnect_.clear();
  }

 private:
  VoidDisconnectFunction disconnect_;
};

}  // namespace message_filters
