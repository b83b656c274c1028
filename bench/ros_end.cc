// One end of a topic in C++, with the same arguments and results as `ros_end.py`: ROLE TYPE COUNT RATE_HZ QUEUE_SIZE.
// It is compiled with the development kit and with Debian's roscpp.
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

#include <geometry_msgs/Twist.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/Image.h>

static double monotonic(clockid_t clock = CLOCK_MONOTONIC) {
  timespec now;
  clock_gettime(clock, &now);
  return now.tv_sec + 1e-9 * now.tv_nsec;
}

static double cpu() { return monotonic(CLOCK_PROCESS_CPUTIME_ID); }

static void sleepFor(double seconds) {
  if (seconds > 0) std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

static void mark(geometry_msgs::Twist& message, double now) { message.linear.x = now; }
static void mark(sensor_msgs::Image&, double) {}
static double age(const geometry_msgs::Twist& message) { return monotonic() - message.linear.x; }
static double age(const sensor_msgs::Image&) { return 0; }

static void fill(geometry_msgs::Twist&) {}
static void fill(sensor_msgs::Image& image) {
  image.height = 240;
  image.width = 320;
  image.encoding = "rgb8";
  image.step = 960;
  image.data.resize(320 * 240 * 3);
}

static std::atomic<bool> closed(false);

template <class M>
struct Receiver {
  long count;
  bool areStamped;
  long received = -1;
  double start = 0, startCpu = 0, end = 0, endCpu = 0;
  std::vector<double> ages;
  std::atomic<bool> isDone{false};

  void take(const boost::shared_ptr<const M>& message) {
    if (isDone) return;
    ++received;
    if (received == 1) {
      start = monotonic();
      startCpu = cpu();
    }
    if (areStamped && received) ages.push_back(age(*message));
    if (received == count) {
      end = monotonic();
      endCpu = cpu();
      isDone = true;
    }
  }
};

template <class M>
int run(const std::string& role, long count, double rate, int queue) {
  ros::NodeHandle node;
  Receiver<M> receiver;
  receiver.count = count;
  receiver.areStamped = rate > 0;
  ros::Publisher publisher;
  ros::Subscriber subscriber;
  if (role == "sub") {
    subscriber = node.subscribe<M>("/bench", queue, &Receiver<M>::take, &receiver, ros::TransportHints().tcpNoDelay());
  } else {
    publisher = node.advertise<M>("/bench", queue);
    while (!publisher.getNumSubscribers()) sleepFor(0.001);
  }
  std::thread([] {
    while (std::cin.get() != EOF) {}
    closed = true;
  }).detach();
  if (role == "sub") {
    while (!receiver.isDone) ros::getGlobalCallbackQueue()->callOne(ros::WallDuration(0.1));
    std::printf("{\"end\": %.9f, \"first\": %.9f, \"sub_cpu\": %.9f, \"ages\": [", receiver.end, receiver.start,
                receiver.endCpu - receiver.startCpu);
    for (size_t i = 0; i < receiver.ages.size(); ++i) std::printf("%s%.9f", i ? ", " : "", receiver.ages[i]);
    std::printf("]}\n");
  } else {
    M message;
    fill(message);
    mark(message, monotonic());
    publisher.publish(message);  // the first one warms up
    if (role == "first") {
      while (!closed) sleepFor(0.01);
      return 0;
    }
    sleepFor(1);
    const double start = monotonic(), startCpu = cpu();
    double due = start;
    long sent = 0;
    for (; (queue || sent != count) && !closed; ++sent) {
      if (rate > 0) {
        due += 1 / rate;
        sleepFor(due - monotonic());
      }
      mark(message, monotonic());
      publisher.publish(message);
    }
    std::printf("{\"start\": %.9f, \"pub_cpu\": %.9f, \"sent\": %ld}\n", start, cpu() - startCpu, sent);
  }
  std::fflush(stdout);
  while (!closed) sleepFor(0.01);
  return 0;
}

int main(int argc, char** argv) {
  const std::string role = argv[1], kind = argv[2], queue = argv[5];
  ros::init(argc, argv, "bench_" + role, ros::init_options::NoRosout | ros::init_options::NoSigintHandler);
  const long count = std::atol(argv[3]);
  const double rate = std::atof(argv[4]);
  const int size = queue == "None" ? 0 : std::atoi(argv[5]);
  return kind == "sensor_msgs/Image" ? run<sensor_msgs::Image>(role, count, rate, size)
                                     : run<geometry_msgs::Twist>(role, count, rate, size);
}
