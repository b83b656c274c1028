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
inline void draw_triangle(const View& view, const Buffers& buffers, const Corner& a, const Corner& b, const Corner& c,
                          int32_t id) {
  const double bu = (double)b.u - a.u, bv = (double)b.v - a.v, cu = (double)c.u - a.u, cv = (double)c.v - a.v;
  const double area = bu * cv - bv * cu;
  if (!(area < 0.0)) return;  // v runs downwards, so that front sides turn the other way
  const int row0 = first_at(least_of(a.v, least_of(b.v, c.v)), view.height);
  const int row1 = first_past(most_of(a.v, most_of(b.v, c.v)), view.height);
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

inline void draw_clipped(const View& view, const Buffers& buffers, const Corner* corners[3], int32_t id) {
  Corner kept[4];
  int count = 0;
  for (int i = 0; i < 3; ++i) {
    const Corner &here = *corners[i], &next = *corners[(i + 1) % 3];
    const bool seen = here.x >= view.near_, next_seen = next.x >= view.near_;
    if (seen) kept[count++] = here;
    if (seen && !next_seen) kept[count++] = cut(view, here, next);
    if (!seen && next_seen) kept[count++] = cut(view, next, here);
  }
  for (int i = 2; i < count; ++i) draw_triangle(view, buffers, kept[0], kept[i - 1], kept[i], id);
}

inline void see_mesh(const View& view, const Solid& solid, const Buffers& buffers) {
  const Triangles& mesh = *solid.mesh;
  const float *axes = solid.axes, *centre = solid.centre;
  Corner* corners = (Corner*)buffers.projected;
  for (int i = 0; i < mesh.vertex_count; ++i) {
    const float *p = mesh.vertices + 3 * (int64_t)i;
    Corner& corner = corners[i];
    corner.x = centre[0] + (axes[0] * p[0] + axes[3] * p[1] + axes[6] * p[2]);
    corner.y = centre[1] + (axes[1] * p[0] + axes[4] * p[1] + axes[7] * p[2]);
    corner.z = centre[2] + (axes[2] * p[0] + axes[5] * p[1] + axes[8] * p[2]);
    project(view, corner);
  }
  for (int i = 0; i < mesh.face_count; ++i) {
    const int32_t* face = mesh.faces + 3 * (int64_t)i;
    const Corner* at[3] = {&corners[face[0]], &corners[face[1]], &corners[face[2]]};
    const int seen = (at[0]->x >= view.near_) + (at[1]->x >= view.near_) + (at[2]->x >= view.near_);
    if (seen == 3)
      draw_triangle(view, buffers, *at[0], *at[1], *at[2], solid.first_id + i);
    else if (seen > 0)
      draw_clipped(view, buffers, at, solid.first_id + i);
  }
}

}  // namespace trundle::TRUNDLE_ISA
