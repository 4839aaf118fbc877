// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// StaffRequest: what a page of the staff's side asks of the appliance, each kind of its own type. A screen
// puts the type into its button's Action; Service (service.h) adds the page and what was typed. Plain values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <variant>

#include "hal/base/wiped_text.h"
#include "ui/device/settings.h"
#include "ui/language/language.h"
#include "ui/view/service_view.h"

namespace relievo::ui {

// --- every page --------------------------------------------------------------------------------------
struct PageOpened {};
struct PageLeft {};

// --- signing in, first start; the text is the PIN ------------------------------------------------------
struct CheckPin {};
// It is typed twice; what the appliance makes of it is AccessView::step.
struct OfferPin {};
struct MoveClock {
  std::int32_t minutes = 0;
};
struct ChooseHome {  // a visit begins in this language, as soon as both PINs are chosen
  Language language{};
};
struct SetClock {};            // the shown time is right
struct TakeConsentText {};     // from the stick
struct ConfirmConsentText {};  // the one in force is meant to be

// --- lists of many pages: in the page's own; pages count from 0 (ListPlace) ---------------------
struct GoToPage {
  std::int64_t page = 0;
};
struct DivideList {  // into stretches, from the first to the last page
  std::int64_t first = 0, last = 0;
};
struct FilterList {
  std::size_t filter = 0;
};
struct FindFilters {};  // which there are, where a page cannot know without looking
using ListRequest = std::variant<GoToPage, DivideList, FilterList, FindFilters>;

// --- records ---------------------------------------------------------------------------------------------
// The text: a part of the name, a number or a code; empty: everyone.
struct FindRecords {};
struct OfRecord {
  std::int64_t record = 0;
};
struct ShowRecord : OfRecord {};
struct EraseRecord : OfRecord {};
struct ExportRecord : OfRecord {};
struct ExportFound {};
struct StopExport {};

struct OfferWord {};  // the text: the word of the sheet that is asked for

// --- device ------------------------------------------------------------------------------------------------
struct ChangeSetting {
  Setting setting{};
  bool more = false;
};
struct BeginSelfTest {};
struct BeginTriggerTest {};
struct BeginTouchTrial {};
struct TakePlainTouch {};  // the panel as it is

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
  Poses,  // of a head from several pairs
  Count
};
inline constexpr std::size_t kTechnicianStages = std::size_t(TechnicianStage::Count);
enum class TechnicianTable : std::uint8_t { Matches, Points, Model, Poses, Calibration, Count };
inline constexpr std::size_t kTechnicianTables = std::size_t(TechnicianTable::Count);

// What needs nothing more to be said.
enum class TechnicianAct : std::uint8_t {
  Capture,  // a new test capture, and all stages of it
  AddSide,  // one more pair of it, of the head turned, for the next calculation
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
  ShowRelief,      // beside the left picture, in place of the right one; again: no longer
  ShowEdges,       // what is in focus is coloured in both pictures; again: no longer
  ShowDifference,  // of each result that was put aside to the present one; again: no longer
  BrighterShot,
  DarkerShot,
  BeginCalibration,
  StopCalibration,
  CancelCalibration,
  StoreCalibration,
  SwitchCharuco,      // the other kind of board
  SwitchMountedAnew,  // the next calibration may find the cameras at another distance than the last
  ExportCalibration,  // the one in use, to the stick
  ImportCalibration,  // from the stick: stored, and in use
  Record,             // the test capture, on the stick
  StopRecording,
  Save,  // all of the reconstruction, on the stick
  ListSaved,
  LeaveSaved  // those that are on it
};
// Again, with the algorithms as they are chosen now: from the first stage they change (0), or at the latest
// from stage 1 .. 4.
struct RunStages {
  std::int32_t latest = 0;
};
struct ShowStage {
  TechnicianStage stage{};
};
struct ShowTable {
  TechnicianTable table{};
};
// A finger on the left or right picture: it came down, or it came down earlier and is there now. Shares of
// the picture.
struct TouchPicture {
  bool right = false, dragged = false;
  float x = 0, y = 0;
};
// What stands there on the page.
struct AtIndex {
  std::size_t index = 0;
};
struct ChooseKind : AtIndex {};
struct ChooseName : AtIndex {};  // chosen, or for rules switched
struct EditOption : AtIndex {};
struct DropResult : AtIndex {};
struct UseCalibration : AtIndex {};
struct TypeDigit {
  char digit = 0;
};  // '0' to '9', '.', '-', 'e'
// Of the calibration board: so many more; the square in tenths of a millimetre.
enum class BoardMeasure : std::uint8_t { Columns, Rows, Square };
struct ChangeBoard {
  BoardMeasure measure{};
  std::int32_t step = 0;
};
// A saved reconstruction; what was captured goes when it is read, or is put aside first.
struct LoadSaved {
  std::size_t row = 0;
  bool beside = false;
};

using TechnicianRequest =
    std::variant<TechnicianAct, RunStages, ShowStage, ShowTable, ListRequest, TouchPicture, ChooseKind,
                 ChooseName, EditOption, TypeDigit, DropResult, ChangeBoard, UseCalibration, LoadSaved>;
using StaffAsk =
    std::variant<std::monostate, PageOpened, PageLeft, CheckPin, OfferPin, MoveClock, ChooseHome, SetClock,
                 TakeConsentText, ConfirmConsentText, ListRequest, FindRecords, ShowRecord, EraseRecord,
                 ExportRecord, ExportFound, StopExport, OfferWord, ChangeSetting, BeginSelfTest,
                 BeginTriggerTest, BeginTouchTrial, TakePlainTouch, TechnicianRequest>;

inline constexpr std::size_t kStaffTextBytes = 128;

struct StaffRequest {
  StaffPage page = StaffPage::Menu;
  StaffAsk ask;
  ShortWipedText<kStaffTextBytes> typed;
  std::string_view text() const { return typed.view(); }
  // What was asked, if it is that.
  template <typename Ask>
  const Ask* as() const {
    return std::get_if<Ask>(&ask);
  }
};

}  // namespace relievo::ui
