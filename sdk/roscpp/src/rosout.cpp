// Log messages on /rosout, and the services that set loggers' levels.
#include <roscpp/GetLoggers.h>
#include <roscpp/SetLoggerLevel.h>
#include <rosgraph_msgs/Log.h>

#include <cctype>
#include <memory>
#include <mutex>

#include "node.h"
#include "ros/init.h"
#include "ros/names.h"
#include "ros/this_node.h"
#include "services.h"
#include "topics.h"

namespace ros {
namespace {

class ImmediateQueue : public CallbackQueueInterface {
 public:
  void addCallback(const CallbackInterfacePtr& callback, uint64_t) override { callback->call(); }
  void removeByID(uint64_t) override {}
};

ImmediateQueue& immediate() {
  static ImmediateQueue* const queue = new ImmediateQueue;
  return *queue;
}

thread_local bool is_publishing = false;  // messages logged while publishing are not published

class Appender : public console::LogAppender {
 public:
  void log(console::Level level, const char* text, const char* file, const char* function, int line) override {
    std::shared_ptr<Publication> publication;
    boost::shared_ptr<Publication::Callbacks> publisher;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      publication = publication_;
      publisher = publisher_;
    }
    if (!publication || is_publishing || publication->linkCount() == 0) return;
    is_publishing = true;
    const auto message = boost::make_shared<rosgraph_msgs::Log>();
    message->header.stamp = Time::now();
    message->level = static_cast<int8_t>(1 << level);
    message->name = this_node::getName();
    message->msg = text;
    message->file = file;
    message->function = function;
    message->line = static_cast<uint32_t>(line);
    message->topics = topics::advertised();
    SerializedMessage bytes;
    publication->publish(publisher, [&message] { return serialization::serializeMessage(*message); }, bytes);
    is_publishing = false;
  }
  void set(const std::shared_ptr<Publication>& publication,
           const boost::shared_ptr<Publication::Callbacks>& publisher) {
    const std::lock_guard<std::mutex> lock(mutex_);
    publication_ = publication;
    publisher_ = publisher;
  }

 private:
  std::mutex mutex_;
  std::shared_ptr<Publication> publication_;
  boost::shared_ptr<Publication::Callbacks> publisher_;
};

Appender& appender() {
  static Appender* const instance = new Appender;
  return *instance;
}

bool getLoggers(roscpp::GetLoggers::Request&, roscpp::GetLoggers::Response& response) {
  static const char* const kNames[] = {"debug", "info", "warn", "error", "fatal"};
  std::map<std::string, console::levels::Level> loggers;
  console::get_loggers(loggers);
  for (const auto& entry : loggers) {
    roscpp::Logger logger;
    logger.name = entry.first;
    logger.level = kNames[entry.second];
    response.loggers.push_back(logger);
  }
  return true;
}

bool setLoggerLevel(roscpp::SetLoggerLevel::Request& request, roscpp::SetLoggerLevel::Response&) {
  static const char* const kNames[] = {"DEBUG", "INFO", "WARN", "ERROR", "FATAL"};
  std::string wanted = request.level;
  for (char& c : wanted) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  for (int i = 0; i < console::levels::Count; ++i)
    if (wanted == kNames[i] && console::set_logger_level(request.logger, static_cast<console::levels::Level>(i))) {
      console::notifyLoggerLevelsChanged();
      return true;
    }
  return false;
}

template <class Service>
void serve(const char* name, bool (*function)(typename Service::Request&, typename Service::Response&)) {
  AdvertiseServiceOptions options;
  options.init<Service>(names::resolve(name), function);
  options.callback_queue = &immediate();
  services::advertise(options);
}

}  // namespace

namespace rosout {

void start() {
  AdvertiseOptions options;
  options.init<rosgraph_msgs::Log>(names::resolve("/rosout"), 100);
  options.latch = true;
  const auto callbacks = boost::make_shared<Publication::Callbacks>();
  callbacks->queue = &immediate();
  callbacks->is_tracked = false;
  callbacks->is_latched = options.latch;
  appender().set(topics::advertise(options, callbacks), callbacks);
  static bool is_registered = false;
  if (!is_registered) console::register_appender(&appender());
  is_registered = true;
}

void serveLoggers() {
  serve<roscpp::GetLoggers>("~get_loggers", getLoggers);
  serve<roscpp::SetLoggerLevel>("~set_logger_level", setLoggerLevel);
}

void stop() { appender().set(nullptr, nullptr); }

}  // namespace rosout
}  // namespace ros
