// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the pages of the staff's side draw, one struct a page, as plain data.
// Spans, pointers and views are borrowed for the length of one frame. Thread: main.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "ui/draw/draw_list.h"
#include "ui/view/service_view.h"

namespace relievo::ui {

// What the event log notes beside faults. Its file keeps the numbers: new ones stand at the end.
enum class LogEvent : std::uint8_t {
  Started,
  SignedOut,
  TechnicianSignedIn,
  OperatorSignedIn,
  WrongPin,
  ClockSet,
  TechnicianPinChosen,
  OperatorPinChosen,
  TechnicianPinForgotten,  // by the command line
  OperatorPinForgotten,
  TouchPlain,
  TouchCorrected,
  SettingChanged,   // its key and its value in figures
  RecordsExported,  // how many
  RecordsExpired,   // how many
  RecordErased,     // its number
  SelfTestBegun,
  ConsentTaken,     // its version
  SettingUnknown,   // what is stored in place of one
  TakenHome,        // a visitor has a copy of their own
  EndedEarly,       // the run before this one: the power or the program failed
  CalibrationUsed,  // another one than before
  Count
};

struct RecordRow {
  std::int64_t number = 0;
  std::string name, since, code;
  int portraits = 0;
};

// Lets pass those of one first letter, or those who agreed to one version of the consent text last.
struct RecordFilter {
  bool letter = false;  // false: `text` is the version of a consent text
  std::string text;
  auto operator<=>(const RecordFilter&) const = default;
};
inline constexpr std::size_t kRecordFilters =
    100;  // at most; whoever falls under none of them is searched for

struct RecordsView {
  std::span<const RecordRow> rows;  // newest first
  ListPlace place;
  std::string_view searched;
  const RecordRow* shown = nullptr;        // the one that is looked at
  std::string_view consent, consented_at;  // the text's version and language; when
  bool erased = false;                     // the last thing that was done
  bool exported = false;
  int asked = 0;  // records of the last export; 0: the last thing that was done is another
  int whole = 0;  // of these, on the stick and read back
  std::span<const RecordFilter> filters{};  // ListPlace::filter 1 is the first; none: not looked up yet
  bool looks = false;                       // all are read for what was asked; ServiceView::work says how far
};

// --- status: what needs a hand, as the appliance knows it; the rest stands in ViewState -------------
struct StatusView {
  bool looked = false;  // at free_mib, hottest_c and calibration_days
  bool camera_away = false;
  std::uint64_t pairs = 0, missed = 0;  // since the start: handed over; late, lost, damaged or not there
  double free_mib = 0;                  // of the store's disk
  double hottest_c = 0;                 // of all sensors; 0: there are none
  int calibration_days = 0;             // age of the calibration in use
  bool clock_jumped = false;            // ahead: nothing is erased for its age
  bool store_damaged = false;           // something read from it was, since the start
  int device_faults = 0;                // noted since the start, none of them a visitor's
};
inline constexpr double kWarmCelsius = 75, kHotCelsius = 90;

// --- statistics: numbers, nobody's name -----------------------------------------------------------
enum class Refusal : std::uint8_t { NoFace, TooFewMatches, PoorGeometry, Memory, Camera, Slow, Other, Count };
inline constexpr std::size_t kRefusals = std::size_t(Refusal::Count);

inline constexpr std::size_t kStatisticsDays = 29;  // four weeks and today

// Of each day, the last is today. Whole numbers; dates are "2026-03-02".
struct DayCounts {
  std::array<std::array<char, 11>, kStatisticsDays> date{};
  std::array<float, kStatisticsDays> visits{}, stored{}, refused{};
};

struct StatisticsView {
  std::string_view since;  // a date
  std::uint64_t visits = 0, captures = 0, models = 0, stored = 0, left = 0;
  std::array<std::uint64_t, kRefusals> refused{};
  double median_s = 0, slow_s = 0;  // from the pictures to the model: half, nine of ten are faster
  DayCounts days{};
};

// What has been noted. Of an event or a fault that this version does not know only the text is shown.
struct LogLine {
  std::string at;  // date and time
  bool fault = false;
  std::string text;  // English
  std::optional<Errc> code{};
  std::optional<LogEvent> event{};
  std::array<std::string, 2> values{};  // of the event
};

// --- health ---------------------------------------------------------------------------------------
enum class Gauge : std::uint8_t { Stages, Process, Disk, Temperature };

struct GaugeRow {
  Gauge gauge = Gauge::Process;
  std::string_view name;    // of a sensor; empty: the gauge's own
  double used = 0, of = 0;  // MiB, or degrees Celsius; of: what it should stay below, 0 for not known
  Mood mood = Mood::Plain;
  std::span<const float> day{};  // the last 24 hours, as `used`, evenly; NaN: not known. Empty: not kept
};

// Of the last visits that were photographed: where the time goes and what memory it takes.
enum class CostlyStage : std::uint8_t { Match, Reconstruct, Mesh, Texture, Assemble, Side, Fuse, Count };
inline constexpr std::size_t kCostlyStages = std::size_t(CostlyStage::Count);

struct StageCost {
  float seconds = 0, mib = 0;  // at most, in one visit; 0: it was not run
};
struct VisitCostsView {
  int visits = 0;  // so many are looked at
  std::array<StageCost, kCostlyStages> stages{};
  float resident_mib = 0;                            // of the whole program, at most
  float planned_seconds = 0, planned_stage_mib = 0;  // of one stage
};

struct HealthView {
  std::span<const GaugeRow> gauges;
  VisitCostsView costs;
  std::span<const LogLine> faults;  // newest first
};

// --- log -------------------------------------------------------------------------------------------
struct LogView {
  std::span<const LogLine> lines;  // of a page, newest first
  ListPlace place;                 // filter 1: faults alone
};

// --- consent text: which is in force, ViewState::consent says --------------------------------------
struct ConsentTextsView {
  bool taking = false;
  Outcome outcome = Outcome::None;  // of the last try; Done: it is in force
  const Fault* fault = nullptr;     // why not
};

// --- recovery words: a sheet, then two of its words, typed ------------------------------------------
enum class SheetState : std::uint8_t { Asked, Wrong, Saving, Failed, Done };

struct RecoveryView {
  std::span<const std::string_view> words;  // English; empty when they are confirmed
  Picture code;                             // the same as a QR code
  int asked = 0;                            // the word that is to be typed; from 1
  SheetState state = SheetState::Asked;
};

// --- self-test --------------------------------------------------------------------------------------
enum class Check : std::uint8_t { Memory, Store, Calibration, Disk, Cameras, Count };
enum class CheckState : std::uint8_t { NotTested, Running, Good, Bad };
inline constexpr std::size_t kChecks = std::size_t(Check::Count);

struct SelfTestView {
  std::array<CheckState, kChecks> states{};
  std::array<Fault, kChecks> problems{};  // of those that are bad
};

// --- trigger test -----------------------------------------------------------------------------------
struct TriggerView {
  int pulses = 0, pairs = 0;                      // given; seen by both cameras
  double apart_ms = 0;                            // between the two exposures, at most
  double delay_ms = 0;                            // from asking to having both pictures, at most
  std::uint64_t late = 0, lost = 0, damaged = 0;  // of both cameras, in this test
  bool ended = false;
};

}  // namespace relievo::ui
