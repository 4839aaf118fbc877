// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/memory/visitor.h"

#include <thread>

#include "storage/sqlite/sqlite_store.h"
#include "tests/memory/failing_malloc.h"
#include "tests/support/rig_calibration.h"
#include "tests/support/small_rig.h"

namespace relievo::test {

using firmware::Kiosk;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

Result<std::unique_ptr<Visitor>> Visitor::at(const std::filesystem::path& folder) {
  std::unique_ptr<Visitor> visitor(new Visitor(folder));
  RELIEVO_TRY(visitor->open());
  return visitor;
}

Result<void> Visitor::open() {
  RELIEVO_TRY(ui::prepare_languages());
  hal::SimDeviceOptions options;
  options.simulation.rig = small_rig(0.3);
  services_.open_device = [options](std::string_view) { return hal::make_sim_device(options); };
  services_.open_store = [this](const std::filesystem::path& at, bool) {
    return storage::open_sqlite_store(at, clock_, {});
  };
  services_.simulated_calibration = [rig = options.simulation.rig]() -> Result<pipeline::StereoCalibration> {
    return true_calibration(hal::sim::make_rig(rig));
  };
  firmware::KioskArgs args;
  args.store = folder_;
  RELIEVO_TRY_ASSIGN(kiosk_, Kiosk::open(args, services_));
  kiosk_->ui().resize(1280, 800);
  return {};
}

void Visitor::turn() {
  const Counted counted;
  kiosk_->turn();
}

void Visitor::tap(std::string_view id) {
  const ui::Node* node = kiosk_->ui().tree().find(id);
  if (node == nullptr) return;
  const float x = node->rect.x + node->rect.w / 2, y = node->rect.y + node->rect.h / 2;
  const Counted counted;
  kiosk_->feed({ui::Input::Kind::Down, 1, x, y});
  kiosk_->feed({ui::Input::Kind::Up, 1, x, y});
}

void Visitor::answer(ui::Step step) {
  switch (step) {
    case ui::Step::Consent: return tap("agree");
    case ui::Step::Name:
      if (kiosk_->ui().visit().name().empty()) kiosk_->ui().visit().type(std::to_string(visits_));
      return tap("done");
    case ui::Step::Known: return tap("somebody_else");
    case ui::Step::Review: return tap("accept");
    case ui::Step::Thanks:
    case ui::Step::Trouble: return tap("finish");
    case ui::Step::Starting:
    case ui::Step::Declined:
    case ui::Step::Attract:
    case ui::Step::Position:
    case ui::Step::Turn:
    case ui::Step::Working: return;  // the page goes on by itself, or is visit()'s
  }
}

void Visitor::nobody(int turns) {
  const Exempt own;
  for (int t = 0; t < turns; ++t) {
    turn();
    std::this_thread::sleep_for(milliseconds(1));
  }
}

VisitEnd Visitor::visit() {
  const Exempt own;
  ++visits_;
  VisitEnd end;
  bool began = false, refused = false;
  steady_clock::time_point refused_at;
  const auto deadline = steady_clock::now() + std::chrono::minutes(5);
  ui::Step before = ui::Step::Starting;
  while (steady_clock::now() < deadline) {
    turn();
    if (was_refused() && !refused) refused = true, refused_at = steady_clock::now();
    const ui::Step step = kiosk_->ui().visit().step;
    if (step == ui::Step::Thanks) end.stored = true;
    if (step == ui::Step::Trouble && before != step) {
      end.apologised = true;
      if (refused) end.told = std::chrono::duration_cast<milliseconds>(steady_clock::now() - refused_at);
    }
    if (step == ui::Step::Attract && kiosk_->appliance().state() == firmware::State::Idle) {
      if (began) return end;
      tap("start");
      began = kiosk_->ui().visit().step != ui::Step::Attract;
    }
    began = began || step == ui::Step::Consent;
    answer(step);
    before = step;
    std::this_thread::sleep_for(milliseconds(1));
  }
  end.stuck = true;
  return end;
}

}  // namespace relievo::test
