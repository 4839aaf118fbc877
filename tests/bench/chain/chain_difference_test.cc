// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What says that two processors made the same face must see a byte that differs, and say of differences how
// large they are.
#include "tests/bench/chain/chain_difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "tests/support/temporary_folder.h"

namespace relievo::bench {
namespace {

// A plate of 40 x 40 mm at 560 mm, seen in ten matches and ten points.
ChainRecord plate(float depth_mm = 560) {
  ChainRecord record;
  record.left_grey = {1, 2, 3}, record.right_grey = {4, 5, 6};
  for (int i = 0; i < 10; ++i) {
    const auto x = static_cast<float>(i);
    record.matches.push_back({x, 7, 30, 0.1F, 0});
    pipeline::CloudPoint point{};
    point.at_mm = {x, 0, depth_mm}, point.left_px = {x, 7}, point.sigma_mm = 0.5F;
    record.points.push_back(point);
  }
  record.vertices_mm = {{-20, -20, depth_mm}, {20, -20, depth_mm}, {20, 20, depth_mm}, {-20, 20, depth_mm}};
  record.triangles = {{0, 1, 2}, {0, 2, 3}};
  record.rgb = {10, 20, 30, 40};
  return record;
}

TEST(ChainDifference, OfTheSameRecordIsNone) {
  const ChainDifference d = between(plate(), plate());
  EXPECT_TRUE(d.identical);
  EXPECT_EQ(d.surface_mm.largest, 0);
  EXPECT_NE(d.text().find("identical in every byte"), std::string::npos);
}

// In whichever part it lies.
TEST(ChainDifference, SeesAByteThatDiffers) {
  const auto differs = [](auto change) {
    ChainRecord other = plate();
    change(other);
    return !between(plate(), other).identical;
  };
  EXPECT_TRUE(differs([](ChainRecord& r) { r.left_grey[1] = std::nextafter(r.left_grey[1], 9.0F); }));
  EXPECT_TRUE(differs([](ChainRecord& r) { r.right_grey.pop_back(); }));
  EXPECT_TRUE(differs([](ChainRecord& r) { r.matches[3].rejected_by = 1; }));
  EXPECT_TRUE(differs([](ChainRecord& r) { r.points[9].sigma_mm = 0.51F; }));
  EXPECT_TRUE(differs([](ChainRecord& r) { r.vertices_mm[0].z = -0.0F; }));
  EXPECT_TRUE(differs([](ChainRecord& r) { std::swap(r.triangles[0], r.triangles[1]); }));
  EXPECT_TRUE(differs([](ChainRecord& r) { r.rgb[3] = 41; }));
}

TEST(ChainDifference, SaysHowFarApartTheyAre) {
  ChainRecord other = plate(560.25F);
  other.matches[0].disparity_px = 30.5F;
  other.matches[1].rejected_by = 2;  // accepted by the first alone
  other.points.pop_back();
  other.rgb[0] = 11;
  const ChainDifference d = between(plate(), other);
  EXPECT_FALSE(d.identical);
  EXPECT_EQ(d.matches, 9U);
  EXPECT_EQ(d.matches_alone, 1U);
  EXPECT_EQ(d.disparity_px.median, 0);
  EXPECT_DOUBLE_EQ(d.disparity_px.largest, 0.5);
  EXPECT_NEAR(d.disparity_sigmas.largest, 5, 1e-6);
  EXPECT_EQ(d.points, 9U);
  EXPECT_EQ(d.points_alone, 1U);
  EXPECT_NEAR(d.point_mm.median, 0.25, 1e-6);
  EXPECT_NEAR(d.point_sigmas.median, 0.5, 1e-6);
  EXPECT_NEAR(d.surface_mm.median, 0.25, 1e-6);
  EXPECT_DOUBLE_EQ(d.colour_share, 0.25);
}

TEST(ChainRecord, ComesBackFromItsFileAndNotFromAPartOfIt) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "record";
  ASSERT_TRUE(write_record(file, plate()));
  const auto back = read_record(file);
  ASSERT_TRUE(back);
  EXPECT_TRUE(between(plate(), *back).identical);
  const auto whole = std::filesystem::file_size(file);
  for (std::uintmax_t size = 0; size < whole; ++size) {
    std::filesystem::resize_file(file, whole - 1 - size);
    const auto part = read_record(file);
    ASSERT_FALSE(part) << whole - 1 - size;
    EXPECT_EQ(part.error().code, Errc::InvalidInput);
  }
  EXPECT_EQ(read_record(folder.path() / "none").error().code, Errc::NotFound);
}

}  // namespace
}  // namespace relievo::bench
