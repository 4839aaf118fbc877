// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A dozen pages, pixel by pixel, as they were when somebody looked at them: tests/golden/pages/. Drawn by
// llvmpipe with Debian's fonts; pictures and models are left out. A page fails when more than 0.1 % of its
// pixels differ by more than 16 levels, or more than a tenth of any tile of 16 x 16.
//
//   RELIEVO_RENEW_GOLDENS=1 build/release/tests/firmware/test_firmware --gtest_filter='*Golden*'   draws them
//   anew: look at them
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "firmware/demo/gallery.h"
#include "hal/picture_file.h"
#include "tests/support/gles_driver.h"
#include "tests/support/made_screen.h"
#include "tests/support/tight_png.h"
#include "tests/ui/quiet_driver.h"
#include "ui/platform/sdl_display.h"
#include "ui/render/renderer.h"

namespace relievo::firmware {
namespace {

constexpr int kLevels = 16, kTile = 16;
constexpr double kMostDifferent = 0.001, kMostInATile = 0.1;
constexpr int kKeptSteps =
    8;  // grey levels are kept to this: a quarter of the file, and half a step of error

struct Golden {
  const char* page;
  ui::Language language;
  int width_px, height_px;
  std::size_t text;  // of ui::kTextPercents
  bool contrast;
};
using enum ui::Language;
constexpr Golden kGoldens[] = {
    {"attract", English, 1280, 800, 0, false},       {"consent", German, 1280, 800, 0, false},
    {"name", Arabic, 1280, 800, 0, false},           {"name", English, 1280, 800, 0, true},
    {"known_code", German, 1280, 800, 2, false},     {"position_aside", Arabic, 1280, 800, 0, false},
    {"working", English, 1080, 1920, 0, false},      {"thanks", Arabic, 1080, 1920, 2, false},
    {"trouble_camera", German, 1280, 800, 0, false}, {"staff_records", Arabic, 1280, 800, 0, false},
    {"staff_erase", German, 1280, 800, 0, false},    {"technician_option", German, 1280, 800, 0, false},
};

std::string name_of(const Golden& golden) {
  return std::string(golden.page) + "_" + std::to_string(golden.width_px) + "x" +
         std::to_string(golden.height_px) + "_" + std::to_string(ui::kTextPercents[golden.text]) +
         (golden.contrast ? "_contrast" : "") + "_" + std::string(ui::info_of(golden.language).code);
}
std::string test_name(const testing::TestParamInfo<Golden>& info) { return name_of(info.param); }

std::filesystem::path kept_in() {
  return std::filesystem::path(RELIEVO_SOURCE_DIR) / "tests" / "golden" / "pages";
}

class GoldenTest : public testing::TestWithParam<Golden> {
 protected:
  void SetUp() override {
    setenv("SDL_VIDEODRIVER", "offscreen", 1);
    auto opened = ui::open_sdl_display({64, 64});
    ASSERT_TRUE(opened.has_value()) << opened.error().where();
    display = std::move(*opened);
    const std::string driver = test::gles_driver();
    if (driver.find("llvmpipe") == std::string::npos)
      GTEST_SKIP() << "goldens are llvmpipe's, and this is " << driver;
    screen = test::make_screen();
  }
  void TearDown() override {
    screen.reset();
    display.reset();
  }

  hal::Picture draw(const Golden& golden) {
    hal::Picture picture;
    picture.width_px = golden.width_px;
    picture.height_px = golden.height_px;
    picture.bytes.resize(std::size_t{3} * static_cast<std::size_t>(picture.width_px) *
                         static_cast<std::size_t>(picture.height_px));
    const auto exhibits = gallery({}, golden.language, golden.text, golden.contrast);
    const auto shown = std::find_if(exhibits.begin(), exhibits.end(),
                                    [&](const Exhibit& one) { return one.name == golden.page; });
    EXPECT_NE(shown, exhibits.end());
    if (shown == exhibits.end()) return picture;
    screen->resize(golden.width_px, golden.height_px);
    screen->show(shown->view, shown->visit, shown->service);
    auto renderer = ui::Renderer::make();
    auto target = ui::Offscreen::make(golden.width_px, golden.height_px);
    EXPECT_TRUE(renderer.has_value() && target.has_value());
    (*target)->begin();
    (*renderer)->draw(screen->draw_list(), screen->text().atlas(), golden.width_px, golden.height_px);
    (*renderer)->read_back({reinterpret_cast<std::uint8_t*>(picture.bytes.data()), picture.bytes.size()},
                           golden.width_px, golden.height_px);
    (*target)->end();
    mask(picture);
    return picture;
  }
  // What shows pictures and models is judged by others.
  void mask(hal::Picture& picture) const {
    for (const ui::Node& node : screen->tree().nodes()) {
      if (node.mark != ui::Mark::Face && node.mark != ui::Mark::Image) continue;
      const int x0 = std::clamp(static_cast<int>(node.rect.x), 0, picture.width_px),
                x1 = std::clamp(static_cast<int>(node.rect.right()), 0, picture.width_px);
      const int y0 = std::clamp(static_cast<int>(node.rect.y), 0, picture.height_px),
                y1 = std::clamp(static_cast<int>(node.rect.bottom()), 0, picture.height_px);
      for (int y = y0; y < y1; ++y)
        std::fill_n(picture.bytes.begin() + 3 * (static_cast<std::ptrdiff_t>(y) * picture.width_px + x0),
                    3 * std::max(0, x1 - x0), std::byte{96});
    }
  }

