#ifndef GAZEBO_SENSORS_RAYSENSOR_HH_
#define GAZEBO_SENSORS_RAYSENSOR_HH_

#include <string>
#include <vector>

#include <gazebo/math/Angle.hh>
#include <gazebo/msgs/msgs.hh>
#include <gazebo/sensors/Noise.hh>
#include <gazebo/sensors/Sensor.hh>
#include <gazebo/transport/transport.hh>

namespace gazebo {
namespace physics {

// Rays of a sensor, as a shape.
class MultiRayShape {
 public:
  explicit MultiRayShape(sensors::RaySensor* sensor) : sensor_(sensor) {}
  double GetRange(unsigned int index);
  double GetRetro(unsigned int index);
  int GetFiducial(unsigned int) { return -1; }
  double GetMinRange() const;
  double GetMaxRange() const;
  double GetResRange() const;
  int GetSampleCount() const;
  double GetScanResolution() const { return 1.0; }
  ignition::math::Angle MinAngle() const;
  ignition::math::Angle MaxAngle() const;
  ignition::math::Angle GetMinAngle() const { return MinAngle(); }
  ignition::math::Angle GetMaxAngle() const { return MaxAngle(); }
  int GetVerticalSampleCount() const;
  double GetVerticalScanResolution() const { return 1.0; }
  ignition::math::Angle VerticalMinAngle() const;
  ignition::math::Angle VerticalMaxAngle() const;
  event::ConnectionPtr ConnectNewLaserScans(std::function<void()> subscriber);
  void DisconnectNewLaserScans(event::ConnectionPtr connection);

 private:
  sensors::RaySensor* sensor_;
};

}  // namespace physics

namespace sensors {

// Distances along rays, row by row; ranges out of reach are infinite. [m], [rad]
class RaySensor : public Sensor {
 public:
  RaySensor() : Sensor(RAY), shape_(new physics::MultiRayShape(this)) {}

  physics::MultiRayShapePtr LaserShape() const { return shape_; }
  physics::MultiRayShapePtr GetLaserShape() const { return shape_; }

  ignition::math::Angle AngleMin() const { return ignition::math::Angle(angle_[0]); }
  ignition::math::Angle AngleMax() const { return ignition::math::Angle(angle_[1]); }
  double AngleResolution() const { return Step(angle_, count_); }
  ignition::math::Angle VerticalAngleMin() const { return ignition::math::Angle(vertical_angle_[0]); }
  ignition::math::Angle VerticalAngleMax() const { return ignition::math::Angle(vertical_angle_[1]); }
  double VerticalAngleResolution() const { return Step(vertical_angle_, vertical_count_); }
  double RangeMin() const { return range_[0]; }
  double RangeMax() const { return range_[1]; }
  double RangeResolution() const { return resolution_; }
  int RayCount() const { return count_; }
  int RangeCount() const { return count_; }
  int VerticalRayCount() const { return vertical_count_; }
  int VerticalRangeCount() const { return vertical_count_; }
  void Ranges(std::vector<double>& ranges) const;
  double Range(unsigned int index) const { return At(ranges_, index); }
  // Of the ranges within reach.
  NoisePtr Noise(SensorNoiseType) const override { return noise_; }
  double Retro(unsigned int index) const { return At(retros_, index); }
  int Fiducial(unsigned int) const { return -1; }
  bool IsWanted() const override { return Sensor::IsWanted() || new_scans_.ConnectionCount() > 0 || HasReaders(); }

  // Called with the ranges of each reading, as the GPU's laser does: three floats per ray, of which the second is the
  // intensity and the third 0.
  event::ConnectionPtr ConnectNewLaserFrame(
      std::function<void(const float*, unsigned int, unsigned int, unsigned int, const std::string&)> subscriber) {
    return new_scans_.Connect(subscriber);
  }
  void DisconnectNewLaserFrame(event::ConnectionPtr connection) { new_scans_.Disconnect(connection); }

  // Names up to Gazebo 6.
  math::Angle GetAngleMin() const { return AngleMin(); }
  math::Angle GetAngleMax() const { return AngleMax(); }
  double GetAngleResolution() const { return AngleResolution(); }
  math::Angle GetVerticalAngleMin() const { return VerticalAngleMin(); }
  math::Angle GetVerticalAngleMax() const { return VerticalAngleMax(); }
  double GetRangeMin() const { return RangeMin(); }
  double GetRangeMax() const { return RangeMax(); }
  double GetRangeResolution() const { return RangeResolution(); }
  int GetRayCount() const { return RayCount(); }
  int GetRangeCount() const { return RangeCount(); }
  int GetVerticalRayCount() const { return VerticalRayCount(); }
  int GetVerticalRangeCount() const { return VerticalRangeCount(); }
  void GetRanges(std::vector<double>& ranges) { Ranges(ranges); }
  double GetRange(int index) { return Range(static_cast<unsigned int>(index)); }
  double GetRetro(int index) { return Retro(static_cast<unsigned int>(index)); }
  int GetFiducial(int index) { return Fiducial(static_cast<unsigned int>(index)); }

 protected:
  void Read(const sdf::ElementPtr& sdf) override;
  void Set(const TrundleGazeboReading& reading) override;
  void Tell(const void* world) override;

 private:
  static double Step(const double (&angles)[2], int count) {
    return count > 1 ? (angles[1] - angles[0]) / (count - 1) : 0.0;
  }
  double At(const std::vector<double>& values, unsigned int index) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return index < values.size() ? values[index] : 0.0;
  }
  bool HasReaders() const { return scans_ && scans_->HasConnections(); }

  physics::MultiRayShapePtr shape_;
  double angle_[2] = {0.0, 0.0}, vertical_angle_[2] = {0.0, 0.0}, range_[2] = {0.0, 0.0}, resolution_ = 0.0;
  int count_ = 1, vertical_count_ = 1;
  std::vector<double> ranges_, retros_;
  NoisePtr noise_ = std::make_shared<sensors::Noise>();
  transport::PublisherPtr scans_;
  event::EventT<void(const float*, unsigned int, unsigned int, unsigned int, const std::string&)> new_scans_;
};

}  // namespace sensors
}  // namespace gazebo

#endif
