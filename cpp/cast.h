// Rays against shapes: those of a block share what they cannot meet, all from one point.
#pragma once

#include "intersect.h"
#include "kernel.h"
#include "lanes.h"
#include "walk.h"

namespace trundle::TRUNDLE_ISA {

constexpr int kBlock = 64;    // rays that shapes are sorted out for together
constexpr int kTogether = 4;  // shapes of which none waits for what the others before it have shown

struct Block {
  int count;  // in whole groups of kLanes: the last ray fills the last one
  alignas(64) double ways[3][kBlock], ranges[kBlock];
  alignas(64) double shapes[kBlock];  // whole numbers
  alignas(64) float narrow[3][kBlock], far[kBlock];  // the same ways and ranges, to sort out by
  alignas(64) float entry[kBlock];                   // how far it is to the first ball around a mesh

  Block(const double* directions, int64_t count, double reach) {
    const int rays = count < kBlock ? (int)count : kBlock;
    this->count = (rays + kLanes - 1) / kLanes * kLanes;
    for (int i = 0; i < rays; ++i)
      for (int axis = 0; axis < 3; ++axis) ways[axis][i] = directions[3 * i + axis];
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = rays; i < this->count; ++i) ways[axis][i] = ways[axis][rays - 1];
      for (int i = 0; i < this->count; ++i) narrow[axis][i] = (float)ways[axis][i];
    }
    for (int i = 0; i < kBlock; ++i) ranges[i] = reach, far[i] = (float)reach, shapes[i] = -1, entry[i] = 3e38f;
  }
  F3 narrow_at(int i) const { return {load(narrow[0] + i), load(narrow[1] + i), load(narrow[2] + i)}; }
  D3 at(int i) const { return {load(ways[0] + i), load(ways[1] + i), load(ways[2] + i)}; }
};

// The cone that the rays of a block keep to.
struct Cone {
  float axis[3], cosine, sine;
  bool narrow;

  explicit Cone(const Block& rays) {
    float square = 0.0f;
    for (int i = 0; i < 3; ++i) {
      const float* way = rays.narrow[i];
      axis[i] = way[0] + way[rays.count / 2] + way[rays.count - 1];
      square += axis[i] * axis[i];
    }
    F least_of_all = splat(3e38f);
    for (int i = 0; i < rays.count; i += kLanes) least_of_all = min(dot(rays.narrow_at(i), splat(axis)), least_of_all);
    const float inverse = 1.0f / __builtin_sqrtf(square);
    for (float& number : axis) number *= inverse;
    cosine = least(least_of_all) * inverse - 1e-6f;  // what single precision may lose
    narrow = cosine > 0.1f;
    sine = __builtin_sqrtf(1.0f - cosine * cosine);
  }

  // What is out of it for sure. A ball whose middle is farther from the line along the cone's side than its radius; a
  // pipe that no ray comes so near to.
  I misses(const Around& around, int at) const {
    const auto three = [at](const auto& rows) { return F3{load(rows[0] + at), load(rows[1] + at), load(rows[2] + at)}; };
    const F3 middle = three(around.middle);
    const F radius = load(around.radius + at), along = dot(middle, splat(axis)), away = dot(middle, middle);
    const F needed = along * sine + radius, across = away * 0.999999f - along * along;
    const F aside = max(abs(dot(three(around.aside), splat(axis))) * cosine - sine * load(around.aside_length + at), F{});
    return (radius >= 0.0f) & ((needed < 0.0f) | (across * (cosine * cosine) > needed * needed) |
                               (aside * aside > load(around.thickness + at)));
  }

  // Writes the numbers of those that are not; returns how many they are.
  int32_t find(const Around* around, int32_t count, int32_t* near) const {
    int32_t found = 0;
    for (int32_t first = 0; first < count; first += kLanes) {
      const I here = splat(first) + counting_whole() < count;
      const I out = narrow ? misses(around[first / kWidest], first % kWidest) : I{};
      for (uint32_t left = bits(here & ~out); left; left &= left - 1) near[found++] = first + __builtin_ctz(left);
    }
    return found;
  }
};

