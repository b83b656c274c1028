#pragma once

#include <shape_msgs/Mesh.h>
#include <shape_msgs/SolidPrimitive.h>

namespace geometric_shapes {

/** Sides of the box along the axes that holds a shape [m]; zeros where dimensions are missing. */
void getShapeExtents(const shape_msgs::SolidPrimitive& shape_msg, double& x_extent, double& y_extent, double& z_extent);
void getShapeExtents(const shape_msgs::Mesh& shape_msg, double& x_extent, double& y_extent, double& z_extent);

}  // namespace geometric_shapes
