#include <gazebo/rendering/Visual.hh>

#include <algorithm>
#include <cmath>

#include <gazebo/common/Console.hh>
#include <gazebo/physics/physics.hh>

namespace gazebo {
namespace rendering {

using ignition::math::Pose3d;
using ignition::math::Vector3d;

namespace {

constexpr double kChangePeriod = 0.1, kLinePeriod = 0.02;  // [s]

// Gazebo draws shapes of unit size, scaled; what is attached to a visual is scaled with it.
Vector3d scale_of(const sdf::ElementPtr& geometry) {
  if (!geometry) return Vector3d::One;
  if (const sdf::ElementPtr box = geometry->FindElement("box")) return box->Get<Vector3d>("size");
  if (const sdf::ElementPtr sphere = geometry->FindElement("sphere"))
    return Vector3d::One * (2.0 * sphere->Get<double>("radius"));
  if (const sdf::ElementPtr cylinder = geometry->FindElement("cylinder")) {
    const double diameter = 2.0 * cylinder->Get<double>("radius");
    return Vector3d(diameter, diameter, cylinder->Get<double>("length"));
  }
  if (const sdf::ElementPtr mesh = geometry->FindElement("mesh"))
    return mesh->Get<Vector3d>("scale", Vector3d::One).first;
  return Vector3d::One;
}

}  // namespace

void DynamicLines::AddPoint(const Vector3d& point, const ignition::math::Color& color) {
  const std::lock_guard<std::mutex> lock(mutex_);
  points_.push_back(point);
  colors_.push_back(color);
}

void DynamicLines::SetPoint(unsigned int index, const Vector3d& point) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (index < points_.size()) points_[index] = point;
  else gzwarn << "a line of " << points_.size() << " points has none with number " << index << "\n";
}

void DynamicLines::SetColor(unsigned int index, const ignition::math::Color& color) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (index < colors_.size()) colors_[index] = color;
}

Vector3d DynamicLines::Point(unsigned int index) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (index < points_.size()) return points_[index];
  gzthrow("a line of " << points_.size() << " points has none with number " << index);
}

unsigned int DynamicLines::GetPointCount() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return static_cast<unsigned int>(points_.size());
}

void DynamicLines::Clear() {
  const std::lock_guard<std::mutex> lock(mutex_);
  points_.clear();
  colors_.clear();
}

void DynamicLines::setMaterial(const std::string& name) {
  const std::lock_guard<std::mutex> lock(mutex_);
  material_ = name;
}

Visual::Visual(const physics::LinkPtr& link, const sdf::ElementPtr& sdf)
    : link_(link),
      world_(link->GetWorld()),
      name_(link->GetScopedName() + "::" + sdf->Get<std::string>("name")),
      sdf_(sdf),
      scale_(scale_of(sdf->FindElement("geometry"))) {
  static uint32_t last_id = 0;
  id_ = ++last_id;
  if (sdf->HasElement("pose")) initial_ = pose_ = sdf->Get<Pose3d>("pose");
  transparency_ = static_cast<float>(sdf->Get<double>("transparency", 0.0).first);
}

Visual::~Visual() {
  while (!lines_.empty()) DeleteDynamicLine(lines_.back().get());
}

Pose3d Visual::Pose() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return pose_;
}

Pose3d Visual::WorldPose() const { return link_->WorldPose() * Pose(); }

void Visual::SetPose(const Pose3d& pose) {
  const std::lock_guard<std::mutex> lock(mutex_);
  has_changed_ |= !(pose == pose_);
  pose_ = pose;
}

void Visual::SetPosition(const Vector3d& position) { SetPose(Pose3d(position, Rotation())); }
void Visual::SetRotation(const ignition::math::Quaterniond& rotation) { SetPose(Pose3d(Position(), rotation)); }
void Visual::SetWorldPose(const Pose3d& pose) { SetPose(link_->WorldPose().Inverse() * pose); }
void Visual::SetWorldPosition(const Vector3d& position) { SetWorldPose(Pose3d(position, WorldPose().Rot())); }

