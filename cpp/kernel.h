// What the kernels work on: plain numbers in the camera's frame, and one table of functions per instruction set.
#pragma once

#include <cstdint>

namespace trundle {

constexpr int kWidest = 16;  // lanes; rows of buffers are padded to it
constexpr int kMostLevels = 15;
constexpr int kTileWidth = kWidest, kTileHeight = 8;  // [px] of what is found to be hidden as a whole

enum class Kind : int32_t { kPlane, kBox, kSphere, kCylinder, kCapsule, kEllipsoid, kMesh };
enum class LightKind : int32_t { kDirectional, kPoint, kSpot };
enum class FogKind : int32_t { kNone, kLinear, kExponential, kSquared };

// Pixels and the rays through them. The camera looks along its +x, with y to the left and z up. Rays of a parallel view
// do not spread: it is what a light sees from far away, its focal length is in px/m, and it has no near plane.
struct View {
  int32_t width, height, stride;
  float centre_u, centre_v;  // the pixel coordinates of the view axis
  float focal;               // [px]
  float near_, far_;         // [m]
  bool parallel;

  // Tiles from the start of a row of them to the next one's.
  int32_t tile_stride() const { return (stride / kTileWidth + kWidest - 1) / kWidest * kWidest; }
};

// Vertices and faces lie in rows of their own for each axis and corner, which are padded to kWidest: with faces that have
// no area.
struct Triangles {
  const float* places[3];     // x, y and z of the vertices [m]
  const int32_t* corners[3];  // vertices of each face, counter-clockwise from outside
  const float* normals;       // (face_count, 4), unit, outwards, and 0
  const float* layout;        // (face_count, 8): u and v, each as gradient [1/m] and value at the origin; may be null
  const float* bend;          // (face_count, 12): x, y and z of normals that run over edges, as the layout; may be null
  int32_t vertex_count, face_count;
};

constexpr int kMostWaiting = 1024;  // nodes that a walk through a tree may put off

constexpr int kLeaf = 8;             // triangles that rays are held against side by side

// Boxes, and below each either `count` leaves from `first` on, or, where count is 0, the node `first`. What is not used
// is a box that holds nothing.
struct BvhNode {
  float low[3][kWidest], high[3][kWidest];
  int32_t first[kWidest], count[kWidest];
};

// Of each triangle a corner, the two edges from there, and what is at right angles to both. What is not used has no area.
struct BvhLeaf {
  float corner[3][kLeaf], edges[2][3][kLeaf], normal[3][kLeaf];
};

struct BvhView {
  const BvhNode* nodes;
  const BvhLeaf* leaves;
};

// An image and its halves, down to one pixel; it repeats: each has its first column and row again after its last ones.
struct Texture {
  const int32_t* texels;  // red | green << 8 | blue << 16, the lowest row first
  int32_t level_count;
  int32_t width[kMostLevels], height[kMostLevels], start[kMostLevels];
};

// How a surface answers light: Blinn and Phong's model.
struct Look {
  float ambient[3], diffuse[3], specular[3], emissive[3];
  float shininess;
  float opacity;
  const Texture* texture;  // multiplies ambient and diffuse; may be null
  float repeat[2];         // how often it is there where it would be once, about its middle
};

// A shape as one view sees it.
struct Solid {
  Kind kind;
  float size[3];        // half lengths, radii; of a plane half lengths or 0 for endless
  float axes[9];        // rows: the shape's axes in the camera frame
  float eye[3];         // the camera in the shape's frame [m]
  float centre[3];      // the shape's origin in the camera frame [m]
  int32_t left, top, right, bottom;  // pixels that it may cover, the last ones excluded
  float nearest;        // no point of it has more nearness
  int32_t first_id;     // its visible pixels carry first_id + face
  int32_t id_count;
  int32_t index;        // in the scene
  const Triangles* mesh;
  float off;            // how far the mesh may be from what casts shadows [m]
  const Look* look;
};

// A shape as rays from one place meet it: what is beside them is sorted out in single precision, what they meet, and
// where, is found in double.
struct Target {
  Kind kind;
  int32_t index;             // in the scene
  double size[3];            // as a Solid's
  double axes[9], eye[3];    // as a Solid's; of a sphere, whose axes are of no interest, in the frame that rays start from
  float narrow_axes[9], narrow_eye[3];
  float middle[3];           // of a ball around it, in the frame that rays start from [m]
  float radius;              // of that ball [m]; less than 0: endless
  float reach;               // the square of how far along a ray its middle is where the ray only touches it [m²]
  float aside[3];            // the axis of an endless pipe around it, times a point of that [m]
  float aside_length;        // [m]
  float thickness;           // the square of that pipe's radius [m²]
  BvhView bvh;
};

// Balls and pipes around as many targets, as a Target has them.
struct Around {
  float middle[3][kWidest], radius[kWidest], aside[3][kWidest], aside_length[kWidest], thickness[kWidest];
};

// What a light sees. Where something is nearer to it than a point, the point is in the shade.
struct ShadowMap {
  const float* nearness;  // (height, stride), as a view's
  const float* nearest;   // of each tile: no texel of it, or next to it on the right or below, has more nearness
  View view;
  float turn[9], shift[3];  // from the camera's frame to the view's
  float texel;              // [m] of a parallel view; of another one [m] at 1 m
};

struct Light {
  LightKind kind;
  float towards[3];  // unit, in the camera frame: against the direction in which the light goes
  float place[3];    // in the camera frame; not of directional lights
  float diffuse[3], specular[3];
  float constant, linear, quadratic, range;  // of what does not come from afar
  float cos_inner, cos_outer, falloff;       // of spots; angles from the axis
  const ShadowMap* shadow;                   // may be null
};

struct Fog {
  FogKind kind;
  float colour[3];
  float start, end, density;
};

struct Lighting {
  float ambient[3];
  const Light* lights;
  int32_t light_count;
  Fog fog;
};

// What is seen where nothing is: one colour, or two that run into each other from the horizon up.
struct Sky {
  float horizon[3], zenith[3];
  float up[3];   // in the camera's frame
  int32_t even;  // the horizon's, as Buffers::colour has it: all of the sky below it, or where both are one
};

// Rows of `stride` numbers each.
struct Buffers {
  float* nearness;    // 1 / depth [1/m]; of a parallel view -depth [m]; endless beside the picture
  int32_t* id;        // what is seen; -1: nothing; null: of no interest
  int32_t* colour;    // red | green << 8 | blue << 16
  int32_t* segment;   // index of the shape, or -1; may be null
  float* hidden;      // of each tile: what has less nearness is not seen there
  float* projected;   // room for 6 rows of the vertices of the largest mesh
  int32_t* large;     // room for the numbers of the faces of the largest mesh
};

// Gaussian, of the same numbers wherever it has the same key.
struct Noise {
  uint32_t key[2];
  float mean, stddev;
};

struct Kernel {
  const char* name;
  // Of two at one place the one with the lower number is seen, in whatever order they come.
  void (*see)(const View&, const Solid&, const Buffers&);
  void (*settle)(const View&, const Solid&, const Buffers&);  // what is hidden by what is seen by now
  void (*fill)(const View&, const Sky&, int32_t top, int32_t bottom, const Buffers&);  // where nothing is
  void (*shade)(const View&, const Solid&, const Lighting&, const Buffers&);
  // `near` has room for a number for each target.
  void (*cast)(const Target*, const Around*, int32_t target_count, int32_t* near, const double* directions, int64_t count, double reach,
               double* ranges, int32_t* shapes);
  // Rows of buffers into the arrays of a picture; depth may be null.
  void (*develop)(const View&, int32_t top, int32_t bottom, const Buffers&, uint8_t* rgb, float* depth);
  void (*add_depth_noise)(const Noise&, int64_t count, float* depths);
  void (*add_colour_noise)(const Noise&, int64_t count, uint8_t* rgb);  // the same on each pixel's three colours
  // What is not between the two, or endless, becomes not a number; both arrays may be one.
  void (*clip_depths)(int64_t count, float near, float far, const float* depths, float* clipped);
  // x, y and z of each pixel in the optical frame [m], and its colour as PCL packs it: 0x00rrggbb in a float's place.
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

const Kernel& best_kernel();  // that this machine runs

}  // namespace trundle
