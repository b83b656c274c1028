// Rays against shapes: a few neighbouring rays at a time, all from one point.
#pragma once

#include "intersect.h"
#include "kernel.h"
#include "lanes.h"

namespace trundle::TRUNDLE_ISA {

// What a bundle of rays has met so far.
struct Found {
  F range;
  I shape;
};

inline void take(Found& found, I hit, F range, int32_t shape) {
  const I nearer = hit & (range < found.range);
  found.range = select(nearer, range, found.range);
  found.shape = select(nearer, splat(shape), found.shape);
}

// Möller and Trumbore's test, on both sides of the triangle.
inline void cast_triangle(const float* t, const F3& o, const F3& d, int32_t shape, Found& found) {
  const float *e1 = t + 3, *e2 = t + 6;
  const F3 p = {d.y * e2[2] - d.z * e2[1], d.z * e2[0] - d.x * e2[2], d.x * e2[1] - d.y * e2[0]};
  const F volume = e1[0] * p.x + e1[1] * p.y + e1[2] * p.z;
  const F inverse = 1.0f / select(volume != 0.0f, volume, splat(1.0f));
  const F3 s = {o.x - t[0], o.y - t[1], o.z - t[2]};
  const F u = dot(s, p) * inverse;
  const F3 q = {s.y * e1[2] - s.z * e1[1], s.z * e1[0] - s.x * e1[2], s.x * e1[1] - s.y * e1[0]};
  const F v = dot(d, q) * inverse, range = (e2[0] * q.x + e2[1] * q.y + e2[2] * q.z) * inverse;
  // A little more than the triangle: rays find no gap between two.
  const I hit = (volume != 0.0f) & (u >= -1e-6f) & (v >= -1e-6f) & (u + v <= 1.000001f) & (range > 0.0f);
  take(found, hit, range, shape);
}

inline void cast_mesh(const BvhView& bvh, const F3& o, const F3& d, int32_t shape, Found& found) {
  const F tiny = splat(1e-30f);
  const F3 inverse = {1.0f / select(d.x != 0.0f, d.x, tiny), 1.0f / select(d.y != 0.0f, d.y, tiny),
                      1.0f / select(d.z != 0.0f, d.z, tiny)};
  int32_t waiting[kDeepestBvh];
  int count = 0;
  waiting[count++] = 0;
  while (count > 0) {
    const int32_t at = waiting[--count];
    const BvhNode& node = bvh.nodes[at];
    const F x0 = (node.low[0] - o.x) * inverse.x, x1 = (node.high[0] - o.x) * inverse.x;
    const F y0 = (node.low[1] - o.y) * inverse.y, y1 = (node.high[1] - o.y) * inverse.y;
    const F z0 = (node.low[2] - o.z) * inverse.z, z1 = (node.high[2] - o.z) * inverse.z;
    const F enter = max(max(min(x0, x1), min(y0, y1)), max(min(z0, z1), F{}));
    const F leave = min(min(max(x0, x1), max(y0, y1)), min(max(z0, z1), found.range));
    if (!any(enter <= leave * 1.000001f)) continue;
    if (node.count > 0) {
      for (int32_t i = node.first; i < node.first + node.count; ++i)
        cast_triangle(bvh.corners + 9 * (int64_t)i, o, d, shape, found);
    } else {
      waiting[count++] = node.first;  // the first part lies right behind its parent
      waiting[count++] = at + 1;
    }
  }
}

template <Kind kind>
inline void cast_solid(const Solid& solid, const F3& o, const F3& d, Found& found) {
  const Meeting met = meet<kind>(solid, o, d);
  take(found, met.hit, met.depth, solid.index);
}

inline void cast_at(const Solid& solid, const F3& o, const F3& d, Found& found) {
  switch (solid.kind) {
    case Kind::kPlane: return cast_solid<Kind::kPlane>(solid, o, d, found);
    case Kind::kBox: return cast_solid<Kind::kBox>(solid, o, d, found);
    case Kind::kSphere: return cast_solid<Kind::kSphere>(solid, o, d, found);
    case Kind::kCylinder: return cast_solid<Kind::kCylinder>(solid, o, d, found);
    case Kind::kCapsule: return cast_solid<Kind::kCapsule>(solid, o, d, found);
    case Kind::kEllipsoid: return cast_solid<Kind::kEllipsoid>(solid, o, d, found);
    case Kind::kMesh: return cast_mesh(solid.bvh, o, d, solid.index, found);
  }
}

// Directions, of unit length, in the frame of the place that all rays start from: `count`, a multiple of kWidest, of x,
// then of y, then of z.
inline void cast(const Solid* solids, int32_t solid_count, const float* directions, int32_t count, float reach,
                 float* ranges, int32_t* shapes) {
  for (int32_t at = 0; at < count; at += kLanes) {
    const F3 d = {load(directions + at), load(directions + count + at), load(directions + 2 * (int64_t)count + at)};
    Found found = {splat(reach), splat((int32_t)-1)};
    for (int32_t i = 0; i < solid_count; ++i) {
      const Solid& solid = solids[i];
      if (solid.radius >= 0.0f) {  // does any ray come near enough to its middle?
        const F along = max(d.x * solid.middle[0] + d.y * solid.middle[1] + d.z * solid.middle[2], F{});
        if (!any((along * along >= solid.reach) & (along - solid.radius <= found.range))) continue;
      }
      cast_at(solid, splat(solid.eye), turn(solid.axes, d), found);
    }
    store(ranges + at, found.range);
    store(shapes + at, found.shape);
  }
}

}  // namespace trundle::TRUNDLE_ISA
