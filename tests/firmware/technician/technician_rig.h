// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The test capture behind the technician's pages, on a small simulated rig: what a finger on a page asks for
// is brought to it as the staff's side does, without a PIN. One simulated person for all tests:
// making one takes longest.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <thread>

#include "firmware/records/event_log.h"
#include "firmware/technician/test_capture.h"
#include "firmware/work/pipeline_stages.h"
#include "firmware/work/session_document.h"
#include "hal/base/whole_file.h"
#include "hal/clock.h"
#include "hal/sim/device.h"
#include "hal/sim/replay/replay_device.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "storage/document/document.h"
#include "storage/sqlite/sqlite_store.h"
#include "tests/firmware/held_hand.h"
#include "tests/firmware/technician/spoiled_pairs.h"
#include "tests/firmware/test_records.h"
#include "tests/support/faulty_store.h"
#include "tests/support/made_screen.h"
#include "tests/support/small_device.h"
#include "tests/support/temporary_folder.h"

namespace relievo::firmware::test_technician {

constexpr double kScale = 0.4, kBoardScale = 0.25;  // of the rig's pictures

// Takes no calibration while its disk is full.
class FullStore final : public test::FaultyStore {
 public:
  FullStore(std::unique_ptr<storage::Store> real, const std::atomic<bool>& full)
      : FaultyStore(std::move(real), none_), full_(full) {}
  Result<std::uint32_t> save_calibration(const pipeline::StereoCalibration& c, std::string_view note,
                                         const storage::CalibrationFigures& figures) override {
    if (full_) return Error{Errc::MediaFull, "as the test says"};
    return FaultyStore::save_calibration(c, note, figures);
  }

 private:
  const std::atomic<std::optional<Errc>> none_{};
  const std::atomic<bool>& full_;
};

class TechnicianRig {
 public:
  TechnicianRig() {
    hal::SimDeviceOptions options = test::small_device(kScale);
    std::filesystem::create_directory(stick());
    options.media_folder = stick();
    device = *hal::make_sim_device(options);
    const auto file = folder.path() / "rig.yml";
    EXPECT_TRUE(hal::sim::write_rig(file, hal::sim::make_rig(test::small_rig(kScale))).has_value());
    const auto calibration = pipeline::read_calibration(file);
    store = std::make_unique<FullStore>(*storage::open_sqlite_store(folder.path() / "store", clock, {}),
                                        disk_full);
    EXPECT_TRUE(store->save_calibration(*calibration, "of the simulated rig").has_value());
    stages = std::make_unique<PipelineStages>(*pipeline::Pipeline::make({}, *store->active_calibration()));
    screen = test::make_screen();
    appliance = std::make_unique<Appliance>(Appliance::Parts{*device, *stages, memory, pool, records});
    side_tasks = std::make_unique<SideTasks>(*appliance);
    test_capture = std::make_unique<TestCapture>(
        TechnicianParts{*appliance, *side_tasks, *device, *stages, pool, *store, log,
                        [this](const BoardArgs& args) -> Result<std::unique_ptr<LivePairs>> {
                          return std::unique_ptr<LivePairs>(std::make_unique<SpoiledPairs>(
                              make_hand_pairs(held_board(boards, args), 1), spoils));
                        },
                        [this](const pipeline::StereoCalibration& in_use) { revision = in_use.revision; }});
    EXPECT_TRUE(until([&] { return appliance->state() == State::Idle; }));
    appliance->ask(ui::Intent::OpenStaff);
    turn();
  }
  ~TechnicianRig() {
    test_capture.reset();
    side_tasks.reset();
    appliance.reset();
  }

