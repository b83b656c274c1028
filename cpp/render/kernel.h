// Data of the render kernels: plain numbers in the camera frame, and one function table per instruction set.
#pragma once

#include <cstdint>

namespace trundle {

constexpr int kMaxLanes = 16;  // lanes of the widest instruction set; buffer rows are padded to this number
constexpr int kMaxMipLevels = 15;
constexpr int kTileWidth = kMaxLanes, kTileHeight = 8;  // [px] of a hierarchical-z tile

enum class ShapeKind : int32_t { kPlane, kBox, kSphere, kCylinder, kCapsule, kEllipsoid, kMesh };
enum class LightKind : int32_t { kDirectional, kPoint, kSpot };
enum class FogKind : int32_t { kNone, kLinear, kExponential, kSquared };

// Image plane of a camera that looks along +x, with y to the left and z up. An orthographic view is a directional
// light's: its focal length is in px/m, and it has no near plane.
struct View {
  int32_t width, height, stride;
  float centre_u, centre_v;  // principal point [px]
  float focal;               // [px]
  float near_, far_;         // [m]
  bool orthographic;

  // Tiles per row of tiles, padding included.
  int32_t tile_stride() const { return (stride / kTileWidth + kMaxLanes - 1) / kMaxLanes * kMaxLanes; }
};

// Triangle mesh, one array per axis and per corner, padded to kMaxLanes with zero-area faces.
struct Triangles {
  const float* positions[3];  // x, y and z of the vertices [m]
  const int32_t* corners[3];  // vertex indices of each face, counter-clockwise seen from outside
  const float* normals;       // (face_count, 4): outward unit normal, 0
  const float* uv_planes;     // (face_count, 8): u and v as planes, gradient [1/m] and value at the origin; may be null
  const float* normal_planes;  // (face_count, 12): interpolated x, y and z of the normal as planes; may be null
  int32_t vertex_count, face_count;
};

constexpr int kMaxStack = 1024;  // nodes on a traversal's stack

constexpr int kLeafSize = 8;  // triangles of a leaf, tested side by side

// kMaxLanes child boxes; below each are `count` leaves from `first` on or, with count 0, the node `first`. Unused
// children are empty boxes.
struct BvhNode {
  float low[3][kMaxLanes], high[3][kMaxLanes];
  int32_t first[kMaxLanes], count[kMaxLanes];
};

// Triangles as a corner, the two edges from it and their cross product. Unused ones have no area.
struct BvhLeaf {
  float corner[3][kLeafSize], edges[2][3][kLeafSize], normal[3][kLeafSize];
};

struct BvhView {
  const BvhNode* nodes;
  const BvhLeaf* leaves;
};

// Mipmapped image. It repeats: each level holds its first column and row again after the last ones.
struct Texture {
  const int32_t* texels;  // red | green << 8 | blue << 16, bottom row first
  int32_t level_count;
  int32_t width[kMaxMipLevels], height[kMaxMipLevels], start[kMaxMipLevels];
};

// Blinn-Phong material.
struct Material {
  float ambient[3], diffuse[3], specular[3], emissive[3];
  float shininess;
  float opacity;
  const Texture* texture;  // multiplies ambient and diffuse; may be null
  float repeat[2];         // repetitions along u and v, about the centre
};

// Shape transformed into one view.
struct Renderable {
  ShapeKind kind;
  float size[3];                     // half lengths, radii; a plane's half lengths, 0 for infinite
  float axes[9];                     // rows: the shape's axes in the camera frame
  float eye[3];                      // the camera in the shape's frame [m]
  float centre[3];                   // the shape's origin in the camera frame [m]
  int32_t left, top, right, bottom;  // screen bounds, right and bottom excluded
  float max_inverse_depth;           // inverse depth of the nearest point
  int32_t first_id;                  // visible pixels hold first_id + face
  int32_t id_count;
  int32_t index;  // in the scene
  const Triangles* mesh;
  float lod_error;  // distance by which this level of detail may differ from the shadow caster's [m]
  const Material* material;
};

// Shape seen from the common origin of rays: culled in single precision, intersected in double.
struct RayTarget {
  ShapeKind kind;
  int32_t index;           // in the scene
  double size[3];          // as a Renderable's
  double axes[9], eye[3];  // as a Renderable's; a sphere's eye in the rays' frame
  float axes_f32[9], eye_f32[3];
  float centre[3];                // of the bounding sphere, in the rays' frame [m]
  float radius;                   // of the bounding sphere [m]; < 0: infinite
  float tangent_squared;          // squared length of a tangent from the origin to the bounding sphere [m²]
  float moment[3];                // Plücker moment of the bounding cylinder's axis [m]
  float moment_length;            // [m]
  float cylinder_radius_squared;  // [m²]
  BvhView bvh;
};

// Bounding spheres and infinite bounding cylinders of kMaxLanes targets, as RayTarget holds them.
struct BoundingVolumes {
  float centre[3][kMaxLanes], radius[kMaxLanes], moment[3][kMaxLanes], moment_length[kMaxLanes],
      cylinder_radius_squared[kMaxLanes];
};

// Depth image from a light. A point is in shadow if the image has a smaller depth.
struct ShadowMap {
  const float* inverse_depth;           // (height, stride), as Buffers'
  const float* tile_max_inverse_depth;  // of each tile: the largest of its texels and their right and lower neighbours
  View view;
  float rotation[9], translation[3];  // view_from_camera
  float texel;                        // width of a texel [m]; in a perspective view, at 1 m
};

struct Light {
  LightKind kind;
  float to_light[3];  // unit, in the camera frame; opposite to the light's direction
  float position[3];  // in the camera frame; unused by directional lights
  float diffuse[3], specular[3];
  float constant, linear, quadratic, range;  // attenuation of point and spot lights
  float cos_inner, cos_outer, falloff;       // cone of spot lights, by half angles
  const ShadowMap* shadow;                   // may be null
};

struct Fog {
  FogKind kind;
  float color[3];
  float start, end, density;
};

struct Lighting {
  float ambient[3];
  const Light* lights;
  int32_t light_count;
  Fog fog;
};

// Background: one color, or a gradient from the horizon up.
struct Sky {
  float horizon[3], zenith[3];
  float up[3];             // world's z axis in the camera frame
  int32_t packed_horizon;  // the horizon's color as in Buffers::color, used below it and where both are equal
};

// Rows of `stride` numbers.
struct Buffers {
  float* inverse_depth;   // 1 / depth [1/m]; orthographic: -depth [m]; infinite in the padding
  int32_t* id;            // id of the visible face, -1 for none; null: not needed
  int32_t* color;         // red | green << 8 | blue << 16
  int32_t* segmentation;  // index of the shape, or -1; may be null
  float* hi_z;            // inverse depth of each tile, below which a fragment is hidden
  float* projected;       // scratch: 6 rows of the largest mesh's vertices
  int32_t* large_faces;   // scratch: face indices of the largest mesh
};

// Gaussian noise, reproducible from its key.
struct Noise {
  uint32_t key[2];
  float mean, stddev;
};

struct Kernel {
  const char* name;
  // At equal depth the lower id wins, for any order of shapes.
  void (*rasterize)(const View&, const Renderable&, const Buffers&);
  void (*update_hi_z)(const View&, const Renderable&, const Buffers&);                     // after rasterize
  void (*fill_sky)(const View&, const Sky&, int32_t top, int32_t bottom, const Buffers&);  // pixels without a shape
  void (*shade)(const View&, const Renderable&, const Lighting&, const Buffers&);
  // candidates: scratch, target_count indices.
  void (*cast_rays)(const RayTarget*, const BoundingVolumes* volumes, int32_t target_count, int32_t* candidates,
                    const double* directions, int64_t count, double max_range, double* ranges, int32_t* shapes);
  // Buffer rows to image rows; depth may be null.
  void (*resolve)(const View&, int32_t top, int32_t bottom, const Buffers&, uint8_t* rgb, float* depth);
  void (*add_depth_noise)(const Noise&, int64_t count, float* depths);
  void (*add_color_noise)(const Noise&, int64_t count, uint8_t* rgb);  // equal on all three channels of a pixel
  // Depths outside [near, far] or infinite become NaN; both arrays may be the same.
  void (*clip_depths)(int64_t count, float near, float far, const float* depths, float* clipped);
  // x, y, z in the optical frame [m] and the color as PCL packs it, 0x00rrggbb in a float's bits.
  void (*fill_cloud)(int64_t count, const float* depth, const uint8_t* rgb, const float* right, const float* down,
                     float* points);
};

namespace baseline {
extern const Kernel kernel;
}
#ifdef TRUNDLE_X86
namespace avx2 {
extern const Kernel kernel;
}
namespace avx512 {
extern const Kernel kernel;
}
#endif

const Kernel& best_kernel();  // True if this machine's processor supports the instruction set

}  // namespace trundle
