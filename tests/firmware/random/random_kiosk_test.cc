// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The whole kiosk before the simulated rig under random hands, times and faults: fingers on buttons and
// anywhere, keypad, PIN pad, codes held before the cameras, sticks, dates, and every fault of the table that
// the program itself outlives. Whatever has happened: left alone and mended it invites again, and then
// nothing of the visitors before is in memory or in a file.
#include <deque>
#include <set>

#include "firmware/kiosk/kiosk.h"
#include "tests/firmware/faults/fault_hands.h"
#include "tests/firmware/random/random_events.h"
#include "tests/support/memory_search.h"
#include "tests/support/printed_code.h"

namespace relievo::firmware {
namespace {

using ui::ActionKind;
using Kind = ui::Input::Kind;

class RandomKiosk : public FaultHands {
 protected:
  enum class Hand : std::uint8_t { Visitor, Staff, Child };  // does as asked; knows the PINs; anything

  RandomKiosk() {
    const hal::Picture code = test::printed_code("Held 7351");
    const hal::CaptureMode mode = rig->preferred_mode();
    sheet.bytes.assign(
        std::size_t{3} * static_cast<std::size_t>(mode.width_px) * static_cast<std::size_t>(mode.height_px),
        std::byte{255});
    for (int y = 0; y < std::min(code.height_px, mode.height_px); ++y)
      for (int x = 0; x < std::min(code.width_px, mode.width_px); ++x)
        for (int c = 0; c < 3; ++c)
          sheet.bytes[static_cast<std::size_t>(3 * (y * mode.width_px + x) + c)] =
              code.bytes[static_cast<std::size_t>(y * code.width_px + x)];
  }
  void begin_glass() {
    if (display == nullptr) return;
    auto on_display = Glass::on(*display);
    ASSERT_TRUE(on_display);
    glass = std::make_unique<Glass>(std::move(*on_display));
  }

