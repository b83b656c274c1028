#pragma once

#include <geometry_msgs/Point.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Vector3.h>
#include <ros/ros.h>
#include <std_msgs/ColorRGBA.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "rviz_visual_tools/remote_control.h"

namespace rviz_visual_tools {

static const std::string RVIZ_MARKER_TOPIC = "/rviz_visual_tools";

enum Colors {
  BLACK = 0,
  BROWN = 1,
  BLUE = 2,
  CYAN = 3,
  GREY = 4,
  DARK_GREY = 5,
  GREEN = 6,
  LIME_GREEN = 7,
  MAGENTA = 8,
  ORANGE = 9,
  PURPLE = 10,
  RED = 11,
  PINK = 12,
  WHITE = 13,
  YELLOW = 14,
  TRANSLUCENT = 15,
  TRANSLUCENT_LIGHT = 16,
  TRANSLUCENT_DARK = 17,
  RAND = 18,
  CLEAR = 19,
  DEFAULT = 20
};
typedef Colors colors;

/** Sizes from a millimetre to half a metre. */
enum Scales {
  XXXXSMALL = 1,
  XXXSMALL = 2,
  XXSMALL = 3,
  XSMALL = 4,
  SMALL = 5,
  MEDIUM = 6,
  LARGE = 7,
  XLARGE = 8,
  XXLARGE = 9,
  XXXLARGE = 10,
  XXXXLARGE = 11
};
typedef Scales scales;

/** Markers on a topic. They are kept until trigger, unless enableBatchPublishing is told otherwise. Lengths in [m]. */
class RvizVisualTools {
 public:
  explicit RvizVisualTools(const std::string& base_frame, const std::string& marker_topic = RVIZ_MARKER_TOPIC,
                           const ros::NodeHandle& node = ros::NodeHandle());
  virtual ~RvizVisualTools() {}

  bool deleteAllMarkers();
  bool deleteAllMarkers(const std::string& ns);
  void resetMarkerCounts() { ids_.clear(); }
  void loadMarkerPub(bool wait_for_subscriber = false, bool latched = false);
  bool waitForMarkerSub(double wait_time = 5.0);

  /** Publish the markers that are kept. */
  bool trigger();
  /** Publish them once there are so many. */
  bool triggerEvery(std::size_t queue_size) { return markers_.markers.size() < queue_size || trigger(); }
  void enableBatchPublishing(bool enable = true) { is_batched_ = enable; }

  void setLifetime(double lifetime) { lifetime_ = ros::Duration(lifetime); }
  void setAlpha(double alpha) { alpha_ = alpha; }
  void setGlobalScale(double scale) { global_scale_ = scale; }
  double getGlobalScale() const { return global_scale_; }
  void setBaseFrame(const std::string& frame) { base_frame_ = frame; }
  const std::string getBaseFrame() const { return base_frame_; }

  std_msgs::ColorRGBA getColor(Colors color) const;
  static std::size_t getColorSize() { return DEFAULT + 1; }
  Colors getRandColor() const;
  geometry_msgs::Vector3 getScale(Scales scale, double marker_scale = 1.0) const;

  bool publishText(const Eigen::Isometry3d& pose, const std::string& text, Colors color = WHITE, Scales scale = MEDIUM,
                   bool static_id = true) {
    return publishText(convertPose(pose), text, color, getScale(scale), static_id);
  }
  bool publishText(const geometry_msgs::Pose& pose, const std::string& text, Colors color = WHITE,
                   Scales scale = MEDIUM, bool static_id = true) {
    return publishText(pose, text, color, getScale(scale), static_id);
  }
  bool publishText(const Eigen::Isometry3d& pose, const std::string& text, Colors color,
                   const geometry_msgs::Vector3 scale, bool static_id = true) {
    return publishText(convertPose(pose), text, color, scale, static_id);
  }
  /** A text with a static id replaces the one before it. */
  bool publishText(const geometry_msgs::Pose& pose, const std::string& text, Colors color,
                   const geometry_msgs::Vector3 scale, bool static_id = true);

