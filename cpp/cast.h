// Rays against shapes: those of a block share what they cannot meet, all from one point.
#pragma once

#include "intersect.h"
#include "kernel.h"
#include "lanes.h"
#include "walk.h"

namespace trundle::TRUNDLE_ISA {

constexpr int kBlock = 64 / kLanes;  // groups of rays that shapes are sorted out for together

// What a group of rays has met so far.
struct Found {
  F range;
  I shape;
};

// Of two at one place the first shape is met, in whatever order they are looked at.
inline void take(Found& found, I hit, F range, int32_t shape) {
  const I nearer = hit & ((range < found.range) | ((range == found.range) & (found.shape > shape)));
  found.range = select(nearer, range, found.range);
  found.shape = select(nearer, splat(shape), found.shape);
}

struct Block {
  int groups;
  F3 d[kBlock];
  Found found[kBlock];
  F entry[kBlock];  // how far it is to the first ball around a mesh
};

// The cone that the rays of a block keep to.
struct Cone {
  float axis[3], cosine, sine;
  bool narrow;

  explicit Cone(const Block& rays) {
    F3 sum = {F{}, F{}, F{}};
    for (int i = 0; i < rays.groups; ++i) sum = sum + rays.d[i];
    const float x = total(sum.x), y = total(sum.y), z = total(sum.z), length = __builtin_sqrtf(x * x + y * y + z * z);
    axis[0] = x / length, axis[1] = y / length, axis[2] = z / length;
    F least_of_all = splat(1.0f);
    for (int i = 0; i < rays.groups; ++i) least_of_all = min(dot(rays.d[i], splat(axis)), least_of_all);
    cosine = least(least_of_all) - 1e-6f;  // what single precision may lose
    narrow = cosine > 0.1f;
    sine = __builtin_sqrtf(1.0f - cosine * cosine);
  }

  // Whether a ball is out of it for sure: its middle is farther from the line along the cone's side than its radius.
  bool misses(const Solid& solid) const {
    if (!narrow || solid.radius < 0.0f) return false;
    const float* m = solid.middle;
    const float along = axis[0] * m[0] + axis[1] * m[1] + axis[2] * m[2], away = m[0] * m[0] + m[1] * m[1] + m[2] * m[2];
    const float needed = along * sine + solid.radius, across = away * 0.999999f - along * along;
    return needed < 0.0f || across * cosine * cosine > needed * needed;
  }
};

// Those of a group's rays that come near enough to a shape's middle, and where.
struct Near {
  I reached;
  F along, within;

