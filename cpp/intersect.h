// Ray intersections with shapes. Rays start at `o` and run along `d`, both in the shape's frame. Depths are in lengths
// of d, whose component along the view axis is 1 m. A shape that contains the ray's start is not hit. A miss is a false
// lane in `mask`.
#pragma once

#include "kernel.h"
#include "simd.h"

namespace trundle::TRUNDLE_ISA {

template <typename N>
struct RayHit {
  Mask<N> mask;
  N depth;
};

template <typename N, typename Number>
inline RayHit<N> intersect_plane(const Vector3<N>& o, const Vector3<N>& d, const Number* half) {
  const N depth = -o.z / d.z;
  Mask<N> hit = (o.z > 0.0f) & (d.z < 0.0f);
  if (half[0] > 0.0f) hit &= abs(o.x + depth * d.x) <= half[0];
  if (half[1] > 0.0f) hit &= abs(o.y + depth * d.y) <= half[1];
  return {hit, depth};
}

template <typename N, typename Number>
inline RayHit<N> intersect_box(const Vector3<N>& o, const Vector3<N>& d, const Number* half) {
  N enter = N{} - 3e38f, leave = N{} + 3e38f;
  const N os[3] = {o.x, o.y, o.z}, ds[3] = {d.x, d.y, d.z};
  Mask<N> missed = {};
  for (int i = 0; i < 3; ++i) {
    const Mask<N> across = ds[i] != 0.0f;  // false: parallel to these faces
    const N inverse = 1.0f / select(across, ds[i], N{} + 1.0f);
    const N a = (-half[i] - os[i]) * inverse, b = (half[i] - os[i]) * inverse;
    enter = select(across, max(enter, min(a, b)), enter);
    leave = select(across, min(leave, max(a, b)), leave);
    missed |= ~across & (abs(os[i]) > half[i]);
  }
  return {~missed & (enter <= leave) & (enter > 0.0f), enter};
}

// Measured from the ray's closest point to the centre: accurate also from far away.
template <typename N, typename Number>
inline RayHit<N> intersect_sphere(const Vector3<N>& o, const Vector3<N>& d, Number squared_radius) {
  const N inverse = 1.0f / dot(d, d);
  const N centre = -dot(o, d) * inverse;
  const Vector3<N> nearest = o + d * centre;
  const N inside = squared_radius - dot(nearest, nearest);
  const N depth = centre - sqrt(max(inside, N{}) * inverse);
  return {(inside >= 0.0f) & (depth > 0.0f), depth};
}

template <typename N, typename Number>
inline RayHit<N> intersect_ellipsoid(const Vector3<N>& o, const Vector3<N>& d, const Number* radii) {
  const Number one = 1, x = one / radii[0], y = one / radii[1], z = one / radii[2];
  return intersect_sphere(Vector3<N>{o.x * x, o.y * y, o.z * z}, {d.x * x, d.y * y, d.z * z}, one);
}

// Distances along a ray to its entry into and exit from the infinite cylinder around z.
template <typename N>
struct CylinderSpan {
  Mask<N> inside;
  N enter, leave;
};

template <typename N, typename Number>
inline CylinderSpan<N> intersect_infinite_cylinder(const Vector3<N>& o, const Vector3<N>& d, Number radius) {
  const N length = d.x * d.x + d.y * d.y;
  const Mask<N> across = length > 0.0f;
  const N inverse = 1.0f / select(across, length, N{} + 1.0f);
  const N centre = select(across, -(o.x * d.x + o.y * d.y) * inverse, N{});
  const N x = o.x + d.x * centre, y = o.y + d.y * centre;
  const N inside = radius * radius - (x * x + y * y);
  const N half = select(across, sqrt(max(inside, N{}) * inverse), N{} + 1e30f);
  return {inside >= 0.0f, centre - half, centre + half};
}

template <typename N, typename Number>
inline RayHit<N> intersect_cylinder(const Vector3<N>& o, const Vector3<N>& d, Number radius, Number half) {
  const CylinderSpan<N> span = intersect_infinite_cylinder(o, d, radius);
  const Mask<N> across = d.z != 0.0f;
  const N inverse = 1.0f / select(across, d.z, N{} + 1.0f);
  const N a = (-half - o.z) * inverse, b = (half - o.z) * inverse;
  const N enter = select(across, max(span.enter, min(a, b)), span.enter);
  const N leave = select(across, min(span.leave, max(a, b)), span.leave);
  const Mask<N> between = across | (abs(o.z) <= half);
  return {span.inside & between & (enter <= leave) & (enter > 0.0f), enter};
}

template <typename N, typename Number>
inline RayHit<N> intersect_capsule(const Vector3<N>& o, const Vector3<N>& d, Number radius, Number half) {
  const CylinderSpan<N> span = intersect_infinite_cylinder(o, d, radius);
  const N z = o.z + span.enter * d.z;
  const Mask<N> side = span.inside & (abs(z) <= half) & (span.enter > 0.0f);
  // A ray that enters the cylinder beyond an end can hit only the cap there.
  const N end = select(z < 0.0f, N{} - half, N{} + half);
  const RayHit<N> cap = intersect_sphere(Vector3<N>{o.x, o.y, o.z - end}, d, radius * radius);
  const N reached = o.z + cap.depth * d.z;
  const Mask<N> take = ~side & cap.mask & (abs(reached) >= half) & ((reached < 0.0f) == (end < 0.0f));
  const N depth = select(take, cap.depth, span.enter);
  Mask<N> hit = side | take;
  // A ray that starts inside must not hit a cap from within.
  const N past = max(abs(o.z) - half, N{});
  hit &= o.x * o.x + o.y * o.y + past * past > radius * radius;
  return {hit, depth};
}

template <ShapeKind kind, typename N, typename Number>
inline RayHit<N> intersect(const Number* size, const Vector3<N>& o, const Vector3<N>& d) {
  if constexpr (kind == ShapeKind::kPlane) return intersect_plane(o, d, size);
  if constexpr (kind == ShapeKind::kBox) return intersect_box(o, d, size);
  if constexpr (kind == ShapeKind::kSphere) return intersect_sphere(o, d, size[0] * size[0]);
  if constexpr (kind == ShapeKind::kCylinder) return intersect_cylinder(o, d, size[0], size[1]);
  if constexpr (kind == ShapeKind::kCapsule) return intersect_capsule(o, d, size[0], size[1]);
  if constexpr (kind == ShapeKind::kEllipsoid) return intersect_ellipsoid(o, d, size);
}

// Outward normal at a point of the surface, not normalised.
template <ShapeKind kind>
inline F3 normal_at(const Renderable& renderable, const F3& p) {
  const float* size = renderable.size;
  if constexpr (kind == ShapeKind::kPlane) return {F{}, F{}, splat(1.0f)};
  if constexpr (kind == ShapeKind::kBox) {  // of the closest face, in half lengths
    const F x = abs(p.x) / size[0], y = abs(p.y) / size[1], z = abs(p.z) / size[2];
    const I is_x = (x >= y) & (x >= z), is_y = ~is_x & (y >= z), is_z = ~is_x & ~is_y;
    const F one = splat(1.0f), sx = select(p.x < 0.0f, -one, one), sy = select(p.y < 0.0f, -one, one);
    return {select(is_x, sx, F{}), select(is_y, sy, F{}), select(is_z, select(p.z < 0.0f, -one, one), F{})};
  }
  if constexpr (kind == ShapeKind::kSphere) return p;
  if constexpr (kind == ShapeKind::kCylinder) {
    const I cap = (abs(p.z) - size[1]) * size[0] >= (p.x * p.x + p.y * p.y - size[0] * size[0]) * 0.5f;
    const F z = select(p.z < 0.0f, splat(-1.0f), splat(1.0f));
    return {select(cap, F{}, p.x), select(cap, F{}, p.y), select(cap, z, F{})};
  }
  if constexpr (kind == ShapeKind::kCapsule) {
    const F along = max(splat(-size[1]), min(splat(size[1]), p.z));
    return {p.x, p.y, p.z - along};
  }
  if constexpr (kind == ShapeKind::kEllipsoid)
    return {p.x / (size[0] * size[0]), p.y / (size[1] * size[1]), p.z / (size[2] * size[2])};
}

}  // namespace trundle::TRUNDLE_ISA
