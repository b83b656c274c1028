// Packets of rays through the bounding volume hierarchy of a mesh.
#pragma once

#include "kernel.h"
#include "simd.h"

namespace trundle::TRUNDLE_ISA {

// Rays are traversed in packets and share the cost of each node and triangle.
constexpr int kPacketGroups = kLanes < 16 ? 16 / kLanes : 1;

struct RayPacket {
  Floats3 d[kPacketGroups];             // directions in the mesh frame
  Ints active[kPacketGroups];           // mask
  Floats inverse_range[kPacketGroups];  // 1 / range of the nearest hit so far
  Ints hit[kPacketGroups];              // triangle: kLeafSize * leaf + index in the leaf, or -1
};

// Frustum around rays from one point: all have the same sign along one axis, and slopes against it between `low` and
// `high`.
struct Frustum {
  int along, across[2];
  float sign, low[3], high[3], fastest;
  bool is_narrow = true;

  explicit Frustum(const RayPacket& packet) {
    int group = 0;
    while (!any(packet.active[group])) ++group;
    const int first = __builtin_ctz(bits(packet.active[group]));
    const float ray[3] = {packet.d[group].x[first], packet.d[group].y[first], packet.d[group].z[first]};
    const float ax = __builtin_fabsf(ray[0]), ay = __builtin_fabsf(ray[1]), az = __builtin_fabsf(ray[2]);
    along = ax >= ay && ax >= az ? 0 : ay >= az ? 1 : 2;
    across[0] = (along + 1) % 3;
    across[1] = (along + 2) % 3;
    sign = ray[along] < 0.0f ? -1.0f : 1.0f;
    Floats slowest = splat(ray[along] * sign), quickest = slowest, lows[2], highs[2];
    for (int i = 0; i < 2; ++i) {
      lows[i] = splat(3e38f);
      highs[i] = splat(-3e38f);
    }
    for (int i = 0; i < kPacketGroups; ++i) {
      const Floats components[3] = {packet.d[i].x, packet.d[i].y, packet.d[i].z};
      const Floats component = select(packet.active[i], components[along], splat(ray[along])) * sign;
      slowest = min(component, slowest);
      quickest = max(component, quickest);
      const Floats inverse = 1.0f / select(component > 0.0f, component, splat(1.0f));
      for (int k = 0; k < 2; ++k) {
        const Floats slope = select(packet.active[i], components[across[k]], splat(ray[across[k]])) * inverse;
        lows[k] = min(slope, lows[k]);
        highs[k] = max(slope, highs[k]);
      }
    }
    fastest = reduce_max(quickest);
    if (!(reduce_min(slowest) > 0.0f)) is_narrow = false;
    for (int k = 0; k < 2; ++k) {  // with a margin for rounding
      const float from = reduce_min(lows[k]) - 2e-6f, to = reduce_max(highs[k]) + 2e-6f;
      low[across[k]] = from;
      high[across[k]] = to;
      if (!(to - from < 0.5f)) is_narrow = false;
    }
    low[along] = high[along] = sign;
  }
};

typedef float Floats8 __attribute__((vector_size(32)));  // one lane per triangle of a leaf
typedef int32_t Ints8 __attribute__((vector_size(32)));
static_assert(kLeafSize == 8);

inline Floats8 load8(const float* at) {
  Floats8 value;
  __builtin_memcpy(&value, at, sizeof value);
  return value;
}
#if defined(__AVX2__)
inline Floats8 max8(Floats8 a, Floats8 b) {
  return reinterpret_cast<Floats8>(_mm256_max_ps(reinterpret_cast<__m256>(a), reinterpret_cast<__m256>(b)));
}
inline uint32_t bits8(Ints8 mask) { return static_cast<uint32_t>(_mm256_movemask_ps(reinterpret_cast<__m256>(mask))); }
#elif defined(__SSE2__)
inline Floats8 max8(Floats8 a, Floats8 b) {
  const __m128* as = reinterpret_cast<const __m128*>(&a);
  const __m128* bs = reinterpret_cast<const __m128*>(&b);
  const __m128 largest[2] = {_mm_max_ps(as[0], bs[0]), _mm_max_ps(as[1], bs[1])};
  return load8(reinterpret_cast<const float*>(largest));
}
inline uint32_t bits8(Ints8 mask) {
  const __m128* halves = reinterpret_cast<const __m128*>(&mask);
  return static_cast<uint32_t>(_mm_movemask_ps(halves[0]) | _mm_movemask_ps(halves[1]) << 4);
}
#else
inline Floats8 max8(Floats8 a, Floats8 b) { return a > b ? a : b; }
inline uint32_t bits8(Ints8 mask) {
  uint32_t all = 0;
  for (int i = 0; i < 8; ++i) all |= (uint32_t)(mask[i] & 1) << i;
  return all;
}
#endif

// Two-sided Möller-Trumbore test. Terms common to all rays from one origin are computed once: a ray hits a triangle
// where it is on the inner side of three planes through that origin. Triangles outside the frustum, or no nearer than
// `min_inverse_range`, are culled.
inline void intersect_leaf(const BvhLeaf* leaves, int32_t number, const float* eye, const Frustum& frustum,
                           float min_inverse_range, RayPacket& packet) {
  const BvhLeaf& leaf = leaves[number];
  Floats8 n[3], p[3], more[3], left[3], right[3], components[4][3];
  for (int i = 0; i < 3; ++i) {
    n[i] = load8(leaf.normal[i]);
    p[i] = eye[i] - load8(leaf.corner[i]);
    more[i] = n[i] * 1e-6f;
  }
  const Floats8 lift = -p[0] * n[0] - p[1] * n[1] - p[2] * n[2], inverse = 1.0f / lift;
  const Floats8 sign = lift < 0.0f ? Floats8{} - 1.0f : Floats8{} + 1.0f;
  for (int i = 0; i < 3; ++i) {
    const int y = (i + 1) % 3, z = (i + 2) % 3;
    left[i] = p[y] * load8(leaf.edges[1][z]) - p[z] * load8(leaf.edges[1][y]);
    right[i] = p[z] * load8(leaf.edges[0][y]) - p[y] * load8(leaf.edges[0][z]);
    components[0][i] = n[i] * inverse;
    components[1][i] = (more[i] + left[i]) * sign;
    components[2][i] = (more[i] + right[i]) * sign;
    components[3][i] = (more[i] + (n[i] - left[i] - right[i])) * sign;
  }
  const auto largest = [&](const Floats8* component) {  // over the frustum, per metre along its axis
    Floats8 sum = max8(component[0] * frustum.low[0], component[0] * frustum.high[0]);
    for (int i = 1; i < 3; ++i) sum = sum + max8(component[i] * frustum.low[i], component[i] * frustum.high[i]);
    return sum;
  };
  const Ints8 hit = (largest(components[1]) >= 0.0f) & (largest(components[2]) >= 0.0f) &
                    (largest(components[3]) >= 0.0f) &
                    (largest(components[0]) * (frustum.fastest * 1.00001f) > min_inverse_range);
  for (uint32_t still = bits8(hit); still; still &= still - 1) {
    const int i = __builtin_ctz(still);
    for (int group = 0; group < kPacketGroups; ++group) {
      const Floats3& d = packet.d[group];
      const Floats than = packet.inverse_range[group];
      const auto along = [&](const Floats8* component) {
        return d.x * component[0][i] + d.y * component[1][i] + d.z * component[2][i];
      };
      const Floats here = along(components[0]);
      const Ints hit =
          (min(min(along(components[1]), along(components[2])), along(components[3])) >= 0.0f) & (here > than);
      packet.inverse_range[group] = select(hit, here, than);
      packet.hit[group] = select(hit, splat(number * kLeafSize + i), packet.hit[group]);
    }
  }
}

// A node to visit, and the start of its box along the frustum's axis.
struct StackEntry {
  float from;
  int32_t node;
};

inline void traverse(const RayTarget& target, const Frustum& frustum, RayPacket& packet) {
  const float* eye = target.eye_f32;
  const float o = eye[frustum.along];
  const auto least_active = [&] {
    Floats inverse_range = splat(3e38f);
    for (int i = 0; i < kPacketGroups; ++i)
      inverse_range = min(select(packet.active[i], packet.inverse_range[i], splat(3e38f)), inverse_range);
    return reduce_min(inverse_range);
  };
  StackEntry stack[kMaxStack];
  int count = 1;
  stack[0] = {0.0f, 0};
  float min_inverse_range = least_active(), furthest = frustum.fastest * 1.00001f / min_inverse_range;
  while (count > 0) {
    const StackEntry next = stack[--count];
    if (next.from > furthest) continue;
    const BvhNode& node = target.bvh.nodes[next.node];
    const float *near = frustum.sign > 0.0f ? node.low[frustum.along] : node.high[frustum.along],
                *far = frustum.sign > 0.0f ? node.high[frustum.along] : node.low[frustum.along];
    const int least_count = count;
    bool found_some = false;
    for (int step = 0; step < kMaxLanes; step += kLanes) {
      const Floats k0 = max((load(near + step) - o) * frustum.sign, Floats{}),
                   k1 = (load(far + step) - o) * frustum.sign;
      Ints hit = (k1 >= 0.0f) & (k0 <= furthest);
      for (int i = 0; i < 2; ++i) {
        const int axis = frustum.across[i];
        const Floats low = load(node.low[axis] + step) - eye[axis], high = load(node.high[axis] + step) - eye[axis];
        const float least_slope = frustum.low[axis], most_slope = frustum.high[axis];
        hit &= (low <= max(k0 * most_slope, k1 * most_slope)) & (high >= min(k0 * least_slope, k1 * least_slope));
      }
      for (uint32_t left = bits(hit); left; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        const int32_t first = node.first[step + lane], leaves = node.count[step + lane];
        if (leaves > 0) {
          if (k0[lane] > furthest) continue;
          for (int32_t i = first; i < first + leaves; ++i)
            intersect_leaf(target.bvh.leaves, i, eye, frustum, min_inverse_range, packet);
          found_some = true;
          continue;
        }
        const StackEntry one = {k0[lane], first};
        int at = count++;
        for (; at > least_count && stack[at - 1].from < one.from; --at) stack[at] = stack[at - 1];
        stack[at] = one;
      }
    }
    if (found_some) {
      min_inverse_range = least_active();
      furthest = frustum.fastest * 1.00001f / min_inverse_range;
    }
  }
}

// For divergent rays: one at a time.
inline void traverse_each(const RayTarget& target, RayPacket& packet) {
  const Floats lanes = lane_indices();
  for (int group = 0; group < kPacketGroups; ++group)
    for (uint32_t left = bits(packet.active[group]); left; left &= left - 1) {
      const int i = __builtin_ctz(left);
      const Floats3& d = packet.d[group];
      RayPacket one;
      for (int k = 0; k < kPacketGroups; ++k) {
        one.d[k] = {splat(d.x[i]), splat(d.y[i]), splat(d.z[i])};
        one.active[k] = k == group ? lanes == static_cast<float>(i) : Ints{};
        one.inverse_range[k] = splat(packet.inverse_range[group][i]);
        one.hit[k] = splat(static_cast<int32_t>(-1));
      }
      const Frustum alone_frustum(one);
      if (alone_frustum.is_narrow) traverse(target, alone_frustum, one);
      packet.inverse_range[group] = select(one.active[group], one.inverse_range[group], packet.inverse_range[group]);
      packet.hit[group] = select(one.active[group], one.hit[group], packet.hit[group]);
    }
}

inline void intersect_mesh(const RayTarget& target, RayPacket& packet) {
  const Frustum frustum(packet);
  if (frustum.is_narrow) return traverse(target, frustum, packet);
  traverse_each(target, packet);
}

}  // namespace trundle::TRUNDLE_ISA
