// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// pipeline/ as a library for others: installed somewhere, found by a program that knows nothing but the
// place, and used on pictures of a simulated face whose true depth is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "pipeline/calibrate/file/calibration_file.h"
#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace relievo::test {
namespace {

struct Ply {
  std::vector<pipeline::Vec3d> vertices;
  std::size_t triangles = 0;
  bool whole = false;
};

Ply read_ply(const std::filesystem::path& file) {
  Ply ply;
  std::ifstream in(file);
  std::size_t vertices = 0, faces = 0;
  for (std::string word; in >> word && word != "end_header";)
    if (word == "vertex") in >> vertices;
    else if (word == "face") in >> faces;
  for (pipeline::Vec3d v; ply.vertices.size() < vertices && in >> v.x >> v.y >> v.z;)
    ply.vertices.push_back(v);
  ply.whole = ply.vertices.size() == vertices;
  for (std::size_t n, a, b, c; ply.triangles < faces && in >> n >> a >> b >> c; ++ply.triangles)
    ply.whole = ply.whole && n == 3 && std::max({a, b, c}) < vertices && a != b && b != c && c != a;
  ply.whole = ply.whole && ply.triangles == faces;
  return ply;
}

// The depth of every left pixel, NaN where nothing is.
struct Truth {
  explicit Truth(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::string letter;
    in >> width >> height >> letter;
    in.get();
    depth_mm.resize(static_cast<std::size_t>(width * height));
    in.read(reinterpret_cast<char*>(depth_mm.data()),
            static_cast<std::streamsize>(depth_mm.size() * sizeof(float)));
  }
  int width = 0, height = 0;
  std::vector<float> depth_mm;
};

// Where the left camera sees the point (Brown-Conrady).
pipeline::Vec2d project(const pipeline::CameraIntrinsics& camera, const pipeline::Vec3d& p) {
  const double x = p.x / p.z, y = p.y / p.z, r2 = x * x + y * y;
  const double* k = camera.distortion;
  const double radial = 1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  return {camera.focal_px.x * (x * radial + 2 * k[2] * x * y + k[3] * (r2 + 2 * x * x)) + camera.centre_px.x,
          camera.focal_px.y * (y * radial + k[2] * (r2 + 2 * y * y) + 2 * k[3] * x * y) + camera.centre_px.y};
}

class Package : public testing::Test {
 protected:
  testing::AssertionResult done(const std::vector<std::string>& words) {
    const Said said = run_program(words, here.path());
    if (said.exit_code == 0) return testing::AssertionSuccess();
    return testing::AssertionFailure() << words[0] << " " << words[1] << "\n" << said.out << said.err;
  }
  TemporaryFolder here;
};

TEST_F(Package, IsInstalledFoundBuiltAndMeasuresAFace) {
  ASSERT_TRUE(done({RELIEVO_CMAKE, "--install", RELIEVO_BUILD, "--component", "library", "--prefix",
                    (here / "installed").string()}));
  ASSERT_TRUE(done({RELIEVO_CMAKE, "-S", RELIEVO_EXAMPLES "/two_pictures_to_ply", "-B", "example", "-G",
                    RELIEVO_GENERATOR, "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_COMPILER=" RELIEVO_COMPILER,
                    "-DCMAKE_PREFIX_PATH=" + (here / "installed").string()}));
  ASSERT_TRUE(done({RELIEVO_CMAKE, "--build", "example"}));
  ASSERT_TRUE(
      done({RELIEVO_BINARY, "simulate", "face", "--seed", "4", "--scale", "0.5", "--truth", "-o", "face"}));
  ASSERT_TRUE(done({(here / "example" / "two_pictures_to_ply").string(), "face/left.png", "face/right.png",
                    "face/rig.yml", "face.ply"}));

  const Ply ply = read_ply(here / "face.ply");
  ASSERT_TRUE(ply.whole);
  EXPECT_GT(ply.vertices.size(), 30'000U);  // 150 by 180 mm, a vertex every 1.2 of the pixels of 0.38 mm
  EXPECT_LT(ply.vertices.size(), 130'000U);
  EXPECT_GT(ply.triangles, ply.vertices.size() * 3 / 2);
  const auto rig = pipeline::read_calibration(here / "face" / "rig.yml");
  ASSERT_TRUE(rig);
  const Truth truth(here / "face" / "truth.bin");
  std::vector<double> errors;
  for (const pipeline::Vec3d& v : ply.vertices) {
    const pipeline::Vec2d at = project(rig->left, v);
    const long x = std::lround(at.x), y = std::lround(at.y);
    ASSERT_TRUE(x >= 0 && y >= 0 && x < truth.width && y < truth.height);
    const double depth = static_cast<double>(truth.depth_mm[static_cast<std::size_t>(y * truth.width + x)]);
    if (std::abs(v.z - depth) < 15)
      errors.push_back(std::abs(v.z - depth));  // not where the face was completed before the room
  }
  EXPECT_GT(errors.size(), ply.vertices.size() * 85 / 100);
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[errors.size() / 2],
            0.35);  // mm; a pixel of disparity is 1.5 mm here, half a pixel of place 0.2
  EXPECT_LT(errors[errors.size() * 95 / 100], 3);  // mm, with what was completed
  RecordProperty("median_um", static_cast<int>(1000 * errors[errors.size() / 2]));
  RecordProperty("p95_um", static_cast<int>(1000 * errors[errors.size() * 95 / 100]));
}

TEST_F(Package, AllHeadersCompileTogetherWhereTheyWereInstalled) {
  ASSERT_TRUE(done({RELIEVO_CMAKE, "--install", RELIEVO_BUILD, "--component", "library", "--prefix",
                    (here / "installed").string()}));
  EXPECT_TRUE(std::filesystem::exists(here / "installed/share/doc/relievo/GPL-3.0-or-later.txt"));
  ASSERT_TRUE(done({RELIEVO_CMAKE, "-S", RELIEVO_PACKAGE_TESTS "/every_header", "-B", "every", "-G",
                    RELIEVO_GENERATOR, "-DCMAKE_CXX_COMPILER=" RELIEVO_COMPILER,
                    "-DCMAKE_PREFIX_PATH=" + (here / "installed").string()}));
  EXPECT_NE(read_text(here / "every/every_header.cc").find("\"pipeline/pipeline.h\""), std::string::npos);
  EXPECT_TRUE(done({RELIEVO_CMAKE, "--build", "every"}));
}

// Who links an older or a newer library than the program was written for is told.
TEST_F(Package, AnotherVersionIsRefused) {
  ASSERT_TRUE(done({RELIEVO_CMAKE, "--install", RELIEVO_BUILD, "--component", "library", "--prefix",
                    (here / "installed").string()}));
  write_text(
      here / "CMakeLists.txt",
      "cmake_minimum_required(VERSION 3.25)\nproject(p LANGUAGES CXX)\nfind_package(relievo 7.0 REQUIRED)\n");
  const Said said = run_program(
      {RELIEVO_CMAKE, "-S", ".", "-B", "b", "-G", RELIEVO_GENERATOR, "-DCMAKE_CXX_COMPILER=" RELIEVO_COMPILER,
       "-DCMAKE_PREFIX_PATH=" + (here / "installed").string()},
      here.path());
  EXPECT_NE(said.exit_code, 0);
  EXPECT_NE(said.err.find("relievo"), std::string::npos) << said.err;
}

// The program as an integrator installs it: it finds its words where it was put, and its unit starts it
// there.
TEST_F(Package, TheKioskIsInstalledWithItsWordsAndItsUnit) {
  const std::filesystem::path prefix = here / "opt";
  ASSERT_TRUE(
      done({RELIEVO_CMAKE, "--install", RELIEVO_BUILD, "--component", "kiosk", "--prefix", prefix.string()}));
  const std::string program = (prefix / "bin/relievo").string();
  ASSERT_TRUE(done({program, "version"}));
  EXPECT_TRUE(std::filesystem::exists(prefix / "share/relievo/assets/invitation_head.face"));
  // What its messages name, and the licence.
  EXPECT_NE(read_text(prefix / "share/doc/relievo/board.md").find("[trigger]"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(prefix / "share/doc/relievo/GPL-3.0-or-later.txt"));
  const std::string users = read_text(prefix / "lib/sysusers.d/relievo.conf");
  const std::string unit = read_text(prefix / "lib/systemd/system/relievo.service");
  for (const char* line : {"\ng tss -", "\nm relievo tss"}) EXPECT_NE(users.find(line), std::string::npos);
  EXPECT_NE(unit.find("\nSupplementaryGroups=video render input audio tss\n"), std::string::npos) << unit;
  // Each of these gives it mounts of its own: no stick could be unmounted.
  for (const char* word : {"ProtectSystem", "ProtectHome", "ProtectKernel", "ProtectControlGroups",
                           "ProtectProc", "Private", "ReadOnlyPaths", "InaccessiblePaths", "DynamicUser"})
    EXPECT_EQ(unit.find(std::string("\n") + word), std::string::npos) << word;
  EXPECT_NE(unit.find("\nExecStart=" + program + " --board linux"), std::string::npos) << unit;
  EXPECT_EQ(unit.find('@'), unit.find("@tty1")) << "something was not filled in";
  const std::filesystem::path words = prefix / "share/relievo/locale";
  ASSERT_TRUE(std::filesystem::remove(words / "C.UTF-8/LC_MESSAGES/relievo-ja.mo"));
  const Said said = run_program({program, "--store", "store", "--windowed", "640x480"}, here.path());
  EXPECT_EQ(said.exit_code, 1);
  EXPECT_NE(said.err.find(words.string() + ": has no words"), std::string::npos) << said.err;
}

}  // namespace
}  // namespace relievo::test
