#include "rviz_visual_tools/rviz_visual_tools.h"

#include <cmath>

namespace rviz_visual_tools {
namespace {

using visualization_msgs::Marker;

/** Red, green, blue, opacity; by the numbers of Colors. */
constexpr float kColors[][4] = {
    {0.0F, 0.0F, 0.0F, 1.0F}, {0.6F, 0.3F, 0.1F, 1.0F}, {0.1F, 0.1F, 0.8F, 1.0F}, {0.0F, 1.0F, 1.0F, 1.0F},
    {0.9F, 0.9F, 0.9F, 1.0F}, {0.6F, 0.6F, 0.6F, 1.0F}, {0.1F, 0.8F, 0.1F, 1.0F}, {0.6F, 1.0F, 0.2F, 1.0F},
    {1.0F, 0.0F, 1.0F, 1.0F}, {1.0F, 0.5F, 0.0F, 1.0F}, {0.6F, 0.2F, 0.8F, 1.0F}, {0.8F, 0.1F, 0.1F, 1.0F},
    {1.0F, 0.4F, 1.0F, 1.0F}, {1.0F, 1.0F, 1.0F, 1.0F}, {1.0F, 1.0F, 0.0F, 1.0F}, {0.1F, 0.1F, 0.1F, 0.25F},
    {0.1F, 0.1F, 0.1F, 0.1F}, {0.1F, 0.1F, 0.1F, 0.5F}, {0.5F, 0.5F, 0.5F, 1.0F}, {0.0F, 0.0F, 0.0F, 0.0F},
    {0.1F, 0.1F, 0.8F, 1.0F},
};
/** Sizes by the numbers of Scales [m]. */
constexpr double kScales[] = {0.01, 0.001, 0.0025, 0.005, 0.0065, 0.0075, 0.01, 0.025, 0.05, 0.075, 0.1, 0.5};

}  // namespace

RvizVisualTools::RvizVisualTools(const std::string& base_frame, const std::string& marker_topic,
                                 const ros::NodeHandle& node)
    : nh_(node), base_frame_(base_frame), marker_topic_(marker_topic) {
  loadMarkerPub();
}

void RvizVisualTools::loadMarkerPub(bool wait_for_subscriber, bool latched) {
  if (!publisher_) publisher_ = nh_.advertise<visualization_msgs::MarkerArray>(marker_topic_, 10, latched);
  if (wait_for_subscriber) waitForMarkerSub();
}

bool RvizVisualTools::waitForMarkerSub(double wait_time) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(wait_time);
  while (ros::ok() && publisher_.getNumSubscribers() == 0 && ros::WallTime::now() < end)
    ros::WallDuration(0.01).sleep();
  return publisher_.getNumSubscribers() > 0;
}

bool RvizVisualTools::deleteAllMarkers() {
  markers_.markers.clear();
  resetMarkerCounts();
  Marker all;
  all.header.frame_id = base_frame_;
  all.action = Marker::DELETEALL;
  all.pose.orientation.w = 1.0;
  return publishMarker(all);
}

bool RvizVisualTools::deleteAllMarkers(const std::string& ns) {
  for (int id = ids_[ns]; id > 0; --id) {
    Marker one;
    one.header.frame_id = base_frame_;
    one.ns = ns;
    one.id = id;
    one.action = Marker::DELETE;
    publishMarker(one);
  }
  ids_.erase(ns);
  return true;
}

bool RvizVisualTools::trigger() {
  if (markers_.markers.empty()) return false;
  publisher_.publish(markers_);
  markers_.markers.clear();
  return true;
}

bool RvizVisualTools::publishMarker(Marker& marker) {
  markers_.markers.push_back(marker);
  return is_batched_ || trigger();
}

bool RvizVisualTools::publishMarkers(visualization_msgs::MarkerArray& markers) {
  markers_.markers.insert(markers_.markers.end(), markers.markers.begin(), markers.markers.end());
  return is_batched_ || trigger();
}

Colors RvizVisualTools::getRandColor() const {
  static const Colors kChoice[] = {RED, GREEN, BLUE, GREY, DARK_GREY, WHITE, ORANGE, YELLOW, BROWN, PINK, PURPLE};
  static std::mt19937 random;
  return kChoice[random() % (sizeof(kChoice) / sizeof(*kChoice))];
}

