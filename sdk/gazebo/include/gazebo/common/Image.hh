// Formats of pixels; files of pictures are not read.
#ifndef GAZEBO_COMMON_IMAGE_HH_
#define GAZEBO_COMMON_IMAGE_HH_

#include <string>

namespace gazebo {
namespace common {

// Names of the formats, in their order.
static const std::string PixelFormatNames[] = {"UNKNOWN_PIXEL_FORMAT",
                                               "L_INT8",
                                               "L_INT16",
                                               "RGB_INT8",
                                               "RGBA_INT8",
                                               "BGRA_INT8",
                                               "RGB_INT16",
                                               "RGB_INT32",
                                               "BGR_INT8",
                                               "BGR_INT16",
                                               "BGR_INT32",
                                               "R_FLOAT16",
                                               "RGB_FLOAT16",
                                               "R_FLOAT32",
                                               "RGB_FLOAT32",
                                               "BAYER_RGGB8",
                                               "BAYER_RGGR8",
                                               "BAYER_GBRG8",
                                               "BAYER_GRBG8"};

class Image {
 public:
  enum PixelFormat {
    UNKNOWN_PIXEL_FORMAT,
    L_INT8,
    L_INT16,
    RGB_INT8,
    RGBA_INT8,
    BGRA_INT8,
    RGB_INT16,
    RGB_INT32,
    BGR_INT8,
    BGR_INT16,
    BGR_INT32,
    R_FLOAT16,
    RGB_FLOAT16,
    R_FLOAT32,
    RGB_FLOAT32,
    BAYER_RGGB8,
    BAYER_RGGR8,
    BAYER_GBRG8,
    BAYER_GRBG8,
    PIXEL_FORMAT_COUNT
  };

  // Format of a name such as RGB_INT8; UNKNOWN_PIXEL_FORMAT for others, such as R8G8B8.
  static PixelFormat ConvertPixelFormat(const std::string& format) {
    for (int i = 0; i < PIXEL_FORMAT_COUNT; ++i)
      if (PixelFormatNames[i] == format) return static_cast<PixelFormat>(i);
    return UNKNOWN_PIXEL_FORMAT;
  }
};

}  // namespace common
}  // namespace gazebo

#endif
