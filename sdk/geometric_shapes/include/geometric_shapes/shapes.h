#pragma once

#include <cstdlib>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace octomap {
class OcTree;
}

/** Forms without a pose, each about the origin of its own frame; lengths in metres. */
namespace shapes {

enum ShapeType { UNKNOWN_SHAPE, SPHERE, CYLINDER, CONE, BOX, PLANE, MESH, OCTREE };

/** Writes the name of a type, such as `sphere`. */
std::ostream& operator<<(std::ostream& out, ShapeType type);

/** Form of an object. */
class Shape {
 public:
  Shape() : type(UNKNOWN_SHAPE) {}
  virtual ~Shape() {}

  /** New copy, which the caller deletes. */
  virtual Shape* clone() const = 0;
  virtual void print(std::ostream& out = std::cout) const;
  void scale(double scale) { scaleAndPadd(scale, 0.0); }
  /** Move the surface outwards [m]. */
  void padd(double padding) { scaleAndPadd(1.0, padding); }
  /** Scale, then move the surface outwards [m]; throws std::runtime_error where a length would become negative. */
  virtual void scaleAndPadd(double scale, double padd) = 0;
  /** Whether it can be neither scaled nor padded. */
  virtual bool isFixed() const { return false; }

  ShapeType type;
};

/** Sphere about the origin. */
class Sphere : public Shape {
 public:
  Sphere() : Sphere(0.0) {}
  Sphere(double r);

  static const std::string STRING_NAME;

  void scaleAndPadd(double scale, double padd) override;
  Sphere* clone() const override { return new Sphere(*this); }
  void print(std::ostream& out = std::cout) const override;

  double radius;
};

/** Cylinder along z, its middle at the origin. */
class Cylinder : public Shape {
 public:
  using Shape::padd;
  using Shape::scale;

  Cylinder() : Cylinder(0.0, 0.0) {}
  Cylinder(double r, double l);

  static const std::string STRING_NAME;

  void scale(double scaleRadius, double scaleLength) { scaleAndPadd(scaleRadius, scaleLength, 0.0, 0.0); }
  void padd(double paddRadius, double paddLength) { scaleAndPadd(1.0, 1.0, paddRadius, paddLength); }
  /** Both ends move by paddLength. */
  void scaleAndPadd(double scaleRadius, double scaleLength, double paddRadius, double paddLength);
  void scaleAndPadd(double scale, double padd) override { scaleAndPadd(scale, scale, padd, padd); }
  Cylinder* clone() const override { return new Cylinder(*this); }
  void print(std::ostream& out = std::cout) const override;

  double length;
  double radius;
};

/** Cone along z, its tip at length / 2 and its base at -length / 2. */
class Cone : public Shape {
 public:
  using Shape::padd;
  using Shape::scale;

  Cone() : Cone(0.0, 0.0) {}
  Cone(double r, double l);

  static const std::string STRING_NAME;

  void scale(double scaleRadius, double scaleLength) { scaleAndPadd(scaleRadius, scaleLength, 0.0, 0.0); }
  void padd(double paddRadius, double paddLength) { scaleAndPadd(1.0, 1.0, paddRadius, paddLength); }
  /** Tip and base move by paddLength. */
  void scaleAndPadd(double scaleRadius, double scaleLength, double paddRadius, double paddLength);
  void scaleAndPadd(double scale, double padd) override { scaleAndPadd(scale, scale, padd, padd); }
  Cone* clone() const override { return new Cone(*this); }
  void print(std::ostream& out = std::cout) const override;

  double length;
  double radius;
};

/** Box along the axes, its middle at the origin. */
class Box : public Shape {
 public:
  using Shape::padd;
  using Shape::scale;

  Box() : Box(0.0, 0.0, 0.0) {}
  Box(double x, double y, double z);

  static const std::string STRING_NAME;

