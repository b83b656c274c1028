// Pictures of a scene: the maps of its lights, then what a camera sees.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <system_error>
#include <thread>

#include "renderer.h"

namespace trundle {

// Rows of a picture that one thread draws.
struct Renderer::Band {
  size_t thread;
  int32_t top, bottom;

  // What of a shape is in them; nothing where none is.
  std::optional<Solid> of(Solid solid) const {
    solid.top = std::max(solid.top, top), solid.bottom = std::min(solid.bottom, bottom);
    return solid.top < solid.bottom ? std::optional(solid) : std::nullopt;
  }
};

// Each thread has a band from above and one from below: skies are less work than what is under them.
template <typename Work>
void Renderer::in_bands(int32_t height, const Work& work) {
  const auto count = (int32_t)rooms_.size();
  const auto draw = [&](int32_t thread) {
    if (count == 1) return work(Band{0, 0, height});
    const int32_t tiles = (height + kTileHeight - 1) / kTileHeight;
    const auto row = [&](int32_t band) { return std::min(tiles * band / (2 * count) * kTileHeight, height); };
    for (const int32_t band : {thread, 2 * count - 1 - thread}) work(Band{(size_t)thread, row(band), row(band + 1)});
  };
  std::vector<std::thread> others;
  int32_t started = 1;
  try {
    for (; started < count; ++started) others.emplace_back(draw, started);
  } catch (const std::system_error&) {  // the system has no more threads to give: this one does the rest
  }
  for (int32_t thread = started; thread < count; ++thread) draw(thread);
  draw(0);
  for (std::thread& other : others) other.join();
}

size_t tiles_of(const View& view) {
  return (size_t)view.tile_stride() * (size_t)((view.height + kTileHeight - 1) / kTileHeight);
}

// What is near first: it hides the rest. What is endless may be near somewhere, and comes last.
void Renderer::sort_by_nearness(std::vector<Solid>& solids) const {
  const auto rank = [this](const Solid& solid) { return is_endless(scene_.shapes[solid.index]) ? -INFINITY : solid.nearest; };
  std::stable_sort(solids.begin(), solids.end(), [&](const Solid& a, const Solid& b) { return rank(a) > rank(b); });
}

void Renderer::see_all(const View& view, const std::vector<Solid>& solids, const Band& band, Buffers buffers) {
  const Kernel& kernel = best_kernel();
  buffers.projected = rooms_[band.thread].projected.data(), buffers.large = rooms_[band.thread].large.data();
  for (const Solid& solid : solids)
    if (const auto part = band.of(solid)) kernel.see(view, *part, buffers), kernel.settle(view, *part, buffers);
}

// Flat things lie on the ground: what a plane would shade is below it.
void Renderer::draw_maps() {
  std::vector<size_t> casters;
  std::vector<Corners> corners;
  for (size_t i = 0; i < scene_.shapes.size(); ++i) {
    const ShapeSpec& shape = scene_.shapes[i];
    const auto& world_from_shape = shape_poses_[i];
    if (!shape.casts_shadow || shape.kind == Kind::kPlane || looks_[i].opacity < 1.0f || !world_from_shape) continue;
    const auto& [low, high, middle, radius] = bounds_[i];
    if (!(low[0] <= high[0])) continue;
    Corners box;
    for (int corner = 0; corner < 8; ++corner)
      box[corner] = world_from_shape->move({corner & 1 ? high[0] : low[0], corner & 2 ? high[1] : low[1],
                                           corner & 4 ? high[2] : low[2]});
    if (!std::all_of(box.begin(), box.end(), [](const Vec3& p) { return std::isfinite(p[0] + p[1] + p[2]); })) continue;
    casters.push_back(i);
    corners.push_back(box);
  }
  for (size_t i = 0; i < maps_.size(); ++i) {
    const LightSpec& light = scene_.lights[i];
    const auto body = light.body < 0 ? Frame() : body_poses_[light.body];
    maps_[i] = light.casts_shadows && body ? look_from(light, *body, corners) : std::nullopt;
    if (!maps_[i]) continue;
    const View& view = maps_[i]->view;
    std::vector<Solid> solids;
    for (const size_t caster : casters) {
      Solid solid;
      if (place(view, maps_[i]->world_from_view, caster, Detail::kSeen, solid)) solids.push_back(solid);
    }
    sort_by_nearness(solids);
    hidden_.assign(tiles_of(view), maps_[i]->nearness.front());  // of nothing yet
    in_bands(view.height, [&](const Band& band) {
      see_all(view, solids, band, {maps_[i]->nearness.data(), nullptr, nullptr, nullptr, hidden_.data(), {}, {}});
    });
  }
  maps_are_old_ = false;
}

int32_t byte_of(double share) { return (int32_t)(std::isfinite(share) ? std::clamp(share, 0.0, 1.0) * 255.0 + 0.5 : 0); }

// Words of three bytes into bytes, four at a time.
void pack(const int32_t* words, int32_t count, uint8_t* bytes) {
  int32_t i = 0;
  for (; i + 4 <= count; i += 4, bytes += 12) {
    const auto a = (uint32_t)words[i], b = (uint32_t)words[i + 1], c = (uint32_t)words[i + 2], d = (uint32_t)words[i + 3];
    const uint32_t packed[3] = {a | b << 24, b >> 8 | c << 16, c >> 16 | d << 8};
    for (int k = 0; k < 3; ++k) std::memcpy(bytes + 4 * k, packed + k, 4);  // all twelve at once would go by way of memory
  }
  for (; i < count; ++i, bytes += 3)
    for (int channel = 0; channel < 3; ++channel) bytes[channel] = (uint8_t)(words[i] >> (8 * channel));
}

void Renderer::render(const Camera& camera, uint8_t* rgb, float* depth, int32_t* segment) {
  const int32_t stride = (camera.width + kWidest - 1) / kWidest * kWidest;
  const View view{camera.width, camera.height, stride, camera.width * 0.5f, camera.height * 0.5f,
                  (float)camera.focal, (float)camera.near_, (float)camera.far_, false};
  if (maps_are_old_) draw_maps();
  std::vector<Light> lights;
  std::vector<ShadowMap> maps(maps_.size());
  for (size_t i = 0; i < maps_.size(); ++i) {
    const LightSpec& light = scene_.lights[i];
    const auto body = light.body < 0 ? Frame() : body_poses_[light.body];
    if (!body) continue;
    if (maps_[i]) maps[i] = map_for(*maps_[i], camera.world_from_camera);
    lights.push_back(light_for(light, *body, camera.world_from_camera, maps_[i] ? &maps[i] : nullptr));
  }
  Lighting lighting{{}, lights.data(), (int32_t)lights.size(), scene_.fog};
  std::copy(scene_.ambient.begin(), scene_.ambient.end(), lighting.ambient);
  Sky sky = scene_.sky;
  for (int i = 0; i < 3; ++i) {
    sky.up[i] = (float)camera.world_from_camera.rotation[6 + i];
    sky.even |= byte_of(sky.horizon[i]) << (8 * i);
  }
  // Distances and segments are of every triangle.
  const Detail detail = depth || segment ? Detail::kAll : Detail::kSeen;
  std::vector<Solid> solids, see_through;
  for (size_t i = 0; i < scene_.shapes.size(); ++i) {
    Solid solid;
    if (looks_[i].opacity > 0.0f && place(view, camera.world_from_camera, i, detail, solid))
      (looks_[i].opacity < 1.0f ? see_through : solids).push_back(solid);
  }
  sort_by_nearness(solids);
  const auto away = [](const Solid& solid) {
    return solid.centre[0] * solid.centre[0] + solid.centre[1] * solid.centre[1] + solid.centre[2] * solid.centre[2];
  };
  std::stable_sort(see_through.begin(), see_through.end(),
                   [&](const Solid& a, const Solid& b) { return away(a) > away(b); });
  const size_t count = (size_t)stride * (size_t)camera.height;
  const auto grow = [count](auto& buffer) { buffer.resize(std::max(buffer.size(), count)); };
  grow(nearness_), grow(id_), grow(colour_);
  if (segment) grow(segment_);
  if (!see_through.empty()) grow(nearness_through_), grow(id_through_);
  hidden_.assign(tiles_of(view), 1.0f / view.far_), hidden_through_.resize(hidden_.size());
  in_bands(camera.height, [&](const Band& band) {
    const Kernel& kernel = best_kernel();
    const Buffers buffers{nearness_.data(), id_.data(), colour_.data(), segment ? segment_.data() : nullptr,
                          hidden_.data(), {}, {}};
    const size_t first = (size_t)band.top * stride, area = (size_t)(band.bottom - band.top) * stride;
    std::fill_n(buffers.nearness + first, area, 1.0f / view.far_);
    for (int32_t row = band.top; row < band.bottom; ++row)
      std::fill_n(buffers.nearness + (size_t)row * stride + view.width, stride - view.width, INFINITY);
    std::fill_n(buffers.id + first, area, -1);
    if (segment) std::fill_n(buffers.segment + first, area, -1);
    see_all(view, solids, band, buffers);
    kernel.fill(view, sky, band.top, band.bottom, buffers);
    for (const Solid& solid : solids)
      if (const auto part = band.of(solid)) kernel.shade(view, *part, lighting, buffers);
    for (const Solid& solid : see_through) {  // over what is there already, seen through a buffer of its own
      const auto part = band.of(solid);
      if (!part) continue;
      const size_t from = (size_t)part->top * stride, rows = (size_t)(part->bottom - part->top) * stride;
      std::copy_n(nearness_.data() + from, rows, nearness_through_.data() + from);
      std::fill_n(id_through_.data() + from, rows, -1);
      const size_t tiles = (size_t)view.tile_stride(), tile_from = (size_t)(part->top / kTileHeight) * tiles;
      const size_t tile_to = (size_t)((part->bottom + kTileHeight - 1) / kTileHeight) * tiles;
      std::copy(hidden_.begin() + tile_from, hidden_.begin() + tile_to, hidden_through_.begin() + tile_from);
      Buffers through = buffers;
      through.nearness = nearness_through_.data(), through.id = id_through_.data();
      through.hidden = hidden_through_.data();
      see_all(view, {solid}, band, through);
      kernel.shade(view, *part, lighting, through);
    }
    for (int32_t row = band.top; row < band.bottom; ++row) {
      const size_t from = (size_t)row * stride, to = (size_t)row * camera.width;
      pack(colour_.data() + from, camera.width, rgb + 3 * to);
      if (depth)
        for (int32_t column = 0; column < camera.width; ++column)
          depth[to + column] = id_[from + column] < 0 ? std::numeric_limits<float>::infinity()
                                                      : 1.0f / nearness_[from + column];
      if (segment) std::copy_n(segment_.data() + from, camera.width, segment + to);
    }
  });
}

}  // namespace trundle
