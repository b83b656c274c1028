#pragma once

#include <sensor_msgs/Image.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <string>

namespace sensor_msgs {

/** Fill an image from an array of rows of `step` bytes. */
static inline bool fillImage(Image& image, const std::string& encoding, uint32_t rows, uint32_t cols, uint32_t step,
                             const void* data) {
  image.encoding = encoding;
  image.height = rows;
  image.width = cols;
  image.step = step;
  image.is_bigendian = 0;
  const uint8_t* const bytes = static_cast<const uint8_t*>(data);
  image.data.assign(bytes, bytes + static_cast<size_t>(rows) * step);
  return true;
}
static inline void clearImage(Image& image) { std::fill(image.data.begin(), image.data.end(), 0); }

}  // namespace sensor_msgs
