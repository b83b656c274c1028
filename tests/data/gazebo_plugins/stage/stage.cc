// Sets a stage: models come in every way that Gazebo knows, move by animations, and fall as a message on ~/physics
// says.
#include <map>
#include <string>
#include <vector>

#include <gazebo/gazebo.hh>

namespace gazebo {

namespace {

std::string ball(const std::string& name, double x) {
  return "<sdf version='1.6'><model name='" + name + "'><pose>" + std::to_string(x) +
         " 0 9 0 0 0</pose><link name='link'><collision name='c'><geometry><sphere><radius>0.1</radius></sphere>"
         "</geometry></collision></link></model></sdf>";
}

}  // namespace

class Stage : public WorldPlugin {
 public:
  void Load(physics::WorldPtr world, sdf::ElementPtr) override {
    world_ = world;
    node_.reset(new transport::Node());
    node_->Init(world->GetName());
    statistics_ = node_->Subscribe("~/world_stats", &Stage::OnStatistics, this);

    world->InsertModelString(ball("text", 1.0));
    sdf::SDF document;
    document.SetFromString(ball("nameless", 2.0));
    document.root->GetElement("model")->GetAttribute("name")->SetFromString("document");
    world->InsertModelSDF(document);
    world->InsertModelFile("model://crate");

    const transport::PublisherPtr factory = node_->Advertise<msgs::Factory>("~/factory");
    msgs::Factory message;
    message.set_sdf_filename("model://crate2");
    msgs::Set(message.mutable_pose(), ignition::math::Pose3d(4, 5, 6, 0, 0, 0));
    factory->Publish(message);

    const transport::PublisherPtr physics = node_->Advertise<msgs::Physics>("~/physics");
    msgs::Physics moon;
    moon.set_type(msgs::Physics::ODE);
    msgs::Set(moon.mutable_gravity(), ignition::math::Vector3d(0, 0, -1.6));
    physics->Publish(moon);

    Animate();
    update_ = event::Events::ConnectWorldUpdateBegin([this](const common::UpdateInfo& info) { OnUpdate(info); });
  }

 private:
  void Animate() {
    const common::PoseAnimationPtr rise(new common::PoseAnimation("rise", 2.0, false));
    rise->CreateKeyFrame(0.0)->Translation({0, 3, 1});
    rise->CreateKeyFrame(2.0)->Translation({0, 3, 3});
    const physics::ModelPtr lift = world_->GetModel("lift");
    lift->SetAnimation(rise, [] { gzmsg << "the lift is up\n"; });

    std::map<std::string, common::NumericAnimationPtr> turns;
    turns["hinge"].reset(new common::NumericAnimation("open", 2.0, true));
    turns["hinge"]->CreateKeyFrame(0.0)->SetValue(0.0);
    turns["hinge"]->CreateKeyFrame(2.0)->SetValue(1.0);
    world_->GetModel("door")->SetJointAnimation(turns);
  }

  void OnStatistics(ConstWorldStatisticsPtr& message) { models_ = message->model_count(); }

  void OnUpdate(const common::UpdateInfo& info) {
    if (is_half_ || info.simTime < common::Time(1.0)) return;
    is_half_ = true;
    for (const physics::ModelPtr& model : world_->GetModels())
      std::printf("model %s at %s\n", model->GetName().c_str(), text(model->WorldPose().Pos()).c_str());
    std::printf("hinge at %.3f, %d models by ~/world_stats\n", world_->GetModel("door")->GetJoint("hinge")->Position(0),
                models_);
    SaveFrame();
    const ignition::math::Vector3d size = world_->GetModel("lift")->BoundingBox().Size();
    std::printf("the lift's box is %s\n", text(size).c_str());
  }

  // A picture of more bytes than a block of its file has.
  static void SaveFrame() {
    std::vector<unsigned char> pixels;
    for (int y = 0; y < 200; ++y)
      for (int x = 0; x < 200; ++x)
        for (const int value : {x, y, x ^ y}) pixels.push_back(static_cast<unsigned char>(value));
    rendering::Camera::SaveFrame(pixels.data(), 200, 200, 3, "R8G8B8", "frame.png");
  }

  static std::string text(const ignition::math::Vector3d& v) {
    char out[80];
    std::snprintf(out, sizeof(out), "%.2f %.2f %.2f", v.X(), v.Y(), v.Z());
    return out;
  }

  physics::WorldPtr world_;
  transport::NodePtr node_;
  transport::SubscriberPtr statistics_;
  event::ConnectionPtr update_;
  int models_ = 0;
  bool is_half_ = false;
};

GZ_REGISTER_WORLD_PLUGIN(Stage)

}  // namespace gazebo
