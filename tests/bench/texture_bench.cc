// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
//   texture_bench LEFT RIGHT RIG.yml [OUT.png]
//
// The textured model of two pictures: what its seams look like (CIEDE2000), how fine its texels are against
// the photographs' pixels, how much of the atlas is used, what texture and files cost; and, into OUT.png, the
// model turned by -40, 0 and 40 degrees, to be looked at.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <span>
#include <thread>
#include <vector>

#include "hal/picture_file.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "pipeline/mesh/model_quality.h"
#include "pipeline/pipeline.h"
#include "pipeline/recognition/recognition_images.h"
#include "pipeline/texture/texturers.h"
#include "storage/export/format/export_mesh.h"
#include "storage/export/model_files.h"
#include "tests/support/stage_fixture.h"
#include "tests/support/texture_seams.h"

namespace relievo::bench {
namespace {

using namespace pipeline;  // NOLINT: one small program

template <typename T>
T need(Result<T> result) {
  if (!result) {
    std::fprintf(stderr, "texture_bench: %.*s %.*s\n", static_cast<int>(result.error().where().size()),
                 result.error().where().data(), static_cast<int>(result.error().what.view().size()),
                 result.error().what.view().data());
    std::exit(1);
  }
  return *std::move(result);
}

// The best of five, so that others on the machine count less: by the clock, and on the processors.
struct Cost {
  double ms = 1e9, cpu_ms = 1e9;
};
Cost& operator+=(Cost& sum, const Cost& one) {
  sum.ms += one.ms;
  sum.cpu_ms += one.cpu_ms;
  return sum;
}

template <typename Work>
Cost best_of_five(Work&& work) {
  Cost best;
  for (int round = 0; round < 5; ++round) {
    const auto begin = std::chrono::steady_clock::now();
    const std::clock_t cpu = std::clock();
    work();
    best.cpu_ms = std::min(best.cpu_ms, 1e3 * static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC);
    best.ms = std::min(
        best.ms, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
  }
  return best;
}

void print_seams(const char* what, const test::SeamReport& r) {
  std::printf(
      "%-34s %6zu edges, at the edge %.2f / %.2f, over 3 mm %.2f / %.2f (CIEDE2000, median / 95 %%)\n", what,
      r.step.count, r.step.median, r.step.p95, r.across.median, r.across.p95);
}

double area(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  return 0.5 * std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
}

// Texels and pixels of either photograph on the measured triangles, one against the other.
void print_texels(const FaceModel& model, const RectifiedPair& pair) {
  std::vector<std::pair<double, double>> ratio;  // texels a pixel of the better photograph; area
  double all_mm2 = 0, all_texels = 0;
  for (std::size_t k = 0; k < model.mesh.triangles.size(); ++k) {
    const auto& t = model.mesh.triangles[k];
    if (model.mesh.measured[t[0]] == 0 || model.mesh.measured[t[1]] == 0 || model.mesh.measured[t[2]] == 0)
      continue;
    Vec2d uv[3], left[3], right[3];
    Vec3d p[3];
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3f& v = model.mesh.vertices_mm[t[i]];
      p[i] = apply(pair.rectified_from_left, Vec3d{double{v.x}, double{v.y}, double{v.z}});
      left[i] = {pair.focal_px * p[i].x / p[i].z, pair.focal_px * p[i].y / p[i].z};
      right[i] = {left[i].x - pair.focal_px * pair.baseline_mm / p[i].z, left[i].y};
      uv[i] = {double{model.texture.uv[3 * k + i].x} * model.texture.width_px,
               double{model.texture.uv[3 * k + i].y} * model.texture.height_px};
    }
    const Vec3d u{p[1].x - p[0].x, p[1].y - p[0].y, p[1].z - p[0].z},
        w{p[2].x - p[0].x, p[2].y - p[0].y, p[2].z - p[0].z};
    const double mm2 = 0.5 * std::hypot(u.y * w.z - u.z * w.y, u.z * w.x - u.x * w.z, u.x * w.y - u.y * w.x);
    const double texels = area(uv[0], uv[1], uv[2]),
                 pixels = std::max(area(left[0], left[1], left[2]), area(right[0], right[1], right[2]));
    if (pixels > 1e-9) ratio.emplace_back(texels / pixels, mm2);
    all_mm2 += mm2;
    all_texels += texels;
  }
  std::sort(ratio.begin(), ratio.end());
  double below = 0, fifth = 0, half = 0;
  for (const auto& [r, mm2] : ratio) {
    below += mm2;
    if (fifth == 0 && below >= 0.05 * all_mm2) fifth = r;
    if (half == 0 && below >= 0.5 * all_mm2) half = r;
  }
  const auto used = std::count_if(model.texture.origin.begin(), model.texture.origin.end(),
                                  [](std::uint8_t o) { return o != kNoSurfaceTexel; });
  std::printf(
      "atlas %d x %d, %.0f %% used; %.2f texels a mm and side; texels a pixel of the better photograph: median %.2f, 5 %% have less than %.2f\n",
      model.texture.width_px, model.texture.height_px,
      100.0 * static_cast<double>(used) / static_cast<double>(model.texture.origin.size()),
      std::sqrt(all_texels / all_mm2), half, fifth);
}

auto png_of(int width_px, int height_px, const auto& rgb) {
  const auto bytes = std::as_bytes(std::span(rgb));
  return hal::encode_png({bytes.data(), width_px, height_px, 3 * width_px, PixelFormat::Rgb8});
}

void print_times(const FaceModel& model, const RectifiedPair& pair, test::StageFixture& fixture) {
  StageContext& c = fixture.context;
  const storage::ExportMesh mesh = need(storage::make_export_mesh(model, storage::ExportFrame::Head));
  const auto png = need(png_of(model.texture.width_px, model.texture.height_px, model.texture.rgb));
  std::pmr::unsynchronized_pool_resource heap;
  const auto images = need(make_recognition_images(model, heap, heap));
  Cost all{0, 0};
  const auto say = [&all](const char* what, const Cost& cost) {
    std::printf("  %-22s %6.0f ms %6.0f ms of the processors\n", what, cost.ms, cost.cpu_ms);
    all += cost;
  };
  say("texture", best_of_five([&] {
        Arena::Mark mark(fixture.output);
        need(run_stage(c, [&](StageContext& s) { return TwoViewTexturer({}).texture(model.mesh, pair, s); }));
      }));
  say("sharpness", best_of_five([&] { texture_sharpness(model.texture, c); }));
  say("into the head frame",
      best_of_five([&] { need(storage::make_export_mesh(model, storage::ExportFrame::Head)); }));
  say("png", best_of_five(
                 [&] { need(png_of(model.texture.width_px, model.texture.height_px, model.texture.rgb)); }));
  say("ply", best_of_five([&] { storage::ply_bytes(mesh); }));
  say("stl", best_of_five([&] { storage::stl_bytes(mesh); }));
  say("obj", best_of_five([&] { storage::obj_text(mesh, "model.mtl"); }));
  say("glb", best_of_five([&] { storage::glb_bytes(mesh, png); }));
  say("portrait and range", best_of_five([&] { need(make_recognition_images(model, heap, heap)); }));
  say("their files", best_of_five([&] {
        need(storage::recognition_files(images, model.landmarks, model.head_from_camera, ""));
      }));
  const Cost sum = all;
  say("all", sum);
}

void draw_three_sides(const FaceModel& model, const char* file) {
  constexpr int kWidth = 560, kHeight = 720;
  std::vector<std::uint8_t> sheet(3 * kWidth * 3 * kHeight);
  for (int side = 0; side < 3; ++side) {
    const double yaw = (side - 1) * 0.698;
    const double s = std::sin(yaw), k = std::cos(yaw);
    // The head turned about an axis 40 mm behind the tip of the nose, seen from 700 mm.
    const double turn[9] = {k, 0, s, 0, 1, 0, -s, 0, k};
    ViewCamera camera;
    camera.width_px = kWidth;
    camera.height_px = kHeight;
    camera.focal_px = 2300;
    camera.centre_px = {kWidth / 2.0, kHeight / 2.0};
    camera.background = {40, 40, 40};
    const auto place = [&](const Vec3d& camera_mm) {
      const Vec3d h = apply(model.head_from_camera, camera_mm);
      const Vec3d q{h.x, h.y - 15, h.z + 40};
      return Vec3d{turn[0] * q.x + turn[2] * q.z, -q.y, 700 - (turn[6] * q.x + turn[8] * q.z)};
    };
    const Vec3d o = place({0, 0, 0});
    const Vec3d axes[3] = {place({1, 0, 0}), place({0, 1, 0}), place({0, 0, 1})};
    for (int column = 0; column < 3; ++column) {
      camera.view_from_camera.rotation.m[column] = axes[column].x - o.x;
      camera.view_from_camera.rotation.m[3 + column] = axes[column].y - o.y;
      camera.view_from_camera.rotation.m[6 + column] = axes[column].z - o.z;
    }
    camera.view_from_camera.translation_mm = o;
    const TexturedView view = draw_textured(model.mesh, model.texture, camera,
                                            std::pmr::new_delete_resource(), std::pmr::new_delete_resource());
    for (int y = 0; y < kHeight; ++y)
      std::copy_n(&view.rgb[static_cast<std::size_t>(3 * y * kWidth)], 3 * kWidth,
                  &sheet[static_cast<std::size_t>(3 * (y * 3 * kWidth + side * kWidth))]);
  }
  const auto png = need(png_of(3 * kWidth, kHeight, sheet));
  std::FILE* out = std::fopen(file, "wb");
  if (out == nullptr || std::fwrite(png.data(), 1, png.size(), out) != png.size() || std::fclose(out) != 0)
    std::exit(1);
}

}  // namespace
}  // namespace relievo::bench

