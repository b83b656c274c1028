#pragma once

#include <eigen_stl_containers/eigen_stl_containers.h>

#include <string>
#include <vector>

#include "geometric_shapes/shapes.h"

/** New meshes, which the caller deletes; null, after a message, where there is none. */
namespace shapes {

/** Mesh of vertices and of triangles: three numbers of vertices for each. */
Mesh* createMeshFromVertices(const EigenSTL::vector_Vector3d& vertices, const std::vector<unsigned int>& triangles);
/** Mesh of triangles, three points for each; equal points become one vertex. */
Mesh* createMeshFromVertices(const EigenSTL::vector_Vector3d& source);

/** Mesh of an STL, OBJ or COLLADA file, named by package://PACKAGE/PATH, file:///PATH or a path.
 *
 * As in the original, lengths of COLLADA are taken as metres and its axes as they are: its <unit> and <up_axis> do not
 * count, while they do, as in Gazebo and rviz, for meshes of robots' descriptions. */
Mesh* createMeshFromResource(const std::string& resource);
/** The same, its vertices multiplied by a scale along each axis. */
Mesh* createMeshFromResource(const std::string& resource, const Eigen::Vector3d& scale);
/** Mesh of a file's contents; its name or extension says what it is, else its first bytes do. */
Mesh* createMeshFromBinary(const char* buffer, std::size_t size, const std::string& assimp_hint = std::string());
Mesh* createMeshFromBinary(const char* buffer, std::size_t size, const Eigen::Vector3d& scale,
                           const std::string& assimp_hint = std::string());

/** Mesh of a sphere, box, cylinder or cone. */
Mesh* createMeshFromShape(const Shape* shape);
Mesh* createMeshFromShape(const Box& box);
/** Triangles with sides of about 1 cm. */
Mesh* createMeshFromShape(const Sphere& sphere);
Mesh* createMeshFromShape(const Cylinder& cylinder);
Mesh* createMeshFromShape(const Cone& cone);

/** Contents of a binary STL file with the mesh. */
void writeSTLBinary(const Mesh* mesh, std::vector<char>& buffer);

}  // namespace shapes
