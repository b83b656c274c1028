// Lets a box fall through the ground after 0.2 s.
#include <gazebo/common/common.hh>
#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>

namespace gazebo {

class Ghost : public ModelPlugin {
 public:
  void Load(physics::ModelPtr model, sdf::ElementPtr) override {
    update_ = event::Events::ConnectWorldUpdateBegin([this, model](const common::UpdateInfo& info) {
      if (info.simTime < common::Time(0.2) || is_done_) return;
      is_done_ = true;
      model->GetLink()->SetCollideMode("none");
    });
  }

 private:
  event::ConnectionPtr update_;
  bool is_done_ = false;
};

GZ_REGISTER_MODEL_PLUGIN(Ghost)

}  // namespace gazebo
