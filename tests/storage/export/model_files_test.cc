// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/export/model_files.h"

#include <gtest/gtest.h>

#include <sys/mount.h>
#include <sys/resource.h>

#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <sstream>
#include <thread>

#include "hal/base/whole_file.h"
#include "storage/byte_order.h"
#include "storage/export/format/export_mesh.h"
#include "tests/storage/sample.h"
#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace relievo::storage {
namespace {

using relievo::test::TemporaryFolder;
using test::sample_model;

// Those that were found: name, place in the frame of the file, sigma.
std::string landmark_lines(const pipeline::FaceModel& model) {
  std::ostringstream lines;
  for (std::size_t k = 0; k < pipeline::kLandmarkCount; ++k) {
    const pipeline::Landmark& l = model.landmarks[k];
    if (!l.found) continue;
    lines << "comment landmark " << word(static_cast<pipeline::LandmarkName>(k)) << ' ' << l.at_mm.x << ' '
          << l.at_mm.y << ' ' << l.at_mm.z << ' ' << l.sigma_mm << '\n';
  }
  return lines.str();
}

TEST(PlyWriter, HeaderAndFirstVertexAreAsPromised) {
  const auto model = sample_model(4);
  const auto mesh = make_export_mesh(model, ExportFrame::Camera);
  ASSERT_TRUE(mesh);
  const auto bytes = ply_bytes(*mesh);
  const std::string header = std::string() +
                             "ply\n"
                             "format binary_little_endian 1.0\n"
                             "comment Relievo face model, millimetres\n"
                             "comment frame camera: the left camera, x right, y down, z forward\n" +
                             landmark_lines(model) +
                             "element vertex 16\n"
                             "property float x\nproperty float y\nproperty float z\n"
                             "property float nx\nproperty float ny\nproperty float nz\n"
                             "property float sigma_mm\n"
                             "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                             "property uchar measured\n"
                             "element face 18\n"
                             "property list uchar int vertex_indices\n"
                             "end_header\n";
  ASSERT_EQ(std::string(reinterpret_cast<const char*>(bytes.data()), header.size()), header);
  ASSERT_EQ(bytes.size(), header.size() + 16 * 32 + 18 * 13);
  ByteReader from(std::span<const std::byte>(bytes).subspan(header.size()));
  EXPECT_EQ(from.get<float>(), model.mesh.vertices_mm[0].x);
  EXPECT_EQ(from.get<float>(), model.mesh.vertices_mm[0].y);
  EXPECT_EQ(from.get<float>(), model.mesh.vertices_mm[0].z);
  EXPECT_NEAR(from.get<float>(), model.mesh.normals[0].x, 1e-6f);
  EXPECT_NEAR(from.get<float>(), model.mesh.normals[0].y, 1e-6f);
  EXPECT_NEAR(from.get<float>(), model.mesh.normals[0].z, 1e-6f);
  EXPECT_EQ(from.get<float>(), model.mesh.sigma_mm[0]);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(from.get<std::uint8_t>(), model.texture.vertex_rgb[c]);
  EXPECT_EQ(from.get<std::uint8_t>(), model.mesh.measured[0]);
}

TEST(ExportMeshTest, GoesOverIntoTheHeadFrame) {
  const auto model = sample_model(4);
  const auto mesh = make_export_mesh(model, ExportFrame::Head);
  ASSERT_TRUE(mesh);
  const auto& at = model.mesh.vertices_mm[3];
  const auto wanted = apply(model.head_from_camera, {at.x, at.y, at.z});
  EXPECT_EQ(mesh->vertices_mm[3].x, static_cast<float>(wanted.x));
  EXPECT_EQ(mesh->vertices_mm[3].y, static_cast<float>(wanted.y));
  EXPECT_EQ(mesh->vertices_mm[3].z, static_cast<float>(wanted.z));
  for (const auto& normal : mesh->normals) EXPECT_GT(normal.z, 0.0f);
}

TEST(ExportMeshTest, MakesNormalsWhereThereAreNone) {
  auto model = sample_model(6);
  const auto given = make_export_mesh(model, ExportFrame::Head);
  model.mesh.normals.clear();
  const auto made = make_export_mesh(model, ExportFrame::Head);
  model.mesh.normals.assign(36, {0, 0, 0});
  const auto zero = make_export_mesh(model, ExportFrame::Head);
  for (std::size_t i = 0; i < 36; ++i) {
    EXPECT_GT(made->normals[i].z * given->normals[i].z, 0.0f);
    EXPECT_NEAR(std::hypot(made->normals[i].x, made->normals[i].y, made->normals[i].z), 1.0f, 1e-6f);
    EXPECT_EQ(zero->normals[i].z, 1.0f);
  }
}

TEST(ModelFiles, RefusesWhatDoesNotHangTogetherAndWritesNothing) {
  using Model = pipeline::FaceModel;
  static constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();
  const std::vector<void (*)(Model&)> breaks{
      [](Model& m) { m.mesh.triangles.clear(); },
      [](Model& m) { m.mesh.triangles[1][2] = 16; },
      [](Model& m) { m.mesh.vertices_mm[2].x = kNowhere; },
      [](Model& m) { m.mesh.vertices_mm[2].y = kNowhere; },
      [](Model& m) { m.mesh.vertices_mm[2].z = kNowhere; },
      [](Model& m) { m.mesh.normals.emplace_back(); },
      [](Model& m) { m.mesh.sigma_mm.push_back(0); },
      [](Model& m) { m.mesh.measured.push_back(0); },
      [](Model& m) { m.mesh.pose.push_back(0); },
      [](Model& m) { m.texture.width_px *= -1; },
      [](Model& m) { m.texture.height_px *= -1; },
      [](Model& m) { m.texture.rgb.push_back(0); },
      [](Model& m) {
        m.texture.rgb.clear();
        m.texture.width_px = m.texture.height_px = 0;
      },
      [](Model& m) { m.texture.uv.pop_back(); },
      [](Model& m) { m.texture.uv[3].x = kNowhere; },
      [](Model& m) { m.texture.uv[3].y = kNowhere; },
      [](Model& m) { m.texture.origin.pop_back(); },
      [](Model& m) { m.texture.vertex_rgb.push_back(0); },
      [](Model& m) { m.head_from_camera.translation_mm.x = std::numeric_limits<double>::infinity(); }};
  const TemporaryFolder folder;
  for (std::size_t k = 0; k < breaks.size(); ++k) {
    Model model = sample_model(4);
    breaks[k](model);
    EXPECT_EQ(test::code_of(write_model_files(model, folder / "out", ExportFrame::Head)), Errc::InvalidInput)
        << k;
  }
  EXPECT_EQ(relievo::test::listing(folder.path()), "");
}

TEST(ModelFiles, NamesWhatItWroteAndReplacesWhatWasThere) {
  const TemporaryFolder folder;
  relievo::test::write_text(folder / "model.ply", "old");
  const auto files = write_model_files(sample_model(), folder.path(), ExportFrame::Head);
  ASSERT_TRUE(files);
  std::string names;
  for (const auto& file : *files) {
    names += file.filename().string() + " ";
    EXPECT_GT(std::filesystem::file_size(file), 10u);
  }
  EXPECT_EQ(names, "model.ply model.stl model.png model_origin.png model.mtl model.obj model.glb ");
  EXPECT_EQ(relievo::test::read_text(folder / "model.ply").substr(0, 4), "ply\n");
}

TEST(ModelFiles, ImagesForRecognitionGoBesideTheModel) {
  const TemporaryFolder folder;
  const auto images = test::sample_images();
  ExportOptions options(ExportFrame::Head);
  options.version = "1.2.3";
  options.images = &images;
  const auto files = write_model_files(sample_model(), folder.path(), options);
  ASSERT_TRUE(files);
  std::string names;
  for (auto file = files->begin() + 7; file != files->end(); ++file) names += file->filename().string() + " ";
  EXPECT_EQ(names,
            "portrait.png portrait_shows.png range.png range_sigma.png range_shows.png recognition.json ");
  const std::string page = relievo::test::read_text(folder / "recognition.json");
  EXPECT_NE(page.find("\"generator\": \"Relievo 1.2.3\""), std::string::npos);
  EXPECT_NE(page.find("\"pitch_mm\": 0.5, \"first_pixel_xy_mm\": [-2.5, 7]"), std::string::npos);
  EXPECT_NE(page.find("\"eyes_found\": true, \"right_eye_px\": [0.5, 0.25], \"left_eye_px\": [1.5, 0.25]"),
            std::string::npos);
  EXPECT_NE(page.find("\"between_eyes_mm\": 63.25, \"between_eyes_px\": 1"), std::string::npos);
  const std::string glb = relievo::test::read_text(folder / "model.glb");
  EXPECT_NE(glb.find("\"generator\":\"Relievo 1.2.3\""), std::string::npos);
  EXPECT_NE(glb.find("\"texture_sharpness\":0.7"), std::string::npos);
}

TEST(ModelFiles, SaysWhereItCouldNotWrite) {
  const TemporaryFolder folder;
  relievo::test::write_text(folder / "file", "x");
  const auto written = write_model_files(sample_model(), folder / "file", ExportFrame::Head);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, Errc::IoFailed);
  EXPECT_NE(written.error().where().find("file"), std::string_view::npos);
  std::filesystem::create_directories(folder / "out/model.obj");
  const auto in_the_way = write_model_files(sample_model(), folder / "out", ExportFrame::Head);
  ASSERT_FALSE(in_the_way);
  EXPECT_NE(in_the_way.error().where().find("model.obj"), std::string_view::npos);
  EXPECT_EQ(relievo::test::listing(folder / "out").find(".part"), std::string::npos);
}

