#ifndef GAZEBO_SENSORS_GPURAYSENSOR_HH_
#define GAZEBO_SENSORS_GPURAYSENSOR_HH_

#include <gazebo/sensors/RaySensor.hh>

namespace gazebo {
namespace sensors {

// The same rays: the simulator casts them on the processor.
class GpuRaySensor : public RaySensor {
 public:
  unsigned int CameraCount() const { return 1; }
  bool IsHorizontal() const { return true; }
  double RangeCountRatio() const {
    return VerticalRangeCount() > 0 ? double(RangeCount()) / VerticalRangeCount() : 0.0;
  }
};

}  // namespace sensors
}  // namespace gazebo

#endif
