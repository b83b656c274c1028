// Rasterization of single triangles into the depth and id buffers. Watertight: an edge is evaluated from the same end
// by both of its triangles, and a pixel centre on it belongs to one of them.
#pragma once

#include "kernel.h"
#include "simd.h"

namespace trundle::TRUNDLE_ISA {

struct Vertex {
  float x, y, z;              // in the camera frame [m]
  float u, v, inverse_depth;  // [px], [px], as in Buffers
};

// Edge function; inside is above `threshold`.
struct Edge {
  float u0, v0, du, dv, threshold;

  Edge(const Vertex& a, const Vertex& b) {
    const bool ordered = a.v < b.v || (a.v == b.v && a.u < b.u);
    const Vertex& from = ordered ? a : b;
    const Vertex& to = ordered ? b : a;
    u0 = from.u;
    v0 = from.v;
    du = ordered ? to.u - from.u : from.u - to.u;
    dv = ordered ? to.v - from.v : from.v - to.v;
    threshold = ordered ? -1e-45f : 0.0f;  // fill rule for centres on the edge
  }
  Ints contains(Floats u, float along_row) const { return (u - u0) * dv - along_row > threshold; }
  float along_row(float v) const { return (v - v0) * du; }
};

inline float min_of(float a, float b) { return a < b ? a : b; }
inline float max_of(float a, float b) { return a > b ? a : b; }

inline void project(const View& view, Vertex& vertex) {
  if (view.orthographic) {
    vertex.inverse_depth = -vertex.x;
    vertex.u = view.centre_u - view.focal * vertex.y;
    vertex.v = view.centre_v - view.focal * vertex.z;
    return;
  }
  vertex.inverse_depth = 1.0f / vertex.x;
  vertex.u = view.centre_u - view.focal * vertex.y * vertex.inverse_depth;
  vertex.v = view.centre_v - view.focal * vertex.z * vertex.inverse_depth;
}

inline int clamp_pixel(float pixel, int last) {
  return pixel > 0.0f ? (pixel < static_cast<float>(last) ? static_cast<int>(pixel) : last) : 0;
}

// First pixel whose centre is >= a coordinate, and first whose centre is > it.
inline int first_at(float coordinate, int last) { return clamp_pixel(__builtin_ceilf(coordinate - 0.5f), last); }
inline int first_past(float coordinate, int last) { return clamp_pixel(__builtin_floorf(coordinate + 0.5f), last); }

// Depth test; at equal depth the lower id wins.
template <bool with_id>
inline void write_pixels(const Buffers& buffers, int at, Ints mask, Floats inverse_depth, Floats old, int32_t id) {
  Ints seen = mask & (inverse_depth > old);
  if constexpr (with_id) {
    const Ints other = load(buffers.id + at);
    seen |= mask & (inverse_depth == old) & (other > id);
    store(buffers.id + at, select(seen, splat(id), other));
  }
  store(buffers.inverse_depth + at, select(seen, inverse_depth, old));
}

// Triangle of any size, tested against kLanes tiles at a time before their pixels. Rounding is monotonic, so a test of
// a tile's extreme corner holds for all of its pixels.
struct LargeTriangle {
  Edge edges[3];
  float u, v, inverse_depth, along_u, along_v, limit;
  int32_t row0, row1, column0, column1, id;

  float inverse_depth_at(float v) const { return inverse_depth + along_v * (v - this->v); }

  template <bool with_id>
  void draw(const View& view, const Buffers& buffers) const {
    for (int top = row0 / kTileHeight * kTileHeight; top < row1; top += kTileHeight) {
      const float first_v = static_cast<float>(top) + 0.5f, last_v = first_v + (kTileHeight - 1);
      const float* hi_z = buffers.hi_z + top / kTileHeight * view.tile_stride();
      for (int left = column0 / (kTileWidth * kLanes) * kLanes; left * kTileWidth < column1; left += kLanes) {
        const Floats first_u = (lane_indices() + static_cast<float>(left)) * static_cast<float>(kTileWidth) + 0.5f;
        const Floats last_u = first_u + static_cast<float>(kTileWidth - 1);
        Ints open = (last_u > static_cast<float>(column0)) & (first_u < static_cast<float>(column1));
        const Floats best =
            inverse_depth_at(along_v > 0.0f ? last_v : first_v) + along_u * ((along_u > 0.0f ? last_u : first_u) - u);
        open &= min(best, splat(limit)) >= load(hi_z + left);
        Ints within = (first_u > static_cast<float>(column0)) & (last_u < static_cast<float>(column1));
        for (const Edge& edge : edges) {
          const Floats low = edge.dv > 0.0f ? first_u : last_u, high = edge.dv > 0.0f ? last_u : first_u;
          const float upper = edge.along_row(first_v), lower = edge.along_row(last_v);
          open &= edge.contains(high, min_of(upper, lower));
          within &= edge.contains(low, max_of(upper, lower));
        }
        const uint32_t all_of_it = bits(within);
        for (uint32_t still = bits(open); still; still &= still - 1) {
          const int i = __builtin_ctz(still), column = (left + i) * kTileWidth;
          if (all_of_it >> i & 1) draw_tile<with_id, true>(view, buffers, top, column);
          else draw_tile<with_id, false>(view, buffers, top, column);
        }
      }
    }
  }

