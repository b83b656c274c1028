// Rasterization of meshes: small triangles kLanes at a time, the others one by one.
#pragma once

#include "kernel.h"
#include "simd.h"
#include "triangle.h"

namespace trundle::TRUNDLE_ISA {

// Vertices of a mesh in a view, as structure of arrays.
struct ProjectedVertices {
  float *x, *y, *z, *u, *v, *inverse_depth;

  ProjectedVertices(float* storage, int32_t count) {
    const int64_t row = (count + kMaxLanes - 1) / kMaxLanes * kMaxLanes;
    x = storage, y = x + row, z = y + row, u = z + row, v = u + row, inverse_depth = v + row;
  }
  Vertex vertex(int32_t i) const { return {x[i], y[i], z[i], u[i], v[i], inverse_depth[i]}; }

  // Returns whether all are in front of the near plane.
  bool project_all(const View& view, const Renderable& renderable) {
    const Triangles& mesh = *renderable.mesh;
    I behind = I{};
    for (int32_t i = 0; i < mesh.vertex_count; i += kLanes) {
      const F3 p = inverse_rotate(
          renderable.axes, {load(mesh.positions[0] + i), load(mesh.positions[1] + i), load(mesh.positions[2] + i)});
      const F ahead = renderable.centre[0] + p.x, left = renderable.centre[1] + p.y, up = renderable.centre[2] + p.z;
      const F near = view.orthographic ? -ahead : 1.0f / ahead;
      behind |= ahead < view.near_;
      store(x + i, ahead), store(y + i, left), store(z + i, up), store(inverse_depth + i, near);
      store(u + i, view.centre_u - (view.orthographic ? view.focal * left : view.focal * left * near));
      store(v + i, view.centre_v - (view.orthographic ? view.focal * up : view.focal * up * near));
    }
    return !any(behind);
  }
};

constexpr float kMaxSmallTriangle = 32.0f;  // [px] up to which single precision suffices

// Edge of kLanes triangles.
struct EdgeBatch {
  F u0, v0, du, dv, threshold;

  EdgeBatch(F au, F av, F bu, F bv) {
    const I ordered = (av < bv) | ((av == bv) & (au < bu));
    u0 = select(ordered, au, bu), v0 = select(ordered, av, bv);
    du = bu - au, dv = bv - av;
    threshold = select(ordered, splat(-1e-45f), F{});
  }
};

// Setup of kLanes triangles, drawn one after the other.
struct SmallTriangles {
  EdgeBatch ab, bc, ca;
  F au, av, an, along_u, along_v, lowest, highest;
  I row0, row1, column0, column1;

