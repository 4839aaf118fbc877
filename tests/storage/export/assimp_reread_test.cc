// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The exported files, read again by somebody else's reader.
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/texture.h>
#include <gtest/gtest.h>
#include <assimp/Importer.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "storage/export/format/export_mesh.h"
#include "storage/export/model_files.h"
#include "tests/storage/sample.h"
#include "tests/support/temporary_folder.h"

namespace relievo::storage {
namespace {

using pipeline::Vec2f;
using pipeline::Vec3f;
using relievo::test::TemporaryFolder;

struct Corner {
  Vec3f at, normal;
  Vec2f uv;
};

// The corners of every triangle, in order: what survives any splitting and joining of vertices.
std::vector<Corner> corners_of(const ExportMesh& mesh) {
  std::vector<Corner> corners;
  const auto& triangles = mesh.model.mesh.triangles;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c) {
      const auto v = triangles[t][c];
      corners.push_back({mesh.vertices_mm[v], mesh.normals[v],
                         mesh.textured() ? mesh.model.texture.uv[3 * t + c] : Vec2f{}});
    }
  }
  return corners;
}

std::vector<Corner> corners_in(const aiScene& scene) {
  std::vector<Corner> corners;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      for (unsigned c = 0; c < mesh.mFaces[f].mNumIndices; ++c) {
        const unsigned v = mesh.mFaces[f].mIndices[c];
        Corner corner{};
        corner.at = {mesh.mVertices[v].x, mesh.mVertices[v].y, mesh.mVertices[v].z};
        if (mesh.HasNormals()) corner.normal = {mesh.mNormals[v].x, mesh.mNormals[v].y, mesh.mNormals[v].z};
        if (mesh.HasTextureCoords(0)) corner.uv = {mesh.mTextureCoords[0][v].x, mesh.mTextureCoords[0][v].y};
        corners.push_back(corner);
      }
    }
  }
  return corners;
}

float distance(const Vec3f& a, const Vec3f& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

class Reread : public ::testing::TestWithParam<ExportFrame> {
 protected:
  void SetUp() override { ASSERT_TRUE(write_model_files(model, folder.path(), GetParam())); }
  const aiScene* read(const char* name) {
    const aiScene* scene = importer.ReadFile((folder / name).string(), 0);
    EXPECT_NE(scene, nullptr) << importer.GetErrorString();
    return scene;
  }
  TemporaryFolder folder;
  pipeline::FaceModel model = test::sample_model(14);
  ExportMesh mesh = *make_export_mesh(model, GetParam());
  Assimp::Importer importer;
};

TEST_P(Reread, PlyIsTheSameToTheBit) {
  const aiScene* scene = read("model.ply");
  ASSERT_TRUE(scene);
  const auto wanted = corners_of(mesh), found = corners_in(*scene);
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_EQ(distance(found[i].at, wanted[i].at), 0.0f) << i;
    ASSERT_EQ(distance(found[i].normal, wanted[i].normal), 0.0f) << i;
  }
  ASSERT_EQ(scene->mMeshes[0]->mNumVertices, mesh.vertices_mm.size());
  const aiColor4D& colour = scene->mMeshes[0]->mColors[0][5];
  EXPECT_EQ(std::lround(colour.r * 255), mesh.colours[5][0]);
  EXPECT_EQ(std::lround(colour.g * 255), mesh.colours[5][1]);
  EXPECT_EQ(std::lround(colour.b * 255), mesh.colours[5][2]);
}

TEST_P(Reread, ObjIsTheSameWithItsTexture) {
  const aiScene* scene = read("model.obj");
  ASSERT_TRUE(scene);
  const auto wanted = corners_of(mesh), found = corners_in(*scene);
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    // Half of the last decimal, and assimp reads decimals in its own, faster way.
    ASSERT_LT(distance(found[i].at, wanted[i].at), 1.1e-3f) << i;
    ASSERT_NEAR(found[i].uv.x, wanted[i].uv.x, 6e-6f);
    ASSERT_NEAR(found[i].uv.y, 1.0f - wanted[i].uv.y, 6e-6f) << "the format counts from below";
  }
  aiString texture;
  const aiMaterial& material = *scene->mMaterials[scene->mMeshes[0]->mMaterialIndex];
  ASSERT_EQ(material.GetTexture(aiTextureType_DIFFUSE, 0, &texture), AI_SUCCESS);
  EXPECT_STREQ(texture.C_Str(), "model.png");
}