  /** Poses of programs for Kinetic and before. */
  template <typename... Rest>
  bool publishText(const Eigen::Affine3d& pose, const std::string& text, Rest... rest) {
    return publishText(Eigen::Isometry3d(pose.matrix()), text, rest...);
  }
  template <typename... Rest>
  bool publishAxis(const Eigen::Affine3d& pose, Rest... rest) {
    return publishAxis(Eigen::Isometry3d(pose.matrix()), rest...);
  }
  template <typename... Rest>
  bool publishAxisLabeled(const Eigen::Affine3d& pose, const std::string& label, Rest... rest) {
    return publishAxisLabeled(Eigen::Isometry3d(pose.matrix()), label, rest...);
  }

  bool publishAxis(const Eigen::Isometry3d& pose, Scales scale = MEDIUM, const std::string& ns = "Axis") {
    return publishAxis(convertPose(pose), scale, ns);
  }
  bool publishAxis(const geometry_msgs::Pose& pose, Scales scale = MEDIUM, const std::string& ns = "Axis");
  bool publishAxis(const Eigen::Isometry3d& pose, double length, double radius = 0.01, const std::string& ns = "Axis") {
    return publishAxis(convertPose(pose), length, radius, ns);
  }
  bool publishAxis(const geometry_msgs::Pose& pose, double length, double radius = 0.01,
                   const std::string& ns = "Axis");
  bool publishAxisLabeled(const Eigen::Isometry3d& pose, const std::string& label, Scales scale = MEDIUM,
                          Colors color = WHITE) {
    return publishAxisLabeled(convertPose(pose), label, scale, color);
  }
  bool publishAxisLabeled(const geometry_msgs::Pose& pose, const std::string& label, Scales scale = MEDIUM,
                          Colors color = WHITE);

  bool publishArrow(const Eigen::Isometry3d& pose, Colors color = BLUE, Scales scale = MEDIUM, double length = 0.0,
                    std::size_t id = 0) {
    return publishArrow(convertPose(pose), color, scale, length, id);
  }
  /** Along the pose's x axis; no length means ten times the diameter. */
  bool publishArrow(const geometry_msgs::Pose& pose, Colors color = BLUE, Scales scale = MEDIUM, double length = 0.0,
                    std::size_t id = 0);
  bool publishZArrow(const Eigen::Isometry3d& pose, Colors color = BLUE, Scales scale = MEDIUM, double length = 0.0,
                     std::size_t id = 0) {
    return publishArrow(pose * Eigen::AngleAxisd(-M_PI / 2.0, Eigen::Vector3d::UnitY()), color, scale, length, id);
  }
  bool publishZArrow(const geometry_msgs::Pose& pose, Colors color = BLUE, Scales scale = MEDIUM, double length = 0.0,
                     std::size_t id = 0) {
    return publishZArrow(convertPose(pose), color, scale, length, id);
  }