int main(int argc, char** argv) {
  using namespace relievo;
  using namespace relievo::bench;
  if (argc < 4) {
    std::fprintf(stderr, "usage: texture_bench LEFT RIGHT RIG.yml [OUT.png]\n");
    return 2;
  }
  test::StageFixture fixture(std::size_t{512} << 20, std::size_t{640} << 20,
                             static_cast<int>(std::thread::hardware_concurrency()));
  pipeline::StageContext& c = fixture.context;
  const auto left = need(hal::read_picture(argv[1]));
  const auto right = need(hal::read_picture(argv[2]));
  const auto calibration = need(pipeline::read_calibration(argv[3], {left.width_px, left.height_px, 0}));
  const auto stages = need(pipeline::Pipeline::make({}, calibration));
  auto pair = need(stages.rectify({left.view(), right.view(), 0, 0}, c));
  const auto matches = need(stages.match(pair, c));
  const auto cloud = need(stages.reconstruct(pair, matches, c));
  auto mesh = need(stages.mesh(cloud, pair, c));
  const auto alone = need(pipeline::run_stage(
      c, [&](pipeline::StageContext& s) { return pipeline::SingleViewTexturer({}).texture(mesh, pair, s); }));
  auto texture = need(stages.texture(mesh, pair, c));
  const auto model = need(stages.assemble(std::move(mesh), std::move(texture), pair, c));
  print_seams("seams, two-view", test::measure_seams(model.mesh, model.texture, &alone));
  print_texels(model, pair);
  std::printf("sharpness %.3f\n", model.quality.texture_sharpness);
  print_times(model, pair, fixture);
  if (argc > 4) draw_three_sides(model, argv[4]);
  return 0;
}