std_msgs::ColorRGBA RvizVisualTools::getColor(Colors color) const {
  if (color == RAND) color = getRandColor();
  const auto& values = kColors[color >= BLACK && color <= DEFAULT ? color : DEFAULT];
  std_msgs::ColorRGBA result;
  result.r = values[0];
  result.g = values[1];
  result.b = values[2];
  result.a = values[3] == 1.0F ? static_cast<float>(alpha_) : values[3];
  return result;
}

geometry_msgs::Vector3 RvizVisualTools::getScale(Scales scale, double marker_scale) const {
  const double size = kScales[scale >= XXXXSMALL && scale <= XXXXLARGE ? scale : 0];
  return cube(size * marker_scale * global_scale_);
}

Marker RvizVisualTools::marker(const std::string& ns, int type, const std_msgs::ColorRGBA& color,
                               const geometry_msgs::Vector3& scale, std::size_t id) {
  Marker result;
  result.header.frame_id = base_frame_;
  result.header.stamp = ros::Time::now();
  result.ns = ns;
  result.id = id == 0 ? ++ids_[ns] : static_cast<int>(id);
  result.type = type;
  result.action = Marker::ADD;
  result.pose.orientation.w = 1.0;
  result.color = color;
  result.scale = scale;
  result.lifetime = lifetime_;
  return result;
}

bool RvizVisualTools::publishText(const geometry_msgs::Pose& pose, const std::string& text, Colors color,
                                  const geometry_msgs::Vector3 scale, bool static_id) {
  if (static_id) ids_["Text"] = 0;
  Marker shown = marker("Text", Marker::TEXT_VIEW_FACING, getColor(color), scale);
  shown.pose = pose;
  shown.text = text;
  return publishMarker(shown);
}

bool RvizVisualTools::publishAxis(const geometry_msgs::Pose& pose, Scales scale, const std::string& ns) {
  const double size = getScale(scale).x;
  return publishAxis(pose, 10.0 * size, size, ns);
}

bool RvizVisualTools::publishAxis(const geometry_msgs::Pose& pose, double length, double radius,
                                  const std::string& ns) {
  const Eigen::Isometry3d frame = convertPose(pose);
  const Colors axis_colors[] = {RED, GREEN, BLUE};
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Isometry3d bar = frame * Eigen::Translation3d(0.5 * length * Eigen::Vector3d::Unit(axis));
    bar.rotate(Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Unit(axis)));
    publishCylinder(convertPose(bar), axis_colors[axis], length, radius, ns);
  }
  return true;
}

bool RvizVisualTools::publishAxisLabeled(const geometry_msgs::Pose& pose, const std::string& label, Scales scale,
                                         Colors color) {
  publishAxis(pose, scale, label);
  geometry_msgs::Pose above = pose;
  above.position.z += 4.0 * getScale(scale).x;
  return publishText(above, label, color, scale, false);
}

bool RvizVisualTools::publishArrow(const geometry_msgs::Pose& pose, Colors color, Scales scale, double length,
                                   std::size_t id) {
  geometry_msgs::Vector3 size = getScale(scale);
  size.x = length == 0.0 ? 10.0 * size.y : length;
  Marker shown = marker("Arrow", Marker::ARROW, getColor(color), size, id);
  shown.pose = pose;
  return publishMarker(shown);
}

bool RvizVisualTools::publishSphere(const geometry_msgs::Pose& pose, const std_msgs::ColorRGBA& color,
                                    const geometry_msgs::Vector3 scale, const std::string& ns, std::size_t id) {
  Marker shown = marker(ns, Marker::SPHERE, color, scale, id);
  shown.pose = pose;
  return publishMarker(shown);
}

bool RvizVisualTools::publishSpheres(const std::vector<geometry_msgs::Point>& points, Colors color,
                                     const geometry_msgs::Vector3& scale, const std::string& ns) {
  Marker shown = marker(ns, Marker::SPHERE_LIST, getColor(color), scale);
  shown.points = points;
  return publishMarker(shown);
}

bool RvizVisualTools::publishLine(const geometry_msgs::Point& from, const geometry_msgs::Point& to,
                                  const std_msgs::ColorRGBA& color, const geometry_msgs::Vector3& scale) {
  Marker shown = marker("Line", Marker::LINE_STRIP, color, scale);
  shown.points = {from, to};
  return publishMarker(shown);
}

