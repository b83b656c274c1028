// Options of cameras, as src/trundle/ros/sdk/config_header.py writes them.
#pragma once

#include <dynamic_reconfigure/config.h>

namespace gazebo_plugins {

class GazeboRosCameraConfig : public dynamic_reconfigure::ConfigBase<GazeboRosCameraConfig> {
 public:
  struct DEFAULT {
    bool state = true;
    std::string name = "Default";
  } groups;

  double imager_rate = 2.0;

  GazeboRosCameraConfig() {}

  static const std::vector<dynamic_reconfigure::Parameter<GazeboRosCameraConfig> >& __parameters__() {
    static const std::vector<dynamic_reconfigure::Parameter<GazeboRosCameraConfig> > table{
        {"imager_rate", 3u, "Images per second", "", 0, &GazeboRosCameraConfig::imager_rate},
    };
    return table;
  }
  static const std::vector<dynamic_reconfigure::GroupOf<GazeboRosCameraConfig> >& __groups__() {
    static const std::vector<dynamic_reconfigure::GroupOf<GazeboRosCameraConfig> > table{
        {"Default", "", 0, 0, [](const GazeboRosCameraConfig& c) { return c.groups.state; },
         [](GazeboRosCameraConfig& c, bool state) { c.groups.state = state; }},
    };
    return table;
  }
  static const GazeboRosCameraConfig& __getDefault__() {
    static const GazeboRosCameraConfig config;
    return config;
  }
  static const GazeboRosCameraConfig& __getMin__() {
    static const GazeboRosCameraConfig config = [] {
      GazeboRosCameraConfig c;
      c.imager_rate = 1.0;
      return c;
    }();
    return config;
  }
  static const GazeboRosCameraConfig& __getMax__() {
    static const GazeboRosCameraConfig config = [] {
      GazeboRosCameraConfig c;
      c.imager_rate = 50.0;
      return c;
    }();
    return config;
  }
};

}  // namespace gazebo_plugins
