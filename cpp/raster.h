// Triangles, into the nearness and id buffers. Two triangles with a common edge share no pixel and leave none out: each
// edge is computed from the same end, whichever triangle asks, and a pixel's centre on it belongs to one of them.
#pragma once

#include "kernel.h"
#include "lanes.h"

namespace trundle::TRUNDLE_ISA {

struct Corner {
  float x, y, z;         // in the camera frame [m]
  float u, v, nearness;  // in the picture [px, px], and as in the buffer
};

// Which side of an edge a pixel's centre is on: inside is above `least`.
struct Edge {
  float u0, v0, du, dv, least;

  Edge(const Corner& a, const Corner& b) {
    const bool ordered = a.v < b.v || (a.v == b.v && a.u < b.u);
    const Corner& from = ordered ? a : b;
    const Corner& to = ordered ? b : a;
    u0 = from.u, v0 = from.v;
    du = ordered ? to.u - from.u : from.u - to.u, dv = ordered ? to.v - from.v : from.v - to.v;
    least = ordered ? -1e-45f : 0.0f;  // centres on the edge itself belong to one side
  }
  I holds(F u, float along_row) const { return (u - u0) * dv - along_row > least; }
  float along_row(float v) const { return (v - v0) * du; }
};

inline float least_of(float a, float b) { return a < b ? a : b; }
inline float most_of(float a, float b) { return a > b ? a : b; }

inline void project(const View& view, Corner& corner) {
  if (view.parallel) {
    corner.nearness = -corner.x;
    corner.u = view.centre_u - view.focal * corner.y;
    corner.v = view.centre_v - view.focal * corner.z;
    return;
  }
  corner.nearness = 1.0f / corner.x;
  corner.u = view.centre_u - view.focal * corner.y * corner.nearness;
  corner.v = view.centre_v - view.focal * corner.z * corner.nearness;
}

inline int kept_inside(float pixel, int last) {
  return pixel > 0.0f ? (pixel < (float)last ? (int)pixel : last) : 0;
}

// The first pixel whose centre is at or past a coordinate, and the first whose centre is past it.
inline int first_at(float coordinate, int last) { return kept_inside(__builtin_ceilf(coordinate - 0.5f), last); }
inline int first_past(float coordinate, int last) { return kept_inside(__builtin_floorf(coordinate + 0.5f), last); }

// The nearer one is seen, of two that are as near the one with the lower number.
template <bool with_id>
inline void put(const Buffers& buffers, int at, I may, F nearness, F before, int32_t id) {
  I seen = may & (nearness > before);
  if constexpr (with_id) {
    const I other = load(buffers.id + at);
    seen |= may & (nearness == before) & (other > id);
    store(buffers.id + at, select(seen, splat(id), other));
  }
  store(buffers.nearness + at, select(seen, nearness, before));
}

// A triangle of any size: of as many tiles side by side those are looked at that it may be seen in. Rounding keeps order,
// so that what holds for a tile's best corner holds for all of it.
struct Large {
  Edge edges[3];
  float u, v, nearness, along_u, along_v, nearest;
  int32_t row0, row1, column0, column1, id;

  float nearness_at(float v) const { return nearness + along_v * (v - this->v); }

