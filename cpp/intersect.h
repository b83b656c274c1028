// Where rays meet shapes. Rays start at `o` and run along `d`, both in the shape's frame; d is one metre long along the
// view axis, so that what comes back, the first point's distance in lengths of d, is the depth. Of a shape that the
// ray starts inside, nothing is seen. A miss is a false lane in `hit`.
#pragma once

#include "kernel.h"
#include "lanes.h"

namespace trundle::TRUNDLE_ISA {

template <typename N>
struct Meeting {
  Mask<N> hit;
  N depth;
};

template <typename N, typename Number>
inline Meeting<N> meet_plane(const Three<N>& o, const Three<N>& d, const Number* half) {
  const N depth = -o.z / d.z;
  Mask<N> hit = (o.z > 0.0f) & (d.z < 0.0f);
  if (half[0] > 0.0f) hit &= abs(o.x + depth * d.x) <= half[0];
  if (half[1] > 0.0f) hit &= abs(o.y + depth * d.y) <= half[1];
  return {hit, depth};
}

template <typename N, typename Number>
inline Meeting<N> meet_box(const Three<N>& o, const Three<N>& d, const Number* half) {
  N enter = N{} - 3e38f, leave = N{} + 3e38f;
  const N os[3] = {o.x, o.y, o.z}, ds[3] = {d.x, d.y, d.z};
  Mask<N> missed = {};
  for (int i = 0; i < 3; ++i) {
    const Mask<N> across = ds[i] != 0.0f;  // a ray along a face meets it never or always
    const N inverse = 1.0f / select(across, ds[i], N{} + 1.0f);
    const N a = (-half[i] - os[i]) * inverse, b = (half[i] - os[i]) * inverse;
    enter = select(across, max(enter, min(a, b)), enter);
    leave = select(across, min(leave, max(a, b)), leave);
    missed |= ~across & (abs(os[i]) > half[i]);
  }
  return {~missed & (enter <= leave) & (enter > 0.0f), enter};
}

// The ball of radius 1, from the ray's closest point on: exact also from far away.
template <typename N, typename Number>
inline Meeting<N> meet_ball(const Three<N>& o, const Three<N>& d, Number squared_radius) {
  const N inverse = 1.0f / dot(d, d);
  const N middle = -dot(o, d) * inverse;
  const Three<N> nearest = o + d * middle;
  const N inside = squared_radius - dot(nearest, nearest);
  const N depth = middle - sqrt(max(inside, N{}) * inverse);
  return {(inside >= 0.0f) & (depth > 0.0f), depth};
}

template <typename N, typename Number>
inline Meeting<N> meet_ellipsoid(const Three<N>& o, const Three<N>& d, const Number* radii) {
  const Number one = 1, x = one / radii[0], y = one / radii[1], z = one / radii[2];
  return meet_ball(Three<N>{o.x * x, o.y * y, o.z * z}, {d.x * x, d.y * y, d.z * z}, one);
}

// The endless pipe around z: where the ray goes in and how far it is inside.
template <typename N>
struct Pipe {
  Mask<N> inside;
  N enter, leave;
};

template <typename N, typename Number>
inline Pipe<N> meet_pipe(const Three<N>& o, const Three<N>& d, Number radius) {
  const N length = d.x * d.x + d.y * d.y;
  const Mask<N> across = length > 0.0f;
  const N inverse = 1.0f / select(across, length, N{} + 1.0f);
  const N middle = select(across, -(o.x * d.x + o.y * d.y) * inverse, N{});
  const N x = o.x + d.x * middle, y = o.y + d.y * middle;
  const N inside = radius * radius - (x * x + y * y);
  const N half = select(across, sqrt(max(inside, N{}) * inverse), N{} + 1e30f);
  return {inside >= 0.0f, middle - half, middle + half};
}

template <typename N, typename Number>
inline Meeting<N> meet_cylinder(const Three<N>& o, const Three<N>& d, Number radius, Number half) {
  const Pipe<N> pipe = meet_pipe(o, d, radius);
  const Mask<N> across = d.z != 0.0f;
  const N inverse = 1.0f / select(across, d.z, N{} + 1.0f);
  const N a = (-half - o.z) * inverse, b = (half - o.z) * inverse;
  const N enter = select(across, max(pipe.enter, min(a, b)), pipe.enter);
  const N leave = select(across, min(pipe.leave, max(a, b)), pipe.leave);
  const Mask<N> between = across | (abs(o.z) <= half);
  return {pipe.inside & between & (enter <= leave) & (enter > 0.0f), enter};
}

template <typename N, typename Number>
inline Meeting<N> meet_capsule(const Three<N>& o, const Three<N>& d, Number radius, Number half) {
  const Pipe<N> pipe = meet_pipe(o, d, radius);
  const N z = o.z + pipe.enter * d.z;
  const Mask<N> side = pipe.inside & (abs(z) <= half) & (pipe.enter > 0.0f);
  // Who comes into the pipe beyond an end may meet the cap there, and nothing else.
  const N end = select(z < 0.0f, N{} - half, N{} + half);
  const Meeting<N> cap = meet_ball(Three<N>{o.x, o.y, o.z - end}, d, radius * radius);
  const N reached = o.z + cap.depth * d.z;
  const Mask<N> take = ~side & cap.hit & (abs(reached) >= half) & ((reached < 0.0f) == (end < 0.0f));
  const N depth = select(take, cap.depth, pipe.enter);
  Mask<N> hit = side | take;
  // From inside the capsule no cap's outer half is met from outside, but its inner side may be.
  const N past = max(abs(o.z) - half, N{});
  hit &= o.x * o.x + o.y * o.y + past * past > radius * radius;
  return {hit, depth};
}

template <Kind kind, typename N, typename Number>
inline Meeting<N> meet(const Number* size, const Three<N>& o, const Three<N>& d) {
  if constexpr (kind == Kind::kPlane) return meet_plane(o, d, size);
  if constexpr (kind == Kind::kBox) return meet_box(o, d, size);
  if constexpr (kind == Kind::kSphere) return meet_ball(o, d, size[0] * size[0]);
  if constexpr (kind == Kind::kCylinder) return meet_cylinder(o, d, size[0], size[1]);
  if constexpr (kind == Kind::kCapsule) return meet_capsule(o, d, size[0], size[1]);
  if constexpr (kind == Kind::kEllipsoid) return meet_ellipsoid(o, d, size);
}

// The outward normal, not of unit length, at a point of the surface.
template <Kind kind>
inline F3 normal_at(const Solid& solid, const F3& p) {
  const float* size = solid.size;
  if constexpr (kind == Kind::kPlane) return {F{}, F{}, splat(1.0f)};
  if constexpr (kind == Kind::kBox) {  // of the face that the point is closest to, in half lengths
    const F x = abs(p.x) / size[0], y = abs(p.y) / size[1], z = abs(p.z) / size[2];
    const I is_x = (x >= y) & (x >= z), is_y = ~is_x & (y >= z), is_z = ~is_x & ~is_y;
    const F one = splat(1.0f), sx = select(p.x < 0.0f, -one, one), sy = select(p.y < 0.0f, -one, one);
    return {select(is_x, sx, F{}), select(is_y, sy, F{}), select(is_z, select(p.z < 0.0f, -one, one), F{})};
  }
  if constexpr (kind == Kind::kSphere) return p;
  if constexpr (kind == Kind::kCylinder) {
    const I cap = (abs(p.z) - size[1]) * size[0] >= (p.x * p.x + p.y * p.y - size[0] * size[0]) * 0.5f;
    const F z = select(p.z < 0.0f, splat(-1.0f), splat(1.0f));
    return {select(cap, F{}, p.x), select(cap, F{}, p.y), select(cap, z, F{})};
  }
  if constexpr (kind == Kind::kCapsule) {
    const F along = max(splat(-size[1]), min(splat(size[1]), p.z));
    return {p.x, p.y, p.z - along};
  }
  if constexpr (kind == Kind::kEllipsoid)
    return {p.x / (size[0] * size[0]), p.y / (size[1] * size[1]), p.z / (size[2] * size[2])};
}

}  // namespace trundle::TRUNDLE_ISA
