// Ray intersections with shapes. Rays start at `o` and run along `d`, both in the shape's frame. Depths are in lengths
// of d, whose component along the view axis is 1 m. A shape that contains the ray's start is not hit. A miss is a false
// lane in `mask`.
#pragma once

#include "kernel.h"
#include "simd.h"

namespace trundle::TRUNDLE_ISA {

template <typename Numbers>
struct RayHit {
  Mask<Numbers> mask;
  Numbers depth;
};

template <typename Numbers, typename Number>
inline RayHit<Numbers> intersect_plane(const Vector3<Numbers>& o, const Vector3<Numbers>& d, const Number* half) {
  const Numbers depth = -o.z / d.z;
  Mask<Numbers> hit = (o.z > 0.0f) & (d.z < 0.0f);
  if (half[0] > 0.0f) hit &= abs(o.x + depth * d.x) <= half[0];
  if (half[1] > 0.0f) hit &= abs(o.y + depth * d.y) <= half[1];
  return {hit, depth};
}

template <typename Numbers, typename Number>
inline RayHit<Numbers> intersect_box(const Vector3<Numbers>& o, const Vector3<Numbers>& d, const Number* half) {
  Numbers enter = Numbers{} - 3e38f, leave = Numbers{} + 3e38f;
  const Numbers os[3] = {o.x, o.y, o.z}, ds[3] = {d.x, d.y, d.z};
  Mask<Numbers> missed = {};
  for (int i = 0; i < 3; ++i) {
    const Mask<Numbers> across = ds[i] != 0.0f;  // false: parallel to these faces
    const Numbers inverse = 1.0f / select(across, ds[i], Numbers{} + 1.0f);
    const Numbers a = (-half[i] - os[i]) * inverse, b = (half[i] - os[i]) * inverse;
    enter = select(across, max(enter, min(a, b)), enter);
    leave = select(across, min(leave, max(a, b)), leave);
    missed |= ~across & (abs(os[i]) > half[i]);
  }
  return {~missed & (enter <= leave) & (enter > 0.0f), enter};
}

// Measured from the ray's closest point to the centre: accurate also from far away.
template <typename Numbers, typename Number>
inline RayHit<Numbers> intersect_sphere(const Vector3<Numbers>& o, const Vector3<Numbers>& d, Number squared_radius) {
  const Numbers inverse = 1.0f / dot(d, d);
  const Numbers centre = -dot(o, d) * inverse;
  const Vector3<Numbers> nearest = o + d * centre;
  const Numbers inside = squared_radius - dot(nearest, nearest);
  const Numbers depth = centre - sqrt(max(inside, Numbers{}) * inverse);
  return {(inside >= 0.0f) & (depth > 0.0f), depth};
}

template <typename Numbers, typename Number>
inline RayHit<Numbers> intersect_ellipsoid(const Vector3<Numbers>& o, const Vector3<Numbers>& d, const Number* radii) {
  const Number one = 1, x = one / radii[0], y = one / radii[1], z = one / radii[2];
  return intersect_sphere(Vector3<Numbers>{o.x * x, o.y * y, o.z * z}, {d.x * x, d.y * y, d.z * z}, one);
}

// Distances along a ray to its entry into and exit from the infinite cylinder around z.
template <typename Numbers>
struct CylinderSpan {
  Mask<Numbers> inside;
  Numbers enter, leave;
};

template <typename Numbers, typename Number>
inline CylinderSpan<Numbers> intersect_infinite_cylinder(const Vector3<Numbers>& o, const Vector3<Numbers>& d,
                                                         Number radius) {
  const Numbers length = d.x * d.x + d.y * d.y;
  const Mask<Numbers> across = length > 0.0f;
  const Numbers inverse = 1.0f / select(across, length, Numbers{} + 1.0f);
  const Numbers centre = select(across, -(o.x * d.x + o.y * d.y) * inverse, Numbers{});
  const Numbers x = o.x + d.x * centre, y = o.y + d.y * centre;
  const Numbers inside = radius * radius - (x * x + y * y);
  const Numbers half = select(across, sqrt(max(inside, Numbers{}) * inverse), Numbers{} + 1e30f);
  return {inside >= 0.0f, centre - half, centre + half};
}

template <typename Numbers, typename Number>
inline RayHit<Numbers> intersect_cylinder(const Vector3<Numbers>& o, const Vector3<Numbers>& d, Number radius,
                                          Number half) {
  const CylinderSpan<Numbers> span = intersect_infinite_cylinder(o, d, radius);
  const Mask<Numbers> across = d.z != 0.0f;
  const Numbers inverse = 1.0f / select(across, d.z, Numbers{} + 1.0f);
  const Numbers a = (-half - o.z) * inverse, b = (half - o.z) * inverse;
  const Numbers enter = select(across, max(span.enter, min(a, b)), span.enter);
  const Numbers leave = select(across, min(span.leave, max(a, b)), span.leave);
  const Mask<Numbers> between = across | (abs(o.z) <= half);
  return {span.inside & between & (enter <= leave) & (enter > 0.0f), enter};
}

template <typename Numbers, typename Number>
inline RayHit<Numbers> intersect_capsule(const Vector3<Numbers>& o, const Vector3<Numbers>& d, Number radius,
                                         Number half) {
  const CylinderSpan<Numbers> span = intersect_infinite_cylinder(o, d, radius);
  const Numbers z = o.z + span.enter * d.z;
  const Mask<Numbers> side = span.inside & (abs(z) <= half) & (span.enter > 0.0f);
  // A ray that enters the cylinder beyond an end can hit only the cap there.
  const Numbers end = select(z < 0.0f, Numbers{} - half, Numbers{} + half);
  const RayHit<Numbers> cap = intersect_sphere(Vector3<Numbers>{o.x, o.y, o.z - end}, d, radius * radius);
  const Numbers reached = o.z + cap.depth * d.z;
  const Mask<Numbers> take = ~side & cap.mask & (abs(reached) >= half) & ((reached < 0.0f) == (end < 0.0f));
  const Numbers depth = select(take, cap.depth, span.enter);
  Mask<Numbers> hit = side | take;
  // A ray that starts inside must not hit a cap from within.
  const Numbers past = max(abs(o.z) - half, Numbers{});
  hit &= o.x * o.x + o.y * o.y + past * past > radius * radius;
  return {hit, depth};
}

template <ShapeKind kind, typename Numbers, typename Number>
inline RayHit<Numbers> intersect(const Number* size, const Vector3<Numbers>& o, const Vector3<Numbers>& d) {
  if constexpr (kind == ShapeKind::kPlane) return intersect_plane(o, d, size);
  if constexpr (kind == ShapeKind::kBox) return intersect_box(o, d, size);
  if constexpr (kind == ShapeKind::kSphere) return intersect_sphere(o, d, size[0] * size[0]);
  if constexpr (kind == ShapeKind::kCylinder) return intersect_cylinder(o, d, size[0], size[1]);
  if constexpr (kind == ShapeKind::kCapsule) return intersect_capsule(o, d, size[0], size[1]);
  if constexpr (kind == ShapeKind::kEllipsoid) return intersect_ellipsoid(o, d, size);
}

// Outward normal at a point of the surface, not normalised.
template <ShapeKind kind>
inline Floats3 normal_at(const Renderable& renderable, const Floats3& p) {
  const float* size = renderable.size;
  if constexpr (kind == ShapeKind::kPlane) return {Floats{}, Floats{}, splat(1.0f)};
  if constexpr (kind == ShapeKind::kBox) {  // distance to the closest face, in half lengths
    const Floats x = abs(p.x) / size[0], y = abs(p.y) / size[1], z = abs(p.z) / size[2];
    const Ints is_x = (x >= y) & (x >= z), is_y = ~is_x & (y >= z), is_z = ~is_x & ~is_y;
    const Floats one = splat(1.0f), sx = select(p.x < 0.0f, -one, one), sy = select(p.y < 0.0f, -one, one);
    return {select(is_x, sx, Floats{}), select(is_y, sy, Floats{}),
            select(is_z, select(p.z < 0.0f, -one, one), Floats{})};
  }
  if constexpr (kind == ShapeKind::kSphere) return p;
  if constexpr (kind == ShapeKind::kCylinder) {
    const Ints cap = (abs(p.z) - size[1]) * size[0] >= (p.x * p.x + p.y * p.y - size[0] * size[0]) * 0.5f;
    const Floats z = select(p.z < 0.0f, splat(-1.0f), splat(1.0f));
    return {select(cap, Floats{}, p.x), select(cap, Floats{}, p.y), select(cap, z, Floats{})};
  }
  if constexpr (kind == ShapeKind::kCapsule) {
    const Floats along = max(splat(-size[1]), min(splat(size[1]), p.z));
    return {p.x, p.y, p.z - along};
  }
  if constexpr (kind == ShapeKind::kEllipsoid)
    return {p.x / (size[0] * size[0]), p.y / (size[1] * size[1]), p.z / (size[2] * size[2])};
}

}  // namespace trundle::TRUNDLE_ISA