// A file-size limit stands in for the full disk: the write fails in the middle of the batch.
TEST(ModelFiles, ADiskThatIsFullLeavesWhatWasThereAndNothingElse) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_model_files(sample_model(4), folder.path(), ExportFrame::Head));
  const std::string before = relievo::test::listing(folder.path());
  const std::string old_glb = relievo::test::read_text(folder / "model.glb");
  rlimit old_limit{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old_limit), 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{90'000, old_limit.rlim_max};  // room for the PLY, not for what follows
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const auto written = write_model_files(sample_model(40), folder.path(), ExportFrame::Head);
  setrlimit(RLIMIT_FSIZE, &old_limit);
  std::signal(SIGXFSZ, old_handler);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, Errc::MediaFull);
  EXPECT_EQ(relievo::test::listing(folder.path()), before);
  EXPECT_EQ(relievo::test::read_text(folder / "model.glb"), old_glb);
}

TEST(ModelFiles, AWriteProtectedDiskIsNamedSo) {
  const relievo::test::TinyDisk disk(std::size_t{64} << 20);
  if (!disk.mounted()) GTEST_SKIP() << disk.why_not();
  ASSERT_TRUE(write_model_files(sample_model(4), disk.path(), ExportFrame::Head));
  const std::string before = relievo::test::listing(disk.path());
  ASSERT_TRUE(disk.protect(true));
  for (const auto& place : {disk.path(), disk.path() / "new"}) {
    const auto written = write_model_files(sample_model(5), place, ExportFrame::Head);
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, Errc::IoFailed);
    EXPECT_EQ(written.error().sys_errno, EROFS) << "by which who asked is told what to do";
  }
  EXPECT_EQ(relievo::test::listing(disk.path()), before);
}

