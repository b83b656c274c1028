#pragma once

#include <ros/time.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#if defined(__has_include)
#if __has_include(<opencv2/imgcodecs.hpp>)
#include <opencv2/imgcodecs.hpp>
#define TRUNDLE_HAS_IMGCODECS
#endif
#endif
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "cv_bridge/opencv_c.h"

namespace cv_bridge {

class Exception : public std::runtime_error {
 public:
  explicit Exception(const std::string& description) : std::runtime_error(description) {}
};

class CvImage;
typedef boost::shared_ptr<CvImage> CvImagePtr;
typedef boost::shared_ptr<CvImage const> CvImageConstPtr;

enum Format { BMP, DIB, JPG, JPEG, JPE, JP2, PNG, PBM, PGM, PPM, SR, RAS, TIFF, TIF };

/** Image of OpenCV, with the header and the encoding of its message. */
class CvImage {
 public:
  std_msgs::Header header;
  std::string encoding;
  cv::Mat image;

  CvImage() {}
  CvImage(const std_msgs::Header& header_, const std::string& encoding_, const cv::Mat& image_ = cv::Mat())
      : header(header_), encoding(encoding_), image(image_) {}

  sensor_msgs::ImagePtr toImageMsg() const {
    const sensor_msgs::ImagePtr message = boost::make_shared<sensor_msgs::Image>();
    toImageMsg(*message);
    return message;
  }
  void toImageMsg(sensor_msgs::Image& message) const {
    message.header = header;
    message.height = static_cast<uint32_t>(image.rows);
    message.width = static_cast<uint32_t>(image.cols);
    message.encoding = encoding;
    message.is_bigendian = 0;
    const size_t row = static_cast<size_t>(image.cols) * image.elemSize();
    message.step = static_cast<uint32_t>(row);
    message.data.resize(row * static_cast<size_t>(image.rows));
    for (int i = 0; i < image.rows; ++i)
      std::copy_n(image.ptr<uint8_t>(i), row, &message.data[static_cast<size_t>(i) * row]);
  }
  sensor_msgs::CompressedImagePtr toCompressedImageMsg(const Format format = JPG) const {
    const sensor_msgs::CompressedImagePtr message = boost::make_shared<sensor_msgs::CompressedImage>();
    toCompressedImageMsg(*message, format);
    return message;
  }
  void toCompressedImageMsg(sensor_msgs::CompressedImage& message, const Format format = JPG) const;

  typedef boost::shared_ptr<CvImage> Ptr;
  typedef boost::shared_ptr<CvImage const> ConstPtr;

