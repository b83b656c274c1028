#pragma once

#include <vector>

#include "message_filters/pass_through.h"

namespace message_filters {

/** Base of chains of any type. */
class ChainBase {
 public:
  virtual ~ChainBase() {}
  /** Filter of a chain by its number; null if there is none, or it has neither this type nor one derived from it. */
  template <class F>
  boost::shared_ptr<F> getFilter(size_t index) const {
    if (index >= filters_.size()) return boost::shared_ptr<F>();
    try {
      filters_[index].raise();
    } catch (F* filter) {  // also a pointer to a derived class
      return boost::shared_ptr<F>(filters_[index].filter, filter);
    } catch (...) {}
    return boost::shared_ptr<F>();
  }

 protected:
  struct Filter {
    boost::shared_ptr<void> filter;
    boost::function<void()> raise;  // throws the pointer with its own type
  };
  std::vector<Filter> filters_;
};
typedef boost::shared_ptr<ChainBase> ChainBasePtr;

/** Filters one behind the other, as one filter. */
template <class M>
class Chain : public ChainBase, public SimpleFilter<M> {
 public:
  typedef boost::shared_ptr<M const> MConstPtr;
  typedef ros::MessageEvent<M const> EventType;

  Chain() {}
  template <class F>
  explicit Chain(F& f) {
    connectInput(f);
  }
  ~Chain() {
    incoming_.disconnect();
    outgoing_.disconnect();
  }

  /** Add a filter at the end; its number is returned. A plain pointer stays the caller's. */
  template <class F>
  size_t addFilter(F* filter) {
    return addFilter(boost::shared_ptr<F>(filter, [](F*) {}));
  }
  template <class F>
  size_t addFilter(const boost::shared_ptr<F>& filter) {
    typedef typename SimpleFilter<M>::EventCallback EventCallback;
    const EventCallback in([filter](const EventType& e) { filter->add(e); });
    outgoing_.disconnect();
    if (filters_.empty()) first_ = in;
    else connect_last_(in);
    connect_last_ = [filter](const EventCallback& callback) { return filter->registerCallback(callback); };
    outgoing_ = connect_last_([this](const EventType& e) { this->signalMessage(e); });
    filters_.push_back(ChainBase::Filter{filter, [filter] { throw filter.get(); }});
    return filters_.size() - 1;
  }
  template <class F>
  void connectInput(F& f) {
    incoming_.disconnect();
    incoming_ = f.registerCallback(typename SimpleFilter<M>::EventCallback([this](const EventType& e) { add(e); }));
  }
  void add(const MConstPtr& message) { add(EventType(message)); }
  void add(const EventType& event) {
    if (first_) first_(event);
  }

 private:
  typename SimpleFilter<M>::EventCallback first_;
  boost::function<Connection(const typename SimpleFilter<M>::EventCallback&)> connect_last_;
  Connection incoming_, outgoing_;
};

}  // namespace message_filters
