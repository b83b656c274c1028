#pragma once

namespace rosbag {
namespace compression {
/** Compression of a bag's chunks. */
enum CompressionType { Uncompressed = 0, BZ2 = 1, LZ4 = 2 };
}  // namespace compression
typedef compression::CompressionType CompressionType;
}  // namespace rosbag
