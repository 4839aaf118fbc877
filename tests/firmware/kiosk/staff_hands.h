// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// StaffHands: a kiosk whose staff's side a test walks through by synthetic fingers. Its cameras give two grey
// pictures, its stick is a folder, its store a real one.
#pragma once

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <utility>

#include "firmware/records/receipt.h"
#include "hal/clock.h"
#include "hal/picture_file.h"
#include "hal/sim/device.h"
#include "hal/sim/replay/replay_device.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "storage/sqlite/sqlite_store.h"
#include "tests/firmware/kiosk/kiosk_hands.h"
#include "tests/storage/sample.h"
#include "tests/support/manual_clock.h"
#include "tests/support/small_rig.h"
#include "tests/support/temporary_folder.h"

namespace relievo::firmware {

using ui::StaffPage;
using ui::StaffRole;

inline hal::sim::RigOptions tiny_rig() { return test::small_rig(0.125); }

// A camera whose light can be set, if only to be told.
class SettableCamera final : public hal::Camera {
 public:
  explicit SettableCamera(hal::Camera& real) : real_(real) {}

 private:
  Result<void> do_open(const hal::CaptureMode& mode) override { return real_.open(mode); }
  Result<void> do_start() override { return real_.start(); }
  Result<hal::Frame> do_next_frame(hal::Instant deadline) override { return real_.next_frame(deadline); }
  void do_stop() override { real_.stop(); }
  void do_close() override { real_.close(); }
  Result<void> do_set_exposure(const hal::Exposure&) override { return {}; }
  Result<hal::ExposureLimits> do_exposure_limits() const override {
    return hal::ExposureLimits{{std::chrono::microseconds(50), 1}, {std::chrono::microseconds(30'000), 1}};
  }
  hal::Camera& real_;
};

// Another device with what a test changes: people stand before its cameras, its time moves by hand, its stick
// has faults.
class ChangedDevice final : public hal::Device {
 public:
  struct Changes {
    bool live = false;
    bool settable = false;        // its cameras' light
    hal::Clock* clock = nullptr;  // none: the device's own
    hal::RemovableMedia* media = nullptr;
    std::function<bool()> too_hot;  // none: it never is
  };
  ChangedDevice(std::unique_ptr<hal::Device> device, const Changes& changes)
      : device_(std::move(device)), changes_(changes) {}
  std::string_view name() const override { return device_->name(); }
  hal::CaptureMode preferred_mode() const override { return device_->preferred_mode(); }
  hal::Camera& left() override { return changes_.settable ? left_ : device_->left(); }
  hal::Camera& right() override { return changes_.settable ? right_ : device_->right(); }
  hal::TriggerLine& trigger() override { return device_->trigger(); }
  hal::RemovableMedia& media() override {
    return changes_.media != nullptr ? *changes_.media : device_->media();
  }
  hal::Clock& clock() override { return changes_.clock != nullptr ? *changes_.clock : device_->clock(); }
  hal::Watchdog& watchdog() override { return device_->watchdog(); }
  bool is_live() const override { return changes_.live; }
  bool exposes_together() const override { return device_->exposes_together(); }
  bool too_hot() const override { return changes_.too_hot && changes_.too_hot(); }

 private:
  std::unique_ptr<hal::Device> device_;
  Changes changes_;
  SettableCamera left_{device_->left()}, right_{device_->right()};
};

class StaffHands : public KioskHands {
 protected:
  StaffHands() {
    EXPECT_TRUE(ui::prepare_languages().has_value());
    std::filesystem::create_directories(stick());
    args.store = folder.path() / "store";
    args.device = "sim";  // its calibration
    // Two empty pictures and a folder that is the stick: nobody is photographed here.
    hal::Picture grey;
    grey.width_px = tiny_rig().width_px;
    grey.height_px = tiny_rig().height_px;
    grey.bytes.assign(std::size_t{3} * std::size_t(grey.width_px) * std::size_t(grey.height_px),
                      std::byte{90});
    std::filesystem::create_directories(folder.path() / "pairs");
    for (const char* name : {"left_000000.png", "right_000000.png"})
      EXPECT_TRUE(hal::write_picture(folder.path() / "pairs" / name, grey.view()).has_value());
    services.open_device = [this](std::string_view) -> Result<std::unique_ptr<hal::Device>> {
      RELIEVO_TRY_ASSIGN(auto device, hal::make_folder_device(folder.path() / "pairs"));
      media = &dynamic_cast<hal::ReplayDevice&>(*device).folder_media();
      media->plug(stick());
      return std::unique_ptr<hal::Device>(std::make_unique<ChangedDevice>(std::move(device), changes));
    };
    services.open_store = [this](const Path& at, bool to_write) {
      return storage::open_sqlite_store(
          at, wall(), {.mode = to_write ? storage::OpenMode::ReadWrite : storage::OpenMode::ReadOnly});
    };
    services.simulated_calibration = [this]() -> Result<pipeline::StereoCalibration> {
      const Path file = folder.path() / "rig.yml";
      RELIEVO_TRY(hal::sim::write_rig(file, hal::sim::make_rig(tiny_rig())));
      return pipeline::read_calibration(file);
    };
  }
  Path stick() const { return folder.path() / "stick"; }
  void start() {
    auto opened = Kiosk::open(args, services);
    ASSERT_TRUE(opened.has_value()) << opened.error().what.view();
    kiosk = std::move(*opened);
    kiosk->ui().resize(1280, 800);
    ASSERT_TRUE(until([this] { return kiosk->ui().visit().step == ui::Step::Attract; }));
  }

  void enrol(const char* name, const char* text = "sample-1") {
    auto store = storage::open_sqlite_store(args.store, wall(), {});
    ASSERT_TRUE(store.has_value());
    const pipeline::FaceModel model = storage::test::sample_model();
    ASSERT_TRUE(
        (*store)->add_enrolment(storage::NewSubject{name}, {model, {text, "en", {}}, 0, "", ""}).has_value());
  }
  const hal::Clock& wall() const {
    if (changes.clock != nullptr) return *changes.clock;
    return clock;
  }
  // Of the n-th who was enrolled here.
  std::string code_of(std::int64_t number) const {
    auto store = storage::open_sqlite_store(args.store, wall(), {.mode = storage::OpenMode::ReadOnly});
    EXPECT_TRUE(store.has_value());
    const auto subject = (*store)->subject(storage::SubjectId{number});
    return subject ? receipt_of(*subject) : "nobody's";
  }
  static std::string text_of_file(const Path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  void let_it_stand() override {
    auto* by_hand = dynamic_cast<hal::ManualClock*>(changes.clock);
    if (by_hand == nullptr) return KioskHands::let_it_stand();
    by_hand->advance(ui::kTooLate);
    kiosk->turn();
  }
  // By the keypad, which needs not hold: on until the lock has the focus.
  void focus_on(std::string_view id) {
    ASSERT_NE(find(id), nullptr) << id << " is not on the screen";
    do kiosk->feed({ui::Input::Kind::Next});
    while (kiosk->ui().focus() != id);
  }
  void knock() {
    focus_on("staff");
    kiosk->feed({ui::Input::Kind::Activate});
    kiosk->turn();
    ASSERT_TRUE(kiosk->ui().service().open);
  }
  void type_pin(std::string_view pin) {
    for (const char digit : pin) tap("digit " + std::string(1, digit));
    tap("pin done");
    ASSERT_TRUE(until([this] { return !kiosk->view().service->access.checking; }));
  }
  void choose_pins() {
    tap("go on");
    tap("clock right");
    tap("consent right");
    for (const char* pin : {"4711", "4711", "80526", "80526"}) type_pin(pin);
    ASSERT_TRUE(until([this] { return kiosk->ui().service().page == StaffPage::Pin; }));
  }
  void first_start() {
    knock();
    ASSERT_EQ(kiosk->ui().service().page, StaffPage::FirstStart);
    choose_pins();
  }
  void sign_in(const char* pin, StaffRole role) {
    if (!kiosk->ui().service().open) knock();
    type_pin(pin);
    // Before real people an operator sees the recovery sheet first, until it is confirmed.
    ASSERT_TRUE(until([this] {
      return kiosk->ui().service().page == StaffPage::Menu ||
             kiosk->ui().service().page == StaffPage::Recovery;
    }));
    EXPECT_EQ(kiosk->view().service->role, role);
    EXPECT_EQ(kiosk->appliance().state(), State::Staff);
  }
  // The operator before the list of those who were enrolled just now.
  void open_records(std::initializer_list<const char*> names) {
    for (const char* name : names) enrol(name);
    start();
    first_start();
    sign_in("80526", StaffRole::Operator);
    tap("open records");
    const auto newest = "record " + std::to_string(names.size());
    ASSERT_TRUE(until([&] { return find(newest) != nullptr; }));
  }
  // A finger comes and stays.
  void rest_on(std::string_view id) {
    const ui::Node* node = find(id);
    ASSERT_NE(node, nullptr) << id << " is not on the screen";
    rests_x = node->rect.x + node->rect.w / 2;
    rests_y = node->rect.y + node->rect.h / 2;
    kiosk->feed({ui::Input::Kind::Down, finger, rests_x, rests_y});
    kiosk->turn();
  }
  void lift() {
    kiosk->feed({ui::Input::Kind::Up, finger, rests_x, rests_y});
    kiosk->turn();
  }
  // Rests on it until it is done. Time must move by hand (changes.clock).
  void hold(std::string_view id, hal::ManualClock& time) {
    rest_on(id);
    time.advance(ui::kHold + std::chrono::milliseconds(1));
    kiosk->turn();
  }
  void sign_out() {
    tap("sign out");
    ASSERT_TRUE(until([this] { return kiosk->appliance().state() == State::Idle; }));
    EXPECT_FALSE(kiosk->ui().service().open);
    EXPECT_EQ(kiosk->view().service->role, StaffRole::None);
    EXPECT_TRUE(kiosk->take_forgotten());
  }

  ChangedDevice::Changes changes;  // before start()
  test::TemporaryFolder folder;
  hal::MonotonicClock clock;
  Console console;
  Services services{.console = console, .clock = clock};
  KioskArgs args;
  hal::FolderMedia* media = nullptr;
  float rests_x = 0, rests_y = 0;
};

}  // namespace relievo::firmware
