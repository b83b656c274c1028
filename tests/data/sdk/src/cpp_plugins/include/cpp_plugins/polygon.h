#pragma once

namespace shapes {

class Polygon {
 public:
  virtual ~Polygon() {}
  virtual void initialize(double side) = 0;
  virtual double area() const = 0;
};

}  // namespace shapes
