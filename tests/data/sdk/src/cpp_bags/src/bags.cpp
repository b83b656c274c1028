// Bags: `bags write FILE none|bz2|lz4`, `bags append FILE`, `bags read FILE`, `bags play FILE`, `bags fast FILE`.
#include <cpp_headers/limits.h>
#include <ros/ros.h>
#include <rosbag/bag.h>
#include <rosbag/bag_player.h>
#include <rosbag/query.h>
#include <rosbag/view.h>
#include <std_msgs/Float64.h>
#include <std_msgs/String.h>

#include <boost/foreach.hpp>
#include <iostream>

namespace {

std_msgs::String textOf(const std::string& data) {
  std_msgs::String message;
  message.data = data;
  return message;
}

void write(const std::string& file, const std::string& compression) {
  rosbag::Bag bag(file, rosbag::bagmode::Write);
  bag.setCompression(compression == "bz2"   ? rosbag::compression::BZ2
                     : compression == "lz4" ? rosbag::compression::LZ4
                                            : rosbag::compression::Uncompressed);
  bag.setChunkThreshold(kChunkBytes);
  for (int i = 0; i < 200; ++i) {
    std_msgs::Float64 number;
    number.data = i * 0.5;
    bag.write("/number", ros::Time(100 + i, 500), number);
    if (i % 10 == 0) bag.write("/text", ros::Time(100 + i), textOf("text " + std::to_string(i)));
  }
  bag.write("/text", ros::Time(50), textOf("early"));  // not in the order of time
  rosbag::View open(bag);
  std::cout << "open " << open.size() << std::endl;
  bag.close();
}

void append(const std::string& file) {
  rosbag::Bag bag;
  bag.open(file, rosbag::bagmode::Append);
  const boost::shared_ptr<std_msgs::String> late(new std_msgs::String(textOf("late")));
  boost::shared_ptr<ros::M_string> header(new ros::M_string);
  (*header)["callerid"] = "/writer";
  (*header)["latching"] = "1";
  bag.write("/text", ros::Time(1000), late, header);
}

void read(const std::string& file) {
  rosbag::Bag bag;
  bag.open(file, rosbag::bagmode::Read);
  std::vector<std::string> topics;
  topics.push_back("/text");
  rosbag::View view(bag, rosbag::TopicQuery(topics));
  BOOST_FOREACH (rosbag::MessageInstance const m, view) {
    std_msgs::String::ConstPtr text = m.instantiate<std_msgs::String>();
    if (text) std::cout << m.getTime() << ' ' << m.getTopic() << ' ' << text->data << ' ' << m.getCallerId() << '\n';
    if (m.instantiate<std_msgs::Float64>()) std::cout << "a number" << '\n';
  }
  double sum = 0.0;
  rosbag::View numbers(bag, rosbag::TypeQuery("std_msgs/Float64"), ros::Time(110), ros::Time(120));
  for (rosbag::View::iterator it = numbers.begin(); it != numbers.end(); ++it) {
    const std_msgs::Float64::ConstPtr number = it->instantiate<std_msgs::Float64>();
    if (number) sum += number->data;
  }
  std::cout << "sum " << sum << " of " << numbers.size() << '\n';
  rosbag::View twice(true);
  twice.addQuery(bag);
  twice.addQuery(bag, rosbag::TopicQuery("/text"));
  std::cout << "all " << twice.size() << " from " << twice.getBeginTime() << " to " << twice.getEndTime();
  for (const rosbag::ConnectionInfo* info : twice.getConnections()) std::cout << ' ' << info->topic << '=' << info->datatype;
  std::cout << std::endl;
}

void play(const std::string& file) {
  rosbag::Bag bag(file);
  rosbag::View view(bag, rosbag::TopicQuery("/text"));
  ros::NodeHandle node;
  ros::Publisher publisher = node.advertise<std_msgs::String>("/played", 100);
  while (ros::ok() && publisher.getNumSubscribers() == 0) ros::WallDuration(0.01).sleep();
  for (const rosbag::MessageInstance& m : view) publisher.publish(m);
  ros::spin();
}

int texts = 0, any = 0;
void onText(const boost::shared_ptr<const std_msgs::String>& message) { texts += message->data.substr(0, 4) == "text"; }
void onNumber(const rosbag::MessageInstance& message) { any += message.isType<std_msgs::Float64>(); }

void fast(const std::string& file) {
  rosbag::BagPlayer player(file);
  player.register_callback<std_msgs::String>("/text", onText);
  player.register_callback<rosbag::MessageInstance>("/number", onNumber);
  player.set_start(ros::Time(110));
  player.set_end(ros::Time(160));
  player.set_playback_speed(-1.0);
  player.set_playback_speed(100.0);
  const ros::WallTime begin = ros::WallTime::now();
  player.start_play();
  const double wall = (ros::WallTime::now() - begin).toSec();
  std::cout << texts << " texts, " << any << " numbers to " << player.get_time() << (wall < 0.5 ? ", too fast" : "")
            << std::endl;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argv[1], file = argv[2];
  try {
    if (what == "write") write(file, argv[3]);
    else if (what == "append") append(file);
    else if (what == "read") read(file);
    else if (what == "fast") fast(file);
    else {
      ros::init(argc, argv, "player");
      play(file);
    }
  } catch (const ros::Exception& error) {  // also of a message that is too short
    std::cout << "exception: " << error.what() << std::endl;
  }
  return 0;
}
