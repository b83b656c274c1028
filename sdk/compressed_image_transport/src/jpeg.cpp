#include <cstdio>  // jpeglib.h needs it before

#include <jpeglib.h>

#include <csetjmp>
#include <cstdlib>
#include <stdexcept>

#include "codecs.h"

namespace compressed_image_transport {
namespace {

/** libjpeg's handler of errors, which would end the program. */
struct Failure {
  jpeg_error_mgr handler;
  std::jmp_buf back;
  char text[JMSG_LENGTH_MAX];

  Failure() {
    jpeg_std_error(&handler);
    handler.error_exit = [](j_common_ptr codec) {
      Failure* const failure = reinterpret_cast<Failure*>(codec->err);
      codec->err->format_message(codec, failure->text);
      std::longjmp(failure->back, 1);
    };
    handler.output_message = [](j_common_ptr) {};
  }
};

/** Encode; nothing here has a destructor, as errors jump out. */
bool encode(const Pixels& pixels, int quality, Failure& failure, unsigned char** out, unsigned long* size) {
  jpeg_compress_struct codec;
  codec.err = &failure.handler;
  jpeg_create_compress(&codec);
  if (setjmp(failure.back)) {
    jpeg_destroy_compress(&codec);
    return false;
  }
  jpeg_mem_dest(&codec, out, size);
  codec.image_width = pixels.width;
  codec.image_height = pixels.height;
  codec.input_components = static_cast<int>(pixels.channels);
  codec.in_color_space = pixels.channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_set_defaults(&codec);
  jpeg_set_quality(&codec, quality, TRUE);
  jpeg_start_compress(&codec, TRUE);
  while (codec.next_scanline < codec.image_height) {
    const size_t at = size_t{codec.next_scanline} * pixels.width * pixels.channels;
    JSAMPROW row = const_cast<JSAMPROW>(pixels.data.data() + at);
    jpeg_write_scanlines(&codec, &row, 1);
  }
  jpeg_finish_compress(&codec);
  jpeg_destroy_compress(&codec);
  return true;
}

/** Decode; `into` is filled, and lives outside, as errors jump out. */
bool decode(const std::vector<uint8_t>& data, Failure& failure, Pixels& into) {
  jpeg_decompress_struct codec;
  codec.err = &failure.handler;
  jpeg_create_decompress(&codec);
  if (setjmp(failure.back)) {
    jpeg_destroy_decompress(&codec);
    return false;
  }
  jpeg_mem_src(&codec, const_cast<unsigned char*>(data.data()), static_cast<unsigned long>(data.size()));
  jpeg_read_header(&codec, TRUE);
  if (size_t{codec.image_width} * codec.image_height > kMaxPixels) {
    std::snprintf(failure.text, sizeof failure.text, "a picture of %u x %u pixels is too large", codec.image_width,
                  codec.image_height);
    jpeg_destroy_decompress(&codec);
    return false;
  }
  codec.out_color_space = codec.num_components == 1 ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_start_decompress(&codec);
  into.width = codec.output_width;
  into.height = codec.output_height;
  into.channels = static_cast<uint32_t>(codec.output_components);
  into.data.resize(size_t{into.width} * into.height * into.channels);
  while (codec.output_scanline < codec.output_height) {
    JSAMPROW row = into.data.data() + size_t{codec.output_scanline} * into.width * into.channels;
    jpeg_read_scanlines(&codec, &row, 1);
  }
  jpeg_finish_decompress(&codec);
  jpeg_destroy_decompress(&codec);
  return true;
}

}  // namespace

std::vector<uint8_t> encodeJpeg(const Pixels& pixels, int quality) {
  Failure failure;
  unsigned char* out = nullptr;
  unsigned long size = 0;
  const bool is_done = encode(pixels, quality, failure, &out, &size);
  std::vector<uint8_t> encoded;
  if (is_done) encoded.assign(out, out + size);
  std::free(out);
  if (!is_done) throw std::runtime_error(std::string("libjpeg: ") + failure.text);
  return encoded;
}

Pixels decodeJpeg(const std::vector<uint8_t>& data) {
  Failure failure;
  Pixels pixels;
  if (!decode(data, failure, pixels)) throw std::runtime_error(std::string("libjpeg: ") + failure.text);
  return pixels;
}

}  // namespace compressed_image_transport
