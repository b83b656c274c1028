#include <pluginlib/class_list_macros.h>
#include <ros/console.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "codecs.h"
#include "compressed_image_transport/compressed_publisher.h"
#include "compressed_image_transport/compressed_subscriber.h"

namespace enc = sensor_msgs::image_encodings;

namespace compressed_image_transport {
namespace {

bool isBlueFirst(const std::string& encoding) { return encoding.compare(0, 3, "bgr") == 0; }

/** Exchange red and blue of each pixel. */
void swapRedBlue(Pixels& pixels) {
  const size_t unit = pixels.depth, step = unit * pixels.channels;
  for (size_t at = 0; at + step <= pixels.data.size(); at += step)
    std::swap_ranges(pixels.data.begin() + static_cast<std::ptrdiff_t>(at),
                     pixels.data.begin() + static_cast<std::ptrdiff_t>(at + unit),
                     pixels.data.begin() + static_cast<std::ptrdiff_t>(at + 2 * unit));
}

/** Pixels of an image, in the order of codecs. Throws for an encoding without one, such as 32FC1. */
Pixels pixelsOf(const sensor_msgs::Image& image) {
  const std::string& encoding = image.encoding;
  Pixels pixels;
  pixels.width = image.width;
  pixels.height = image.height;
  const int bits = enc::bitDepth(encoding);
  pixels.depth = static_cast<uint32_t>(bits / 8);
  pixels.channels = static_cast<uint32_t>(enc::numChannels(encoding));
  const bool has_codec = (bits == 8 || (bits == 16 && encoding != "16SC1")) &&
                         (pixels.channels == 1 || pixels.channels == 3 || pixels.channels == 4);
  if (!has_codec || encoding == enc::YUV422) throw std::runtime_error("JPEG and PNG cannot hold images of " + encoding);
  const size_t step = size_t{pixels.width} * pixels.channels * pixels.depth;
  if (image.step < step || image.data.size() < size_t{image.step} * image.height)
    throw std::runtime_error("the image has fewer bytes than its size and encoding say");
  pixels.data.resize(step * pixels.height);
  for (size_t row = 0; row < pixels.height; ++row)
    std::memcpy(pixels.data.data() + row * step, image.data.data() + row * image.step, step);
  if (pixels.channels >= 3 && isBlueFirst(encoding)) swapRedBlue(pixels);
  return pixels;
}

/** Leave alpha out. */
void dropAlpha(Pixels& pixels) {
  const size_t unit = pixels.depth;
  size_t to = 0;
  for (size_t from = 0; from + 4 * unit <= pixels.data.size(); from += 4 * unit, to += 3 * unit)
    std::memmove(pixels.data.data() + to, pixels.data.data() + from, 3 * unit);
  pixels.data.resize(to);
  pixels.channels = 3;
}

/** Encoding of decoded pixels: the image's own, if they have as many channels and bytes, else the plain one. */
std::string encodingOf(const Pixels& pixels, const std::string& original) {
  if (!original.empty()) try {
      if (enc::numChannels(original) == static_cast<int>(pixels.channels) &&
          enc::bitDepth(original) == static_cast<int>(8 * pixels.depth))
        return original;
    } catch (const std::runtime_error&) {  // no encoding of ROS'
    }
  if (pixels.channels == 1) return pixels.depth == 2 ? enc::MONO16 : enc::MONO8;
  if (pixels.channels == 3) return pixels.depth == 2 ? enc::BGR16 : enc::BGR8;
  return pixels.depth == 2 ? enc::BGRA16 : enc::BGRA8;
}

}  // namespace

void CompressedPublisher::publish(const sensor_msgs::Image& message, const PublishFn& publish_fn) const {
  std::string format = "jpeg";
  int quality = 80, level = 9;
  nh().getParamCached("format", format);
  nh().getParamCached("jpeg_quality", quality);
  nh().getParamCached("png_level", level);
  sensor_msgs::CompressedImage compressed;
  compressed.header = message.header;
  compressed.format = message.encoding;
  try {
    Pixels pixels = pixelsOf(message);
    if (format == "png") {
      compressed.data = encodePng(pixels, std::min(std::max(level, 1), 9));
    } else if (format == "jpeg") {
      if (pixels.depth != 1) throw std::runtime_error("JPEG cannot hold " + message.encoding + "; set ~format to png");
      if (pixels.channels == 4) dropAlpha(pixels);
      compressed.data = encodeJpeg(pixels, std::min(std::max(quality, 1), 100));
    } else {
      throw std::runtime_error("unknown format '" + format + "', which is jpeg or png");
    }
    compressed.format += "; " + format + " compressed " + (pixels.channels > 1 ? "bgr8" : "");
  } catch (const std::runtime_error& error) {
    ROS_ERROR_THROTTLE(10.0, "%s: %s", getTopic().c_str(), error.what());
    return;
  }
  publish_fn(compressed);
}

void CompressedSubscriber::internalCallback(const sensor_msgs::CompressedImageConstPtr& message,
                                            const Callback& user_cb) {
  const boost::shared_ptr<sensor_msgs::Image> image = boost::make_shared<sensor_msgs::Image>();
  try {
    const bool is_png = message->data.size() > 4 && message->data[0] == 0x89 && message->data[1] == 'P';
    Pixels pixels = is_png ? decodePng(message->data) : decodeJpeg(message->data);
    const size_t end = message->format.find(';');
    const std::string original = end == std::string::npos ? std::string() : message->format.substr(0, end);
    image->encoding = encodingOf(pixels, original);
    if (pixels.channels >= 3 && isBlueFirst(image->encoding)) swapRedBlue(pixels);
    image->header = message->header;
    image->width = pixels.width;
    image->height = pixels.height;
    image->step = pixels.width * pixels.channels * pixels.depth;
    image->data.swap(pixels.data);
  } catch (const std::runtime_error& error) {
    ROS_ERROR_THROTTLE(10.0, "%s: %s", getTopic().c_str(), error.what());
    return;
  }
  user_cb(image);
}

}  // namespace compressed_image_transport

PLUGINLIB_EXPORT_CLASS(compressed_image_transport::CompressedPublisher, image_transport::PublisherPlugin)
PLUGINLIB_EXPORT_CLASS(compressed_image_transport::CompressedSubscriber, image_transport::SubscriberPlugin)