  void scale(double scaleX, double scaleY, double scaleZ) { scaleAndPadd(scaleX, scaleY, scaleZ, 0.0, 0.0, 0.0); }
  void padd(double paddX, double paddY, double paddZ) { scaleAndPadd(1.0, 1.0, 1.0, paddX, paddY, paddZ); }
  /** Each side moves by its padding. */
  void scaleAndPadd(double scaleX, double scaleY, double scaleZ, double paddX, double paddY, double paddZ);
  void scaleAndPadd(double scale, double padd) override { scaleAndPadd(scale, scale, scale, padd, padd, padd); }
  Box* clone() const override { return new Box(*this); }
  void print(std::ostream& out = std::cout) const override;

  double size[3];
};

/** Triangles with shared vertices, in arrays that the mesh deletes; normals may be null. */
class Mesh : public Shape {
 public:
  using Shape::padd;
  using Shape::scale;

  Mesh();
  /** Arrays of these counts, to be filled. */
  Mesh(unsigned int v_count, unsigned int t_count);
  Mesh(const Mesh& other);
  Mesh& operator=(const Mesh&) = delete;
  ~Mesh() override;

  static const std::string STRING_NAME;

  void scale(double scaleX, double scaleY, double scaleZ) { scaleAndPadd(scaleX, scaleY, scaleZ, 0.0, 0.0, 0.0); }
  void padd(double paddX, double paddY, double paddZ) { scaleAndPadd(1.0, 1.0, 1.0, paddX, paddY, paddZ); }
  /** Scale about the mean of the vertices, then move each vertex along its normal. */
  void scaleAndPadd(double scaleX, double scaleY, double scaleZ, double paddX, double paddY, double paddZ);
  void scaleAndPadd(double scale, double padd) override { scaleAndPadd(scale, scale, scale, padd, padd, padd); }
  Mesh* clone() const override { return new Mesh(*this); }
  void print(std::ostream& out = std::cout) const override;

  /** Unit normals of the triangles, by the order of their vertices; zero for triangles without area. */
  void computeTriangleNormals();
  /** Unit normals of the vertices: means of their triangles' normals, weighted by the angles there. */
  void computeVertexNormals();
  /** Make vertices one that are at most this far apart [m]. */
  void mergeVertices(double threshold);

  unsigned int vertex_count;
  /** x, y, z of each vertex. */
  double* vertices;
  unsigned int triangle_count;
  /** Three vertices of each triangle, by their numbers. */
  unsigned int* triangles;
  /** x, y, z for each triangle. */
  double* triangle_normals;
  /** x, y, z for each vertex. */
  double* vertex_normals;
};

/** Plane a x + b y + c z + d = 0. */
class Plane : public Shape {
 public:
  Plane() : Plane(0.0, 0.0, 0.0, 0.0) {}
  Plane(double pa, double pb, double pc, double pd);

  static const std::string STRING_NAME;

  Plane* clone() const override { return new Plane(*this); }
  void print(std::ostream& out = std::cout) const override;
  /** Warns, and does nothing. */
  void scaleAndPadd(double scale, double padd) override;
  bool isFixed() const override { return true; }

  double a, b, c, d;
};

/** Tree of octomap, which the kit does not have: a shape that programs pass on. */
class OcTree : public Shape {
 public:
  OcTree() { type = OCTREE; }
  OcTree(const std::shared_ptr<const octomap::OcTree>& t) : octree(t) { type = OCTREE; }

  static const std::string STRING_NAME;

  OcTree* clone() const override { return new OcTree(octree); }
  void print(std::ostream& out = std::cout) const override;
  /** Warns, and does nothing. */
  void scaleAndPadd(double scale, double padd) override;
  bool isFixed() const override { return true; }

  std::shared_ptr<const octomap::OcTree> octree;
};

typedef std::shared_ptr<Shape> ShapePtr;
typedef std::shared_ptr<const Shape> ShapeConstPtr;

}  // namespace shapes
