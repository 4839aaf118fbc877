// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What each fault does to the appliance in each of its states, as one table. fault_walk_test.cc walks it cell
// by cell through the real kiosk; firmware/FAULTS.md has it as fault_table_test.cc prints it.
//
// A cell says where the appliance is when all that ran has ended and nobody has touched the screen: in a
// state, at its end (exit code 0), or ended by its sentinel to be started anew.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/machine/machine.h"

namespace relievo::firmware {

enum class Fault : std::uint8_t {
  None,
  CameraLost,      // one of them is pulled
  CameraLate,      // its pictures do not come
  CameraDark,      // both see nothing
  CamerasSwapped,  // their plugs change places
  TriggerSilent,   // it is driven, and no pulse arrives
  TriggerStuck,    // it cannot be driven
  WorkerStuck,     // works on after its limit, until it is told to stop
  StoreFull,
  StoreCorrupt,
  StoreLocked,  // by another program
  MediumPulled,
  ClockAhead,  // the date jumps by 40 days
  ClockBack,
  ContextLost,  // GL's
  TooHot,
  Terminate,  // SIGTERM
  HangUp,     // SIGHUP
  MainFrozen,
  CaptureFrozen,
  WorkerFrozen,
  KeeperFrozen,
  Count
};
inline constexpr std::size_t kFaults = static_cast<std::size_t>(Fault::Count);
inline constexpr std::size_t kStates = static_cast<std::size_t>(State::Count);

struct Fate {
  enum class Kind : std::uint8_t { In, Ends, Restarts };
  Kind kind = Kind::In;
  State state = State::Idle;
  friend constexpr bool operator==(const Fate&, const Fate&) = default;
};
inline constexpr Fate kEnds{Fate::Kind::Ends}, kRestarts{Fate::Kind::Restarts};

namespace fault_table {

using S = State;
using F = Fault;
struct Row {
  Fault fault;
  Fate fate;
  std::array<State, kStates> in;  // Count: no more
};
constexpr Row row(Fault fault, Fate fate, std::initializer_list<State> in) {
  Row made{fault, fate, {}};
  made.in.fill(S::Count);
  std::size_t i = 0;
  for (const State state : in) made.in[i++] = state;
  return made;
}

// A visit goes on to its model, work ends, what waits for a person waits.
constexpr Fate without_fault(State state) {
  switch (state) {
    case S::SelfTest:
    case S::Idle:
    case S::Store:
    case S::Fault:
    case S::Count: return {.state = S::Idle};
    case S::Position:
    case S::Capture:
    case S::Turn:
    case S::Match:
    case S::Reconstruct:
    case S::Mesh:
    case S::Texture:
    case S::Assemble:
    case S::Fuse:
    case S::Review: return {.state = S::Review};
    case S::Calibrate: return {.state = S::Calibrate};
    case S::Staff:
    case S::Export: return {.state = S::Staff};
  }
  return {};
}

inline constexpr std::array kRows{
    row(F::CameraLost, {.state = S::Fault}, {S::SelfTest, S::Position, S::Capture, S::Fault}),
    row(F::CameraLost, {.state = S::Staff}, {S::Calibrate}),
    row(F::CameraLate, {.state = S::Idle}, {S::Position, S::Capture}),
    row(F::CameraLate, {.state = S::Staff}, {S::Calibrate}),
    row(F::CameraDark, {.state = S::Position}, {S::Position, S::Capture}),
    row(F::CamerasSwapped, {.state = S::Idle}, {S::Position, S::Capture}),
    row(F::CamerasSwapped, {.state = S::Staff}, {S::Calibrate}),
    row(F::TriggerSilent, {.state = S::Idle}, {S::Position, S::Capture}),
    row(F::TriggerSilent, {.state = S::Staff}, {S::Calibrate}),
    row(F::TriggerStuck, {.state = S::Idle}, {S::Position, S::Capture}),
    row(F::TriggerStuck, {.state = S::Staff}, {S::Calibrate}),
    row(F::WorkerStuck, {.state = S::Idle},
        {S::Turn, S::Match, S::Reconstruct, S::Mesh, S::Texture, S::Assemble, S::Fuse}),
    row(F::StoreFull, {.state = S::Review}, {S::Store}),
    row(F::StoreCorrupt, {.state = S::Fault}, {S::Store}),
    row(F::StoreLocked, {.state = S::Review}, {S::Store}),
    row(F::ClockBack, {.state = S::Review}, {S::Store}),
    row(F::CaptureFrozen, kRestarts, {S::SelfTest, S::Position, S::Capture, S::Turn, S::Calibrate, S::Fault}),
    row(F::WorkerFrozen, kRestarts,
        {S::Position, S::Capture, S::Turn, S::Match, S::Reconstruct, S::Mesh, S::Texture, S::Assemble,
         S::Fuse}),
    row(F::KeeperFrozen, kRestarts, {S::Store, S::Export}),
};

}  // namespace fault_table

constexpr Fate fate_of(State state, Fault fault) {
  if (fault == Fault::Terminate || fault == Fault::HangUp) return kEnds;
  if (fault == Fault::MainFrozen) return kRestarts;
  for (const fault_table::Row& row : fault_table::kRows) {
    for (const State in : row.in) {
      if (row.fault == fault && in == state) return row.fate;
    }
  }
  return fault_table::without_fault(state);
}

}  // namespace relievo::firmware
