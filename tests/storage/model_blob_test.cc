// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/model_blob.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "storage/sodium_sha256.h"
#include "tests/storage/sample.h"

namespace relievo::storage {
namespace {

using test::identical;
using test::sample_model;

// Counts what decoding takes.
class Meter final : public std::pmr::memory_resource {
 public:
  std::size_t bytes = 0;

 private:
  void* do_allocate(std::size_t size, std::size_t alignment) override {
    bytes += size;
    return std::pmr::new_delete_resource()->allocate(size, alignment);
  }
  void do_deallocate(void* p, std::size_t size, std::size_t alignment) override {
    std::pmr::new_delete_resource()->deallocate(p, size, alignment);
  }
  bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }
};

std::vector<std::byte> encoded(const pipeline::FaceModel& model) { return *encode_model(model); }

void seal(std::vector<std::byte>& bytes) {
  const auto digest = sha256(std::span(bytes).first(bytes.size() - sizeof(Sha256)));
  std::memcpy(bytes.data() + bytes.size() - sizeof(Sha256), digest.data(), sizeof(Sha256));
}

TEST(ModelBlob, ReturnsEveryBit) {
  auto model = sample_model();
  model.mesh.sigma_mm[0] = std::numeric_limits<float>::quiet_NaN();
  model.mesh.sigma_mm[1] = -0.0f;
  model.mesh.sigma_mm[2] = std::numeric_limits<float>::denorm_min();
  model.quality.coverage = -0.0;
  const auto back = decode_model(encoded(model), std::pmr::new_delete_resource());
  ASSERT_TRUE(back);
  EXPECT_TRUE(identical(model, *back));
}

TEST(ModelBlob, CarriesAnEmptyAndAnUntexturedModel) {
  pipeline::FaceModel empty(std::pmr::new_delete_resource());
  auto bare = sample_model();
  bare.texture = pipeline::TextureAtlas(std::pmr::new_delete_resource());
  bare.mesh.normals.clear();
  bare.mesh.sigma_mm.clear();
  bare.mesh.measured.clear();
  for (const auto* model : {&empty, &bare}) {
    const auto back = decode_model(encoded(*model), std::pmr::new_delete_resource());
    ASSERT_TRUE(back);
    EXPECT_TRUE(identical(*model, *back));
  }
}

TEST(ModelBlob, RefusesEveryTruncation) {
  const auto bytes = encoded(sample_model(4));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    Meter meter;
    const auto back = decode_model(std::span(bytes).first(size), &meter);
    ASSERT_FALSE(back) << size;
    EXPECT_EQ(back.error().code, Errc::StoreCorrupt) << size;
    EXPECT_EQ(meter.bytes, 0u) << size;
  }
}

TEST(ModelBlob, RefusesEveryChangedByte) {
  const auto bytes = encoded(sample_model(4));
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    auto changed = bytes;
    changed[i] ^= std::byte{0x40};
    ASSERT_FALSE(decode_model(changed, std::pmr::new_delete_resource())) << i;
  }
}

TEST(ModelBlob, RefusesALongerPiece) {
  auto bytes = encoded(sample_model(4));
  bytes.push_back(std::byte{0});
  EXPECT_FALSE(decode_model(bytes, std::pmr::new_delete_resource()));
}

TEST(ModelBlob, RefusesHostileSizesBeforeAllocating) {
  const auto bytes = encoded(sample_model(4));
  for (std::size_t field = 8; field < 28; field += 4) {
    for (const std::uint32_t value : {0x7fffffffu, 0xffffffffu, 0x55555556u, 1u << 30}) {
      auto hostile = bytes;
      std::memcpy(hostile.data() + field, &value, 4);
      seal(hostile);
      Meter meter;
      ASSERT_FALSE(decode_model(hostile, &meter)) << field << " " << value;
      EXPECT_EQ(meter.bytes, 0u);
    }
  }
}

TEST(ModelBlob, RefusesIndicesOutOfRangeUnderARightChecksum) {
  const auto model = sample_model(4);
  auto bytes = encoded(model);
  const std::size_t triangles_at = 28 + 21 * 8 + 10 * 17 + 6 * 8 + 16 * (12 + 12 + 4 + 1);
  const std::uint32_t index = 16;
  std::memcpy(bytes.data() + triangles_at, &index, 4);
  seal(bytes);
  const auto back = decode_model(bytes, std::pmr::new_delete_resource());
  ASSERT_FALSE(back);
  EXPECT_EQ(back.error().code, Errc::StoreCorrupt);
}