  bool publishSphere(const Eigen::Isometry3d& pose, Colors color = BLUE, Scales scale = MEDIUM,
                     const std::string& ns = "Sphere", std::size_t id = 0) {
    return publishSphere(convertPose(pose), getColor(color), getScale(scale), ns, id);
  }
  bool publishSphere(const Eigen::Vector3d& point, Colors color = BLUE, Scales scale = MEDIUM,
                     const std::string& ns = "Sphere", std::size_t id = 0) {
    return publishSphere(poseAt(convertPoint(point)), getColor(color), getScale(scale), ns, id);
  }
  bool publishSphere(const geometry_msgs::Point& point, Colors color = BLUE, Scales scale = MEDIUM,
                     const std::string& ns = "Sphere", std::size_t id = 0) {
    return publishSphere(poseAt(point), getColor(color), getScale(scale), ns, id);
  }
  bool publishSphere(const geometry_msgs::Pose& pose, Colors color = BLUE, Scales scale = MEDIUM,
                     const std::string& ns = "Sphere", std::size_t id = 0) {
    return publishSphere(pose, getColor(color), getScale(scale), ns, id);
  }
  /** The scale is the diameter. */
  bool publishSphere(const geometry_msgs::Pose& pose, Colors color, double scale, const std::string& ns = "Sphere",
                     std::size_t id = 0) {
    return publishSphere(pose, getColor(color), cube(scale), ns, id);
  }
  bool publishSphere(const Eigen::Isometry3d& pose, Colors color, double scale, const std::string& ns = "Sphere",
                     std::size_t id = 0) {
    return publishSphere(convertPose(pose), color, scale, ns, id);
  }
  bool publishSphere(const geometry_msgs::Pose& pose, const std_msgs::ColorRGBA& color,
                     const geometry_msgs::Vector3 scale, const std::string& ns = "Sphere", std::size_t id = 0);
  bool publishSpheres(const std::vector<geometry_msgs::Point>& points, Colors color = BLUE, Scales scale = MEDIUM,
                      const std::string& ns = "Spheres") {
    return publishSpheres(points, color, getScale(scale), ns);
  }
  bool publishSpheres(const std::vector<geometry_msgs::Point>& points, Colors color, double scale,
                      const std::string& ns = "Spheres") {
    return publishSpheres(points, color, cube(scale), ns);
  }
  bool publishSpheres(const std::vector<geometry_msgs::Point>& points, Colors color,
                      const geometry_msgs::Vector3& scale, const std::string& ns = "Spheres");

  bool publishLine(const geometry_msgs::Point& from, const geometry_msgs::Point& to, Colors color = BLUE,
                   Scales scale = MEDIUM) {
    return publishLine(from, to, getColor(color), getScale(scale, 0.25));
  }
  bool publishLine(const Eigen::Vector3d& from, const Eigen::Vector3d& to, Colors color = BLUE, Scales scale = MEDIUM) {
    return publishLine(convertPoint(from), convertPoint(to), color, scale);
  }
  bool publishLine(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to, Colors color = BLUE,
                   Scales scale = MEDIUM) {
    return publishLine(Eigen::Vector3d(from.translation()), Eigen::Vector3d(to.translation()), color, scale);
  }
  bool publishLine(const geometry_msgs::Point& from, const geometry_msgs::Point& to, const std_msgs::ColorRGBA& color,
                   const geometry_msgs::Vector3& scale);

  /** A line through points, and a sphere at each. */
  bool publishPath(const std::vector<geometry_msgs::Pose>& path, Colors color = RED, Scales scale = MEDIUM,
                   const std::string& ns = "Path") {
    return publishPath(positions(path), color, getScale(scale, 0.25).x, ns);
  }
  bool publishPath(const std::vector<geometry_msgs::Point>& path, Colors color = RED, Scales scale = MEDIUM,
                   const std::string& ns = "Path") {
    return publishPath(path, color, getScale(scale, 0.25).x, ns);
  }
  bool publishPath(const std::vector<geometry_msgs::Pose>& path, Colors color, double radius,
                   const std::string& ns = "Path") {
    return publishPath(positions(path), color, radius, ns);
  }
  template <typename Allocator>
  bool publishPath(const std::vector<Eigen::Isometry3d, Allocator>& path, Colors color = RED, Scales scale = MEDIUM,
                   const std::string& ns = "Path") {
    return publishPath(positions(path), color, scale, ns);
  }
  template <typename Allocator>
  bool publishPath(const std::vector<Eigen::Isometry3d, Allocator>& path, Colors color, double radius,
                   const std::string& ns = "Path") {
    return publishPath(positions(path), color, radius, ns);
  }
  bool publishPath(const std::vector<geometry_msgs::Point>& path, Colors color, double radius,
                   const std::string& ns = "Path");

