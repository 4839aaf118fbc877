// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The manners of a program that works hard while somebody waits: how soon each stage hears that it is to
// stop, how long the page stands still while a face is reconstructed on all cores, how soon a button answers
// a finger meanwhile. At 1920 x 1200, pages of 1280 x 800 drawn by the GL driver there is.
//
// From a finger to the pressed button: a finger comes down at a random moment since the page last looked for
// one, goes through SDL's queue, and the time ends when the GL has drawn the frame that shows the button
// pressed (its first pixel can be read; a driver's threads may be at it long after the calls have returned).
// Its parts: waiting for the page to look, making the page, drawing it. A panel's own time is not in it.
//
//   SDL_VIDEODRIVER=offscreen manners_bench [VISITS [CANCELS]]     default: 10 visits, 20 cancels of each
//   stage
#include <time.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>
#include <thread>

#include "firmware/base/boot_memory.h"
#include "firmware/base/process_memory.h"
#include "firmware/kiosk/kiosk.h"
#include "firmware/work/jobs.h"
#include "hal/clock.h"
#include "hal/sim/device.h"
#include "storage/sqlite/sqlite_store.h"
#include "tests/support/rig_calibration.h"
#include "tests/support/temporary_folder.h"
#include "ui/platform/sdl_display.h"

namespace relievo {
namespace {

using namespace firmware;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

double ms_since(steady_clock::time_point begin) {
  return 1e3 * std::chrono::duration<double>(steady_clock::now() - begin).count();
}

double processor_ms() {
  timespec at{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &at);
  return 1e3 * static_cast<double>(at.tv_sec) + 1e-6 * static_cast<double>(at.tv_nsec);
}

class Times {
 public:
  void add(double ms) { all_.push_back(ms); }
  // False: over the bar. `share`: of the times that must be within it.
  bool say(const char* what, double bar_ms, double share = 1) {
    if (all_.empty()) return std::printf("%-44s never\n", what), false;
    std::sort(all_.begin(), all_.end());
    const auto at = [this](double s) {
      return all_[static_cast<std::size_t>(s * static_cast<double>(all_.size() - 1))];
    };
    const bool good = at(share) <= bar_ms;
    std::printf("%-44s %5zu times, median %6.1f, 95 %% %6.1f, worst %6.1f ms   bar %.0f at %.0f %%%s\n", what,
                all_.size(), at(0.5), at(0.95), all_.back(), bar_ms, 100 * share, good ? "" : "   OVER");
    std::fflush(stdout);
    return good;
  }

