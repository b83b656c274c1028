// A model of a lift, or of what hangs from a winch: says where it is at times, from a class derived from Gazebo's.
#include <gazebo/plugins/ElevatorPlugin.hh>
#include <gazebo/plugins/HarnessPlugin.hh>

#include <cmath>
#include <cstdio>

namespace gazebo
{
class Lift : public ElevatorPlugin
{
};

class Winch : public HarnessPlugin
{
public:
  void At(int _step)
  {
    if (_step == 500)
      this->SetWinchVelocity(0.5);
    if (_step == 1500)
      this->SetWinchVelocity(0);
    if (_step == 2000)
      this->Detach();
  }
};

class Machines : public ModelPlugin
{
public:
  void Load(physics::ModelPtr _model, sdf::ElementPtr _sdf)
  {
    this->model = _model;
    if (_sdf->HasElement("winch"))
      this->winch.Load(_model, _sdf);
    else
      this->lift.Load(_model, _sdf);
    this->isWinch = _sdf->HasElement("winch");
    this->begin = event::Events::ConnectWorldUpdateBegin(boost::bind(&Machines::OnBegin, this, _1));
  }

private:
  void OnBegin(const common::UpdateInfo& _info)
  {
    const int step = static_cast<int>(std::lround(_info.simTime.Double() * 1000));
    if (this->isWinch)
      this->winch.At(step);
    else if (step == 10)
      this->lift.MoveToFloor(1);
    if (step % 500 == 0)
    {
      std::printf("%s at %d: %.2f", this->model->GetName().c_str(), step, this->model->GetLink("body")->WorldPose().Pos().Z());
      if (this->model->GetLink("door"))
        std::printf(" %.1f", this->model->GetJoint("slide")->Position(0));
      std::printf("\n");
      std::fflush(stdout);
    }
  }

  physics::ModelPtr model;
  Lift lift;
  Winch winch;
  bool isWinch;
  event::ConnectionPtr begin;
};

GZ_REGISTER_MODEL_PLUGIN(Machines)
}
