// Plugin of the system: prints the models of the world, and its hundredth step.
#include <cstdio>
#include <string>

#include <gazebo/common/common.hh>
#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>

namespace gazebo {

class Watch : public SystemPlugin {
 public:
  void Load(int count, char** words) override {
    const std::string program = count > 0 ? words[0] : "nothing";
    added_ = event::Events::ConnectAddEntity([this](const std::string& name) { models_ += " " + name; });
    created_ = event::Events::ConnectWorldCreated([this, program](const std::string& name) {
      gzmsg << "watched " << program << ": world " << name << " with" << models_ << std::endl;
      const physics::WorldPtr world = physics::get_world(name);
      const physics::LinkPtr feather = world->ModelByName("feather")->GetLink("body");
      feather->SetGravityMode(false);
      drawn_ = event::Events::ConnectPreRender([this] { ++draws_; });
      update_ = event::Events::ConnectWorldUpdateBegin([this, feather](const common::UpdateInfo& info) {
        if (++steps_ == 90) feather->SetGravityMode(true);
        if (steps_ != 100) return;
        char text[200];
        std::snprintf(text, sizeof(text), "feather %.4f", feather->WorldPose().Pos().Z());
        gzmsg << "watched step 100 at " << info.simTime.Double() << ", " << draws_ << " draws, " << text << std::endl;
      });
    });
  }

 private:
  std::string models_;
  int steps_ = 0, draws_ = 0;
  event::ConnectionPtr added_, created_, drawn_, update_;
};

GZ_REGISTER_SYSTEM_PLUGIN(Watch)

}  // namespace gazebo