  template <bool with_id>
  void draw(const View& view, const Buffers& buffers) const {
    for (int top = row0 / kTileHeight * kTileHeight; top < row1; top += kTileHeight) {
      const float first_v = (float)top + 0.5f, last_v = first_v + (kTileHeight - 1);
      const float* hidden = buffers.hidden + top / kTileHeight * view.tile_stride();
      for (int left = column0 / (kTileWidth * kLanes) * kLanes; left * kTileWidth < column1; left += kLanes) {
        const F first_u = (counting() + (float)left) * (float)kTileWidth + 0.5f;
        const F last_u = first_u + (float)(kTileWidth - 1);
        I open = (last_u > (float)column0) & (first_u < (float)column1);
        const F best = nearness_at(along_v > 0.0f ? last_v : first_v) + along_u * ((along_u > 0.0f ? last_u : first_u) - u);
        open &= min(best, splat(nearest)) >= load(hidden + left);
        I within = (first_u > (float)column0) & (last_u < (float)column1);
        for (const Edge& edge : edges) {
          const F low = edge.dv > 0.0f ? first_u : last_u, high = edge.dv > 0.0f ? last_u : first_u;
          const float upper = edge.along_row(first_v), lower = edge.along_row(last_v);
          open &= edge.holds(high, least_of(upper, lower)), within &= edge.holds(low, most_of(upper, lower));
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
    F farthest = splat(3e38f);
    for (int row = first; row < last; ++row) {
      const float v = (float)row + 0.5f, row_nearness = nearness_at(v);
      const float along[3] = {edges[0].along_row(v), edges[1].along_row(v), edges[2].along_row(v)};
      for (int column = left; column < left + kTileWidth; column += kLanes) {
        const F u = counting() + ((float)column + 0.5f);
        const int at = row * view.stride + column;
        const F before = load(buffers.nearness + at);
        const F here = min(row_nearness + along_u * (u - this->u), splat(nearest));
        I inside = here >= before;
        if constexpr (!within) {
          inside &= (u > (float)column0) & (u < (float)column1);
          for (int i = 0; i < 3; ++i) inside &= edges[i].holds(u, along[i]);
        }
        farthest = min(select(inside, here, before), farthest);
        if (any(inside)) put<with_id>(buffers, at, inside, here, before, id);
      }
    }
    const bool whole = first == top && (last == top + kTileHeight || last == view.height);
    if (whole) buffers.hidden[top / kTileHeight * view.tile_stride() + left / kTileWidth] = least(farthest);
  }
};

// Counter-clockwise from outside; seen from behind, nothing is drawn.
template <bool with_id>
inline void draw_triangle(const View& view, const Solid& solid, const Buffers& buffers, const Corner& a, const Corner& b,
                          const Corner& c, int32_t id) {
  const double bu = (double)b.u - a.u, bv = (double)b.v - a.v, cu = (double)c.u - a.u, cv = (double)c.v - a.v;
  const double area = bu * cv - bv * cu;
  if (!(area < 0.0)) return;  // v runs downwards, so that front sides turn the other way
  int row0 = first_at(least_of(a.v, least_of(b.v, c.v)), view.height);
  int row1 = first_past(most_of(a.v, most_of(b.v, c.v)), view.height);
  row0 = row0 > solid.top ? row0 : solid.top, row1 = row1 < solid.bottom ? row1 : solid.bottom;
  const int column0 = first_at(least_of(a.u, least_of(b.u, c.u)), view.width);
  const int column1 = first_past(most_of(a.u, most_of(b.u, c.u)), view.width);
  if (column0 >= column1 || row0 >= row1) return;
  const double bn = (double)b.nearness - a.nearness, cn = (double)c.nearness - a.nearness, share = 1.0 / area;
  const float along_u = (float)((bn * cv - cn * bv) * share), along_v = (float)((cn * bu - bn * cu) * share);
  const float nearest = view.parallel ? -view.near_ : 1.0f / view.near_;
  const Large large = {{Edge(a, b), Edge(b, c), Edge(c, a)}, a.u, a.v, a.nearness, along_u, along_v, nearest,
                       row0, row1, column0, column1, id};
  large.draw<with_id>(view, buffers);
}

// Where an edge goes through the near plane, from its visible end on, so that both triangles at it find one point.
inline Corner cut(const View& view, const Corner& seen, const Corner& hidden) {
  const float share = (view.near_ - seen.x) / (hidden.x - seen.x);
  Corner corner{view.near_, seen.y + share * (hidden.y - seen.y), seen.z + share * (hidden.z - seen.z), 0, 0, 0};
  project(view, corner);
  return corner;
}

struct Corners {
  Corner at[3];
};

template <bool with_id>
inline void draw_clipped(const View& view, const Solid& solid, const Buffers& buffers, const Corners& corners, int32_t id) {
  Corner kept[4];
  int count = 0;
  for (int i = 0; i < 3; ++i) {
    const Corner &here = corners.at[i], &next = corners.at[(i + 1) % 3];
    const bool seen = here.x >= view.near_, next_seen = next.x >= view.near_;
    if (seen) kept[count++] = here;
    if (seen && !next_seen) kept[count++] = cut(view, here, next);
    if (!seen && next_seen) kept[count++] = cut(view, next, here);
  }
  for (int i = 2; i < count; ++i) draw_triangle<with_id>(view, solid, buffers, kept[0], kept[i - 1], kept[i], id);
}

// The vertices of a mesh as a view sees them, in rows as a mesh has them.
struct Projected {
  float *x, *y, *z, *u, *v, *nearness;

  Projected(float* room, int32_t count) {
    const int64_t row = (count + kWidest - 1) / kWidest * kWidest;
    x = room, y = x + row, z = y + row, u = z + row, v = u + row, nearness = v + row;
  }
  Corner corner(int32_t i) const { return {x[i], y[i], z[i], u[i], v[i], nearness[i]}; }

  // False where some may be hidden by the near plane.
  bool take(const View& view, const Solid& solid) {
    const Triangles& mesh = *solid.mesh;
    I hidden = I{};
    for (int32_t i = 0; i < mesh.vertex_count; i += kLanes) {
      const F3 p = turn_back(solid.axes, {load(mesh.places[0] + i), load(mesh.places[1] + i), load(mesh.places[2] + i)});
      const F ahead = solid.centre[0] + p.x, left = solid.centre[1] + p.y, up = solid.centre[2] + p.z;
      const F near = view.parallel ? -ahead : 1.0f / ahead;
      hidden |= ahead < view.near_;
      store(x + i, ahead), store(y + i, left), store(z + i, up), store(nearness + i, near);
      store(u + i, view.centre_u - (view.parallel ? view.focal * left : view.focal * left * near));
      store(v + i, view.centre_v - (view.parallel ? view.focal * up : view.focal * up * near));
    }
    return !any(hidden);
  }
};

constexpr float kSmall = 32.0f;  // [px] of triangles for which single precision is enough

// Edges of as many triangles, as `Edge` has them.
struct Edges {
  F u0, v0, du, dv, least;

  Edges(F au, F av, F bu, F bv) {
    const I ordered = (av < bv) | ((av == bv) & (au < bu));
    u0 = select(ordered, au, bu), v0 = select(ordered, av, bv);
    du = bu - au, dv = bv - av;
    least = select(ordered, splat(-1e-45f), F{});
  }
};

// As many triangles side by side, ready to be drawn one after the other.
struct Small {
  Edges ab, bc, ca;
  F au, av, an, along_u, along_v, lowest, highest;
  I row0, row1, column0, column1;

  template <bool with_id>
  void draw(const View& view, const Buffers& buffers, int i, int32_t id) const {
    const int last = view.stride - kLanes, right = column1[i], bottom = row1[i];
    for (int column = column0[i]; column < right; column += kLanes) {
      const int from = column < last ? column : last;
      const F u = counting() + ((float)from + 0.5f);
      const I within = (u > (float)column) & (u < (float)right);
      const F on_ab = select(within, (u - ab.u0[i]) * ab.dv[i], splat(-3e38f));
      const F on_bc = (u - bc.u0[i]) * bc.dv[i], on_ca = (u - ca.u0[i]) * ca.dv[i];
      const F slope = along_u[i] * (u - au[i]);
      for (int row = row0[i]; row < bottom; ++row) {
        const float v = (float)row + 0.5f;
        const I inside = (on_ab - (v - ab.v0[i]) * ab.du[i] > ab.least[i]) &
                         (on_bc - (v - bc.v0[i]) * bc.du[i] > bc.least[i]) &
                         (on_ca - (v - ca.v0[i]) * ca.du[i] > ca.least[i]);
        const F nearness = max(min(slope + (an[i] + along_v[i] * (v - av[i])), splat(highest[i])), splat(lowest[i]));
        const int at = row * view.stride + from;
        const F before = load(buffers.nearness + at);
        put<with_id>(buffers, at, inside, nearness, before, id);
      }
    }
  }
};

inline F least_of(F a, F b, F c) { return min(min(a, b), c); }
inline F most_of(F a, F b, F c) { return max(max(a, b), c); }

// As `first_at` and `first_past`.
inline I first_at(F coordinate, int last) {
  return to_int(-floor(-max(min(coordinate - 0.5f, splat((float)last)), F{})));
}
inline I first_past(F coordinate, int last) { return to_int(max(min(coordinate + 0.5f, splat((float)last)), F{})); }

// Which triangles are hidden in all tiles that they are in. Of those in more than two by two, nothing is said.
inline I is_hidden(const View& view, const Buffers& buffers, I mask, I row0, I row1, I column0, I column1, F nearest) {
  static_assert(kTileWidth == 16 && kTileHeight == 8);
  const I top = row0 >> 3, bottom = (row1 - 1) >> 3, left = column0 >> 4, right = (column1 - 1) >> 4;
  mask &= (bottom - top <= 1) & (right - left <= 1);
  const I upper = top * view.tile_stride(), lower = bottom * view.tile_stride();
  const auto at = [&](I tile) { return gather(buffers.hidden, tile & mask); };
  const F least = min(min(at(upper + left), at(upper + right)), min(at(lower + left), at(lower + right)));
  return mask & (nearest < least);
}

// A stride that leads once to each of so many things, and early to all parts of them.
inline int32_t apart(int32_t count) {
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
inline void draw_faces(const View& view, const Solid& solid, const Buffers& buffers) {
  const Triangles& mesh = *solid.mesh;
  Projected seen(buffers.projected, mesh.vertex_count);
  const bool whole = seen.take(view, solid);
  int32_t count = 0;
  for (int32_t first = 0; first < mesh.face_count; first += kLanes) {
    const I a = load(mesh.corners[0] + first), b = load(mesh.corners[1] + first), c = load(mesh.corners[2] + first);
    const F au = gather(seen.u, a), av = gather(seen.v, a), bu = gather(seen.u, b), bv = gather(seen.v, b);
    const F cu = gather(seen.u, c), cv = gather(seen.v, c);
    const F low_u = least_of(au, bu, cu), high_u = most_of(au, bu, cu);
    const F low_v = least_of(av, bv, cv), high_v = most_of(av, bv, cv);
    const F ab_u = bu - au, ab_v = bv - av, ac_u = cu - au, ac_v = cv - av;
    const F area = ab_u * ac_v - ab_v * ac_u;
    const I small = (high_u - low_u <= kSmall) & (high_v - low_v <= kSmall);
    I row0 = first_at(low_v, view.height), row1 = first_past(high_v, view.height);
    row0 = select(row0 > solid.top, row0, splat(solid.top)), row1 = min_of(row1, solid.bottom);
    const I column0 = first_at(low_u, view.width), column1 = first_past(high_u, view.width);
    // v runs downwards, so that front sides turn the other way.
    I drawn = (row0 < row1) & (column0 < column1) & (area < 0.0f) & small;
    I others = ~small & (a != b);
    if (!whole) {
      const F ax = gather(seen.x, a), bx = gather(seen.x, b), cx = gather(seen.x, c);
      const I all = least_of(ax, bx, cx) >= view.near_;
      others = (a != b) & (most_of(ax, bx, cx) >= view.near_) & (~all | ~small);
      drawn &= all;
    }
    if (any(drawn)) {
      const F an = gather(seen.nearness, a), bn = gather(seen.nearness, b), cn = gather(seen.nearness, c);
      drawn &= ~is_hidden(view, buffers, drawn, row0, row1, column0, column1, most_of(an, bn, cn));
      const F share = 1.0f / area, ab_n = bn - an, ac_n = cn - an;
      const Small batch = {Edges(au, av, bu, bv), Edges(bu, bv, cu, cv), Edges(cu, cv, au, av), au, av, an,
                           (ab_n * ac_v - ac_n * ab_v) * share, (ac_n * ab_u - ab_n * ac_u) * share,
                           least_of(an, bn, cn), most_of(an, bn, cn), row0, row1, column0, column1};
      for (uint32_t left = bits(drawn); left; left &= left - 1) {
        const int i = __builtin_ctz(left);
        batch.draw<with_id>(view, buffers, i, solid.first_id + first + i);
      }
    }
    for (uint32_t left = bits(others); left; left &= left - 1) buffers.large[count++] = first + __builtin_ctz(left);
  }
  // Not one after the other: so many that lie behind one another, the farthest first, would all be drawn.
  const int32_t stride = apart(count);
  for (int32_t i = 0, at = 0; i < count; ++i, at = at < count - stride ? at + stride : at + stride - count) {
    const int32_t face = buffers.large[at];
    const auto corner = [&](int k) { return seen.corner(mesh.corners[k][face]); };
    draw_clipped<with_id>(view, solid, buffers, {{corner(0), corner(1), corner(2)}}, solid.first_id + face);
  }
}

inline void see_mesh(const View& view, const Solid& solid, const Buffers& buffers) {
  if (buffers.id) return draw_faces<true>(view, solid, buffers);
  draw_faces<false>(view, solid, buffers);
}

}  // namespace trundle::TRUNDLE_ISA