  void open(ui::StaffPage to) {
    if (page != ui::StaffPage::Count) test_capture->closed(page);
    page = to;
    screen->service().show(to);
    test_capture->opened(to);
    turn();
  }
  void turn() {
    // The machine ends a staff round that nobody touches; under a sanitizer a test takes longer than that.
    appliance->ask(ui::Intent::StillHere);
    appliance->step(std::chrono::milliseconds(0));
    side_tasks->turn();
    test_capture->turn();
    frame();
    while (const auto request = screen->take_staff_request()) {
      if (const auto* asked = request->as<ui::TechnicianRequest>()) test_capture->act(*asked);
      if (const auto* list = request->as<ui::ListRequest>()) test_capture->act(ui::TechnicianRequest(*list));
      test_capture->turn();
      frame();
    }
  }
  // Minutes are "never".
  template <typename Condition>
  bool until(Condition condition) {
    for (int i = 0; i < 60'000 && !condition(); ++i) {
      turn();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return condition();
  }
  // Scrolls are for fingers: what lies in one is touched by the keypad.
  void tap(std::string_view id, float x_share = 0.5F, float y_share = 0.5F) {
    const ui::Node* node = screen->tree().find(id);
    ASSERT_NE(node, nullptr) << id << " is not on the screen";
    const float x = node->rect.x + node->rect.w * x_share, y = node->rect.y + node->rect.h * y_share;
    const ui::Node* at = screen->tree().at(x, y);
    if (at != nullptr && at->id == id) {
      screen->feed({ui::Input::Kind::Down, 3, x, y}, view);
      screen->feed({ui::Input::Kind::Up, 3, x, y}, view);
    } else {
      for (std::size_t i = 0; i < screen->tree().nodes().size() && focused() != id; ++i)
        screen->feed({ui::Input::Kind::Next}, view);
      ASSERT_EQ(focused(), id) << "the keypad does not get there";
      screen->feed({ui::Input::Kind::Activate}, view);
    }
    turn();
  }
  // A finger comes down at one place of it and goes to another, in shares.
  void drag(std::string_view id, float from_x, float from_y, float to_x, float to_y) {
    const ui::Node* node = screen->tree().find(id);
    ASSERT_NE(node, nullptr) << id << " is not on the screen";
    const ui::Rect at = node->rect;
    const auto feed = [&](ui::Input::Kind kind, float x, float y) {
      screen->feed({kind, 3, at.x + at.w * x, at.y + at.h * y}, view);
      turn();
    };
    feed(ui::Input::Kind::Down, from_x, from_y);
    for (const float part : {0.3F, 0.7F, 1.0F})
      feed(ui::Input::Kind::Move, from_x + part * (to_x - from_x), from_y + part * (to_y - from_y));
    feed(ui::Input::Kind::Up, to_x, to_y);
  }
  // After what was written the stick was let go.
  void plug_in() { dynamic_cast<hal::FolderMedia&>(device->media()).plug(stick()); }
  bool shows(std::string_view id) const { return screen->tree().find(id) != nullptr; }
  bool says(std::string_view words) const {
    return std::ranges::any_of(screen->tree().nodes(), [&](const ui::Node& node) {
      return node.text.find(words) != std::string_view::npos;
    });
  }
  std::string_view focused() const { return screen->focus(); }
  const ui::TechnicianView& now() { return test_capture->view(); }

  std::filesystem::path stick() const { return folder.path() / "stick"; }
  // What the last "save" has put there.
  Result<Making> saved_making() {
    RELIEVO_TRY_ASSIGN(const auto bytes, read_whole_file(stick() / now().recording.where, 1U << 30));
    RELIEVO_TRY_ASSIGN(const auto document, storage::Document::open(bytes));
    return making_of(document);
  }

  ::relievo::test::TemporaryFolder folder;
  hal::MonotonicClock clock;
  EventLog log{clock, {}};
  BootMemory memory;
  ThreadPool pool{2};
  std::unique_ptr<hal::Device> device;
  std::atomic<bool> disk_full{false};
  std::unique_ptr<storage::Store> store;
  std::unique_ptr<PipelineStages> stages;
  std::unique_ptr<ui::Ui> screen;
  std::string names;
  std::deque<Errc> errors;
  TestRecords records{names, errors};
  std::unique_ptr<Appliance> appliance;
  std::unique_ptr<SideTasks> side_tasks;
  std::unique_ptr<TestCapture> test_capture;
  ui::ServiceView staff;
  ui::ViewState view;
  hal::sim::RigOptions boards = test::small_rig(kBoardScale);  // the cameras that are shown one
  SpoiledPairs::Spoils spoils;                                 // ... and what happens to their pairs
  ui::StaffPage page = ui::StaffPage::Count;
  std::uint32_t revision = 0;

 private:
  void frame() {
    staff = {};
    staff.role = ui::StaffRole::Technician;
    staff.technician = &test_capture->view();
    view = ui::ViewState();
    view.now = clock.now();
    view.screen = ui::Screen::Staff;
    view.service = &staff;
    screen->frame(view);
  }
};

}  // namespace relievo::firmware::test_technician