TEST_P(Reread, StlIsTheSameToTheBit) {
  const aiScene* scene = read("model.stl");
  ASSERT_TRUE(scene);
  const auto wanted = corners_of(mesh), found = corners_in(*scene);
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_EQ(distance(found[i].at, wanted[i].at), 0.0f) << i;
    ASSERT_NEAR(std::hypot(found[i].normal.x, found[i].normal.y, found[i].normal.z), 1, 1e-5) << i;
  }
}

TEST_P(Reread, GlbIsTheSameInMetresAndUpright) {
  const aiScene* scene = read("model.glb");
  ASSERT_TRUE(scene);
  const auto wanted = corners_of(mesh), found = corners_in(*scene);
  ASSERT_EQ(found.size(), wanted.size());
  const float turn = GetParam() == ExportFrame::Head ? 1.0f : -1.0f;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Vec3f& at = wanted[i].at;
    ASSERT_LT(distance(found[i].at, {at.x / 1000, turn * at.y / 1000, turn * at.z / 1000}), 1e-7f) << i;
    ASSERT_NEAR(found[i].uv.x, wanted[i].uv.x, 1e-6f);
    ASSERT_NEAR(1.0f - found[i].uv.y, wanted[i].uv.y, 1e-6f) << "assimp counts from below, glTF from above";
    ASSERT_GT(found[i].normal.z, 0.0f) << "the face looks along +z";
  }
  ASSERT_EQ(scene->mNumTextures, 1u);
  EXPECT_STREQ(scene->mTextures[0]->achFormatHint, "png");
  // Split at the seam only: two columns of the sample, one vertex more a row.
  EXPECT_EQ(scene->mMeshes[0]->mNumVertices, mesh.vertices_mm.size() + 14);
}

TEST_P(Reread, EveryTriangleTurnsOutward) {
  for (const char* name : {"model.ply", "model.obj", "model.stl", "model.glb"}) {
    const aiScene* scene = read(name);
    ASSERT_TRUE(scene);
    auto corners = corners_in(*scene);
    const auto ours = corners_of(mesh);
    for (std::size_t i = 0; i < corners.size(); i += 3) {
      // OBJ has none; ours are upside down against a GLB made in the camera's frame, but then it has its own.
      if (!scene->mMeshes[0]->HasNormals()) corners[i].normal = ours[i].normal;
      const Vec3f &a = corners[i].at, &b = corners[i + 1].at, &c = corners[i + 2].at, &n = corners[i].normal;
      const Vec3f u{b.x - a.x, b.y - a.y, b.z - a.z}, w{c.x - a.x, c.y - a.y, c.z - a.z};
      const float facing =
          (u.y * w.z - u.z * w.y) * n.x + (u.z * w.x - u.x * w.z) * n.y + (u.x * w.y - u.y * w.x) * n.z;
      ASSERT_GT(facing, 0.0f) << name << " " << i / 3;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Frames, Reread, ::testing::Values(ExportFrame::Head, ExportFrame::Camera),
                         [](const auto& instance) {
                           return instance.param == ExportFrame::Head ? "Head" : "Camera";
                         });

TEST(RereadUntextured, GlbCarriesColoursOfVertices) {
  const TemporaryFolder folder;
  auto model = test::sample_model(8);
  model.texture.uv.clear();
  model.texture.rgb.clear();
  model.texture.origin.clear();
  model.texture.width_px = model.texture.height_px = 0;
  const auto files = write_model_files(model, folder.path(), ExportFrame::Head);
  ASSERT_TRUE(files);
  EXPECT_EQ(files->size(), 5u);
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile((folder / "model.glb").string(), 0);
  ASSERT_TRUE(scene) << importer.GetErrorString();
  EXPECT_TRUE(scene->mMeshes[0]->HasVertexColors(0));
  EXPECT_EQ(scene->mMeshes[0]->mNumVertices, 64u);
}

}  // namespace
}  // namespace relievo::storage
