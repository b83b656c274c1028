// Ray casting from one origin, in blocks of rays that share culling.
#pragma once

#include "bvh_traversal.h"
#include "intersect.h"
#include "kernel.h"
#include "simd.h"

namespace trundle::TRUNDLE_ISA {

constexpr int kBlockRays = 64;  // rays culled together
constexpr int kBatch = 4;       // number of shapes that are culled together, without waiting for each other's hits

struct RayBlock {
  int count;  // a multiple of kLanes; the last ray is repeated
  alignas(64) double directions[3][kBlockRays], ranges[kBlockRays];
  alignas(64) double shapes[kBlockRays];                                    // indices, as doubles
  alignas(64) float directions_f32[3][kBlockRays], ranges_f32[kBlockRays];  // rounded, for culling
  alignas(64) float entry[kBlockRays];  // range to the nearest bounding sphere of a mesh

  RayBlock(const double* unit_directions, int64_t count, double reach) {
    const int rays = count < kBlockRays ? static_cast<int>(count) : kBlockRays;
    this->count = (rays + kLanes - 1) / kLanes * kLanes;
    for (int i = 0; i < rays; ++i)
      for (int axis = 0; axis < 3; ++axis) directions[axis][i] = unit_directions[3 * i + axis];
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = rays; i < this->count; ++i) directions[axis][i] = directions[axis][rays - 1];
      for (int i = 0; i < this->count; ++i) directions_f32[axis][i] = static_cast<float>(directions[axis][i]);
    }
    for (int i = 0; i < kBlockRays; ++i) {
      ranges[i] = reach;
      ranges_f32[i] = static_cast<float>(reach);
      shapes[i] = -1;
      entry[i] = 3e38f;
    }
  }
  Floats3 direction_f32_at(int i) const {
    return {load(directions_f32[0] + i), load(directions_f32[1] + i), load(directions_f32[2] + i)};
  }
  Doubles3 at(int i) const { return {load(directions[0] + i), load(directions[1] + i), load(directions[2] + i)}; }
};

// Cone around the rays of a block.
struct Cone {
  float axis[3], cosine, sine;
  bool directions_f32;

  explicit Cone(const RayBlock& rays) {
    float square = 0.0f;
    for (int i = 0; i < 3; ++i) {
      const float* direction = rays.directions_f32[i];
      axis[i] = direction[0] + direction[rays.count / 2] + direction[rays.count - 1];
      square += axis[i] * axis[i];
    }
    Floats least_of_all = splat(3e38f);
    for (int i = 0; i < rays.count; i += kLanes)
      least_of_all = min(dot(rays.direction_f32_at(i), splat(axis)), least_of_all);
    const float inverse = 1.0f / __builtin_sqrtf(square);
    for (float& number : axis) number *= inverse;
    cosine = reduce_min(least_of_all) * inverse - 1e-6f;  // minus rounding
    directions_f32 = cosine > 0.1f;
    sine = __builtin_sqrtf(1.0f - cosine * cosine);
  }

  // Lanes that are surely outside: bounding spheres beyond the cone's side, and bounding cylinders that no ray reaches.
  Ints misses(const BoundingVolumes& volumes, int at) const {
    const auto three = [at](const auto& rows) {
      return Floats3{load(rows[0] + at), load(rows[1] + at), load(rows[2] + at)};
    };
    const Floats3 centre = three(volumes.centre);
    const Floats radius = load(volumes.radius + at), along = dot(centre, splat(axis)), away = dot(centre, centre);
    const Floats needed = along * sine + radius, across = away * 0.999999f - along * along;
    const Floats moment =
        max(abs(dot(three(volumes.moment), splat(axis))) * cosine - sine * load(volumes.moment_length + at), Floats{});
    return (radius >= 0.0f) & ((needed < 0.0f) | (across * (cosine * cosine) > needed * needed) |
                               (moment * moment > load(volumes.cylinder_radius_squared + at)));
  }

  // Writes the indices of the lanes that are not outside; returns their number.
  int32_t find(const BoundingVolumes* volumes, int32_t count, int32_t* near) const {
    int32_t count_near = 0;
    for (int32_t first = 0; first < count; first += kLanes) {
      const Ints here = splat(first) + lane_numbers() < count;
      const Ints out = directions_f32 ? misses(volumes[first / kMaxLanes], first % kMaxLanes) : Ints{};
      for (uint32_t left = bits(here & ~out); left; left &= left - 1) near[count_near++] = first + __builtin_ctz(left);
    }
    return count_near;
  }
};

