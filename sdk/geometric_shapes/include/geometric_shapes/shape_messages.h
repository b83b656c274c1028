#pragma once

#include <shape_msgs/Mesh.h>
#include <shape_msgs/Plane.h>
#include <shape_msgs/SolidPrimitive.h>

#include <boost/variant.hpp>

namespace shapes {

/** Message of any shape; boost::get<shape_msgs::Mesh>(message) is the mesh in it. */
typedef boost::variant<shape_msgs::SolidPrimitive, shape_msgs::Mesh, shape_msgs::Plane> ShapeMsg;

}  // namespace shapes
