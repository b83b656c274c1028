// Pictures of a scene: the maps of its lights, then what a camera sees.
#include <algorithm>
#include <cmath>
#include <system_error>
#include <thread>

#include "renderer.h"

namespace trundle {

// The first tile of some rows, and how many there are.
std::pair<size_t, size_t> tiles_between(const View& view, int32_t top, int32_t bottom) {
  const auto stride = (size_t)view.tile_stride(), first = (size_t)(top / kTileHeight) * stride;
  return {first, (size_t)rows_of_tiles(bottom) * stride - first};
}

// Rows of one of some pictures that a thread draws.
struct Renderer::Band {
  size_t thread, picture;
  int32_t top, bottom;

  // What of a shape is in them; nothing where none is.
  std::optional<Solid> of(Solid solid) const {
    solid.top = std::max(solid.top, top), solid.bottom = std::min(solid.bottom, bottom);
    return solid.top < solid.bottom ? std::optional(solid) : std::nullopt;
  }

  // Nothing in them hides what has more than this nearness.
  void clear_tiles(const View& view, float nearness, float* hidden) const {
    const auto [first, count] = tiles_between(view, top, bottom);
    std::fill_n(hidden + first, count, nearness);
  }
};

constexpr int64_t kTilesForThread = 2048;  // 256 ki pixels: of fewer, starting a thread is most of what it saves

// Of all pictures, one below another, each thread has a band from above and one from below: skies are less work than
// what is under them. The two in the middle are one.
template <typename Work>
void Renderer::in_bands(const std::vector<View>& views, const Work& work) {
  const auto count = (int64_t)rooms_.size();
  std::vector<int64_t> starts{0};  // of each picture, in tiles
  for (const View& view : views) starts.push_back(starts.back() + (int64_t)tiles_of(view));
  const auto draw_between = [&](int64_t thread, int64_t first, int64_t last) {
    for (size_t i = 0; i < views.size(); ++i) {
      const auto row = [&](int64_t band) {
        const int64_t tiles = std::max(starts.back() * band / (2 * count) - starts[i], int64_t{0});
        return (int32_t)std::min(tiles / views[i].tile_stride() * kTileHeight, (int64_t)views[i].height);
      };
      if (row(first) < row(last)) work(Band{(size_t)thread, i, row(first), row(last)});
    }
  };
  const auto draw = [&](int64_t thread) {
    if (thread + 1 == count) return draw_between(thread, count - 1, count + 1);
    draw_between(thread, thread, thread + 1);
    draw_between(thread, 2 * count - 1 - thread, 2 * count - thread);
  };
  std::vector<std::thread> others;
  int64_t started = 1;
  const int64_t helpful = std::min(count, starts.back() / kTilesForThread + 1);
  try {
    for (; started < helpful; ++started) others.emplace_back(draw, started);
  } catch (const std::system_error&) {  // the system has no more threads to give: this one does the rest
  }
  for (int64_t thread = started; thread < count; ++thread) draw(thread);
  draw(0);
  for (std::thread& other : others) other.join();
}

// What is near first: it hides the rest. What is endless may be near somewhere, and comes last.
void Renderer::sort_by_nearness(std::vector<Solid>& solids) const {
  const auto rank = [this](const Solid& solid) { return is_endless(scene_.shapes[solid.index]) ? -INFINITY : solid.nearest; };
  std::stable_sort(solids.begin(), solids.end(), [&](const Solid& a, const Solid& b) { return rank(a) > rank(b); });
}

void Renderer::see_all(const View& view, const std::vector<Solid>& solids, const Band& band,
                       Buffers buffers) const {
  const Kernel& kernel = best_kernel();
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
    const Vec3 &low = bounds_[i].low, &high = bounds_[i].high;
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
      if (!place(view, maps_[i]->world_from_view, caster, Detail::kSeen, solid)) continue;
      solids.push_back(solid);
      maps_[i]->cover(solid);
    }
    sort_by_nearness(solids);
    for (Room& room : rooms_) room.hidden.fit(tiles_of(view));
    in_bands({view}, [&](const Band& band) {
      Room& room = rooms_[band.thread];
      band.clear_tiles(view, maps_[i]->nearness.front(), room.hidden.data());  // of nothing yet
      see_all(view, solids, band, {maps_[i]->nearness.data(), nullptr, nullptr, nullptr, room.hidden.data(),
                                   room.projected.data(), room.large.data()});
    });
  }
  maps_are_old_ = false;
}

int32_t byte_of(double share) { return (int32_t)(std::isfinite(share) ? std::clamp(share, 0.0, 1.0) * 255.0 + 0.5 : 0); }

struct Renderer::Sight {
  std::vector<ShadowMap> maps;
  std::vector<Light> lights;
  Sky sky;
  std::vector<Solid> solids, see_through;
};

