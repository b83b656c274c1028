// Prints a line for each check that fails, and at the end how many were made.
#include <cpp_nodes/AddTwoInts.h>
#include <cpp_nodes/Reading.h>
#include <geometry_msgs/PoseStamped.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_msgs/Int32.h>
#include <std_msgs/String.h>
#include <xmlrpcpp/XmlRpc.h>

#include <atomic>
#include <iostream>
#include <thread>

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

/** Run callbacks until a condition holds. */
template <class Condition>
bool waitFor(Condition condition) {
  for (int i = 0; i < 3000 && ros::ok() && !condition(); ++i) {
    ros::spinOnce();
    ros::WallDuration(0.01).sleep();
  }
  return condition();
}

void checkTime() {
  CHECK((ros::Duration(1.5) + ros::Duration(0, 600000000)).toSec() == 2.1);
  CHECK((-ros::Duration(0.5)).sec == -1 && (-ros::Duration(0.5)).nsec == 500000000);
  CHECK((ros::Time(10, 0) - ros::Time(9.25)) == ros::Duration(0.75));
  CHECK(ros::Time(1.0) + ros::Duration(2) * 0.5 == ros::Time(2, 0));
  CHECK(ros::Time().isZero() && ros::TIME_MAX > ros::Time(5));
  std::stringstream text;
  text << ros::Time(3, 4) << " " << ros::Duration(-1.25);
  CHECK(text.str() == "3.000000004 -1.250000000");
  text.width(9);
  text << ros::Time(7, 5) << ros::Duration(2.5);
  CHECK(text.str().substr(24) == "        7.000000005        2.500000000" && text.width() == 9);
  int refused = 0;
  for (const ros::Duration& span : {ros::Duration(2.0), ros::DURATION_MIN}) try {
      ros::Time(1.0) - span;
    } catch (const std::runtime_error&) {
      ++refused;
    }
  CHECK(refused == 2);
}

void checkSerialization() {
  cpp_nodes::Reading reading;
  CHECK(reading.position[2] == 0.0 && reading.is_on == 0 && cpp_nodes::Reading::LIMIT == -7);
  CHECK(cpp_nodes::Reading::TITLE == "a \"title\" # with a sign");
  reading.header.frame_id = "map";
  reading.names = {"a", "", "ccc"};
  reading.position[1] = -2.5;
  reading.bytes.assign(200, 7);
  reading.colors.resize(70);
  reading.colors[69].g = 0.5F;
  reading.when = ros::Time(5, 6);
  reading.span = ros::Duration(-1.5);
  reading.is_on = true;
  ros::SerializedMessage bytes = ros::serialization::serializeMessage(reading);
  cpp_nodes::Reading copy;
  ros::serialization::deserializeMessage(bytes, copy);
  CHECK(copy == reading);
  copy.colors[69].g = 0.25F;
  CHECK(copy != reading);
  std::stringstream text;
  text << reading;
  CHECK(text.str().find("frame_id: map") != std::string::npos);
  CHECK(std::string(ros::message_traits::datatype(reading)) == "cpp_nodes/Reading");
  CHECK(ros::message_traits::timeStamp(reading) == &reading.header.stamp);
  CHECK(!ros::message_traits::isFixedSize<cpp_nodes::Reading>() && ros::message_traits::isFixedSize<std_msgs::Int32>());
  // Bytes that end early, or whose lengths lie, are refused at every place.
  for (size_t end = 4; end < bytes.num_bytes; ++end) {
    ros::serialization::IStream stream(bytes.message_start, static_cast<uint32_t>(end - 4));
    bool is_refused = false;
    try {
      ros::serialization::deserialize(stream, copy);
    } catch (const ros::serialization::StreamOverrunException&) {
      is_refused = true;
    }
    if (!is_refused) CHECK(is_refused);
  }
  for (size_t at = 4; at + 4 < bytes.num_bytes; ++at) {
    ros::SerializedMessage lying = bytes;
    lying.buf.reset(new uint8_t[bytes.num_bytes]);
    std::copy(bytes.buf.get(), bytes.buf.get() + bytes.num_bytes, lying.buf.get());
    lying.message_start = lying.buf.get() + 4;
    for (int i = 0; i < 4; ++i) lying.buf[at + i] = 0xFF;
    try {
      ros::serialization::deserializeMessage(lying, copy);
    } catch (const ros::serialization::StreamOverrunException&) {
    }
  }
}

