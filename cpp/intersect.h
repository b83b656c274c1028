// Where rays meet shapes. Rays start at `o` and run along `d`, both in the shape's frame; d is one metre long along the
// view axis, so that what comes back, the first point's distance in lengths of d, is the depth. Of a shape that the
// ray starts inside, nothing is seen. A miss is a false lane in `hit`.
#pragma once

#include "kernel.h"
#include "lanes.h"

namespace trundle::TRUNDLE_ISA {

struct Meeting {
  I hit;
  F depth;
};

inline Meeting meet_plane(const F3& o, const F3& d, const float* half) {
  const F depth = -o.z / d.z;
  I hit = (o.z > 0.0f) & (d.z < 0.0f);
  if (half[0] > 0.0f) hit &= abs(o.x + depth * d.x) <= half[0];
  if (half[1] > 0.0f) hit &= abs(o.y + depth * d.y) <= half[1];
  return {hit, depth};
}

inline Meeting meet_box(const F3& o, const F3& d, const float* half) {
  F enter = splat(-3e38f), leave = splat(3e38f);
  const F os[3] = {o.x, o.y, o.z}, ds[3] = {d.x, d.y, d.z};
  I missed = I{};
  for (int i = 0; i < 3; ++i) {
    const I across = ds[i] != 0.0f;  // a ray along a face meets it never or always
    const F inverse = 1.0f / select(across, ds[i], splat(1.0f));
    const F a = (-half[i] - os[i]) * inverse, b = (half[i] - os[i]) * inverse;
    enter = select(across, max(enter, min(a, b)), enter);
    leave = select(across, min(leave, max(a, b)), leave);
    missed |= ~across & (abs(os[i]) > half[i]);
  }
  return {~missed & (enter <= leave) & (enter > 0.0f), enter};
}

// The ball of radius 1, from the ray's closest point on: exact also from far away.
inline Meeting meet_ball(const F3& o, const F3& d, float squared_radius) {
  const F inverse = 1.0f / dot(d, d);
  const F middle = -dot(o, d) * inverse;
  const F3 nearest = o + d * middle;
  const F inside = squared_radius - dot(nearest, nearest);
  const F depth = middle - sqrt(max(inside, F{}) * inverse);
  return {(inside >= 0.0f) & (depth > 0.0f), depth};
}

inline Meeting meet_ellipsoid(const F3& o, const F3& d, const float* radii) {
  const float x = 1.0f / radii[0], y = 1.0f / radii[1], z = 1.0f / radii[2];
  return meet_ball({o.x * x, o.y * y, o.z * z}, {d.x * x, d.y * y, d.z * z}, 1.0f);
}

// The endless pipe around z: where the ray goes in and how far it is inside.
struct Pipe {
  I inside;
  F enter, leave;
};

inline Pipe meet_pipe(const F3& o, const F3& d, float radius) {
  const F length = d.x * d.x + d.y * d.y;
  const I across = length > 0.0f;
  const F inverse = 1.0f / select(across, length, splat(1.0f));
  const F middle = select(across, -(o.x * d.x + o.y * d.y) * inverse, F{});
  const F x = o.x + d.x * middle, y = o.y + d.y * middle;
  const F inside = radius * radius - (x * x + y * y);
  const F half = select(across, sqrt(max(inside, F{}) * inverse), splat(1e30f));
  return {inside >= 0.0f, middle - half, middle + half};
}

inline Meeting meet_cylinder(const F3& o, const F3& d, float radius, float half) {
  const Pipe pipe = meet_pipe(o, d, radius);
  const I across = d.z != 0.0f;
  const F inverse = 1.0f / select(across, d.z, splat(1.0f));
  const F a = (-half - o.z) * inverse, b = (half - o.z) * inverse;
  const F enter = select(across, max(pipe.enter, min(a, b)), pipe.enter);
  const F leave = select(across, min(pipe.leave, max(a, b)), pipe.leave);
  const I between = across | (abs(o.z) <= half);
  return {pipe.inside & between & (enter <= leave) & (enter > 0.0f), enter};
}

inline Meeting meet_capsule(const F3& o, const F3& d, float radius, float half) {
  const Pipe pipe = meet_pipe(o, d, radius);
  const F z = o.z + pipe.enter * d.z;
  I hit = pipe.inside & (abs(z) <= half) & (pipe.enter > 0.0f);
  F depth = pipe.enter;
  const float ends[2] = {-half, half};
  for (const float end : ends) {
    const Meeting cap = meet_ball({o.x, o.y, o.z - end}, d, radius * radius);
    const F reached = o.z + cap.depth * d.z;
    const I beyond = end < 0.0f ? reached <= end : reached >= end;
    const I take = cap.hit & beyond & (~hit | (cap.depth < depth));
    depth = select(take, cap.depth, depth);
    hit |= take;
  }
  // From inside the capsule no cap's outer half is met from outside, but its inner side may be.
  const F past = max(abs(o.z) - half, F{});
  hit &= o.x * o.x + o.y * o.y + past * past > radius * radius;
  return {hit, depth};
}

template <Kind kind>
inline Meeting meet(const Solid& solid, const F3& o, const F3& d) {
  if constexpr (kind == Kind::kPlane) return meet_plane(o, d, solid.size);
  if constexpr (kind == Kind::kBox) return meet_box(o, d, solid.size);
  if constexpr (kind == Kind::kSphere) return meet_ball(o, d, solid.size[0] * solid.size[0]);
  if constexpr (kind == Kind::kCylinder) return meet_cylinder(o, d, solid.size[0], solid.size[1]);
  if constexpr (kind == Kind::kCapsule) return meet_capsule(o, d, solid.size[0], solid.size[1]);
  if constexpr (kind == Kind::kEllipsoid) return meet_ellipsoid(o, d, solid.size);
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