// No room but for files that are there: a folder needs some, too.
TEST(ModelFiles, ADiskWithoutRoomForTheFolderIsFull) {
  const TemporaryFolder folder;
  if (::mount("tmpfs", folder.path().c_str(), "tmpfs", 0, "nr_inodes=1") != 0)
    GTEST_SKIP() << "may not mount a small tmpfs";
  const auto written = write_model_files(sample_model(4), folder / "new", ExportFrame::Head);
  ::umount(folder.path().c_str());
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, Errc::MediaFull);
}

// The place where the disk was is an empty folder: nothing is begun anew there.
TEST(ModelFiles, ADiskThatIsPulledMidwayIsNotWrittenOnBesides) {
  const TemporaryFolder folder;
  const auto place = folder / "place", out = place / "out", hand = folder / "hand";
  std::filesystem::create_directory(place);
  const auto model = sample_model(400);  // the first file takes a while, and the others longer
  std::thread puller([&] {
    while (!std::filesystem::exists(out)) std::this_thread::yield();
    std::filesystem::rename(place, hand);
    std::filesystem::create_directory(place);
  });
  const auto written = write_model_files(model, out, ExportFrame::Head);
  puller.join();
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, Errc::IoFailed);
  EXPECT_EQ(relievo::test::listing(place), "");
  for (const auto& entry : std::filesystem::directory_iterator(hand / "out"))
    EXPECT_NE(entry.path().filename().string().find(".part"), std::string::npos) << entry.path();
}

