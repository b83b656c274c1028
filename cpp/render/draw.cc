// Rendering: shadow maps, then cameras.
#include <algorithm>
#include <cmath>
#include <system_error>
#include <thread>

#include "renderer.h"

namespace trundle {

// First tile of the given rows, and their number of tiles.
std::pair<size_t, size_t> tile_range(const View& view, int32_t top, int32_t bottom) {
  const auto stride = static_cast<size_t>(view.tile_stride()), first = static_cast<size_t>(top / kTileHeight) * stride;
  return {first, static_cast<size_t>(tile_rows(bottom)) * stride - first};
}

// Rows of one image that one thread draws.
struct Renderer::Band {
  size_t thread, picture;
  int32_t top, bottom;

  // The part of a shape within the band, if any.
  std::optional<Renderable> clip(Renderable renderable) const {
    renderable.top = std::max(renderable.top, top);
    renderable.bottom = std::min(renderable.bottom, bottom);
    return renderable.top < renderable.bottom ? std::optional(renderable) : std::nullopt;
  }

  // Reset the band's hierarchical z.
  void clear_tiles(const View& view, float inverse_depth, float* hi_z) const {
    const auto [first, count] = tile_range(view, top, bottom);
    std::fill_n(hi_z + first, count, inverse_depth);
  }
};

constexpr int64_t kTilesForThread = 2048;  // 256 Ki pixels; for fewer, starting a thread costs nearly what it saves

// With all images stacked, each thread draws one band counted from the top and one from the bottom, because skies cost
// less than the parts below them. The two middle bands are one.
template <typename Work>
void Renderer::for_each_band(const std::vector<View>& views, const Work& work) {
  const auto count = static_cast<int64_t>(workspaces_.size());
  std::vector<int64_t> starts{0};  // of each image, in tiles
  for (const View& view : views) starts.push_back(starts.back() + static_cast<int64_t>(tile_count(view)));
  const auto draw_between = [&](int64_t thread, int64_t first, int64_t last) {
    for (size_t i = 0; i < views.size(); ++i) {
      const auto row = [&](int64_t band) {
        const int64_t tiles = std::max(starts.back() * band / (2 * count) - starts[i], int64_t{0});
        return static_cast<int32_t>(
            std::min(tiles / views[i].tile_stride() * kTileHeight, static_cast<int64_t>(views[i].height)));
      };
      if (row(first) < row(last)) work(Band{static_cast<size_t>(thread), i, row(first), row(last)});
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
  } catch (const std::system_error&) {  // no more threads: the calling thread does the rest
  }
  for (int64_t thread = started; thread < count; ++thread) draw(thread);
  draw(0);
  for (std::thread& other : others) other.join();
}

// Front to back, for early rejection; infinite planes last.
void Renderer::sort_front_to_back(std::vector<Renderable>& renderables) const {
  const auto rank = [this](const Renderable& renderable) {
    return is_infinite(scene_.shapes[renderable.index]) ? -INFINITY : renderable.max_inverse_depth;
  };
  std::stable_sort(renderables.begin(), renderables.end(),
                   [&](const Renderable& a, const Renderable& b) { return rank(a) > rank(b); });
}

void Renderer::rasterize_all(const View& view, const std::vector<Renderable>& renderables, const Band& band,
                             Buffers buffers) const {
  const Kernel& kernel = best_kernel();
  for (const Renderable& renderable : renderables)
    if (const auto part = band.clip(renderable)) {
      kernel.rasterize(view, *part, buffers);
      kernel.update_hi_z(view, *part, buffers);
    }
}

// Planes cast no shadow: they are floors.
void Renderer::render_shadow_maps() {
  std::vector<size_t> casters;
  std::vector<BoxCorners> corners;
  for (size_t i = 0; i < scene_.shapes.size(); ++i) {
    const ShapeSpec& shape = scene_.shapes[i];
    const auto& world_from_shape = shape_poses_[i];
    if (!shape.casts_shadow || shape.kind == ShapeKind::kPlane || materials_[i].opacity < 1.0f || !world_from_shape)
      continue;
    const Vec3 &low = bounds_[i].low, &high = bounds_[i].high;
    if (!(low[0] <= high[0])) continue;
    BoxCorners box;
    for (int corner = 0; corner < 8; ++corner)
      box[corner] = world_from_shape->apply(
          {corner & 1 ? high[0] : low[0], corner & 2 ? high[1] : low[1], corner & 4 ? high[2] : low[2]});
    if (!std::all_of(box.begin(), box.end(), [](const Vec3& p) { return std::isfinite(p[0] + p[1] + p[2]); })) continue;
    casters.push_back(i);
    corners.push_back(box);
  }
  for (size_t i = 0; i < shadow_maps_.size(); ++i) {
    const LightSpec& light = scene_.lights[i];
    const auto body = light.body < 0 ? Transform() : body_poses_[light.body];
    shadow_maps_[i] = light.casts_shadows && body ? make_shadow_map(light, *body, corners) : std::nullopt;
    if (!shadow_maps_[i]) continue;
    const View& view = shadow_maps_[i]->view;
    std::vector<Renderable> renderables;
    for (const size_t caster : casters) {
      Renderable renderable;
      if (!project_shape(view, shadow_maps_[i]->world_from_view, caster, Detail::kLod, renderable)) continue;
      renderables.push_back(renderable);
      shadow_maps_[i]->add_caster(renderable);
    }
    sort_front_to_back(renderables);
    for (Workspace& workspace : workspaces_) workspace.hi_z.reserve(tile_count(view));
    for_each_band({view}, [&](const Band& band) {
      Workspace& workspace = workspaces_[band.thread];
      band.clear_tiles(view, shadow_maps_[i]->inverse_depth.front(), workspace.hi_z.data());  // empty
      rasterize_all(view, renderables, band,
                    {shadow_maps_[i]->inverse_depth.data(), nullptr, nullptr, nullptr, workspace.hi_z.data(),
                     workspace.projected.data(), workspace.large_faces.data()});
    });
  }
  shadow_maps_dirty_ = false;
}

int32_t byte_of(double share) {
  return static_cast<int32_t>(std::isfinite(share) ? std::clamp(share, 0.0, 1.0) * 255.0 + 0.5 : 0);
}

struct Renderer::VisibleSet {
  std::vector<ShadowMap> maps;
  std::vector<Light> lights;
  Sky sky;
  std::vector<Renderable> opaque, transparent;
};

Renderer::VisibleSet Renderer::find_visible(const CameraTarget& target, const View& view) {
  VisibleSet visible{std::vector<ShadowMap>(shadow_maps_.size()), {}, scene_.sky, {}, {}};
  for (size_t i = 0; i < shadow_maps_.size(); ++i) {
    const LightSpec& light = scene_.lights[i];
    const auto body = light.body < 0 ? Transform() : body_poses_[light.body];
    if (!body) continue;
    if (shadow_maps_[i]) visible.maps[i] = shadow_map_in_camera(*shadow_maps_[i], target.world_from_camera);
    visible.lights.push_back(
        light_in_camera(light, *body, target.world_from_camera, shadow_maps_[i] ? &visible.maps[i] : nullptr));
  }
  for (int i = 0; i < 3; ++i) {
    visible.sky.up[i] = static_cast<float>(target.world_from_camera.rotation[6 + i]);
    visible.sky.packed_horizon |= byte_of(visible.sky.horizon[i]) << (8 * i);
  }
  // Depth and segmentation use the full meshes.
  const Detail detail = target.depth || target.segmentation ? Detail::kFull : Detail::kLod;
  for (size_t i = 0; i < scene_.shapes.size(); ++i) {
    Renderable renderable;
    if (materials_[i].opacity > 0.0f && project_shape(view, target.world_from_camera, i, detail, renderable))
      (materials_[i].opacity < 1.0f ? visible.transparent : visible.opaque).push_back(renderable);
  }
  sort_front_to_back(visible.opaque);
  const auto away = [](const Renderable& renderable) {
    return renderable.centre[0] * renderable.centre[0] + renderable.centre[1] * renderable.centre[1] +
           renderable.centre[2] * renderable.centre[2];
  };
  std::stable_sort(visible.transparent.begin(), visible.transparent.end(),
                   [&](const Renderable& a, const Renderable& b) { return away(a) > away(b); });
  return visible;
}

void Renderer::render(const std::vector<CameraTarget>& targets) {
  if (shadow_maps_dirty_) render_shadow_maps();
  std::vector<View> views;
  std::vector<VisibleSet> visible_sets;
  for (const CameraTarget& target : targets) {
    const int32_t stride = (target.width + kMaxLanes - 1) / kMaxLanes * kMaxLanes;
    const View view{target.width,
                    target.height,
                    stride,
                    target.width * 0.5f,
                    target.height * 0.5f,
                    static_cast<float>(target.focal),
                    static_cast<float>(target.near_),
                    static_cast<float>(target.far_),
                    false};
    views.push_back(view);
    visible_sets.push_back(find_visible(target, view));
    const size_t count = static_cast<size_t>(stride) * static_cast<size_t>(target.height), tiles = tile_count(view);
    for (Workspace& workspace : workspaces_) {
      workspace.inverse_depth.reserve(count);
      workspace.id.reserve(count);
      workspace.color.reserve(count);
      workspace.hi_z.reserve(tiles);
      if (target.segmentation) workspace.segmentation.reserve(count);
      if (!visible_sets.back().transparent.empty()) {
        workspace.inverse_depth_through.reserve(count);
        workspace.id_through.reserve(count);
        workspace.hi_z_through.reserve(tiles);
      }
    }
  }
  for_each_band(views, [&](const Band& band) {
    draw(targets[band.picture], views[band.picture], visible_sets[band.picture], band);
  });
}

void Renderer::draw(const CameraTarget& target, const View& view, const VisibleSet& visible, const Band& band) {
  const Kernel& kernel = best_kernel();
  Workspace& workspace = workspaces_[band.thread];
  Lighting lighting{{}, visible.lights.data(), static_cast<int32_t>(visible.lights.size()), scene_.fog};
  std::copy(scene_.ambient.begin(), scene_.ambient.end(), lighting.ambient);
  const Buffers buffers{workspace.inverse_depth.data(), workspace.id.data(),
                        workspace.color.data(),         target.segmentation ? workspace.segmentation.data() : nullptr,
                        workspace.hi_z.data(),          workspace.projected.data(),
                        workspace.large_faces.data()};
  const auto stride = static_cast<size_t>(view.stride);
  const size_t first = static_cast<size_t>(band.top) * stride,
               area = static_cast<size_t>(band.bottom - band.top) * stride;
  std::fill_n(buffers.inverse_depth + first, area, 1.0f / view.far_);
  for (int32_t row = band.top; row < band.bottom; ++row)
    std::fill_n(buffers.inverse_depth + static_cast<size_t>(row) * stride + view.width, view.stride - view.width,
                INFINITY);
  std::fill_n(buffers.id + first, area, -1);
  if (target.segmentation) std::fill_n(buffers.segmentation + first, area, -1);
  band.clear_tiles(view, 1.0f / view.far_, buffers.hi_z);
  rasterize_all(view, visible.opaque, band, buffers);
  kernel.fill_sky(view, visible.sky, band.top, band.bottom, buffers);
  for (const Renderable& renderable : visible.opaque)
    if (const auto part = band.clip(renderable)) kernel.shade(view, *part, lighting, buffers);
  Buffers through = buffers;  // blended over the image; visibility in separate buffers
  through.inverse_depth = workspace.inverse_depth_through.data();
  through.id = workspace.id_through.data();
  through.hi_z = workspace.hi_z_through.data();
  for (const Renderable& renderable : visible.transparent) {
    const auto part = band.clip(renderable);
    if (!part) continue;
    const size_t from = static_cast<size_t>(part->top) * stride,
                 rows = static_cast<size_t>(part->bottom - part->top) * stride;
    std::copy_n(buffers.inverse_depth + from, rows, through.inverse_depth + from);
    std::fill_n(through.id + from, rows, -1);
    const auto [tile, tiles] = tile_range(view, part->top, part->bottom);
    std::copy_n(buffers.hi_z + tile, tiles, through.hi_z + tile);
    rasterize_all(view, {renderable}, band, through);
    kernel.shade(view, *part, lighting, through);
  }
  kernel.resolve(view, band.top, band.bottom, buffers, target.rgb, target.depth);
  if (!target.segmentation) return;
  for (int32_t row = band.top; row < band.bottom; ++row)
    std::copy_n(buffers.segmentation + static_cast<size_t>(row) * stride, target.width,
                target.segmentation + static_cast<size_t>(row) * static_cast<size_t>(target.width));
}

}  // namespace trundle
