// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/recognition/textured_view.h"

#include <algorithm>

#include "pipeline/model/photo_sampler.h"
#include "pipeline/model/recognition_images.h"
#include "pipeline/texture/chart/raster.h"

namespace relievo::pipeline {
namespace {

constexpr int kFiner = 2;  // samples a pixel and side

struct Seen {
  Vec2f at;
  float z_mm;
};  // in samples; not in front of the camera: z <= 0

std::pmr::vector<Seen> project(const FaceMesh& mesh, const ViewCamera& camera,
                               std::pmr::memory_resource* memory) {
  std::pmr::vector<Seen> seen(memory);
  seen.reserve(mesh.vertices_mm.size());
  for (const Vec3f& v : mesh.vertices_mm) {
    const Vec3d p = apply(camera.view_from_camera, Vec3d{static_cast<double>(v.x), static_cast<double>(v.y),
                                                         static_cast<double>(v.z)});
    if (p.z < 1) {
      seen.push_back({{0, 0}, 0});
      continue;
    }
    // The centre of a pixel lies between its samples.
    const double x = camera.centre_px.x + camera.focal_px * p.x / p.z,
                 y = camera.centre_px.y + camera.focal_px * p.y / p.z;
    seen.push_back(
        {{static_cast<float>((x + 0.5) * kFiner - 0.5), static_cast<float>((y + 0.5) * kFiner - 0.5)},
         static_cast<float>(p.z)});
  }
  return seen;
}

struct Samples {
  Samples(int width_px, int height_px, std::pmr::memory_resource* memory)
      : width(kFiner * width_px),
        height(kFiner * height_px),
        depth(size(), 1e30F, memory),
        rgb(3 * size(), 0, memory),
        shows(size(), kNothingShown, memory) {}
  std::size_t size() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  int width, height;
  std::pmr::vector<float> depth;
  std::pmr::vector<std::uint8_t> rgb;
  std::pmr::vector<std::uint8_t> shows;
};

void read_texel(const TextureAtlas& atlas, float u, float v, std::uint8_t* rgb, std::uint8_t& shows) {
  const float x =
      std::clamp(u * static_cast<float>(atlas.width_px) - 0.5F, 0.0F, static_cast<float>(atlas.width_px - 1));
  const float y = std::clamp(v * static_cast<float>(atlas.height_px) - 0.5F, 0.0F,
                             static_cast<float>(atlas.height_px - 1));
  const std::size_t w = static_cast<std::size_t>(atlas.width_px);
  const std::size_t k = static_cast<std::size_t>(y) * w + static_cast<std::size_t>(x);
  const float fx = x - std::floor(x);
  const float fy = y - std::floor(y);
  const std::size_t right = fx > 0 ? 3 : 0;
  const std::size_t below = fy > 0 ? 3 * w : 0;
  const std::uint8_t* p = &atlas.rgb[3 * k];
  for (std::size_t c = 0; c < 3; ++c) {
    const float upper = static_cast<float>(p[c]) + fx * static_cast<float>(p[right + c] - p[c]);
    const float lower =
        static_cast<float>(p[below + c]) + fx * static_cast<float>(p[below + right + c] - p[below + c]);
    rgb[c] = to_byte(upper + fy * (lower - upper));
  }
  if (!atlas.origin.empty() && atlas.origin[k] == kFilledTexel) shows = kCompletedShown;
}

void draw(const FaceMesh& mesh, const TextureAtlas& atlas, std::span<const Seen> seen, Samples& samples) {
  const auto measured = [&](std::uint32_t v) { return mesh.measured.empty() || mesh.measured[v] != 0; };
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const auto& t = mesh.triangles[k];
    const Seen& a = seen[t[0]];
    const Seen& b = seen[t[1]];
    const Seen& c = seen[t[2]];
    if (a.z_mm <= 0 || b.z_mm <= 0 || c.z_mm <= 0) continue;
    const std::uint8_t shows =
        measured(t[0]) && measured(t[1]) && measured(t[2]) ? kMeasuredShown : kCompletedShown;
    const Vec2f* uv = &atlas.uv[3 * k];
    for_each_texel(a.at, b.at, c.at, samples.width, {0, samples.height},
                   [&](int x, int y, float wa, float wb, float wc) {
                     const std::size_t at = samples.index(x, y);
                     const float z = wa * a.z_mm + wb * b.z_mm + wc * c.z_mm;
                     if (z >= samples.depth[at]) return;
                     samples.depth[at] = z;
                     samples.shows[at] = shows;
                     read_texel(atlas, wa * uv[0].x + wb * uv[1].x + wc * uv[2].x,
                                wa * uv[0].y + wb * uv[1].y + wc * uv[2].y, &samples.rgb[3 * at],
                                samples.shows[at]);
                   });
  }
}

}  // namespace

TexturedView draw_textured(const FaceMesh& mesh, const TextureAtlas& atlas, const ViewCamera& camera,
                           std::pmr::memory_resource* output, std::pmr::memory_resource* scratch) {
  Samples samples(camera.width_px, camera.height_px, scratch);
  if (!atlas.uv.empty()) draw(mesh, atlas, project(mesh, camera, scratch), samples);
  TexturedView view(output);
  const std::size_t size =
      static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(camera.height_px);
  view.rgb.resize(3 * size);
  view.shows.resize(size);
  std::size_t k = 0;
  for (int y = 0; y < camera.height_px; ++y)
    for (int x = 0; x < camera.width_px; ++x, ++k) {
      int sum[3] = {0, 0, 0};
      int of[3] = {0, 0, 0};  // samples of each kind
      for (int s = 0; s < kFiner * kFiner; ++s) {
        const std::size_t at = samples.index(kFiner * x + s % kFiner, kFiner * y + s / kFiner);
        ++of[samples.shows[at]];
        for (std::size_t c = 0; c < 3; ++c)
          sum[c] += samples.shows[at] == kNothingShown ? camera.background[c] : samples.rgb[3 * at + c];
      }
      for (std::size_t c = 0; c < 3; ++c)
        view.rgb[3 * k + c] = static_cast<std::uint8_t>((sum[c] + kFiner * kFiner / 2) / (kFiner * kFiner));
      // Completed wins a tie against measured: nothing invented passes as measured.
      view.shows[k] = 2 * of[0] > kFiner * kFiner   ? kNothingShown
                      : of[1] >= of[2] && of[1] > 0 ? kCompletedShown
                                                    : kMeasuredShown;
    }
  return view;
}

}  // namespace relievo::pipeline
