// Plugin of a model that uses nothing of Gazebo's library.
#include <gazebo/common/Plugin.hh>

#include <cstdio>

namespace gazebo {

class Idle : public ModelPlugin {
 public:
  void Load(physics::ModelPtr, sdf::ElementPtr) override { std::puts("idle is loaded"), std::fflush(stdout); }
};

GZ_REGISTER_MODEL_PLUGIN(Idle)

}  // namespace gazebo
