#include <cpp_plugins/polygon.h>
#include <pluginlib/class_list_macros.h>

#include <cmath>

namespace shapes {

class Square : public Polygon {
 public:
  void initialize(double side) override { side_ = side; }
  double area() const override { return side_ * side_; }

 private:
  double side_ = 0.0;
};

/** A second base, so that the pointer to the object is not the one to the base. */
class Named {
 public:
  virtual ~Named() {}
  double padding = 7.0;
};
class Triangle : public Named, public Polygon {
 public:
  void initialize(double side) override { side_ = side; }
  double area() const override { return std::sqrt(3.0) / 4.0 * side_ * side_; }

 private:
  double side_ = 0.0;
};

}  // namespace shapes

PLUGINLIB_EXPORT_CLASS(shapes::Square, shapes::Polygon)
PLUGINLIB_EXPORT_CLASS(shapes::Triangle, shapes::Polygon)
