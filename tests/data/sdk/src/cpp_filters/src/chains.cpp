// Chains of filters of values; prints a line for each check that fails.
#include <filters/filter_chain.h>
#include <filters/realtime_circular_buffer.h>
#include <ros/ros.h>

#include <iostream>

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

XmlRpc::XmlRpcValue filter(const std::string& name, const std::string& type) {
  XmlRpc::XmlRpcValue value;
  value["name"] = name;
  value["type"] = type;
  return value;
}

XmlRpc::XmlRpcValue chain(const XmlRpc::XmlRpcValue& first) {
  XmlRpc::XmlRpcValue list;
  list[0] = first;
  return list;
}

double next(filters::FilterChain<double>& filters, double value) {
  double result = -1.0;
  CHECK(filters.update(value, result));
  return result;
}

void checkWindows() {
  XmlRpc::XmlRpcValue mean = filter("mean", "filters/MeanFilterDouble");
  mean["params"]["number_of_observations"] = 3;
  XmlRpc::XmlRpcValue median = filter("median", "filters/MedianFilterDouble");
  median["params"]["number_of_observations"] = 3;
  XmlRpc::XmlRpcValue list = chain(mean);
  filters::FilterChain<double> means("double"), medians("double"), both("double");
  CHECK(means.configure(list, "/"));
  CHECK(next(means, 3.0) == 3.0 && next(means, 5.0) == 4.0 && next(means, 10.0) == 6.0 && next(means, 0.0) == 5.0);
  list[0] = median;
  CHECK(medians.configure(list, "/"));
  CHECK(next(medians, 3.0) == 3.0 && next(medians, 1.0) == 1.0);  // the lower one in the middle
  CHECK(next(medians, 2.0) == 2.0 && next(medians, 9.0) == 2.0 && next(medians, 9.0) == 9.0);
  list[1] = mean;
  list[2] = filter("halve", "cpp_filters/Halve");
  CHECK(both.configure(list, "/"));
  CHECK(both.getFilters().size() == 3 && both.getFilters()[2]->getType() == "cpp_filters/Halve");
  CHECK(next(both, 8.0) == 4.0 && next(both, 4.0) == 3.0);
  CHECK(both.clear() && next(both, 8.0) == 8.0);
}

void checkTransferFunction() {
  XmlRpc::XmlRpcValue value = filter("low_pass", "filters/TransferFunctionFilterDouble");
  value["params"]["a"][0] = 2.0;
  value["params"]["a"][1] = -1;
  value["params"]["b"][0] = 1;
  filters::FilterChain<double> filters("double");
  XmlRpc::XmlRpcValue list = chain(value);
  CHECK(filters.configure(list, "/"));
  CHECK(next(filters, 1.0) == 0.5 && next(filters, 1.0) == 0.75 && next(filters, 0.0) == 0.375);
  list[0]["params"]["a"][0] = 0.0;
  CHECK(!filters.configure(list, "/"));
}

void checkChannels() {
  ros::NodeHandle node("~");
  XmlRpc::XmlRpcValue list;
  for (int i = 0; i < 3; ++i) list[i] = filter("add" + std::to_string(i), "filters/MultiChannelIncrementFilterInt");
  node.setParam("increments", list);
  filters::MultiChannelFilterChain<int> filters("int");
  std::vector<int> values(2, 5), results(2), short_results(1);
  CHECK(filters.configure(2, "increments", node));
  CHECK(filters.update(values, results) && results[0] == 8 && results[1] == 8);
  CHECK(filters.update(values, values) && values[0] == 8);
  CHECK(!filters.update(values, short_results));
  CHECK(!filters.configure(2, "no_such", node));
}

void checkRefusals() {
  filters::FilterChain<double> filters("double");
  XmlRpc::XmlRpcValue text = "a text";
  CHECK(!filters.configure(text, "/"));
  XmlRpc::XmlRpcValue list = chain(filter("a", "filters/NoSuchFilter"));
  CHECK(!filters.configure(list, "/"));
  for (int i = 0; i < 2; ++i) list[i] = filter("a", "cpp_filters/Halve");
  CHECK(!filters.configure(list, "/"));  // two of a name
  list = chain(filter("mean", "filters/MeanFilterDouble"));
  CHECK(!filters.configure(list, "/"));  // without its parameter
  list[0]["params"]["number_of_observations"] = 0;
  CHECK(!filters.configure(list, "/"));
  CHECK(filters.configure("no_such", ros::NodeHandle("~")) && next(filters, 4.0) == 4.0);
}

void checkBuffer() {
  filters::RealtimeCircularBuffer<int> buffer(2, 7);
  CHECK(buffer.size() == 0 && buffer.back() == 7 && !buffer.empty());
  buffer.push_back(1);
  CHECK(buffer.size() == 1 && buffer.front() == 1 && buffer.back() == 1);
  buffer.push_back(2);
  buffer.push_back(3);
  CHECK(buffer.size() == 2 && buffer[0] == 2 && buffer.back() == 3);
  buffer.push_front(9);
  CHECK(buffer.front() == 9 && buffer.at(1) == 2);
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "chains");
  ros::NodeHandle node;
  checkWindows();
  checkTransferFunction();
  checkChannels();
  checkRefusals();
  checkBuffer();
  std::cout << made << " checks, " << failed << " failed" << std::endl;
  return failed == 0 ? 0 : 1;
}