 private:
  std::vector<double> all_;
};

bool failed(const Error& error) {
  return std::printf("%s: %s\n", error.where().data(), error.what.view().data()), false;
}

// Each stage is told to stop at a random moment, until it has been so often; then it may run to its end.
bool stop_stages(hal::Device& device, const pipeline::StereoCalibration& calibration, int cancels) {
  BootMemory memory;
  ThreadPool pool(pool_size());
  EnrolmentSession session(memory);
  PipelineStages stages{pipeline::AlgorithmSet{}};
  auto pipeline = pipeline::Pipeline::make({}, calibration);
  if (!pipeline) return failed(pipeline.error());
  stages.replace(std::move(*pipeline));
  StageJob job(stages, session, pool, device.clock());
  JobReports reports;
  JobThread worker(reports, "worker");
  StereoGrabber grabber(device);
  const std::atomic<bool> never{false};
  if (!session.open("Ada") || !grabber.start(device.preferred_mode())) return false;
  const auto frame = grabber.grab(session.slot(), never);
  if (!frame) return failed(frame.error());
  session.took(*frame);
  std::mt19937 random(1);
  bool good = true;
  for (const State stage : kStages) {
    job.choose(stage);
    const auto run = [&] {
      const auto begin = steady_clock::now();
      if (!worker.start(job)) std::abort();
      worker.wait_until_idle();
      return ms_since(begin);
    };
    const double whole_ms = run();
    if (const auto report = reports.take_for(milliseconds(100)); !report || report->error)
      return failed(report ? *report->error : Error{Errc::Timeout, "no report"});
    Times heard, worked;
    for (int i = 0; i < cancels; ++i) {
      session.rework(stage);
      if (!worker.start(job)) std::abort();
      const double wait_ms = std::uniform_real_distribution<double>(0, whole_ms)(random);
      std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(wait_ms));
      const auto told = steady_clock::now();
      const double used_ms = processor_ms();
      worker.cancel();
      worker.wait_until_idle();
      heard.add(ms_since(told));
      worked.add(processor_ms() - used_ms);
      (void)reports.take_for(milliseconds(100));
    }
    (void)heard.say((std::string(name_of(stage)) + " stops").c_str(), 100);
    // Of all cores together: what it would take at most with nothing else on the machine.
    good = worked.say("   of the processor for that", 100) && good;
    session.rework(stage);
    (void)run();
    if (const auto report = reports.take_for(milliseconds(100)); !report || report->error)
      return failed(report ? *report->error : Error{Errc::Timeout, "no report"});
  }
  return good;
}

class Watched {
 public:
  Watched(Kiosk& kiosk, ui::Display& display, Glass& glass)
      : kiosk_(kiosk), display_(display), glass_(glass) {}
  bool visit(int number) {
    bool began = false;
    last_.reset();
    const auto begun = steady_clock::now();
    while (ms_since(begun) < 300'000) {
      const auto begin = steady_clock::now();
      const ui::Step step = kiosk_.ui().visit().step;
      if (began && step == ui::Step::Attract) return true;
      answer(step, number);
      began = began || step == ui::Step::Position;
      press();
      while (const auto input = display_.poll()) kiosk_.feed(*input);
      const auto fed = steady_clock::now();
      kiosk_.turn();
      const auto made = steady_clock::now();
      const auto drawn = glass_.draw(kiosk_, begin, false);
      if (!drawn) return false;
      if (*drawn) display_.show();
      if (pressed_at_) {
        if (!*drawn) return std::puts("a pressed button was not drawn"), false;
        const auto ms = [](auto a, auto b) {
          return std::chrono::duration<double, std::milli>(b - a).count();
        };
        waits_.add(ms(*pressed_at_, fed));
        makes_.add(ms(fed, made));
        look(begin);
        draws_.add(ms_since(made));
      } else {
        look(begin);
      }
      std::this_thread::sleep_until(begin + milliseconds(16));
    }
    return false;
  }
  bool say() {
    const bool gaps = gaps_.say("between two frames while a face is made", 50);
    const bool answers = answers_.say("from a finger to the pressed button", 100, 0.95);
    (void)waits_.say("   until the page looks", 100, 0.95);
    (void)makes_.say("   the page is made", 100, 0.95);
    (void)draws_.say("   it is drawn", 100, 0.95);
    for (auto& [state, times] : by_state_)
      (void)times.say((std::string("   in ") + std::string(name_of(state))).c_str(), 100, 0.95);
    return answers && gaps;
  }

