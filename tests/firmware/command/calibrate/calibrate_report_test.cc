// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/calibrate/calibrate_command.h"

#include <gtest/gtest.h>

#include "hal/picture_file.h"
#include "tests/firmware/command/calibrate/kept_lines.h"
#include "tests/pipeline/calibrate/simulated_boards.h"
#include "tests/support/html_reader.h"
#include "tests/support/temporary_folder.h"

namespace relievo::tests {
namespace {

namespace fs = std::filesystem;

// An eighth of the simulated rig: small pictures, the same corners.
SimulatedRig small_rig() {
  SimulatedRig rig;
  for (int eye = 0; eye < 2; ++eye) {
    rig.focal[eye] /= 8;
    for (double& c : rig.centre[eye]) c /= 8;
  }
  rig.width_px /= 8;
  rig.height_px /= 8;
  return rig;
}

class CalibrateReport : public ::testing::Test {
 protected:
  CalibrateReport() : boards_(small_rig(), 0.02, 4) {
    boards_.add(8);
    const char* const names[] = {"0",       "1",      "_1", "<script>alert('x')<|script>",
                                 "caf\xE9", "a b#?%", "6",  "7"};
    for (std::size_t i = 0; i < 8; ++i) {
      pipeline::BoardView& view = boards_.input().views[i];
      view.name = i == 2 ? "1" : names[i];
      pairs_.push_back({view.name, here / ("left" + std::string(names[i]) + ".png"),
                        here / ("right" + std::string(names[i]) + ".png")});
      write(pairs_.back().left, 128);
      write(pairs_.back().right, i == 6 ? 120 : 128);
    }
    auto done = pipeline::calibrate(boards_.input());
    EXPECT_TRUE(done);
    if (done) output_ = *std::move(done);
  }
  static void write(const fs::path& file, int side) {
    const std::vector<std::byte> grey(static_cast<std::size_t>(side) * static_cast<std::size_t>(side),
                                      std::byte{90});
    ASSERT_TRUE(hal::write_picture(file, {grey.data(), side, side, side, PixelFormat::Grey8}));
  }
  Result<void> report(const fs::path& folder) {
    return firmware::write_calibration_report(folder, pairs_, boards_.input(), output_,
                                              "2026-03-14 09:26 UTC", out_.tell());
  }

  test::TemporaryFolder here;
  BoardSimulator boards_;
  std::vector<hal::PicturePairFiles> pairs_;
  pipeline::CalibratorOutput output_;
  KeptLines out_;
};

TEST_F(CalibrateReport, EveryLinkLeadsToAPicture) {
  const auto done = report(here / "new/report");
  ASSERT_TRUE(done) << done.error().what.view();
  const std::string html = test::read_text(here / "new/report/index.html");
  const HtmlReader page(html);
  EXPECT_EQ(page.error(), "");
  EXPECT_EQ(html.find("<script"), std::string::npos);
  int links = 0;
  int images = 0;
  for (const HtmlElement& element : page.elements()) {
    images += element.name == "image" ? 1 : 0;
    if (element.name != "a") continue;
    const std::string& link = element.attributes.at("href");
    if (link.starts_with('#')) continue;  // a place on the page itself
    ++links;
    std::string name;
    for (std::size_t i = 0; i < link.size(); ++i) {
      if (link[i] != '%') name += link[i];
      else name += static_cast<char>(std::stoi(link.substr(i + 1, 2), nullptr, 16)), i += 2;
    }
    EXPECT_TRUE(hal::read_picture(here / ("new/report/" + name))) << link;
  }
  EXPECT_EQ(links, 14) << "two a pair, none of the pair whose pictures differ in size";
  EXPECT_EQ(images, 16) << "but its thumbnails are there";
  EXPECT_TRUE(fs::exists(here / "new/report/report.json"));
  EXPECT_TRUE(fs::exists(here / "new/report/corners_1_2.png"))
      << "two views may have one name, two files may not";
}

TEST_F(CalibrateReport, LeavesNothingHalfWritten) {
  fs::remove(pairs_[5].right);
  const std::string before = test::listing(here.path());
  const auto lost = report(here / "new/report");
  ASSERT_FALSE(lost);
  EXPECT_EQ(lost.error().code, Errc::NotFound);
  EXPECT_NE(lost.error().where().find("a b#?%"), std::string_view::npos);
  EXPECT_EQ(test::listing(here.path()), before);

  test::write_text(here / "file", "in the way");
  ASSERT_FALSE(report(here / "file"));
  ASSERT_FALSE(report(here / "file/report"));
  EXPECT_EQ(test::read_text(here / "file"), "in the way");
}

TEST_F(CalibrateReport, SaysThatTheDiskIsFullAndWhere) {
  const test::TinyDisk disk(20'000);
  if (!disk.mounted()) GTEST_SKIP() << disk.why_not();
  const auto full = report(disk.path() / "report");
  ASSERT_FALSE(full);
  EXPECT_EQ(full.error().code, Errc::MediaFull);
  EXPECT_NE(full.error().where().find("/report/"), std::string_view::npos) << full.error().where();
  EXPECT_EQ(full.error().where().find(".part"), std::string_view::npos) << "the name that was asked for";
  EXPECT_EQ(test::listing(disk.path()), "");
}

}  // namespace
}  // namespace relievo::tests