TEST(ModelFiles, WithoutEyesThePageOfNumbersSaysSo) {
  auto images = test::sample_images();
  images.portrait.between_eyes_mm = 0;
  const auto files = recognition_files(images, {}, {}, "");
  ASSERT_TRUE(files);
  const auto& json = files->back().bytes;
  const std::string page(reinterpret_cast<const char*>(json.data()), json.size());
  EXPECT_NE(page.find("\"eyes_found\": false"), std::string::npos);
  EXPECT_NE(page.find("\"landmarks\": {}"), std::string::npos);
  EXPECT_NE(page.find("\"generator\": \"Relievo\""), std::string::npos);
}

// Landmarks whose place or uncertainty is no number, or nowhere near a head.
TEST(ModelFiles, ALandmarkThatIsNowhereIsLeftOut) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  auto model = sample_model();
  for (pipeline::Landmark& l : model.landmarks) l = {};
  ASSERT_GE(pipeline::kLandmarkCount, 7U);
  model.landmarks[0] = {{1, 2, 600}, 0.5F, true};
  model.landmarks[1] = {{1, 2, 600}, 0.5F, false};
  model.landmarks[2] = {{kNone, 2, 600}, 0.5F, true};
  model.landmarks[3] = {{1, -2e6F, 600}, 0.5F, true};
  model.landmarks[4] = {{1, 2, 600}, -1, true};
  model.landmarks[5] = {{1, 2, 600}, 2e6F, true};
  model.landmarks[6] = {{1, 2, 600}, kNone, true};
  const auto images = test::sample_images();
  ExportOptions options = ExportFrame::Camera;
  options.images = &images;
  const TemporaryFolder folder;
  ASSERT_TRUE(write_model_files(model, folder.path(), options));
  const std::string ply = relievo::test::read_text(folder / "model.ply");
  const std::string page = relievo::test::read_text(folder / "recognition.json");
  for (std::size_t k = 0; k < 7; ++k) {
    const std::string name(word(static_cast<pipeline::LandmarkName>(k)));
    EXPECT_EQ(ply.find("comment landmark " + name + " ") != std::string::npos, k == 0) << name;
    EXPECT_EQ(page.find("\"" + name + "\": {\"mm\"") != std::string::npos, k == 0) << name;
  }
}