 private:
  bool works() const {
    const State state = kiosk_.appliance().state();
    return is_stage(state) || state == State::Turn || state == State::Fuse;
  }
  void tap(std::string_view id) {
    const ui::Node* node = kiosk_.ui().tree().find(id);
    if (node == nullptr || pressed_at_) return;
    const float x = node->rect.x + node->rect.w / 2, y = node->rect.y + node->rect.h / 2;
    kiosk_.feed({ui::Input::Kind::Down, 1, x, y});
    kiosk_.feed({ui::Input::Kind::Up, 1, x, y});
  }
  void answer(ui::Step step, int number) {
    if (step == ui::Step::Attract && kiosk_.appliance().state() == State::Idle) tap("start");
    if (step == ui::Step::Consent) tap("agree");
    if (step == ui::Step::Name) {
      if (kiosk_.ui().visit().name().empty()) kiosk_.ui().visit().type("Visitor " + std::to_string(number));
      tap("done");
    }
    if (step == ui::Step::Turn && presses_ % 4 == 3) tap("enough");
    if (step == ui::Step::Review) tap("accept");
    if (step == ui::Step::Thanks || step == ui::Step::Trouble) tap("finish");
  }
  // On any button while a face is made; it slides off again, so that nothing is done.
  void press() {
    if (pressed_at_ || !works() || ++frames_ % 12 != 0) return;
    for (const ui::Node& node : kiosk_.ui().tree().nodes()) {
      if (node.role != ui::Role::Button || node.action.kind == ui::ActionKind::None) continue;
      const auto now = steady_clock::now();
      const double since = last_ ? std::chrono::duration<double>(now - *last_).count() : 0;
      const double ago = std::uniform_real_distribution<double>(0, since)(random_);
      pressed_at_ =
          now - std::chrono::duration_cast<steady_clock::duration>(std::chrono::duration<double>(ago));
      ++presses_;
      display_.push({ui::Input::Kind::Down, 2, node.rect.x + node.rect.w / 2, node.rect.y + node.rect.h / 2});
      return;
    }
  }
  // What is drawn is on the screen when it can be read back.
  void look(steady_clock::time_point begin) {
    if (pressed_at_) {
      std::array<std::uint8_t, 3> pixel{};
      glass_.renderer().read_back(pixel, 1, 1);
      answers_.add(ms_since(*pressed_at_));
      by_state_[kiosk_.appliance().state()].add(ms_since(*pressed_at_));
      kiosk_.feed({ui::Input::Kind::Move, 2, 2, 2});
      kiosk_.feed({ui::Input::Kind::Up, 2, 2, 2});
      pressed_at_.reset();
      last_.reset();
      return;
    }
    if (last_ && works()) gaps_.add(std::chrono::duration<double, std::milli>(begin - *last_).count());
    last_ = begin;
  }

  Kiosk& kiosk_;
  ui::Display& display_;
  Glass& glass_;
  std::optional<steady_clock::time_point> last_, pressed_at_;
  std::mt19937 random_{1};
  long frames_ = 0, presses_ = 0;
  Times gaps_, answers_, waits_, makes_, draws_;
  std::map<State, Times> by_state_;
};

int bench(int visits, int cancels) {
  if (!take_heap(budget::kHeapBytes)) return std::puts("no heap"), 1;
  const hal::SimDeviceOptions options;
  const test::TemporaryFolder folder;
  const hal::MonotonicClock clock;
  Console console;
  Services services{.console = console, .clock = clock};
  services.open_device = [&](std::string_view) { return hal::make_sim_device(options); };
  services.open_store = [&](const std::filesystem::path& at, bool) {
    return storage::open_sqlite_store(at, clock, {});
  };
  const auto calibration = test::true_calibration(hal::sim::make_rig(options.simulation.rig));
  services.simulated_calibration = [&]() -> Result<pipeline::StereoCalibration> { return calibration; };
  KioskArgs args;
  args.store = folder.path() / "store";
  bool good = true;
  if (cancels > 0) {
    auto device = hal::make_sim_device(options);
    good = device && stop_stages(**device, calibration, cancels);
  }
  if (visits == 0) return good ? 0 : 1;
  if (!ui::prepare_languages()) return 1;
  auto kiosk = Kiosk::open(args, services);
  auto display = ui::open_sdl_display({1280, 800});
  if (!kiosk || !display) return std::puts("no kiosk or no display"), 1;
  (*kiosk)->ui().resize(1280, 800);
  auto glass = Glass::on(**display);
  if (!glass) return std::puts("nothing draws"), 1;
  Watched watched(**kiosk, **display, *glass);
  for (int number = 1; number <= visits; ++number)
    if (!watched.visit(number)) return std::printf("visit %d did not end\n", number), 1;
  return watched.say() && good ? 0 : 1;
}

}  // namespace
}  // namespace relievo

int main(int argc, char** argv) {
  return relievo::bench(argc > 1 ? std::atoi(argv[1]) : 10, argc > 2 ? std::atoi(argv[2]) : 20);
}
