#pragma once

#include <sensor_msgs/PointField.h>

#include <cstdint>
#include <cstring>

namespace sensor_msgs {

/** Read a number of type `Stored` as T. */
template <typename Stored, typename T>
inline T readPointCloud2BufferValue(const unsigned char* data_ptr) {
  Stored value;
  std::memcpy(&value, data_ptr, sizeof value);
  return static_cast<T>(value);
}
/** Read a number of a PointField's type as T; 0 if the type is unknown. */
template <typename T>
inline T readPointCloud2BufferValue(const unsigned char* data_ptr, unsigned char datatype) {
  switch (datatype) {
    case PointField::INT8: return readPointCloud2BufferValue<int8_t, T>(data_ptr);
    case PointField::UINT8: return readPointCloud2BufferValue<uint8_t, T>(data_ptr);
    case PointField::INT16: return readPointCloud2BufferValue<int16_t, T>(data_ptr);
    case PointField::UINT16: return readPointCloud2BufferValue<uint16_t, T>(data_ptr);
    case PointField::INT32: return readPointCloud2BufferValue<int32_t, T>(data_ptr);
    case PointField::UINT32: return readPointCloud2BufferValue<uint32_t, T>(data_ptr);
    case PointField::FLOAT32: return readPointCloud2BufferValue<float, T>(data_ptr);
    case PointField::FLOAT64: return readPointCloud2BufferValue<double, T>(data_ptr);
    default: return T();
  }
}

}  // namespace sensor_msgs
