// A world plugin that checks what the interface says and does, and prints each check that fails.
#include <cmath>
#include <cstdio>

#include <boost/thread.hpp>
#include <gazebo/gazebo.hh>
#include <gazebo/msgs/msgs.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/transport/transport.hh>
#include <ignition/math.hh>

static int checks = 0, failed = 0;

#define CHECK(condition)                                              \
  do {                                                                \
    ++checks;                                                         \
    if (!(condition)) {                                               \
      ++failed;                                                       \
      std::printf("line %d: not true: %s\n", __LINE__, #condition);   \
    }                                                                 \
  } while (false)

static bool Near(double a, double b, double tolerance = 1e-3) { return std::abs(a - b) <= tolerance; }
static bool Near(const ignition::math::Vector3d& a, double x, double y, double z, double tolerance = 1e-3)
{
  return Near(a.X(), x, tolerance) && Near(a.Y(), y, tolerance) && Near(a.Z(), z, tolerance);
}

namespace gazebo
{
class Checks : public WorldPlugin
{
public:
  void Load(physics::WorldPtr _world, sdf::ElementPtr _sdf)
  {
    this->world = _world;
    CheckSdf(_sdf);
    CheckMath();
    CheckUri();
    CheckPaths();
    CheckWorld();
    this->begin = event::Events::ConnectWorldUpdateBegin(boost::bind(&Checks::OnBegin, this, _1));
    this->end = event::Events::ConnectWorldUpdateEnd(boost::bind(&Checks::OnEnd, this));
    this->node = transport::NodePtr(new transport::Node());
    this->node->Init(_world->Name());
    this->subscriber = this->node->Subscribe("~/said", &Checks::OnText, this);
    this->publisher = this->node->Advertise<msgs::GzString>("/gazebo/checks/said");
    CHECK(this->publisher->HasConnections());
    event::EventT<void()> loaded;
    int calls = 0;
    const event::ConnectionPtr counts = loaded.Connect([&calls] { ++calls; });
    boost::thread([&loaded] { loaded(); }).join();
    CHECK(calls == 1);
    event::ConnectionPtr outlives;
    {
      event::EventT<void()> ended;
      outlives = ended.Connect([&calls] { ++calls; });
      ended.Disconnect(outlives);
      ended();
    }
    CHECK(calls == 1 && outlives);
    {
      event::EventT<void()> ended;
      outlives = ended.Connect([&calls] { ++calls; });
      ended.~EventT<void()>();  // as hector_gazebo_plugins disconnects
      outlives.reset();
    }
    CHECK(calls == 1);
  }

private:
  void CheckSdf(sdf::ElementPtr _sdf)
  {
    CHECK(_sdf->GetName() == "plugin");
    CHECK(_sdf->Get<std::string>("filename") == "libchecks.so");
    CHECK(_sdf->Get<bool>("flag"));
    CHECK(_sdf->Get<ignition::math::Vector3d>("point") == ignition::math::Vector3d(1, 2, 3));
    CHECK(_sdf->Get<math::Vector3>("point") == math::Vector3(1, 2, 3));
    CHECK(Near(_sdf->Get<ignition::math::Pose3d>("place").Rot().Yaw(), M_PI / 2));
    CHECK(_sdf->GetElement("place")->GetAttribute("frame")->GetAsString() == "x");
    CHECK(!_sdf->HasElement("none") && !_sdf->GetElement("none"));
    CHECK(_sdf->Get<double>("none", 7.5).first == 7.5 && !_sdf->Get<double>("none", 7.5).second);
    CHECK(_sdf->Get<std::string>("text") == "two words");
    int sum = 0;
    for (sdf::ElementPtr item = _sdf->GetElement("item"); item; item = item->GetNextElement("item"))
      sum = 10 * sum + item->Get<int>();
    CHECK(sum == 12);
    double value = 0;
    CHECK(_sdf->GetElement("item")->GetValue()->Get(value) && value == 1.0);
    CHECK(_sdf->Clone()->ToString("").find("<text>two words</text>") != std::string::npos);
  }

  void CheckMath()
  {
    const ignition::math::Quaterniond turned(0.1, 0.2, 0.3);
    CHECK(Near(turned.Euler(), 0.1, 0.2, 0.3));
    CHECK(Near(ignition::math::Quaterniond(ignition::math::Matrix3d(turned)).Euler(), 0.1, 0.2, 0.3));
    CHECK(Near(turned.Inverse() * (turned * ignition::math::Vector3d(1, 2, 3)), 1, 2, 3));
    const ignition::math::Pose3d a(1, 2, 3, 0, 0, M_PI / 2), b(1, 0, 0, 0, 0, 0);
    CHECK(Near((a * b).Pos(), 1, 3, 3) && (a * b) == (b + a));
    CHECK(((a * b) - a).Pos() == b.Pos());
    CHECK(Near(a.CoordPositionAdd(ignition::math::Vector3d(1, 0, 0)), 1, 3, 3));
    CHECK((a * a.Inverse()) == ignition::math::Pose3d::Zero);
    CHECK((ignition::math::Matrix4d(a) * ignition::math::Matrix4d(a).Inverse()) == ignition::math::Matrix4d::Identity);
    CHECK(math::Pose(a).rot.GetYaw() == a.Rot().Yaw() && math::Pose(a).pos.x == 1);
    CHECK(Near(math::Quaternion(0, 0, M_PI).RotateVector(math::Vector3(1, 0, 0)).Ign(), -1, 0, 0));
    CHECK(common::Time(1.5) + common::Time(0, 600000000) == common::Time(2, 100000000));
    CHECK(common::Time(1.0) - common::Time(2.5) < common::Time(0.0));
    common::PID pid(2.0, 0.0, 0.0, 0.0, 0.0, 3.0, -3.0);
    CHECK(pid.Update(1.0, common::Time(0.01)) == -2.0 && pid.Update(-9.0, common::Time(0.01)) == 3.0);
    try
    {
      gzthrow("number " << 3);
    }
    catch (const common::Exception& error)
    {
      CHECK(error.GetErrorStr() == "number 3");
    }
  }

  void CheckPaths()
  {
    common::SystemPaths* const paths = common::SystemPaths::Instance();
    CHECK(paths->FindFileURI("file:///dev/null") == "/dev/null" && paths->FindFile("/dev/none").empty());
    CHECK(paths->FindFile("null").empty() && paths->FindFileURI("model://none").empty());
    paths->AddGazeboPaths("/none:/dev");
    CHECK(common::find_file("null") == "/dev/null" && common::find_file_path("null") == "/dev");
    common::add_search_path_suffix("dev/");
    paths->AddGazeboPaths("/");
    CHECK(paths->FindFile("null") == "/dev/null" && paths->GetGazeboPaths().back() == "/");
  }

  void CheckUri()
  {
    common::URI uri("data://world/default?p=pose&a=b");
    CHECK(uri.Valid() && uri.Scheme() == "data" && uri.Path().Str("::") == "world::default");
    CHECK(uri.Query().Str() == "?a=b&p=pose" && uri.Str() == "data://world/default?a=b&p=pose");
    const common::URI copy = uri;
    uri.Path() = common::URIPath("/default/") / "model";
    uri.Path().PushFront("world");
    uri.Path() /= "box";
    uri.Query().Clear();
    uri.Query().Insert("p", "v");
    CHECK(uri.Str() == "data://world/default/model/box?p=v" && !(uri == copy));
    CHECK(!uri.Parse("data://?p=v") && uri.Path().Valid() && uri.Parse(copy.Str()) && uri == copy);
    for (const char* text : {"", "data", "data://", "://world", "data://world?p", "data://wor ld", "data://world?p=v?"})
      CHECK(!common::URI::Valid(text));
    CHECK(common::URIQuery::Valid("") && !common::URIQuery::Valid("p=v") && !common::URIPath::Valid("//"));
    uri.Clear();
    CHECK(uri.Str().empty());
  }

  void CheckWorld()
  {
    CHECK(this->world->Name() == "checks" && physics::get_world() == this->world);
    CHECK(this->world->ModelCount() == 2 && !this->world->ModelByName("none"));
    CHECK(this->world->Physics()->GetMaxStepSize() == 0.001);
    CHECK(this->world->GetPhysicsEngine()->GetRealTimeUpdateRate() == 500);
    this->box = this->world->GetModel("box");
    this->body = this->box->GetLink("body");
    CHECK(this->box->GetLink() == this->body && this->body->GetScopedName() == "box::body");
    CHECK(this->world->EntityByName("box::body::shape") == this->body->GetCollision("shape"));
    CHECK(Near(this->box->WorldPose().Pos(), 1, 2, 3) && Near(this->box->GetWorldPose().rot.GetYaw(), M_PI / 2));
    CHECK(Near(this->body->WorldPose().Pos(), 1, 2.5, 3));
    CHECK(this->body->GetInertial()->Mass() == 2.0);
    const physics::BoxShapePtr shape =
        boost::dynamic_pointer_cast<physics::BoxShape>(this->body->GetCollision("shape")->GetShape());
    CHECK(shape && shape->Size() == ignition::math::Vector3d(0.1, 0.2, 0.3));
    CHECK(this->body->GetCollision("shape")->GetSurface()->FrictionPyramid()->MuPrimary() == 0.25);
    physics::Contact contact;
    contact.positions[0] = ignition::math::Vector3d(1, 2, 3);
    contact.normals[1] = contact.positions[0];
    contact.positions[0].z = 4;
    CHECK(contact.positions[0].Z() == 4 && contact.normals[1].z == 3 && contact.normals[1].Length() > 3.7);
    const math::Vector3 sum = math::Vector3(1, 1, 1) + contact.positions[0];
    CHECK(sum == math::Vector3(2, 3, 5));
    const physics::Contact copy = contact;
    contact.positions[0].x = 9;
    CHECK(copy.positions[0].x == 1 && copy.positions[0] + ignition::math::Vector3d::One == sum.Ign());
    this->turn = this->world->ModelByName("arm")->GetJoint("turn");
    CHECK(this->turn->DOF() == 1 && this->turn->GetChild()->GetName() == "tip" && this->turn->GetParent());
    CHECK(this->turn->LowerLimit(0) == -2 && this->turn->GetUpperLimit(0).Radian() == 3);
    CHECK(this->turn->GetEffortLimit(0) == 50);
    CHECK(Near(this->turn->GlobalAxis(0), 0, 0, 1) && Near(this->turn->Anchor(0), 0, 0, 6));
    CHECK(Near(this->world->Gravity(), 0, 0, 0));
  }

  void OnBegin(const common::UpdateInfo& _info)
  {
    const int step = static_cast<int>(std::lround(_info.simTime.Double() * 1000));
    CHECK(step == this->steps && _info.worldName == "checks" && this->world->SimTime() == _info.simTime);
    ++this->steps;
    if (step < 500)  // 2 N on 2 kg for half a second
      this->body->AddForce(ignition::math::Vector3d(1, 0, 0)), this->body->AddForce(ignition::math::Vector3d(1, 0, 0));
    if (step == 500)
    {
      CHECK(Near(this->body->WorldLinearVel(), 0.5, 0, 0) && Near(this->body->RelativeLinearVel(), 0, -0.5, 0));
      CHECK(Near(this->box->GetWorldLinearVel().x, 0.5));
    }
    if (step == 600)  // without a force the velocity stays
    {
      CHECK(Near(this->body->WorldLinearVel(), 0.5, 0, 0));
      this->box->SetWorldPose(ignition::math::Pose3d(0, 0, 1, 0, 0, 0));
      CHECK(Near(this->box->WorldPose().Pos(), 0, 0, 1) && Near(this->body->WorldPose().Pos(), 0.5, 0, 1));
      CHECK(Near(this->body->WorldLinearVel(), 0.5, 0, 0));
      this->box->SetLinearVel(ignition::math::Vector3d(0, 2, 0));
      this->box->SetAngularVel(math::Vector3(0, 0, 1));
      CHECK(Near(this->body->WorldLinearVel(), 0, 2, 0) && Near(this->body->WorldAngularVel(), 0, 0, 1));
      this->turn->SetPosition(0, 1.0);
      CHECK(Near(this->turn->Position(0), 1.0));
    }
    if (step == 700)
      CHECK(Near(this->body->WorldPose().Pos(), 0.5, 0.2, 1) && Near(this->turn->GetAngle(0).Radian(), 1.0));
    if (step >= 700 && step < 800)  // 2 Nm on 0.5 kg m2
      this->turn->SetForce(0, 2.0);
    if (step == 750)
      CHECK(this->turn->GetForce(0) == 2.0);
    if (step == 801)
      CHECK(Near(this->turn->GetVelocity(0), 0.4, 2e-3) && this->turn->GetForce(0) == 0.0);
    if (step == 900)  // set once, without a motor: it stays as in free space
      this->turn->SetVelocity(0, -1.0);
    if (step == 950)
    {
      CHECK(Near(this->turn->GetVelocity(0), -1.0, 5e-3));
      this->turn->SetParam("fmax", 0, 10.0);
      this->turn->SetParam("vel", 0, 0.25);
    }
    if (step == 1100)
    {
      CHECK(Near(this->turn->GetVelocity(0), 0.25) && this->turn->GetParam("fmax", 0) == 10.0);
      this->publisher->Publish(msgs::GzString());
    }
    CheckJoint(step);
    if (step == 1400)
    {
      CHECK(this->texts == 1 && this->ends == this->steps - 1);
      std::printf("%d checks, %d failed\n", checks, failed);
      std::fflush(stdout);
    }
  }

  // A rigid joint made at run time, attached first and limited afterwards, as plugins that grasp do.
  void CheckJoint(int _step)
  {
    const physics::LinkPtr tip = this->turn->GetChild();
    if (_step == 1110)
    {
      this->box->SetWorldTwist(ignition::math::Vector3d(), ignition::math::Vector3d());
      this->made = this->world->Physics()->CreateJoint("revolute", this->box);
      this->made->Attach(tip, this->body);
      this->made->Load(tip, this->body, ignition::math::Pose3d());
      this->made->SetModel(this->box);
      this->made->SetUpperLimit(0, 0);
      this->made->SetLowerLimit(0, 0);
      this->made->Init();
      this->offset = this->body->WorldPose() - tip->WorldPose();
    }
    if (_step == 1300)
    {
      CHECK(this->turn->GetVelocity(0) > 0.1);
      CHECK((this->body->WorldPose() - tip->WorldPose()).Equal(this->offset, 5e-3));
      CHECK(this->body->WorldLinearVel().Length() > 0.05);
      this->made->Detach();
    }
    if (_step == 1350)
      this->body->AddForce(ignition::math::Vector3d(0, 0, 2000));
    if (_step == 1352)
      CHECK(this->body->WorldLinearVel().Z() > 0.9 && Near(tip->WorldLinearVel().Z(), 0));
    if (_step == 1360)  // 10 N up and 3 N along the arm's x, which the joint takes, in each link's axes
    {
      this->turn->GetForceTorque(0);
      tip->AddForce(ignition::math::Vector3d(0, 0, 10));
      tip->AddRelativeForce(ignition::math::Vector3d(3, 0, 0));
    }
    if (_step == 1361)
    {
      const physics::JointWrench wrench = this->turn->GetForceTorque(0);
      CHECK(Near(wrench.body2Force, 3, 0, 10, 0.02) && Near(wrench.body2Torque, 0, 0, 0, 0.02));
      const double yaw = this->turn->Position(0);
      CHECK(Near(wrench.body1Force, -3 * std::cos(yaw), -3 * std::sin(yaw), -10, 0.02));
    }
    if (_step == 1370)
    {
      CHECK(this->world->PhysicsEnabled());
      this->world->SetPhysicsEnabled(false);
      this->offset = this->body->WorldPose();
      CHECK(this->body->WorldLinearVel().Z() > 0.9);
    }
    if (_step == 1380)  // nothing moves but what a plugin moves
    {
      CHECK(this->body->WorldPose() == this->offset && this->body->WorldLinearVel().Z() > 0.9);
      this->turn->SetPosition(0, 0.5);
      CHECK(Near(this->turn->Position(0), 0.5));
    }
    if (_step == 1390)
    {
      CHECK(Near(this->turn->Position(0), 0.5) && !this->world->PhysicsEnabled());
      this->world->SetPhysicsEnabled(true);
    }
    if (_step == 1399)
      CHECK(this->body->WorldPose().Pos().Z() - this->offset.Pos().Z() > 0.008);
  }

  void OnEnd() { ++this->ends; }
  void OnText(ConstGzStringPtr&) { ++this->texts; }

  physics::WorldPtr world;
  physics::ModelPtr box;
  physics::LinkPtr body;
  physics::JointPtr turn, made;
  ignition::math::Pose3d offset;
  event::ConnectionPtr begin, end;
  transport::NodePtr node;
  transport::SubscriberPtr subscriber;
  transport::PublisherPtr publisher;
  int steps = 0, ends = 0, texts = 0;
};

GZ_REGISTER_WORLD_PLUGIN(Checks)
}
