// Visibility, then light: what every pixel sees first, then its colour once. Compiled once per instruction set; nothing
// of the standard library is used here, so that no copy of it for one instruction set is linked into another.
#include "kernel.h"

#include "intersect.h"
#include "lanes.h"
#include "raster.h"
#include "shade.h"

namespace trundle::TRUNDLE_ISA {
namespace {

template <Kind kind>
void see_solid(const View& view, const Solid& solid, const Buffers& buffers) {
  const float* axes = solid.axes;
  const float step = 1.0f / view.focal, nearest = 1.0f / view.near_;
  const F3 eye = {splat(solid.eye[0]), splat(solid.eye[1]), splat(solid.eye[2])};
  const int first = solid.left / kLanes * kLanes;
  for (int row = solid.top; row < solid.bottom; ++row) {
    const float z = (view.centre_v - ((float)row + 0.5f)) * step;
    const float rx = axes[0] + axes[2] * z, ry = axes[3] + axes[5] * z, rz = axes[6] + axes[8] * z;
    for (int column = first; column < solid.right; column += kLanes) {
      const F u = counting() + ((float)column + 0.5f);
      const F y = (view.centre_u - u) * step;
      const Meeting met = meet<kind>(solid, eye, {rx + axes[1] * y, ry + axes[4] * y, rz + axes[7] * y});
      const F nearness = 1.0f / met.depth;
      const int at = row * view.stride + column;
      const F before = load(buffers.nearness + at);
      const I seen = met.hit & (nearness > before) & (nearness <= nearest) & (u > (float)solid.left) &
                     (u < (float)solid.right);
      if (!any(seen)) continue;
      store(buffers.nearness + at, select(seen, nearness, before));
      store(buffers.id + at, select(seen, splat(solid.first_id), load(buffers.id + at)));
    }
  }
}

template <Kind kind>
struct NormalOf {
  F3 operator()(const View&, const Solid& solid, const F3& point, I, I) const {
    const float* axes = solid.axes;
    const F3 local = {
        solid.eye[0] + axes[0] * point.x + axes[1] * point.y + axes[2] * point.z,
        solid.eye[1] + axes[3] * point.x + axes[4] * point.y + axes[5] * point.z,
        solid.eye[2] + axes[6] * point.x + axes[7] * point.y + axes[8] * point.z,
    };
    return normal_at<kind>(solid, local);
  }
};

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

void shade(const View& view, const Solid& solid, const Lighting& lighting, const Buffers& buffers) {
  switch (solid.kind) {
    case Kind::kPlane: return shade_solid(view, solid, lighting, buffers, NormalOf<Kind::kPlane>());
    case Kind::kBox: return shade_solid(view, solid, lighting, buffers, NormalOf<Kind::kBox>());
    case Kind::kSphere: return shade_solid(view, solid, lighting, buffers, NormalOf<Kind::kSphere>());
    case Kind::kCylinder: return shade_solid(view, solid, lighting, buffers, NormalOf<Kind::kCylinder>());
    case Kind::kCapsule: return shade_solid(view, solid, lighting, buffers, NormalOf<Kind::kCapsule>());
    case Kind::kEllipsoid: return shade_solid(view, solid, lighting, buffers, NormalOf<Kind::kEllipsoid>());
    case Kind::kMesh: return shade_solid(view, solid, lighting, buffers, NormalOfFace());
  }
}

}  // namespace

#define TRUNDLE_TEXT(name) #name
#define TRUNDLE_NAME(name) TRUNDLE_TEXT(name)
extern const Kernel kernel;
const Kernel kernel = {TRUNDLE_NAME(TRUNDLE_ISA), see, shade};

}  // namespace trundle::TRUNDLE_ISA
