#include <gazebo/sensors/sensors.hh>

#include <algorithm>
#include <limits>
#include <map>

#include <gazebo/physics/physics.hh>

namespace gazebo {
namespace physics {

double MultiRayShape::GetRange(unsigned int index) { return sensor_->Range(index); }
double MultiRayShape::GetRetro(unsigned int index) { return sensor_->Retro(index); }
double MultiRayShape::GetMinRange() const { return sensor_->RangeMin(); }
double MultiRayShape::GetMaxRange() const { return sensor_->RangeMax(); }
double MultiRayShape::GetResRange() const { return sensor_->RangeResolution(); }
int MultiRayShape::GetSampleCount() const { return sensor_->RayCount(); }
ignition::math::Angle MultiRayShape::MinAngle() const { return sensor_->AngleMin(); }
ignition::math::Angle MultiRayShape::MaxAngle() const { return sensor_->AngleMax(); }
int MultiRayShape::GetVerticalSampleCount() const { return sensor_->VerticalRayCount(); }
ignition::math::Angle MultiRayShape::VerticalMinAngle() const { return sensor_->VerticalAngleMin(); }
ignition::math::Angle MultiRayShape::VerticalMaxAngle() const { return sensor_->VerticalAngleMax(); }
event::ConnectionPtr MultiRayShape::ConnectNewLaserScans(std::function<void()> subscriber) {
  return sensor_->ConnectUpdated(subscriber);
}
void MultiRayShape::DisconnectNewLaserScans(event::ConnectionPtr connection) { sensor_->DisconnectUpdated(connection); }

}  // namespace physics

namespace sensors {

using ignition::math::Quaterniond;
using ignition::math::Vector3d;

namespace {

std::string TopicOf(const Sensor& sensor, const char* last) {
  std::string name = sensor.ParentName() + "::" + sensor.Name();
  for (std::size_t at; (at = name.find("::")) != std::string::npos;) name.replace(at, 2, "/");
  return "~/" + name + "/" + last;
}

template <typename M>
transport::PublisherPtr Advertise(const Sensor& sensor, const std::string& topic) {
  transport::Node node;
  node.Init(sensor.WorldName());
  return node.Advertise<M>(topic);
}

}  // namespace

void Sensor::Take(const void* world, int64_t time_ns, const TrundleGazeboReading& reading) {
  const common::Time time(static_cast<int32_t>(time_ns / 1000000000), static_cast<int32_t>(time_ns % 1000000000));
  if (rate_ > 0.0 && last_ < time && (time - last_).Double() < 0.999 / rate_) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    last_ = time;
    Set(reading);
  }
  Tell(world);
  if (IsComplete()) updated_.SignalIn(world);
}

void RaySensor::Read(const sdf::ElementPtr& sdf) {
  const sdf::ElementPtr ray = sdf->FindElement("ray");
  if (!ray) return;
  if (const sdf::ElementPtr range = ray->FindElement("range")) {
    range_[0] = Number(range, "min", 0.0);
    range_[1] = Number(range, "max", 0.0);
    resolution_ = Number(range, "resolution", 0.0);
  }
  const sdf::ElementPtr scan = ray->FindElement("scan");
  const auto read = [](const sdf::ElementPtr& direction, double (&angles)[2], int& count) {
    if (!direction) return;
    angles[0] = Number(direction, "min_angle", 0.0);
    angles[1] = Number(direction, "max_angle", 0.0);
    count = std::max(1, static_cast<int>(Number(direction, "samples", 1.0)));
  };
  read(scan ? scan->FindElement("horizontal") : sdf::ElementPtr(), angle_, count_);
  read(scan ? scan->FindElement("vertical") : sdf::ElementPtr(), vertical_angle_, vertical_count_);
  scans_ = Advertise<msgs::LaserScanStamped>(*this, topic_ = TopicOf(*this, "scan"));
}

void Noise::SetCustomNoiseCallback(std::function<double(double)> function) {
  const std::lock_guard<std::mutex> lock(mutex_);
  function_ = std::move(function);
  type_ = CUSTOM;
}

double Noise::Apply(double value) const {
  std::function<double(double)> function;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    function = function_;
  }
  return function ? function(value) : value;
}

void RaySensor::Ranges(std::vector<double>& ranges) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  ranges = ranges_;
}

