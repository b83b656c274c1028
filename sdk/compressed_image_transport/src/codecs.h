#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace compressed_image_transport {

/** Pixels in rows without gaps, of 1, 3 or 4 channels in the order red, green, blue, alpha. */
struct Pixels {
  uint32_t width = 0, height = 0, channels = 0;
  /** Bytes of a channel: 1, or 2 in the machine's order. */
  uint32_t depth = 1;
  std::vector<uint8_t> data;
};

/** Largest picture that is read, in pixels. */
constexpr size_t kMaxPixels = size_t{1} << 26;

/** Encode pixels of 8 bits with 1 or 3 channels; `quality` is 1 to 100. Throws std::runtime_error, as all here. */
std::vector<uint8_t> encodeJpeg(const Pixels& pixels, int quality);
Pixels decodeJpeg(const std::vector<uint8_t>& data);
/** `level` is zlib's, 1 to 9. */
std::vector<uint8_t> encodePng(const Pixels& pixels, int level);
Pixels decodePng(const std::vector<uint8_t>& data);

}  // namespace compressed_image_transport
