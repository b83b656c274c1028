#pragma once

#include "message_filters/sync_policies/exact_time.h"
#include "message_filters/synchronizer.h"

namespace message_filters {

/** Synchronizer of messages with the same stamp. */
template <class... M>
class TimeSynchronizer : public Synchronizer<sync_policies::ExactTime<M...> > {
 public:
  typedef sync_policies::ExactTime<M...> Policy;
  typedef Synchronizer<Policy> Base;

  explicit TimeSynchronizer(uint32_t queue_size) : Base(Policy(queue_size)) {}
  template <class F0, class F1>
  TimeSynchronizer(F0& f0, F1& f1, uint32_t queue_size) : Base(Policy(queue_size), f0, f1) {}
  template <class F0, class F1, class F2>
  TimeSynchronizer(F0& f0, F1& f1, F2& f2, uint32_t queue_size) : Base(Policy(queue_size), f0, f1, f2) {}
  template <class F0, class F1, class F2, class F3>
  TimeSynchronizer(F0& f0, F1& f1, F2& f2, F3& f3, uint32_t queue_size) : Base(Policy(queue_size), f0, f1, f2, f3) {}
  template <class F0, class F1, class F2, class F3, class F4>
  TimeSynchronizer(F0& f0, F1& f1, F2& f2, F3& f3, F4& f4, uint32_t queue_size)
      : Base(Policy(queue_size), f0, f1, f2, f3, f4) {}
  template <class F0, class F1, class F2, class F3, class F4, class F5>
  TimeSynchronizer(F0& f0, F1& f1, F2& f2, F3& f3, F4& f4, F5& f5, uint32_t queue_size)
      : Base(Policy(queue_size), f0, f1, f2, f3, f4, f5) {}
  template <class F0, class F1, class F2, class F3, class F4, class F5, class F6>
  TimeSynchronizer(F0& f0, F1& f1, F2& f2, F3& f3, F4& f4, F5& f5, F6& f6, uint32_t queue_size)
      : Base(Policy(queue_size), f0, f1, f2, f3, f4, f5, f6) {}
  template <class F0, class F1, class F2, class F3, class F4, class F5, class F6, class F7>
  TimeSynchronizer(F0& f0, F1& f1, F2& f2, F3& f3, F4& f4, F5& f5, F6& f6, F7& f7, uint32_t queue_size)
      : Base(Policy(queue_size), f0, f1, f2, f3, f4, f5, f6, f7) {}
  template <class F0, class F1, class F2, class F3, class F4, class F5, class F6, class F7, class F8>
  TimeSynchronizer(F0& f0, F1& f1, F2& f2, F3& f3, F4& f4, F5& f5, F6& f6, F7& f7, F8& f8, uint32_t queue_size)
      : Base(Policy(queue_size), f0, f1, f2, f3, f4, f5, f6, f7, f8) {}

  // Messages of each input, by hand.
  template <class P>
  void add0(const P& message) {
    this->template add<0>(message);
  }
  template <class P>
  void add1(const P& message) {
    this->template add<1>(message);
  }
  template <class P>
  void add2(const P& message) {
    this->template add<2>(message);
  }
  template <class P>
  void add3(const P& message) {
    this->template add<3>(message);
  }
  template <class P>
  void add4(const P& message) {
    this->template add<4>(message);
  }
  template <class P>
  void add5(const P& message) {
    this->template add<5>(message);
  }
  template <class P>
  void add6(const P& message) {
    this->template add<6>(message);
  }
  template <class P>
  void add7(const P& message) {
    this->template add<7>(message);
  }
  template <class P>
  void add8(const P& message) {
    this->template add<8>(message);
  }
};

}  // namespace message_filters
