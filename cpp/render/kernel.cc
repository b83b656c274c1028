// Deferred rendering: visibility first, then each pixel is shaded once. Compiled once per instruction set; the standard
// library is not used here, so that no copy of it for one instruction set is linked into another.
#include "kernel.h"

#include "image_noise.h"
#include "intersect.h"
#include "pixels.h"
#include "raster.h"
#include "ray_cast.h"
#include "shade.h"
#include "simd.h"

namespace trundle::TRUNDLE_ISA {
namespace {

// Rays through the pixels of a row, in a shape's frame.
template <bool orthographic>
struct PixelRays {
  const View& view;
  const Renderable& renderable;
  float step, z;

  PixelRays(const View& view, const Renderable& renderable)
      : view(view), renderable(renderable), step(1.0f / view.focal), z(0.0f) {}
  void begin_row(int row) { z = (view.centre_v - (static_cast<float>(row) + 0.5f)) * step; }
  template <ShapeKind kind>
  RayHit<Floats> hit_at(Floats u) const {
    const float* axes = renderable.axes;
    const Floats y = (view.centre_u - u) * step;
    const Floats3 across = {axes[2] * z + axes[1] * y, axes[5] * z + axes[4] * y, axes[8] * z + axes[7] * y};
    const Floats3 ahead = {splat(axes[0]), splat(axes[3]), splat(axes[6])};
    if constexpr (orthographic) return intersect<kind>(renderable.size, splat(renderable.eye) + across, ahead);
    return intersect<kind>(renderable.size, splat(renderable.eye), ahead + across);
  }
};

template <ShapeKind kind, bool orthographic, bool with_id>
void rasterize_rays(const View& view, const Renderable& renderable, const Buffers& buffers) {
  PixelRays<orthographic> rays(view, renderable);
  const float near_limit = orthographic ? -view.near_ : 1.0f / view.near_;
  const int first = renderable.left / kLanes * kLanes;
  for (int row = renderable.top; row < renderable.bottom; ++row) {
    rays.begin_row(row);
    const float* hi_z = buffers.hi_z + row / kTileHeight * view.tile_stride();
    for (int column = first; column < renderable.right; column += kLanes) {
      if (renderable.max_inverse_depth < hi_z[column / kTileWidth]) continue;
      const Floats u = lane_indices() + (static_cast<float>(column) + 0.5f);
      const RayHit<Floats> hit = rays.template hit_at<kind>(u);
      const Floats inverse_depth = orthographic ? -hit.depth : 1.0f / hit.depth;
      const int at = row * view.stride + column;
      const Floats old = load(buffers.inverse_depth + at);
      const Ints mask = hit.mask & (inverse_depth <= near_limit) & (u > static_cast<float>(renderable.left)) &
                        (u < static_cast<float>(renderable.right));
      if (!any(mask & (inverse_depth >= old))) continue;
      write_pixels<with_id>(buffers, at, mask, inverse_depth, old, renderable.first_id);
    }
  }
}

template <ShapeKind kind>
void rasterize_shape(const View& view, const Renderable& renderable, const Buffers& buffers) {
  if (view.orthographic) return rasterize_rays<kind, true, false>(view, renderable, buffers);
  if (!buffers.id) return rasterize_rays<kind, false, false>(view, renderable, buffers);
  rasterize_rays<kind, false, true>(view, renderable, buffers);
}

void rasterize(const View& view, const Renderable& renderable, const Buffers& buffers) {
  switch (renderable.kind) {
    case ShapeKind::kPlane: return rasterize_shape<ShapeKind::kPlane>(view, renderable, buffers);
    case ShapeKind::kBox: return rasterize_shape<ShapeKind::kBox>(view, renderable, buffers);
    case ShapeKind::kSphere: return rasterize_shape<ShapeKind::kSphere>(view, renderable, buffers);
    case ShapeKind::kCylinder: return rasterize_shape<ShapeKind::kCylinder>(view, renderable, buffers);
    case ShapeKind::kCapsule: return rasterize_shape<ShapeKind::kCapsule>(view, renderable, buffers);
    case ShapeKind::kEllipsoid: return rasterize_shape<ShapeKind::kEllipsoid>(view, renderable, buffers);
    case ShapeKind::kMesh: return rasterize_mesh(view, renderable, buffers);
  }
}

void update_hi_z(const View& view, const Renderable& renderable, const Buffers& buffers) {
  const int first = renderable.left / kTileWidth, last = (renderable.right - 1) / kTileWidth;
  for (int top = renderable.top / kTileHeight; top <= (renderable.bottom - 1) / kTileHeight; ++top)
    for (int left = first; left <= last; ++left) {
      const int bottom = (top + 1) * kTileHeight < view.height ? (top + 1) * kTileHeight : view.height;
      Floats farthest = splat(3e38f);
      for (int row = top * kTileHeight; row < bottom; ++row)
        for (int column = 0; column < kTileWidth; column += kLanes)
          farthest = min(load(buffers.inverse_depth + row * view.stride + left * kTileWidth + column), farthest);
      buffers.hi_z[top * view.tile_stride() + left] = reduce_min(farthest);
    }
}

void fill_sky(const View& view, const Sky& sky, int32_t top, int32_t bottom, const Buffers& buffers) {
  const float step = 1.0f / view.focal;
  float range[3];
  bool is_uniform = true;
  for (int i = 0; i < 3; ++i) {
    range[i] = sky.zenith[i] - sky.horizon[i];
    is_uniform &= range[i] == 0.0f;
  }
  for (int row = top; row < bottom; ++row) {
    const float z = (view.centre_v - (static_cast<float>(row) + 0.5f)) * step;
    for (int column = 0; column < view.stride; column += kLanes) {
      const int at = row * view.stride + column;
      const Ints empty = load(buffers.id + at) < 0;
      if (!any(empty)) continue;
      Ints word = splat(sky.packed_horizon);
      if (!is_uniform) {
        const Floats y = (view.centre_u - (lane_indices() + (static_cast<float>(column) + 0.5f))) * step;
        const Floats up = (sky.up[0] + sky.up[1] * y + sky.up[2] * z) / sqrt(1.0f + y * y + z * z);
        const Floats share = sqrt(max(up, Floats{}));
        const Ints high = to_byte(sky.horizon[0] + share * range[0]) | to_byte(sky.horizon[1] + share * range[1]) << 8 |
                          to_byte(sky.horizon[2] + share * range[2]) << 16;
        word = select(up > 0.0f, high, word);
      }
      store(buffers.color + at, word);
    }
  }
}

void shade(const View& view, const Renderable& renderable, const Lighting& lighting, const Buffers& buffers) {
  switch (renderable.kind) {
    case ShapeKind::kPlane: return shade_shape<ShapeKind::kPlane>(view, renderable, lighting, buffers);
    case ShapeKind::kBox: return shade_shape<ShapeKind::kBox>(view, renderable, lighting, buffers);
    case ShapeKind::kSphere: return shade_shape<ShapeKind::kSphere>(view, renderable, lighting, buffers);
    case ShapeKind::kCylinder: return shade_shape<ShapeKind::kCylinder>(view, renderable, lighting, buffers);
    case ShapeKind::kCapsule: return shade_shape<ShapeKind::kCapsule>(view, renderable, lighting, buffers);
    case ShapeKind::kEllipsoid: return shade_shape<ShapeKind::kEllipsoid>(view, renderable, lighting, buffers);
    case ShapeKind::kMesh: return shade_shape<ShapeKind::kMesh>(view, renderable, lighting, buffers);
  }
}

}  // namespace

#define TRUNDLE_TEXT(name) #name
#define TRUNDLE_NAME(name) TRUNDLE_TEXT(name)
extern const Kernel kernel;
const Kernel kernel = {TRUNDLE_NAME(TRUNDLE_ISA), rasterize,       update_hi_z, fill_sky,  shade, cast_rays, resolve,
                       add_depth_noise,           add_color_noise, clip_depths, fill_cloud};

}  // namespace trundle::TRUNDLE_ISA
