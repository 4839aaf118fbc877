// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// KioskHands: a test that touches a kiosk as people do: what is on the screen is found by its name and
// tapped, and what takes its time is waited for.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <sstream>
#include <string_view>
#include <thread>

#include "firmware/kiosk/kiosk.h"
#include "firmware/kiosk/script/script_player.h"
#include "hal/sim/device.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "storage/sqlite/sqlite_store.h"
#include "tests/support/small_device.h"

namespace relievo::firmware {

class KioskHands : public testing::Test {
 protected:
  // A small simulated rig that knows its calibration, and a store in `folder`; all may be replaced.
  static void lend_small_rig(Services& services, KioskArgs& args, const std::filesystem::path& folder,
                             const hal::Clock& clock, const hal::SimDeviceOptions& device) {
    EXPECT_TRUE(ui::prepare_languages().has_value());
    args.store = folder / "store";
    services.open_device = [device](std::string_view) { return hal::make_sim_device(device); };
    services.open_store = [&clock](const std::filesystem::path& at, bool) {
      return storage::open_sqlite_store(at, clock, {});
    };
    services.simulated_calibration = [folder,
                                      rig = device.simulation.rig]() -> Result<pipeline::StereoCalibration> {
      const std::filesystem::path file = folder / "rig.yml";
      RELIEVO_TRY(hal::sim::write_rig(file, hal::sim::make_rig(rig)));
      return pipeline::read_calibration(file);
    };
  }
  void open(const KioskArgs& args, Services& services) {
    auto opened = Kiosk::open(args, services);
    EXPECT_TRUE(opened.has_value()) << opened.error().what.view();
    kiosk = std::move(*opened);
    kiosk->ui().resize(1280, 800);
  }
  // Before what the test lends it goes.
  void TearDown() override { kiosk.reset(); }
  const ui::Node* find(std::string_view id) const { return kiosk->ui().tree().find(id); }
  // A page takes no touch in its first moment.
  virtual void let_it_stand() {
    EXPECT_TRUE(until([this] { return !kiosk->ui().has_just_come(kiosk->view().now); }));
  }
  void tap(std::string_view id) {
    if (kiosk->ui().has_just_come(kiosk->view().now)) let_it_stand();
    const ui::Node* node = find(id);
    ASSERT_NE(node, nullptr) << id << " is not on the screen";
    const float x = node->rect.x + node->rect.w / 2, y = node->rect.y + node->rect.h / 2;
    kiosk->feed({ui::Input::Kind::Down, finger, x, y});
    kiosk->feed({ui::Input::Kind::Up, finger, x, y});
    kiosk->turn();
  }
  // Minutes are "never".
  bool until(const std::function<bool()>& reached) {
    for (int turn = 0; turn < 100'000 && !reached(); ++turn) {
      kiosk->turn();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return reached();
  }
  bool says(std::string_view words) const {
    for (const ui::Node& node : kiosk->ui().tree().nodes()) {
      if (node.text.find(words) != std::string_view::npos) return true;
    }
    return false;
  }
  bool reach(ui::Step step) {
    return until([this, step] { return kiosk->ui().visit().step == step; });
  }
  // Lines of a script (firmware/kiosk/script), played to their end.
  Result<void> play(const char* lines) {
    std::vector<ScriptAction> script;
    std::istringstream in(lines);
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
      RELIEVO_TRY_ASSIGN(const auto action, read_script_line(line, "line " + std::to_string(number)));
      if (action) script.push_back(*action);
    }
    ScriptPlayer player(std::move(script), {[this](const ui::Input& input) { kiosk->feed(input); }});
    for (;;) {
      RELIEVO_TRY_ASSIGN(const bool goes_on, player.turn(*kiosk, std::chrono::steady_clock::now()));
      if (!goes_on) return {};
      kiosk->turn();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  std::int64_t finger = 7;  // ui::kMouse: a mouse
  std::unique_ptr<Kiosk> kiosk;
};

}  // namespace relievo::firmware
