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

// Counter-clockwise from outside; seen from behind, nothing is drawn.
inline void draw_triangle(const View& view, const Solid& solid, const Buffers& buffers, const Corner& a, const Corner& b, const Corner& c,
                          int32_t id) {
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
  const Edge ab(a, b), bc(b, c), ca(c, a);
  const float nearest = view.parallel ? -view.near_ : 1.0f / view.near_;
  const int start = column0 < view.stride - kLanes ? column0 : view.stride - kLanes;
  for (int row = row0; row < row1; ++row) {
    const float v = (float)row + 0.5f;
    const float row_nearness = a.nearness + along_v * (v - a.v);
    const float row_ab = ab.along_row(v), row_bc = bc.along_row(v), row_ca = ca.along_row(v);
    for (int column = start; column < column1; column += kLanes) {
      // Not beyond the row: what is left of the last columns is looked at twice, and is the same.
      const int from = column < view.stride - kLanes ? column : view.stride - kLanes;
      const F u = counting() + ((float)from + 0.5f);
      const I inside = ab.holds(u, row_ab) & bc.holds(u, row_bc) & ca.holds(u, row_ca);
      if (!any(inside)) continue;
      const int at = row * view.stride + from;
      const F nearness = min(row_nearness + along_u * (u - a.u), splat(nearest));
      const F before = load(buffers.nearness + at);
      const I seen = inside & (nearness > before);
      store(buffers.nearness + at, select(seen, nearness, before));
      if (buffers.id) store(buffers.id + at, select(seen, splat(id), load(buffers.id + at)));
    }
  }
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
  for (int i = 2; i < count; ++i) draw_triangle(view, solid, buffers, kept[0], kept[i - 1], kept[i], id);
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
        const I seen = inside & (nearness > before);
        store(buffers.nearness + at, select(seen, nearness, before));
        if constexpr (with_id) store(buffers.id + at, select(seen, splat(id), load(buffers.id + at)));
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

template <bool with_id>
inline void draw_faces(const View& view, const Solid& solid, const Buffers& buffers) {
  const Triangles& mesh = *solid.mesh;
  Projected seen(buffers.projected, mesh.vertex_count);
  const bool whole = seen.take(view, solid);
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
      const F share = 1.0f / area, ab_n = bn - an, ac_n = cn - an;
      const Small batch = {Edges(au, av, bu, bv), Edges(bu, bv, cu, cv), Edges(cu, cv, au, av), au, av, an,
                           (ab_n * ac_v - ac_n * ab_v) * share, (ac_n * ab_u - ab_n * ac_u) * share,
                           least_of(an, bn, cn), most_of(an, bn, cn), row0, row1, column0, column1};
      for (uint32_t left = bits(drawn); left; left &= left - 1) {
        const int i = __builtin_ctz(left);
        batch.draw<with_id>(view, buffers, i, solid.first_id + first + i);
      }
    }
    for (uint32_t left = bits(others); left; left &= left - 1) {
      const int i = __builtin_ctz(left);
      draw_clipped(view, solid, buffers, {{seen.corner(a[i]), seen.corner(b[i]), seen.corner(c[i])}}, solid.first_id + first + i);
    }
  }
}

inline void see_mesh(const View& view, const Solid& solid, const Buffers& buffers) {
  if (buffers.id) return draw_faces<true>(view, solid, buffers);
  draw_faces<false>(view, solid, buffers);
}

}  // namespace trundle::TRUNDLE_ISA
