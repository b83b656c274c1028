// Checks of transports of images, robots of parts, distances in a URDF and files by URL; then images are published.
#include <combined_robot_hw/combined_robot_hw.h>
#include <hardware_interface/joint_command_interface.h>
#include <image_transport/image_transport.h>
#include <resource_retriever/retriever.h>
#include <ros/ros.h>
#include <ros/xmlrpc_manager.h>
#include <sensor_msgs/CompressedImage.h>
#include <urdf_geometry_parser/urdf_geometry_parser.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iostream>
#include <map>

namespace {

int made = 0, failed = 0;
#define CHECK(cond)                                                        \
  do {                                                                     \
    ++made;                                                                \
    if (!(cond)) {                                                         \
      ++failed;                                                            \
      std::cout << "failed, line " << __LINE__ << ": " #cond << std::endl; \
    }                                                                      \
  } while (false)

/** A smooth picture, which JPEG keeps nearly; each row ends with a gap of two bytes. */
sensor_msgs::Image picture(const std::string& encoding, uint32_t channels) {
  sensor_msgs::Image image;
  image.header.frame_id = "eye";
  image.encoding = encoding;
  image.width = 32;
  image.height = 24;
  image.step = image.width * channels + 2;
  image.data.resize(image.step * image.height);
  for (uint32_t y = 0; y < image.height; ++y)
    for (uint32_t x = 0; x < image.width; ++x)
      for (uint32_t c = 0; c < channels; ++c) image.data[y * image.step + x * channels + c] = 60 + 2 * x + y + 40 * c;
  return image;
}

/** Largest difference of two pictures' values; 1000 if they differ in size or encoding. */
int difference(const sensor_msgs::Image& a, const sensor_msgs::Image& b, uint32_t channels) {
  if (a.encoding != b.encoding || a.width != b.width || a.height != b.height) return 1000;
  int most = 0;
  for (uint32_t y = 0; y < a.height; ++y)
    for (uint32_t x = 0; x < a.width * channels; ++x)
      most = std::max(most, std::abs(int(a.data[y * a.step + x]) - int(b.data[y * b.step + x])));
  return most;
}

struct Heard {
  std::map<std::string, sensor_msgs::ImageConstPtr> images;
  void hear(const std::string& name, const sensor_msgs::ImageConstPtr& image) { images[name] = image; }
};

/** Publish a picture until all transports have brought it. */
std::map<std::string, sensor_msgs::ImageConstPtr> sent(image_transport::ImageTransport& it, const std::string& topic,
                                                       const sensor_msgs::Image& image,
                                                       const std::vector<std::string>& transports) {
  Heard heard;
  std::vector<image_transport::Subscriber> subscribers;
  for (const std::string& name : transports)
    subscribers.push_back(it.subscribe(topic, 1, boost::bind(&Heard::hear, &heard, name, _1), ros::VoidPtr(),
                                       image_transport::TransportHints(name)));
  image_transport::Publisher publisher = it.advertise(topic, 1);
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(20);
  while (heard.images.size() < transports.size() && ros::WallTime::now() < end) {
    publisher.publish(image);
    ros::spinOnce();
    ros::WallDuration(0.02).sleep();
  }
  CHECK(heard.images.size() == transports.size());
  CHECK(publisher.getNumSubscribers() == transports.size());
  CHECK(subscribers.back().getTransport() == transports.back());
  return heard.images;
}

void checkTransports(ros::NodeHandle& node, bool has_compressed) {
  image_transport::ImageTransport it(node);
  const std::vector<std::string> declared = it.getDeclaredTransports(), there = it.getLoadableTransports();
  for (const char* const name : {"image_transport/raw", "image_transport/inverted"}) {
    CHECK(std::count(declared.begin(), declared.end(), name) == 1);
    CHECK(std::count(there.begin(), there.end(), name) == 1);
  }
  std::vector<std::string> transports = {"raw", "inverted"};
  if (has_compressed) transports.push_back("compressed");
  for (const auto& kind : std::map<std::string, uint32_t>{{"rgb8", 3}, {"bgr8", 3}, {"mono8", 1}}) {
    const sensor_msgs::Image image = picture(kind.first, kind.second);
    auto images = sent(it, "jpeg_" + kind.first, image, transports);
    CHECK(images["raw"] && difference(*images["raw"], image, kind.second) == 0);
    CHECK(images["inverted"] && difference(*images["inverted"], image, kind.second) == 0);
    if (has_compressed) CHECK(images["compressed"] && difference(*images["compressed"], image, kind.second) < 12);
    node.setParam("png_" + kind.first + "/compressed/format", "png");
    if (!has_compressed) continue;
    images = sent(it, "png_" + kind.first, image, {"compressed"});
    CHECK(images["compressed"] && difference(*images["compressed"], image, kind.second) == 0);
    CHECK(images["compressed"] && images["compressed"]->header.frame_id == "eye");
  }
  try {
    it.subscribe("shot", 1, image_transport::ImageTransport::ImageCallback(), ros::VoidPtr(),
                 image_transport::TransportHints("no_such"));
    CHECK(!"an unknown transport is refused");
  } catch (const image_transport::TransportLoadException& error) {
    CHECK(error.getTransport() == "no_such");
  }
}

/** Damaged pictures are told of, and do not arrive. */
void checkDamaged(ros::NodeHandle& node) {
  image_transport::ImageTransport it(node);
  int count = 0;
  const image_transport::ImageTransport::ImageCallback hear = [&count](const sensor_msgs::ImageConstPtr&) { ++count; };
  const image_transport::Subscriber images =
      it.subscribe("damaged", 10, hear, ros::VoidPtr(), image_transport::TransportHints("compressed"));
  ros::Publisher publisher = node.advertise<sensor_msgs::CompressedImage>("damaged/compressed", 10);
  while (images.getNumPublishers() == 0 || publisher.getNumSubscribers() == 0) ros::WallDuration(0.01).sleep();
  for (const std::string& bytes : {std::string(), std::string("\xff\xd8\xff\xd9"), std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR"),
                                   std::string("no picture"), std::string("\x89PNG")}) {
    sensor_msgs::CompressedImage message;
    message.format = "jpeg";
    message.data.assign(bytes.begin(), bytes.end());
    publisher.publish(message);
  }
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(1);
  while (ros::WallTime::now() < end) ros::spinOnce();
  CHECK(count == 0);
}

void checkRobot(ros::NodeHandle& node) {
  node.setParam("robot/robot_hardware", std::vector<std::string>{"left", "right"});
  for (const std::string name : {"left", "right"}) {
    node.setParam("robot/" + name + "/type", "cpp_images/Part");
    node.setParam("robot/" + name + "/joint", name + "_joint");
  }
  ros::NodeHandle robot_node(node, "robot");
  combined_robot_hw::CombinedRobotHW robot;
  CHECK(robot.init(node, robot_node));
  hardware_interface::PositionJointInterface* const joints = robot.get<hardware_interface::PositionJointInterface>();
  CHECK(joints && joints->getNames().size() == 2);
  joints->getHandle("right_joint").setCommand(0.5);
  robot.read(ros::Time(1), ros::Duration(0.01));
  CHECK(joints->getHandle("right_joint").getPosition() == 0.5 && joints->getHandle("left_joint").getPosition() == 0);
  hardware_interface::ControllerInfo both;
  both.claimed_resources.emplace_back("hardware_interface::PositionJointInterface",
                                      std::set<std::string>{"left_joint", "right_joint"});
  CHECK(robot.prepareSwitch({both}, {}));
  robot_node.setParam("robot_hardware", std::vector<std::string>{"none"});
  combined_robot_hw::CombinedRobotHW other;
  CHECK(!other.init(node, robot_node));
}

void checkGeometry(ros::NodeHandle& node) {
  node.setParam("robot_description", R"(<robot name="r"><link name="base"/><link name="axle"/>
    <link name="wheel"><collision><geometry><cylinder radius="0.3" length="0.1"/></geometry></collision></link>
    <joint name="a" type="revolute"><parent link="base"/><child link="axle"/><origin xyz="1 0.5 0"/>
      <limit lower="-0.4" upper="0.6" effort="1" velocity="1"/></joint>
    <joint name="b" type="continuous"><parent link="axle"/><child link="wheel"/><origin xyz="0 0 0.2"/></joint></robot>)");
  urdf_geometry_parser::UrdfGeometryParser parser(node, "base");
  urdf::Vector3 to;
  double number = 0;
  CHECK(parser.getTransformVector("b", "base", to) && to.x == 1 && to.y == 0.5 && to.z == 0.2);
  CHECK(parser.getDistanceBetweenJoints("a", "b", number) && number == 0);
  CHECK(parser.getJointRadius("b", number) && number == 0.3);
  CHECK(parser.getJointSteeringLimits("a", number) && number == 0.4);
  CHECK(!parser.getJointRadius("a", number) && !parser.getJointSteeringLimits("b", number));
  CHECK(!parser.getTransformVector("c", "base", to) && !parser.getTransformVector("a", "wheel", to));
}

void checkFiles() {
  resource_retriever::Retriever retriever;
  const resource_retriever::MemoryResource file = retriever.get("package://cpp_images/robots.xml");
  CHECK(file.size > 8 && std::string(file.data.get(), file.data.get() + 8) == "<library");
  for (const std::string url : {"package://cpp_images", "package://no_such/file", "http://localhost/file"}) try {
      retriever.get(url);
      CHECK(!"such a file cannot be read");
    } catch (const resource_retriever::Exception& error) {
      CHECK(std::string(error.what()).find(url) != std::string::npos);
    }
}

std::atomic<bool> is_asked{false};

/** In place of roscpp's own: the program ends when it has done its work. */
void shutdownAsked(XmlRpc::XmlRpcValue& params, XmlRpc::XmlRpcValue& result) {
  std::cout << "asked to end: " << static_cast<std::string>(params[1]) << std::endl;
  is_asked = true;
  result = ros::xmlrpc::responseInt(1, "", 0);
}

void checkManager() {
  CHECK(!ros::XMLRPCManager::instance()->bind("shutdown", shutdownAsked));
  ros::XMLRPCManager::instance()->unbind("shutdown");
  CHECK(ros::XMLRPCManager::instance()->bind("shutdown", shutdownAsked));
  XmlRpc::XmlRpcValue good = ros::xmlrpc::responseStr(1, "", "yes"), bad = ros::xmlrpc::responseBool(0, "no", false);
  XmlRpc::XmlRpcValue value;
  CHECK(ros::XMLRPCManager::instance()->validateXmlrpcResponse("any", good, value));
  CHECK(static_cast<std::string>(value) == "yes");
  CHECK(!ros::XMLRPCManager::instance()->validateXmlrpcResponse("any", bad, value));
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "shots");
  ros::NodeHandle node;
  image_transport::ImageTransport it(node);
  const std::vector<std::string> there = it.getLoadableTransports();
  const bool has_compressed = std::count(there.begin(), there.end(), "image_transport/compressed") > 0;
  checkTransports(node, has_compressed);
  if (has_compressed) checkDamaged(node);
  checkRobot(node);
  checkGeometry(node);
  checkFiles();
  checkManager();
  std::cout << made << " checks, " << failed << " failed" << (has_compressed ? "" : ", nothing compressed") << std::endl;
  const image_transport::Publisher shots = it.advertise("shot", 1);
  while (ros::ok() && !is_asked) {
    shots.publish(picture("rgb8", 3));
    ros::spinOnce();
    ros::WallDuration(0.05).sleep();
  }
  return failed;
}
