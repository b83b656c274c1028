// Checks of small libraries; then a node that passes images on, and publishes diagnostics and a cloud.
#include <angles/angles.h>
#include <bondcpp/bond.h>
#include <camera_calibration_parsers/parse_yml.h>
#include <camera_info_manager/camera_info_manager.h>
#include <control_toolbox/pid.h>
#include <diagnostic_updater/diagnostic_updater.h>
#include <diagnostic_updater/publisher.h>
#include <image_transport/image_transport.h>
#include <image_transport/subscriber_filter.h>
#include <laser_geometry/laser_geometry.h>
#include <realtime_tools/realtime_box.h>
#include <realtime_tools/realtime_buffer.h>
#include <realtime_tools/realtime_publisher.h>
#include <ros/ros.h>
#include <sensor_msgs/fill_image.h>
#include <sensor_msgs/image_encodings.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <sensor_msgs/point_cloud_conversion.h>
#include <std_msgs/Float64.h>
#include <tf2_sensor_msgs/tf2_sensor_msgs.h>

#include <cstdlib>
#include <iostream>
#include <sstream>

namespace {

namespace enc = sensor_msgs::image_encodings;
int made = 0, failed = 0;
#define CHECK(cond)                                                    \
  do {                                                                 \
    ++made;                                                            \
    if (!(cond)) {                                                     \
      ++failed;                                                        \
      std::cout << "failed, line " << __LINE__ << ": " #cond << std::endl; \
    }                                                                  \
  } while (false)

bool near(double a, double b) { return std::fabs(a - b) < 1e-6; }

void checkAngles() {
  CHECK(near(angles::normalize_angle(3 * M_PI), M_PI) && near(angles::normalize_angle(-4.0), 2 * M_PI - 4.0));
  CHECK(near(angles::normalize_angle_positive(-0.5), 2 * M_PI - 0.5) && near(angles::from_degrees(180), M_PI));
  CHECK(near(angles::shortest_angular_distance(3.0, -3.0), 2 * M_PI - 6.0));
  CHECK(near(angles::two_pi_complement(1.0), 1.0 - 2 * M_PI) && near(angles::to_degrees(M_PI), 180));
  double way = 0.0;
  CHECK(angles::shortest_angular_distance_with_limits(2.0, -2.0, -2.5, 2.5, way) && near(way, -4.0));
  CHECK(!angles::shortest_angular_distance_with_limits(3.0, 0.0, -2.5, 2.5, way));
  CHECK(angles::shortest_angular_distance_with_large_limits(0.0, 3.0, -6.0, 1.0, way) && near(way, 3.0 - 2 * M_PI));
  CHECK(angles::shortest_angular_distance_with_large_limits(9.0, 3.0, -10.0, 10.0, way) && near(way, 3.0 + 2 * M_PI - 9.0));
  CHECK(!angles::shortest_angular_distance_with_large_limits(0.0, 3.0, -1.0, 1.0, way));
}

void checkPid() {
  control_toolbox::Pid pid(2.0, 1.0, 0.5, 0.3, -0.3);
  // p: 2·1, i: 1·1·0.1, d: 0.5·(1 - 0)/0.1
  CHECK(near(pid.computeCommand(1.0, ros::Duration(0.1)), 2.0 + 0.1 + 5.0));
  CHECK(near(pid.computeCommand(1.0, ros::Duration(0.1)), 2.0 + 0.2));
  for (int i = 0; i < 10; ++i) pid.computeCommand(1.0, ros::Duration(0.1));
  CHECK(near(pid.computeCommand(1.0, 0.0, ros::Duration(0.1)), 2.3));
  double p, i, d;
  pid.getCurrentPIDErrors(&p, &i, &d);
  CHECK(near(i, 1.3) && near(pid.getCurrentCmd(), 2.3));
  pid.setGains(2.0, 1.0, 0.5, 0.3, -0.3, true);
  pid.computeCommand(1.0, 0.0, ros::Duration(0.1));
  pid.getCurrentPIDErrors(&p, &i, &d);
  CHECK(near(i, 0.3) && pid.computeCommand(std::nan(""), ros::Duration(0.1)) == 0.0);
  ros::NodeHandle gains("~pid");
  CHECK(!pid.init(gains, true));
  gains.setParam("p", 4.0);
  gains.setParam("i_clamp", 2);
  CHECK(pid.init(gains) && near(pid.getGains().p_gain_, 4.0) && near(pid.getGains().i_min_, -2.0));
}

void checkRealtime() {
  realtime_tools::RealtimeBuffer<int> buffer(3);
  CHECK(*buffer.readFromRT() == 3);
  buffer.writeFromNonRT(4);
  CHECK(*buffer.readFromNonRT() == 4 && *buffer.readFromRT() == 4 && *buffer.readFromNonRT() == 4);
  realtime_tools::RealtimeBuffer<int> copy(buffer);
  CHECK(*copy.readFromRT() == 4);
  realtime_tools::RealtimeBox<int> box(1);
  int value = 0;
  box.set(2);
  box.get(value);
  CHECK(value == 2);
}

void checkImages() {
  CHECK(enc::numChannels("rgba8") == 4 && enc::numChannels(enc::TYPE_32FC2) == 2 && enc::numChannels("16UC1") == 1);
  CHECK(enc::bitDepth("mono16") == 16 && enc::bitDepth("64FC1") == 64 && enc::bitDepth("bayer_rggb8") == 8);
  CHECK(enc::isColor("bgr8") && !enc::isColor("mono8") && enc::isBayer("bayer_grbg16") && enc::hasAlpha("bgra8"));
  bool is_refused = false;
  try {
    enc::numChannels("none");
  } catch (const std::runtime_error&) {
    is_refused = true;
  }
  CHECK(is_refused);
  CHECK(image_transport::getCameraInfoTopic("/eye/image_raw") == "/eye/camera_info");
}

void checkOldClouds() {
  sensor_msgs::PointCloud old, back;
  old.points.resize(2);
  old.points[1].y = 2.5f;
  old.channels.resize(1);
  old.channels[0].name = "intensity";
  old.channels[0].values = {7.f, 8.f};
  sensor_msgs::PointCloud2 cloud;
  CHECK(sensor_msgs::convertPointCloudToPointCloud2(old, cloud) && cloud.width == 2 && cloud.point_step == 16);
  CHECK(sensor_msgs::getPointCloud2FieldIndex(cloud, "intensity") == 3);
  CHECK(sensor_msgs::getPointCloud2FieldIndex(cloud, "rgb") == -1);
  CHECK(sensor_msgs::convertPointCloud2ToPointCloud(cloud, back) && back.points[1].y == 2.5f);
  CHECK(back.channels.size() == 1 && back.channels[0].values == old.channels[0].values);
  cloud.width = 4000000000u;
  CHECK(!sensor_msgs::convertPointCloud2ToPointCloud(cloud, back));
  cloud.width = 2;
  cloud.fields[1].offset = 14;
  CHECK(!sensor_msgs::convertPointCloud2ToPointCloud(cloud, back));
  old.channels[0].values.pop_back();
  CHECK(!sensor_msgs::convertPointCloudToPointCloud2(old, cloud));
}

void checkClouds() {
  sensor_msgs::PointCloud2 cloud;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2FieldsByString(2, "xyz", "rgb");
  modifier.resize(3);
  CHECK(cloud.point_step == 32 && cloud.data.size() == 96 && modifier.size() == 3);
  sensor_msgs::PointCloud2Iterator<float> x(cloud, "x");
  sensor_msgs::PointCloud2Iterator<uint8_t> red(cloud, "r");
  for (int i = 0; x != x.end(); ++x, ++red, ++i) {
    x[2] = static_cast<float>(i);
    *red = static_cast<uint8_t>(10 * i);
  }
  sensor_msgs::PointCloud2ConstIterator<float> z(cloud, "z");
  CHECK(*(z + 2) == 2.0f && cloud.data[2 * 32 + 18] == 20);
  cloud.width = 1000;  // more points than bytes
  bool is_refused = false;
  try {
    sensor_msgs::PointCloud2ConstIterator<float> broken(cloud, "z");
  } catch (const std::runtime_error&) {
    is_refused = true;
  }
  CHECK(is_refused);

  sensor_msgs::LaserScan scan;
  scan.header.frame_id = "laser";
  scan.header.stamp = ros::Time(100);
  scan.angle_increment = static_cast<float>(M_PI / 2);
  scan.range_min = 0.1f;
  scan.range_max = 5.0f;
  scan.time_increment = 0.5f;
  for (const float range : {1.0f, 2.0f, 9.0f, std::nanf("")}) scan.ranges.push_back(range);
  scan.intensities.assign(4, 7.0f);
  laser_geometry::LaserProjection projection;
  projection.projectLaser(scan, cloud);
  CHECK(cloud.width == 2 && cloud.fields.size() == 5 && cloud.fields[4].name == "index");
  sensor_msgs::PointCloud2ConstIterator<float> y(cloud, "y"), intensity(cloud, "intensity");
  CHECK(near(*(y + 1), 2.0) && *intensity == 7.0f && *sensor_msgs::PointCloud2ConstIterator<int>(cloud, "index") == 0);
  geometry_msgs::TransformStamped up;
  up.header.frame_id = "base";
  up.transform.translation.z = 3.0;
  up.transform.rotation.w = 1.0;
  sensor_msgs::PointCloud2 higher;
  tf2::doTransform(cloud, higher, up);
  CHECK(near(*sensor_msgs::PointCloud2ConstIterator<float>(higher, "z"), 3.0) && higher.header.frame_id == "base");
  projection.projectLaser(scan, cloud, 1.5);
  CHECK(cloud.width == 1);
  sensor_msgs::PointCloud points;
  tf::Transformer frames;
  for (int i = 0; i < 4; ++i)  // it moves by 1 m each second, and the second ray is half a second late
    frames.setTransform(tf::StampedTransform(tf::Transform(tf::Quaternion(0, 0, 0, 1), tf::Vector3(i, 0, 0)),
                                             ros::Time(100 + i), "odom", "laser"));
  projection.transformLaserScanToPointCloud("odom", scan, points, frames);
  CHECK(points.points.size() == 2 && near(points.points[1].x, 0.5) && points.header.frame_id == "odom");
}

double least = 1.0, most = 2.0;

class Node {
 public:
  Node()
      : images_(node_),
        out_(images_.advertiseCamera("small/image", 1)),
        in_(images_.subscribeCamera("eye/image_raw", 1, &Node::onImage, this)),
        numbers_(node_, "numbers", 1),
        ticks_("ticks", updater_, diagnostic_updater::FrequencyStatusParam(&least, &most)) {
    updater_.setHardwareIDf("robot %d", 7);
    updater_.add("battery", this, &Node::onBattery);
    timer_ = node_.createTimer(ros::Duration(0.05), [this](const ros::TimerEvent&) {
      updater_.update();
      if (!numbers_.trylock()) return;
      numbers_.msg_.data += 1.0;
      numbers_.unlockAndPublish();
    });
  }

