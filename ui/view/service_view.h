// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ServiceView: what the staff's pages may draw, as plain data; the part of ViewState that a visitor
// never sees. A page whose data is not here yet has a null pointer and says so.
// Ownership: everything is borrowed for the length of one frame. Thread: main.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "hal/base/words.h"
#include "pipeline/model/face_model.h"

namespace relievo::ui {

enum class StaffRole : std::uint8_t { None, Technician, Operator };

// Every page of the staff's side. Pin and FirstStart need no role; the rest are rows of staff_pages().
enum class StaffPage : std::uint8_t {
  Pin,
  FirstStart,
  Menu,
  Records,
  Statistics,
  Consent,
  Recovery,  // operator's
  Stages,
  Model,
  Tables,
  Algorithms,
  Compare,
  Cameras,
  Calibrate,  // technician's, with pictures
  SelfTest,
  Trigger,
  Touch,
  Health,
  Log,  // technician's
  Settings,
  Clock,
  Pins,  // everybody's
  Count
};

// How a piece of work ended, as far as it makes a difference to who asked for it.
enum class Outcome : std::uint8_t {
  None,
  Done,
  Cancelled,
  NoStick,
  StickFull,
  StickGone,
  StickLocked,
  StickBad,
  StickHeld,  // write-protected; does not keep what is written; all is there, but the system does not let it
              // go
  StickUnchecked,  // all is there and was read back, but it cannot be opened once more to be sure
  NotFound,
  Refused,
  Failed
};

struct Work {
  bool running = false;
  float progress = 0;  // 0 to 1
  Outcome outcome = Outcome::None;
};

// Whose PIN is to be typed while new ones are chosen: each is typed twice.
enum class PinStep : std::uint8_t {
  Technician,
  TechnicianAgain,
  Operator,
  OperatorAgain,
  Own,
  OwnAgain,
  Done
};
enum class PinFault : std::uint8_t { None, Differ, Simple, Taken };

struct AccessView {
  bool set_up = true;     // both PINs have been chosen
  bool demanded = false;  // until they are, nobody gets past the first start: before real people
  PinStep step = PinStep::Technician;
  PinFault fault = PinFault::None;
  std::string_view clock;      // the date and time that is shown for the first start
  bool clock_right = false;    // somebody has said so
  bool clock_refused = false;  // the system does not let this program set its clock
  bool checking = false;
  bool wrong = false;          // the last one was
  std::optional<Errc> failed;  // why the last one could not be checked or kept
  int wait_s = 0;              // until the next try
  bool locked = false;         // that is a wait of minutes, after too many wrong ones; else of a moment
  bool consent_right = false;  // somebody has seen which consent text is in force, and goes on with it
  bool forgotten = false;      // not set up, because one of the two is to be chosen anew
  bool words_due = false;      // no recovery words open the store yet
};

enum class Mood : std::uint8_t { Plain, Good, Warn, Bad };

struct ServiceView {
  StaffRole role = StaffRole::None;
  int leaves_in_s = 0;  // 0: not soon
  AccessView access;
  Work work;           // of the page that is shown
  bool inner = false;  // it shows something within itself: Back opens the page anew
  // The model of the page, to be turned; another number for every model.
  const pipeline::FaceModel* model = nullptr;
  std::uint32_t model_number = 0;
  // The pages' own, in files of their own.
  const struct StatusView* status = nullptr;  // of the menu
  const struct RecordsView* records = nullptr;
  const struct StatisticsView* statistics = nullptr;
  const struct SelfTestView* self_test = nullptr;
  const struct TriggerView* trigger = nullptr;
  const struct HealthView* health = nullptr;
  const struct LogView* log = nullptr;
  const struct ConsentTextsView* consent = nullptr;
  const struct RecoveryView* recovery = nullptr;
  const struct SettingsView* settings = nullptr;
  const struct TouchView* touch = nullptr;
  const struct TechnicianView* technician = nullptr;  // of all the technician's picture pages
};

// Fault: an error of the engine as the staff's pages show it: its code, which they say in the reader's
// language (ui/screens/service/fault_words.cc), and its detail in English, as it was written. Visitors see
// none. Thread: any. Errors: none.
struct Fault {
  Errc code = Errc::InvalidState;
  std::string detail;  // where and what; empty: nothing is wrong
  bool empty() const { return detail.empty(); }
};

// The same, kept by somebody else: it costs no memory in every turn.
struct FaultView {
  FaultView() = default;
  FaultView(Errc whose, std::string_view what) : code(whose), detail(what) {}
  FaultView(const Fault& fault) : code(fault.code), detail(fault.detail) {}
  FaultView(Fault&&) = delete;  // it would not outlive this
  Errc code = Errc::InvalidState;
  std::string_view detail;
  bool empty() const { return detail.empty(); }
};

inline Fault fault_of(const Error& error) { return {error.code, detail_of(error)}; }

// ListPlace: where one is in a list of many pages, and the ways to another place, as the shared part of all
// lists draws them (list_pager()). Borrowed for one frame. Thread: main.

// Pages, counted from 0, both ends included; and what stands at the top of the first: a date, a number.
struct ListStretch {
  std::int64_t first = 0, last = 0;
  std::string_view label;
};
inline constexpr std::size_t kListStretches = 10;

struct ListPlace {
  std::int64_t page = 0, pages = 1;
  std::array<ListStretch, kListStretches> stretches{};  // of what was divided last
  std::size_t stretch_count = 0;                        // 0: they are being looked up
  std::size_t filter = 0;                               // of the page's own; 0: all rows
};

}  // namespace relievo::ui
