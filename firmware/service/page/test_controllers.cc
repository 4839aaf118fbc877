// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Behind the pages that look at the device: RecoveryController and StatusController, as it says where they
// stand. Behind the technician's tests: SelfTestController asks memory, store, calibration, disk and cameras;
// TriggerController pulses the line and counts what both cameras saw; LogController shows the lines of the
// log, the newest first. The store is read on the keeper, cameras are asked on the capture thread; the
// pictures of a test are wiped before it is reported. Thread: main.
#include "firmware/service/page_controller.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "firmware/base/list_walk.h"
#include "firmware/base/settings.h"
#include "firmware/kiosk/code/qr_code.h"
#include "firmware/report/report.h"
#include "firmware/service/access.h"
#include "hal/picture_file.h"
#include "storage/cipher/recovery.h"
#include "storage/text.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {
namespace {

using ui::Check;
using ui::CheckState;

constexpr std::chrono::milliseconds kBetweenPulses{100};
constexpr std::chrono::seconds kBetweenLooks{2};

// A visitor without a face, or one who left, is no fault of the device.
bool is_of_the_device(Errc code) {
  return code == Errc::Disconnected || code == Errc::Timeout || code == Errc::OutOfMemory ||
         code == Errc::LibraryFailed || code == Errc::IoFailed || code == Errc::MediaFull ||
         code == Errc::StoreCorrupt || code == Errc::StoreNewer;
}

std::uint64_t missed(const CameraCounts& counts) {
  return counts.late + counts.lost + counts.damaged + counts.too_short + counts.missing;
}

// Behind the page of the recovery sheet: words are drawn when it is opened, and hold when two of them were
// typed; then it shows none again. A sheet that is left before is worth nothing. Thread: main; the store is
// written on the keeper.
class RecoveryController final : public PageController {
 public:
  using PageController::PageController;
  void opened() override {
    closed();
    state_ = ui::SheetState::Asked;
    outcome_ = ui::Outcome::None;
    if (!services().words_due) return;
    words_ = storage::draw_recovery_words();
    each_ = storage::split(words_, ' ');
    to_type_ = storage::words_to_ask();
    typed_ = 0;
    code_ = code_picture(words_);
    ++version_;
  }

  void closed() override {
    each_.clear();
    wipe_text(words_);
    std::ranges::fill(code_.bytes, std::byte{255});
    ++version_;
  }

  void ask(const ui::StaffRequest& request) override {
    if (request.as<ui::OfferWord>() == nullptr || each_.empty() || state_ == ui::SheetState::Saving) return;
    std::string word(request.text());
    std::ranges::transform(word, word.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
    std::erase(word, ' ');
    const bool right = word == each_[to_type_[typed_]];
    wipe_text(word);
    state_ = right ? ui::SheetState::Asked : ui::SheetState::Wrong;
    if (right && ++typed_ == to_type_.size()) keep();
  }

  void show(ui::ServiceView& view) override {
    view_ = {each_, {}, 0, state_};
    if (!each_.empty()) {
      view_.code = {code_.view(), version_};
      view_.asked = int(to_type_[typed_]) + 1;
    }
    view.work.outcome = outcome_;
    view.recovery = services().words_due || state_ == ui::SheetState::Done ? &view_ : nullptr;
  }

 private:
  void keep() {
    state_ = ui::SheetState::Saving;
    typed_ = 0;
    const auto kept = std::make_shared<std::string>(words_);
    services().side_tasks.send(
        JobLane::Keeper,
        [this, kept](JobControl&) {
          const auto done = services().store.keep_recovery_words(*kept);
          wipe_text(*kept);
          return done;
        },
        [this](const std::optional<Error>& error) {
          state_ = error ? ui::SheetState::Failed : ui::SheetState::Done;
          if (error) {
            services().log.fault(*error);
            outcome_ = outcome_of(*error);
            return;
          }
          services().words_due = false;
          closed();
        },
        SideTasks::Whose::Device);
  }

  std::string words_;                     // wiped when the page is left, or they are kept
  std::vector<std::string_view> each_;    // of words_
  std::array<std::size_t, 2> to_type_{};  // which, from 0
  std::size_t typed_ = 0;                 // how many of the two were right
  hal::Picture code_;
  std::uint32_t version_ = 0;
  ui::SheetState state_ = ui::SheetState::Asked;
  ui::Outcome outcome_ = ui::Outcome::None;
  ui::RecoveryView view_;
};

// Behind the staff's first page: the facts its rules judge (ui/screens/menu_page.cc). Disk, sensors
// and calibration are looked at on the keeper, anew every two seconds. Thread: main.
class StatusController final : public PageController {
 public:
  using PageController::PageController;
  void closed() override { looking_ = false; }  // what is under way may be forgotten with the page
  // What was seen before stays until it is seen anew: nothing moves away from a finger.
  void opened() override { next_look_ = {}; }

