#pragma once

#include <visualization_msgs/Marker.h>

#include <iostream>

#include "geometric_shapes/mesh_operations.h"
#include "geometric_shapes/shape_messages.h"
#include "geometric_shapes/shapes.h"

namespace shapes {

/** New shape of a message, which the caller deletes; null, after a message, where it is not valid. */
Shape* constructShapeFromMsg(const shape_msgs::SolidPrimitive& shape_msg);
Shape* constructShapeFromMsg(const shape_msgs::Plane& shape_msg);
Shape* constructShapeFromMsg(const shape_msgs::Mesh& shape_msg);
Shape* constructShapeFromMsg(const ShapeMsg& shape_msg);

/** Message of a shape; false for null and a tree of octomap. */
bool constructMsgFromShape(const Shape* shape, ShapeMsg& shape_msg);
/** Type, scale and points of a marker; false for planes, trees and null. */
bool constructMarkerFromShape(const Shape* shape, visualization_msgs::Marker& mk, bool use_mesh_triangle_list = false);

/** Sides of the box along the axes that holds a shape [m]; zeros for a plane. */
Eigen::Vector3d computeShapeExtents(const ShapeMsg& shape_msg);
Eigen::Vector3d computeShapeExtents(const Shape* shape);
/** Sphere that holds a shape; of radius zero for a plane. */
void computeShapeBoundingSphere(const Shape* shape, Eigen::Vector3d& center, double& radius);

/** Name of a shape's type, such as `sphere`; empty for null. */
const std::string& shapeStringName(const Shape* shape);

/** Write the name of the type and the numbers of a shape. */
void saveAsText(const Shape* shape, std::ostream& out);
/** New shape of such a text, which the caller deletes; null where it is no shape. */
Shape* constructShapeFromText(std::istream& in);

}  // namespace shapes
