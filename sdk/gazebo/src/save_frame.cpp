#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>

#include <gazebo/common/Console.hh>
#include <gazebo/rendering/Camera.hh>

namespace gazebo {
namespace rendering {

namespace {

constexpr std::size_t kBlock = 65535;  // of bytes that deflate stores as they are

std::string big_endian(uint32_t value) {
  return {static_cast<char>(value >> 24), static_cast<char>(value >> 16), static_cast<char>(value >> 8),
          static_cast<char>(value)};
}

uint32_t crc(const std::string& bytes) {
  static const std::array<uint32_t, 256> table = [] {
    std::array<uint32_t, 256> made;
    for (uint32_t n = 0; n < 256; ++n) {
      made[n] = n;
      for (int bit = 0; bit < 8; ++bit) made[n] = made[n] & 1 ? 0xEDB88320u ^ (made[n] >> 1) : made[n] >> 1;
    }
    return made;
  }();
  uint32_t sum = 0xFFFFFFFFu;
  for (const char byte : bytes) sum = table[(sum ^ static_cast<unsigned char>(byte)) & 0xFF] ^ (sum >> 8);
  return ~sum;
}

std::string chunk(const std::string& type, const std::string& data) {
  return big_endian(static_cast<uint32_t>(data.size())) + type + data + big_endian(crc(type + data));
}

// A stream of zlib that stores its bytes.
std::string stored(const std::string& bytes) {
  std::string stream = "\x78\x01";
  for (std::size_t at = 0; at < bytes.size(); at += kBlock) {
    const std::size_t size = std::min(kBlock, bytes.size() - at);
    stream += at + size == bytes.size() ? '\1' : '\0';
    for (const std::size_t length : {size, ~size}) {
      stream += static_cast<char>(length);
      stream += static_cast<char>(length >> 8);
    }
    stream.append(bytes, at, size);
  }
  uint32_t a = 1, b = 0;  // Adler's sums
  for (const char byte : bytes) {
    a = (a + static_cast<unsigned char>(byte)) % 65521;
    b = (b + a) % 65521;
  }
  return stream + big_endian(b << 16 | a);
}

}  // namespace

bool Camera::SaveFrame(const std::string& filename) {
  return SaveFrame(ImageData(), width_, height_, static_cast<int>(depth_), format_, filename);
}

bool Camera::SaveFrame(const unsigned char* image, unsigned int width, unsigned int height, int depth,
                       const std::string& format, const std::string& filename) {
  if (!image || (depth != 1 && depth != 3)) {
    gzerr << filename << " is not written: only pictures of R8G8B8 and L8 are, got " << format << "\n";
    return false;
  }
  const std::size_t row = std::size_t(width) * static_cast<std::size_t>(depth);
  std::string rows;
  for (unsigned int y = 0; y < height; ++y)
    (rows += '\0').append(reinterpret_cast<const char*>(image) + y * row, row);  // without a filter
  const std::string size = big_endian(width) + big_endian(height);
  const char kind[] = {8, static_cast<char>(depth == 3 ? 2 : 0), 0, 0, 0};  // bits, colors
  std::ofstream out(filename, std::ios::binary);
  out << "\x89PNG\r\n\x1a\n"
      << chunk("IHDR", size + std::string(kind, 5)) << chunk("IDAT", stored(rows)) << chunk("IEND", "");
  if (out.flush()) return true;
  gzerr << filename << " cannot be written\n";
  return false;
}

}  // namespace rendering
}  // namespace gazebo