// Those of a group's rays that come near enough to a shape's middle, and where.
struct Near {
  I reached;
  F along, within;

  Near(const Target& target, const F3& d)
      : along(max(d.x * target.middle[0] + d.y * target.middle[1] + d.z * target.middle[2], F{})),
        within(along * along - target.reach) {
    reached = within >= 0.0f;
    along *= 0.999999f;  // what single precision may lose
  }
  F entry() const { return along - sqrt(max(within, F{})); }  // into the ball around it, or a little before
};

// Those of a group's rays that may meet a shape before what they have met.
inline I may_meet(const Target& target, const F3& d, F far) {
  if (target.kind == Kind::kPlane) {
    const F down = -(d.x * target.narrow_axes[6] + d.y * target.narrow_axes[7] + d.z * target.narrow_axes[8]);
    return (down + 1e-6f) * far >= target.narrow_eye[2] * 0.999999f;
  }
  const Near near(target, d);
  const F aside = dot(d, splat(target.aside));
  return near.reached & (near.along - target.radius <= far) & (aside * aside <= target.thickness);
}

// Where in a block there are rays that may meet a shape, as many side by side as are met with it together.
struct Places {
  int count, at[kBlock / kHalf];

  void find(const Target& target, const Block& rays) {
    count = 0;
    if (target.kind == Kind::kMesh) return;
    for (int first = 0; first < rays.count; first += kLanes) {
      const uint32_t some = bits(may_meet(target, rays.narrow_at(first), load(rays.far + first)));
      // Without a branch for each: nobody could foretell it.
      at[count] = first, count += (some & ((1u << kHalf) - 1)) != 0;
      at[count] = first + kHalf, count += some >> kHalf != 0;
    }
  }
};

template <Kind kind>
inline void cast_solid(const Target& target, const Places& places, Block& rays) {
  const D3 o = splat(target.eye);
  for (int i = 0; i < places.count; ++i) {
    const int at = places.at[i];
    const D3 d = rays.at(at);
    const Meeting<D> met = meet<kind>(target.size, o, kind == Kind::kSphere ? d : turn(target.axes, d));
    const D range = load(rays.ranges + at), shape = load(rays.shapes + at), index = splat((double)target.index);
    // Of two at one place the first shape is met, in whatever order they are looked at.
    const L nearer = met.hit & ((met.depth < range) | ((met.depth == range) & (shape > index)));
    store(rays.ranges + at, select(nearer, met.depth, range));
    store(rays.shapes + at, select(nearer, index, shape));
    for (int k = at; k < at + kHalf; ++k) rays.far[k] = (float)rays.ranges[k];
  }
}

// How far it is to the plane of a triangle along a direction in the mesh's frame.
inline double range_to(const Target& target, int32_t triangle, double x, double y, double z) {
  const BvhLeaf& leaf = target.bvh.leaves[triangle / kLeaf];
  const int i = triangle % kLeaf;
  const double normal[3] = {leaf.normal[0][i], leaf.normal[1][i], leaf.normal[2][i]};
  double away = 0.0;
  for (int axis = 0; axis < 3; ++axis) away += normal[axis] * (leaf.corner[axis][i] - target.eye[axis]);
  return away / (normal[0] * x + normal[1] * y + normal[2] * z);
}

// Of each ray the mesh whose ball it comes to first, then all others that are not behind what that has shown.
enum class Turn { kFirst, kOthers };

