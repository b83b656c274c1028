// Noise of a sensor, by a function of a plugin.
#ifndef GAZEBO_SENSORS_NOISE_HH_
#define GAZEBO_SENSORS_NOISE_HH_

#include <functional>
#include <mutex>

#include <gazebo/sensors/SensorTypes.hh>

namespace gazebo {
namespace sensors {

// The simulator adds what the file's <noise> says. What a plugin adds acts on its readings after that, here, and so
// reaches the sensor's plugins alone.
class Noise {
 public:
  enum NoiseType { NONE, CUSTOM, GAUSSIAN, GAUSSIAN_QUANTIZED };

  explicit Noise(NoiseType type = NONE) : type_(type) {}
  NoiseType GetNoiseType() const { return type_; }
  // Value with noise, from the one without.
  void SetCustomNoiseCallback(std::function<double(double)> function);
  double Apply(double value) const;

 private:
  mutable std::mutex mutex_;
  NoiseType type_;
  std::function<double(double)> function_;
};

}  // namespace sensors
}  // namespace gazebo

#endif