  void show(ui::ServiceView& view) override {
    PageServices& all = services();
    if (!looking_ && all.device.clock().now() >= next_look_) look();
    view_.camera_away = all.appliance.cameras() != CameraWatch::Well;
    const GrabCounts& counts = all.appliance.grabber().counts();
    view_.pairs = counts.pairs;
    view_.missed = counts.slipped + missed(counts.left) + missed(counts.right);
    view_.clock_jumped = all.retention.clock_jumped();
    view_.store_damaged = false;
    view_.device_faults = 0;
    for (const ui::LogLine& fault : all.log.faults()) {
      if (!fault.code || !is_of_the_device(*fault.code)) continue;
      ++view_.device_faults;
      view_.store_damaged = view_.store_damaged || *fault.code == Errc::StoreCorrupt;
    }
    view.status = &view_;
  }

 private:
  void look() {
    looking_ = true;
    services().side_tasks.ask(
        JobLane::Keeper,
        [&store = services().store, folder = services().folder, revision = services().calibration,
         now = services().device.clock().wall_now()](JobControl&) -> Result<ui::StatusView> {
          ui::StatusView seen{.looked = true};
          for (const Sensor& sensor : read_temperatures("/sys/class/thermal"))
            seen.hottest_c = std::max(seen.hottest_c, sensor.celsius);
          std::error_code none;
          seen.free_mib = double(std::filesystem::space(folder, none).available) / (1 << 20);
          if (none) return Error{Errc::IoFailed, "the disk does not tell how much room it has"};
          RELIEVO_TRY_ASSIGN(const auto calibrations, store.calibrations());
          for (const storage::CalibrationInfo& one : calibrations) {
            if (one.revision == revision)
              seen.calibration_days =
                  int(std::chrono::floor<std::chrono::days>(now - one.created_at).count());
          }
          return seen;
        },
        [this](const Result<ui::StatusView>& seen) {
          looking_ = false;
          next_look_ = services().device.clock().now() + kBetweenLooks;
          if (seen) {
            told_.reset();
            view_ = *seen;
          } else if (std::exchange(told_, seen.error().code) != seen.error().code) {
            services().log.fault(seen.error());
          }
        });
  }

  bool looking_ = false;
  std::optional<Errc> told_;  // why it cannot look
  hal::Instant next_look_{};
  ui::StatusView view_;
};

class SelfTestController final : public PageController {
 public:
  using PageController::PageController;
  void opened() override {
    closed();
    view_ = {};
  }

  // Of what is cancelled nothing is heard: the next visit does not wait for it.
  void closed() override {
    ++visit_;
    running_ = 0;
  }

  void ask(const ui::StaffRequest& request) override {
    if (request.as<ui::BeginSelfTest>() == nullptr || running_ > 0) return;
    view_ = {};
    PageServices& t = services();
    t.log.say(ui::LogEvent::SelfTestBegun);
    begin(Check::Memory, JobLane::Keeper, [&t](JobControl&) -> Result<void> {
      if (peak_rss_bytes() > budget::appliance_bytes(t.device.preferred_mode().pixels()))
        return Error{Errc::OutOfMemory,
                     "the program has used more memory than was planned: see the page of health"};
      return {};
    });
    begin(Check::Store, JobLane::Keeper,
          [&t](JobControl& control) { return t.store.check(control.cancelled); });
    // The one that is measured with, which may be a file's or the simulated rig's and so not the store's
    // active one.
    begin(Check::Calibration, JobLane::Keeper, [&t, revision = t.calibration](JobControl&) -> Result<void> {
      RELIEVO_TRY(revision == 0 ? t.store.active_calibration() : t.store.calibration(revision));
      return {};
    });
    begin(Check::Disk, JobLane::Keeper,
          [&t, least = t.settings.now().of(ui::Setting::LeastRoomMib)](JobControl&) {
            return disk_has_room(t.folder, least);
          });
    begin(Check::Cameras, JobLane::Capture, [&t](JobControl& control) -> Result<void> {
      RELIEVO_TRY(take_and_forget(t.appliance.grabber(), t.appliance.session(), t.device, control.cancelled));
      return {};
    });
  }

  void show(ui::ServiceView& view) override {
    view.work.running = running_ > 0;
    view.self_test = &view_;
  }

 private:
  void begin(Check check, JobLane lane, SideTasks::Work work) {
    const auto at = std::size_t(check);
    view_.states[at] = CheckState::Running;
    ++running_;
    services().side_tasks.send(lane, std::move(work),
                               [this, at, visit = visit_](const std::optional<Error>& error) {
                                 if (error) services().log.fault(*error);
                                 if (visit != visit_) return;
                                 --running_;
                                 view_.states[at] = error ? CheckState::Bad : CheckState::Good;
                                 view_.problems[at] = error ? ui::fault_of(*error) : ui::Fault{};
                               });
  }

