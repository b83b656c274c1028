#include "geometric_shapes/shape_extents.h"

#include <Eigen/Geometry>

namespace geometric_shapes {

using shape_msgs::SolidPrimitive;

void getShapeExtents(const SolidPrimitive& shape_msg, double& x_extent, double& y_extent, double& z_extent) {
  const auto& sizes = shape_msg.dimensions;
  x_extent = y_extent = z_extent = 0.0;
  if (shape_msg.type == SolidPrimitive::SPHERE && !sizes.empty()) {
    x_extent = y_extent = z_extent = 2.0 * sizes[SolidPrimitive::SPHERE_RADIUS];
  } else if (shape_msg.type == SolidPrimitive::BOX && sizes.size() >= 3) {
    x_extent = sizes[SolidPrimitive::BOX_X];
    y_extent = sizes[SolidPrimitive::BOX_Y];
    z_extent = sizes[SolidPrimitive::BOX_Z];
  } else if (shape_msg.type == SolidPrimitive::CYLINDER && sizes.size() >= 2) {
    x_extent = y_extent = 2.0 * sizes[SolidPrimitive::CYLINDER_RADIUS];
    z_extent = sizes[SolidPrimitive::CYLINDER_HEIGHT];
  } else if (shape_msg.type == SolidPrimitive::CONE && sizes.size() >= 2) {
    x_extent = y_extent = 2.0 * sizes[SolidPrimitive::CONE_RADIUS];
    z_extent = sizes[SolidPrimitive::CONE_HEIGHT];
  }
}

void getShapeExtents(const shape_msgs::Mesh& shape_msg, double& x_extent, double& y_extent, double& z_extent) {
  Eigen::AlignedBox3d box;
  for (const geometry_msgs::Point& vertex : shape_msg.vertices)
    box.extend(Eigen::Vector3d(vertex.x, vertex.y, vertex.z));
  const Eigen::Vector3d sides = box.isEmpty() ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : box.sizes();
  x_extent = sides.x();
  y_extent = sides.y();
  z_extent = sides.z();
}

}  // namespace geometric_shapes
