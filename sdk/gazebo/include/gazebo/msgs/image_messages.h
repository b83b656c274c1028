// Messages of pictures.
#ifndef GAZEBO_MSGS_IMAGE_MESSAGES_H_
#define GAZEBO_MSGS_IMAGE_MESSAGES_H_

#include <cstdint>
#include <string>

#include <boost/shared_ptr.hpp>

#include <gazebo/msgs/fields.h>
#include <gazebo/msgs/msgs.hh>

namespace gazebo {
namespace msgs {

class Image {
  TRUNDLE_FIELD(uint32_t, width)
  TRUNDLE_FIELD(uint32_t, height)
  // A common::Image::PixelFormat.
  TRUNDLE_FIELD(uint32_t, pixel_format)
  // Bytes of a row.
  TRUNDLE_FIELD(uint32_t, step)
  TRUNDLE_FIELD(std::string, data)

 public:
  void set_data(const void* bytes, std::size_t size) { set_data(std::string(static_cast<const char*>(bytes), size)); }
  void Clear() { *this = Image(); }
};

class ImageStamped {
  TRUNDLE_MESSAGE(Time, time)
  TRUNDLE_MESSAGE(Image, image)

 public:
  void Clear() { *this = ImageStamped(); }
};

class ImagesStamped {
  TRUNDLE_MESSAGE(Time, time)
  TRUNDLE_MESSAGES(Image, image)

 public:
  void Clear() { *this = ImagesStamped(); }
};

typedef boost::shared_ptr<Image> ImagePtr;
typedef boost::shared_ptr<ImageStamped> ImageStampedPtr;
typedef boost::shared_ptr<ImagesStamped> ImagesStampedPtr;

}  // namespace msgs
}  // namespace gazebo

typedef const boost::shared_ptr<const gazebo::msgs::Image> ConstImagePtr;
typedef const boost::shared_ptr<const gazebo::msgs::ImageStamped> ConstImageStampedPtr;
typedef const boost::shared_ptr<const gazebo::msgs::ImagesStamped> ConstImagesStampedPtr;

#endif
