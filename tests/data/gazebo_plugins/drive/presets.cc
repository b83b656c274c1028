// A world plugin that says what profiles of the physics there are, makes one, and switches between them.
#include <cstdio>
#include <string>

#include <gazebo/gazebo.hh>
#include <gazebo/physics/PresetManager.hh>
#include <gazebo/physics/physics.hh>

namespace gazebo
{
class Presets : public WorldPlugin
{
public:
  void Load(physics::WorldPtr _world, sdf::ElementPtr)
  {
    this->world = _world;
    const physics::PresetManagerPtr presets = _world->PresetMgr();
    for (const std::string& name : presets->AllProfiles())
      std::printf("profile %s\n", name.c_str());
    boost::any rate;
    const bool found = presets->GetCurrentProfileParam("real_time_update_rate", rate);
    std::printf("%s at %g Hz\n", presets->CurrentProfile().c_str(), found ? boost::any_cast<double>(rate) : -1.0);

    presets->CreateProfile("mine");
    const bool stored = presets->SetProfileParam("mine", "max_step_size", 0.004);
    const bool unknown = presets->SetProfileParam("mine", "iters", 70) || presets->SetProfileParam("none", "iters", 70);
    sdf::ElementPtr element;
    presets->GenerateSDFFromPreset("mine", element);
    std::printf("mine: %d %d %g %s\n", stored, unknown, element->Get<double>("max_step_size"),
                element->Get<std::string>("type").c_str());
    std::printf("before: %g\n", presets->ProfileSDF("mine")->Get<double>("max_step_size"));

    sdf::SDF document;
    document.SetFromString("<sdf version='1.6'><physics name='deep' type='ode'><ode><solver><type>quick</type>"
                           "<iters>70</iters><sor>1.3</sor></solver></ode></physics></sdf>");
    const std::string deep = presets->CreateProfile(document.root->GetElement("physics"));
    boost::any iterations, step;
    presets->GetProfileParam(deep, "iters", iterations);
    presets->GetProfileParam(deep, "max_step_size", step);
    std::printf("%s: %d %g\n", deep.c_str(), boost::any_cast<int>(iterations), boost::any_cast<double>(step));
    presets->RemoveProfile(deep);
    std::printf("removed: %d %d\n", presets->HasProfile(deep), presets->CurrentProfile(deep));
    this->begin = event::Events::ConnectWorldUpdateBegin([this](const common::UpdateInfo&) { OnBegin(); });
  }

private:
  void OnBegin()
  {
    const physics::PhysicsEnginePtr engine = this->world->Physics();
    const physics::PresetManagerPtr presets = this->world->GetPresetManager();
    const int step = ++this->steps;
    if (step == 2) std::printf("switched: %d\n", presets->CurrentProfile("moon"));
    if (step == 10) std::printf("set: %d\n", presets->SetCurrentProfileParam("max_step_size", 0.005));
    if (step == 15) std::printf("iterations: %d\n", presets->SetCurrentProfileParam("iters", 70));
    if (step == 20) presets->CurrentProfile("earth");
    if (step != 1 && step != 8 && step != 18 && step != 28) return;
    boost::any size;
    engine->GetParam("max_step_size", size);
    const ignition::math::Vector3d gravity =
        boost::any_cast<ignition::math::Vector3d>(engine->GetParam("gravity"));
    std::printf("step %d: %s, %g s, %g\n", step, presets->CurrentProfile().c_str(), boost::any_cast<double>(size),
                gravity.Z());
  }

  physics::WorldPtr world;
  event::ConnectionPtr begin;
  int steps = 0;
};
GZ_REGISTER_WORLD_PLUGIN(Presets)
}