inline void cast_mesh(const Target& target, Turn when, Block& rays) {
  for (int first = 0; first < rays.count; first += kGroups * kLanes) {
    Bundle bundle;
    I awake = I{};
    for (int i = 0; i < kGroups; ++i) {
      const int at = first + i * kLanes;
      bundle.awake[i] = I{}, bundle.d[i] = rays.narrow_at(first), bundle.nearness[i] = F{};
      bundle.met[i] = splat((int32_t)-1);
      if (at >= rays.count) continue;
      const Near near(target, rays.narrow_at(at));
      if (!any(near.reached)) continue;
      const F entry = near.entry(), far = load(rays.far + at);
      const I is_first = entry <= load(rays.entry + at);
      bundle.awake[i] = near.reached & (entry <= far) & (when == Turn::kFirst ? is_first : ~is_first);
      bundle.d[i] = rays.narrow_at(at), bundle.nearness[i] = far;
      awake |= bundle.awake[i];
    }
    if (!any(awake)) continue;
    for (int i = 0; i < kGroups; ++i) {
      bundle.d[i] = turn(target.narrow_axes, bundle.d[i]);
      bundle.nearness[i] = 0.99999f / bundle.nearness[i];  // what is at the same place counts
    }
    meet_mesh(target, bundle);
    for (int i = 0; i < kGroups; ++i) {
      uint32_t left = bits(bundle.met[i] >= 0);
      if (!left) continue;
      const int at = first + i * kLanes;
      const D3 ways[2] = {turn(target.axes, rays.at(at)), turn(target.axes, rays.at(at + kHalf))};
      for (; left; left &= left - 1) {
        const int lane = __builtin_ctz(left), k = lane % kHalf;
        const D3& d = ways[lane / kHalf];
        const double range = range_to(target, bundle.met[i][lane], d.x[k], d.y[k], d.z[k]), before = rays.ranges[at + lane];
        if (!(range > 0.0 && (range < before || (range == before && rays.shapes[at + lane] > target.index)))) continue;
        rays.ranges[at + lane] = range, rays.far[at + lane] = (float)range, rays.shapes[at + lane] = target.index;
      }
    }
  }
}

inline void cast_at(const Target& target, const Places& places, Block& rays) {
  switch (target.kind) {
    case Kind::kPlane: return cast_solid<Kind::kPlane>(target, places, rays);
    case Kind::kBox: return cast_solid<Kind::kBox>(target, places, rays);
    case Kind::kSphere: return cast_solid<Kind::kSphere>(target, places, rays);
    case Kind::kCylinder: return cast_solid<Kind::kCylinder>(target, places, rays);
    case Kind::kCapsule: return cast_solid<Kind::kCapsule>(target, places, rays);
    case Kind::kEllipsoid: return cast_solid<Kind::kEllipsoid>(target, places, rays);
    case Kind::kMesh:  // what hides them is looked for first
      for (int i = 0; i < rays.count; i += kLanes) {
        const Near near(target, rays.narrow_at(i));
        store(rays.entry + i, min(select(near.reached, near.entry(), splat(3e38f)), load(rays.entry + i)));
      }
  }
}

// Directions (count, 3), of unit length, in the frame of the place that all rays start from.
inline void cast(const Target* targets, const Around* around, int32_t target_count, int32_t* near,
                 const double* directions, int64_t count, double reach, double* ranges, int32_t* shapes) {
  for (int64_t first = 0; first < count; first += kBlock) {
    Block rays(directions + 3 * first, count - first, reach);
    const int32_t near_count = Cone(rays).find(around, target_count, near);
    bool has_meshes = false;
    for (int32_t i = 0; i < near_count; i += kTogether) {
      Places places[kTogether];
      const int32_t last = near_count - i < kTogether ? near_count - i : kTogether;
      for (int32_t k = 0; k < last; ++k) places[k].find(targets[near[i + k]], rays);
      for (int32_t k = 0; k < last; ++k) {
        const Target& target = targets[near[i + k]];
        cast_at(target, places[k], rays), has_meshes |= target.kind == Kind::kMesh;
      }
    }
    const Turn turns[2] = {Turn::kFirst, Turn::kOthers};
    for (const Turn turn : turns)
      for (int32_t i = 0; has_meshes && i < near_count; ++i)
        if (targets[near[i]].kind == Kind::kMesh) cast_mesh(targets[near[i]], turn, rays);
    const int64_t last = count - first < kBlock ? count - first : kBlock;
    for (int64_t i = 0; i < last; ++i) {
      ranges[first + i] = rays.shapes[i] < 0 ? __builtin_inf() : rays.ranges[i];
      shapes[first + i] = (int32_t)rays.shapes[i];
    }
  }
}

}  // namespace trundle::TRUNDLE_ISA
