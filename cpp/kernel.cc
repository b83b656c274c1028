// Visibility, then light: what every pixel sees first, then its colour once. Compiled once per instruction set; nothing
// of the standard library is used here, so that no copy of it for one instruction set is linked into another.
#include "kernel.h"

#include "cast.h"
#include "intersect.h"
#include "lanes.h"
#include "noise.h"
#include "pixels.h"
#include "raster.h"
#include "shade.h"

namespace trundle::TRUNDLE_ISA {
namespace {

// Where rays start and how they run, in the shape's frame, a row at a time.
template <bool parallel>
struct Rays {
  const View& view;
  const Solid& solid;
  float step, z;

  Rays(const View& view, const Solid& solid) : view(view), solid(solid), step(1.0f / view.focal), z(0.0f) {}
  void begin_row(int row) { z = (view.centre_v - ((float)row + 0.5f)) * step; }
  template <Kind kind>
  Meeting<F> meet_at(F u) const {
    const float* axes = solid.axes;
    const F y = (view.centre_u - u) * step;
    const F3 across = {axes[2] * z + axes[1] * y, axes[5] * z + axes[4] * y, axes[8] * z + axes[7] * y};
    const F3 ahead = {splat(axes[0]), splat(axes[3]), splat(axes[6])};
    if constexpr (parallel) return meet<kind>(solid.size, splat(solid.eye) + across, ahead);
    return meet<kind>(solid.size, splat(solid.eye), ahead + across);
  }
};

template <Kind kind, bool parallel, bool with_id>
void see_along(const View& view, const Solid& solid, const Buffers& buffers) {
  Rays<parallel> rays(view, solid);
  const float nearest = parallel ? -view.near_ : 1.0f / view.near_;
  const int first = solid.left / kLanes * kLanes;
  for (int row = solid.top; row < solid.bottom; ++row) {
    rays.begin_row(row);
    const float* hidden = buffers.hidden + row / kTileHeight * view.tile_stride();
    for (int column = first; column < solid.right; column += kLanes) {
      if (solid.nearest < hidden[column / kTileWidth]) continue;
      const F u = counting() + ((float)column + 0.5f);
      const Meeting<F> met = rays.template meet_at<kind>(u);
      const F nearness = parallel ? -met.depth : 1.0f / met.depth;
      const int at = row * view.stride + column;
      const F before = load(buffers.nearness + at);
      const I may = met.hit & (nearness <= nearest) & (u > (float)solid.left) & (u < (float)solid.right);
      if (!any(may & (nearness >= before))) continue;
      put<with_id>(buffers, at, may, nearness, before, solid.first_id);
    }
  }
}

template <Kind kind>
void see_solid(const View& view, const Solid& solid, const Buffers& buffers) {
  if (view.parallel) return see_along<kind, true, false>(view, solid, buffers);
  if (!buffers.id) return see_along<kind, false, false>(view, solid, buffers);
  see_along<kind, false, true>(view, solid, buffers);
}

void see(const View& view, const Solid& solid, const Buffers& buffers) {
  switch (solid.kind) {
    case Kind::kPlane: return see_solid<Kind::kPlane>(view, solid, buffers);
    case Kind::kBox: return see_solid<Kind::kBox>(view, solid, buffers);
    case Kind::kSphere: return see_solid<Kind::kSphere>(view, solid, buffers);
    case Kind::kCylinder: return see_solid<Kind::kCylinder>(view, solid, buffers);
    case Kind::kCapsule: return see_solid<Kind::kCapsule>(view, solid, buffers);
    case Kind::kEllipsoid: return see_solid<Kind::kEllipsoid>(view, solid, buffers);
    case Kind::kMesh: return see_mesh(view, solid, buffers);
  }
}

void settle(const View& view, const Solid& solid, const Buffers& buffers) {
  const int first = solid.left / kTileWidth, last = (solid.right - 1) / kTileWidth;
  for (int top = solid.top / kTileHeight; top <= (solid.bottom - 1) / kTileHeight; ++top)
    for (int left = first; left <= last; ++left) {
      const int bottom = (top + 1) * kTileHeight < view.height ? (top + 1) * kTileHeight : view.height;
      F farthest = splat(3e38f);
      for (int row = top * kTileHeight; row < bottom; ++row)
        for (int column = 0; column < kTileWidth; column += kLanes)
          farthest = min(load(buffers.nearness + row * view.stride + left * kTileWidth + column), farthest);
      buffers.hidden[top * view.tile_stride() + left] = least(farthest);
    }
}

void fill(const View& view, const Sky& sky, int32_t top, int32_t bottom, const Buffers& buffers) {
  const float step = 1.0f / view.focal;
  float more[3];
  bool is_even = true;
  for (int i = 0; i < 3; ++i) more[i] = sky.zenith[i] - sky.horizon[i], is_even &= more[i] == 0.0f;
  for (int row = top; row < bottom; ++row) {
    const float z = (view.centre_v - ((float)row + 0.5f)) * step;
    for (int column = 0; column < view.stride; column += kLanes) {
      const int at = row * view.stride + column;
      const I none = load(buffers.id + at) < 0;
      if (!any(none)) continue;
      I word = splat(sky.even);
      if (!is_even) {
        const F y = (view.centre_u - (counting() + ((float)column + 0.5f))) * step;
        const F up = (sky.up[0] + sky.up[1] * y + sky.up[2] * z) / sqrt(1.0f + y * y + z * z);
        const F share = sqrt(max(up, F{}));
        const I high = to_byte(sky.horizon[0] + share * more[0]) | to_byte(sky.horizon[1] + share * more[1]) << 8 |
                       to_byte(sky.horizon[2] + share * more[2]) << 16;
        word = select(up > 0.0f, high, word);
      }
      store(buffers.colour + at, word);
    }
  }
}

void shade(const View& view, const Solid& solid, const Lighting& lighting, const Buffers& buffers) {
  switch (solid.kind) {
    case Kind::kPlane: return shade_solid<Kind::kPlane>(view, solid, lighting, buffers);
    case Kind::kBox: return shade_solid<Kind::kBox>(view, solid, lighting, buffers);
    case Kind::kSphere: return shade_solid<Kind::kSphere>(view, solid, lighting, buffers);
    case Kind::kCylinder: return shade_solid<Kind::kCylinder>(view, solid, lighting, buffers);
    case Kind::kCapsule: return shade_solid<Kind::kCapsule>(view, solid, lighting, buffers);
    case Kind::kEllipsoid: return shade_solid<Kind::kEllipsoid>(view, solid, lighting, buffers);
    case Kind::kMesh: return shade_solid<Kind::kMesh>(view, solid, lighting, buffers);
  }
}

}  // namespace

#define TRUNDLE_TEXT(name) #name
#define TRUNDLE_NAME(name) TRUNDLE_TEXT(name)
extern const Kernel kernel;
const Kernel kernel = {TRUNDLE_NAME(TRUNDLE_ISA), see, settle, fill, shade, cast, develop,
                       add_depth_noise, add_colour_noise, clip_depths, fill_cloud};

}  // namespace trundle::TRUNDLE_ISA