  const ui::QuietDriver quiet;
  std::unique_ptr<ui::Display> display;
  std::unique_ptr<ui::Ui> screen;
};

struct Difference {
  double of_all = 0, of_the_worst_tile = 0;
};

Difference difference(const hal::Picture& a, const hal::Picture& b) {
  const int across = (a.width_px + kTile - 1) / kTile, down = (a.height_px + kTile - 1) / kTile;
  std::vector<int> in_tile(static_cast<std::size_t>(across * down));
  int all = 0;
  for (int y = 0; y < a.height_px; ++y) {
    for (int x = 0; x < a.width_px; ++x) {
      const std::size_t at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(a.width_px) +
                                  static_cast<std::size_t>(x));
      int most = 0;
      for (std::size_t c = 0; c < 3; ++c)
        most = std::max(
            most, std::abs(std::to_integer<int>(a.bytes[at + c]) - std::to_integer<int>(b.bytes[at + c])));
      if (most <= kLevels) continue;
      ++all;
      ++in_tile[static_cast<std::size_t>(y / kTile * across + x / kTile)];
    }
  }
  return {static_cast<double>(all) / a.width_px / a.height_px,
          static_cast<double>(*std::max_element(in_tile.begin(), in_tile.end())) / (kTile * kTile)};
}

TEST_P(GoldenTest, IsAsItWasLookedAt) {
  const hal::Picture now = draw(GetParam());
  const auto file = kept_in() / (name_of(GetParam()) + ".png");
  if (std::getenv("RELIEVO_RENEW_GOLDENS") != nullptr) {
    std::filesystem::create_directories(kept_in());
    ASSERT_TRUE(test::write_tight_png(now, kKeptSteps, file));
    return;
  }
  const auto kept = hal::read_picture(file);
  ASSERT_TRUE(kept.has_value()) << file;
  ASSERT_EQ(kept->width_px, now.width_px);
  ASSERT_EQ(kept->height_px, now.height_px);
  const Difference off = difference(*kept, now);
  if (off.of_all <= kMostDifferent && off.of_the_worst_tile <= kMostInATile) return;
  const auto beside = std::filesystem::temp_directory_path() / ("relievo_" + file.filename().string());
  EXPECT_TRUE(hal::write_picture(beside, now.view()).has_value());
  ADD_FAILURE() << 100 * off.of_all << " % of the page differ, " << 100 * off.of_the_worst_tile
                << " % of one tile: compare " << file << " with " << beside;
}

INSTANTIATE_TEST_SUITE_P(Pages, GoldenTest, testing::ValuesIn(kGoldens), test_name);

// A mark of five pixels, which nobody may add to a page unseen.
TEST(GoldenDifference, ASmallMarkInOnePlaceIsNoticedAndNoiseIsNot) {
  hal::Picture a;
  a.width_px = 320;
  a.height_px = 200;
  a.bytes.assign(std::size_t{3} * 320 * 200, std::byte{200});
  hal::Picture noisy = a;
  for (std::size_t i = 0; i < noisy.bytes.size(); i += 7) noisy.bytes[i] = std::byte{185};
  EXPECT_EQ(difference(a, noisy).of_all, 0);
  hal::Picture marked = a;
  for (std::size_t y = 66; y < 72; ++y)
    for (std::size_t x = 100; x < 105; ++x) marked.bytes[3 * (y * 320 + x)] = std::byte{100};
  EXPECT_LT(difference(a, marked).of_all, kMostDifferent);
  EXPECT_GT(difference(a, marked).of_the_worst_tile, kMostInATile);
}

}  // namespace
}  // namespace relievo::firmware
