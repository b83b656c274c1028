// Fans of rays through the tree of a mesh.
#pragma once

#include "kernel.h"
#include "lanes.h"

namespace trundle::TRUNDLE_ISA {

// Rays that walk together: what a box or a triangle costs, they share.
constexpr int kGroups = kLanes < 16 ? 16 / kLanes : 1;

struct Bundle {
  F3 d[kGroups];         // in the mesh's frame
  I awake[kGroups];      // rays that are not do not count
  F nearness[kGroups];   // 1 / how far they have come
  I met[kGroups];        // the triangle that has stopped them: kLeaf times its leaf's number, and its place there; or -1
};

// A narrow fan of rays from one point: along one axis, all of them go the same way, and each metre brings them to
// somewhere between `low` and `high` along x, y and z.
struct Fan {
  int along, across[2];
  float sign, low[3], high[3], fastest;
  bool narrow = true;

  explicit Fan(const Bundle& rays) {
    int group = 0;
    while (!any(rays.awake[group])) ++group;
    const int first = __builtin_ctz(bits(rays.awake[group]));
    const float ray[3] = {rays.d[group].x[first], rays.d[group].y[first], rays.d[group].z[first]};
    const float ax = __builtin_fabsf(ray[0]), ay = __builtin_fabsf(ray[1]), az = __builtin_fabsf(ray[2]);
    along = ax >= ay && ax >= az ? 0 : ay >= az ? 1 : 2;
    across[0] = (along + 1) % 3, across[1] = (along + 2) % 3;
    sign = ray[along] < 0.0f ? -1.0f : 1.0f;
    F slowest = splat(ray[along] * sign), quickest = slowest, lows[2], highs[2];
    for (int i = 0; i < 2; ++i) lows[i] = splat(3e38f), highs[i] = splat(-3e38f);
    for (int i = 0; i < kGroups; ++i) {
      const F ways[3] = {rays.d[i].x, rays.d[i].y, rays.d[i].z};
      const F way = select(rays.awake[i], ways[along], splat(ray[along])) * sign;
      slowest = min(way, slowest), quickest = max(way, quickest);
      const F inverse = 1.0f / select(way > 0.0f, way, splat(1.0f));
      for (int k = 0; k < 2; ++k) {
        const F slope = select(rays.awake[i], ways[across[k]], splat(ray[across[k]])) * inverse;
        lows[k] = min(slope, lows[k]), highs[k] = max(slope, highs[k]);
      }
    }
    fastest = largest(quickest);
    if (!(least(slowest) > 0.0f)) narrow = false;
    for (int k = 0; k < 2; ++k) {  // with what single precision may lose
      const float from = least(lows[k]) - 2e-6f, to = largest(highs[k]) + 2e-6f;
      low[across[k]] = from, high[across[k]] = to;
      if (!(to - from < 0.5f)) narrow = false;
    }
    low[along] = high[along] = sign;
  }
};

typedef float F8 __attribute__((vector_size(32)));  // the triangles of a leaf, side by side
typedef int32_t I8 __attribute__((vector_size(32)));
static_assert(kLeaf == 8);

inline F8 load8(const float* at) {
  F8 value;
  __builtin_memcpy(&value, at, sizeof value);
  return value;
}
#if defined(__AVX2__)
inline F8 max8(F8 a, F8 b) { return (F8)_mm256_max_ps((__m256)a, (__m256)b); }
inline uint32_t bits8(I8 mask) { return (uint32_t)_mm256_movemask_ps((__m256)mask); }
#elif defined(__SSE2__)
inline F8 max8(F8 a, F8 b) {
  const __m128* as = (const __m128*)&a;
  const __m128* bs = (const __m128*)&b;
  const __m128 most[2] = {_mm_max_ps(as[0], bs[0]), _mm_max_ps(as[1], bs[1])};
  return load8((const float*)most);
}
inline uint32_t bits8(I8 mask) {
  const __m128* halves = (const __m128*)&mask;
  return (uint32_t)(_mm_movemask_ps(halves[0]) | _mm_movemask_ps(halves[1]) << 4);
}
#else
inline F8 max8(F8 a, F8 b) { return a > b ? a : b; }
inline uint32_t bits8(I8 mask) {
  uint32_t all = 0;
  for (int i = 0; i < 8; ++i) all |= (uint32_t)(mask[i] & 1) << i;
  return all;
}
#endif

// Möller and Trumbore's test on both sides of triangles, with what is the same for all rays from one point taken out of
// it: a ray is inside where it is on the inner side of three planes through that point. Nearness becomes 1 / distance
// where that is more than what is there already; of triangles that no ray of the fan can meet, or none that has come less
// near than `least_near`, nothing else is looked at.
inline void meet_leaf(const BvhLeaf* leaves, int32_t number, const float* eye, const Fan& fan, float least_near,
                      Bundle& rays) {
  const BvhLeaf& leaf = leaves[number];
  F8 n[3], p[3], more[3], left[3], right[3], ways[4][3];
  for (int i = 0; i < 3; ++i) n[i] = load8(leaf.normal[i]), p[i] = eye[i] - load8(leaf.corner[i]), more[i] = n[i] * 1e-6f;
  const F8 lift = -p[0] * n[0] - p[1] * n[1] - p[2] * n[2], inverse = 1.0f / lift;
  const F8 sign = lift < 0.0f ? F8{} - 1.0f : F8{} + 1.0f;
  for (int i = 0; i < 3; ++i) {
    const int y = (i + 1) % 3, z = (i + 2) % 3;
    left[i] = p[y] * load8(leaf.edges[1][z]) - p[z] * load8(leaf.edges[1][y]);
    right[i] = p[z] * load8(leaf.edges[0][y]) - p[y] * load8(leaf.edges[0][z]);
    ways[0][i] = n[i] * inverse;
    ways[1][i] = (more[i] + left[i]) * sign, ways[2][i] = (more[i] + right[i]) * sign;
    ways[3][i] = (more[i] + (n[i] - left[i] - right[i])) * sign;
  }
  const auto most = [&](const F8* way) {  // of the fan's rays, for each metre along its axis
    F8 sum = max8(way[0] * fan.low[0], way[0] * fan.high[0]);
    for (int i = 1; i < 3; ++i) sum = sum + max8(way[i] * fan.low[i], way[i] * fan.high[i]);
    return sum;
  };
  const I8 met = (most(ways[1]) >= 0.0f) & (most(ways[2]) >= 0.0f) & (most(ways[3]) >= 0.0f) &
                 (most(ways[0]) * (fan.fastest * 1.00001f) > least_near);
  for (uint32_t still = bits8(met); still; still &= still - 1) {
    const int i = __builtin_ctz(still);
    for (int group = 0; group < kGroups; ++group) {
      const F3& d = rays.d[group];
      const F than = rays.nearness[group];
      const auto along = [&](const F8* way) { return d.x * way[0][i] + d.y * way[1][i] + d.z * way[2][i]; };
      const F here = along(ways[0]);
      const I hit = (min(min(along(ways[1]), along(ways[2])), along(ways[3])) >= 0.0f) & (here > than);
      rays.nearness[group] = select(hit, here, than);
      rays.met[group] = select(hit, splat(number * kLeaf + i), rays.met[group]);
    }
  }
}

// What is yet to be looked at: how far along the fan's axis a node's box begins, and the node.
struct Waiting {
  float from;
  int32_t node;
};

inline void walk(const Target& target, const Fan& fan, Bundle& rays) {
  const float* eye = target.narrow_eye;
  const float o = eye[fan.along];
  const auto least_of_awake = [&] {
    F nearness = splat(3e38f);
    for (int i = 0; i < kGroups; ++i) nearness = min(select(rays.awake[i], rays.nearness[i], splat(3e38f)), nearness);
    return least(nearness);
  };
  Waiting waiting[kMostWaiting];
  int count = 1;
  waiting[0] = {0.0f, 0};
  float least_near = least_of_awake(), furthest = fan.fastest * 1.00001f / least_near;
  while (count > 0) {
    const Waiting next = waiting[--count];
    if (next.from > furthest) continue;
    const BvhNode& node = target.bvh.nodes[next.node];
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
        const float least_slope = fan.low[axis], most_slope = fan.high[axis];
        met &= (low <= max(k0 * most_slope, k1 * most_slope)) & (high >= min(k0 * least_slope, k1 * least_slope));
      }
      for (uint32_t left = bits(met); left; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        const int32_t first = node.first[step + lane], leaves = node.count[step + lane];
        if (leaves > 0) {
          if (k0[lane] > furthest) continue;
          for (int32_t i = first; i < first + leaves; ++i) meet_leaf(target.bvh.leaves, i, eye, fan, least_near, rays);
          found_some = true;
          continue;
        }
        const Waiting one = {k0[lane], first};
        int at = count++;
        for (; at > least_count && waiting[at - 1].from < one.from; --at) waiting[at] = waiting[at - 1];
        waiting[at] = one;
      }
    }
    if (found_some) least_near = least_of_awake(), furthest = fan.fastest * 1.00001f / least_near;
  }
}

// Rays that go apart, one by one.
inline void walk_apart(const Target& target, Bundle& rays) {
  const F lanes = counting();
  for (int group = 0; group < kGroups; ++group)
    for (uint32_t left = bits(rays.awake[group]); left; left &= left - 1) {
      const int i = __builtin_ctz(left);
      const F3& d = rays.d[group];
      Bundle one;
      for (int k = 0; k < kGroups; ++k) {
        one.d[k] = {splat(d.x[i]), splat(d.y[i]), splat(d.z[i])};
        one.awake[k] = k == group ? lanes == (float)i : I{};
        one.nearness[k] = splat(rays.nearness[group][i]);
        one.met[k] = splat((int32_t)-1);
      }
      const Fan thin(one);
      if (thin.narrow) walk(target, thin, one);
      rays.nearness[group] = select(one.awake[group], one.nearness[group], rays.nearness[group]);
      rays.met[group] = select(one.awake[group], one.met[group], rays.met[group]);
    }
}

inline void meet_mesh(const Target& target, Bundle& rays) {
  const Fan fan(rays);
  if (fan.narrow) return walk(target, fan, rays);
  walk_apart(target, rays);
}

}  // namespace trundle::TRUNDLE_ISA