  template <bool with_id>
  void draw(const View& view, const Buffers& buffers, int i, int32_t id) const {
    const int last = view.stride - kLanes, right = column1[i], bottom = row1[i];
    for (int column = column0[i]; column < right; column += kLanes) {
      const int from = column < last ? column : last;
      const F u = lane_indices() + ((float)from + 0.5f);
      const I within = (u > (float)column) & (u < (float)right);
      const F on_ab = select(within, (u - ab.u0[i]) * ab.dv[i], splat(-3e38f));
      const F on_bc = (u - bc.u0[i]) * bc.dv[i], on_ca = (u - ca.u0[i]) * ca.dv[i];
      const F slope = along_u[i] * (u - au[i]);
      for (int row = row0[i]; row < bottom; ++row) {
        const float v = (float)row + 0.5f;
        const I inside = (on_ab - (v - ab.v0[i]) * ab.du[i] > ab.threshold[i]) &
                         (on_bc - (v - bc.v0[i]) * bc.du[i] > bc.threshold[i]) &
                         (on_ca - (v - ca.v0[i]) * ca.du[i] > ca.threshold[i]);
        const F inverse_depth =
            max(min(slope + (an[i] + along_v[i] * (v - av[i])), splat(highest[i])), splat(lowest[i]));
        const int at = row * view.stride + from;
        const F old = load(buffers.inverse_depth + at);
        write_pixels<with_id>(buffers, at, inside, inverse_depth, old, id);
      }
    }
  }
};

inline F min_of(F a, F b, F c) { return min(min(a, b), c); }
inline F max_of(F a, F b, F c) { return max(max(a, b), c); }

// Vector versions.
inline I first_at(F coordinate, int last) {
  return to_int(-floor(-max(min(coordinate - 0.5f, splat((float)last)), F{})));
}
inline I first_past(F coordinate, int last) { return to_int(max(min(coordinate + 0.5f, splat((float)last)), F{})); }

// Triangles hidden in all of their tiles, by hierarchical z; only for those within two by two tiles.
inline I is_occluded(const View& view, const Buffers& buffers, I mask, I row0, I row1, I column0, I column1, F limit) {
  static_assert(kTileWidth == 16 && kTileHeight == 8);
  const I top = row0 >> 3, bottom = (row1 - 1) >> 3, left = column0 >> 4, right = (column1 - 1) >> 4;
  mask &= (bottom - top <= 1) & (right - left <= 1);
  const I upper = top * view.tile_stride(), lower = bottom * view.tile_stride();
  const auto at = [&](I tile) { return gather(buffers.hi_z, tile & mask); };
  const F threshold = min(min(at(upper + left), at(upper + right)), min(at(lower + left), at(lower + right)));
  return mask & (limit < threshold);
}

// Stride that visits each of `count` items once, spread out from the start.
inline int32_t coprime_stride(int32_t count) {
  int32_t stride = (int32_t)((double)count * 0.618033988749895);
  const auto have_common = [](int32_t a, int32_t b) {
    while (b) {
      const int32_t rest = a % b;
      a = b, b = rest;
    }
    return a > 1;
  };
  while (stride < 1 || have_common(count, stride)) ++stride;
  return stride;
}

template <bool with_id>
inline void rasterize_faces(const View& view, const Renderable& renderable, const Buffers& buffers) {
  const Triangles& mesh = *renderable.mesh;
  ProjectedVertices seen(buffers.projected, mesh.vertex_count);
  const bool whole = seen.project_all(view, renderable);
  int32_t count = 0;
  for (int32_t first = 0; first < mesh.face_count; first += kLanes) {
    const I a = load(mesh.corners[0] + first), b = load(mesh.corners[1] + first), c = load(mesh.corners[2] + first);
    const F au = gather(seen.u, a), av = gather(seen.v, a), bu = gather(seen.u, b), bv = gather(seen.v, b);
    const F cu = gather(seen.u, c), cv = gather(seen.v, c);
    const F low_u = min_of(au, bu, cu), high_u = max_of(au, bu, cu);
    const F low_v = min_of(av, bv, cv), high_v = max_of(av, bv, cv);
    const F ab_u = bu - au, ab_v = bv - av, ac_u = cu - au, ac_v = cv - av;
    const F area = ab_u * ac_v - ab_v * ac_u;
    const I small = (high_u - low_u <= kMaxSmallTriangle) & (high_v - low_v <= kMaxSmallTriangle);
    I row0 = first_at(low_v, view.height), row1 = first_past(high_v, view.height);
    row0 = select(row0 > renderable.top, row0, splat(renderable.top)), row1 = min_of(row1, renderable.bottom);
    const I column0 = first_at(low_u, view.width), column1 = first_past(high_u, view.width);
    // v points down: front faces have a negative area.
    I drawn = (row0 < row1) & (column0 < column1) & (area < 0.0f) & small;
    I deferred = ~small & (a != b);
    if (!whole) {
      const F ax = gather(seen.x, a), bx = gather(seen.x, b), cx = gather(seen.x, c);
      const I all = min_of(ax, bx, cx) >= view.near_;
      deferred = (a != b) & (max_of(ax, bx, cx) >= view.near_) & (~all | ~small);
      drawn &= all;
    }
    if (any(drawn)) {
      const F an = gather(seen.inverse_depth, a), bn = gather(seen.inverse_depth, b),
              cn = gather(seen.inverse_depth, c);
      drawn &= ~is_occluded(view, buffers, drawn, row0, row1, column0, column1, max_of(an, bn, cn));
      const F share = 1.0f / area, ab_n = bn - an, ac_n = cn - an;
      const SmallTriangles batch = {EdgeBatch(au, av, bu, bv),
                                    EdgeBatch(bu, bv, cu, cv),
                                    EdgeBatch(cu, cv, au, av),
                                    au,
                                    av,
                                    an,
                                    (ab_n * ac_v - ac_n * ab_v) * share,
                                    (ac_n * ab_u - ab_n * ac_u) * share,
                                    min_of(an, bn, cn),
                                    max_of(an, bn, cn),
                                    row0,
                                    row1,
                                    column0,
                                    column1};
      for (uint32_t left = bits(drawn); left; left &= left - 1) {
        const int i = __builtin_ctz(left);
        batch.draw<with_id>(view, buffers, i, renderable.first_id + first + i);
      }
    }
    for (uint32_t left = bits(deferred); left; left &= left - 1)
      buffers.large_faces[count++] = first + __builtin_ctz(left);
  }
  // Spread out: in order, layers that come back to front would all be drawn.
  const int32_t stride = coprime_stride(count);
  for (int32_t i = 0, at = 0; i < count; ++i, at = at < count - stride ? at + stride : at + stride - count) {
    const int32_t face = buffers.large_faces[at];
    const auto vertex = [&](int k) { return seen.vertex(mesh.corners[k][face]); };
    draw_clipped<with_id>(view, renderable, buffers, {{vertex(0), vertex(1), vertex(2)}}, renderable.first_id + face);
  }
}

inline void rasterize_mesh(const View& view, const Renderable& renderable, const Buffers& buffers) {
  if (buffers.id) return rasterize_faces<true>(view, renderable, buffers);
  rasterize_faces<false>(view, renderable, buffers);
}

}  // namespace trundle::TRUNDLE_ISA
