// A plugin that fails as its parameter says.
#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <stdexcept>

namespace gazebo
{
class Faulty : public ModelPlugin
{
public:
  ~Faulty()
  {
    if (this->needsJoint)
      this->model->GetJoint("no_such_joint").get()->SetForce(0, 1.0);
  }

  void Load(physics::ModelPtr _model, sdf::ElementPtr _sdf)
  {
    this->model = _model;
    const std::string fault = _sdf->Get<std::string>("fault");
    this->needsJoint = fault == "destructor" || fault == "end";
    if (fault == "load" || fault == "destructor")
      throw std::runtime_error("no wheels");
    if (fault == "parameter")
      this->value = _sdf->GetElement("radius")->Get<double>();
    this->connection = event::Events::ConnectWorldUpdateBegin([this, fault](const common::UpdateInfo&) {
      if (fault == "update")
        gzthrow("joint " << 7 << " is gone");
      if (fault == "crash")
      {
        physics::Joint* joint = this->model->GetJoint("no_such_joint").get();
        joint->SetForce(0, 1.0);
      }
    });
  }

private:
  physics::ModelPtr model;
  bool needsJoint = false;
  double value = 0.0;
  event::ConnectionPtr connection;
};

GZ_REGISTER_MODEL_PLUGIN(Faulty)
}
