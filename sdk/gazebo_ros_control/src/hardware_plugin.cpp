// Plugin by which the simulator makes a model's RobotHWSim; its element has <class>, <namespace> and <urdf>.
#include <gazebo/common/Plugin.hh>

#include <gazebo_ros_control/robot_hw_sim.h>
#include <transmission_interface/transmission_parser.h>
#include <class_loader/registry.hpp>

#include "../../controller_interface/src/control_kit.h"

namespace gazebo_ros_control {
namespace {

// Inside, the simulation is read and written as from a plugin's function.
struct Call {
  Call(const TrundleGazeboHost* to, const char* of) : host(to) {
    host->begin_call(host->self);
    host->enter(host->self, of);
  }
  ~Call() {
    host->enter(host->self, nullptr);
    host->end_call(host->self);
  }
  const TrundleGazeboHost* host;
};

class HardwarePlugin : public gazebo::ModelPlugin {
 public:
  virtual ~HardwarePlugin() {
    if (!model_.empty()) trundle_control_set_robot(model_.c_str(), nullptr);
  }

  void Load(gazebo::physics::ModelPtr model, sdf::ElementPtr sdf) override {
    class_ = sdf->Get<std::string>("class");
    const std::string urdf = sdf->Get<std::string>("urdf"), space = sdf->Get<std::string>("namespace");
    const class_loader::impl::Create create = class_loader::impl::findClass("", class_, typeid(RobotHWSim));
    if (!create)
      throw std::runtime_error("class " + class_ +
                               " is not exported; PLUGINLIB_EXPORT_CLASS(…, gazebo_ros_control::RobotHWSim) does");
    const std::shared_ptr<RobotHWSim> hardware(static_cast<RobotHWSim*>(create()));
    std::vector<transmission_interface::TransmissionInfo> transmissions;
    urdf::Model robot;
    const urdf::Model* const used = robot.initString(urdf) ? &robot : nullptr;
    transmission_interface::TransmissionParser::parse(urdf, transmissions);
    if (!hardware->initSim(space, ros::NodeHandle(space), model, used, transmissions))
      throw std::runtime_error("the initSim of " + class_ + " returned false");
    const TrundleGazeboHost* const host = model->GetWorld()->Host();
    const auto name = std::make_shared<std::string>(class_);  // for messages after a crash
    const auto made = std::make_shared<trundle::Robot>();
    made->hardware = hardware;
    made->read = [hardware, host, name](const ros::Time& time, const ros::Duration& period) {
      const Call call(host, name->c_str());
      hardware->readSim(time, period);
    };
    made->write = [hardware, host, name](const ros::Time& time, const ros::Duration& period) {
      const Call call(host, name->c_str());
      hardware->writeSim(time, period);
    };
    made->stop = [hardware](bool is_active) { hardware->eStopActive(is_active); };
    std::shared_ptr<trundle::Robot> robot_of_model = made;
    model_ = model->GetName();
    trundle_control_set_robot(model_.c_str(), &robot_of_model);
  }

 private:
  std::string model_, class_;
};

}  // namespace
}  // namespace gazebo_ros_control

// As GZ_REGISTER_MODEL_PLUGIN does, without the text that marks a user's library.
extern "C" GZ_PLUGIN_VISIBLE int TrundleGazeboPluginKind() { return ::gazebo::MODEL_PLUGIN; }
extern "C" GZ_PLUGIN_VISIBLE void* TrundleGazeboMakePlugin() {
  return static_cast<::gazebo::ModelPlugin*>(new gazebo_ros_control::HardwarePlugin());
}
