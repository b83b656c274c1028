#pragma once

#include "message_filters/simple_filter.h"

namespace message_filters {

/** Filter that passes on what it gets. */
template <class M>
class PassThrough : public SimpleFilter<M> {
 public:
  typedef boost::shared_ptr<M const> MConstPtr;
  typedef ros::MessageEvent<M const> EventType;

  PassThrough() {}
  template <class F>
  explicit PassThrough(F& f) {
    connectInput(f);
  }
  ~PassThrough() { incoming_.disconnect(); }

  template <class F>
  void connectInput(F& f) {
    incoming_.disconnect();
    incoming_ = f.registerCallback(typename SimpleFilter<M>::EventCallback([this](const EventType& e) { add(e); }));
  }
  void add(const MConstPtr& message) { add(EventType(message)); }
  void add(const EventType& event) { this->signalMessage(event); }

 private:
  Connection incoming_;
};

}  // namespace message_filters