int by_value = 0, by_pointer = 0, by_event = 0, by_boost = 0, changed = 0;
std::string publisher_name;
void onInt(std_msgs::Int32 m) { by_value += m.data; }
void onPointer(const std_msgs::Int32ConstPtr& m) { by_pointer += m->data; }
void onEvent(const ros::MessageEvent<std_msgs::Int32 const>& event) {
  by_event += event.getMessage()->data;
  publisher_name = event.getPublisherName();
}
void onBoost(const std_msgs::Int32ConstPtr& m, int factor) { by_boost += factor * m->data; }
void onMutable(const std_msgs::Int32Ptr& m) {
  m->data += 1;
  changed = m->data;
}
const void *seen = nullptr, *seen_mutable = nullptr;
void onOnlyMutable(const std_msgs::Int32Ptr& m) { seen_mutable = m.get(); }
void onSame(const geometry_msgs::PoseStampedConstPtr& m) { seen = m.get(); }

void checkTopics(ros::NodeHandle& n) {
  ros::Publisher pub = n.advertise<std_msgs::Int32>("numbers", 5, true);
  std_msgs::Int32 number;
  number.data = 5;
  pub.publish(number);
  std::vector<ros::Subscriber> subscribers;
  subscribers.push_back(n.subscribe("numbers", 5, onInt));
  subscribers.push_back(n.subscribe("numbers", 5, onPointer, ros::TransportHints().tcpNoDelay()));
  subscribers.push_back(n.subscribe("numbers", 5, onEvent));
  subscribers.push_back(n.subscribe<std_msgs::Int32>("numbers", 5, boost::bind(onBoost, _1, 3)));
  subscribers.push_back(n.subscribe("numbers", 5, onMutable));
  int by_lambda = 0;
  subscribers.push_back(n.subscribe<std_msgs::Int32>(
      "numbers", 5, [&by_lambda](const std_msgs::Int32ConstPtr& m) { by_lambda += m->data; }));
  CHECK(pub.getNumSubscribers() == 1 && pub.isLatched());
  pub.publish(number);
  CHECK(waitFor([] { return changed == 6; }));
  CHECK(waitFor([&] { return by_value == 10 && by_pointer == 10 && by_event == 10 && by_boost == 30 && by_lambda == 10; }));
  CHECK(number.data == 5 && publisher_name == ros::this_node::getName());

  // Within a process, subscribers get the object itself.
  ros::Publisher poses = n.advertise<geometry_msgs::PoseStamped>("poses", 1);
  ros::Subscriber same = n.subscribe("poses", 1, onSame);
  const geometry_msgs::PoseStampedPtr pose = boost::make_shared<geometry_msgs::PoseStamped>();
  poses.publish(pose);
  CHECK(waitFor([] { return seen != nullptr; }));
  CHECK(seen == pose.get());

  // Also the only one of a topic that may change it.
  ros::Publisher numbers = n.advertise<std_msgs::Int32>("own_numbers", 1);
  const ros::Subscriber only = n.subscribe("own_numbers", 1, onOnlyMutable);
  const std_msgs::Int32Ptr own = boost::make_shared<std_msgs::Int32>();
  numbers.publish(own);
  CHECK(waitFor([] { return seen_mutable != nullptr; }));
  CHECK(seen_mutable == own.get());

  ros::AdvertiseOptions any("any", 1, "*", "std_msgs/Int32", "");
  try {
    n.advertise(any);
    CHECK(!"a type is needed");
  } catch (const ros::InvalidParameterException&) {
  }

  same.shutdown();
  CHECK(!same && same.getNumPublishers() == 0 && poses.getNumSubscribers() == 0);

  ros::NodeHandle ended;
  ended.shutdown();
  CHECK(!ended.ok() && n.ok());

  // A queue of its own, whose oldest messages are dropped.
  ros::CallbackQueue queue;
  ros::NodeHandle other(n);
  other.setCallbackQueue(&queue);
  std::vector<int> received;
  ros::Subscriber few = other.subscribe<std_msgs::Int32>(
      "fast", 2, [&received](const std_msgs::Int32ConstPtr& m) { received.push_back(m->data); });
  ros::Publisher fast = n.advertise<std_msgs::Int32>("fast", 10);
  for (int i = 0; i < 5; ++i) {
    number.data = i;
    fast.publish(number);
  }
  queue.callAvailable(ros::WallDuration(1));
  CHECK(received == (std::vector<int>{3, 4}));
  CHECK(queue.isEmpty());

  // Members of a plugin are destroyed in the reverse order of their declarations: the queue may come first.
  ros::Subscriber longer;
  {
    ros::CallbackQueue brief;
    other.setCallbackQueue(&brief);
    longer = other.subscribe<std_msgs::Int32>(
        "fast", 1, [&received](const std_msgs::Int32ConstPtr& m) { received.push_back(m->data); });
    CHECK(ros::CallbackQueueInterface::exists(&brief));
  }
  longer.shutdown();
  CHECK(!longer && !ros::CallbackQueueInterface::exists(nullptr));
}

