// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/session/session.h"
#include "storage/record.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace relievo::firmware {
namespace {

constexpr std::size_t kFrames = 2 * 7 * 64 * 64;
constexpr std::size_t kArena = 1 << 20;

class SessionTest : public testing::Test {
 protected:
  SessionTest() { clear(); }
  void clear() {
    auto all = memory.all();
    std::memset(const_cast<std::byte*>(all.data()), 0, all.size());
  }
  bool all_zero() const {
    return std::all_of(memory.all().begin(), memory.all().end(),
                       [](std::byte b) { return b == std::byte{0}; });
  }
  // Fills everything a person's enrolment touches.
  void live() {
    std::vector<std::byte> pixels(64 * 64 * 3, std::byte{0xAB});
    const ImageView picture{pixels.data(), 64, 64, 64 * 3, PixelFormat::Rgb8};
    Products& products = session.products();
    products.frame.emplace();
    products.frame->left = *session.slot().keep_left(hal::raw_of(picture));
    products.frame->right = *session.slot().keep_right(hal::raw_of(picture));
    ASSERT_TRUE(session.spare_slot().keep_left(hal::raw_of(picture)));
    ASSERT_TRUE(session.spare_slot().keep_right(hal::raw_of(picture)));
    products.pair.emplace(&session.output());
    products.pair->left.rgb.assign(64 * 64 * 3, 0xCD);
    products.model.emplace(&session.output());
    products.model->mesh.vertices_mm.assign(500, {1, 2, 3});
    products.model->quality.nose_relief_mm = 21;
    EnrolmentSession::Scratch scratch(session);  // as a stage does: given back, not yet wiped
    std::pmr::vector<float> working(&scratch.arena());
    working.assign(1000, 0.5F);
  }

  BootMemory memory{kFrames, kArena, kArena};
  EnrolmentSession session{memory};
};

TEST_F(SessionTest, ClosesWithoutAByteOfTheVisitor) {
  ASSERT_TRUE(session.open("Ada Lovelace"));
  live();
  EXPECT_FALSE(all_zero());
  session.close();
  EXPECT_TRUE(all_zero());
  EXPECT_EQ(session.subject(), "");
  const auto* raw = reinterpret_cast<const char*>(&session);
  const std::string object(raw, sizeof(session));
  EXPECT_EQ(object.find("Ada"), std::string::npos);
  EXPECT_EQ(object.find("Lovelace"), std::string::npos);
}

TEST_F(SessionTest, OpensEmptyAfterAnother) {
  ASSERT_TRUE(session.open("first"));
  live();
  session.close();
  ASSERT_TRUE(session.open("second"));
  EXPECT_EQ(session.subject(), "second");
  EXPECT_FALSE(session.products().frame);
  EXPECT_FALSE(session.products().model);
}

TEST_F(SessionTest, RetakeKeepsTheSubjectAndNothingElse) {
  ASSERT_TRUE(session.open("Ada"));
  live();
  session.retake();
  EXPECT_EQ(session.subject(), "Ada");
  EXPECT_FALSE(session.products().frame);
  EXPECT_FALSE(session.products().pair);
  EXPECT_EQ(session.output().used(), sizeof(Products));
  session.close();
  EXPECT_TRUE(all_zero());
}

TEST_F(SessionTest, TheMirrorStaysForTheShotIfItIsAskedForAndGoesWithTheSession) {
  const std::vector<std::byte> pixels(64 * 64 * 3, std::byte{0xAB});
  const auto look = [&] {
    session.live().fill({pixels.data(), 64, 64, 64 * 3, PixelFormat::Rgb8});
    ui::LiveView guidance;
    guidance.steady_s = 2;
    session.live().publish(guidance);
    return session.live().newest();
  };
  ASSERT_TRUE(session.open("Ada"));
  live();
  const ui::LiveView seen = look();
  EXPECT_EQ(seen.steady_s, 2);
  session.retake(true);
  const ui::LiveView kept = session.live().newest();
  EXPECT_EQ(kept.number, seen.number);
  ASSERT_EQ(kept.picture.bytes, seen.picture.bytes);
  EXPECT_EQ(*kept.picture.bytes, pixels[0]);
  EXPECT_EQ(kept.steady_s, ui::LiveView().steady_s) << "nothing is said of it any more";
  EXPECT_FALSE(session.products().frame);
  session.retake();
  EXPECT_TRUE(session.live().newest().picture.empty());
  EXPECT_EQ(*seen.picture.bytes, std::byte{0});
  const ui::LiveView last = look();
  session.retake(true);
  EXPECT_EQ(*last.picture.bytes, pixels[0]);
  session.close();
  EXPECT_TRUE(session.live().newest().picture.empty());
  EXPECT_EQ(*last.picture.bytes, std::byte{0});
  EXPECT_TRUE(all_zero());
}

TEST_F(SessionTest, DestructionWipesToo) {
  {
    EnrolmentSession other(memory);
    ASSERT_TRUE(other.open("Ada"));
    std::memset(other.output().allocate(100), 0x77, 100);
  }
  EXPECT_TRUE(all_zero());
}

TEST_F(SessionTest, RefusesASecondPersonAndAnEndlessName) {
  ASSERT_TRUE(session.open("Ada"));
  EXPECT_EQ(session.open("Grace").error().code, Errc::InvalidState);
  session.close();
  EXPECT_EQ(session.open(std::string(storage::kMaxNameBytes + 1, 'x')).error().code, Errc::InvalidInput);
  EXPECT_FALSE(session.is_open());
  EXPECT_TRUE(session.open(std::string(storage::kMaxNameBytes, 'x')));
}

// The kiosk takes memory for the size of its own cameras' pictures.
TEST(MemoryPlan, HoldsTheFrontAndEverySideOfItsSizeAndRefusesLargerPictures) {
  for (const auto& [width, height] : {std::pair{640, 400}, {1920, 1200}, {2448, 2048}}) {
    SCOPED_TRACE(width);
    const BootMemory memory(budget::plan_of_a_head(std::size_t(width) * std::size_t(height)));
    EnrolmentSession session(memory);
    ASSERT_TRUE(session.open("Ada"));
    ASSERT_TRUE(session.has_sides());
    const int larger = height * 9 / 8;
    const std::vector<std::byte> pixels(std::size_t(3) * std::size_t(width) * std::size_t(larger));
    const auto picture = [&](int rows) {
      return ImageView{pixels.data(), width, rows, 3 * width, PixelFormat::Rgb8};
    };
    for (StereoSlot* slot : {&session.slot(), &session.spare_slot()}) {
      EXPECT_TRUE(slot->keep_left(hal::raw_of(picture(height))));
      EXPECT_TRUE(slot->keep_right(hal::raw_of(picture(height))));
      EXPECT_EQ(slot->keep_left(hal::raw_of(picture(larger))).error().code, Errc::InvalidInput);
    }
    pipeline::StereoFrame pair;
    pair.left = pair.right = picture(larger);
    EXPECT_EQ(session.sides().add(pair).error().code, Errc::OutOfMemory);
    pair.left = pair.right = picture(height);
    for (std::size_t side = 0; side < pipeline::kSides; ++side) EXPECT_TRUE(session.sides().add(pair));
  }
}

}  // namespace
}  // namespace relievo::firmware
