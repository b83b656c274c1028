#pragma once

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace sensor_msgs {
/** Names of pixel formats in sensor_msgs/Image. */
namespace image_encodings {

const std::string RGB8 = "rgb8";
const std::string RGBA8 = "rgba8";
const std::string RGB16 = "rgb16";
const std::string RGBA16 = "rgba16";
const std::string BGR8 = "bgr8";
const std::string BGRA8 = "bgra8";
const std::string BGR16 = "bgr16";
const std::string BGRA16 = "bgra16";
const std::string MONO8 = "mono8";
const std::string MONO16 = "mono16";
const std::string TYPE_8UC1 = "8UC1";
const std::string TYPE_8UC2 = "8UC2";
const std::string TYPE_8UC3 = "8UC3";
const std::string TYPE_8UC4 = "8UC4";
const std::string TYPE_8SC1 = "8SC1";
const std::string TYPE_8SC2 = "8SC2";
const std::string TYPE_8SC3 = "8SC3";
const std::string TYPE_8SC4 = "8SC4";
const std::string TYPE_16UC1 = "16UC1";
const std::string TYPE_16UC2 = "16UC2";
const std::string TYPE_16UC3 = "16UC3";
const std::string TYPE_16UC4 = "16UC4";
const std::string TYPE_16SC1 = "16SC1";
const std::string TYPE_16SC2 = "16SC2";
const std::string TYPE_16SC3 = "16SC3";
const std::string TYPE_16SC4 = "16SC4";
const std::string TYPE_32SC1 = "32SC1";
const std::string TYPE_32SC2 = "32SC2";
const std::string TYPE_32SC3 = "32SC3";
const std::string TYPE_32SC4 = "32SC4";
const std::string TYPE_32FC1 = "32FC1";
const std::string TYPE_32FC2 = "32FC2";
const std::string TYPE_32FC3 = "32FC3";
const std::string TYPE_32FC4 = "32FC4";
const std::string TYPE_64FC1 = "64FC1";
const std::string TYPE_64FC2 = "64FC2";
const std::string TYPE_64FC3 = "64FC3";
const std::string TYPE_64FC4 = "64FC4";
const std::string BAYER_RGGB8 = "bayer_rggb8";
const std::string BAYER_RGGB16 = "bayer_rggb16";
const std::string BAYER_BGGR8 = "bayer_bggr8";
const std::string BAYER_BGGR16 = "bayer_bggr16";
const std::string BAYER_GBRG8 = "bayer_gbrg8";
const std::string BAYER_GBRG16 = "bayer_gbrg16";
const std::string BAYER_GRBG8 = "bayer_grbg8";
const std::string BAYER_GRBG16 = "bayer_grbg16";
const std::string YUV422 = "yuv422";
const std::string YUV422_YUY2 = "yuv422_yuy2";

static inline bool isColor(const std::string& encoding) {
  return encoding == RGB8 || encoding == BGR8 || encoding == RGBA8 || encoding == BGRA8 || encoding == RGB16 ||
         encoding == BGR16 || encoding == RGBA16 || encoding == BGRA16;
}
static inline bool isMono(const std::string& encoding) { return encoding == MONO8 || encoding == MONO16; }
static inline bool isBayer(const std::string& encoding) { return encoding.compare(0, 6, "bayer_") == 0; }
static inline bool hasAlpha(const std::string& encoding) {
  return encoding == RGBA8 || encoding == BGRA8 || encoding == RGBA16 || encoding == BGRA16;
}

/** Number of a pixel's values. Throws std::runtime_error for an unknown name. */
static inline int numChannels(const std::string& encoding) {
  if (isMono(encoding) || isBayer(encoding)) return 1;
  if (isColor(encoding)) return hasAlpha(encoding) ? 4 : 3;
  if (encoding == YUV422 || encoding == YUV422_YUY2) return 2;
  const size_t c = encoding.find('C');
  if (c != std::string::npos && c + 1 < encoding.size()) {
    const int count = std::atoi(encoding.c_str() + c + 1);
    if (count > 0) return count;
  }
  if (encoding == "8U" || encoding == "8S" || encoding == "16U" || encoding == "16S" || encoding == "32S" ||
      encoding == "32F" || encoding == "64F")
    return 1;
  throw std::runtime_error("Unknown encoding " + encoding);
}

/** Bits of each value. Throws std::runtime_error for an unknown name. */
static inline int bitDepth(const std::string& encoding) {
  if (isMono(encoding) || isBayer(encoding) || isColor(encoding))
    return encoding.size() > 2 && encoding.compare(encoding.size() - 2, 2, "16") == 0 ? 16 : 8;
  if (encoding == YUV422 || encoding == YUV422_YUY2) return 8;
  const int bits = std::atoi(encoding.c_str());
  if (bits == 8 || bits == 16 || bits == 32 || bits == 64) return bits;
  throw std::runtime_error("Unknown encoding " + encoding);
}

}  // namespace image_encodings
}  // namespace sensor_msgs
