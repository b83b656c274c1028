// republish IN_TRANSPORT in:=TOPIC [OUT_TRANSPORT] out:=TOPIC: images of one transport by another one, or by all.
#include <image_transport/image_transport.h>
#include <ros/ros.h>

#include <algorithm>
#include <iostream>

int main(int argc, char** argv) {
  ros::init(argc, argv, "image_republisher", ros::init_options::AnonymousName);
  if (argc < 2) {
    std::cerr << "usage: republish IN_TRANSPORT in:=TOPIC [OUT_TRANSPORT] out:=TOPIC\n";
    return 1;
  }
  ros::NodeHandle node;
  const std::string from = node.resolveName("in"), to = node.resolveName("out");
  image_transport::ImageTransport transport(node);
  if (argc > 2) {
    const std::string only = "image_transport/" + std::string(argv[2]);
    std::vector<std::string> others = transport.getDeclaredTransports();
    const auto kept = std::remove(others.begin(), others.end(), only);
    if (kept == others.end()) {
      std::cerr << "there is no transport '" << argv[2] << "'\n";
      return 1;
    }
    others.erase(kept, others.end());
    ros::param::set(to + "/disable_pub_plugins", others);
  }
  try {
    const image_transport::Publisher out = transport.advertise(to, 1);
    const image_transport::ImageTransport::ImageCallback pass = [out](const sensor_msgs::ImageConstPtr& image) {
      out.publish(image);
    };
    const image_transport::Subscriber images =
        transport.subscribe(from, 1, pass, ros::VoidPtr(), image_transport::TransportHints(argv[1]));
    ros::spin();
  } catch (const image_transport::TransportLoadException& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