void RaySensor::Set(const TrundleGazeboReading& reading) {
  const int64_t count = reading.count / 2;
  ranges_.assign(reading.values, reading.values + count);
  for (double& range : ranges_)
    if (range < range_[1]) range = noise_->Apply(range);
  retros_.assign(reading.values + count, reading.values + 2 * count);
}

void RaySensor::Tell(const void* world) {
  if (HasReaders()) {
    msgs::LaserScanStamped message;
    msgs::Set(message.mutable_time(), last_);
    msgs::LaserScan* const scan = message.mutable_scan();
    scan->set_frame(ParentName());
    scan->set_angle_min(angle_[0]);
    scan->set_angle_max(angle_[1]);
    scan->set_angle_step(AngleResolution());
    scan->set_count(static_cast<uint32_t>(count_));
    scan->set_vertical_angle_min(vertical_angle_[0]);
    scan->set_vertical_angle_max(vertical_angle_[1]);
    scan->set_vertical_angle_step(VerticalAngleResolution());
    scan->set_vertical_count(static_cast<uint32_t>(vertical_count_));
    scan->set_range_min(range_[0]);
    scan->set_range_max(range_[1]);
    for (const double range : ranges_) scan->add_ranges(range);
    for (const double retro : retros_) scan->add_intensities(retro);
    scans_->Publish(message);
  }
  if (new_scans_.ConnectionCount() == 0) return;
  std::vector<float> frame(3 * ranges_.size());
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    frame[3 * i] = static_cast<float>(ranges_[i]);
    frame[3 * i + 1] = static_cast<float>(retros_[i]);
  }
  new_scans_.SignalIn(world, frame.data(), static_cast<unsigned int>(count_),
                      static_cast<unsigned int>(vertical_count_), 3, "float32");
}

void ImuSensor::Set(const TrundleGazeboReading& reading) {
  const double* v = reading.values;
  orientation_ = has_reference_ && link_ ? reference_.Inverse() * WorldRotation() : Quaterniond(v[0], v[1], v[2], v[3]);
  angular_velocity_.Set(v[4], v[5], v[6]);
  acceleration_.Set(v[7], v[8], v[9]);
}

Quaterniond ImuSensor::WorldRotation() const { return link_->WorldPose().Rot() * Pose().Rot(); }

void ImuSensor::SetReferencePose() {
  if (link_) SetWorldToReferenceOrientation(WorldRotation());
}

void GpsSensor::Set(const TrundleGazeboReading& reading) { std::copy_n(reading.values, 3, values_); }

void SonarSensor::Read(const sdf::ElementPtr& sdf) {
  const sdf::ElementPtr sonar = sdf->FindElement("sonar");
  min_ = Number(sonar, "min", 0.0);
  max_ = Number(sonar, "max", 0.0);
  radius_ = Number(sonar, "radius", 0.0);
}
void SonarSensor::Set(const TrundleGazeboReading& reading) { range_ = reading.values[0]; }

void ForceTorqueSensor::Set(const TrundleGazeboReading& reading) {
  force_.Set(reading.values[0], reading.values[1], reading.values[2]);
  torque_.Set(reading.values[3], reading.values[4], reading.values[5]);
}

void ForceTorqueSensor::Tell(const void* world) {
  msgs::WrenchStamped message;
  msgs::Set(message.mutable_time(), last_);
  msgs::Set(message.mutable_wrench()->mutable_force(), force_);
  msgs::Set(message.mutable_wrench()->mutable_torque(), torque_);
  new_wrenches_.SignalIn(world, message);
}

void SonarSensor::Tell(const void* world) {
  msgs::SonarStamped message;
  msgs::Set(message.mutable_time(), last_);
  msgs::Sonar& sonar = *message.mutable_sonar();
  sonar.set_range_min(min_);
  sonar.set_range_max(max_);
  sonar.set_radius(radius_);
  sonar.set_range(range_);
  new_ranges_.SignalIn(world, message);
}

void LogicalCameraSensor::Read(const sdf::ElementPtr& sdf) {
  const sdf::ElementPtr camera = sdf->FindElement("logical_camera");
  near_ = Number(camera, "near", 0.0);
  far_ = Number(camera, "far", 1.0);
  horizontal_fov_ = Number(camera, "horizontal_fov", 1.0);
  aspect_ratio_ = Number(camera, "aspect_ratio", 1.0);
  images_ = Advertise<msgs::LogicalCameraImage>(*this, topic_ = TopicOf(*this, "models"));
}

