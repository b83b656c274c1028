#include <cmath>
#include <map>
#include <utility>

#include <sensor_msgs/fill_image.h>
#include <tf/transform_listener.h>

#include <gazebo_plugins/gazebo_ros_camera_utils.h>
#include <gazebo/sensors/Sensor.hh>

namespace gazebo {

namespace {

namespace encodings = sensor_msgs::image_encodings;

// Encoding of a format of the file, and the bytes of a pixel.
std::pair<std::string, int> encoding(const std::string& format) {
  static const std::map<std::string, std::pair<std::string, int> > known = {
      {"L8", {encodings::MONO8, 1}},
      {"L_INT8", {encodings::MONO8, 1}},
      {"L16", {encodings::MONO16, 2}},
      {"L_INT16", {encodings::MONO16, 2}},
      {"R8G8B8", {encodings::RGB8, 3}},
      {"RGB_INT8", {encodings::RGB8, 3}},
      {"B8G8R8", {encodings::BGR8, 3}},
      {"BGR_INT8", {encodings::BGR8, 3}},
      {"R16G16B16", {encodings::RGB16, 6}},
      {"RGB_INT16", {encodings::RGB16, 6}},
      {"BAYER_RGGB8", {encodings::BAYER_RGGB8, 1}},
      {"BAYER_BGGR8", {encodings::BAYER_BGGR8, 1}},
      {"BAYER_GBRG8", {encodings::BAYER_GBRG8, 1}},
      {"BAYER_GRBG8", {encodings::BAYER_GRBG8, 1}},
  };
  const auto found = known.find(format);
  if (found != known.end()) return found->second;
  ROS_ERROR_NAMED("camera_utils", "pictures of the format %s are published as bgr8", format.c_str());
  return {encodings::BGR8, 3};
}

}  // namespace

GazeboRosCameraUtils::GazeboRosCameraUtils()
    : rosnode_(nullptr),
      image_topic_name_("image_raw"),
      camera_info_topic_name_("camera_info"),
      frame_name_("/world"),
      update_rate_(0.0),
      update_period_(0.0),
      cx_prime_(0.0),
      cx_(0.0),
      cy_(0.0),
      focal_length_(0.0),
      hack_baseline_(0.0),
      distortion_k1_(0.0),
      distortion_k2_(0.0),
      distortion_k3_(0.0),
      distortion_t1_(0.0),
      distortion_t2_(0.0),
      auto_distortion_(false),
      border_crop_(true),
      skip_(0),
      width_(0),
      height_(0),
      depth_(0),
      trigger_topic_name_("image_trigger"),
      initialized_(false) {}

GazeboRosCameraUtils::~GazeboRosCameraUtils() {
  if (!rosnode_) return;
  if (parentSensor_) parentSensor_->SetActive(false);
  rosnode_->shutdown();
  camera_queue_.clear();
  camera_queue_.disable();
  if (callback_queue_thread_.joinable()) callback_queue_thread_.join();
  options_.reset();
  transport_.reset();
  delete rosnode_;
}

event::ConnectionPtr GazeboRosCameraUtils::OnLoad(const boost::function<void()>& function) {
  return loaded_.Connect(function);
}

void GazeboRosCameraUtils::Load(sensors::SensorPtr parent, sdf::ElementPtr sdf, const std::string& camera_name_suffix) {
  if (read(parent, sdf, camera_name_suffix)) advertise();
}

void GazeboRosCameraUtils::Load(sensors::SensorPtr parent, sdf::ElementPtr sdf, const std::string& camera_name_suffix,
                                double hack_baseline) {
  if (!read(parent, sdf, camera_name_suffix)) return;
  hack_baseline_ = hack_baseline;
  advertise();
}

bool GazeboRosCameraUtils::read(const sensors::SensorPtr& parent, const sdf::ElementPtr& sdf,
                                const std::string& suffix) {
  if (!ros::isInitialized()) {
    gzerr << "a camera's plugin needs a node of ROS; run without --no-ros\n";
    return false;
  }
  parentSensor_ = parent;
  world_ = world = physics::get_world(parent->WorldName());
  const auto set = [&sdf](const char* name, auto& value) {
    if (sdf->HasElement(name)) value = sdf->Get<typename std::decay<decltype(value)>::type>(name);
  };
  robot_namespace_ = GetRobotNamespace(parent, sdf, "Camera");
  set("imageTopicName", image_topic_name_);
  set("cameraInfoTopicName", camera_info_topic_name_);
  set("triggerTopicName", trigger_topic_name_);
  set("cameraName", camera_name_);
  camera_name_ += suffix;
  set("frameName", frame_name_);
  set("updateRate", update_rate_);
  set("CxPrime", cx_prime_);
  set("Cx", cx_);
  set("Cy", cy_);
  set("focalLength", focal_length_);
  set("hackBaseline", hack_baseline_);
  set("distortionK1", distortion_k1_);
  set("distortionK2", distortion_k2_);
  set("distortionK3", distortion_k3_);
  set("distortionT1", distortion_t1_);
  set("distortionT2", distortion_t2_);
  set("autoDistortion", auto_distortion_);
  set("borderCrop", border_crop_);
  // Cameras of one sensor share them.
  if (!image_connect_count_) image_connect_count_.reset(new int(0));
  if (!image_connect_count_lock_) image_connect_count_lock_.reset(new boost::mutex);
  if (!was_active_) was_active_.reset(new bool(false));
  return true;
}

void GazeboRosCameraUtils::advertise() {
  parentSensor_->SetActive(false);  // until there are subscribers
  rosnode_ = new ros::NodeHandle(robot_namespace_ + "/" + camera_name_);
  rosnode_->setCallbackQueue(&camera_queue_);
  frame_name_ = tf::resolve(tf::getPrefixParam(*rosnode_), frame_name_);
  camera_info_manager_.reset(new camera_info_manager::CameraInfoManager(*rosnode_, camera_name_));
  transport_.reset(new image_transport::ImageTransport(*rosnode_));
  if (!camera_name_.empty()) {
    options_.reset(new dynamic_reconfigure::Server<gazebo_plugins::GazeboRosCameraConfig>(*rosnode_));
    options_->setCallback(boost::bind(&GazeboRosCameraUtils::reconfigure, this, _1, _2));
  }
  image_pub_ = transport_->advertise(image_topic_name_, 2, boost::bind(&GazeboRosCameraUtils::ImageConnect, this),
                                     boost::bind(&GazeboRosCameraUtils::ImageDisconnect, this), ros::VoidPtr(), true);
  camera_info_pub_ = rosnode_->advertise<sensor_msgs::CameraInfo>(
      camera_info_topic_name_, 2, boost::bind(&GazeboRosCameraUtils::ImageConnect, this),
      boost::bind(&GazeboRosCameraUtils::ImageDisconnect, this));
  field_of_view_ = rosnode_->subscribe<std_msgs::Float64>("set_hfov", 1, [this](const std_msgs::Float64ConstPtr& m) {
    if (camera_) camera_->SetHFOV(ignition::math::Angle(m->data));
  });
  rate_ = rosnode_->subscribe<std_msgs::Float64>(
      "set_update_rate", 1, [this](const std_msgs::Float64ConstPtr& m) { parentSensor_->SetUpdateRate(m->data); });
  if (CanTriggerCamera())
    trigger_ = rosnode_->subscribe<std_msgs::Empty>(trigger_topic_name_, 1,
                                                    [this](const std_msgs::EmptyConstPtr&) { TriggerCamera(); });
  update_period_ = update_rate_ > 0.0 ? 1.0 / update_rate_ : 0.0;
  std::tie(type_, skip_) = encoding(format_);
  if (camera_ && camera_->LensDistortion()) camera_->LensDistortion()->SetCrop(border_crop_);
  camera_info_manager_->setCameraInfo(calibration());
  callback_queue_thread_ = boost::thread(boost::bind(&GazeboRosCameraUtils::CameraQueueThread, this));
  loaded_();
  initialized_ = true;
}

sensor_msgs::CameraInfo GazeboRosCameraUtils::calibration() const {
  const double cx = cx_ != 0.0 ? cx_ : (width_ + 1.0) / 2.0, cy = cy_ != 0.0 ? cy_ : (height_ + 1.0) / 2.0;
  double focal = focal_length_;
  if (focal == 0.0 && camera_) focal = width_ / (2.0 * std::tan(camera_->HFOV().Radian() / 2.0));
  sensor_msgs::CameraInfo info;
  info.header.frame_id = frame_name_;
  info.height = height_;
  info.width = width_;
  info.distortion_model = "plumb_bob";
  info.D = {distortion_k1_, distortion_k2_, distortion_t1_, distortion_t2_, distortion_k3_};
  if (auto_distortion_ && camera_ && camera_->LensDistortion()) {
    const rendering::Distortion& lens = *camera_->LensDistortion();
    info.D = {lens.K1(), lens.K2(), lens.P1(), lens.P2(), lens.K3()};
  }
  info.K = {focal, 0.0, cx, 0.0, focal, cy, 0.0, 0.0, 1.0};
  info.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  info.P = {focal, 0.0, cx, -focal * hack_baseline_, 0.0, focal, cy, 0.0, 0.0, 0.0, 1.0, 0.0};
  return info;
}

void GazeboRosCameraUtils::reconfigure(gazebo_plugins::GazeboRosCameraConfig& config, uint32_t) {
  if (initialized_) parentSensor_->SetUpdateRate(config.imager_rate);  // not by the default
}

void GazeboRosCameraUtils::ImageConnect() {
  const boost::mutex::scoped_lock lock(*image_connect_count_lock_);
  if (*image_connect_count_ == 0) *was_active_ = parentSensor_->IsActive();
  ++*image_connect_count_;
  parentSensor_->SetActive(true);
}

void GazeboRosCameraUtils::ImageDisconnect() {
  const boost::mutex::scoped_lock lock(*image_connect_count_lock_);
  if (--*image_connect_count_ <= 0 && !*was_active_) parentSensor_->SetActive(false);
}

void GazeboRosCameraUtils::PutCameraData(const unsigned char* image, common::Time& time) {
  sensor_update_time_ = time;
  PutCameraData(image);
}

void GazeboRosCameraUtils::PutCameraData(const unsigned char* image) {
  if (!initialized_ || height_ == 0 || width_ == 0 || *image_connect_count_ <= 0) return;
  const boost::mutex::scoped_lock lock(lock_);
  image_msg_.header.frame_id = frame_name_;
  image_msg_.header.stamp = ros::Time(sensor_update_time_.sec, sensor_update_time_.nsec);
  sensor_msgs::fillImage(image_msg_, type_, height_, width_, static_cast<uint32_t>(skip_) * width_, image);
  image_pub_.publish(image_msg_);
}

void GazeboRosCameraUtils::PublishCameraInfo(common::Time& time) {
  sensor_update_time_ = time;
  PublishCameraInfo();
}

void GazeboRosCameraUtils::PublishCameraInfo() {
  if (!initialized_ || height_ == 0 || width_ == 0 || camera_info_pub_.getNumSubscribers() == 0) return;
  sensor_update_time_ = parentSensor_->LastMeasurementTime();
  if (sensor_update_time_ - last_info_update_time_ < common::Time(update_period_)) return;
  PublishCameraInfo(camera_info_pub_);
  last_info_update_time_ = sensor_update_time_;
}

void GazeboRosCameraUtils::PublishCameraInfo(ros::Publisher publisher) {
  sensor_msgs::CameraInfo info = camera_info_manager_->getCameraInfo();
  info.header.frame_id = frame_name_;
  info.header.stamp = ros::Time(sensor_update_time_.sec, sensor_update_time_.nsec);
  publisher.publish(info);
}

void GazeboRosCameraUtils::CameraQueueThread() {
  while (rosnode_->ok()) camera_queue_.callAvailable(ros::WallDuration(0.05));
}

}  // namespace gazebo
