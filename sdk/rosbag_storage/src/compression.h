#pragma once

#include <string>

#include "rosbag/stream.h"

namespace rosbag {

/** Name of a compression in a chunk's header. */
const char* nameOf(CompressionType compression);
std::string compressed(CompressionType compression, const std::string& bytes);
/** Bytes of a chunk, `size` in all; throws BagFormatException if they are damaged. */
std::string uncompressed(const std::string& compression, const std::string& bytes, uint32_t size);

}  // namespace rosbag
