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

inline bool take(Found& found, I hit, F range, int32_t shape) {
  const I nearer = hit & (range < found.range);
  if (!any(nearer)) return false;
  found.range = select(nearer, range, found.range);
  found.shape = select(nearer, splat(shape), found.shape);
  return true;
}

// Möller and Trumbore's test, on both sides of the triangle.
inline bool cast_triangle(const float* t, const F3& o, const F3& d, int32_t shape, Found& found) {
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
  return take(found, hit, range, shape);
}

// A narrow fan of rays from one point: along one axis, all of them go the same way, and each metre brings them to
// somewhere between `low` and `high` along the two others.
struct Fan {
  int along, across[2];
  float sign, low[2], high[2], fastest;
  bool narrow = true;

  explicit Fan(const F3& d) {
    const F ways[3] = {d.x, d.y, d.z};
    const float x = d.x[0] < 0 ? -d.x[0] : d.x[0], y = d.y[0] < 0 ? -d.y[0] : d.y[0], z = d.z[0] < 0 ? -d.z[0] : d.z[0];
    along = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    across[0] = (along + 1) % 3, across[1] = (along + 2) % 3;
    sign = ways[along][0] < 0.0f ? -1.0f : 1.0f;
    const F way = ways[along] * sign;
    fastest = largest(way);
    if (!(least(way) > 0.0f)) narrow = false;
    const F inverse = 1.0f / select(way > 0.0f, way, splat(1.0f));
    for (int i = 0; i < 2; ++i) {
      const F slope = ways[across[i]] * inverse;
      low[i] = least(slope) - 1e-6f, high[i] = largest(slope) + 1e-6f;  // what single precision may lose
      if (!(high[i] - low[i] < 0.5f)) narrow = false;
    }
  }
};

// What is yet to be looked at: how far along the fan's axis it begins, and what it is, as in BvhNode.
struct Waiting {
  float from;
  int32_t first, count;
};

// Puts off those boxes of a node that a fan meets, the nearest last.
inline int put_off(const BvhNode& node, const Fan& fan, const float* eye, float furthest, Waiting* waiting, int count) {
  const int least_count = count;
  const float o = eye[fan.along], *near = fan.sign > 0.0f ? node.low[fan.along] : node.high[fan.along],
              *far = fan.sign > 0.0f ? node.high[fan.along] : node.low[fan.along];
  for (int step = 0; step < kWidest; step += kLanes) {
    const F k0 = max((load(near + step) - o) * fan.sign, F{}), k1 = (load(far + step) - o) * fan.sign;
    I met = (k1 >= 0.0f) & (k0 <= furthest);
    for (int i = 0; i < 2; ++i) {
      const int axis = fan.across[i];
      const F low = load(node.low[axis] + step) - eye[axis], high = load(node.high[axis] + step) - eye[axis];
      met &= (low <= max(k0 * fan.high[i], k1 * fan.high[i])) & (high >= min(k0 * fan.low[i], k1 * fan.low[i]));
    }
    for (uint32_t left = bits(met); left; left &= left - 1) {
      const int lane = __builtin_ctz(left);
      const Waiting one = {k0[lane], node.first[step + lane], node.count[step + lane]};
      int at = count++;
      for (; at > least_count && waiting[at - 1].from < one.from; --at) waiting[at] = waiting[at - 1];
      waiting[at] = one;
    }
  }
  return count;
}

inline void cast_fan(const Solid& solid, const Fan& fan, const F3& d, Found& found) {
  const F3 o = splat(solid.eye);
  Waiting waiting[kMostWaiting];
  int count = 0;
  float furthest = largest(found.range) * fan.fastest * 1.00001f;
  count = put_off(solid.bvh.nodes[0], fan, solid.eye, furthest, waiting, count);
  while (count > 0) {
    const Waiting next = waiting[--count];
    if (next.from > furthest) continue;
    if (next.count == 0) {
      count = put_off(solid.bvh.nodes[next.first], fan, solid.eye, furthest, waiting, count);
      continue;
    }
    bool nearer = false;
    for (int32_t i = next.first; i < next.first + next.count; ++i)
      nearer |= cast_triangle(solid.bvh.corners + 9 * (int64_t)i, o, d, solid.index, found);
    if (nearer) furthest = largest(found.range) * fan.fastest * 1.00001f;
  }
}

// Rays that go apart, one by one.
inline void cast_mesh(const Solid& solid, const F3& d, Found& found) {
  const Fan fan(d);
  if (fan.narrow) return cast_fan(solid, fan, d, found);
  const F lanes = counting();
  for (int i = 0; i < kLanes; ++i) {
    const F3 one = {splat(d.x[i]), splat(d.y[i]), splat(d.z[i])};
    Found alone = {splat(found.range[i]), splat(found.shape[i])};
    const Fan thin(one);
    if (thin.narrow) cast_fan(solid, thin, one, alone);
    const I here = lanes == (float)i;
    found = {select(here, alone.range, found.range), select(here, alone.shape, found.shape)};
  }
}

template <Kind kind>
inline void cast_solid(const Solid& solid, const F3& o, const F3& d, Found& found) {
  const Meeting met = meet<kind>(solid, o, d);
  take(found, met.hit, met.depth, solid.index);
}

inline void cast_at(const Solid& solid, const F3& d, Found& found) {
  const F3 o = splat(solid.eye);
  switch (solid.kind) {
    case Kind::kPlane: return cast_solid<Kind::kPlane>(solid, o, d, found);
    case Kind::kBox: return cast_solid<Kind::kBox>(solid, o, d, found);
    case Kind::kSphere: return cast_solid<Kind::kSphere>(solid, o, d, found);
    case Kind::kCylinder: return cast_solid<Kind::kCylinder>(solid, o, d, found);
    case Kind::kCapsule: return cast_solid<Kind::kCapsule>(solid, o, d, found);
    case Kind::kEllipsoid: return cast_solid<Kind::kEllipsoid>(solid, o, d, found);
    case Kind::kMesh: return cast_mesh(solid, d, found);
  }
}

// Directions (count, 3), of unit length, in the frame of the place that all rays start from.
inline void cast(const Solid* solids, int32_t solid_count, const float* directions, int64_t count, float reach,
                 float* ranges, int32_t* shapes) {
  for (int64_t at = 0; at < count; at += kLanes) {
    const int many = count - at < kLanes ? (int)(count - at) : kLanes;
    const I row = min_of(counting_whole(), many - 1) * 3;
    const float* from = directions + 3 * at;
    const F3 d = {gather(from, row), gather(from + 1, row), gather(from + 2, row)};
    Found found = {splat(reach), splat((int32_t)-1)};
    for (int32_t i = 0; i < solid_count; ++i) {
      const Solid& solid = solids[i];
      if (solid.radius >= 0.0f) {  // does any ray come near enough to its middle?
        const F along = max(d.x * solid.middle[0] + d.y * solid.middle[1] + d.z * solid.middle[2], F{});
        if (!any((along * along >= solid.reach) & (along - solid.radius <= found.range))) continue;
      }
      cast_at(solid, turn(solid.axes, d), found);
    }
    found.range = select(found.shape < 0, splat(__builtin_inff()), found.range);
    if (many == kLanes) {
      store(ranges + at, found.range), store(shapes + at, found.shape);
    } else {
      for (int i = 0; i < many; ++i) ranges[at + i] = found.range[i], shapes[at + i] = found.shape[i];
    }
  }
}

}  // namespace trundle::TRUNDLE_ISA
