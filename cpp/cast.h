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

// A narrow fan of rays from one point: along one axis, all of them go the same way, and each metre brings them to
// somewhere between `low` and `high` along the two others. Rays that are not awake do not count.
struct Fan {
  int along, across[2];
  float sign, low[2], high[2], fastest;
  bool narrow = true;

  Fan(const F3& d, I awake) {
    const int first = __builtin_ctz(bits(awake));
    const F ways[3] = {d.x, d.y, d.z};
    const float x = d.x[first], y = d.y[first], z = d.z[first];
    const float ax = x < 0 ? -x : x, ay = y < 0 ? -y : y, az = z < 0 ? -z : z;
    along = ax >= ay && ax >= az ? 0 : ay >= az ? 1 : 2;
    across[0] = (along + 1) % 3, across[1] = (along + 2) % 3;
    sign = ways[along][first] < 0.0f ? -1.0f : 1.0f;
    const F way = select(awake, ways[along], splat(ways[along][first])) * sign;
    fastest = largest(way);
    if (!(least(way) > 0.0f)) narrow = false;
    const F inverse = 1.0f / select(way > 0.0f, way, splat(1.0f));
    for (int i = 0; i < 2; ++i) {
      const F slope = select(awake, ways[across[i]], splat(ways[across[i]][first])) * inverse;
      low[i] = least(slope) - 1e-6f, high[i] = largest(slope) + 1e-6f;  // what single precision may lose
      if (!(high[i] - low[i] < 0.5f)) narrow = false;
    }
  }
};

typedef float F4 __attribute__((vector_size(16)));  // x, y, z, and one that does not count

inline F4 load4(const float* at) {
  F4 value;
  __builtin_memcpy(&value, at, sizeof value);
  return value;
}

// Möller and Trumbore's test on both sides of a triangle, with what is the same for all rays from one point taken out of
// it: a ray is inside where it is on the inner side of three planes through that point. Returns 1 / distance where
// that is more than what is there already.
inline F meet_face(const BvhFace& face, const float* eye, const F3& d, F than) {
  const F4 n = load4(face.normal);
  const F4 away = load4(face.corner) - load4(eye), y = load4(eye + 1) - load4(face.corner + 1),
           z = load4(eye + 2) - load4(face.corner + 2);
  const F4 left = y * load4(face.edges[1] + 2) - z * load4(face.edges[1] + 1);
  const F4 right = z * load4(face.edges[0] + 1) - y * load4(face.edges[0] + 2);
  const F4 lifts = away * n;
  const float lift = lifts[0] + lifts[1] + lifts[2], sign = lift < 0.0f ? -1.0f : 1.0f;
  const F4 more = n * 1e-6f;  // a little more than the triangle: rays find no gap between two
  const F4 ways[4] = {n * (1.0f / lift), (more + left) * sign, (more + right) * sign, (more + (n - left - right)) * sign};
  const auto along = [&](int i) { return d.x * ways[i][0] + d.y * ways[i][1] + d.z * ways[i][2]; };
  const F here = along(0);
  const I hit = (min(min(along(1), along(2)), along(3)) >= 0.0f) & (here > than);
  return select(hit, here, than);
}

// What is yet to be looked at: how far along the fan's axis a node's box begins, and the node.
struct Waiting {
  float from;
  int32_t node;
};

inline void cast_fan(const Solid& solid, const Fan& fan, const F3& d, I awake, Found& found) {
  const float eye[6] = {solid.eye[0], solid.eye[1], solid.eye[2], solid.eye[0], solid.eye[1], solid.eye[2]};
  const float o = eye[fan.along];
  const F at_first = 1.0f / found.range;
  F nearness = at_first;
  const auto furthest_of = [&] { return fan.fastest * 1.00001f / least(select(awake, nearness, splat(3e38f))); };
  Waiting waiting[kMostWaiting];
  int count = 1;
  waiting[0] = {0.0f, 0};
  float furthest = furthest_of();
  while (count > 0) {
    const Waiting next = waiting[--count];
    if (next.from > furthest) continue;
    const BvhNode& node = solid.bvh.nodes[next.node];
    const float *near = fan.sign > 0.0f ? node.low[fan.along] : node.high[fan.along],
                *far = fan.sign > 0.0f ? node.high[fan.along] : node.low[fan.along];
    const int least_count = count;
    bool found_some = false;
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
        const int32_t first = node.first[step + lane], faces = node.count[step + lane];
        if (faces > 0) {
          for (int32_t i = first; i < first + faces; ++i) nearness = meet_face(solid.bvh.faces[i], eye, d, nearness);
          found_some = true;
          continue;
        }
        const Waiting one = {k0[lane], first};
        int at = count++;
        for (; at > least_count && waiting[at - 1].from < one.from; --at) waiting[at] = waiting[at - 1];
        waiting[at] = one;
      }
    }
    if (found_some) furthest = furthest_of();
  }
  take(found, nearness > at_first, 1.0f / nearness, solid.index);
}

// Rays that go apart, one by one. Lanes that are not `awake` cannot meet it.
inline void cast_mesh(const Solid& solid, const F3& d, I awake, Found& found) {
  const Fan fan(d, awake);
  if (fan.narrow) return cast_fan(solid, fan, d, awake, found);
  const F lanes = counting();
  for (uint32_t left = bits(awake); left; left &= left - 1) {
    const int i = __builtin_ctz(left);
    const F3 one = {splat(d.x[i]), splat(d.y[i]), splat(d.z[i])};
    Found alone = {splat(found.range[i]), splat(found.shape[i])};
    const I here = lanes == (float)i;
    const Fan thin(one, here);
    if (thin.narrow) cast_fan(solid, thin, one, here, alone);
    found = {select(here, alone.range, found.range), select(here, alone.shape, found.shape)};
  }
}

template <Kind kind>
inline void cast_solid(const Solid& solid, const F3& o, const F3& d, Found& found) {
  const Meeting met = meet<kind>(solid, o, d);
  take(found, met.hit, met.depth, solid.index);
}

inline void cast_at(const Solid& solid, const F3& d, I awake, Found& found) {
  const F3 o = splat(solid.eye);
  switch (solid.kind) {
    case Kind::kPlane: return cast_solid<Kind::kPlane>(solid, o, d, found);
    case Kind::kBox: return cast_solid<Kind::kBox>(solid, o, d, found);
    case Kind::kSphere: return cast_solid<Kind::kSphere>(solid, o, d, found);
    case Kind::kCylinder: return cast_solid<Kind::kCylinder>(solid, o, d, found);
    case Kind::kCapsule: return cast_solid<Kind::kCapsule>(solid, o, d, found);
    case Kind::kEllipsoid: return cast_solid<Kind::kEllipsoid>(solid, o, d, found);
    case Kind::kMesh: return cast_mesh(solid, d, awake, found);
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
      I awake = splat((int32_t)-1);
      if (solid.radius >= 0.0f) {  // those rays that come near enough to its middle, before they meet something
        const F along = max(d.x * solid.middle[0] + d.y * solid.middle[1] + d.z * solid.middle[2], F{});
        const F within = along * along - solid.reach;
        awake = (within >= 0.0f) & (along - solid.radius <= found.range);
        if (!any(awake)) continue;
        if (solid.kind == Kind::kMesh) {
          awake &= along - sqrt(max(within, F{})) <= found.range;
          if (!any(awake)) continue;
        }
      }
      cast_at(solid, turn(solid.axes, d), awake, found);
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
