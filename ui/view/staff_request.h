// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// StaffRequest: what a page of the staff's side asks of the appliance, each kind of its own type. A screen
// puts the type into its button's Action; Service (service.h) adds the page and what was typed. Plain values.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <variant>

#include "ui/device/settings.h"
#include "ui/view/service_view.h"

namespace relievo::ui {

// --- every page --------------------------------------------------------------------------------------
struct PageOpened {
  bool operator==(const PageOpened&) const = default;
};
struct PageLeft {
  bool operator==(const PageLeft&) const = default;
};

// --- signing in, first start; the text is the PIN ------------------------------------------------------
struct CheckPin {
  bool operator==(const CheckPin&) const = default;
};
// It is typed twice; what the appliance makes of it is AccessView::step.
struct OfferPin {
  bool operator==(const OfferPin&) const = default;
};
struct MoveClock {
  std::int32_t minutes = 0;
  bool operator==(const MoveClock&) const = default;
};
struct SetClock {
  bool operator==(const SetClock&) const = default;
};  // the shown time is right
struct TakeConsentText {
  bool operator==(const TakeConsentText&) const = default;
};  // from the stick
struct ConfirmConsentText {
  bool operator==(const ConfirmConsentText&) const = default;
};  // the one in force is meant to be

// --- records ---------------------------------------------------------------------------------------------
// The text: a part of the name, a number or a code; empty: everyone.
struct FindRecords {
  bool operator==(const FindRecords&) const = default;
};
struct TurnRecords {
  bool older = false;
  bool operator==(const TurnRecords&) const = default;
};
struct ShowRecord {
  std::int64_t record = 0;
  bool operator==(const ShowRecord&) const = default;
};
struct EraseRecord {
  std::int64_t record = 0;
  bool operator==(const EraseRecord&) const = default;
};
struct ExportRecord {
  std::int64_t record = 0;
  bool operator==(const ExportRecord&) const = default;
};
struct ExportFound {
  bool operator==(const ExportFound&) const = default;
};
struct StopExport {
  bool operator==(const StopExport&) const = default;
};

// --- device ------------------------------------------------------------------------------------------------
struct ChangeSetting {
  Setting setting{};
  bool more = false;
  bool operator==(const ChangeSetting&) const = default;
};
struct BeginSelfTest {
  bool operator==(const BeginSelfTest&) const = default;
};
struct BeginTriggerTest {
  bool operator==(const BeginTriggerTest&) const = default;
};
struct BeginTouchTrial {
  bool operator==(const BeginTouchTrial&) const = default;
};
struct TakePlainTouch {
  bool operator==(const TakePlainTouch&) const = default;
};  // the panel as it is

// --- the technician's picture pages ---------------------------------------------------------------------
enum class TechnicianStage : std::uint8_t {
  Input,
  Processed,
  Rectified,
  Matches,
  Disparity,
  Cloud,
  Mesh,
  Texture,
  Count
};
inline constexpr std::size_t kTechnicianStages = static_cast<std::size_t>(TechnicianStage::Count);
enum class TechnicianTable : std::uint8_t { Matches, Points, Model, Calibration, Count };
inline constexpr std::size_t kTechnicianTables = static_cast<std::size_t>(TechnicianTable::Count);

// What needs nothing more to be said.
enum class TechnicianAct : std::uint8_t {
  Capture,  // a new test capture, and all stages of it
  Stop,
  ByHand,      // touches make pairs by hand; again: no longer
  RemovePair,  // the chosen one
  EraseDigit,
  UseTyped,
  UseDefault,
  LeaveOption,
  ResetSet,    // every choice as it is by default
  ApplySet,    // visitors are measured with these from now on
  KeepResult,  // the present result is put aside, to be compared with others: kCompared - 1 at most
  WatchCameras,
  ShowRelief,  // beside the left picture, in place of the right one; again: no longer
  BrighterShot,
  DarkerShot,
  BeginCalibration,
  StopCalibration,
  CancelCalibration,
  StoreCalibration,
  SwitchCharuco,      // the other kind of board
  ExportCalibration,  // the one in use, to the stick
  ImportCalibration,  // from the stick: stored, and in use
  Record,             // the test capture, on the stick
  StopRecording,
  Save,  // all of the reconstruction, on the stick
  ListSaved,
  LeaveSaved  // those that are on it
};
struct DoTechnician {
  TechnicianAct act{};
  bool operator==(const DoTechnician&) const = default;
};
// Again, with the algorithms as they are chosen now: from the first stage they change (0), or at the latest
// from stage 1 .. 4.
struct RunStages {
  std::int32_t latest = 0;
  bool operator==(const RunStages&) const = default;
};
struct ShowStage {
  TechnicianStage stage{};
  bool operator==(const ShowStage&) const = default;
};
struct ShowTable {
  TechnicianTable table{};
  bool operator==(const ShowTable&) const = default;
};
struct TurnTable {
  std::int32_t pages = 0;
  bool operator==(const TurnTable&) const = default;
};
// A finger on the left or right picture: it came down, or it came down earlier and is there now. Shares of
// the picture.
struct TouchPicture {
  bool right = false, dragged = false;
  float x = 0, y = 0;
  bool operator==(const TouchPicture&) const = default;
};
// Of TechnicianChoice, what stands there.
struct ChooseKind {
  std::size_t index = 0;
  bool operator==(const ChooseKind&) const = default;
};
struct ChooseName {
  std::size_t index = 0;
  bool operator==(const ChooseName&) const = default;
};  // chosen, or for rules switched
struct EditOption {
  std::size_t index = 0;
  bool operator==(const EditOption&) const = default;
};
struct TypeDigit {
  char digit = 0;
  bool operator==(const TypeDigit&) const = default;
};  // '0' to '9', '.', '-', 'e'
struct DropResult {
  std::size_t index = 0;
  bool operator==(const DropResult&) const = default;
};
// Of the calibration board: so many more; the square in tenths of a millimetre.
enum class BoardMeasure : std::uint8_t { Columns, Rows, Square };
struct ChangeBoard {
  BoardMeasure measure{};
  std::int32_t step = 0;
  bool operator==(const ChangeBoard&) const = default;
};
struct UseCalibration {
  std::size_t row = 0;
  bool operator==(const UseCalibration&) const = default;
};
// A saved reconstruction; what was captured goes when it is read, or is put aside first.
struct LoadSaved {
  std::size_t row = 0;
  bool beside = false;
  bool operator==(const LoadSaved&) const = default;
};

using TechnicianRequest =
    std::variant<DoTechnician, RunStages, ShowStage, ShowTable, TurnTable, TouchPicture, ChooseKind,
                 ChooseName, EditOption, TypeDigit, DropResult, ChangeBoard, UseCalibration, LoadSaved>;
using StaffAsk =
    std::variant<std::monostate, PageOpened, PageLeft, CheckPin, OfferPin, MoveClock, SetClock,
                 TakeConsentText, ConfirmConsentText, FindRecords, TurnRecords, ShowRecord, EraseRecord,
                 ExportRecord, ExportFound, StopExport, ChangeSetting, BeginSelfTest, BeginTriggerTest,
                 BeginTouchTrial, TakePlainTouch, TechnicianRequest>;

inline constexpr std::size_t kStaffTextBytes = 128;

struct StaffRequest {
  StaffPage page = StaffPage::Menu;
  StaffAsk ask;
  std::array<char, kStaffTextBytes + 1> bytes{};
  std::string_view text() const { return {bytes.data()}; }
  // What was asked, if it is that.
  template <typename Ask>
  const Ask* as() const {
    return std::get_if<Ask>(&ask);
  }
};

}  // namespace relievo::ui