  Near(const Solid& solid, const F3& d)
      : along(max(d.x * solid.middle[0] + d.y * solid.middle[1] + d.z * solid.middle[2], F{})),
        within(along * along - solid.reach) {
    reached = within >= 0.0f;
  }
  F entry() const { return along - sqrt(max(within, F{})); }  // into the ball around it
};

template <Kind kind>
inline void cast_solid(const Solid& solid, Block& rays) {
  const F3 o = splat(solid.eye);
  for (int i = 0; i < rays.groups; ++i) {
    Found& found = rays.found[i];
    if (kind == Kind::kPlane) {
      const F3& d = rays.d[i];
      if (!any(d.x * solid.axes[6] + d.y * solid.axes[7] + d.z * solid.axes[8] < 0.0f)) continue;
    }
    if (solid.radius >= 0.0f) {
      const Near near(solid, rays.d[i]);
      if (!any(near.reached & (near.along - solid.radius <= found.range))) continue;
    }
    const Meeting met = meet<kind>(solid, o, turn(solid.axes, rays.d[i]));
    take(found, met.hit, met.depth, solid.index);
  }
}

// Of each ray the mesh whose ball it comes to first, then all others that are not behind what that has shown.
enum class Turn { kFirst, kOthers };

inline void cast_mesh(const Solid& solid, Turn when, Block& rays) {
  for (int first = 0; first < rays.groups; first += kGroups) {
    Bundle bundle;
    I awake = I{};
    for (int i = 0; i < kGroups; ++i) {
      const int group = first + i;
      bundle.awake[i] = I{}, bundle.d[i] = rays.d[first], bundle.nearness[i] = F{};
      if (group >= rays.groups) continue;
      const Near near(solid, rays.d[group]);
      if (!any(near.reached)) continue;
      const F entry = near.entry();
      const I is_first = entry <= rays.entry[group];
      bundle.awake[i] = near.reached & (entry <= rays.found[group].range) & (when == Turn::kFirst ? is_first : ~is_first);
      bundle.d[i] = rays.d[group], bundle.nearness[i] = rays.found[group].range;
      awake |= bundle.awake[i];
    }
    if (!any(awake)) continue;
    for (int i = 0; i < kGroups; ++i) {
      bundle.d[i] = turn(solid.axes, bundle.d[i]);
      bundle.nearness[i] = 0.999999f / bundle.nearness[i];  // what is at the same place counts
    }
    F before[kGroups];
    for (int i = 0; i < kGroups; ++i) before[i] = bundle.nearness[i];
    meet_mesh(solid, bundle);
    for (int i = 0; i < kGroups && first + i < rays.groups; ++i)
      take(rays.found[first + i], bundle.nearness[i] > before[i], 1.0f / bundle.nearness[i], solid.index);
  }
}

inline void cast_at(const Solid& solid, Block& rays) {
  switch (solid.kind) {
    case Kind::kPlane: return cast_solid<Kind::kPlane>(solid, rays);
    case Kind::kBox: return cast_solid<Kind::kBox>(solid, rays);
    case Kind::kSphere: return cast_solid<Kind::kSphere>(solid, rays);
    case Kind::kCylinder: return cast_solid<Kind::kCylinder>(solid, rays);
    case Kind::kCapsule: return cast_solid<Kind::kCapsule>(solid, rays);
    case Kind::kEllipsoid: return cast_solid<Kind::kEllipsoid>(solid, rays);
    case Kind::kMesh:  // what hides them is looked for first
      for (int i = 0; i < rays.groups; ++i) {
        const Near near(solid, rays.d[i]);
        rays.entry[i] = min(select(near.reached, near.entry(), splat(3e38f)), rays.entry[i]);
      }
  }
}

// Directions (count, 3), of unit length, in the frame of the place that all rays start from.
inline void cast(const Solid* solids, int32_t solid_count, const float* directions, int64_t count, float reach,
                 float* ranges, int32_t* shapes) {
  for (int64_t first = 0; first < count; first += kBlock * kLanes) {
    Block rays;
    rays.groups = 0;
    for (int64_t at = first; at < count && rays.groups < kBlock; at += kLanes) {
      const I row = min_of(counting_whole(), count - at < kLanes ? (int)(count - at) - 1 : kLanes - 1) * 3;
      const float* from = directions + 3 * at;
      rays.d[rays.groups] = {gather(from, row), gather(from + 1, row), gather(from + 2, row)};
      rays.entry[rays.groups] = splat(3e38f);
      rays.found[rays.groups++] = {splat(reach), splat((int32_t)-1)};
    }
    const Cone cone(rays);
    for (int32_t i = 0; i < solid_count; ++i)
      if (!cone.misses(solids[i])) cast_at(solids[i], rays);
    const Turn turns[2] = {Turn::kFirst, Turn::kOthers};
    for (const Turn turn : turns)
      for (int32_t i = 0; i < solid_count; ++i)
        if (solids[i].kind == Kind::kMesh && !cone.misses(solids[i])) cast_mesh(solids[i], turn, rays);
    for (int group = 0; group < rays.groups; ++group) {
      const Found& found = rays.found[group];
      const F range = select(found.shape < 0, splat(__builtin_inff()), found.range);
      const int64_t at = first + group * kLanes;
      if (count - at >= kLanes) {
        store(ranges + at, range), store(shapes + at, found.shape);
      } else {
        for (int i = 0; i < (int)(count - at); ++i) ranges[at + i] = range[i], shapes[at + i] = found.shape[i];
      }
    }
  }
}

}  // namespace trundle::TRUNDLE_ISA
