// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Machine: the present state, and how long it may last. It knows the table and the clock, and does
// nothing else: what a change of state sets in motion, the Appliance decides.
// Thread: main. Errors: none; an event a state does not listen to changes nothing.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "hal/clock.h"

namespace relievo::firmware {

// The whole life of the appliance, as one table.
//
//   SelfTest -> Idle -> Position -> Capture -> Match -> Reconstruct -> Mesh -> Texture -> Assemble
//                                   Capture -> Turn -> Fuse
//   Assemble | Fuse -> Review -> Store -> Idle
//   Review -> Capture | Position
//   Idle -> Staff -> Calibrate | Export
//
// A command has no Position: it goes from Idle to Capture at once, and from a failure to Capture again.
// A person at the screen finds their place first, with a live picture, and goes back there for advice. Who
// may turn the head after the frontal picture comes to Turn: there the stages of that picture, and of each
// side as it is taken, run beside the cameras; Fuse is what is left of them, and the head of all.
//   Fault is entered when the machine cannot; it tests itself again.
//
// The compiler proves the table: one event leads one way, every state can be reached, every state
// leads back to Idle, and every state answers Cancel, Timeout and Failed or says why it is deaf.

enum class State : std::uint8_t {
  SelfTest,
  Idle,
  Calibrate,
  Position,
  Capture,
  Turn,
  Match,
  Reconstruct,
  Mesh,
  Texture,
  Assemble,
  Fuse,
  Review,
  Store,
  Export,
  Staff,  // operators and technicians
  Fault,
  Count
};

// The stages of the pipeline (pipeline/pipeline.h), in their order.
inline constexpr std::array kStages{State::Match, State::Reconstruct, State::Mesh, State::Texture,
                                    State::Assemble};
constexpr bool is_stage(State state) { return state >= kStages.front() && state <= kStages.back(); }
constexpr std::size_t number_of(State stage) { return std::size_t(stage) - std::size_t(kStages.front()); }

enum class Event : std::uint8_t {
  Passed,       // the self test found everything in place
  Failed,       // the machine cannot: a camera gone, a library at its end
  PoseAsked,    // a person wants to see where to stand
  Begin,        // take the picture
  Triggered,    // both pictures are here
  TurnAsked,    // they are, and now the sides
  StageDone,    // the job of the present state is done
  StageFailed,  // it could not, and another try may help
  AdviceGiven,  // it could not, and the person in front of the screen is told why
  Accept,
  Retake,  // the person's answer to the model
  Cancel,
  Timeout,  // the state lasted longer than budget.h allows
  StaffIn,
  StaffOut,
  CalibrateAsked,
  ExportAsked,
  Count
};

struct Transition {
  State from;
  Event event;
  State to;
};

// What a state does that no other does alike.
inline constexpr std::array kOwnTransitions{
    Transition{State::SelfTest, Event::Passed, State::Idle},
    Transition{State::SelfTest, Event::Timeout, State::Fault},

    Transition{State::Idle, Event::PoseAsked, State::Position},
    Transition{State::Idle, Event::Begin, State::Capture},
    Transition{State::Idle, Event::StaffIn, State::Staff},

    Transition{State::Position, Event::Begin, State::Capture},
    Transition{State::Position, Event::StageFailed, State::Idle},  // the cameras are silent
    Transition{State::Position, Event::Cancel, State::Idle},
    Transition{State::Position, Event::Timeout, State::Idle},

    Transition{State::Capture, Event::Triggered, State::Match},
    Transition{State::Capture, Event::TurnAsked, State::Turn},
    Transition{State::Turn, Event::StageDone, State::Fuse},
    Transition{State::Match, Event::StageDone, State::Reconstruct},
    Transition{State::Reconstruct, Event::StageDone, State::Mesh},
    Transition{State::Mesh, Event::StageDone, State::Texture},
    Transition{State::Texture, Event::StageDone, State::Assemble},
    Transition{State::Assemble, Event::StageDone, State::Review},
    Transition{State::Fuse, Event::StageDone, State::Review},

    Transition{State::Review, Event::Accept, State::Store},
    Transition{State::Review, Event::Retake, State::Capture},
    Transition{State::Review, Event::PoseAsked, State::Position},
    Transition{State::Review, Event::Cancel, State::Idle},
    Transition{State::Review, Event::Timeout, State::Idle},  // no answer is no consent

    Transition{State::Store, Event::StageDone, State::Idle},
    Transition{State::Store, Event::StageFailed, State::Review},  // a full disk: accept again, or leave
    Transition{State::Store, Event::Timeout, State::Fault},

    Transition{State::Staff, Event::CalibrateAsked, State::Calibrate},
    Transition{State::Staff, Event::ExportAsked, State::Export},
    Transition{State::Staff, Event::StaffOut, State::Idle},
    Transition{State::Staff, Event::Cancel, State::Idle},
    Transition{State::Staff, Event::Timeout, State::Idle},

    Transition{State::Fault, Event::Timeout, State::SelfTest},
    Transition{State::Fault, Event::StaffIn, State::Staff},
};

// From the photograph to the model what goes wrong leads out of every state alike.
inline constexpr std::array kMaking{State::Capture, State::Turn,    State::Match,    State::Reconstruct,
                                    State::Mesh,    State::Texture, State::Assemble, State::Fuse};
// From what the staff asked for everything leads back to them.
inline constexpr std::array kAsked{State::Calibrate, State::Export};
inline constexpr std::array kOutcomes{Event::StageDone, Event::StageFailed, Event::Cancel, Event::Timeout};
inline constexpr auto kTransitions = [] {
  constexpr auto kFaulty = std::size_t(State::Fault);  // all states before it
  std::array<Transition,
             kOwnTransitions.size() + 4 * kMaking.size() + kOutcomes.size() * kAsked.size() + kFaulty>
      all{};
  auto row = std::ranges::copy(kOwnTransitions, all.begin()).out;
  for (const State from : kMaking) {
    *row++ = {from, Event::StageFailed, State::Capture};  // advice is shown, another try
    *row++ = {from, Event::AdviceGiven, State::Position};
    *row++ = {from, Event::Cancel, State::Idle};
    // Turn goes on with the sides that are there.
    *row++ = {from, Event::Timeout, from == State::Turn ? State::Fuse : State::Idle};
  }
  for (const State from : kAsked)
    for (const Event event : kOutcomes) *row++ = {from, event, State::Staff};
  for (std::size_t from = 0; from < kFaulty; ++from)
    *row++ = {static_cast<State>(from), Event::Failed, State::Fault};
  return all;
}();

struct Deaf {
  State state;
  Event event;
  std::string_view why;
};
inline constexpr std::array kDeaf{
    Deaf{State::SelfTest, Event::Cancel, "nobody has asked for anything yet"},
    Deaf{State::Idle, Event::Cancel, "nothing is under way"},
    Deaf{State::Idle, Event::Timeout, "waiting is its work"},
    Deaf{State::Store, Event::Cancel, "one transaction: it ends in a moment, whole or not at all"},
    Deaf{State::Fault, Event::Cancel, "nothing is under way"},
    Deaf{State::Fault, Event::Failed, "it already is"},
};

// Somebody is to be photographed, or was: until they have left, or their record is stored.
constexpr bool is_of_a_visit(State state) {
  return state == State::Position || state == State::Review || state == State::Store ||
         std::ranges::find(kMaking, state) != kMaking.end();
}

// Where an event leads, or nothing when the state does not listen to it.
constexpr std::optional<State> next(State from, Event event) {
  for (const Transition& t : kTransitions) {
    if (t.from == from && t.event == event) return t.to;
  }
  return std::nullopt;
}

std::string_view name_of(State state);

// --- proofs -------------------------------------------------------------------------------------
namespace proof {

inline constexpr std::size_t kStates = std::size_t(State::Count);

consteval bool deterministic() {
  for (std::size_t i = 0; i < kTransitions.size(); ++i) {
    for (std::size_t j = i + 1; j < kTransitions.size(); ++j) {
      if (kTransitions[i].from == kTransitions[j].from && kTransitions[i].event == kTransitions[j].event)
        return false;
    }
  }
  return true;
}

// Forward: the states reached from `start`. Backward: those from which `start` is reached.
consteval bool all_connected(State start, bool backward) {
  std::array<bool, kStates> seen{};
  seen[std::size_t(start)] = true;
  for (std::size_t round = 0; round < kStates; ++round) {
    for (const Transition& t : kTransitions) {
      const auto from = std::size_t(backward ? t.to : t.from);
      const auto to = std::size_t(backward ? t.from : t.to);
      if (seen[from]) seen[to] = true;
    }
  }
  return std::ranges::find(seen, false) == seen.end();
}

consteval bool answers_or_is_deaf(Event event) {
  for (std::size_t s = 0; s < kStates; ++s) {
    const auto state = static_cast<State>(s);
    int deaf = 0;
    for (const Deaf& d : kDeaf) deaf += d.state == state && d.event == event ? 1 : 0;
    if (deaf + (next(state, event) ? 1 : 0) != 1) return false;  // exactly one of the two
  }
  return true;
}

static_assert(deterministic(), "one event, one way out");
static_assert(all_connected(State::SelfTest, false), "a state nobody can reach");
static_assert(all_connected(State::Idle, true), "a state with no way back to Idle");
static_assert(answers_or_is_deaf(Event::Cancel), "a state that neither answers Cancel nor says why");
static_assert(answers_or_is_deaf(Event::Timeout), "a state that neither answers Timeout nor says why");
static_assert(answers_or_is_deaf(Event::Failed), "a state that neither answers Failed nor says why");

}  // namespace proof

// How long a state may last; nothing where it may last for ever.
std::optional<std::chrono::milliseconds> limit_of(State state);

class Machine {
 public:
  explicit Machine(hal::Instant now) : entered_(now) {}

  State state() const { return state_; }

  // Entering a state, also the same one again, starts its time anew.
  std::optional<Transition> handle(Event event, hal::Instant now);
  // Somebody is there, or an export goes on: a state that waits for that waits its whole time again.
  void renew(hal::Instant now);
  // Handles Timeout when the state's time is over.
  std::optional<Transition> tick(hal::Instant now);
  bool limit_reached(hal::Instant now) const;  // of the state: a tick leaves it

 private:
  State state_ = State::SelfTest;
  hal::Instant entered_;
};

}  // namespace relievo::firmware
