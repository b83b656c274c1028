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
/** No frame of this name. */
TF2_EXCEPTION(LookupException);
/** Frames of separate trees. */
TF2_EXCEPTION(ConnectivityException);
/** A time before or after what is known. */
TF2_EXCEPTION(ExtrapolationException);
TF2_EXCEPTION(InvalidArgumentException);
TF2_EXCEPTION(TimeoutException);
#undef TF2_EXCEPTION

}  // namespace tf2
