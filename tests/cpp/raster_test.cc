// Triangles in the buffers: clipped at the near plane, culled, watertight.
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "render/triangle.h"

using namespace trundle;
using namespace trundle::TRUNDLE_ISA;

namespace {

constexpr int kWidth = 64, kHeight = 48;

// An image with its buffers, and a renderable that covers it.
struct Canvas {
  View view{kWidth, kHeight, kWidth, kWidth / 2.0f, kHeight / 2.0f, 40.0f, 0.5f, 100.0f, false};
  Renderable renderable{};
  std::vector<float> inverse_depth = std::vector<float>(kWidth * kHeight, 0.0f);
  std::vector<int32_t> id = std::vector<int32_t>(kWidth * kHeight, -1);
  std::vector<float> hi_z =
      std::vector<float>(static_cast<size_t>(view.tile_stride()) * ((kHeight + kTileHeight - 1) / kTileHeight), 0.0f);
  Buffers buffers{};

  Canvas() {
    renderable.right = kWidth;
    renderable.bottom = kHeight;
    buffers.inverse_depth = inverse_depth.data();
    buffers.id = id.data();
    buffers.hi_z = hi_z.data();
  }

  Vertex vertex(float x, float y, float z) const {
    Vertex made{x, y, z, 0, 0, 0};
    if (x >= view.near_) project(view, made);
    return made;
  }

  void draw(const Vertex& a, const Vertex& b, const Vertex& c, int32_t number) const {
    draw_clipped<true>(view, renderable, buffers, {{a, b, c}}, number);
  }

  int count(int32_t number) const {
    int pixels = 0;
    for (const int32_t face : id) pixels += face == number;
    return pixels;
  }
};

}  // namespace

TEST_CASE("a triangle has its depths, and covers half of its square") {
  const Canvas canvas;
  // 20 x 20 pixels around the centre, at 2 m; counter-clockwise seen from the camera.
  canvas.draw(canvas.vertex(2, 0.5f, -0.5f), canvas.vertex(2, -0.5f, -0.5f), canvas.vertex(2, -0.5f, 0.5f), 5);
  CHECK(canvas.count(5) == doctest::Approx(200).epsilon(0.06));
  CHECK(canvas.inverse_depth[(kHeight / 2 + 5) * kWidth + kWidth / 2 + 5] == doctest::Approx(0.5f));
}

TEST_CASE("a face seen from behind is culled") {
  const Canvas canvas;
  canvas.draw(canvas.vertex(2, 0.5f, -0.5f), canvas.vertex(2, -0.5f, 0.5f), canvas.vertex(2, -0.5f, -0.5f), 5);
  CHECK(canvas.count(5) == 0);
}

TEST_CASE("two triangles of a quadrilateral cover each of its pixels once") {
  const Canvas together, first, second;
  const Vertex a = together.vertex(3, 1.1f, -0.7f), b = together.vertex(2, -0.6f, -0.4f),
               c = together.vertex(2.5f, -0.5f, 0.6f), d = together.vertex(3.5f, 0.9f, 0.8f);
  first.draw(a, b, c, 1);
  second.draw(a, c, d, 1);
  together.draw(a, b, c, 1);
  together.draw(a, c, d, 1);
  CHECK(first.count(1) > 0);
  CHECK(second.count(1) > 0);
  CHECK(together.count(1) == first.count(1) + second.count(1));
}

TEST_CASE("pixel centres on a shared edge belong to one of its triangles") {
  Canvas together, first, second;
  for (Canvas* canvas : {&together, &first, &second}) canvas->view.focal = 32;  // exact projections
  const auto at = [&](float u, float v) { return together.vertex(2, (32 - u) / 16, (24 - v) / 16); };
  const Vertex a = at(12.5f, 44.5f), b = at(52.5f, 44.5f), c = at(52.5f, 4.5f), d = at(12.5f, 4.5f);
  first.draw(a, b, c, 1);
  second.draw(a, c, d, 1);
  together.draw(a, b, c, 1);
  together.draw(a, c, d, 1);
  CHECK(together.count(1) == 40 * 40);
  CHECK(together.count(1) == first.count(1) + second.count(1));
}

TEST_CASE("triangles are clipped at the near plane, without gaps between neighbours") {
  const Canvas together, first, second;
  // A floor 0.4 m below the camera, from behind it to 4 m ahead.
  const Vertex a = together.vertex(-1, 3, -0.4f), b = together.vertex(-1, -3, -0.4f), c = together.vertex(4, -3, -0.4f),
               d = together.vertex(4, 3, -0.4f);
  first.draw(a, b, c, 1);
  second.draw(a, c, d, 1);
  together.draw(a, b, c, 1);
  together.draw(a, c, d, 1);
  CHECK(together.count(1) == first.count(1) + second.count(1));
  // Rows between the far edge and the bottom edge, to which the floor comes within 0.5 m, are covered.
  const int far_row = static_cast<int>(std::ceil(kHeight / 2.0f + 40.0f * 0.4f / 4.0f + 0.5f));
  for (int row = far_row; row < kHeight; ++row) CHECK(together.id[row * kWidth + kWidth / 2] == 1);
  CHECK(together.id[(far_row - 3) * kWidth + kWidth / 2] == -1);
  for (const float inverse_depth : together.inverse_depth) CHECK(inverse_depth <= 1.0f / 0.5f);
}

TEST_CASE("the nearer triangle is drawn, at equal depth the one with the lower number") {
  const Canvas canvas;
  const auto draw = [&](float x, int32_t number) {
    canvas.draw(canvas.vertex(x, 9, -9), canvas.vertex(x, -9, -9), canvas.vertex(x, -9, 9), number);
  };
  draw(3, 7);
  draw(2, 8);
  draw(4, 9);
  draw(2, 6);
  CHECK(canvas.id[(kHeight - 1) * kWidth + kWidth - 1] == 6);
}
