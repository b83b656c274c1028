// A model plugin as one wrote them for Gazebo 5: both wheels turn from the start.
#include <boost/bind.hpp>
#include <gazebo/common/common.hh>
#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <stdio.h>

namespace gazebo
{
class Rp2w : public ModelPlugin
{
public:
  void Load(physics::ModelPtr _parent, sdf::ElementPtr _sdf)
  {
    this->model = _parent;
    this->speed = 2.0;
    if (_sdf->HasElement("speed"))
      this->speed = _sdf->GetElement("speed")->Get<double>();
    this->left = this->model->GetJoint("chassis_left_wheel");
    this->right = this->model->GetJoint("chassis_right_wheel");
    this->left->SetMaxForce(0, 2.0);
    this->right->SetMaxForce(0, 2.0);
    gzmsg << "driving " << this->model->GetName() << " with " << this->model->GetJointCount() << " joints\n";
    this->updateConnection = event::Events::ConnectWorldUpdateBegin(boost::bind(&Rp2w::OnUpdate, this, _1));
  }

  void OnUpdate(const common::UpdateInfo& _info)
  {
    this->left->SetVelocity(0, this->speed);
    this->right->SetVelocity(0, this->speed);
    if (_info.simTime.Double() >= 2.0 && !this->said)
    {
      this->said = true;
      math::Pose pose = this->model->GetWorldPose();
      printf("after 2 s: %.3f %.3f yaw %.3f, wheel %.2f rad/s\n", pose.pos.x, pose.pos.y, pose.rot.GetYaw(),
             this->left->GetVelocity(0));
      fflush(stdout);
    }
  }

private:
  physics::ModelPtr model;
  physics::JointPtr left, right;
  event::ConnectionPtr updateConnection;
  double speed;
  bool said = false;
};

GZ_REGISTER_MODEL_PLUGIN(Rp2w)
}
