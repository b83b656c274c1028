// Plugin of a visual: a line that turns from green to where the link is, and a visual that moves and fades.
#include <cmath>

#include <gazebo/common/Events.hh>
#include <gazebo/common/Plugin.hh>
#include <gazebo/rendering/rendering.hh>

namespace gazebo
{
class Marks : public VisualPlugin
{
public:
  ~Marks() { this->visual->DeleteDynamicLine(this->line); }

  void Load(rendering::VisualPtr _visual, sdf::ElementPtr)
  {
    this->visual = _visual;
    this->line = _visual->CreateDynamicLine(rendering::RENDERING_LINE_STRIP);
    this->line->AddPoint(ignition::math::Vector3d(0, 0, 0), ignition::math::Color(0, 1, 0, 1));
    this->line->AddPoint(1, 0, 0, ignition::math::Color::Green);
    this->line->setVisibilityFlags(GZ_VISIBILITY_GUI);
    this->visual->SetVisible(true);
    this->connection = event::Events::ConnectPreRender(boost::bind(&Marks::OnPreRender, this));
  }

private:
  void OnPreRender()
  {
    ++this->count;
    if (this->count == 500)
    {
      this->line->setMaterial("Gazebo/Purple");
      this->line->SetPoint(1, ignition::math::Vector3d(0, 0, 2));
      this->visual->SetPosition(ignition::math::Vector3d(0, 0, 0.5));
      this->visual->SetTransparency(0.5);
    }
    if (this->count == 1500)
      this->visual->SetVisible(false);
  }

  rendering::VisualPtr visual;
  rendering::DynamicLines* line;
  event::ConnectionPtr connection;
  int count = 0;
};

GZ_REGISTER_VISUAL_PLUGIN(Marks)
}