bool Visual::GetVisible() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return is_visible_;
}

void Visual::SetVisible(bool is_visible, bool) {
  const std::lock_guard<std::mutex> lock(mutex_);
  has_changed_ |= is_visible != is_visible_;
  is_visible_ = is_visible;
}

float Visual::GetTransparency() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return transparency_;
}

void Visual::SetTransparency(float transparency) {
  const std::lock_guard<std::mutex> lock(mutex_);
  transparency = std::min(std::max(transparency, 0.0f), 1.0f);
  has_changed_ |= transparency != transparency_;
  transparency_ = transparency;
}

void Visual::SetMaterial(const std::string& name, bool, const bool) {
  const std::lock_guard<std::mutex> lock(mutex_);
  has_changed_ |= name != material_;
  material_ = name;
}

std::string Visual::GetMaterialName() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return material_;
}

DynamicLines* Visual::CreateDynamicLine(RenderOpType type) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (type == RENDERING_POINT_LIST) gzthrow("visual " << name_ << ": points are not drawn, but lines are");
  lines_.emplace_back(new DynamicLines(type));
  lines_.back()->number_ = ++last_line_;
  return lines_.back().get();
}

void Visual::DeleteDynamicLine(DynamicLines* line) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = std::find_if(lines_.begin(), lines_.end(), [line](const auto& one) { return one.get() == line; });
  if (found == lines_.end()) return;
  if (const physics::WorldPtr world = world_.lock())
    if (!line->sent_.empty()) world->Request({"line", LineName(*line), ""});
  lines_.erase(found);
}

std::string Visual::LineName(const DynamicLines& line) const { return name_ + "#" + std::to_string(line.number_); }

void Visual::Send(const common::Time& time) {
  const auto is_due = [&time](const common::Time& last, double period) {
    return time < last || (time - last).Double() >= period;
  };
  const Pose3d world_from_visual = WorldPose();
  const std::lock_guard<std::mutex> lock(mutex_);
  if (has_changed_ && is_due(sent_, kChangePeriod)) {
    Change();
    has_changed_ = false;
    sent_ = time;
  }
  if (lines_.empty() || !is_due(sent_lines_, kLinePeriod)) return;
  sent_lines_ = time;
  for (const std::unique_ptr<DynamicLines>& line : lines_) SendLine(*line, world_from_visual);
}

void Visual::Change() {
  const physics::WorldPtr world = world_.lock();
  if (!world) return;
  const Vector3d& p = pose_.Pos();
  const ignition::math::Quaterniond& q = pose_.Rot();
  world->Request({"visual", name_, material_},
                 {p.X(), p.Y(), p.Z(), q.W(), q.X(), q.Y(), q.Z(), is_visible_ ? double(transparency_) : 1.0});
}

void Visual::SendLine(DynamicLines& line, const Pose3d& world_from_visual) {
  const std::lock_guard<std::mutex> lock(line.mutex_);
  const ignition::math::Color color = line.colors_.empty() ? ignition::math::Color::White : line.colors_.front();
  std::vector<double> numbers = {line.type_ == RENDERING_LINE_LIST ? 1.0 : 0.0, color.R(), color.G(), color.B()};
  for (const Vector3d& point : line.points_) {
    const Vector3d in_world = world_from_visual.CoordPositionAdd(point * scale_);
    for (const double value : {in_world.X(), in_world.Y(), in_world.Z()})
      numbers.push_back(std::isfinite(value) ? value : 0.0);
  }
  if (numbers == line.sent_ && line.material_ == line.sent_material_) return;
  line.sent_ = numbers;
  line.sent_material_ = line.material_;
  if (const physics::WorldPtr world = world_.lock()) world->Request({"line", LineName(line), line.material_}, numbers);
}

}  // namespace rendering
}  // namespace gazebo