  // ---- what hands do
  void down_up(float x, float y) {
    kiosk->feed({Kind::Down, 7, x, y});
    if (events.one_in(4)) kiosk->feed({Kind::Move, 7, x + static_cast<float>(events.of(9) - 4), y});
    kiosk->feed({Kind::Up, 7, x, y});
  }
  bool touch(std::string_view id) {
    const ui::Node* node = find(id);
    if (node == nullptr) return false;
    events.note("touch " + std::string(id));
    if (kiosk->ui().has_just_come(kiosk->view().now) && !events.one_in(4)) {  // few are so quick
      faults.ahead_s += 1;
      turn();
      node = find(id);
      if (node == nullptr) return false;
    }
    down_up(node->rect.x + node->rect.w / 2, node->rect.y + node->rect.h / 2);
    return true;
  }
  void touch_any_button() {
    std::vector<const ui::Node*> buttons;
    for (const ui::Node& node : kiosk->ui().tree().nodes())
      if (node.action.kind != ActionKind::None && kiosk->ui().tree().is_on_top(node))
        buttons.push_back(&node);
    if (buttons.empty()) return touch_anywhere();
    const ui::Node& node = *buttons[static_cast<std::size_t>(events.of(static_cast<int>(buttons.size())))];
    touch(std::string(node.id));
  }
  void touch_anywhere() {
    events.note("touch anywhere");
    down_up(static_cast<float>(events.of(1280)), static_cast<float>(events.of(800)));
  }
  void drag() {
    events.note("drag");
    const auto place = [this](Kind kind, std::int64_t whose) {
      kiosk->feed({kind, whose, static_cast<float>(events.of(1280)), static_cast<float>(events.of(800))});
    };
    const bool two = events.one_in(3);
    place(Kind::Down, 1);
    if (two) place(Kind::Down, 2);
    for (int i = events.of(6); i > 0; --i) place(Kind::Move, two && events.one_in(2) ? 2 : 1);
    if (two) place(Kind::Up, 2);
    if (!events.one_in(10)) place(Kind::Up, 1);  // else it is never told to have gone
  }
  void press_a_key() {
    ui::Input input;
    input.kind = static_cast<Kind>(events.of(static_cast<int>(Kind::Quit)));
    if (input.kind <= Kind::Up) return;
    events.note("key " + std::to_string(static_cast<int>(input.kind)));
    if (input.kind == Kind::Letter) input.letter = {static_cast<char>('a' + events.of(26))};
    // As a keypad has them (ui/platform/): its 0 is another key, which types where digits are asked for.
    if (input.kind == Kind::Digit) input.letter = {static_cast<char>('1' + events.of(9))};
    if (input.kind == Kind::Repeat) input.letter = {'0'};
    kiosk->feed(input);
  }
  void hold_the_lock() {
    const ui::Node* node = find("staff");
    if (node == nullptr) return;
    events.note("hold the lock");
    const float x = node->rect.x + node->rect.w / 2, y = node->rect.y + node->rect.h / 2;
    kiosk->feed({Kind::Down, 7, x, y});
    turn();
    faults.ahead_s += ui::kHold.count() + 1;
    turn();
    kiosk->feed({Kind::Up, 7, x, y});
  }
  void enter_pin() {
    events.note("a PIN");
    for (const char digit : events.one_in(2) ? std::string_view("4711") : std::string_view("80526"))
      if (!touch("digit " + std::string(1, digit))) return;
    turn();
    if (touch("pin done")) (void)turns_until([this] { return !kiosk->view().service->access.checking; });
  }
  // A name that nobody else has, to be looked for when its visitor has gone.
  void type_a_name() {
    events.note("a name");
    std::string name = "Q";
    for (int i = 0; i < 13; ++i) name += static_cast<char>('a' + events.of(26));
    for (const char letter : name) {
      ui::Input input{Kind::Letter, 0, 0, 0, {letter}};
      kiosk->feed(input);
    }
    turn();
    if (kiosk->ui().visit().name() == name) left_behind.emplace_back("a name", name);
    explicit_bzero(name.data(), name.size());
  }
  void do_as_asked() {
    const ui::Visit& visit = kiosk->ui().visit();
    if (visit.overlay != ui::Overlay::None || kiosk->ui().service().open) return touch_any_button();
    switch (visit.step) {
      case ui::Step::Attract: touch("start"); return;
      case ui::Step::Consent:
        if (!touch("agree")) touch_any_button();
        return;
      case ui::Step::Name:
        if (visit.name().empty()) type_a_name();
        touch("done");
        return;
      case ui::Step::Known: touch("somebody_else"); return;
      case ui::Step::Position:
        if (events.one_in(6)) touch("shoot");
        return wait_a_little();
      case ui::Step::Turn:
        if (events.one_in(6)) touch("enough");
        return wait_a_little();
      case ui::Step::Review:
        remember_the_model();
        if (events.one_in(4)) touch(events.one_in(8) ? "retake" : "accept");
        else touch_any_button();
        return;
      case ui::Step::Thanks:
      case ui::Step::Trouble:
        if (events.one_in(3)) touch("finish");
        return;
      case ui::Step::Working: return wait_a_little();
      case ui::Step::Starting:
      case ui::Step::Declined:
      case ui::Step::Count: return;
    }
  }
  void wait_a_little() {
    for (int t = 0; t < 20; ++t) turn();
  }
  bool turns_until(const std::function<bool()>& reached) {
    for (int t = 0; t < 3'000 && !reached(); ++t) turn();
    return reached();
  }

  // ---- what the world does
  void let_in_any() {
    static constexpr std::array kOutlived{Fault::CameraLost,     Fault::CameraLate,    Fault::CameraDark,
                                          Fault::CamerasSwapped, Fault::TriggerSilent, Fault::TriggerStuck,
                                          Fault::StoreFull,      Fault::StoreCorrupt,  Fault::StoreLocked,
                                          Fault::MediumPulled,   Fault::ClockAhead,    Fault::ClockBack,
                                          Fault::TooHot,         Fault::HangUp,        Fault::Terminate};
    const Fault fault = events.any(kOutlived);
    events.note("fault " + std::to_string(static_cast<int>(fault)));
    if (fault == Fault::MediumPulled && !std::filesystem::exists(stick())) return;  // it is out already
    let_in(fault);
  }
  void world() {
    switch (events.of(5)) {
      case 0: return let_in_any();
      case 1: events.note("mended"); return mend();
      case 2:
        events.note("a code is held, or no more");
        return faults.sheet.store(faults.sheet.load() == nullptr && events.one_in(2) ? &sheet : nullptr);
      default:
        const int jump_s = events.one_in(8) ? events.of(700) : events.of(10);
        events.note("time " + std::to_string(jump_s));
        faults.ahead_s += jump_s;
    }
  }

  // ---- what must hold
  void remember_the_model() {
    const pipeline::FaceModel* model = kiosk->view().model;
    if (model == nullptr || model->mesh.vertices_mm.size() < 100) return;
    const auto bytes = std::as_bytes(std::span(model->mesh.vertices_mm));
    left_behind.emplace_back(kModel, bytes.subspan(bytes.size() / 2 / 12 * 12, 48));
  }
  void remember_the_mark() {
    std::vector<std::byte> mark(test::RigFaults::kMarkBytes);
    test::RigFaults::put_mark(faults.mark.load(), mark.data());
    left_behind.emplace_back("a photograph's pixels", mark);
    explicit_bzero(mark.data(), mark.size());
  }
  void remember() {
    if (!kiosk->view().receipt.empty() && kiosk->view().receipt != receipt) {
      receipt = kiosk->view().receipt;
      left_behind.emplace_back("an erasure code", receipt);
      explicit_bzero(receipt.data(), receipt.size());
    }
    while (left_behind.size() > 60) left_behind.pop_front();
  }
  void is_well() {
    const State now_in = state();
    visited.insert(now_in);
    if (now_in == State::Idle || now_in == State::Fault || now_in == State::SelfTest) {
      EXPECT_FALSE(kiosk->appliance().session().is_open()) << name_of(now_in);
      EXPECT_EQ(kiosk->appliance().session().subject(), "");
      EXPECT_EQ(kiosk->view().model, nullptr);
    }
    const bool alone = kiosk->ui().visit().step == ui::Step::Attract && !kiosk->ui().service().open;
    if (alone) {
      EXPECT_EQ(kiosk->ui().visit().name(), "");
    }
    remember();
  }
  // Nobody touches anything any more: within the time that its limits add up to it invites again.
  void comes_to_rest() {
    events.note("left alone");
    const auto begun = std::chrono::steady_clock::now() + std::chrono::seconds(faults.ahead_s.load());
    constexpr auto kLongest = budget::kExportLimit + budget::kStaffLimit + budget::kTurnLimit +
                              budget::kFuseLimit + 5 * budget::kStageLimit + milliseconds(300'000);
    kiosk->feed({Kind::Up, 1, 0, 0});
    mend();
    faults.sheet = nullptr;
    const auto rests = [this] {
      return state() == State::Idle && kiosk->ui().visit().step == ui::Step::Attract &&
             !kiosk->ui().service().open;
    };
    const auto waited = [&] {
      return std::chrono::steady_clock::now() + std::chrono::seconds(faults.ahead_s.load()) - begun;
    };
    while (!rests() && waited() < kLongest) {
      faults.ahead_s += 1;
      turn();
      is_well();
    }
    ASSERT_TRUE(rests()) << "no way back: " << name_of(state()) << " "
                         << ui::info_of(kiosk->ui().visit().step).name
                         << (kiosk->ui().service().open ? ", the staff's side is open" : "");
    for (int t = 0; t < 60; ++t) turn();  // what runs beside ends, the cameras go to rest
    draw();
    draw();
  }
  void draw() {
    if (glass == nullptr) return;
    ASSERT_TRUE(glass->draw(*kiosk, std::chrono::steady_clock::now(), true).has_value());
  }
  void nothing_is_left() {
    const std::vector<test::Canary> canaries(left_behind.begin(), left_behind.end());
    ++searches;
    for (const std::string& line : search.find(canaries)) ADD_FAILURE() << line;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path())) {
      if (!entry.is_regular_file() || entry.path().string().starts_with(stick().string())) continue;
      const std::string text = test::read_text(entry.path());
      std::array<std::byte, 256> room{};
      for (const test::Canary& canary : canaries) {
        canary.show_in(room.data());
        EXPECT_EQ(memmem(text.data(), text.size(), room.data(), canary.size()), nullptr)
            << canary.what() << " in " << entry.path();
      }
      explicit_bzero(room.data(), room.size());
    }
    looked_for += canaries.size();
    left_behind.clear();
  }
  // The search finds what is there: who stands before the kiosk is in its memory.
  bool is_there() {
    remember_the_model();
    if (left_behind.empty() || left_behind.back().what() != kModel) return false;
    EXPECT_FALSE(search.find(std::array{left_behind.back()}).empty()) << "the search finds nobody";
    return true;
  }

