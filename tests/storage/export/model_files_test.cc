// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/export/model_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "storage/byte_order.h"
#include "storage/export/atomic_file.h"
#include "storage/export/glb_writer.h"
#include "storage/export/ply_writer.h"
#include "storage/export/png_writer.h"
#include "tests/storage/sample.h"
#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace relievo::storage {
namespace {

using relievo::test::TemporaryFolder;
using test::sample_model;

TEST(PlyWriter, HeaderAndFirstVertexAreAsPromised) {
  const auto model = sample_model(4);
  const auto mesh = make_export_mesh(model, ExportFrame::Camera);
  ASSERT_TRUE(mesh);
  const auto bytes = ply_bytes(*mesh);
  const std::string header =
      "ply\n"
      "format binary_little_endian 1.0\n"
      "comment Relievo face model, millimetres\n"
      "comment frame camera: the left camera, x right, y down, z forward\n"
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
  const TemporaryFolder folder;
  auto empty = pipeline::FaceModel(std::pmr::new_delete_resource());
  auto nowhere = sample_model(4);
  nowhere.mesh.vertices_mm[2].y = std::numeric_limits<float>::quiet_NaN();
  auto wild = sample_model(4);
  wild.mesh.triangles[1][2] = 16;
  auto no_pixels = sample_model(4);
  no_pixels.texture.rgb.clear();
  no_pixels.texture.width_px = no_pixels.texture.height_px = 0;
  auto bad_frame = sample_model(4);
  bad_frame.head_from_camera.translation_mm.x = std::numeric_limits<double>::infinity();
  for (const auto* model : {&empty, &nowhere, &wild, &no_pixels, &bad_frame}) {
    const auto written = write_model_files(*model, folder / "out", ExportFrame::Head);
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, Errc::InvalidInput);
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
  EXPECT_EQ(names, "model.ply model.png model.mtl model.obj model.glb ");
  EXPECT_EQ(relievo::test::read_text(folder / "model.ply").substr(0, 4), "ply\n");
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
  ASSERT_TRUE(write_file(folder / "a", bytes_of("new")));
  EXPECT_EQ(relievo::test::read_text(folder / "a"), "new");
  EXPECT_FALSE(write_file(folder / "none/a", bytes_of("new")));
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
