// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/storage/sample.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <random>

#include "storage/byte_order.h"
#include "storage/calibration_record.h"
#include "storage/sodium_sha256.h"

namespace relievo::storage::test {

using pipeline::FaceModel;

FaceModel sample_model(int side, unsigned seed) {
  FaceModel model(std::pmr::new_delete_resource());
  std::mt19937 random(seed);
  const auto noise = [&random] { return static_cast<float>(random()) / 4.3e9f; };
  auto& mesh = model.mesh;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const float u = static_cast<float>(x) / static_cast<float>(side - 1) - 0.5f;
      const float v = static_cast<float>(y) / static_cast<float>(side - 1) - 0.5f;
      mesh.vertices_mm.push_back(
          {160 * u + noise(), 200 * v + noise(), 600 + 120 * (u * u + v * v) + noise()});
      const float nx = 240 * u / 160, ny = 240 * v / 200, length = std::sqrt(nx * nx + ny * ny + 1);
      mesh.normals.push_back({nx / length, ny / length, -1 / length});
      mesh.sigma_mm.push_back(0.1f + noise());
      mesh.measured.push_back(static_cast<std::uint8_t>((x + y) % 5 != 0));
      for (int c = 0; c < 3; ++c) model.texture.vertex_rgb.push_back(static_cast<std::uint8_t>(random()));
    }
  }
  model.texture.width_px = 32;
  model.texture.height_px = 16;
  for (int i = 0; i < 32 * 16 * 3; ++i) model.texture.rgb.push_back(static_cast<std::uint8_t>(random()));
  for (int i = 0; i < 32 * 16; ++i) model.texture.origin.push_back(static_cast<std::uint8_t>(random()));
  const auto corner = [&](int x, int y, bool right_chart) {
    const float s = static_cast<float>(side - 1);
    model.texture.uv.push_back(
        {static_cast<float>(x) / s * 0.9f + (right_chart ? 0.1f : 0.0f), static_cast<float>(y) / s});
    return static_cast<std::uint32_t>(y * side + x);
  };
  for (int y = 0; y + 1 < side; ++y) {
    for (int x = 0; x + 1 < side; ++x) {
      const bool right = x >= side / 2;
      const auto at = [&](int dx, int dy) { return corner(x + dx, y + dy, right); };
      // x right, y down, z forward: this order is counter-clockwise seen from the camera.
      const std::uint32_t a = at(0, 0), b = at(0, 1), c = at(1, 0);
      mesh.triangles.push_back({a, b, c});
      const std::uint32_t d = at(1, 0), e = at(0, 1), f = at(1, 1);
      mesh.triangles.push_back({d, e, f});
    }
  }
  model.head_from_camera = {{{1, 0, 0, 0, -1, 0, 0, 0, -1}}, {0.1 + seed, 1.0 / 3.0, 600.5}};
  model.quality = {0.12, 15'000.3, 0.91, 140.2, 190.7,
                   23.4, 0.05,     0.7,  0.21,  {0.9, 0.31, 7.9, 3.6, 18.5, 7.25}};
  for (std::size_t k = 0; k < pipeline::kLandmarkCount; ++k)
    model.landmarks[k] = {{static_cast<float>(k) - 4.5F, static_cast<float>(seed), 610.25F},
                          0.5F + static_cast<float>(k),
                          k != 3};
  return model;
}

pipeline::RecognitionImages sample_images() {
  pipeline::RecognitionImages images(std::pmr::new_delete_resource());
  auto& p = images.portrait;
  p.width_px = 2;
  p.height_px = 1;
  p.rgb = {10, 20, 30, 200, 201, 202};
  p.shows = {2, 1};
  p.mm_per_px = 0.3;
  p.camera_mm = 1500;
  p.between_eyes_mm = 63.25;
  p.right_eye_px = {0.5, 0.25};
  p.left_eye_px = {1.5, 0.25};
  auto& r = images.range;
  r.width_px = 3;
  r.height_px = 2;
  r.pitch_mm = 0.5;
  r.first_mm = {-2.5, 7};
  r.z_mm = {0, -12.34f, 5, -400, 400, 0};
  r.sigma_mm = {0, 0.0123f, 0.1f, 0, 1000, 2};
  r.shows = {0, 2, 1, 2, 2, 2};
  return images;
}

pipeline::StereoCalibration sample_calibration() {
  pipeline::StereoCalibration c;
  c.left = {{1200.123456789012, 1201.1}, {640.25, 480.75}, {0.21, -0.1, 1e-5, -1e-6, 0.3}, 1280, 960};
  c.right = {{1199.0, 1198.0}, {650.0, 470.0}, {0.2, -0.11, 0, 0, 0}, 1280, 960};
  const double angle = 0.1;
  c.right_from_left = {{{std::cos(angle), 0, std::sin(angle), 0, 1, 0, -std::sin(angle), 0, std::cos(angle)}},
                       {-120.5, 0.25, 1.0 / 7}};
  c.rms_px = 0.123;
  return c;
}

NewEnrolment sample_enrolment(const FaceModel& model) {
  return {.model = model,
          .consent = {"2026-03", "en", WallTime(std::chrono::milliseconds(1'772'000'000'000))},
          .calibration_revision = 0,
          .algorithms = "[matcher]\nname = \"refined\"\n",
          .report_json = "{\"version\": \"0.1.0\"}"};
}

namespace {

template <typename Vector>
bool same(const Vector& a, const Vector& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0);
}

}  // namespace

bool identical(const FaceModel& a, const FaceModel& b) {
  return same(a.mesh.vertices_mm, b.mesh.vertices_mm) && same(a.mesh.normals, b.mesh.normals) &&
         same(a.mesh.sigma_mm, b.mesh.sigma_mm) && same(a.mesh.measured, b.mesh.measured) &&
         same(a.mesh.triangles, b.mesh.triangles) && same(a.mesh.pose, b.mesh.pose) &&
         same(a.texture.rgb, b.texture.rgb) && same(a.texture.uv, b.texture.uv) &&
         same(a.texture.vertex_rgb, b.texture.vertex_rgb) && same(a.texture.origin, b.texture.origin) &&
         a.texture.width_px == b.texture.width_px && a.texture.height_px == b.texture.height_px &&
         std::memcmp(&a.head_from_camera, &b.head_from_camera, sizeof a.head_from_camera) == 0 &&
         std::equal(a.landmarks.begin(), a.landmarks.end(), b.landmarks.begin(),
                    [](const auto& l, const auto& r) {
                      return std::memcmp(&l.at_mm, &r.at_mm, sizeof l.at_mm) == 0 &&
                             l.sigma_mm == r.sigma_mm && l.found == r.found;
                    }) &&
         std::memcmp(&a.quality, &b.quality, sizeof a.quality) == 0;
}

std::unique_ptr<Store> opened(const std::filesystem::path& dir, const SqliteStoreOptions& options) {
  static const StillClock clock;
  auto store = open_sqlite_store(dir, clock, options);
  if (!store) {
    ADD_FAILURE() << store.error().where() << ": " << store.error().what.view();
    return nullptr;
  }
  return *std::move(store);
}

std::string all_bytes(const std::filesystem::path& dir) {
  std::string bytes;
  for (const auto& entry : std::filesystem::directory_iterator(dir)) {
    std::ifstream file(entry.path(), std::ios::binary);
    bytes.append(std::istreambuf_iterator<char>(file), {});
  }
  return bytes;
}

}  // namespace relievo::storage::test
