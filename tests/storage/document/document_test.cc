// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A document gives back every bit of what was put in, and what is no whole document is told from one.
#include "storage/document/document.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <random>

#include "tests/storage/sample.h"

namespace relievo::storage {
namespace {

constexpr int kWidth = 40, kHeight = 30;

// Awkward numbers of every kind, small enough for thousands of damaged copies.
struct Sample {
  std::vector<std::byte> left =
      std::vector<std::byte>(static_cast<std::size_t>(kWidth) * kHeight * 3, std::byte{7});
  std::vector<std::byte> right =
      std::vector<std::byte>(static_cast<std::size_t>(kWidth + 2) * kHeight * 2, std::byte{9});
  DocumentHead head{"1.2",
                    "matcher = zmncc\n",
                    true,
                    test::sample_calibration(),
                    -1234,
                    {{std::chrono::nanoseconds(5), 1, 2, 3}, {{}, 4, 5, 6}, {}, {}, {}},
                    {{{3.25F, 1e-42F}, -0.1F, 0, 0.5F, 0}, {{7, 8}, 1.0F / 3, 0, 1e9F, 0}},
                    {{"file-matches.path", std::make_shared<const std::string>("1 2 3\n\0x", 8)}}};
  pipeline::RectifiedPair pair{std::pmr::get_default_resource()};
  pipeline::MatchSet matches{std::pmr::get_default_resource()};
  pipeline::PointCloud cloud{std::pmr::get_default_resource()};
  pipeline::FaceModel model = test::sample_model();

