#pragma once

#include "diagnostic_updater/update_functions.h"

namespace diagnostic_updater {

/** Check of a topic's frequency. */
class HeaderlessTopicDiagnostic : public CompositeDiagnosticTask {
 public:
  HeaderlessTopicDiagnostic(std::string name, Updater& diag, const FrequencyStatusParam& freq)
      : CompositeDiagnosticTask(name + " topic status"), frequency_(freq) {
    addTask(&frequency_);
    diag.add(*this);
  }
  virtual void tick() { frequency_.tick(); }
  virtual void clear_window() { frequency_.clear(); }

 private:
  FrequencyStatus frequency_;
};

/** Check of a topic's frequency and stamps. */
class TopicDiagnostic : public HeaderlessTopicDiagnostic {
 public:
  TopicDiagnostic(std::string name, Updater& diag, const FrequencyStatusParam& freq, const TimeStampStatusParam& stamp)
      : HeaderlessTopicDiagnostic(name, diag, freq), stamps_(stamp) {
    addTask(&stamps_);
  }
  void tick() override { ROS_FATAL("tick(void) has been called on a TopicDiagnostic, which needs a timestamp"); }
  virtual void tick(const ros::Time& stamp) {
    stamps_.tick(stamp);
    HeaderlessTopicDiagnostic::tick();
  }

 private:
  TimeStampStatus stamps_;
};

/** Publisher whose topic is checked. */
template <class T>
class DiagnosedPublisher : public TopicDiagnostic {
 public:
  DiagnosedPublisher(const ros::Publisher& pub, Updater& diag, const FrequencyStatusParam& freq,
                     const TimeStampStatusParam& stamp)
      : TopicDiagnostic(pub.getTopic(), diag, freq, stamp), publisher_(pub) {}
  virtual ~DiagnosedPublisher() {}
  virtual void publish(const boost::shared_ptr<T>& message) { publish(*message); }
  virtual void publish(const T& message) {
    tick(message.header.stamp);
    publisher_.publish(message);
  }
  ros::Publisher getPublisher() const { return publisher_; }
  void setPublisher(ros::Publisher pub) { publisher_ = pub; }

 private:
  ros::Publisher publisher_;
};

}  // namespace diagnostic_updater
