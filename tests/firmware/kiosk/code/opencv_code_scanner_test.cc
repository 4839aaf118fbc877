// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A sheet of paper with a QR code before the simulated cameras: read by the kiosk as it was printed, on
// the page for the name and nowhere else. What is printed is known; nothing else is taken for a code.
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "firmware/kiosk/code/qr_code.h"
#include "firmware/records/receipt.h"
#include "hal/clock.h"
#include "hal/sim/device.h"
#include "hal/sim/sheet/sheet_photo.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "storage/sqlite/sqlite_store.h"
#include "tests/firmware/kiosk/kiosk_hands.h"
#include "tests/support/printed_code.h"
#include "tests/support/temporary_folder.h"

namespace relievo::firmware {
namespace {

constexpr double kScale = 0.5;  // of the rig's pictures

hal::sim::SheetPhotoOptions held(double width_mm, hal::sim::HeadPose pose) {
  hal::sim::SheetPhotoOptions options;
  options.rig.width_px = static_cast<int>(options.rig.width_px * kScale);
  options.rig.height_px = static_cast<int>(options.rig.height_px * kScale);
  options.sheet.width_mm = width_mm;
  options.sheet.pose = pose;
  return options;
}

TEST(CodeReader, ReadsWhatIsPrintedHoweverItIsHeld) {
  ThreadPool pool(2);
  const auto see = [&](const std::string& text, double width_mm, hal::sim::HeadPose pose) {
    const auto options = held(width_mm, pose);
    const auto scene = hal::sim::make_sheet_scene(test::printed_code(text), options.sheet);
    EXPECT_TRUE(scene.has_value());
    const auto pair =
        hal::sim::render_pair(**scene, hal::sim::make_rig(options.rig), options.sensor, 7, pool);
    EXPECT_EQ(read_code(pair.left.view()), text);
    EXPECT_EQ(read_code(pair.right.view()), text);
  };
  see("A-2041", 160, {12, -8, 20, 500, 30, -20});
  see("Grace Hopper 1906", 200, {-15, 10, -90, 600, 0, 0});
}

TEST(CodeReader, NothingIsReadWhereNothingIs) {
  std::vector<std::byte> noise(640 * 480);
  cv::RNG random(5);
  for (std::byte& b : noise) b = static_cast<std::byte>(random.uniform(0, 256));
  EXPECT_FALSE(read_code({noise.data(), 640, 480, 640, PixelFormat::Grey8}));
  std::fill(noise.begin(), noise.end(), std::byte{90});
  EXPECT_FALSE(read_code({noise.data(), 640, 480, 640, PixelFormat::Grey8}));
}

class CodeScannerTest : public KioskHands {
 protected:
  CodeScannerTest() { EXPECT_TRUE(ui::prepare_languages().has_value()); }
  void show(const hal::Picture& sheet) {
    ASSERT_TRUE(hal::sim::photograph_sheet(sheet, held(180, {0, 0, 8, 560, 0, 0}), folder.path() / "held")
                    .has_value());
    services.open_device = [this](std::string_view) {
      return hal::make_folder_device(folder.path() / "held");
    };
    services.open_store = [this](const Path& at, bool) { return storage::open_sqlite_store(at, clock, {}); };
    args.store = folder.path() / "store";
    args.calibration = folder.path() / "held" / "rig.yml";
    auto opened = Kiosk::open(args, services);
    ASSERT_TRUE(opened.has_value()) << opened.error().where() << opened.error().what.view();
    kiosk = std::move(*opened);
    kiosk->ui().resize(1280, 800);
  }
  void turns(int count) {
    for (int turn = 0; turn < count; ++turn) {
      kiosk->turn();
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }
  std::string_view name() const { return kiosk->ui().visit().name(); }

  test::TemporaryFolder folder;
  hal::MonotonicClock clock;
  Console console;
  Services services{.console = console, .clock = clock};
  KioskArgs args;
};

TEST_F(CodeScannerTest, ACodeStandsInTheFieldAfterTheConsentAndIsConfirmedByTouch) {
  show(test::printed_code("A-2041"));
  ASSERT_TRUE(reach(ui::Step::Attract));
  turns(20);
  EXPECT_EQ(name(), "") << "before anybody is there";
  tap("start");
  turns(50);
  EXPECT_EQ(name(), "") << "before the consent no camera looks";
  tap("agree");
  ASSERT_TRUE(until([this] { return name() == "A-2041"; })) << name();
  EXPECT_EQ(kiosk->ui().visit().step, ui::Step::Name) << "to be confirmed";
  EXPECT_EQ(kiosk->appliance().state(), State::Idle);
  tap("erase");
  EXPECT_EQ(name(), "A-204");
  turns(30);
  EXPECT_EQ(name(), "A-204") << "what was typed is not written over";
  tap("key 1");
  tap("done");
  ASSERT_TRUE(reach(ui::Step::Position));
  EXPECT_EQ(kiosk->appliance().session().subject(), "A-2041");
  EXPECT_LE(kiosk->ui().visit().touches, 2);
}

// Also where it is read in the moment in which they go back to their name.
TEST_F(CodeScannerTest, TheCodeOfARecordIsTakenOnItsOwnPageAlone) {
  std::string code;
  {
    auto store = storage::open_sqlite_store(folder.path() / "store", clock, {});
    ASSERT_TRUE(store.has_value());
    code = receipt_of(*(*store)->subject(*(*store)->add_subject({"Ada"})));
  }
  show(test::printed_code(code));
  std::erase(code, '-');
  ASSERT_TRUE(reach(ui::Step::Attract));
  tap("start");
  tap("agree");
  ASSERT_TRUE(until([this] { return !kiosk->view().live.picture.empty(); }));
  turns(150);
  EXPECT_EQ(name(), "") << "it is nobody's name";
  const auto ask_for_the_code = [this] {
    kiosk->ui().visit().type("Ada");
    kiosk->turn();
    tap("done");
    ASSERT_TRUE(reach(ui::Step::Known));
    turns(50);
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // after a look it rests
    tap("have_code");
  };
  ask_for_the_code();
  ASSERT_TRUE(until([this] { return !name().empty(); }));
  EXPECT_EQ(name(), code);
  kiosk->feed({ui::Input::Kind::Back});
  kiosk->turn();
  ASSERT_EQ(name(), "");
  ask_for_the_code();
  std::this_thread::sleep_for(std::chrono::milliseconds(500));  // it is read, and nobody has heard of it
  kiosk->feed({ui::Input::Kind::Back});
  turns(50);
  EXPECT_EQ(kiosk->ui().visit().step, ui::Step::Name);
  EXPECT_EQ(name(), "");
}

TEST_F(CodeScannerTest, AnAddressIsNoNameAndWhoLeavesIsForgotten) {
  show(test::printed_code("https://example.org"));
  ASSERT_TRUE(reach(ui::Step::Attract));
  tap("start");
  tap("agree");
  turns(150);
  EXPECT_EQ(name(), "");
  EXPECT_EQ(kiosk->ui().visit().step, ui::Step::Name);
  tap("back");
  EXPECT_EQ(kiosk->ui().visit().step, ui::Step::Consent);
}

}  // namespace
}  // namespace relievo::firmware
