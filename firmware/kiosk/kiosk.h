// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Kiosk: the whole appliance behind the whole screen, without the screen's glass: fingers go in, a
// DrawList comes out. Window, device and tests turn the same Kiosk.
//
//   feed(Input) ... turn() -> ui().draw_list()
//
// Thread: main; the jobs have threads of their own and turn() never waits for them.
// Without a calibration it starts, and serves the staff alone until they have made one.
// A stored choice of algorithms that is none is told in the log, and the usual one holds.
// Errors of open(): those of device, store, fonts and words.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "firmware/appliance/appliance.h"
#include "firmware/kiosk/code/code_scanner.h"
#include "firmware/kiosk/invitation_head.h"
#include "firmware/kiosk/stored_visits.h"
#include "firmware/kiosk/take_home.h"
#include "firmware/services/services.h"
#include "firmware/staff/staff_controller.h"
#include "firmware/work/pipeline_stages.h"
#include "hal/speaker.h"
#include "ui/display.h"
#include "ui/render/renderer.h"
#include "ui/speech/narrator.h"
#include "ui/ui.h"

namespace relievo::firmware {

// Voice: the kiosk's speaker. It plays the sounds that tell everybody what has happened, hands on what the
// pages say while somebody wants to hear it, and is silent at once when nobody does. Thread: main, which it
// never holds up. Errors: none; without a speaker it is silent.
class Voice {
 public:
  explicit Voice(std::unique_ptr<hal::Speaker> speaker) : speaker_(std::move(speaker)) {}

  // What there is to hear with.
  void look(ui::ViewState& view);
  // After a frame was made. True: something is being said to the visitor, who is there as long.
  bool turn(ui::Ui& ui, const ui::ViewState& view);

 private:
  void sound(const ui::Ui& ui, const ui::ViewState& view);

  std::unique_ptr<hal::Speaker> speaker_;
  ui::Cues cues_;
  hal::Instant guided_{};
  bool heard_ = false;
};

class Kiosk {
 public:
  static Result<std::unique_ptr<Kiosk>> open(const KioskArgs& args, Services& services);
  Kiosk& operator=(Kiosk&&) = delete;

  void feed(const ui::Input& input);
  // One turn of the main loop: hears what has happened, makes the next frame.
  void turn();
  // Shall the next start say that this run ended early? Where nobody says so: as this start found it.
  void leave_mark(bool stays) { run_mark_->leave(stays); }
  // A visit has ended: what the renderer keeps of it must go.
  bool take_forgotten() { return std::exchange(forgotten_, false); }

  ui::Ui& ui() { return *ui_; }
  const ui::Ui& ui() const { return *ui_; }
  const ui::ViewState& view() const { return view_; }
  hal::Device& device() { return *device_; }
  const Appliance& appliance() const { return *appliance_; }
  const StaffController& staff() const { return *staff_; }

 private:
  Kiosk() = default;
  Result<void> prepare(const KioskArgs& args, Services& services);
  using MaybeCalibration = std::optional<pipeline::StereoCalibration>;  // none: nobody has calibrated yet
  // `given`: that of --calibration.
  Result<MaybeCalibration> find_calibration(const KioskArgs& args, const MaybeCalibration& given,
                                            Services& services);
  // `unknown` gets what is no choice: the usual one holds.
  Result<pipeline::AlgorithmSet> chosen_algorithms(std::vector<std::string>& unknown);
  Result<void> set_up_measuring(const KioskArgs& args, const MaybeCalibration& given, Services& services,
                                std::vector<std::string>& unknown);
  std::unique_ptr<TestCapture> make_test_capture(const KioskArgs& args, Services& services);
  ui::Trouble out_of_order() const;
  void turn_simulated_head();
  void speak();
  void rest_cameras();
  VisitRecord record_of(const ui::VisitRequest& request) const;
  template <typename Work>
  void guarded(const Work& work);
  void hear(const ui::Input& input);
  void turn_once();
  void look();
  void ask(ui::Intent intent);
  void look_up();

  std::unique_ptr<hal::Device> device_;
  std::function<void(double yaw_deg)> turn_head_;  // of the simulated person; empty: a living one does it
  double turned_to_deg_ = 0;
  std::size_t turned_with_ = 0;  // so many sides taken
  hal::Instant turned_at_{};
  std::unique_ptr<storage::Store> store_;
  std::unique_ptr<BootMemory> memory_;
  std::unique_ptr<ThreadPool> pool_;
  std::unique_ptr<PipelineStages> stages_;
  std::unique_ptr<LiveJudge> judge_;
  std::unique_ptr<InvitationHead> invitation_head_;
  std::unique_ptr<ui::Ui> ui_;
  std::function<std::unique_ptr<hal::Speaker>()> open_speaker_;  // until the first turn: behind the display
  std::unique_ptr<Voice> voice_;
  std::unique_ptr<hal::InputSwitch> presence_;  // none: somebody may always be near
  std::uint32_t revision_ = 0;
  WipedText claimed_, quoted_;                 // a name that is asked about, a code that is quoted
  std::unique_ptr<FunctionJob> rest_cameras_;  // ends their streams
  std::unique_ptr<FunctionJob> look_at_cameras_;
  hal::Instant next_camera_look_{};
  ui::Fault exchanged_;  // which cameras are not the calibrated ones; empty: they are
  bool may_tell_known_ = true;
  std::unique_ptr<RunMark> run_mark_;
  std::unique_ptr<MovedFaces> moved_faces_;
  bool restarted_ = false, told_ = false;
  ui::Trouble unwell_ = ui::Trouble::None;  // too hot (Other), or its disk is full
  hal::Instant next_health_look_{};
  std::optional<hal::Instant> short_since_;  // of memory, again and again
  hal::Instant short_last_{};
  storage::WallTime newest_record_{};
  ui::ViewState view_;
  bool forgotten_ = false;
  std::unique_ptr<StoredVisits> visits_;
  std::unique_ptr<Appliance> appliance_;    // its threads use everything above
  std::unique_ptr<StaffController> staff_;  // it and those below use the appliance
  std::unique_ptr<CodeScanner> code_scanner_;
  std::unique_ptr<ReceiptSlip> slip_;
  std::unique_ptr<TakeHome> take_home_;
};

// Glass: the kiosk's pages on a display. It draws what is not on the screen yet: a page that stands still
// leaves the processor to the pipeline. A GL context that the driver loses is made anew and drawn into again:
// no visit ends for it. Thread: main.
class Glass {
 public:
  // The display outlives it. Errors: the renderer's.
  static Result<Glass> on(ui::Display& display);

  // True: there is a new frame, to be shown. Errors: LibraryFailed (the driver gives no context any more).
  Result<bool> draw(Kiosk& kiosk, std::chrono::steady_clock::time_point now, bool wanted);
  ui::Renderer& renderer() { return *renderer_; }

 private:
  Glass(ui::Display& display, std::unique_ptr<ui::Renderer> renderer)
      : display_(&display), renderer_(std::move(renderer)) {}
  static constexpr std::chrono::milliseconds kAtLeastEvery{500};  // a window may have been covered
  ui::Display* display_;
  std::unique_ptr<ui::Renderer> renderer_;
  ui::DrawList drawn_;
  int width_ = 0, height_ = 0;
  std::chrono::steady_clock::time_point drawn_at_{};
};

}  // namespace relievo::firmware
