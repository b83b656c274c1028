// Boxes on a slope: one stays, one loses its friction, and one is let through; their places go by a message of ours.
#include <sstream>

#include <gazebo/gazebo.hh>

#include "report.pb.h"

namespace gazebo {

class Slide : public WorldPlugin {
 public:
  void Load(physics::WorldPtr world, sdf::ElementPtr) override {
    world_ = world;
    node_.reset(new transport::Node());
    node_->Init(world->Name());
    told_ = node_->Subscribe("~/report", &Slide::OnReport, this);
    tells_ = node_->Advertise<slide_msgs::Report>("~/report");
    SurfaceOf("ghost")->collideWithoutContact = true;
    update_ = event::Events::ConnectWorldUpdateBegin([this](const common::UpdateInfo& info) { OnUpdate(info.simTime); });
  }

 private:
  physics::SurfaceParamsPtr SurfaceOf(const std::string& model) {
    return world_->ModelByName(model)->GetLink("link")->GetCollision("c")->GetSurface();
  }

  void OnUpdate(const common::Time& time) {
    const int step = static_cast<int>(time.Double() * 1000 + 0.5);
    const physics::FrictionPyramidPtr friction = SurfaceOf("slips")->FrictionPyramid();
    if (step == 500) {
      friction->SetMuPrimary(0.0);
      friction->SetMuSecondary(0.0);
    }
    if (step != 499 && step != 2000) return;
    slide_msgs::Report report;
    report.mutable_header()->mutable_stamp()->set_sec(time.sec);
    report.mutable_header()->mutable_stamp()->set_nsec(static_cast<uint32_t>(time.nsec));
    for (const char* name : {"keeps", "slips", "ghost"}) {
      slide_msgs::Thing* thing = report.add_things();
      thing->set_name(name);
      msgs::Vector3d* position = new msgs::Vector3d;
      msgs::Set(position, world_->ModelByName(name)->WorldPose().Pos());
      thing->set_allocated_position(position);
      thing->set_kind(slide_msgs::Thing::BOX);
      report.add_heights(thing->position().z());
    }
    tells_->Publish(report);
  }

  void OnReport(const boost::shared_ptr<const slide_msgs::Report>& report) {
    std::ostringstream text;
    text << "at " << report->header().stamp().sec() << " s in " << report->header().frameid() << ", last "
          << report->last() << report->has_last() << ":";
    for (int i = 0; i < report->things_size(); ++i)
      text << " " << report->things(i).name() << " " << report->things(i).position().x() << " "
            << report->heights(i) << (report->things(i).kind() == slide_msgs::Thing::BOX ? "" : "?");
    gzmsg << text.str() << "\n";
  }

  physics::WorldPtr world_;
  transport::NodePtr node_;
  transport::PublisherPtr tells_;
  transport::SubscriberPtr told_;
  event::ConnectionPtr update_;
};

GZ_REGISTER_WORLD_PLUGIN(Slide)

}  // namespace gazebo