// What a model need not have: a writer says nothing of it, and the uncertainty that is none is 0.
TEST(ModelFiles, WhatIsNotKnownIsNotWritten) {
  auto model = sample_model();
  model.mesh.sigma_mm[0] = std::numeric_limits<float>::infinity();
  model.mesh.pose.assign(model.mesh.vertices_mm.size(), 2);
  model.quality.texture_sharpness = std::numeric_limits<double>::quiet_NaN();
  const TemporaryFolder folder;
  ASSERT_TRUE(write_model_files(model, folder / "known", ExportFrame::Camera));
  EXPECT_NE(relievo::test::read_text(folder / "known/model.ply").find("property uchar pose"),
            std::string::npos);
  const std::string known = relievo::test::read_text(folder / "known/model.glb");
  EXPECT_EQ(known.find("texture_sharpness"), std::string::npos);
  EXPECT_NE(known.find("_SIGMA_MM"), std::string::npos);
  model.mesh.sigma_mm.clear();
  model.mesh.measured.clear();
  model.mesh.pose.clear();
  model.texture.origin.clear();
  model.mesh.normals[1] = {};
  model.mesh.normals[2].x = std::numeric_limits<float>::quiet_NaN();
  model.mesh.triangles[0][1] = model.mesh.triangles[0][0];  // a triangle that faces nowhere
  model.quality.width_mm = 1e12;
  ASSERT_TRUE(write_model_files(model, folder / "unknown", ExportFrame::Camera));
  EXPECT_FALSE(std::filesystem::exists(folder / "unknown/model_origin.png"));
  const std::string unknown = relievo::test::read_text(folder / "unknown/model.glb");
  EXPECT_EQ(unknown.find("_SIGMA_MM"), std::string::npos);
  EXPECT_EQ(unknown.find("_MEASURED"), std::string::npos);
  EXPECT_EQ(unknown.find("width_mm"), std::string::npos);
  const std::string stl = relievo::test::read_text(folder / "unknown/model.stl");
  EXPECT_EQ(stl.substr(84, 12), std::string(12, '\0')) << "no normal";
  EXPECT_EQ(relievo::test::read_text(folder / "unknown/model.ply").find("property uchar pose"),
            std::string::npos);
  model.texture.uv.clear();
  model.texture.rgb.clear();
  model.texture.vertex_rgb.clear();
  model.texture.width_px = model.texture.height_px = 0;
  ASSERT_TRUE(write_model_files(model, folder / "bare", ExportFrame::Camera));
  EXPECT_FALSE(std::filesystem::exists(folder / "bare/model.png"));
  EXPECT_NE(relievo::test::read_text(folder / "bare/model.glb").find("COLOR_0"), std::string::npos)
      << "white";
}

TEST(ModelFiles, PicturesThatDoNotFitTheirSizeAreRefused) {
  auto images = test::sample_images();
  images.portrait.width_px += 1;
  EXPECT_EQ(test::code_of(recognition_files(images, {}, {}, "")), Errc::InvalidInput);
}

TEST(AtomicFile, AnUnfinishedFileIsNeverSeen) {
  const TemporaryFolder folder;
  relievo::test::write_text(folder / "a", "old");
  {
    auto file = PendingFile::create(folder / "a");
    ASSERT_TRUE(file);
    ASSERT_TRUE(file->write(bytes_of("new")));
    EXPECT_EQ(relievo::test::read_text(folder / "a"), "old");
  }
  EXPECT_EQ(relievo::test::read_text(folder / "a"), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
  ASSERT_TRUE(write_whole_file(folder / "a", bytes_of("new")));
  EXPECT_EQ(relievo::test::read_text(folder / "a"), "new");
  EXPECT_FALSE(write_whole_file(folder / "none/a", bytes_of("new")));
}

// Khronos' own judge, where it is installed: npm install gltf-validator; RELIEVO_GLTF_VALIDATOR=that folder.
TEST(GlbWriter, KhronosFindsNoErrorAndNoWarning) {
  const char* where = std::getenv("RELIEVO_GLTF_VALIDATOR");
  if (where == nullptr)
    GTEST_SKIP() << "RELIEVO_GLTF_VALIDATOR names no folder with node_modules/gltf-validator";
  auto plain = sample_model(9);
  plain.texture = pipeline::TextureAtlas(std::pmr::new_delete_resource());
  const auto textured = sample_model(30);
  for (const auto* model : {&textured, static_cast<const pipeline::FaceModel*>(&plain)}) {
    for (const auto frame : {ExportFrame::Head, ExportFrame::Camera}) {
      const TemporaryFolder folder;
      ASSERT_TRUE(write_model_files(*model, folder.path(), frame));
      const std::string script = "require('" + std::string(where) +
                                 "/node_modules/gltf-validator').validateBytes(new Uint8Array("
                                 "require('fs').readFileSync('model.glb'))).then(r => console.log('errors ' "
                                 "+ r.issues.numErrors + ' warnings ' + "
                                 "r.issues.numWarnings + ' triangles ' + r.info.totalTriangleCount + '\\n' + "
                                 "JSON.stringify(r.issues.messages)))";
      const auto said = relievo::test::run_program({"/usr/bin/env", "node", "-e", script}, folder.path());
      EXPECT_EQ(said.out.substr(0, said.out.find('\n')),
                "errors 0 warnings 0 triangles " + std::to_string(model->mesh.triangles.size()))
          << said.out << said.err;
    }
  }
}

}  // namespace
}  // namespace relievo::storage