bool add(cpp_nodes::AddTwoInts::Request& req, cpp_nodes::AddTwoInts::Response& res) {
  res.sum = req.a + req.b;
  return true;
}
bool addByEvent(ros::ServiceEvent<cpp_nodes::AddTwoInts::Request, cpp_nodes::AddTwoInts::Response>& event) {
  event.getResponse().sum = event.getCallerName() == ros::this_node::getName() ? event.getRequest().a : -1;
  return true;
}

void checkLatched(ros::NodeHandle& n) {
  std::vector<ros::Publisher> publishers;
  std_msgs::Int32 number;
  for (number.data = 1; number.data <= 4; ++number.data) {
    publishers.push_back(n.advertise<std_msgs::Int32>("latched", 10, number.data < 4));
    publishers.back().publish(number);
    publishers.back().publish(number);
  }
  CHECK(publishers[0].isLatched() && !publishers[3].isLatched());
  int heard = 0, sum = 0;
  const auto listen = [&] {
    return n.subscribe<std_msgs::Int32>("latched", 10, [&](const std_msgs::Int32ConstPtr& message) {
      ++heard;
      sum += message->data;
    });
  };
  const ros::Subscriber first = listen();
  CHECK(waitFor([&] { return heard >= 3; }) && sum == 6);  // the last message of each
  publishers[1].shutdown();
  const ros::Subscriber second = listen();
  CHECK(waitFor([&] { return heard >= 5; }) && sum == 10);
}

void checkServices(ros::NodeHandle& n) {
  ros::ServiceServer server = n.advertiseService("sum", add), other = n.advertiseService("first", addByEvent);
  ros::AsyncSpinner spinner(2);
  spinner.start();
  ros::ServiceClient client = n.serviceClient<cpp_nodes::AddTwoInts>("sum", true);
  CHECK(client.waitForExistence(ros::Duration(10)) && client.isPersistent());
  cpp_nodes::AddTwoInts call;
  for (int i = 0; i < 3; ++i) {
    call.request.a = 40 + i;
    call.request.b = 2;
    CHECK(client.call(call) && call.response.sum == 42 + i);
  }
  CHECK(client.isValid());
  CHECK(ros::service::call("first", call) && call.response.sum == 42);
  CHECK(!ros::service::exists("nothing", false));
  CHECK(!ros::service::waitForService("nothing", ros::Duration(0.05)));
  server.shutdown();
  CHECK(waitFor([&] { return !client.isValid(); }));
  spinner.stop();
}

