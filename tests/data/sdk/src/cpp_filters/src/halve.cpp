// A filter as a plugin.
#include <filters/filter_base.hpp>
#include <pluginlib/class_list_macros.hpp>

namespace cpp_filters {

class Halve : public filters::FilterBase<double> {
 public:
  bool configure() override { return true; }
  bool update(const double& in, double& out) override {
    out = in / 2.0;
    return true;
  }
};

}  // namespace cpp_filters

PLUGINLIB_EXPORT_CLASS(cpp_filters::Halve, filters::FilterBase<double>)