Renderer::Sight Renderer::sight_of(const Shot& shot, const View& view) {
  Sight sight{std::vector<ShadowMap>(maps_.size()), {}, scene_.sky, {}, {}};
  for (size_t i = 0; i < maps_.size(); ++i) {
    const LightSpec& light = scene_.lights[i];
    const auto body = light.body < 0 ? Frame() : body_poses_[light.body];
    if (!body) continue;
    if (maps_[i]) sight.maps[i] = map_for(*maps_[i], shot.world_from_camera);
    sight.lights.push_back(light_for(light, *body, shot.world_from_camera, maps_[i] ? &sight.maps[i] : nullptr));
  }
  for (int i = 0; i < 3; ++i) {
    sight.sky.up[i] = (float)shot.world_from_camera.rotation[6 + i];
    sight.sky.even |= byte_of(sight.sky.horizon[i]) << (8 * i);
  }
  // Distances and segments are of every triangle.
  const Detail detail = shot.depth || shot.segment ? Detail::kAll : Detail::kSeen;
  for (size_t i = 0; i < scene_.shapes.size(); ++i) {
    Solid solid;
    if (looks_[i].opacity > 0.0f && place(view, shot.world_from_camera, i, detail, solid))
      (looks_[i].opacity < 1.0f ? sight.see_through : sight.solids).push_back(solid);
  }
  sort_by_nearness(sight.solids);
  const auto away = [](const Solid& solid) {
    return solid.centre[0] * solid.centre[0] + solid.centre[1] * solid.centre[1] + solid.centre[2] * solid.centre[2];
  };
  std::stable_sort(sight.see_through.begin(), sight.see_through.end(),
                   [&](const Solid& a, const Solid& b) { return away(a) > away(b); });
  return sight;
}

void Renderer::render(const std::vector<Shot>& shots) {
  if (maps_are_old_) draw_maps();
  std::vector<View> views;
  std::vector<Sight> sights;
  for (const Shot& shot : shots) {
    const int32_t stride = (shot.width + kWidest - 1) / kWidest * kWidest;
    const View view{shot.width, shot.height, stride, shot.width * 0.5f, shot.height * 0.5f,
                    (float)shot.focal, (float)shot.near_, (float)shot.far_, false};
    views.push_back(view);
    sights.push_back(sight_of(shot, view));
    const size_t count = (size_t)stride * (size_t)shot.height, tiles = tiles_of(view);
    for (Room& room : rooms_) {
      room.nearness.fit(count), room.id.fit(count), room.colour.fit(count), room.hidden.fit(tiles);
      if (shot.segment) room.segment.fit(count);
      if (!sights.back().see_through.empty())
        room.nearness_through.fit(count), room.id_through.fit(count), room.hidden_through.fit(tiles);
    }
  }
  in_bands(views, [&](const Band& band) {
    draw(shots[band.picture], views[band.picture], sights[band.picture], band);
  });
}

void Renderer::draw(const Shot& shot, const View& view, const Sight& sight, const Band& band) {
  const Kernel& kernel = best_kernel();
  Room& room = rooms_[band.thread];
  Lighting lighting{{}, sight.lights.data(), (int32_t)sight.lights.size(), scene_.fog};
  std::copy(scene_.ambient.begin(), scene_.ambient.end(), lighting.ambient);
  const Buffers buffers{room.nearness.data(), room.id.data(), room.colour.data(),
                        shot.segment ? room.segment.data() : nullptr, room.hidden.data(), room.projected.data(),
                        room.large.data()};
  const auto stride = (size_t)view.stride;
  const size_t first = (size_t)band.top * stride, area = (size_t)(band.bottom - band.top) * stride;
  std::fill_n(buffers.nearness + first, area, 1.0f / view.far_);
  for (int32_t row = band.top; row < band.bottom; ++row)
    std::fill_n(buffers.nearness + (size_t)row * stride + view.width, view.stride - view.width, INFINITY);
  std::fill_n(buffers.id + first, area, -1);
  if (shot.segment) std::fill_n(buffers.segment + first, area, -1);
  band.clear_tiles(view, 1.0f / view.far_, buffers.hidden);
  see_all(view, sight.solids, band, buffers);
  kernel.fill(view, sight.sky, band.top, band.bottom, buffers);
  for (const Solid& solid : sight.solids)
    if (const auto part = band.of(solid)) kernel.shade(view, *part, lighting, buffers);
  Buffers through = buffers;  // over what is there already, seen through a buffer of its own
  through.nearness = room.nearness_through.data(), through.id = room.id_through.data();
  through.hidden = room.hidden_through.data();
  for (const Solid& solid : sight.see_through) {
    const auto part = band.of(solid);
    if (!part) continue;
    const size_t from = (size_t)part->top * stride, rows = (size_t)(part->bottom - part->top) * stride;
    std::copy_n(buffers.nearness + from, rows, through.nearness + from);
    std::fill_n(through.id + from, rows, -1);
    const auto [tile, tiles] = tiles_between(view, part->top, part->bottom);
    std::copy_n(buffers.hidden + tile, tiles, through.hidden + tile);
    see_all(view, {solid}, band, through);
    kernel.shade(view, *part, lighting, through);
  }
  kernel.develop(view, band.top, band.bottom, buffers, shot.rgb, shot.depth);
  if (!shot.segment) return;
  for (int32_t row = band.top; row < band.bottom; ++row)
    std::copy_n(buffers.segment + (size_t)row * stride, shot.width, shot.segment + (size_t)row * (size_t)shot.width);
}

}  // namespace trundle
