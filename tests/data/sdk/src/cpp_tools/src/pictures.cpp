// Conversions of cv_bridge; prints a line for each check that fails.
#include <cv_bridge/cv_bridge.h>
#include <image_geometry/pinhole_camera_model.h>
#include <image_geometry/stereo_camera_model.h>
#include <ros/ros.h>

#include <iostream>

namespace {

int made = 0, failed = 0;
#define CHECK(cond)                                                    \
  do {                                                                 \
    ++made;                                                            \
    if (!(cond)) {                                                     \
      ++failed;                                                        \
      std::cout << "failed, line " << __LINE__ << ": " #cond << std::endl; \
    }                                                                  \
  } while (false)

sensor_msgs::ImagePtr picture(const std::string& encoding, uint32_t width, uint32_t step, std::vector<uint8_t> bytes) {
  const sensor_msgs::ImagePtr image = boost::make_shared<sensor_msgs::Image>();
  image->header.frame_id = "eye";
  image->encoding = encoding;
  image->width = width;
  image->step = step;
  image->height = static_cast<uint32_t>(bytes.size()) / step;
  image->data = bytes;
  return image;
}

std::string fault(const sensor_msgs::Image& image, const std::string& encoding = "") {
  try {
    cv_bridge::toCvCopy(image, encoding);
  } catch (const cv_bridge::Exception& error) {
    return error.what();
  }
  return "";
}

bool isNear(const cv::Point2d& a, double x, double y) { return std::fabs(a.x - x) + std::fabs(a.y - y) < 1e-6; }

void checkCameras() {
  sensor_msgs::CameraInfo info;
  info.width = 640;
  info.height = 480;
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.0);
  info.K = {{500, 0, 320, 0, 400, 240, 0, 0, 1}};
  info.R = {{1, 0, 0, 0, 1, 0, 0, 0, 1}};
  info.P = {{500, 0, 320, 0, 0, 400, 240, 0, 0, 0, 1, 0}};
  image_geometry::PinholeCameraModel camera;
  bool is_refused = false;
  try {
    camera.project3dToPixel(cv::Point3d(1, 1, 1));
  } catch (const image_geometry::Exception&) {
    is_refused = true;
  }
  CHECK(is_refused && !camera.initialized());
  CHECK(camera.fromCameraInfo(info) && !camera.fromCameraInfo(info));
  CHECK(isNear(camera.project3dToPixel(cv::Point3d(1, -1, 2)), 570, 40));
  CHECK(camera.projectPixelTo3dRay(cv::Point2d(570, 40)) == cv::Point3d(0.5, -0.5, 1));
  CHECK(isNear(camera.rectifyPoint(cv::Point2d(3, 4)), 3, 4) && camera.fullResolution() == cv::Size(640, 480));
  info.D = {-0.3, 0.1, 0, 0, 0};
  CHECK(camera.fromCameraInfo(info));
  const cv::Point2d raw = camera.unrectifyPoint(cv::Point2d(600, 440));
  CHECK(raw.x < 600 && raw.y < 440 && cv::norm(camera.rectifyPoint(raw) - cv::Point2d(600, 440)) < 0.1);
  info.D.assign(5, 0.0);
  info.binning_x = info.binning_y = 2;
  info.roi.x_offset = 100;
  info.roi.y_offset = 40;
  info.roi.width = 200;
  info.roi.height = 100;
  CHECK(camera.fromCameraInfo(info) && camera.reducedResolution() == cv::Size(100, 50));
  CHECK(isNear(camera.project3dToPixel(cv::Point3d(0, 0, 1)), 110, 100) && camera.fx() == 250);
  CHECK(isNear(camera.toFullResolution(cv::Point2d(110, 100)), 320, 240));

  sensor_msgs::CameraInfo right = info;
  right.P[3] = -50;  // 0.1 m beside
  image_geometry::StereoCameraModel pair;
  CHECK(pair.fromCameraInfo(info, right) && std::fabs(pair.baseline() - 0.1) < 1e-9);
  CHECK(std::fabs(pair.getZ(10) - 2.5) < 1e-9 && std::fabs(pair.getDisparity(2.5) - 10) < 1e-9);
  cv::Point3d point;
  pair.projectDisparityTo3d(cv::Point2d(360, 100), 10, point);
  CHECK(std::fabs(point.x - 2.5) < 1e-9 && std::fabs(point.z - 2.5) < 1e-9);
  const cv::Matx41d seen = pair.reprojectionMatrix() * cv::Matx41d(360, 100, 10, 1);
  CHECK(std::fabs(seen(0) / seen(3) - 2.5) < 1e-9 && std::fabs(seen(2) / seen(3) - 2.5) < 1e-9);
}