void checkParameters(ros::NodeHandle& n) {
  ros::NodeHandle own("~");
  n.setParam("numbers", std::vector<double>{1.0, 2.5});
  std::vector<int> whole;
  CHECK(n.getParam("numbers", whole) && whole == (std::vector<int>{1, 3}));
  n.setParam("gains/p", 2);
  n.setParam("gains/i", 0.5);
  std::map<std::string, double> gains;
  CHECK(n.getParam("gains", gains) && gains["p"] == 2.0 && gains["i"] == 0.5);
  XmlRpc::XmlRpcValue value;
  CHECK(n.getParam("gains", value) && value.getType() == XmlRpc::XmlRpcValue::TypeStruct && value.hasMember("p"));
  CHECK(static_cast<int>(value["p"]) == 2 && value.size() == 2);
  int at = 0;
  CHECK(XmlRpc::XmlRpcUtil::nextTagData("<int>", " <int>4</int>", &at) == "4" && at == 13);
  char bytes[] = {1, 2};
  std::stringstream text64;
  text64 << XmlRpc::XmlRpcValue(bytes, 2);
  CHECK(text64.str() == "AQI=\n" && !value.fromXml("<value>4</value>", nullptr) && !value.valid());
  CHECK(XmlRpc::XmlRpcUtil::xmlDecode(XmlRpc::XmlRpcUtil::xmlEncode("<&\"'>")) == "<&\"'>");
  std::string text;
  CHECK(!n.getParam("gains/p", text) && !n.getParam("nothing", text) && !n.hasParam("nothing"));
  CHECK(n.param("nothing", 7) == 7 && n.param<std::string>("nothing", "x") == "x");
  CHECK(own.param("from_command_line", 0.0) == 1.25 && ros::param::param<bool>("~flag", false));
  double cached = 0.0;
  CHECK(n.getParamCached("gains/i", cached) && cached == 0.5);
  n.setParam("gains/i", 0.75);
  CHECK(waitFor([&] { return n.getParamCached("gains/i", cached) && cached == 0.75; }));
  std::string key;
  CHECK(own.searchParam("gains", key) && key == "/gains");
  CHECK(n.deleteParam("gains") && !n.hasParam("gains"));
  CHECK(n.resolveName("a//b/") == "/a/b" && own.resolveName("x") == ros::this_node::getName() + "/x");
  CHECK(n.resolveName("from") == "/to");
  bool is_refused = false;
  try {
    n.resolveName("1 is no name");
  } catch (const ros::InvalidNameException&) {
    is_refused = true;
  }
  CHECK(is_refused);
}

void checkCachedParents(ros::NodeHandle& n) {
  XmlRpc::XmlRpcValue tree;
  n.setParam("tree", 1);
  CHECK(n.getParamCached("tree", tree));
  n.setParam("tree/stem", 4);
  n.setParam("tree/leaf", 2);
  CHECK(n.getParamCached("tree", tree) && tree.hasMember("leaf"));
  n.deleteParam("tree/leaf");
  CHECK(n.getParamCached("tree", tree) && !tree.hasMember("leaf"));
  ros::M_string remappings;
  remappings["fruit"] = "apple";
  const ros::NodeHandle orchard("tree", remappings);
  const ros::NodeHandle second(n, "2"), inner(ros::NodeHandle(n, "base", {{"sub", "other"}}), "sub");
  CHECK(second.resolveName("x") == "/2/x" && inner.resolveName("x") == "/base/other/x");
  std::string key;
  n.setParam("fruit", 1);
  CHECK(!orchard.searchParam("fruit", key));
  n.setParam("apple", 1);
  CHECK(orchard.searchParam("fruit", key) && key == "/apple");
}

/** Text with the type of std_msgs/String, as another class. */
struct Words {
  std::string data;
};

}  // namespace

namespace ros {
namespace message_traits {
template <>
struct MD5Sum<Words> {
  static const char* value() { return MD5Sum<std_msgs::String>::value(); }
  static const char* value(const Words&) { return value(); }
};
template <>
struct DataType<Words> {
  static const char* value() { return "std_msgs/String"; }
  static const char* value(const Words&) { return value(); }
};
template <>
struct Definition<Words> {
  static const char* value() { return "string data\n"; }
  static const char* value(const Words&) { return value(); }
};
}  // namespace message_traits
namespace serialization {
template <>
struct Serializer<Words> {
  template <typename Stream, typename T>
  static void allInOne(Stream& stream, T words) {
    stream.next(words.data);
  }
  ROS_DECLARE_ALLINONE_SERIALIZER
};
}  // namespace serialization
}  // namespace ros

