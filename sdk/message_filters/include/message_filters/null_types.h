#pragma once

#include "message_filters/connection.h"

namespace message_filters {

/** Filter that has no messages, for an input that is filled by hand. */
template <class M>
struct NullFilter {
  template <class C>
  Connection registerCallback(const C&) {
    return Connection();
  }
};

}  // namespace message_filters