 private:
  friend CvImageConstPtr toCvShare(const sensor_msgs::Image& source,
                                   const boost::shared_ptr<void const>& tracked_object, const std::string& encoding);
  /** Owner of the pixels, if they are not the image's own. */
  boost::shared_ptr<void const> tracked_object_;
};

/** OpenCV's type of an encoding, such as CV_8UC3; throws Exception for an unknown one. */
inline int getCvType(const std::string& encoding) {
  namespace enc = sensor_msgs::image_encodings;
  try {
    const int channels = enc::numChannels(encoding), bits = enc::bitDepth(encoding);
    if (enc::isColor(encoding) || enc::isMono(encoding) || enc::isBayer(encoding) || encoding == enc::YUV422 ||
        encoding == enc::YUV422_YUY2)
      return CV_MAKETYPE(bits == 16 ? CV_16U : CV_8U, channels);
    const char kind = encoding.size() > (bits == 8 ? 1u : 2u) ? encoding[bits == 8 ? 1 : 2] : ' ';
    const std::map<std::pair<int, char>, int> depths{{{8, 'U'}, CV_8U},   {{8, 'S'}, CV_8S},   {{16, 'U'}, CV_16U},
                                                     {{16, 'S'}, CV_16S}, {{32, 'S'}, CV_32S}, {{32, 'F'}, CV_32F},
                                                     {{64, 'F'}, CV_64F}};
    const auto depth = depths.find({bits, kind});
    if (depth == depths.end() || channels > CV_CN_MAX)
      throw Exception("Unrecognized image encoding [" + encoding + "]");
    return CV_MAKETYPE(depth->second, channels);
  } catch (const Exception&) {
    throw;
  } catch (const std::runtime_error&) {
    throw Exception("Unrecognized image encoding [" + encoding + "]");
  }
}

namespace impl {

enum Kind { kNone, kMono, kRgb, kBgr, kRgba, kBgra, kYuv, kYuy2, kRggb, kBggr, kGbrg, kGrbg };

inline Kind kindOf(const std::string& encoding) {
  namespace enc = sensor_msgs::image_encodings;
  static const std::map<std::string, Kind> kinds{
      {enc::MONO8, kMono},       {enc::MONO16, kMono},       {enc::RGB8, kRgb},         {enc::RGB16, kRgb},
      {enc::BGR8, kBgr},         {enc::BGR16, kBgr},         {enc::RGBA8, kRgba},       {enc::RGBA16, kRgba},
      {enc::BGRA8, kBgra},       {enc::BGRA16, kBgra},       {enc::YUV422, kYuv},       {enc::YUV422_YUY2, kYuy2},
      {enc::BAYER_RGGB8, kRggb}, {enc::BAYER_RGGB16, kRggb}, {enc::BAYER_BGGR8, kBggr}, {enc::BAYER_BGGR16, kBggr},
      {enc::BAYER_GBRG8, kGbrg}, {enc::BAYER_GBRG16, kGbrg}, {enc::BAYER_GRBG8, kGrbg}, {enc::BAYER_GRBG16, kGrbg}};
  const auto found = kinds.find(encoding);
  return found == kinds.end() ? kNone : found->second;
}

/** OpenCV's code of a conversion; -1 if there is none, -2 if the pixels are the same. */
inline int code(Kind from, Kind to) {
  // OpenCV names a Bayer pattern after its second row's second and third pixel.
  static const std::map<std::pair<Kind, Kind>, int> codes{
      {{kMono, kRgb}, cv::COLOR_GRAY2RGB},      {{kMono, kBgr}, cv::COLOR_GRAY2BGR},
      {{kMono, kRgba}, cv::COLOR_GRAY2RGBA},    {{kMono, kBgra}, cv::COLOR_GRAY2BGRA},
      {{kRgb, kMono}, cv::COLOR_RGB2GRAY},      {{kRgb, kBgr}, cv::COLOR_RGB2BGR},
      {{kRgb, kRgba}, cv::COLOR_RGB2RGBA},      {{kRgb, kBgra}, cv::COLOR_RGB2BGRA},
      {{kBgr, kMono}, cv::COLOR_BGR2GRAY},      {{kBgr, kRgb}, cv::COLOR_BGR2RGB},
      {{kBgr, kRgba}, cv::COLOR_BGR2RGBA},      {{kBgr, kBgra}, cv::COLOR_BGR2BGRA},
      {{kRgba, kMono}, cv::COLOR_RGBA2GRAY},    {{kRgba, kRgb}, cv::COLOR_RGBA2RGB},
      {{kRgba, kBgr}, cv::COLOR_RGBA2BGR},      {{kRgba, kBgra}, cv::COLOR_RGBA2BGRA},
      {{kBgra, kMono}, cv::COLOR_BGRA2GRAY},    {{kBgra, kRgb}, cv::COLOR_BGRA2RGB},
      {{kBgra, kBgr}, cv::COLOR_BGRA2BGR},      {{kBgra, kRgba}, cv::COLOR_BGRA2RGBA},
      {{kYuv, kMono}, cv::COLOR_YUV2GRAY_UYVY}, {{kYuv, kRgb}, cv::COLOR_YUV2RGB_UYVY},
      {{kYuv, kBgr}, cv::COLOR_YUV2BGR_UYVY},   {{kYuv, kRgba}, cv::COLOR_YUV2RGBA_UYVY},
      {{kYuv, kBgra}, cv::COLOR_YUV2BGRA_UYVY}, {{kYuy2, kMono}, cv::COLOR_YUV2GRAY_YUY2},
      {{kYuy2, kRgb}, cv::COLOR_YUV2RGB_YUY2},  {{kYuy2, kBgr}, cv::COLOR_YUV2BGR_YUY2},
      {{kRggb, kMono}, cv::COLOR_BayerBG2GRAY}, {{kRggb, kRgb}, cv::COLOR_BayerBG2RGB},
      {{kRggb, kBgr}, cv::COLOR_BayerBG2BGR},   {{kBggr, kMono}, cv::COLOR_BayerRG2GRAY},
      {{kBggr, kRgb}, cv::COLOR_BayerRG2RGB},   {{kBggr, kBgr}, cv::COLOR_BayerRG2BGR},
      {{kGbrg, kMono}, cv::COLOR_BayerGR2GRAY}, {{kGbrg, kRgb}, cv::COLOR_BayerGR2RGB},
      {{kGbrg, kBgr}, cv::COLOR_BayerGR2BGR},   {{kGrbg, kMono}, cv::COLOR_BayerGB2GRAY},
      {{kGrbg, kRgb}, cv::COLOR_BayerGB2RGB},   {{kGrbg, kBgr}, cv::COLOR_BayerGB2BGR}};
  if (from == to) return -2;
  const auto found = codes.find({from, to});
  return found == codes.end() ? -1 : found->second;
}

/** Image over a message's bytes; in order of this machine. Throws Exception if the message has too few. */
inline cv::Mat pixels(const sensor_msgs::Image& message) {
  const int type = getCvType(message.encoding);
  if (message.width == 0 || message.height == 0) return cv::Mat();
  const size_t row = static_cast<size_t>(message.width) * CV_ELEM_SIZE(type);
  if (message.step < row) throw Exception("Image is wrongly formed: step < width * byte_depth * num_channels");
  if (static_cast<size_t>(message.step) * message.height > message.data.size())
    throw Exception("Image is wrongly formed: height * step != size");
  const cv::Mat mat(static_cast<int>(message.height), static_cast<int>(message.width), type,
                    const_cast<uint8_t*>(message.data.data()), message.step);
  const size_t depth = mat.elemSize1();
  if (!message.is_bigendian || depth == 1) return mat;
  cv::Mat swapped = mat.clone();
  for (int i = 0; i < swapped.rows; ++i)
    for (uint8_t* at = swapped.ptr<uint8_t>(i); at != swapped.ptr<uint8_t>(i) + row; at += depth)
      std::reverse(at, at + depth);
  return swapped;
}

/** Copy of an image in another encoding; "" keeps it. */
inline cv::Mat converted(const cv::Mat& source, const std::string& from, const std::string& to) {
  cv::Mat result;
  const int type = getCvType(to.empty() ? from : to);
  if (to.empty() || from == to || (source.type() == type && (kindOf(from) == kNone || kindOf(to) == kNone))) {
    source.copyTo(result);
    return result;
  }
  const Kind from_kind = kindOf(from), to_kind = kindOf(to);
  if (from_kind == kNone || to_kind == kNone) {
    if (source.channels() != CV_MAT_CN(type))
      throw Exception("[" + (from_kind == kNone ? from : to) + "] is not a color format. but [" +
                      (from_kind == kNone ? to : from) + "] is. The conversion does not make sense");
    source.convertTo(result, type);
    return result;
  }
  const int conversion = code(from_kind, to_kind);
  if (conversion == -1) throw Exception("Unsupported conversion from [" + from + "] to [" + to + "]");
  if (conversion == -2) result = source;
  else cv::cvtColor(source, result, conversion);
  if (result.depth() == CV_MAT_DEPTH(type)) return conversion == -2 ? result.clone() : result;
  cv::Mat scaled;
  result.convertTo(scaled, type, result.depth() == CV_8U ? 65535.0 / 255.0 : 255.0 / 65535.0);
  return scaled;
}

}  // namespace impl

/** Copy a message's image, converted to an encoding; "" keeps its own. Throws Exception. */
inline CvImagePtr toCvCopy(const sensor_msgs::Image& source, const std::string& encoding = std::string()) {
  const std::string target = encoding.empty() ? source.encoding : encoding;
  return boost::make_shared<CvImage>(source.header, target,
                                     impl::converted(impl::pixels(source), source.encoding, target));
}
inline CvImagePtr toCvCopy(const sensor_msgs::ImageConstPtr& source, const std::string& encoding = std::string()) {
  return toCvCopy(*source, encoding);
}
/** Image that shares the message's bytes if they need no conversion; they must not be changed. */
inline CvImageConstPtr toCvShare(const sensor_msgs::Image& source, const boost::shared_ptr<void const>& tracked_object,
                                 const std::string& encoding = std::string()) {
  if ((!encoding.empty() && source.encoding != encoding) ||
      (source.is_bigendian && sensor_msgs::image_encodings::bitDepth(source.encoding) > 8))
    return toCvCopy(source, encoding);
  const CvImagePtr shared = boost::make_shared<CvImage>(source.header, source.encoding, impl::pixels(source));
  shared->tracked_object_ = tracked_object;
  return shared;
}
inline CvImageConstPtr toCvShare(const sensor_msgs::ImageConstPtr& source,
                                 const std::string& encoding = std::string()) {
  return toCvShare(*source, source, encoding);
}
inline CvImagePtr cvtColor(const CvImageConstPtr& source, const std::string& encoding) {
  return boost::make_shared<CvImage>(source->header, encoding,
                                     impl::converted(source->image, source->encoding, encoding));
}

#ifdef TRUNDLE_HAS_IMGCODECS
inline void CvImage::toCompressedImageMsg(sensor_msgs::CompressedImage& message, const Format format) const {
  static const char* const names[] = {"bmp", "dib", "jpg", "jpeg", "jpe", "jp2",  "png",
                                      "pbm", "pgm", "ppm", "sr",   "ras", "tiff", "tif"};
  message.header = header;
  message.format = names[format];
  const cv::Mat pixels =
      encoding == sensor_msgs::image_encodings::BGR8 || encoding == sensor_msgs::image_encodings::BGRA8
          ? image
          : impl::converted(image, encoding, sensor_msgs::image_encodings::BGR8);
  cv::imencode("." + message.format, pixels, message.data);
}
inline CvImagePtr toCvCopy(const sensor_msgs::CompressedImage& source, const std::string& encoding = std::string()) {
  const cv::Mat image = source.data.empty() ? cv::Mat() : cv::imdecode(source.data, cv::IMREAD_COLOR);
  if (image.empty()) throw Exception("the compressed image is damaged, or of an unknown format");
  const std::string bgr = sensor_msgs::image_encodings::BGR8;
  return boost::make_shared<CvImage>(source.header, encoding.empty() ? bgr : encoding,
                                     impl::converted(image, bgr, encoding));
}
inline CvImagePtr toCvCopy(const sensor_msgs::CompressedImageConstPtr& source,
                           const std::string& encoding = std::string()) {
  return toCvCopy(*source, encoding);
}
#endif

}  // namespace cv_bridge