namespace {

void checkOtherClass(ros::NodeHandle& n) {
  std::string heard;
  ros::Subscriber subscriber = n.subscribe<std_msgs::String>(
      "words", 1, [&](const std_msgs::StringConstPtr& message) { heard = message->data; });
  ros::Publisher publisher = n.advertise<Words>("words", 1);
  const boost::shared_ptr<Words> words(new Words);
  words->data = "sent as it is";
  publisher.publish(boost::shared_ptr<const Words>(words));
  CHECK(waitFor([&] { return heard == "sent as it is"; }));
}

/** A call that ends once it may, and would then be called again. */
struct SlowCall : ros::CallbackInterface {
  CallResult call() override {
    has_begun = true;
    while (!may_end) ros::WallDuration(0.001).sleep();
    ++calls;
    return TryAgain;
  }
  std::atomic<bool> has_begun{false}, may_end{false};
  std::atomic<int> calls{0};
};

void checkRemovals() {
  ros::CallbackQueue queue;
  for (const bool waits_for_remover : {false, true}) {
    const boost::shared_ptr<SlowCall> slow = boost::make_shared<SlowCall>();
    queue.addCallback(slow, 1);
    std::thread caller([&] { queue.callOne(); });
    while (!slow->has_begun) ros::WallDuration(0.001).sleep();
    queue.addCallback(slow, 1);
    std::thread opener([&] {
      ros::WallDuration(0.1).sleep();
      if (!waits_for_remover) slow->may_end = true;
    });
    queue.removeByID(1);
    CHECK(slow->calls == (waits_for_remover ? 0 : 1));
    slow->may_end = true;
    caller.join();
    opener.join();
    CHECK(queue.isEmpty() && slow->calls == 1);
  }
}

void checkSpinners() {
  ros::CallbackQueue queue;
  ros::AsyncSpinner several(2, &queue), more(1, &queue);
  several.start();
  more.start();
  int refused = 0;
  try {
    ros::SingleThreadedSpinner().spin(&queue);
  } catch (const std::runtime_error&) {
    ++refused;
  }
  CHECK(refused == 1);
}

void checkSecondLife(int argc, char** argv) {
  ros::shutdown();
  CHECK(!ros::ok());
  int kept = 0;
  CHECK(ros::param::get("/kept", kept) && kept == 3);  // the master answers also now
  ros::init(argc, argv, "checks");
  ros::NodeHandle n;
  int heard = 0;
  ros::Subscriber subscriber =
      n.subscribe<std_msgs::Int32>("again", 1, [&](const std_msgs::Int32ConstPtr& message) { heard = message->data; });
  ros::Publisher publisher = n.advertise<std_msgs::Int32>("again", 1);
  std_msgs::Int32 seven;
  seven.data = 7;
  publisher.publish(seven);
  CHECK(waitFor([&] { return heard == 7; }));
}

void checkTimers(ros::NodeHandle& n) {
  int calls = 0, once = 0, wall = 0;
  ros::Timer timer = n.createTimer(ros::Duration(0.02), [&](const ros::TimerEvent& event) {
    ++calls;
    if (event.current_real < event.current_expected) calls = -1000;
    if (event.current_expired < event.current_expected || event.current_real < event.current_expired) calls = -1000;
  });
  ros::Timer single = n.createTimer(ros::Duration(0.01), [&](const ros::TimerEvent&) { ++once; }, true);
  ros::WallTimer slow = n.createWallTimer(ros::WallDuration(0.05), [&](const ros::WallTimerEvent&) { ++wall; });
  CHECK(waitFor([&] { return calls >= 5 && wall >= 2; }));
  CHECK(once == 1);
  timer.stop();
  const int last = calls;
  ros::WallDuration(0.1).sleep();
  ros::spinOnce();
  CHECK(calls == last);
  timer.setPeriod(ros::Duration(0.01));
  timer.start();
  CHECK(waitFor([&] { return calls > last; }));
}

void checkAll(int argc, char** argv) {
  ros::NodeHandle n;
  CHECK(argc == 2 && std::string(argv[1]) == "--kept");
  n.setParam("/kept", 3);
  checkTime();
  checkSerialization();
  checkTopics(n);
  checkLatched(n);
  checkServices(n);
  checkParameters(n);
  checkCachedParents(n);
  checkOtherClass(n);
  checkSpinners();
  checkRemovals();
  checkTimers(n);
  ROS_DEBUG("not shown");
  for (int i = 0; i < 3; ++i) ROS_WARN_ONCE("shown %s", "once");
  ROS_ERROR_STREAM_NAMED("sensor", "a stream, " << 3);
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "checks");
  checkAll(argc, argv);
  CHECK(!ros::ok());  // the last handle has ended the node
  {
    const ros::NodeHandle another;
    CHECK(another.ok());
  }
  checkSecondLife(argc, argv);
  std::cout << made << " checks, " << failed << " failed" << std::endl;
  return failed == 0 ? 0 : 1;
}
