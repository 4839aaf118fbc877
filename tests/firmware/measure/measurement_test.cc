// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Truth first: a bumpy surface with known depth, and models of it with known errors.
#include "firmware/measure/measurement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "pipeline/calibrate/file/calibration_file.h"
#include "tests/support/temporary_folder.h"

namespace relievo::firmware::measure {
namespace {

constexpr int kWidth = 200;
constexpr int kHeight = 160;
constexpr double kFocal = 600;

double depth_at(double x_mm, double y_mm) {
  return 500 + 0.004 * (x_mm * x_mm + y_mm * y_mm) + 3 * std::sin(0.15 * x_mm) * std::cos(0.12 * y_mm);
}

Vec3d seen_at(double u, double v) {
  const double dx = (u - kWidth / 2) / kFocal;
  const double dy = (v - kHeight / 2) / kFocal;
  double z = 500;
  for (int i = 0; i < 50; ++i) z = depth_at(dx * z, dy * z);
  return {dx * z, dy * z, z};
}

Surface bumps(double step_px) {
  Surface s;
  const int nx = static_cast<int>(kWidth / step_px);
  const int ny = static_cast<int>(kHeight / step_px);
  for (int y = 0; y < ny; ++y) {
    for (int x = 0; x < nx; ++x) {
      const Vec3d p = seen_at(x * step_px, y * step_px);
      s.vertices_mm.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
      if (x == 0 || y == 0) continue;
      const auto i = static_cast<std::uint32_t>(y * nx + x);
      const auto n = static_cast<std::uint32_t>(nx);
      s.triangles.push_back({i, i - n, i - 1});
      s.triangles.push_back({i - n, i - n - 1, i - 1});
    }
  }
  return s;
}

void write_truth(const test::TemporaryFolder& folder) {
  pipeline::StereoCalibration rig;
  for (pipeline::CameraIntrinsics* c : {&rig.left, &rig.right}) {
    *c = {{kFocal, kFocal}, {kWidth / 2, kHeight / 2}, {0, 0, 0, 0, 0}, kWidth, kHeight};
  }
  rig.right_from_left.translation_mm = {-100, 0, 0};
  ASSERT_TRUE(pipeline::write_calibration(folder / "rig.yml", rig));
  std::string text = std::to_string(kWidth) + " " + std::to_string(kHeight) + " z\n";
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const auto z = static_cast<float>(seen_at(x, y).z);
      char bytes[4];
      std::memcpy(bytes, &z, 4);
      text.append(bytes, 4);
    }
  }
  text.append(static_cast<std::size_t>(kWidth * kHeight), '\x07');
  test::write_text(folder / "truth.bin", text);
}

// In gentle waves nearer and further.
pipeline::FaceMesh mesh_of(const Surface& s, double error_mm, float sigma_mm) {
  pipeline::FaceMesh mesh(std::pmr::get_default_resource());
  for (std::size_t i = 0; i < s.vertices_mm.size(); ++i) {
    Vec3f v = s.vertices_mm[i];
    const double across = static_cast<double>(i % kWidth) / 6;
    const double down = static_cast<double>(i) / kWidth / 6;
    v.z += static_cast<float>(error_mm * std::sin(across) * std::sin(down));
    mesh.vertices_mm.push_back(v);
    mesh.sigma_mm.push_back(sigma_mm);
    mesh.measured.push_back(1);
  }
  mesh.triangles.assign(s.triangles.begin(), s.triangles.end());
  return mesh;
}

double to_segment(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const Vec3d ab = minus(b, a);
  const double t = std::clamp(dot(minus(p, a), ab) / dot(ab, ab), 0.0, 1.0);
  return distance(p, plus(a, times(ab, t)));
}

// The slow twin: the foot on the plane where it lies inside, else the nearest edge.
double to_triangle(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d n = cross(minus(b, a), minus(c, a));
  const auto side = [&](const Vec3d& from, const Vec3d& to) {
    return dot(cross(minus(to, from), minus(p, from)), n);
  };
  if (side(a, b) >= 0 && side(b, c) >= 0 && side(c, a) >= 0) return std::abs(dot(minus(p, a), n)) / length(n);
  return std::min({to_segment(p, a, b), to_segment(p, b, c), to_segment(p, c, a)});
}

TEST(TriangleGrid, AgreesWithLookingAtEveryTriangle) {
  const Surface s = bumps(8);
  const TriangleGrid grid(s);
  unsigned seed = 7;
  const auto random = [&seed](double from, double to) {
    seed = seed * 1664525U + 1013904223U;
    return from + (to - from) * static_cast<double>(seed >> 8) / 16777216.0;
  };
  for (int i = 0; i < 300; ++i) {
    const Vec3d p{random(-100, 100), random(-80, 80), random(490, 580)};
    double slow = 1e9;
    for (const auto& t : s.triangles) {
      slow = std::min(slow, to_triangle(p, wide(s.vertices_mm[t[0]]), wide(s.vertices_mm[t[1]]),
                                        wide(s.vertices_mm[t[2]])));
    }
    const auto fast = grid.nearest(p, 120);
    ASSERT_TRUE(fast);
    EXPECT_NEAR(fast->distance_mm, slow, 1e-9);
    EXPECT_NEAR(distance(fast->at_mm, p), slow, 1e-9);
    EXPECT_FALSE(grid.nearest(p, slow * 0.999));
  }
}

