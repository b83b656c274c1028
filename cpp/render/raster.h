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
    x = storage;
    y = x + row;
    z = y + row;
    u = z + row;
    v = u + row;
    inverse_depth = v + row;
  }
  Vertex vertex(int32_t i) const { return {x[i], y[i], z[i], u[i], v[i], inverse_depth[i]}; }

  // Returns whether all are in front of the near plane.
  bool project_all(const View& view, const Renderable& renderable) {
    const Triangles& mesh = *renderable.mesh;
    Ints behind = Ints{};
    for (int32_t i = 0; i < mesh.vertex_count; i += kLanes) {
      const Floats3 p = inverse_rotate(
          renderable.axes, {load(mesh.positions[0] + i), load(mesh.positions[1] + i), load(mesh.positions[2] + i)});
      const Floats ahead = renderable.centre[0] + p.x, left = renderable.centre[1] + p.y,
                   up = renderable.centre[2] + p.z;
      const Floats near = view.orthographic ? -ahead : 1.0f / ahead;
      behind |= ahead < view.near_;
      store(x + i, ahead);
      store(y + i, left);
      store(z + i, up);
      store(inverse_depth + i, near);
      store(u + i, view.centre_u - (view.orthographic ? view.focal * left : view.focal * left * near));
      store(v + i, view.centre_v - (view.orthographic ? view.focal * up : view.focal * up * near));
    }
    return !any(behind);
  }
};

constexpr float kMaxSmallTriangle = 32.0f;  // [px] up to which single precision suffices

// Edge of kLanes triangles.
struct EdgeBatch {
  Floats u0, v0, du, dv, threshold;

  EdgeBatch(Floats au, Floats av, Floats bu, Floats bv) {
    const Ints ordered = (av < bv) | ((av == bv) & (au < bu));
    u0 = select(ordered, au, bu);
    v0 = select(ordered, av, bv);
    du = bu - au;
    dv = bv - av;
    threshold = select(ordered, splat(-1e-45f), Floats{});
  }
};

// Setup of kLanes triangles, drawn one after the other.
struct SmallTriangles {
  EdgeBatch ab, bc, ca;
  Floats au, av, an, along_u, along_v, lowest, highest;
  Ints row0, row1, column0, column1;

  template <bool with_id>
  void draw(const View& view, const Buffers& buffers, int i, int32_t id) const {
    const int last = view.stride - kLanes, right = column1[i], bottom = row1[i];
    for (int column = column0[i]; column < right; column += kLanes) {
      const int from = column < last ? column : last;
      const Floats u = lane_indices() + (static_cast<float>(from) + 0.5f);
      const Ints within = (u > static_cast<float>(column)) & (u < static_cast<float>(right));
      const Floats on_ab = select(within, (u - ab.u0[i]) * ab.dv[i], splat(-3e38f));
      const Floats on_bc = (u - bc.u0[i]) * bc.dv[i], on_ca = (u - ca.u0[i]) * ca.dv[i];
      const Floats slope = along_u[i] * (u - au[i]);
      for (int row = row0[i]; row < bottom; ++row) {
        const float v = static_cast<float>(row) + 0.5f;
        const Ints inside = (on_ab - (v - ab.v0[i]) * ab.du[i] > ab.threshold[i]) &
                            (on_bc - (v - bc.v0[i]) * bc.du[i] > bc.threshold[i]) &
                            (on_ca - (v - ca.v0[i]) * ca.du[i] > ca.threshold[i]);
        const Floats inverse_depth =
            max(min(slope + (an[i] + along_v[i] * (v - av[i])), splat(highest[i])), splat(lowest[i]));
        const int at = row * view.stride + from;
        const Floats old = load(buffers.inverse_depth + at);
        write_pixels<with_id>(buffers, at, inside, inverse_depth, old, id);
      }
    }
  }
};

