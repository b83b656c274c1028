#pragma once

#include <shape_msgs/SolidPrimitive.h>

namespace geometric_shapes {

/** Number of dimensions of a type of shape_msgs::SolidPrimitive. */
template <int shape>
constexpr unsigned int solidPrimitiveDimCount() {
  static_assert(shape >= shape_msgs::SolidPrimitive::BOX && shape <= shape_msgs::SolidPrimitive::CONE,
                "a type of shape_msgs::SolidPrimitive");
  return shape == shape_msgs::SolidPrimitive::SPHERE ? 1 : shape == shape_msgs::SolidPrimitive::BOX ? 3 : 2;
}

/** The same by its older name. */
template <int shape>
struct SolidPrimitiveDimCount {
  enum { value = solidPrimitiveDimCount<shape>() };
};

}  // namespace geometric_shapes