// Rays that hit a target's bounding sphere, and where.
struct SphereHits {
  Ints reached;
  Floats along, within;

  SphereHits(const RayTarget& target, const Floats3& d)
      : along(max(d.x * target.centre[0] + d.y * target.centre[1] + d.z * target.centre[2], Floats{})),
        within(along * along - target.tangent_squared) {
    reached = within >= 0.0f;
    along *= 0.999999f;  // minus rounding
  }
  Floats entry() const {
    return along - sqrt(max(within, Floats{}));
  }  // range at which the sphere is entered, rounded down
};

// Rays that may hit the target before their nearest hit so far.
inline Ints may_hit(const RayTarget& target, const Floats3& d, Floats ranges_f32) {
  if (target.kind == ShapeKind::kPlane) {
    const Floats down = -(d.x * target.axes_f32[6] + d.y * target.axes_f32[7] + d.z * target.axes_f32[8]);
    return (down + 1e-6f) * ranges_f32 >= target.eye_f32[2] * 0.999999f;
  }
  const SphereHits near(target, d);
  const Floats moment = dot(d, splat(target.moment));
  return near.reached & (near.along - target.radius <= ranges_f32) &
         (moment * moment <= target.cylinder_radius_squared);
}

// Groups of kDoubleLanes rays of a block that may hit a target.
struct Candidates {
  int count, at[kBlockRays / kDoubleLanes];

  void find(const RayTarget& target, const RayBlock& rays) {
    count = 0;
    if (target.kind == ShapeKind::kMesh) return;
    for (int first = 0; first < rays.count; first += kLanes) {
      const uint32_t some = bits(may_hit(target, rays.direction_f32_at(first), load(rays.ranges_f32 + first)));
      // Branchless: the branch would be unpredictable.
      at[count] = first;
      count += (some & ((1u << kDoubleLanes) - 1)) != 0;
      at[count] = first + kDoubleLanes;
      count += some >> kDoubleLanes != 0;
    }
  }
};

template <ShapeKind kind>
inline void cast_shape(const RayTarget& target, const Candidates& candidates, RayBlock& rays) {
  const Doubles3 o = splat(target.eye);
  for (int i = 0; i < candidates.count; ++i) {
    const int at = candidates.at[i];
    const Doubles3 d = rays.at(at);
    const RayHit<Doubles> hit =
        intersect<kind>(target.size, o, kind == ShapeKind::kSphere ? d : rotate(target.axes, d));
    const Doubles range = load(rays.ranges + at), shape = load(rays.shapes + at),
                  index = splat(static_cast<double>(target.index));
    // At equal range the lower index wins, for any order of shapes.
    const Longs nearer = hit.mask & ((hit.depth < range) | ((hit.depth == range) & (shape > index)));
    store(rays.ranges + at, select(nearer, hit.depth, range));
    store(rays.shapes + at, select(nearer, index, shape));
    for (int k = at; k < at + kDoubleLanes; ++k) rays.ranges_f32[k] = static_cast<float>(rays.ranges[k]);
  }
}

// Range to a triangle's plane along a direction in the mesh frame.
inline double range_to(const RayTarget& target, int32_t triangle, double x, double y, double z) {
  const BvhLeaf& leaf = target.bvh.leaves[triangle / kLeafSize];
  const int i = triangle % kLeafSize;
  const double normal[3] = {leaf.normal[0][i], leaf.normal[1][i], leaf.normal[2][i]};
  double away = 0.0;
  for (int axis = 0; axis < 3; ++axis) away += normal[axis] * (leaf.corner[axis][i] - target.eye[axis]);
  return away / (normal[0] * x + normal[1] * y + normal[2] * z);
}

// First each ray's nearest mesh by bounding sphere, then the meshes that its hit does not hide.
enum class Pass { kNearest, kRest };