 private:
  void onImage(const sensor_msgs::ImageConstPtr& image, const sensor_msgs::CameraInfoConstPtr& info) {
    sensor_msgs::Image half;
    half.header = image->header;
    const std::vector<uint8_t> row(image->data.begin(), image->data.begin() + image->step);
    sensor_msgs::fillImage(half, image->encoding, 1, image->width, image->step, row.data());
    out_.publish(half, *info);
  }
  void onBattery(diagnostic_updater::DiagnosticStatusWrapper& status) {
    status.summary(diagnostic_msgs::DiagnosticStatus::OK, "full");
    status.mergeSummaryf(diagnostic_msgs::DiagnosticStatus::WARN, "hot: %d °C", 60);
    status.add("volts", 12.5);
    status.add("charging", true);
    status.addf("cells", "%d of %d", 3, 4);
  }

  ros::NodeHandle node_;
  image_transport::ImageTransport images_;
  image_transport::CameraPublisher out_;
  image_transport::CameraSubscriber in_;
  realtime_tools::RealtimePublisher<std_msgs::Float64> numbers_;
  diagnostic_updater::Updater updater_;
  diagnostic_updater::HeaderlessTopicDiagnostic ticks_;
  ros::Timer timer_;
};

}  // namespace

void checkCalibration() {
  const std::string file = std::string(std::getenv("ROS_HOME")) + "/camera_info/left.yaml";
  camera_info_manager::CameraInfoManager camera(ros::NodeHandle("left"), "left");
  CHECK(!camera.isCalibrated() && camera.getCameraInfo().width == 0);
  CHECK(camera.resolveURL("", "left") == "file://" + file);
  CHECK(camera.validateURL("package://a/b.yaml") && !camera.validateURL("http://a/b.yaml") && camera.validateURL(""));
  sensor_msgs::SetCameraInfo call;
  call.request.camera_info.width = 640;
  call.request.camera_info.height = 480;
  call.request.camera_info.distortion_model = "plumb_bob";
  call.request.camera_info.D = {0.1, -0.2, 1e-3, 0, 0};
  for (size_t i = 0; i < 9; ++i) call.request.camera_info.K[i] = 0.1 * static_cast<double>(i + 1);
  ros::AsyncSpinner spinner(1);
  spinner.start();
  CHECK(ros::service::call("/left/set_camera_info", call) && call.response.success);
  camera_info_manager::CameraInfoManager again(ros::NodeHandle("again"), "left", "file://${ROS_HOME}/camera_info/${NAME}.yaml");
  const sensor_msgs::CameraInfo read = again.getCameraInfo();
  CHECK(again.isCalibrated() && read.K == call.request.camera_info.K && read.D == call.request.camera_info.D);
  CHECK(read.width == 640 && read.distortion_model == "plumb_bob");
  CHECK(!again.setCameraName("a/b") && again.setCameraName("right") && !again.loadCameraInfo("package://none/a.yaml"));
  std::istringstream calibration("image_width: 8\nimage_height: 6\ncamera_name: 'narrow stereo'\ncamera_matrix: !!opencv\n"
                                 "  rows: 3\n  cols: 3\n  data: [ 1., 0., 4.,\n    0., 1., 3., 0., 0., 1. ]\n"
                                 "distortion_coefficients:\n  data:\n  - 0.5\n  - -1\nrectification_matrix:\n"
                                 "  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]\nprojection_matrix:\n"
                                 "  data: [1, 0, 4, 0, 0, 1, 3, 0, 0, 0, 1, 0]\n");
  std::string name;
  sensor_msgs::CameraInfo info;
  CHECK(camera_calibration_parsers::readCalibrationYml(calibration, name, info) && name == "narrow stereo");
  CHECK(info.K[2] == 4 && info.K[4] == 1 && info.D == std::vector<double>({0.5, -1}) && info.P[6] == 3);
  std::istringstream damaged("image_width: x\nimage_height: 6\n"), empty;
  CHECK(!camera_calibration_parsers::readCalibrationYml(damaged, name, info) && info.width == 8);
  CHECK(!camera_calibration_parsers::readCalibrationYml(empty, name, info));
}

void checkBonds() {
  ros::AsyncSpinner spinner(1);
  spinner.start();
  bond::Bond one("/bonds", "both"), other("/bonds", "both");
  one.setFormedCallback([&one] { one.breakBond(); });
  one.start();
  other.start();
  CHECK(one.waitUntilFormed(ros::Duration(20.0)) && other.waitUntilBroken(ros::Duration(20.0)));
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "tools");
  ros::NodeHandle node;
  checkAngles();
  checkPid();
  checkRealtime();
  checkImages();
  checkClouds();
  checkOldClouds();
  checkCalibration();
  checkBonds();
  std::cout << made << " checks, " << failed << " failed" << std::endl;
  if (failed) return 1;
  Node tools;
  ros::spin();
  return 0;
}