  void event() {
    if (--of_this_hand <= 0) {
      hand = events.any(std::array{Hand::Visitor, Hand::Visitor, Hand::Staff, Hand::Child});
      of_this_hand = 20 + events.of(100);
    }
    const int kind = events.of(100);
    if (kind < 4) return world();
    if (kind < 50 && hand == Hand::Visitor) return do_as_asked();
    if (kind < 30 && hand == Hand::Staff) {
      if (!kiosk->ui().service().open) return hold_the_lock();
      if (find("pin done") != nullptr) return enter_pin();
    }
    if (kind < 80) touch_any_button();
    else if (kind < 86) touch_anywhere();
    else if (kind < 90) drag();
    else press_a_key();
  }

  static constexpr const char* kModel = "a model's points";
  RandomEvents events{600};
  hal::Picture sheet;
  std::unique_ptr<Glass> glass;
  test::MemorySearch search;
  std::deque<test::Canary> left_behind;
  std::string receipt;
  std::set<State> visited;
  Hand hand = Hand::Visitor;
  int of_this_hand = 0;
  std::size_t looked_for = 0, searches = 0;
};

TEST_F(RandomKiosk, InvitesAgainWhateverHappensAndForgets) {
  begin_glass();
  start();
  first_start();
  tap("sign out");
  faults.mark = events.seed() + 1;
  int until_rest = 200;
  bool shown = false;
  while (events.go_on()) {
    event();
    for (int t = 1 + events.of(2); t > 0; --t) turn();
    is_well();
    if (events.one_in(10)) draw();
    if (!shown && state() == State::Review) shown = is_there();
    if (--until_rest > 0 && events.step() != events.events()) continue;
    until_rest = 100 + events.of(300);
    remember_the_mark();
    comes_to_rest();
    if (HasFatalFailure()) break;
    nothing_is_left();
    ++faults.mark;
  }
  mend();
  std::printf(
      "%lu events from seed %lu: in %zu of %zu states, %zu canaries looked for in %zu searches of %.0f MiB\n",
      events.step(), events.seed(), visited.size(), kStates, looked_for, searches,
      static_cast<double>(search.searched_bytes()) / (1 << 20));
  kiosk.reset();
  auto store = storage::open_sqlite_store(args.store, clock, {});
  ASSERT_TRUE(store);
  EXPECT_TRUE((*store)->check());
}

}  // namespace
}  // namespace relievo::firmware