void LogicalCameraSensor::Set(const TrundleGazeboReading& reading) {
  image_.Clear();
  if (link_) msgs::Set(image_.mutable_pose(), Pose() + link_->WorldPose());
  for (int i = 0; i < reading.contact_count; ++i) {
    const double* v = reading.values + 7 * i;
    msgs::LogicalCameraImage::Model& model = *image_.add_model();
    model.set_name(reading.contacts[i].collision1);
    msgs::Set(model.mutable_pose(), ignition::math::Pose3d(v[0], v[1], v[2], v[3], v[4], v[5], v[6]));
  }
}

void LogicalCameraSensor::Tell(const void*) {
  if (images_->HasConnections()) images_->Publish(image_);
}

void ContactSensor::Read(const sdf::ElementPtr& sdf) {
  const sdf::ElementPtr contact = sdf->FindElement("contact");
  if (!contact) return;
  for (sdf::ElementPtr e = contact->FindElement("collision"); e; e = e->GetNextElement("collision"))
    collisions_.push_back(ParentName() + "::" + e->Get<std::string>());
}

void ContactSensor::Set(const TrundleGazeboReading& reading) {
  contacts_.Clear();
  msgs::Set(contacts_.mutable_time(), last_);
  for (int i = 0; i < reading.contact_count; ++i) {
    const TrundleGazeboContact& point = reading.contacts[i];
    msgs::Contact* contact = nullptr;
    for (int k = 0; k < contacts_.contact_size(); ++k)
      if (contacts_.contact(k).collision1() == point.collision1 &&
          contacts_.contact(k).collision2() == point.collision2)
        contact = contacts_.mutable_contact(k);
    if (!contact) {
      contact = contacts_.add_contact();
      contact->set_collision1(point.collision1);
      contact->set_collision2(point.collision2);
      contact->set_world(WorldName());
      msgs::Set(contact->mutable_time(), last_);
    }
    const Vector3d force(point.force[0], point.force[1], point.force[2]);
    msgs::Set(contact->add_position(), Vector3d(point.position[0], point.position[1], point.position[2]));
    msgs::Set(contact->add_normal(), Vector3d(point.normal[0], point.normal[1], point.normal[2]));
    contact->add_depth(point.depth);
    msgs::JointWrench* const wrench = contact->add_wrench();
    wrench->set_body_1_name(point.collision1);
    wrench->set_body_2_name(point.collision2);
    msgs::Set(wrench->mutable_body_1_wrench()->mutable_force(), force);
    msgs::Set(wrench->mutable_body_2_wrench()->mutable_force(), -force);
  }
}

std::map<std::string, physics::Contact> ContactSensor::Contacts(const std::string& collision) const {
  std::map<std::string, physics::Contact> contacts;
  const msgs::Contacts all = Contacts();
  for (const msgs::Contact& contact : all.contact())
    if (contact.collision1() == collision) contacts[contact.collision2()] = contact;
    else if (contact.collision2() == collision) contacts[contact.collision1()] = contact;
  return contacts;
}

unsigned int ContactSensor::GetCollisionContactCount(const std::string& collision) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  unsigned int count = 0;
  for (const msgs::Contact& contact : contacts_.contact())
    if (contact.collision1() == collision || contact.collision2() == collision)
      count += static_cast<unsigned int>(contact.position_size());
  return count;
}

void CameraSensor::Read(const sdf::ElementPtr& sdf) {
  camera_->Read(ScopedName(), sdf->FindElement("camera"), UpdateRate());
  const std::string world = WorldName(), name = ParentName() + "::" + Name();
  camera_->WhenCropChanges([world, name](bool crop) {
    if (physics::has_world(world)) physics::get_world(world)->Request({"border_crop", name}, {crop ? 1.0 : 0.0});
  });
}

void MultiCameraSensor::Read(const sdf::ElementPtr& sdf) {
  for (sdf::ElementPtr e = sdf->FindElement("camera"); e; e = e->GetNextElement("camera")) {
    cameras_.push_back(rendering::CameraPtr(new rendering::Camera));
    cameras_.back()->Read(e->Get<std::string>("name"), e, UpdateRate());
  }
}

void MultiCameraSensor::Set(const TrundleGazeboReading& reading) {
  last_set_ = reading.count == 1 ? static_cast<std::size_t>(reading.values[0]) : cameras_.size();
  if (last_set_ < cameras_.size()) cameras_[last_set_]->Set(reading, last_);
}