  template <bool with_id, bool within>
  void draw_tile(const View& view, const Buffers& buffers, int top, int left) const {
    const int first = top > row0 ? top : row0, last = top + kTileHeight < row1 ? top + kTileHeight : row1;
    Floats farthest = splat(3e38f);
    for (int row = first; row < last; ++row) {
      const float v = static_cast<float>(row) + 0.5f, row_inverse_depth = inverse_depth_at(v);
      const float along[3] = {edges[0].along_row(v), edges[1].along_row(v), edges[2].along_row(v)};
      for (int column = left; column < left + kTileWidth; column += kLanes) {
        const Floats u = lane_indices() + (static_cast<float>(column) + 0.5f);
        const int at = row * view.stride + column;
        const Floats old = load(buffers.inverse_depth + at);
        const Floats here = min(row_inverse_depth + along_u * (u - this->u), splat(limit));
        Ints inside = here >= old;
        if constexpr (!within) {
          inside &= (u > static_cast<float>(column0)) & (u < static_cast<float>(column1));
          for (int i = 0; i < 3; ++i) inside &= edges[i].contains(u, along[i]);
        }
        farthest = min(select(inside, here, old), farthest);
        if (any(inside)) write_pixels<with_id>(buffers, at, inside, here, old, id);
      }
    }
    const bool whole = first == top && (last == top + kTileHeight || last == view.height);
    if (whole) buffers.hi_z[top / kTileHeight * view.tile_stride() + left / kTileWidth] = reduce_min(farthest);
  }
};

// Counter-clockwise seen from outside; back faces are culled.
template <bool with_id>
inline void draw_triangle(const View& view, const Renderable& renderable, const Buffers& buffers, const Vertex& a,
                          const Vertex& b, const Vertex& c, int32_t id) {
  const double bu = static_cast<double>(b.u) - a.u, bv = static_cast<double>(b.v) - a.v,
               cu = static_cast<double>(c.u) - a.u, cv = static_cast<double>(c.v) - a.v;
  const double area = bu * cv - bv * cu;
  if (!(area < 0.0)) return;  // v points down: front faces have a negative area
  int row0 = first_at(min_of(a.v, min_of(b.v, c.v)), view.height);
  int row1 = first_past(max_of(a.v, max_of(b.v, c.v)), view.height);
  row0 = row0 > renderable.top ? row0 : renderable.top;
  row1 = row1 < renderable.bottom ? row1 : renderable.bottom;
  const int column0 = first_at(min_of(a.u, min_of(b.u, c.u)), view.width);
  const int column1 = first_past(max_of(a.u, max_of(b.u, c.u)), view.width);
  if (column0 >= column1 || row0 >= row1) return;
  const double bn = static_cast<double>(b.inverse_depth) - a.inverse_depth,
               cn = static_cast<double>(c.inverse_depth) - a.inverse_depth, share = 1.0 / area;
  const float along_u = static_cast<float>((bn * cv - cn * bv) * share),
              along_v = static_cast<float>((cn * bu - bn * cu) * share);
  const float limit = view.orthographic ? -view.near_ : 1.0f / view.near_;
  const LargeTriangle triangle{
      {{a, b}, {b, c}, {c, a}}, a.u, a.v, a.inverse_depth, along_u, along_v, limit, row0, row1, column0, column1, id};
  triangle.draw<with_id>(view, buffers);
}

// Intersection with the near plane, computed from the visible end by both triangles of an edge.
inline Vertex clip_edge(const View& view, const Vertex& visible, const Vertex& behind) {
  const float share = (view.near_ - visible.x) / (behind.x - visible.x);
  Vertex vertex{
      view.near_, visible.y + share * (behind.y - visible.y), visible.z + share * (behind.z - visible.z), 0, 0, 0};
  project(view, vertex);
  return vertex;
}

struct Triangle {
  Vertex at[3];
};

template <bool with_id>
inline void draw_clipped(const View& view, const Renderable& renderable, const Buffers& buffers,
                         const Triangle& corners, int32_t id) {
  Vertex clipped[4];
  int count = 0;
  for (int i = 0; i < 3; ++i) {
    const Vertex &here = corners.at[i], &next = corners.at[(i + 1) % 3];
    const bool seen = here.x >= view.near_, next_seen = next.x >= view.near_;
    if (seen) clipped[count++] = here;
    if (seen && !next_seen) clipped[count++] = clip_edge(view, here, next);
    if (!seen && next_seen) clipped[count++] = clip_edge(view, next, here);
  }
  for (int i = 2; i < count; ++i)
    draw_triangle<with_id>(view, renderable, buffers, clipped[0], clipped[i - 1], clipped[i], id);
}

}  // namespace trundle::TRUNDLE_ISA
