#pragma once

#include <boost/type_traits/remove_const.hpp>
#include <boost/type_traits/remove_reference.hpp>

namespace ros {
/** Traits of service types, and of their requests and responses. */
namespace service_traits {

template <typename M>
struct MD5Sum {
  static const char* value() { return M::__s_getServerMD5Sum().c_str(); }
  static const char* value(const M& m) { return m.__getServerMD5Sum().c_str(); }
};
template <typename M>
struct DataType {
  static const char* value() { return M::__s_getServiceDataType().c_str(); }
  static const char* value(const M& m) { return m.__getServiceDataType().c_str(); }
};

template <typename M>
inline const char* md5sum() {
  return MD5Sum<typename boost::remove_const<typename boost::remove_reference<M>::type>::type>::value();
}
template <typename M>
inline const char* datatype() {
  return DataType<typename boost::remove_const<typename boost::remove_reference<M>::type>::type>::value();
}
template <typename M>
inline const char* md5sum(const M& m) {
  return MD5Sum<M>::value(m);
}
template <typename M>
inline const char* datatype(const M& m) {
  return DataType<M>::value(m);
}

}  // namespace service_traits
}  // namespace ros
