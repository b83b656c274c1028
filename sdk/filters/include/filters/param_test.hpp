#pragma once

#include <filters/filter_base.hpp>

namespace filters {

/** The parameter `key`, whatever the value; for tests. */
template <typename T>
class ParamTest : public FilterBase<T> {
 public:
  virtual bool configure() { return true; }
  virtual bool update(const T&, T& data_out) {
    T value;
    if (!this->getParam("key", value)) return false;
    data_out = value;
    return true;
  }
};

}  // namespace filters