  Sample() {
    std::mt19937 random(1);
    const auto fill = [&random](auto& bytes, std::size_t size) {
      bytes.resize(size);
      for (auto& b : bytes) b = static_cast<std::uint8_t>(random());
    };
    constexpr std::size_t kPixels = std::size_t{kWidth} * kHeight;
    pair.width_px = kWidth, pair.height_px = kHeight;
    pair.focal_px = 1.0 / 3, pair.baseline_mm = 110.1, pair.near_mm = -0.0;
    pair.rectified_from_left.m[3] = 1e-310;  // denormal
    pair.right_from_left = test::sample_calibration().right_from_left;
    for (auto* view : {&pair.left, &pair.right}) {
      for (std::size_t i = 0; i < kPixels; ++i) view->grey.push_back(static_cast<float>(i) / 7);
      fill(view->rgb, 3 * kPixels);
      fill(view->valid, kPixels);
    }
    fill(pair.region, kPixels);
    matches.lattice_step_px = 2;
    matches.motion_px = 0.1;
    matches.epipolar_shift.covariance_px2[5] = 1.0 / 9;
    matches.matches = {{{3, 4.5F}, 0.1F, -0.0F, std::numeric_limits<float>::infinity(), 5},
                       {{kWidth - 1, kHeight - 1}, 1.0F / 3, 1, 0, 0}};
    cloud.points = {{{1, 2, 600.1F}, {3, 4}, 0.1F}, {{-1, 1e-42F, 2}, {0, 0}, 0}};
    cloud.right_camera_mm = {110, 0.1, -3};
    model.backdrop.columns = 2, model.backdrop.rows = 1;
    model.backdrop.at_mm = {{1, 2, 3}, {4, 5, 1.0F / 3}};
    model.backdrop.rgba = {{1, 2, 3, 4}, {5, 6, 7, 8}};
  }
  DocumentParts parts() const {
    const ImageView l{left.data(), kWidth, kHeight, kWidth * 3, PixelFormat::Rgb8};
    const ImageView r{right.data(), kWidth, kHeight, (kWidth + 2) * 2, PixelFormat::Grey16};  // padded rows
    return {head, {l, r, 0, head.skew_ns}, &pair, &matches, &cloud, nullptr, &model};
  }
};

template <typename Items>
bool same(const Items& a, const Items& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

std::pmr::memory_resource* heap() { return std::pmr::get_default_resource(); }

TEST(Document, GivesBackEveryBit) {
  const Sample sample;
  const auto bytes = make_document(sample.parts());
  ASSERT_TRUE(bytes) << bytes.error().what.view();
  const auto document = Document::open(*bytes);
  ASSERT_TRUE(document) << document.error().what.view();
  EXPECT_EQ(document->head().version, "1.2");
  EXPECT_EQ(document->head().algorithms, "matcher = zmncc\n");
  EXPECT_TRUE(document->head().whole_view);
  EXPECT_EQ(document->head().skew_ns, -1234);
  ASSERT_EQ(document->head().stages.size(), kDocumentStages);
  EXPECT_EQ(document->head().stages[0].took.count(), 5);
  EXPECT_EQ(document->head().stages[1].arena_peak_bytes, 6U);
  EXPECT_TRUE(std::ranges::equal(
      document->head().by_hand, sample.head.by_hand, [](const pipeline::Match& a, const pipeline::Match& b) {
        return std::memcmp(&a, &b, offsetof(pipeline::Match, rejected_by)) == 0;  // but for its last bytes
      }));
  ASSERT_EQ(document->head().texts.size(), 1U);
  EXPECT_EQ(*document->head().texts.at("file-matches.path"), std::string_view("1 2 3\n\0x", 8));
  const auto left = document->picture(true), right = document->picture(false);
  ASSERT_TRUE(left && right);
  EXPECT_EQ(left->view.format, PixelFormat::Rgb8);
  EXPECT_EQ(right->view.format, PixelFormat::Grey16);
  EXPECT_EQ(right->view.stride_bytes, kWidth * 2);
  for (int y = 0; y < kHeight; ++y) {
    EXPECT_EQ(std::memcmp(left->view.row(y), sample.parts().frame.left.row(y), kWidth * 3), 0);
    EXPECT_EQ(std::memcmp(right->view.row(y), sample.parts().frame.right.row(y), kWidth * 2), 0);
  }
  const auto pair = document->pair(heap());
  ASSERT_TRUE(pair);
  EXPECT_TRUE(same(pair->left.grey, sample.pair.left.grey) && same(pair->right.rgb, sample.pair.right.rgb) &&
              same(pair->region, sample.pair.region));
  EXPECT_TRUE(same(pair->left.valid, sample.pair.left.valid));
  EXPECT_TRUE(std::signbit(pair->near_mm));
  EXPECT_EQ(pair->focal_px, 1.0 / 3);
  EXPECT_TRUE(std::ranges::equal(pair->rectified_from_left.m, sample.pair.rectified_from_left.m));
  EXPECT_TRUE(std::ranges::equal(pair->right_from_left.rotation.m, sample.pair.right_from_left.rotation.m));
  EXPECT_EQ(pair->right_from_left.translation_mm.x, sample.pair.right_from_left.translation_mm.x);
  const auto matches = document->matches(*pair, heap());
  ASSERT_TRUE(matches);
  ASSERT_EQ(matches->matches.size(), 2U);
  EXPECT_EQ(matches->matches[0].disparity_px, 0.1F);
  EXPECT_TRUE(std::signbit(matches->matches[0].cost) && std::isinf(matches->matches[0].sigma_px));
  EXPECT_EQ(matches->matches[0].rejected_by, 5);
  EXPECT_EQ(matches->epipolar_shift.covariance_px2[5], 1.0 / 9);
  EXPECT_EQ(matches->lattice_step_px, 2);
  const auto cloud = document->cloud(*pair, heap());
  ASSERT_TRUE(cloud);
  EXPECT_TRUE(same(cloud->points, sample.cloud.points));
  EXPECT_EQ(cloud->right_camera_mm.z, -3);
  const auto model = document->model(heap());
  ASSERT_TRUE(model);
  EXPECT_TRUE(test::identical(*model, sample.model));
  EXPECT_TRUE(same(model->backdrop.at_mm, sample.model.backdrop.at_mm) &&
              same(model->backdrop.rgba, sample.model.backdrop.rgba));
  const auto& c = document->head().calibration;
  EXPECT_TRUE(
      std::ranges::equal(c.right_from_left.rotation.m, sample.head.calibration.right_from_left.rotation.m));
  EXPECT_EQ(c.right_from_left.translation_mm.z, sample.head.calibration.right_from_left.translation_mm.z);
}

TEST(Document, AReconstructionThatEndedEarlyHasWhatItsStagesMade) {
  Sample sample;
  sample.head.stages.resize(3);
  DocumentParts parts = sample.parts();
  parts.model = nullptr;
  parts.mesh = &sample.model.mesh;
  const auto bytes = make_document(parts);
  ASSERT_TRUE(bytes);
  const auto document = Document::open(*bytes);
  ASSERT_TRUE(document);
  const auto mesh = document->mesh(heap());
  ASSERT_TRUE(mesh);
  EXPECT_TRUE(same(mesh->vertices_mm, sample.model.mesh.vertices_mm) &&
              same(mesh->triangles, sample.model.mesh.triangles) &&
              same(mesh->measured, sample.model.mesh.measured));
  EXPECT_FALSE(document->model(heap()));
}

TEST(Document, WhatIsNoneOrNewerIsToldApart) {
  const auto bytes = make_document(Sample().parts());
  ASSERT_TRUE(bytes);
  EXPECT_EQ(Document::open({}).error().code, Errc::InvalidInput);
  EXPECT_EQ(Document::open(std::span(*bytes).first(99)).error().code, Errc::InvalidInput);
  auto foreign = *bytes;
  foreign[71] ^= std::byte{1};  // the application id
  EXPECT_EQ(Document::open(foreign).error().code, Errc::InvalidInput);
  auto newer = *bytes;
  newer[63] = std::byte{4};  // the user version
  EXPECT_EQ(Document::open(newer).error().code, Errc::Unsupported);
}

TEST(Document, EveryCutIsNoticed) {
  const auto bytes = make_document(Sample().parts());
  ASSERT_TRUE(bytes);
  for (std::size_t size = 100; size < bytes->size(); size += 509)
    EXPECT_EQ(Document::open(std::span(*bytes).first(size)).error().code, Errc::InvalidInput) << size;
}

// A changed byte is refused, or it lay in a page's unused room and every product is as it was.
TEST(Document, AChangedByteIsNeverTakenForANumber) {
  const Sample sample;
  const auto bytes = make_document(sample.parts());
  ASSERT_TRUE(bytes);
  std::size_t refused = 0, tried = 0;
  for (std::size_t at = 100; at < bytes->size(); at += 97, ++tried) {
    auto changed = *bytes;
    changed[at] ^= std::byte{0x10};
    const auto document = Document::open(changed);
    if (!document) {
      ++refused;
      EXPECT_EQ(document.error().code, Errc::InvalidInput) << at;
      continue;
    }
    const auto model = document->model(heap());
    ASSERT_TRUE(model) << at;
    EXPECT_TRUE(test::identical(*model, sample.model)) << at;
    const auto pair = document->pair(heap());
    ASSERT_TRUE(pair) << at;
    EXPECT_TRUE(same(pair->left.grey, sample.pair.left.grey)) << at;
  }
  EXPECT_GT(refused * 2, tried);  // so small a document has much unused room
}

// A place outside its picture would be read past the end of it.
TEST(Document, WhatDoesNotHangTogetherIsRefused) {
  Sample sample;
  sample.matches.matches[0].left_px.x = kWidth;
  const auto outside = make_document(sample.parts());
  ASSERT_TRUE(outside);
  const auto document = Document::open(*outside);
  ASSERT_TRUE(document);
  const auto pair = document->pair(heap());
  ASSERT_TRUE(pair);
  EXPECT_EQ(document->matches(*pair, heap()).error().code, Errc::InvalidInput);
  sample.pair.right.valid.pop_back();
  const auto short_of_one = make_document(sample.parts());
  ASSERT_TRUE(short_of_one);
  const auto other = Document::open(*short_of_one);
  ASSERT_TRUE(other);
  EXPECT_EQ(other->pair(heap()).error().code, Errc::InvalidInput);
}

}  // namespace
}  // namespace relievo::storage