inline Floats min_of(Floats a, Floats b, Floats c) { return min(min(a, b), c); }
inline Floats max_of(Floats a, Floats b, Floats c) { return max(max(a, b), c); }

// Vector versions.
inline Ints first_at(Floats coordinate, int last) {
  return to_int(-floor(-max(min(coordinate - 0.5f, splat(static_cast<float>(last))), Floats{})));
}
inline Ints first_past(Floats coordinate, int last) {
  return to_int(max(min(coordinate + 0.5f, splat(static_cast<float>(last))), Floats{}));
}

// Triangles hidden in all of their tiles, by hierarchical z; only for those within two by two tiles.
inline Ints is_occluded(const View& view, const Buffers& buffers, Ints mask, Ints row0, Ints row1, Ints column0,
                        Ints column1, Floats limit) {
  static_assert(kTileWidth == 16 && kTileHeight == 8);
  const Ints top = row0 >> 3, bottom = (row1 - 1) >> 3, left = column0 >> 4, right = (column1 - 1) >> 4;
  mask &= (bottom - top <= 1) & (right - left <= 1);
  const Ints upper = top * view.tile_stride(), lower = bottom * view.tile_stride();
  const auto at = [&](Ints tile) { return gather(buffers.hi_z, tile & mask); };
  const Floats threshold = min(min(at(upper + left), at(upper + right)), min(at(lower + left), at(lower + right)));
  return mask & (limit < threshold);
}

// Stride that visits each of `count` items once, spread out from the start.
inline int32_t coprime_stride(int32_t count) {
  int32_t stride = static_cast<int32_t>(static_cast<double>(count) * 0.618033988749895);
  const auto have_common = [](int32_t a, int32_t b) {
    while (b) {
      const int32_t rest = a % b;
      a = b;
      b = rest;
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
    const Ints a = load(mesh.corners[0] + first), b = load(mesh.corners[1] + first), c = load(mesh.corners[2] + first);
    const Floats au = gather(seen.u, a), av = gather(seen.v, a), bu = gather(seen.u, b), bv = gather(seen.v, b);
    const Floats cu = gather(seen.u, c), cv = gather(seen.v, c);
    const Floats low_u = min_of(au, bu, cu), high_u = max_of(au, bu, cu);
    const Floats low_v = min_of(av, bv, cv), high_v = max_of(av, bv, cv);
    const Floats ab_u = bu - au, ab_v = bv - av, ac_u = cu - au, ac_v = cv - av;
    const Floats area = ab_u * ac_v - ab_v * ac_u;
    const Ints small = (high_u - low_u <= kMaxSmallTriangle) & (high_v - low_v <= kMaxSmallTriangle);
    Ints row0 = first_at(low_v, view.height), row1 = first_past(high_v, view.height);
    row0 = select(row0 > renderable.top, row0, splat(renderable.top));
    row1 = min_of(row1, renderable.bottom);
    const Ints column0 = first_at(low_u, view.width), column1 = first_past(high_u, view.width);
    // v points down: front faces have a negative area.
    Ints drawn = (row0 < row1) & (column0 < column1) & (area < 0.0f) & small;
    Ints deferred = ~small & (a != b);
    if (!whole) {
      const Floats ax = gather(seen.x, a), bx = gather(seen.x, b), cx = gather(seen.x, c);
      const Ints all = min_of(ax, bx, cx) >= view.near_;
      deferred = (a != b) & (max_of(ax, bx, cx) >= view.near_) & (~all | ~small);
      drawn &= all;
    }
    if (any(drawn)) {
      const Floats an = gather(seen.inverse_depth, a), bn = gather(seen.inverse_depth, b),
                   cn = gather(seen.inverse_depth, c);
      drawn &= ~is_occluded(view, buffers, drawn, row0, row1, column0, column1, max_of(an, bn, cn));
      const Floats share = 1.0f / area, ab_n = bn - an, ac_n = cn - an;
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