/** Names of OpenCV before 4, without a header of theirs. */
void checkOldNames() {
  const cv::Point corner = cvPoint(3, 4);
  CHECK(corner == cv::Point(3, 4));
  CHECK(CV_BGR2HSV == cv::COLOR_BGR2HSV && CV_FONT_HERSHEY_COMPLEX == cv::FONT_HERSHEY_COMPLEX);
  CHECK(CV_AA == cv::LINE_AA && CV_LOAD_IMAGE_COLOR == 1 && CV_HAAR_SCALE_IMAGE == 2);
  CHECK(cvGetTickCount() > 0 && cvRound(2.6) == 3);
}

}  // namespace

int main() {
  ros::Time::init();
  checkCameras();
  checkOldNames();
  const sensor_msgs::ImagePtr rgb = picture("rgb8", 2, 6, {0, 10, 20, 30, 40, 50});
  const cv_bridge::CvImagePtr bgr = cv_bridge::toCvCopy(rgb, sensor_msgs::image_encodings::BGR8);
  CHECK(bgr->image.at<cv::Vec3b>(0, 1) == cv::Vec3b(50, 40, 30) && bgr->header.frame_id == "eye");
  CHECK(bgr->toImageMsg()->data == std::vector<uint8_t>({20, 10, 0, 50, 40, 30}) && bgr->toImageMsg()->step == 6);
  const cv_bridge::CvImageConstPtr shared = cv_bridge::toCvShare(rgb);
  CHECK(shared->image.data == rgb->data.data() && shared->encoding == "rgb8");
  CHECK(cv_bridge::toCvShare(rgb, "mono8")->image.type() == CV_8UC1);
  // 8 and 16 bits: white stays white.
  const sensor_msgs::ImagePtr gray = picture("mono8", 2, 4, {255, 128, 9, 9});  // rows are padded
  CHECK(cv_bridge::toCvCopy(gray, "mono16")->image.at<uint16_t>(0, 0) == 65535);
  CHECK(cv_bridge::toCvCopy(gray, "rgba8")->image.at<cv::Vec4b>(0, 1) == cv::Vec4b(128, 128, 128, 255));
  CHECK(cv_bridge::toCvCopy(gray)->toImageMsg()->data == std::vector<uint8_t>({255, 128}));
  sensor_msgs::ImagePtr depth = picture("16UC1", 2, 4, {1, 2, 3, 4});
  depth->is_bigendian = 1;
  CHECK(cv_bridge::toCvCopy(depth)->image.at<uint16_t>(0, 1) == 0x304);
  CHECK(cv_bridge::toCvShare(depth, "32FC1")->image.at<float>(0, 0) == 0x102);
  CHECK(cv_bridge::getCvType("32FC4") == CV_32FC4 && cv_bridge::getCvType("bayer_rggb16") == CV_16UC1);
  // A picture of one red pixel per 2 × 2.
  std::vector<uint8_t> mosaic(64, 0);
  for (size_t i = 0; i < 64; i += 16)
    for (size_t k = 0; k < 8; k += 2) mosaic[i + k] = 200;
  const cv::Vec3b center = cv_bridge::toCvCopy(picture("bayer_rggb8", 8, 8, mosaic), "rgb8")->image.at<cv::Vec3b>(4, 4);
  CHECK(center == cv::Vec3b(200, 0, 0));

  CHECK(fault(*rgb, "32FC1").find("is not a color format") != std::string::npos);
  CHECK(fault(*rgb, "none").find("Unrecognized image encoding") != std::string::npos);
  CHECK(fault(*rgb, "yuv422").find("Unsupported conversion") != std::string::npos);
  rgb->height = 4000000000u;
  CHECK(fault(*rgb) == "Image is wrongly formed: height * step != size");
  rgb->step = 5;
  CHECK(fault(*rgb) == "Image is wrongly formed: step < width * byte_depth * num_channels");
  rgb->width = rgb->step = 0;
  CHECK(fault(*rgb).empty());
  std::cout << made << " checks, " << failed << " failed" << std::endl;
  return failed == 0 ? 0 : 1;
}