  std::uint32_t visit_ = 0;
  int running_ = 0;  // of this visit
  ui::SelfTestView view_;
};

class TriggerController final : public PageController {
 public:
  using PageController::PageController;
  void opened() override {
    closed();
    view_ = {};
  }

  void closed() override {
    ++visit_;
    if (std::exchange(running_, false)) services().side_tasks.stop(task_);
  }

  void ask(const ui::StaffRequest& request) override {
    if (request.as<ui::BeginTriggerTest>() == nullptr || running_) return;
    running_ = true;
    view_ = {};
    const auto seen = std::make_shared<ui::TriggerView>();
    PageServices& t = services();
    task_ = t.side_tasks.send(
        JobLane::Capture,
        [&t, seen](JobControl& control) -> Result<void> {
          const GrabCounts before = t.appliance.grabber().counts();
          std::optional<Error> last;
          for (; seen->pulses < kPulses && !control.cancelled.load(); ++seen->pulses) {
            const hal::Instant asked = t.device.clock().now();
            const auto pair =
                take_and_forget(t.appliance.grabber(), t.appliance.session(), t.device, control.cancelled);
            const std::chrono::duration<double, std::milli> took = t.device.clock().now() - asked;
            if (pair) {
              ++seen->pairs;
              seen->delay_ms = std::max(seen->delay_ms, took.count());
              seen->apart_ms = std::max(seen->apart_ms, std::abs(double(pair->skew_ns)) * 1e-6);
            } else {
              last = pair.error();
            }
            control.progress.done.store(float(seen->pulses + 1) / kPulses);
            std::this_thread::sleep_for(kBetweenPulses);
          }
          const GrabCounts& after = t.appliance.grabber().counts();
          seen->late = after.left.late - before.left.late + after.right.late - before.right.late;
          seen->lost = after.left.lost - before.left.lost + after.right.lost - before.right.lost;
          seen->damaged =
              after.left.damaged - before.left.damaged + after.right.damaged - before.right.damaged;
          return last ? Result<void>(*last) : Result<void>();
        },
        [this, seen, visit = visit_](const std::optional<Error>& error) {
          if (error && error->code != Errc::Cancelled) services().log.fault(*error);
          if (visit != visit_) return;
          running_ = false;
          view_ = *seen;
          view_.ended = true;
        });
  }

  void show(ui::ServiceView& view) override {
    view.work.running = running_;
    view.trigger = &view_;
  }

 private:
  static constexpr int kPulses = 10;

  std::uint32_t visit_ = 0;
  bool running_ = false;  // of this visit
  std::uint32_t task_ = 0;
  ui::TriggerView view_;
};

class LogController final : public PageController {
 public:
  using PageController::PageController;
  void opened() override { walk_.begin_anew(); }
  void ask(const ui::StaffRequest& request) override {
    const auto* asked = request.as<ui::ListRequest>();
    if (asked == nullptr || walk_.ask(*asked) != ListWalk::Ask::Labels) return;
    const std::vector<ui::LogLine> lines = wanted();
    walk_.label_each([&](std::size_t top) { return top < lines.size() ? lines[top].at : std::string(); });
  }

  void show(ui::ServiceView& view) override {
    lines_ = wanted();
    walk_.set_rows(std::int64_t(lines_.size()));
    lines_.erase(lines_.begin() + walk_.end_row(), lines_.end());
    lines_.erase(lines_.begin(), lines_.begin() + walk_.first_row());
    view_ = {lines_, walk_.view()};
    view.log = &view_;
  }

 private:
  static constexpr std::int64_t kShown = 40;  // of a page

  std::vector<ui::LogLine> wanted() const {
    std::vector<ui::LogLine> lines = services().log.entries();
    std::reverse(lines.begin(), lines.end());
    if (walk_.filter() != 0) std::erase_if(lines, [](const ui::LogLine& line) { return !line.fault; });
    return lines;
  }

  ListWalk walk_{kShown};
  std::vector<ui::LogLine> lines_;
  ui::LogView view_;
};

}  // namespace

std::unique_ptr<PageController> device_controller(PageServices& services, ui::StaffPage page) {
  if (page == ui::StaffPage::Recovery) return std::make_unique<RecoveryController>(services);
  if (page == ui::StaffPage::SelfTest) return std::make_unique<SelfTestController>(services);
  if (page == ui::StaffPage::Trigger) return std::make_unique<TriggerController>(services);
  if (page == ui::StaffPage::Log) return std::make_unique<LogController>(services);
  RELIEVO_ASSERT(page == ui::StaffPage::Menu);
  return std::make_unique<StatusController>(services);
}

}  // namespace relievo::firmware
