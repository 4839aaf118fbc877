// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <cstring>

#include "firmware/measure/comparison.h"
#include "hal/picture_file.h"
#include "tests/support/temporary_folder.h"

namespace relievo::firmware::compare {
namespace {

DisparityMap sample() {
  DisparityMap map(5, 3);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 5; ++x)
      if (x != y) map.values[map.index(x, y)] = static_cast<float>(10 * y + x) + 0.25F;
  return map;
}

void write_bytes(const std::filesystem::path& file, const std::vector<std::byte>& bytes) {
  test::write_text(file, std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

void expect_same(const DisparityMap& a, const DisparityMap& b) {
  ASSERT_EQ(a.values.size(), b.values.size());
  for (std::size_t k = 0; k < a.values.size(); ++k) {
    if (std::isnan(a.values[k])) EXPECT_TRUE(std::isnan(b.values[k])) << k;
    else EXPECT_EQ(a.values[k], b.values[k]) << k;
  }
}

TEST(Pfm, ComesBackAsItWasInEitherByteOrder) {
  const test::TemporaryFolder here;
  std::vector<std::byte> bytes = pfm_of(sample());
  write_bytes(here / "little.pfm", bytes);
  const auto little = read_pfm(here / "little.pfm");
  ASSERT_TRUE(little);
  expect_same(sample(), *little);
  const std::string head = "Pf\n5 3\n-1\n";
  std::string big = "Pf\n5 3\n1.0\n";
  for (std::size_t k = head.size(); k < bytes.size(); k += 4)
    for (std::size_t i = 4; i > 0; --i) big += static_cast<char>(bytes[k + i - 1]);
  test::write_text(here / "big.pfm", big);
  const auto other = read_pfm(here / "big.pfm");
  ASSERT_TRUE(other);
  expect_same(sample(), *other);
}

TEST(Pfm, RowsStandFromTheBottomUp) {
  const test::TemporaryFolder here;
  std::string text = "Pf 1 2 -1 ";
  for (const float value : {7.0F, 3.0F}) {
    std::array<char, 4> four{};
    std::memcpy(four.data(), &value, 4);
    text.append(four.data(), 4);
  }
  test::write_text(here / "two.pfm", text);
  const auto map = read_pfm(here / "two.pfm");
  ASSERT_TRUE(map);
  EXPECT_EQ(map->at(0, 0), 3);
  EXPECT_EQ(map->at(0, 1), 7);
}

TEST(Pfm, RefusesWhatIsNoWholeMap) {
  const test::TemporaryFolder here;
  const std::vector<std::byte> whole = pfm_of(sample());
  write_bytes(here / "cut.pfm", {whole.begin(), whole.end() - 1});
  test::write_text(here / "colour.pfm", "PF 1 1 -1 " + std::string(12, 'x'));
  test::write_text(here / "huge.pfm", "Pf 99999999 99999999 -1 x");
  test::write_text(here / "words.pfm", "this is no map at all");
  test::write_text(here / "hex.pfm", "Pf 1 1 -0x1 " + std::string(4, 'x'));
  for (const char* name : {"cut.pfm", "colour.pfm", "huge.pfm", "words.pfm", "hex.pfm"}) {
    const auto map = read_pfm(here / name);
    ASSERT_FALSE(map) << name;
    EXPECT_EQ(map.error().code, Errc::InvalidInput) << name;
    EXPECT_NE(map.error().where().find(name), std::string_view::npos);
  }
  EXPECT_EQ(read_pfm(here / "none.pfm").error().code, Errc::NotFound);
}

TEST(DisparityTruthFile, APicturesGreyValuesAreScaledAndNoughtIsUnknown) {
  const test::TemporaryFolder here;
  const std::array<std::uint8_t, 4> grey{0, 40, 80, 120};
  ASSERT_TRUE(hal::write_picture(
      here / "truth.png", {reinterpret_cast<const std::byte*>(grey.data()), 4, 1, 4, PixelFormat::Grey8}));
  const auto truth = read_disparity_truth(here / "truth.png", 4);
  ASSERT_TRUE(truth);
  EXPECT_FALSE(truth->map.known(0, 0));
  EXPECT_EQ(truth->map.at(1, 0), 10);
  EXPECT_EQ(truth->map.at(3, 0), 30);
  const std::array<std::uint8_t, 4> nothing{};
  ASSERT_TRUE(hal::write_picture(
      here / "black.png", {reinterpret_cast<const std::byte*>(nothing.data()), 4, 1, 4, PixelFormat::Grey8}));
  EXPECT_EQ(read_disparity_truth(here / "black.png", 1).error().code, Errc::InvalidInput);
}

}  // namespace
}  // namespace relievo::firmware::compare
