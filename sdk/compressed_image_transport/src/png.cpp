#include <png.h>

#include <csetjmp>
#include <cstring>
#include <new>
#include <stdexcept>

#include "codecs.h"

namespace compressed_image_transport {
namespace {

constexpr uint32_t kEndian = 1;
bool isLittleEndian() { return *reinterpret_cast<const uint8_t*>(&kEndian) == 1; }

struct Failure {
  char text[256] = "";
};

void fail(png_structp png, png_const_charp what) {
  Failure* const failure = static_cast<Failure*>(png_get_error_ptr(png));
  std::strncpy(failure->text, what, sizeof failure->text - 1);
  png_longjmp(png, 1);
}

void ignore(png_structp, png_const_charp) {}

void append(png_structp png, png_bytep data, png_size_t count) {
  std::vector<uint8_t>* const out = static_cast<std::vector<uint8_t>*>(png_get_io_ptr(png));
  try {
    out->insert(out->end(), data, data + count);
    return;
  } catch (const std::bad_alloc&) {  // libpng is C
  }
  png_error(png, "out of memory");
}

struct Source {
  const std::vector<uint8_t>* data;
  size_t at;
};

void take(png_structp png, png_bytep into, png_size_t count) {
  Source* const source = static_cast<Source*>(png_get_io_ptr(png));
  if (count > source->data->size() - source->at) png_error(png, "the data end early");
  std::memcpy(into, source->data->data() + source->at, count);
  source->at += count;
}

int colorType(uint32_t channels) {
  return channels == 1 ? PNG_COLOR_TYPE_GRAY : channels == 3 ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA;
}

/** Encode; errors jump out, so that what has a destructor lives outside. */
bool encode(const Pixels& pixels, int level, Failure& failure, std::vector<uint8_t>& out) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &failure, fail, ignore);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  if (!info || setjmp(png_jmpbuf(png))) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_set_write_fn(png, &out, append, nullptr);
  png_set_compression_level(png, level);
  png_set_IHDR(png, info, pixels.width, pixels.height, static_cast<int>(pixels.depth) * 8, colorType(pixels.channels),
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  if (pixels.depth == 2 && isLittleEndian()) png_set_swap(png);
  const size_t step = size_t{pixels.width} * pixels.channels * pixels.depth;
  for (uint32_t row = 0; row < pixels.height; ++row) png_write_row(png, pixels.data.data() + row * step);
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return true;
}

bool decode(Source& source, Failure& failure, Pixels& pixels) {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &failure, fail, ignore);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  if (!info || setjmp(png_jmpbuf(png))) {
    png_destroy_read_struct(&png, &info, nullptr);
    return false;
  }
  png_set_read_fn(png, &source, take);
  png_read_info(png, info);
  pixels.width = png_get_image_width(png, info);
  pixels.height = png_get_image_height(png, info);
  if (size_t{pixels.width} * pixels.height > kMaxPixels) png_error(png, "the picture is too large");
  png_set_expand(png);
  if (png_get_color_type(png, info) == PNG_COLOR_TYPE_GRAY_ALPHA) png_set_gray_to_rgb(png);
  if (isLittleEndian()) png_set_swap(png);
  const int passes = png_set_interlace_handling(png);
  png_read_update_info(png, info);
  pixels.channels = png_get_channels(png, info);
  pixels.depth = png_get_bit_depth(png, info) == 16 ? 2 : 1;
  const size_t step = png_get_rowbytes(png, info);
  pixels.data.resize(step * pixels.height);
  for (int pass = 0; pass < passes; ++pass)
    for (uint32_t row = 0; row < pixels.height; ++row) png_read_row(png, pixels.data.data() + row * step, nullptr);
  png_read_end(png, nullptr);
  png_destroy_read_struct(&png, &info, nullptr);
  return true;
}

}  // namespace

std::vector<uint8_t> encodePng(const Pixels& pixels, int level) {
  std::vector<uint8_t> out;
  Failure failure;
  if (!encode(pixels, level, failure, out)) throw std::runtime_error(std::string("libpng: ") + failure.text);
  return out;
}

Pixels decodePng(const std::vector<uint8_t>& data) {
  Pixels pixels;
  Failure failure;
  Source source{&data, 0};
  if (!decode(source, failure, pixels)) throw std::runtime_error(std::string("libpng: ") + failure.text);
  return pixels;
}

}  // namespace compressed_image_transport
