// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TechnicianAct: what a touch on the technician's picture pages asks of the test capture, with a number
// that says which. It is the verb of a StaffDo action (ui/view/service.h). Thread: any.
#pragma once

#include <cstdint>

namespace relievo::ui {

enum class TechnicianAct : std::uint8_t {
  None,     // the page was opened
  Capture,  // a new test capture, and all stages of it
  Run,  // again, with the algorithms as they are chosen now: from the first stage they change (0), or at the
        // latest from stage 1 .. 4
  Stop,
  ShowStage,   // TechnicianStage
  Point,       // touched in the left picture: x << 12 | y, 4096ths of the picture
  PointRight,  // in the right one
  Drag,        // a finger that came down on the left picture is there now
  DragRight,   // on the right one
  ByHand,      // touches make pairs by hand; again: no longer
  RemovePair,  // the chosen one
  ChooseKind,  // index into kinds
  ChooseName,  // index into the chosen kind's names: chosen, or for rules switched
  EditOption,  // index into options
  TypeDigit,   // '0' to '9', '.', '-', 'e'
  EraseDigit,
  UseTyped,
  UseDefault,
  LeaveOption,
  ResetSet,    // every choice as it is by default
  ApplySet,    // visitors are measured with these from now on
  KeepResult,  // the present result is put aside, to be compared with others: kCompared - 1 at most
  DropResult,  // one of those: which
  ShowTable,   // TechnicianTable
  TurnPage,    // by so many pages
  WatchCameras,
  ShowRelief,  // beside the left picture, in place of the right one; again: no longer
  BrighterShot,
  DarkerShot,
  BeginCalibration,
  StopCalibration,
  CancelCalibration,
  StoreCalibration,
  Columns,
  Rows,
  Square,
  Charuco,            // of the board: one more or less; a tenth of a millimetre times the value; other kind
  Activate,           // a stored calibration: its row
  ExportCalibration,  // the one in use, to the stick
  ImportCalibration,  // from the stick: stored, and in use
  Record,
  StopRecording,  // the test capture, on the stick
  Save,           // all of the reconstruction, on the stick
  ListSaved,
  LeaveSaved,  // those that are on it
  Load,        // one of them: its row; what was captured goes when it is read
  LoadBeside   // the same, and the present result is put aside first
};

// What a request of the staff's side (ui/view/service.h) says, once it has come to the test capture.
struct TechnicianOrder {
  TechnicianAct act = TechnicianAct::None;
  std::int64_t argument = 0;
};

}  // namespace relievo::ui