inline void cast_mesh(const RayTarget& target, Pass pass, RayBlock& rays) {
  for (int first = 0; first < rays.count; first += kPacketGroups * kLanes) {
    RayPacket packet;
    Ints active = Ints{};
    for (int i = 0; i < kPacketGroups; ++i) {
      const int at = first + i * kLanes;
      packet.active[i] = Ints{};
      packet.d[i] = rays.direction_f32_at(first);
      packet.inverse_range[i] = Floats{};
      packet.hit[i] = splat(static_cast<int32_t>(-1));
      if (at >= rays.count) continue;
      const SphereHits near(target, rays.direction_f32_at(at));
      if (!any(near.reached)) continue;
      const Floats entry = near.entry(), ranges_f32 = load(rays.ranges_f32 + at);
      const Ints is_first = entry <= load(rays.entry + at);
      packet.active[i] = near.reached & (entry <= ranges_f32) & (pass == Pass::kNearest ? is_first : ~is_first);
      packet.d[i] = rays.direction_f32_at(at);
      packet.inverse_range[i] = ranges_f32;
      active |= packet.active[i];
    }
    if (!any(active)) continue;
    for (int i = 0; i < kPacketGroups; ++i) {
      packet.d[i] = rotate(target.axes_f32, packet.d[i]);
      packet.inverse_range[i] = 0.99999f / packet.inverse_range[i];  // equal range counts as a hit
    }
    intersect_mesh(target, packet);
    for (int i = 0; i < kPacketGroups; ++i) {
      uint32_t left = bits(packet.hit[i] >= 0);
      if (!left) continue;
      const int at = first + i * kLanes;
      const Doubles3 directions[2] = {rotate(target.axes, rays.at(at)),
                                      rotate(target.axes, rays.at(at + kDoubleLanes))};
      for (; left; left &= left - 1) {
        const int lane = __builtin_ctz(left), k = lane % kDoubleLanes;
        const Doubles3& d = directions[lane / kDoubleLanes];
        const double range = range_to(target, packet.hit[i][lane], d.x[k], d.y[k], d.z[k]),
                     old = rays.ranges[at + lane];
        if (!(range > 0.0 && (range < old || (range == old && rays.shapes[at + lane] > target.index)))) continue;
        rays.ranges[at + lane] = range;
        rays.ranges_f32[at + lane] = static_cast<float>(range);
        rays.shapes[at + lane] = target.index;
      }
    }
  }
}

inline void cast_target(const RayTarget& target, const Candidates& candidates, RayBlock& rays) {
  switch (target.kind) {
    case ShapeKind::kPlane: return cast_shape<ShapeKind::kPlane>(target, candidates, rays);
    case ShapeKind::kBox: return cast_shape<ShapeKind::kBox>(target, candidates, rays);
    case ShapeKind::kSphere: return cast_shape<ShapeKind::kSphere>(target, candidates, rays);
    case ShapeKind::kCylinder: return cast_shape<ShapeKind::kCylinder>(target, candidates, rays);
    case ShapeKind::kCapsule: return cast_shape<ShapeKind::kCapsule>(target, candidates, rays);
    case ShapeKind::kEllipsoid: return cast_shape<ShapeKind::kEllipsoid>(target, candidates, rays);
    case ShapeKind::kMesh:  // after all shapes that may hide it
      for (int i = 0; i < rays.count; i += kLanes) {
        const SphereHits near(target, rays.direction_f32_at(i));
        store(rays.entry + i, min(select(near.reached, near.entry(), splat(3e38f)), load(rays.entry + i)));
      }
  }
}

// directions: (count, 3), unit, in the frame of the common origin.
inline void cast_rays(const RayTarget* targets, const BoundingVolumes* volumes, int32_t target_count, int32_t* near,
                      const double* directions, int64_t count, double reach, double* ranges, int32_t* shapes) {
  for (int64_t first = 0; first < count; first += kBlockRays) {
    RayBlock rays(directions + 3 * first, count - first, reach);
    const int32_t candidate_count = Cone(rays).find(volumes, target_count, near);
    bool has_meshes = false;
    for (int32_t i = 0; i < candidate_count; i += kBatch) {
      Candidates candidates[kBatch];
      const int32_t last = candidate_count - i < kBatch ? candidate_count - i : kBatch;
      for (int32_t k = 0; k < last; ++k) candidates[k].find(targets[near[i + k]], rays);
      for (int32_t k = 0; k < last; ++k) {
        const RayTarget& target = targets[near[i + k]];
        cast_target(target, candidates[k], rays);
        has_meshes |= target.kind == ShapeKind::kMesh;
      }
    }
    const Pass passes[2] = {Pass::kNearest, Pass::kRest};
    for (const Pass pass : passes)
      for (int32_t i = 0; has_meshes && i < candidate_count; ++i)
        if (targets[near[i]].kind == ShapeKind::kMesh) cast_mesh(targets[near[i]], pass, rays);
    const int64_t last = count - first < kBlockRays ? count - first : kBlockRays;
    for (int64_t i = 0; i < last; ++i) {
      ranges[first + i] = rays.shapes[i] < 0 ? __builtin_inf() : rays.ranges[i];
      shapes[first + i] = static_cast<int32_t>(rays.shapes[i]);
    }
  }
}

}  // namespace trundle::TRUNDLE_ISA