  bool publishCuboid(const Eigen::Vector3d& corner, const Eigen::Vector3d& opposite, Colors color = BLUE) {
    return publishCuboid(convertPoint(corner), convertPoint(opposite), color);
  }
  bool publishCuboid(const geometry_msgs::Point& corner, const geometry_msgs::Point& opposite, Colors color = BLUE,
                     const std::string& ns = "Cuboid", std::size_t id = 0);
  bool publishCuboid(const Eigen::Isometry3d& pose, double depth, double width, double height, Colors color = BLUE) {
    return publishCuboid(convertPose(pose), depth, width, height, color);
  }
  bool publishCuboid(const geometry_msgs::Pose& pose, double depth, double width, double height, Colors color = BLUE);
  bool publishCylinder(const Eigen::Isometry3d& pose, Colors color = BLUE, double height = 0.1, double radius = 0.01,
                       const std::string& ns = "Cylinder") {
    return publishCylinder(convertPose(pose), color, height, radius, ns);
  }
  bool publishCylinder(const geometry_msgs::Pose& pose, Colors color = BLUE, double height = 0.1, double radius = 0.01,
                       const std::string& ns = "Cylinder");
  bool publishMesh(const Eigen::Isometry3d& pose, const std::string& file_name, Colors color = CLEAR, double scale = 1,
                   const std::string& ns = "mesh", std::size_t id = 0) {
    return publishMesh(convertPose(pose), file_name, color, scale, ns, id);
  }
  /** CLEAR: with the colors of the file, which is package:// or file://. */
  bool publishMesh(const geometry_msgs::Pose& pose, const std::string& file_name, Colors color = CLEAR,
                   double scale = 1, const std::string& ns = "mesh", std::size_t id = 0);

  /** Publish a marker as it is, or keep it until trigger. */
  bool publishMarker(visualization_msgs::Marker& marker);
  bool publishMarkers(visualization_msgs::MarkerArray& markers);

  static geometry_msgs::Pose convertPose(const Eigen::Isometry3d& pose);
  static Eigen::Isometry3d convertPose(const geometry_msgs::Pose& pose);
  static geometry_msgs::Point convertPoint(const Eigen::Vector3d& point);
  static Eigen::Vector3d convertPoint(const geometry_msgs::Point& point);
  static geometry_msgs::Pose getIdentityPose() { return poseAt(geometry_msgs::Point()); }

  /** Wait for a person; what is kept is published first. */
  void prompt(const std::string& msg) { getRemoteControl()->waitForNextStep(msg); }
  RemoteControlPtr& getRemoteControl() {
    loadRemoteControl();
    return remote_control_;
  }
  void setRemoteControl(const RemoteControlPtr& remote_control) { remote_control_ = remote_control; }
  void loadRemoteControl();

 protected:
  visualization_msgs::Marker marker(const std::string& ns, int type, const std_msgs::ColorRGBA& color,
                                    const geometry_msgs::Vector3& scale, std::size_t id = 0);
  static geometry_msgs::Vector3 cube(double size);
  static geometry_msgs::Pose poseAt(const geometry_msgs::Point& point);
  static std::vector<geometry_msgs::Point> positions(const std::vector<geometry_msgs::Pose>& poses);
  template <typename Allocator>
  static std::vector<geometry_msgs::Point> positions(const std::vector<Eigen::Isometry3d, Allocator>& poses) {
    std::vector<geometry_msgs::Point> result;
    for (const Eigen::Isometry3d& pose : poses) result.push_back(convertPoint(Eigen::Vector3d(pose.translation())));
    return result;
  }

  ros::NodeHandle nh_;
  std::string base_frame_, marker_topic_;

 private:
  ros::Publisher publisher_;
  visualization_msgs::MarkerArray markers_;
  std::map<std::string, int> ids_;
  ros::Duration lifetime_;
  double alpha_ = 1.0, global_scale_ = 1.0;
  bool is_batched_ = true;
  RemoteControlPtr remote_control_;
};

typedef std::shared_ptr<RvizVisualTools> RvizVisualToolsPtr;
typedef std::shared_ptr<const RvizVisualTools> RvizVisualToolsConstPtr;

}  // namespace rviz_visual_tools
