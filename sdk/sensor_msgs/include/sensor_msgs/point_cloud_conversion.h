#pragma once

#include <sensor_msgs/PointCloud.h>
#include <sensor_msgs/PointCloud2.h>

#include <cstdint>
#include <cstring>
#include <string>

#include "sensor_msgs/point_cloud2_iterator.h"
#include "sensor_msgs/point_field_conversion.h"

namespace sensor_msgs {

/** Index of a field by its name; -1 if there is none. */
inline int getPointCloud2FieldIndex(const PointCloud2& cloud, const std::string& field_name) {
  for (size_t i = 0; i < cloud.fields.size(); ++i)
    if (cloud.fields[i].name == field_name) return static_cast<int>(i);
  return -1;
}

/** Convert to fields x, y, z and one for each channel, all of 32-bit floats. */
inline bool convertPointCloudToPointCloud2(const PointCloud& input, PointCloud2& output) {
  const size_t count = 3 + input.channels.size(), points = input.points.size();
  output.header = input.header;
  output.height = 1;
  output.width = static_cast<uint32_t>(points);
  output.fields.resize(count);
  for (size_t i = 0; i < count; ++i) {
    output.fields[i].name = i < 3 ? std::string(1, static_cast<char>('x' + i)) : input.channels[i - 3].name;
    output.fields[i].offset = static_cast<uint32_t>(i * sizeof(float));
    output.fields[i].datatype = PointField::FLOAT32;
    output.fields[i].count = 1;
  }
  output.point_step = static_cast<uint32_t>(count * sizeof(float));
  output.row_step = output.point_step * output.width;
  output.is_bigendian = false;
  output.is_dense = false;
  output.data.resize(points * count * sizeof(float));
  for (size_t i = 0; i < count; ++i) {
    if (i >= 3 && input.channels[i - 3].values.size() < points) return false;
    for (size_t p = 0; p < points; ++p) {
      const geometry_msgs::Point32& point = input.points[p];
      const float value = i == 0 ? point.x : i == 1 ? point.y : i == 2 ? point.z : input.channels[i - 3].values[p];
      std::memcpy(&output.data[(p * count + i) * sizeof(float)], &value, sizeof value);
    }
  }
  return true;
}

/** Convert fields of any number type; false if x, y or z is missing, a type is unknown, or the data are too short. */
inline bool convertPointCloud2ToPointCloud(const PointCloud2& input, PointCloud& output) {
  const int axes[] = {getPointCloud2FieldIndex(input, "x"), getPointCloud2FieldIndex(input, "y"),
                      getPointCloud2FieldIndex(input, "z")};
  if (axes[0] < 0 || axes[1] < 0 || axes[2] < 0) return false;
  const size_t points = static_cast<size_t>(input.width) * input.height;
  for (const PointField& field : input.fields)
    if (field.datatype < PointField::INT8 || field.datatype > PointField::FLOAT64 ||
        static_cast<size_t>(field.offset) + static_cast<size_t>(sizeOfPointField(field.datatype)) > input.point_step)
      return false;
  if (input.height > 0 && (static_cast<size_t>(input.width) * input.point_step > input.row_step ||
                           static_cast<size_t>(input.height) * input.row_step > input.data.size()))
    return false;
  output.header = input.header;
  output.points.resize(points);
  output.channels.clear();
  for (size_t i = 0; i < input.fields.size(); ++i) {
    const PointField& field = input.fields[i];
    const int index = static_cast<int>(i);
    const int axis = index == axes[0] ? 0 : index == axes[1] ? 1 : index == axes[2] ? 2 : -1;
    if (axis < 0) {
      output.channels.emplace_back();
      output.channels.back().name = field.name;
      output.channels.back().values.resize(points);
    }
    for (size_t p = 0; p < points; ++p) {
      const size_t at = p / input.width * input.row_step + p % input.width * input.point_step + field.offset;
      const float value = readPointCloud2BufferValue<float>(&input.data[at], field.datatype);
      geometry_msgs::Point32& point = output.points[p];
      if (axis < 0) output.channels.back().values[p] = value;
      else (axis == 0 ? point.x : axis == 1 ? point.y : point.z) = value;
    }
  }
  return true;
}

}  // namespace sensor_msgs