TEST(ModelBlob, SaysThatALaterFormIsNewer) {
  auto bytes = encoded(sample_model(4));
  bytes[6] = std::byte{6};
  const auto back = decode_model(bytes, std::pmr::new_delete_resource());
  ASSERT_FALSE(back);
  EXPECT_EQ(back.error().code, Errc::StoreNewer);
}

TEST(ModelBlob, AHeadOfSeveralPairsKeepsWhichOfThemMeasuredWhat) {
  auto model = sample_model(4);
  for (std::size_t v = 0; v < model.mesh.vertices_mm.size(); ++v)
    model.mesh.pose.push_back(static_cast<std::uint8_t>(v % 5));
  auto bytes = encoded(model);
  const auto back = decode_model(bytes, std::pmr::new_delete_resource());
  ASSERT_TRUE(back);
  EXPECT_TRUE(identical(model, *back));
  bytes[6] = std::byte{4};  // which knew no poses
  seal(bytes);
  EXPECT_FALSE(decode_model(bytes, std::pmr::new_delete_resource()));
  model.mesh.pose.pop_back();
  EXPECT_FALSE(encode_model(model));
}

// The first form: seven figures of quality, no word about where a texel's colour comes from.
TEST(ModelBlob, ReadsTheFirstForm) {
  auto model = sample_model();
  model.texture.origin.clear();
  model.quality.texture_sharpness = model.quality.symmetry_residual_mm = 0;
  model.quality.relief = {};
  model.landmarks = {};
  auto bytes = encoded(model);
  bytes[6] = std::byte{1};
  const auto eighth = bytes.begin() + 28 + 19 * 8;
  bytes.erase(eighth, eighth + 2 * 8 + 10 * 17 + 6 * 8);
  seal(bytes);
  const auto back = decode_model(bytes, std::pmr::new_delete_resource());
  ASSERT_TRUE(back);
  EXPECT_TRUE(identical(model, *back));
}

// The second: eight figures, no landmarks.
TEST(ModelBlob, ReadsTheSecondForm) {
  auto model = sample_model();
  model.quality.symmetry_residual_mm = 0;
  model.quality.relief = {};
  model.landmarks = {};
  auto bytes = encoded(model);
  bytes[6] = std::byte{2};
  const auto ninth = bytes.begin() + 28 + 20 * 8;
  bytes.erase(ninth, ninth + 8 + 10 * 17 + 6 * 8);
  seal(bytes);
  const auto back = decode_model(bytes, std::pmr::new_delete_resource());
  ASSERT_TRUE(back);
  EXPECT_TRUE(identical(model, *back));
}

// The third: no relief.
TEST(ModelBlob, ReadsTheThirdForm) {
  auto model = sample_model();
  model.quality.relief = {};
  auto bytes = encoded(model);
  bytes[6] = std::byte{3};
  const auto relief = bytes.begin() + 28 + 21 * 8 + 10 * 17;
  bytes.erase(relief, relief + 6 * 8);
  seal(bytes);
  const auto back = decode_model(bytes, std::pmr::new_delete_resource());
  ASSERT_TRUE(back);
  EXPECT_TRUE(identical(model, *back));
}

TEST(ModelBlob, TakesNoModelThatDoesNotHangTogether) {
  auto short_normals = sample_model();
  short_normals.mesh.normals.pop_back();
  auto wild_index = sample_model();
  wild_index.mesh.triangles[3][1] = 100'000;
  auto wrong_texture = sample_model();
  wrong_texture.texture.width_px += 1;
  auto short_uv = sample_model();
  short_uv.texture.uv.pop_back();
  auto large_texture = sample_model();
  large_texture.texture.width_px = 100'000;
  for (const auto* model : {&short_normals, &wild_index, &wrong_texture, &short_uv, &large_texture}) {
    const auto bytes = encode_model(*model);
    ASSERT_FALSE(bytes);
    EXPECT_EQ(bytes.error().code, Errc::InvalidInput);
  }
}

}  // namespace
}  // namespace relievo::storage