TEST(TriangleGrid, NothingIsNearAnEmptySurface) {
  const Surface none;
  EXPECT_FALSE(TriangleGrid(none).nearest({0, 0, 0}, 1000));
}

TEST(RigidFit, FindsTheMotionBack) {
  const Surface s = bumps(2);
  const TriangleGrid grid(s);
  const double angle = 0.01;
  const pipeline::RigidTransform moved{
      {{std::cos(angle), 0, std::sin(angle), 0, 1, 0, -std::sin(angle), 0, std::cos(angle)}}, {-4, 1, 3}};
  std::vector<Vec3d> points;
  for (int v = 20; v < kHeight - 20; v += 4) {
    for (int u = 20; u < kWidth - 20; u += 4) points.push_back(apply(moved, seen_at(u, v)));
  }
  const RigidFit fit = fit_rigidly(points, grid);
  std::vector<double> left;
  for (const Vec3d& p : points)
    left.push_back(grid.nearest(apply(fit.surface_from_points, p), 5)->distance_mm);
  for (const double d : left) EXPECT_LT(d, 0.03);
  EXPECT_NEAR(fit.turned_deg, angle * 180 / 3.14159265, 0.05);
}

TEST(Measurement, APerfectModelIsPerfectAndAKnownErrorIsFound) {
  const test::TemporaryFolder folder;
  write_truth(folder);
  const auto truth = TruthView::read(folder.path());
  ASSERT_TRUE(truth);
  const Surface s = bumps(1);
  const Measurement perfect = measure(mesh_of(s, 0, 0.01F), *truth, bumps(1));
  EXPECT_LT(perfect.interior_median_mm, 0.002);
  EXPECT_LT(perfect.accuracy_p95_mm, 0.01);
  EXPECT_GT(perfect.complete_quarter_mm, 0.98);
  EXPECT_EQ(perfect.outliers_3mm, 0);
  const Measurement rough = measure(mesh_of(s, 0.3, 0.31F), *truth, bumps(1));
  EXPECT_GT(rough.interior_median_mm, 0.06);
  EXPECT_LT(rough.moved_mm, 0.05);
  EXPECT_LT(rough.interior_median_mm, 0.3);
  EXPECT_GT(rough.within_sigma, 0.95);
  EXPECT_LT(measure(mesh_of(s, 0.3, 0.03F), *truth, bumps(1)).within_sigma, 0.35);
}

TEST(Measurement, HalfAModelIsHalfComplete) {
  const test::TemporaryFolder folder;
  write_truth(folder);
  const auto truth = TruthView::read(folder.path());
  ASSERT_TRUE(truth);
  Surface s = bumps(1);
  std::erase_if(s.triangles, [&](const auto& t) { return s.vertices_mm[t[0]].x > 0; });
  const Measurement half = measure(mesh_of(s, 0, 0.01F), *truth, bumps(1));
  EXPECT_NEAR(half.complete_half_mm, 0.5, 0.06);
  EXPECT_LT(half.accuracy_p95_mm, 0.01);
}

TEST(TrueSurface, ReadsOneFormOfPlyAndNothingElse) {
  std::string text =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 5};
  text.append(reinterpret_cast<const char*>(corners), sizeof corners);
  text.append("\x03\0\0\0\0\1\0\0\0\2\0\0\0", 13);
  const auto surface = parse_true_surface(text);
  ASSERT_TRUE(surface);
  EXPECT_EQ(surface->vertices_mm[2].z, 5);
  EXPECT_EQ(surface->triangles[0][2], 2U);
  for (std::size_t length = 0; length < text.size(); ++length)
    EXPECT_FALSE(parse_true_surface(text.substr(0, length)));
  EXPECT_FALSE(parse_true_surface(text + "x"));
  text[text.size() - 4] = '\x03';  // a corner that is not there
  EXPECT_FALSE(parse_true_surface(text));
}

// A bit of the exponent is wrong.
TEST(TrueSurface, RefusesACornerFartherThanAnyHead) {
  for (const float far : {1e30F, -1e30F, 1e6F}) {
    std::string text =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    const float corners[9] = {0, 0, 0, 1, 0, 0, 0, far, 5};
    text.append(reinterpret_cast<const char*>(corners), sizeof corners);
    text.append("\x03\0\0\0\0\1\0\0\0\2\0\0\0", 13);
    const auto surface = parse_true_surface(text);
    ASSERT_FALSE(surface) << far;
    EXPECT_EQ(surface.error().code, Errc::InvalidInput);
  }
}

TEST(TruthView, RefusesWhatIsNone) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(TruthView::read(folder.path()).error().code, Errc::NotFound);
  write_truth(folder);
  const std::string whole = test::read_text(folder / "truth.bin");
  for (const std::string& bad :
       {std::string("x"), whole.substr(0, whole.size() - 1), whole + "x", "-1 -1 z\n" + whole}) {
    test::write_text(folder / "truth.bin", bad);
    EXPECT_EQ(TruthView::read(folder.path()).error().code, Errc::InvalidInput);
  }
  // Another rig's: as wide, not as high.
  test::write_text(folder / "truth.bin", whole);
  auto rig = pipeline::read_calibration(folder / "rig.yml");
  ASSERT_TRUE(rig);
  rig->left.height_px = rig->right.height_px = kHeight / 2;
  ASSERT_TRUE(pipeline::write_calibration(folder / "rig.yml", *rig));
  EXPECT_EQ(TruthView::read(folder.path()).error().code, Errc::InvalidInput);
}

}  // namespace
}  // namespace relievo::firmware::measure
