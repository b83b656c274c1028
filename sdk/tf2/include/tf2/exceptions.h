#pragma once

#include <stdexcept>
#include <string>

namespace tf2 {

/** Base of all exceptions of tf2. */
class TransformException : public std::runtime_error {
 public:
  explicit TransformException(const std::string& what) : std::runtime_error(what) {}
};

#define TF2_EXCEPTION(Name)                                              \
  class Name : public TransformException {                               \
   public:                                                               \
    explicit Name(const std::string& what) : TransformException(what) {} \
  }
/** There is no frame of this name. */
TF2_EXCEPTION(LookupException);
/** The frames are in separate trees. */
TF2_EXCEPTION(ConnectivityException);
/** The time is before or after all known transforms. */
TF2_EXCEPTION(ExtrapolationException);
TF2_EXCEPTION(InvalidArgumentException);
TF2_EXCEPTION(TimeoutException);
#undef TF2_EXCEPTION

}  // namespace tf2