void MultiCameraSensor::Tell(const void* world) {
  if (last_set_ < cameras_.size()) cameras_[last_set_]->Tell(world);
}

namespace {

struct Made {
  const void* world;
  std::string name;  // `model::link::sensor`
  SensorPtr sensor;
};
std::mutex made_mutex;
std::vector<Made> made_sensors;

SensorPtr make(const std::string& type) {
  if (type == "ray") return std::make_shared<RaySensor>();
  if (type == "gpu_ray") return std::make_shared<GpuRaySensor>();
  if (type == "camera") return std::make_shared<CameraSensor>();
  if (type == "multicamera") return std::make_shared<MultiCameraSensor>();
  if (type == "depth") return std::make_shared<DepthCameraSensor>();
  if (type == "imu") return std::make_shared<ImuSensor>();
  if (type == "contact") return std::make_shared<ContactSensor>();
  if (type == "gps") return std::make_shared<GpsSensor>();
  if (type == "sonar") return std::make_shared<SonarSensor>();
  if (type == "logical_camera") return std::make_shared<LogicalCameraSensor>();
  if (type == "force_torque") return std::make_shared<ForceTorqueSensor>();
  return SensorPtr();
}

}  // namespace

SensorManager* SensorManager::Instance() {
  static SensorManager* const instance = new SensorManager;
  return instance;
}

SensorPtr SensorManager::Make(const physics::WorldPtr& world, const physics::BasePtr& parent,
                              const sdf::ElementPtr& sdf) {
  const std::string name = parent->GetScopedName() + "::" + sdf->Get<std::string>("name");
  const std::lock_guard<std::mutex> lock(made_mutex);
  for (const Made& one : made_sensors)
    if (one.world == world.get() && one.name == name) return one.sensor;
  const SensorPtr sensor = make(sdf->Get<std::string>("type"));
  if (!sensor) return sensor;
  static uint32_t last_id = 0;
  sensor->id_ = ++last_id;
  sensor->name_ = sdf->Get<std::string>("name");
  sensor->parent_name_ = parent->GetScopedName();
  sensor->parent_id_ = parent->GetId();
  sensor->type_ = sdf->Get<std::string>("type");
  sensor->world_name_ = world->Name();
  sensor->pose_ = sdf->HasElement("pose") ? sdf->Get<ignition::math::Pose3d>("pose") : ignition::math::Pose3d();
  sensor->rate_ = sdf->Get<double>("update_rate", 0.0).first;
  sensor->visualize_ = sdf->Get<bool>("visualize");
  sensor->is_active_ = sdf->Get<bool>("always_on");
  sensor->sdf_ = sdf;
  if (const auto force_torque = std::dynamic_pointer_cast<ForceTorqueSensor>(sensor))
    force_torque->joint_ = boost::dynamic_pointer_cast<physics::Joint>(parent);
  if (const auto imu = std::dynamic_pointer_cast<ImuSensor>(sensor))
    imu->link_ = boost::dynamic_pointer_cast<physics::Link>(parent);
  if (const auto camera = std::dynamic_pointer_cast<LogicalCameraSensor>(sensor))
    camera->link_ = boost::dynamic_pointer_cast<physics::Link>(parent);
  sensor->Read(sdf);
  made_sensors.push_back({world.get(), name, sensor});
  return sensor;
}

void SensorManager::Remove(const void* world, const std::string& model) {
  const std::lock_guard<std::mutex> lock(made_mutex);
  made_sensors.erase(std::remove_if(made_sensors.begin(), made_sensors.end(),
                                    [&](const Made& one) {
                                      return one.world == world &&
                                             one.name.compare(0, model.size() + 2, model + "::") == 0;
                                    }),
                     made_sensors.end());
}

SensorPtr SensorManager::GetSensor(const std::string& name) const {
  const std::lock_guard<std::mutex> lock(made_mutex);
  for (const Made& one : made_sensors)
    if (name == one.name || name == one.sensor->ScopedName() || name == one.sensor->Name()) return one.sensor;
  return SensorPtr();
}

Sensor_V SensorManager::GetSensors() const {
  const std::lock_guard<std::mutex> lock(made_mutex);
  Sensor_V sensors;
  for (const Made& one : made_sensors) sensors.push_back(one.sensor);
  return sensors;
}

}  // namespace sensors
}  // namespace gazebo
