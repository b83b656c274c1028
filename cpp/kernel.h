// What the kernels work on: plain numbers in the camera's frame, and one table of functions per instruction set.
#pragma once

#include <cstdint>

namespace trundle {

constexpr int kWidest = 16;  // lanes; rows of buffers are padded to it

enum class Kind : int32_t { kPlane, kBox, kSphere, kCylinder, kCapsule, kEllipsoid, kMesh };

// Pixels and the rays through them. The camera looks along its +x, with y to the left and z up.
struct View {
  int32_t width, height, stride;
  float centre_u, centre_v;  // the pixel coordinates of the view axis
  float focal;               // [px]
  float near_, far_;         // [m]
};

struct Triangles {
  const float* vertices;  // (vertex_count, 3) [m]
  const int32_t* faces;   // (face_count, 3)
  const float* normals;   // (face_count, 3), unit, outwards
  int32_t vertex_count, face_count;
};

// A shape as one view sees it.
struct Solid {
  Kind kind;
  float size[3];        // half lengths, radii; of a plane half lengths or 0 for endless
  float axes[9];        // rows: the shape's axes in the camera frame
  float eye[3];         // the camera in the shape's frame [m]
  float centre[3];      // the shape's origin in the camera frame [m]
  int32_t left, top, right, bottom;  // pixels that it may cover, the last ones excluded
  int32_t first_id;     // its visible pixels carry first_id + face
  int32_t id_count;
  int32_t index;        // in the scene
  const Triangles* mesh;
  float colour[3];
};

struct Light {
  float towards[3];  // unit, in the camera frame: where the light comes from
  float diffuse[3];
};

struct Lighting {
  float ambient[3];
  const Light* lights;
  int32_t light_count;
};

// Rows of `stride` numbers each.
struct Buffers {
  float* nearness;    // 1 / depth [1/m]
  int32_t* id;        // what is seen; -1: nothing
  int32_t* colour;    // red | green << 8 | blue << 16
  int32_t* segment;   // index of the shape, or -1; may be null
  float* projected;   // room for 6 numbers for each vertex of the largest mesh
};

struct Kernel {
  const char* name;
  void (*see)(const View&, const Solid&, const Buffers&);
  void (*shade)(const View&, const Solid&, const Lighting&, const Buffers&);
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

}  // namespace trundle
