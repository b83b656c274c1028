#include "compression.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstring>
#include <initializer_list>

#include "rosbag/exceptions.h"

namespace rosbag {
namespace {

constexpr uint32_t kStep = 1 << 20;
constexpr int kBlockSize = 9, kWorkFactor = 30;  // bzip2's own defaults

/** Library of the machine, which bags without compression do not need. */
class Library {
 public:
  Library(const char* package, std::initializer_list<const char*> names) : package_(package) {
    for (const char* name : names)
      if (!handle_) handle_ = dlopen(name, RTLD_NOW);
  }
  template <class Function>
  Function* find(const char* name) const {
    void* const found = handle_ ? dlsym(handle_, name) : nullptr;
    if (!found) throw BagException(std::string("this bag's compression needs a library; install it: ") + package_);
    return reinterpret_cast<Function*>(found);
  }

 private:
  const char* package_;
  void* handle_ = nullptr;
};

const Library& bz2() {
  static const Library library("apt install libbz2-1.0", {"libbz2.so.1.0", "libbz2.so.1", "libbz2.dylib"});
  return library;
}
const Library& lz4() {
  static const Library library("apt install liblz4-1", {"liblz4.so.1", "liblz4.dylib"});
  return library;
}

[[noreturn]] void throwDamaged() { throw BagFormatException("a chunk's compressed bytes are damaged"); }

/** Uncompress step by step, as memory for what a damaged bag claims is not reserved at once. */
std::string lz4Uncompressed(const std::string& bytes, uint32_t size) {
  typedef size_t Create(void**, unsigned);
  typedef size_t Free(void*);
  typedef size_t Decompress(void*, void*, size_t*, const void*, size_t*, const void*);
  void* context = nullptr;
  constexpr unsigned kVersion = 100;
  lz4().find<Create>("LZ4F_createDecompressionContext")(&context, kVersion);
  std::string result;
  size_t from = 0, rest = 1;
  while (rest != 0 && from < bytes.size() && result.size() <= size) {
    const size_t old = result.size();
    size_t given = bytes.size() - from, room = std::min<size_t>(kStep, size - old + 1);
    result.resize(old + room);
    rest = lz4().find<Decompress>("LZ4F_decompress")(context, &result[old], &room, &bytes[from], &given, nullptr);
    const bool is_error = rest > static_cast<size_t>(-1000);
    result.resize(is_error ? 0 : old + room);
    if (is_error || (room == 0 && given == 0)) break;
    from += given;
  }
  lz4().find<Free>("LZ4F_freeDecompressionContext")(context);
  return result;
}

struct Bz2Stream {
  char* next_in;
  unsigned avail_in, total_in_low, total_in_high;
  char* next_out;
  unsigned avail_out, total_out_low, total_out_high;
  void* state;
  void* (*allocate)(void*, int, int);
  void (*release)(void*, void*);
  void* opaque;
};

std::string bz2Uncompressed(const std::string& bytes, uint32_t size) {
  Bz2Stream stream;
  std::memset(&stream, 0, sizeof stream);
  if (bz2().find<int(Bz2Stream*, int, int)>("BZ2_bzDecompressInit")(&stream, 0, 0) != 0) throwDamaged();
  stream.next_in = const_cast<char*>(bytes.data());
  stream.avail_in = static_cast<unsigned>(bytes.size());
  std::string result;
  int state = 0;
  while (state == 0 && result.size() <= size) {
    const size_t old = result.size(), room = std::min<size_t>(kStep, size - old + 1);
    result.resize(old + room);
    stream.next_out = &result[old];
    stream.avail_out = static_cast<unsigned>(room);
    state = bz2().find<int(Bz2Stream*)>("BZ2_bzDecompress")(&stream);
    result.resize(old + room - stream.avail_out);
    if (stream.avail_in == 0 && result.size() == old) break;
  }
  bz2().find<int(Bz2Stream*)>("BZ2_bzDecompressEnd")(&stream);
  return result;
}

}  // namespace

const char* nameOf(CompressionType compression) {
  switch (compression) {
    case compression::BZ2: return "bz2";
    case compression::LZ4: return "lz4";
    default: return "none";
  }
}

std::string compressed(CompressionType compression, const std::string& bytes) {
  std::string result;
  if (compression == compression::BZ2) {
    typedef int Compress(char*, unsigned*, char*, unsigned, int, int, int);
    unsigned size = static_cast<unsigned>(bytes.size() + bytes.size() / 100 + 600);  // as bzip2's manual asks
    result.resize(size);
    char* const source = const_cast<char*>(bytes.data());
    const int error = bz2().find<Compress>("BZ2_bzBuffToBuffCompress")(
        &result[0], &size, source, static_cast<unsigned>(bytes.size()), kBlockSize, 0, kWorkFactor);
    if (error != 0) throw BagException("bzip2 cannot compress a chunk: error " + std::to_string(error));
    result.resize(size);
    return result;
  }
  if (compression == compression::LZ4) {
    result.resize(lz4().find<size_t(size_t, const void*)>("LZ4F_compressFrameBound")(bytes.size(), nullptr));
    const size_t size = lz4().find<size_t(void*, size_t, const void*, size_t, const void*)>("LZ4F_compressFrame")(
        &result[0], result.size(), bytes.data(), bytes.size(), nullptr);
    if (size > result.size()) throw BagException("LZ4 cannot compress a chunk");
    result.resize(size);
    return result;
  }
  return bytes;
}

std::string uncompressed(const std::string& compression, const std::string& bytes, uint32_t size) {
  std::string result;
  if (compression == "none") result = bytes;
  else if (compression == "bz2") result = bz2Uncompressed(bytes, size);
  else if (compression == "lz4") result = lz4Uncompressed(bytes, size);
  else throw BagFormatException("a chunk's compression is unknown: " + compression.substr(0, 40));
  if (result.size() != size) throwDamaged();
  return result;
}

}  // namespace rosbag
