// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/recognition/recognition_images.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "pipeline/model/photo_sampler.h"
#include "pipeline/model/vector3.h"
#include "pipeline/texture/chart/raster.h"

namespace relievo::pipeline {
namespace {

constexpr float kLeastFacing = 0.0872F;  // cosine of 85 degrees

// 200 x 250 mm about the tip of the nose.
constexpr double kPitchMm = 0.5;
constexpr Vec2d kFirstMm{-100, 130};
constexpr int kRangeWidthPx = 401, kRangeHeightPx = 501;

// A vertex in a picture.
struct Seen {
  Vec2f at;  // pixels, or samples
  float z_mm;
};

// Cosine between a triangle's normal and +z; negative from behind. Rows run downwards, hence the sign.
float facing(const Seen& a, const Seen& b, const Seen& c) {
  const auto side = [&](const Seen& to) {
    constexpr auto kPitch = float(kPitchMm);
    return Vec3f{(to.at.x - a.at.x) * kPitch, -(to.at.y - a.at.y) * kPitch, to.z_mm - a.z_mm};
  };
  const Vec3f normal = cross(side(b), side(c));
  const float size = length(normal);
  return size > 0 ? normal.z / size : 0;
}

constexpr int kWidthPx = 840;
constexpr int kHeightPx = 1080;
constexpr double kMmPerPx = 0.3;
constexpr double kCameraMm = 1500;
constexpr double kEyeLine = 0.45;  // of the height, from above
// From the tip of the nose, where eyes were not found; faces differ by some millimetres.
constexpr Vec3d kTypicalEyesMm{0, 34, -30};

Vec3d middle(const Vec3d& a, const Vec3d& b) { return times(plus(a, b), 0.5); }

struct Eyes {
  Vec3d right_mm, left_mm;
  bool found;
};

// The middle of each eye from its corners; a corner that was not found is the other side's mirror image.
Eyes eyes_of(const FaceModel& model) {
  Eyes eyes{{}, {}, true};
  const auto corner = [&](LandmarkName name, LandmarkName mirrored) {
    const bool own = of(model.landmarks, name).found;
    const Landmark& l = of(model.landmarks, own ? name : mirrored);
    eyes.found = eyes.found && l.found;
    Vec3d at = apply(model.head_from_camera, wide(l.at_mm));
    if (!own) at.x = -at.x;
    return at;
  };
  using enum LandmarkName;
  eyes.right_mm =
      middle(corner(EndocanthionRight, EndocanthionLeft), corner(ExocanthionRight, ExocanthionLeft));
  eyes.left_mm =
      middle(corner(EndocanthionLeft, EndocanthionRight), corner(ExocanthionLeft, ExocanthionRight));
  return eyes;
}

constexpr int kFiner = 2;  // samples a pixel and side

// In samples; what is not in front of the camera has no z.
std::pmr::vector<Seen> project(const FaceMesh& mesh, const ViewCamera& camera,
                               std::pmr::memory_resource* memory) {
  std::pmr::vector<Seen> seen(memory);
  seen.reserve(mesh.vertices_mm.size());
  for (const Vec3f& v : mesh.vertices_mm) {
    const Vec3d p = apply(camera.view_from_camera, wide(v));
    if (p.z < 1) {
      seen.push_back({{0, 0}, 0});
      continue;
    }
    // The centre of a pixel lies between its samples.
    const double x = camera.centre_px.x + camera.focal_px * p.x / p.z,
                 y = camera.centre_px.y + camera.focal_px * p.y / p.z;
    seen.push_back({{float((x + 0.5) * kFiner - 0.5), float((y + 0.5) * kFiner - 0.5)}, float(p.z)});
  }
  return seen;
}

struct Samples : PixelGrid {
  Samples(const PixelGrid& picture, std::pmr::memory_resource* memory)
      : PixelGrid{kFiner * picture.width_px, kFiner * picture.height_px},
        depth(pixels(), 1e30F, memory),
        rgb(3 * pixels(), 0, memory),
        shows(pixels(), kNothingShown, memory) {}
  std::pmr::vector<float> depth;
  std::pmr::vector<std::uint8_t> rgb;
  std::pmr::vector<std::uint8_t> shows;
};

void read_texel(const TextureAtlas& atlas, float u, float v, std::uint8_t* rgb, std::uint8_t& shows) {
  const float x = std::clamp(u * float(atlas.width_px) - 0.5F, 0.0F, float(atlas.width_px - 1));
  const float y = std::clamp(v * float(atlas.height_px) - 0.5F, 0.0F, float(atlas.height_px - 1));
  float colour[3];
  PhotoSampler(atlas.rgb, atlas.width_px, atlas.height_px).read(x, y, colour);
  for (std::size_t c = 0; c < 3; ++c) rgb[c] = to_byte(colour[c]);
  const std::size_t k = atlas.index(int(x + 0.5F), int(y + 0.5F));
  if (!atlas.origin.empty() && atlas.origin[k] == kFilledTexel) shows = kCompletedShown;
}

// Of a triangle.
std::uint8_t shown(const FaceMesh& mesh, const Triangle& triangle) {
  const auto measured = [&](std::uint32_t v) { return mesh.measured.empty() || mesh.measured[v] != 0; };
  return std::ranges::all_of(triangle, measured) ? kMeasuredShown : kCompletedShown;
}

void draw(const FaceMesh& mesh, const TextureAtlas& atlas, std::span<const Seen> seen, Samples& samples) {
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const auto& t = mesh.triangles[k];
    const Seen& a = seen[t[0]];
    const Seen& b = seen[t[1]];
    const Seen& c = seen[t[2]];
    if (a.z_mm <= 0 || b.z_mm <= 0 || c.z_mm <= 0) continue;
    const std::uint8_t shows = shown(mesh, t);
    const Vec2f* uv = &atlas.uv[3 * k];
    for_each_texel(a.at, b.at, c.at, samples.width_px, {0, samples.height_px},
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

RangeImage measure_range(const FaceMesh& mesh, const RigidTransform& head_from_camera,
                         std::pmr::memory_resource* output, std::pmr::memory_resource* scratch) {
  RangeImage image(output);
  image.width_px = kRangeWidthPx;
  image.height_px = kRangeHeightPx;
  image.pitch_mm = kPitchMm;
  image.first_mm = kFirstMm;
  constexpr std::size_t kSize = std::size_t{kRangeWidthPx} * kRangeHeightPx;
  image.z_mm.assign(kSize, 0);
  image.sigma_mm.assign(kSize, 0);
  image.shows.assign(kSize, kNothingShown);
  std::pmr::vector<Seen> points(scratch);
  points.reserve(mesh.vertices_mm.size());
  for (const Vec3f& v : mesh.vertices_mm) {
    const Vec3d p = apply(head_from_camera, wide(v));
    points.push_back(
        {{float((p.x - kFirstMm.x) / kPitchMm), float((kFirstMm.y - p.y) / kPitchMm)}, float(p.z)});
  }
  const auto sigma = [&](std::uint32_t v) { return mesh.sigma_mm.empty() ? 0.0F : mesh.sigma_mm[v]; };
  for (const auto& t : mesh.triangles) {
    const Seen& a = points[t[0]];
    const Seen& b = points[t[1]];
    const Seen& c = points[t[2]];
    const float cosine = facing(a, b, c);
    if (cosine < kLeastFacing) continue;
    const std::uint8_t shows = shown(mesh, t);
    for_each_texel(a.at, b.at, c.at, kRangeWidthPx, {0, kRangeHeightPx},
                   [&](int x, int y, float wa, float wb, float wc) {
                     const std::size_t k = std::size_t(y) * kRangeWidthPx + std::size_t(x);
                     const float z = wa * a.z_mm + wb * b.z_mm + wc * c.z_mm;
                     if (image.shows[k] != kNothingShown && z <= image.z_mm[k]) return;
                     image.z_mm[k] = z;
                     // The mesh knows its deviation across the surface; along z a slope makes it longer.
                     image.sigma_mm[k] = (wa * sigma(t[0]) + wb * sigma(t[1]) + wc * sigma(t[2])) / cosine;
                     image.shows[k] = shows;
                   });
  }
  return image;
}

Portrait draw_portrait(const FaceModel& model, std::pmr::memory_resource* output,
                       std::pmr::memory_resource* scratch) {
  Portrait portrait(output);
  portrait.width_px = kWidthPx;
  portrait.height_px = kHeightPx;
  portrait.mm_per_px = kMmPerPx;
  portrait.camera_mm = kCameraMm;
  portrait.eyes_mm = kTypicalEyesMm;
  portrait.eyes_px = {(kWidthPx - 1) / 2.0, kEyeLine * kHeightPx};
  if (const Eyes eyes = eyes_of(model); eyes.found) {
    const Vec3d &r = eyes.right_mm, &l = eyes.left_mm;
    portrait.eyes_mm = middle(r, l);
    portrait.between_eyes_mm = std::hypot(l.x - r.x, l.y - r.y, l.z - r.z);
    portrait.right_eye_px = portrait.place_of(r);
    portrait.left_eye_px = portrait.place_of(l);
  }

  ViewCamera camera;
  camera.width_px = kWidthPx;
  camera.height_px = kHeightPx;
  camera.focal_px = kCameraMm / kMmPerPx;
  camera.centre_px = portrait.eyes_px;
  // x stays, y and z turn: the camera looks along the head's -z and counts rows downwards.
  const RigidTransform& head = model.head_from_camera;
  for (int i = 0; i < 9; ++i) camera.view_from_camera.rotation.m[i] = (i < 3 ? 1 : -1) * head.rotation.m[i];
  camera.view_from_camera.translation_mm = {head.translation_mm.x - portrait.eyes_mm.x,
                                            -(head.translation_mm.y - portrait.eyes_mm.y),
                                            -(head.translation_mm.z - portrait.eyes_mm.z) + kCameraMm};
  TexturedView view = draw_textured(model.mesh, model.texture, camera, output, scratch);
  portrait.rgb = std::move(view.rgb);
  portrait.shows = std::move(view.shows);
  return portrait;
}

TexturedView draw_textured(const FaceMesh& mesh, const TextureAtlas& atlas, const ViewCamera& camera,
                           std::pmr::memory_resource* output, std::pmr::memory_resource* scratch) {
  Samples samples({camera.width_px, camera.height_px}, scratch);
  if (!atlas.uv.empty()) draw(mesh, atlas, project(mesh, camera, scratch), samples);
  TexturedView view(output);
  const std::size_t size = std::size_t(camera.width_px) * std::size_t(camera.height_px);
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
        view.rgb[3 * k + c] = std::uint8_t((sum[c] + kFiner * kFiner / 2) / (kFiner * kFiner));
      // Completed wins a tie against measured: nothing invented passes as measured.
      view.shows[k] = 2 * of[0] > kFiner * kFiner   ? kNothingShown
                      : of[1] >= of[2] && of[1] > 0 ? kCompletedShown
                                                    : kMeasuredShown;
    }
  return view;
}

Result<RecognitionImages> make_recognition_images(const FaceModel& model, std::pmr::memory_resource& output,
                                                  std::pmr::memory_resource& scratch) {
  if (model.mesh.triangles.empty()) return invalid("there is no surface to draw");
  try {
    RecognitionImages images(&output);
    images.portrait = draw_portrait(model, &output, &scratch);
    images.range = measure_range(model.mesh, model.head_from_camera, &output, &scratch);
    return images;
  } catch (const std::bad_alloc&) {
    return Error{Errc::OutOfMemory, "not enough memory for the portrait and the range image"};
  }
}

}  // namespace relievo::pipeline
