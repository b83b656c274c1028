// Lets a box fall through the ground after 0.2 s, when another model comes, too.
#include <gazebo/common/common.hh>
#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>

namespace gazebo {

const char* const kPost =
    "<sdf version='1.6'><model name='post'><static>true</static><pose>0 -9 0 0 0 0</pose><link name='l'>"
    "<collision name='c'><geometry><sphere><radius>0.1</radius></sphere></geometry></collision></link></model></sdf>";

class Ghost : public ModelPlugin {
 public:
  void Load(physics::ModelPtr model, sdf::ElementPtr) override {
    update_ = event::Events::ConnectWorldUpdateBegin([this, model](const common::UpdateInfo& info) {
      if (info.simTime < common::Time(0.2) || is_done_) return;
      is_done_ = true;
      model->GetLink()->SetCollideMode("none");
      model->GetWorld()->InsertModelString(kPost);
    });
  }

 private:
  event::ConnectionPtr update_;
  bool is_done_ = false;
};

GZ_REGISTER_MODEL_PLUGIN(Ghost)

}  // namespace gazebo
