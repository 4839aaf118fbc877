// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// FaultHands: the real kiosk before the simulated rig, brought by fingers into a state, and each fault let in
// and mended.
#pragma once

#include <chrono>
#include <csignal>
#include <thread>

#include "firmware/base/console.h"
#include "tests/firmware/faults/fault_table.h"
#include "tests/firmware/faults/faulty_rig.h"
#include "tests/firmware/faults/frozen_thread.h"
#include "tests/firmware/kiosk/staff_hands.h"
#include "tests/support/faulty_stick.h"
#include "tests/support/faulty_store.h"
#include "tests/support/rig_calibration.h"
#include "ui/platform/sdl_display.h"

namespace relievo::firmware {

using std::chrono::milliseconds;

using test::FrozenThread;

class FaultHands : public StaffHands {
 protected:
  static void SetUpTestSuite() {
    auto looks = test::small_device(kScale);
    looks.simulation.seed = 4;  // somebody whose turning can be followed at this size
    auto made = hal::make_sim_device(looks);
    ASSERT_TRUE(made);
    rig = made->release();
#ifndef __SANITIZE_ADDRESS__
    // The GL driver leaks and is unloaded at the end, so that no suppression can name it.
    setenv("SDL_VIDEODRIVER", "offscreen", 1);
    auto opened = ui::open_sdl_display({1280, 800});
    ASSERT_TRUE(opened);
    display = opened->release();
#endif
  }
  static void TearDownTestSuite() {
    delete display;
    delete rig;
  }
  FaultHands() {
    services.open_device = [this](std::string_view) {
      return std::unique_ptr<hal::Device>(std::make_unique<test::FaultyRig>(*rig, faults, stick_faults));
    };
    services.open_store = [this](const Path& at, bool) -> Result<std::unique_ptr<storage::Store>> {
      RELIEVO_TRY_ASSIGN(auto real, storage::open_sqlite_store(at, clock, {}));
      return std::unique_ptr<storage::Store>(
          std::make_unique<test::FaultyStore>(std::move(real), store_error));
    };
    services.simulated_calibration = []() -> Result<pipeline::StereoCalibration> {
      pipeline::StereoCalibration known = test::true_calibration(hal::sim::make_rig(test::small_rig(kScale)));
      known.cameras = {"serial L1", "serial R1"};
      return known;
    };
  }
  void turn() {
    if (kick) kick();
    kiosk->turn();
    std::this_thread::sleep_for(milliseconds(4));
  }
  State state() const { return kiosk->appliance().state(); }
  // Nobody touches the screen, and time passes.
  bool come_to_rest() {
    for (int t = 0; t < 20'000; ++t) {
      if (state() == State::Idle && kiosk->ui().visit().step == ui::Step::Attract &&
          !kiosk->ui().service().open)
        return true;
      faults.ahead_s += 1;
      turn();
    }
    return false;
  }
  bool turn_until(State wanted) {
    for (int t = 0; t < 60'000 && state() != wanted; ++t) turn();
    return state() == wanted;
  }

  void pose() {
    tap("start");
    tap("agree");
    kiosk->ui().visit().type("Visitor " + std::to_string(++visitors));
    kiosk->turn();
    tap("done");
    ASSERT_TRUE(turn_until(State::Position)) << name_of(state());
  }
  void visit(State wanted) {
    pose();
    if (wanted == State::Position) return;
    ASSERT_TRUE(until([this] { return kiosk->view().live.number > 0 && find("shoot") != nullptr; }));
    faults.slow = wanted == State::Capture;
    if (state() == State::Position) tap("shoot");
    if (wanted == State::Fuse) {
      ASSERT_TRUE(turn_until(State::Turn)) << name_of(state());
      kiosk->turn();
      tap("enough");
    }
    ASSERT_TRUE(turn_until(wanted == State::Store ? State::Review : wanted)) << name_of(state());
  }
  void enter_staff(State wanted) {
    const bool operates = wanted == State::Export;
    sign_in(operates ? "80526" : "4711", operates ? StaffRole::Operator : StaffRole::Technician);
    if (wanted == State::Calibrate) {
      tap("open calibrate");
      tap("calibration begin");
      ASSERT_TRUE(turn_until(State::Calibrate));
    }
    if (wanted != State::Export) return;
    stick_faults.fail(test::FaultyStick::Fault::Waits);
    tap("open records");
    ASSERT_TRUE(until([this] { return find("export all") != nullptr; }));
    tap("export all");
    ASSERT_TRUE(until([this] { return stick_faults.waits(); }));
  }
  void enter(State wanted) {
    switch (wanted) {
      case State::SelfTest:
        kiosk.reset();
        faults.slow = true;
        begin();
        for (int t = 0; t < 3; ++t) turn();
        break;
      case State::Idle:
      case State::Count: break;
      case State::Staff:
      case State::Calibrate:
      case State::Export: enter_staff(wanted); break;
      case State::Fault:
        pose();
        faults.lost = true;
        ASSERT_TRUE(turn_until(State::Fault));
        faults.lost = false;
        break;
      case State::Position:
      case State::Capture:
      case State::Turn:
      case State::Match:
      case State::Reconstruct:
      case State::Mesh:
      case State::Texture:
      case State::Assemble:
      case State::Fuse:
      case State::Review:
      case State::Store: visit(wanted); break;
    }
  }
  void begin() {
    auto opened = Kiosk::open(args, services);
    ASSERT_TRUE(opened.has_value()) << opened.error().what.view();
    kiosk = std::move(*opened);
    kiosk->ui().resize(1280, 800);
  }

  void let_in(Fault fault) {
    switch (fault) {
      case Fault::None:
      case Fault::MainFrozen:
      case Fault::ContextLost:  // whoever draws lets it in
      case Fault::Count: break;
      case Fault::CameraLost: faults.lost = true; break;
      case Fault::CameraLate: faults.late = true; break;
      case Fault::CameraDark: faults.dark = true; break;
      case Fault::CamerasSwapped:
        faults.lost = faults.swapped = true;  // plugged in again in settle()
        break;
      case Fault::TriggerSilent: faults.silent = true; break;
      case Fault::TriggerStuck: faults.stuck = true; break;
      case Fault::StoreFull: store_error = Errc::MediaFull; break;
      case Fault::StoreCorrupt: store_error = Errc::StoreCorrupt; break;
      case Fault::StoreLocked: store_error = Errc::Timeout; break;
      case Fault::MediumPulled: stick_faults.pull(); break;
      case Fault::ClockAhead: faults.wall_shift_s = 40 * 86'400; break;
      case Fault::ClockBack: faults.wall_shift_s = -40 * 86'400; break;
      case Fault::TooHot: faults.hot = true; break;
      case Fault::Terminate: ask_to_end(SIGTERM); break;
      case Fault::HangUp: ask_to_end(SIGHUP); break;
      case Fault::CaptureFrozen: ASSERT_TRUE(FrozenThread::freeze("capture")); break;
      case Fault::WorkerStuck:
      case Fault::WorkerFrozen: ASSERT_TRUE(FrozenThread::freeze("worker")); break;
      case Fault::KeeperFrozen: ASSERT_TRUE(FrozenThread::freeze("keeper")); break;
    }
  }
  // What the main loop looks at when it decides to go on.
  static void ask_to_end(int signal) {
    const std::atomic<bool>& asked = interrupted();
    ASSERT_FALSE(asked.load());
    struct sigaction ours {};
    ASSERT_EQ(sigaction(signal, nullptr, &ours), 0);
    ASSERT_EQ(std::raise(signal), 0);
    ASSERT_TRUE(asked.load());
    const_cast<std::atomic<bool>&>(asked).store(false);  // for the next cell
    sigaction(signal, &ours, nullptr);
  }

  void mend() {
    FrozenThread::thaw();
    faults.mend();
    store_error = std::nullopt;
    stick_faults.let_go_on();
    stick_faults.fail(test::FaultyStick::Fault::None);
    stick_faults.plug_in_again();
  }

  static constexpr double kScale = 0.3;
  static inline hal::Device* rig = nullptr;
  static inline ui::Display* display = nullptr;  // none where sanitizers look at leaks
  test::RigFaults faults;
  test::FaultyStick stick_faults{stick()};
  std::atomic<std::optional<Errc>> store_error{};
  std::function<void()> kick;  // with every turn, as the main loop does
  int visitors = 0;
};

}  // namespace relievo::firmware
