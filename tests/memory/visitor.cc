// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/memory/visitor.h"

#include <array>
#include <thread>
#include <utility>

#include "storage/sqlite/sqlite_store.h"
#include "tests/memory/failing_malloc.h"
namespace relievo::test {

using firmware::Kiosk;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

namespace {

constexpr std::array kLeaves{ui::Step::Position, ui::Step::Working, ui::Step::Review};
constexpr std::string_view kTechnician = "4711", kOperator = "80526";

}  // namespace

Result<std::unique_ptr<Visitor>> Visitor::at(const std::filesystem::path& folder, std::size_t people) {
  std::unique_ptr<Visitor> visitor(new Visitor(folder, people));
  RELIEVO_TRY(visitor->open());
  return visitor;
}

Result<void> Visitor::open() {
  opened_ = steady_clock::now();
  RELIEVO_TRY(ui::prepare_languages());
  services_.open_device = [this](std::string_view) -> Result<std::unique_ptr<hal::Device>> {
    return people_.device();
  };
  services_.open_store = [this](const std::filesystem::path& at, bool) {
    return storage::open_sqlite_store(at, clock_, {});
  };
  services_.turn_head = [this](hal::Device&, double yaw_deg) {
    if (turns_) people_.turn(yaw_deg);  // who does not keeps still until "enough" can be touched
  };
  services_.simulated_calibration = [this]() -> Result<pipeline::StereoCalibration> {
    return people_.calibration();
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

void Visitor::press(ui::Input::Kind key) {
  {
    const Counted counted;
    kiosk_->feed({key});
  }
  turn();
}

void Visitor::answer(ui::Step step, Manner manner) {
  if (manner == Manner::Leaves && step == kLeaves[std::size_t(visits_) % kLeaves.size()])
    return tap(kiosk_->ui().visit().overlay == ui::Overlay::Leave ? "answer_quiet" : "leave");
  switch (step) {
    case ui::Step::Consent: return tap(manner == Manner::Declines ? "decline" : "agree");
    case ui::Step::Name:
      if (kiosk_->ui().visit().name().empty()) kiosk_->ui().visit().type(std::to_string(visits_));
      return tap("done");
    case ui::Step::Known: return tap("somebody_else");
    case ui::Step::Position: return people_.plug(manner != Manner::Unlucky);
    case ui::Step::Turn: return manner == Manner::Turns ? void() : tap("enough");
    case ui::Step::Review:
      return tap(manner == Manner::Retakes && !std::exchange(again_, true) ? "retake" : "accept");
    case ui::Step::Thanks: return tap("finish");
    case ui::Step::Trouble: people_.plug(true); return tap("finish");
    // One in ten walks away: the page goes by itself, after half a minute.
    case ui::Step::Declined: return visits_ % 50 == 2 ? void() : tap("finish");
    case ui::Step::Starting:
    case ui::Step::Attract:
    case ui::Step::Working:
    case ui::Step::Count: return;  // the page goes on by itself, or is visit()'s
  }
}

void Visitor::nobody(int turns) {
  const Exempt own;
  for (int t = 0; t < turns; ++t) {
    turn();
    std::this_thread::sleep_for(milliseconds(1));
  }
}

bool Visitor::until(const std::function<bool()>& reached) {
  const auto deadline = steady_clock::now() + std::chrono::minutes(5);
  while (!reached() && steady_clock::now() < deadline) {
    turn();
    std::this_thread::sleep_for(milliseconds(1));
  }
  return reached();
}

milliseconds Visitor::until_invited() {
  const Exempt own;
  until([this] { return kiosk_->ui().visit().step == ui::Step::Attract; });
  return std::chrono::duration_cast<milliseconds>(steady_clock::now() - opened_);
}

// By the keypad, which needs not hold: on until the lock has the focus.
bool Visitor::knock() {
  for (int key = 0; kiosk_->ui().focus() != "staff"; ++key) {
    if (key == 100) return false;
    press(ui::Input::Kind::Next);
  }
  press(ui::Input::Kind::Activate);
  return kiosk_->ui().service().open;
}

void Visitor::type_pin(std::string_view pin) {
  for (const char digit : pin) tap("digit " + std::string(1, digit)), turn();
  tap("pin done"), turn();
  until([this] { return !kiosk_->view().service->access.checking; });
}

bool Visitor::page(ui::StaffPage wanted) {
  return until([&] { return kiosk_->ui().service().page == wanted; });
}

bool Visitor::first_start() {
  const Exempt own;
  until_invited();
  if (!knock()) return false;
  for (const char* button : {"go on", "clock right", "consent right"}) tap(button), turn();
  for (const std::string_view pin : {kTechnician, kTechnician, kOperator, kOperator}) type_pin(pin);
  return page(ui::StaffPage::Pin) && staff_round();
}

bool Visitor::staff_round() {
  const Exempt own;
  for (const bool operates : {true, false}) {
    if (!kiosk_->ui().service().open && !knock()) return false;
    type_pin(operates ? kOperator : kTechnician);
    if (!page(ui::StaffPage::Menu)) return false;
    for (const char* button : {"open records", "open statistics", "open health", "open log"}) {
      if (kiosk_->ui().tree().find(button) == nullptr) continue;
      tap(button);
      until([this] { return kiosk_->ui().service().page != ui::StaffPage::Menu; });
      nobody(200);
      tap("back");
      if (!page(ui::StaffPage::Menu)) return false;
    }
    tap("sign out");
    if (!until([this] { return kiosk_->appliance().state() == firmware::State::Idle; })) return false;
  }
  return true;
}

VisitEnd Visitor::visit(std::size_t person, Manner manner) {
  const Exempt own;
  ++visits_;
  again_ = false;
  turns_ = manner == Manner::Turns;
  people_.shows(person);
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
    answer(step, manner);
    before = step;
    std::this_thread::sleep_for(milliseconds(1));
  }
  end.stuck = true;
  return end;
}

}  // namespace relievo::test
