// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/calibration_record.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "storage/byte_order.h"
#include "storage/sodium_sha256.h"
#include "storage/text.h"
#include "tests/storage/sample.h"

namespace relievo::storage {
namespace {

using test::sample_calibration;

TEST(Sha256, KnowsTheStandardsOwnExample) {  // FIPS 180-2, appendix B.1
  const Sha256 digest = sha256(bytes_of("abc"));
  EXPECT_EQ(std::to_integer<int>(digest[0]), 0xba);
  EXPECT_EQ(std::to_integer<int>(digest[31]), 0xad);
}

TEST(CalibrationRecord, ReturnsEveryDouble) {
  auto calibration = sample_calibration();
  calibration.revision = 7;
  calibration.epipolar_shift_px = 0.0123;
  const CalibrationFigures figures{CalibrationGrade::Usable, 0.05, 0.31, 0.17};
  const auto stored = decode_calibration(encode_calibration(calibration, figures));
  ASSERT_TRUE(stored);
  const auto* back = &stored->calibration;
  EXPECT_EQ(std::memcmp(back, &calibration, sizeof(double) * 9), 0);
  EXPECT_EQ(back->epipolar_shift_px, 0.0123);
  EXPECT_EQ(stored->figures.grade, CalibrationGrade::Usable);
  EXPECT_EQ(stored->figures.held_out_epipolar_px, 0.05);
  EXPECT_EQ(stored->figures.depth_sigma_mm, 0.31);
  EXPECT_EQ(stored->figures.shape_sigma_mm, 0.17);
  EXPECT_EQ(back->right_from_left.translation_mm.z, calibration.right_from_left.translation_mm.z);
  EXPECT_EQ(back->right.focal_px.y, calibration.right.focal_px.y);
  EXPECT_EQ(back->rms_px, calibration.rms_px);
  EXPECT_EQ(back->revision, 7u);
  EXPECT_EQ(back->left.width_px, 1280);
  EXPECT_EQ(back->right.height_px, 960);
}

TEST(CalibrationRecord, RefusesEveryTruncationAndEveryChangedByte) {
  const auto bytes = encode_calibration(sample_calibration());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    EXPECT_FALSE(decode_calibration(std::span(bytes).first(i))) << i;
    auto changed = bytes;
    changed[i] ^= std::byte{1};
    EXPECT_FALSE(decode_calibration(changed)) << i;
  }
}

TEST(CalibrationRecord, AnotherFormIsNotRead) {
  auto other = encode_calibration(sample_calibration());
  other[8] = std::byte{4};
  EXPECT_EQ(decode_calibration(other).error().code, Errc::StoreNewer);
  other[8] = std::byte{2};
  EXPECT_EQ(decode_calibration(other).error().code, Errc::StoreCorrupt);
}

TEST(CalibrationRecord, ReturnsTheNamesOfTheCameras) {
  auto calibration = sample_calibration();
  EXPECT_EQ(decode_calibration(encode_calibration(calibration))->calibration.cameras, pipeline::RigCameras());
  calibration.cameras = {"serial 40123456", std::string(pipeline::kMaxCameraWords, '~')};
  EXPECT_EQ(decode_calibration(encode_calibration(calibration))->calibration.cameras, calibration.cameras);
}

TEST(CalibrationRecord, TellsTheImpossible) {
  EXPECT_TRUE(check_calibration(sample_calibration()));
  const auto refused = [](auto spoil) {
    auto calibration = sample_calibration();
    spoil(calibration);
    return !check_calibration(calibration);
  };
  EXPECT_TRUE(refused([](auto& c) { c.left.focal_px.x = 0; }));
  EXPECT_TRUE(refused([](auto& c) { c.right.centre_px.y = std::nan(""); }));
  EXPECT_TRUE(refused([](auto& c) { c.left.distortion[4] = std::numeric_limits<double>::infinity(); }));
  EXPECT_TRUE(refused([](auto& c) { c.right.width_px = -1; }));
  EXPECT_TRUE(refused([](auto& c) { c.right_from_left.rotation.m[4] = 2; }));
  EXPECT_TRUE(refused([](auto& c) {
    for (double& v : c.right_from_left.rotation.m) v = -v;
  }));
  EXPECT_TRUE(refused([](auto& c) { c.right_from_left.translation_mm = {}; }));
  EXPECT_TRUE(refused([](auto& c) { c.epipolar_shift_px = std::nan(""); }));
  EXPECT_TRUE(refused([](auto& c) { c.cameras.left.assign(pipeline::kMaxCameraWords + 1, 'x'); }));
  EXPECT_TRUE(refused([](auto& c) { c.cameras.right = "tab\there"; }));
}

TEST(Text, KnowsNames) {
  for (const char* name : {"Ada", "Ž", "李小龙", "O'Neill-Łuksza", "\U0001F600", "a b"})
    EXPECT_TRUE(is_name(name)) << name;
  for (const char* name : {"", "\xff", "\xc0\x80", "\xed\xa0\x80", "\xe2\x82", "tab\there", "\x7f",
                           "\xc2\x85", "\xf4\x90\x80\x80"}) {
    EXPECT_FALSE(is_name(name)) << name;
  }
  EXPECT_TRUE(is_name(std::string(200, 'x')));
  EXPECT_FALSE(is_name(std::string(201, 'x')));
  EXPECT_TRUE(contains_name("Ada Lovelace", "LOVE"));
  EXPECT_TRUE(contains_name("Ada", ""));
  EXPECT_FALSE(contains_name("Ada", "Bob"));
}

}  // namespace
}  // namespace relievo::storage
