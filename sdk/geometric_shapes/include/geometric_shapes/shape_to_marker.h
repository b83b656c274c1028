#pragma once

#include <shape_msgs/Mesh.h>
#include <shape_msgs/SolidPrimitive.h>
#include <visualization_msgs/Marker.h>

namespace geometric_shapes {

/** Type, scale and points of a marker: triangles, or else their edges. Throws std::runtime_error for an empty mesh, and
 * one whose triangles name vertices that it has not. */
void constructMarkerFromShape(const shape_msgs::Mesh& shape_msg, visualization_msgs::Marker& marker,
                              bool use_mesh_triangle_list = true);
/** Type and scale of a marker; a cone is shown as a cylinder. Throws std::runtime_error where dimensions are missing.
 */
void constructMarkerFromShape(const shape_msgs::SolidPrimitive& shape_msg, visualization_msgs::Marker& marker);

}  // namespace geometric_shapes