bool RvizVisualTools::publishPath(const std::vector<geometry_msgs::Point>& path, Colors color, double radius,
                                  const std::string& ns) {
  if (path.size() < 2) {
    ROS_WARN_STREAM("Skipping path because " << path.size() << " points passed in.");
    return false;
  }
  Marker line = marker(ns, Marker::LINE_STRIP, getColor(color), cube(radius));
  line.points = path;
  return publishMarker(line) && publishSpheres(path, color, cube(2.0 * radius), ns + " Spheres");
}

bool RvizVisualTools::publishCuboid(const geometry_msgs::Point& corner, const geometry_msgs::Point& opposite,
                                    Colors color, const std::string& ns, std::size_t id) {
  geometry_msgs::Vector3 size;
  size.x = std::abs(opposite.x - corner.x);
  size.y = std::abs(opposite.y - corner.y);
  size.z = std::abs(opposite.z - corner.z);
  Marker shown = marker(ns, Marker::CUBE, getColor(color), size, id);
  shown.pose.position = convertPoint(Eigen::Vector3d((convertPoint(corner) + convertPoint(opposite)) / 2.0));
  return publishMarker(shown);
}

bool RvizVisualTools::publishCuboid(const geometry_msgs::Pose& pose, double depth, double width, double height,
                                    Colors color) {
  geometry_msgs::Vector3 size;
  size.x = depth;
  size.y = width;
  size.z = height;
  Marker shown = marker("Cuboid", Marker::CUBE, getColor(color), size);
  shown.pose = pose;
  return publishMarker(shown);
}

bool RvizVisualTools::publishCylinder(const geometry_msgs::Pose& pose, Colors color, double height, double radius,
                                      const std::string& ns) {
  geometry_msgs::Vector3 size = cube(2.0 * radius);
  size.z = height;
  Marker shown = marker(ns, Marker::CYLINDER, getColor(color), size);
  shown.pose = pose;
  return publishMarker(shown);
}

bool RvizVisualTools::publishMesh(const geometry_msgs::Pose& pose, const std::string& file_name, Colors color,
                                  double scale, const std::string& ns, std::size_t id) {
  Marker shown = marker(ns, Marker::MESH_RESOURCE, getColor(color), cube(scale), id);
  shown.pose = pose;
  shown.mesh_resource = file_name;
  shown.mesh_use_embedded_materials = color == CLEAR;
  return publishMarker(shown);
}

geometry_msgs::Pose RvizVisualTools::convertPose(const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond turn(pose.linear());
  geometry_msgs::Pose result = poseAt(convertPoint(Eigen::Vector3d(pose.translation())));
  result.orientation.x = turn.x();
  result.orientation.y = turn.y();
  result.orientation.z = turn.z();
  result.orientation.w = turn.w();
  return result;
}

Eigen::Isometry3d RvizVisualTools::convertPose(const geometry_msgs::Pose& pose) {
  const auto& q = pose.orientation;
  return Eigen::Translation3d(convertPoint(pose.position)) * Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized();
}

geometry_msgs::Point RvizVisualTools::convertPoint(const Eigen::Vector3d& point) {
  geometry_msgs::Point result;
  result.x = point.x();
  result.y = point.y();
  result.z = point.z();
  return result;
}

Eigen::Vector3d RvizVisualTools::convertPoint(const geometry_msgs::Point& point) {
  return Eigen::Vector3d(point.x, point.y, point.z);
}

void RvizVisualTools::loadRemoteControl() {
  if (!remote_control_) remote_control_ = std::make_shared<RemoteControl>(nh_);
}

geometry_msgs::Vector3 RvizVisualTools::cube(double size) {
  geometry_msgs::Vector3 result;
  result.x = result.y = result.z = size;
  return result;
}

geometry_msgs::Pose RvizVisualTools::poseAt(const geometry_msgs::Point& point) {
  geometry_msgs::Pose result;
  result.position = point;
  result.orientation.w = 1.0;
  return result;
}

std::vector<geometry_msgs::Point> RvizVisualTools::positions(const std::vector<geometry_msgs::Pose>& poses) {
  std::vector<geometry_msgs::Point> result;
  for (const geometry_msgs::Pose& pose : poses) result.push_back(pose.position);
  return result;
}

}  // namespace rviz_visual_tools
