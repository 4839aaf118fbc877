// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Finds the inner corners of a printed board, to about a hundredth of a pixel, in tens of milliseconds.
//
// A chessboard must be in the picture whole, but for a few corners under a highlight or a shadow's
// rim. Of a ChArUco board any part will do that shows two markers: the markers say which part it is.
//
// Corners come row by row, `columns` in each row. A ChArUco board's first corner is always the same
// one. A chessboard's first corner is the one beside a black corner square where only one turn has it
// there (columns + rows odd: 10x7); what the colours leave open, half turns, and quarter turns of a
// board with as many columns as rows, is chosen as the board is seen, and pair_order() makes left and
// right agree.
// Pixels, (0, 0) the centre of the top left pixel.
// Thread: any.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hal/base/image_view.h"
#include "hal/base/result.h"
#include "pipeline/model/calibration.h"

namespace relievo::pipeline {

enum class BoardKind : std::uint8_t { Chessboard, Charuco };

// A ChArUco board is laid out as OpenCV 4.6 and later draw it: the top left square is black, the
// markers in the white squares are numbered row by row, out of OpenCV's dictionary of that size.
struct BoardPattern {
  int columns = 10;  // inner corners, as everywhere in OpenCV
  int rows = 7;
  double square_mm = 20;
  BoardKind kind = BoardKind::Chessboard;
  double marker_mm = 0;  // ChArUco: side of a marker; 0: kMarkerShare of a square
  int marker_bits = 4;   // ChArUco: a side, 4 to 7; the dictionary of 1000 markers of that size

  // Leaves the white rim that edges need, and markers large enough to be read from afar.
  static constexpr double kMarkerShare = 0.7;

  int corners() const { return columns * rows; }
  int markers() const { return (columns + 1) * (rows + 1) / 2; }
  double marker_side_mm() const { return marker_mm > 0 ? marker_mm : kMarkerShare * square_mm; }
  Result<void> check() const;
};

// All of the pattern. A corner that cannot be trusted is not-a-number and takes no part.
using BoardCorners = std::vector<Vec2d>;

inline bool seen(const Vec2d& corner) { return corner.x == corner.x; }

// Errors: NotFound (no whole board, or too little of a ChArUco board), InvalidInput (no picture, wrong
// pattern), OutOfMemory, LibraryFailed.
Result<BoardCorners> find_board(const ImageView& picture, const BoardPattern& pattern);
// The same, but that no board is a finding: no corners.
Result<BoardCorners> look_for_board(const ImageView& picture, const BoardPattern& pattern);

// Turns a chessboard's `right` by half, or by quarters where it has as many columns as rows, so that
// its rows run as those of `left`: cameras that stand side by side see a board the same way up. What
// ChArUco markers say stays.
void pair_order(const BoardCorners& left, BoardCorners& right, const BoardPattern& pattern);

inline constexpr int kMinBoardPairs = 5;
inline constexpr int kMaxBoardPairs = 500;

struct BoardView {
  std::string name;
  BoardCorners left;  // empty where no board was found
  BoardCorners right;
};

// What a calibration is made from: the corners that were seen, and what is known of the rig beforehand.
// Pixels, millimetres.
struct CalibratorInput {
  BoardPattern pattern;
  int width_px = 0;  // of both cameras
  int height_px = 0;
  std::vector<BoardView> views;
  // What the distance of the cameras is known to be, from their mount or the calibration before; 0: unknown.
  // A wrong size of the board's squares cannot be seen without it.
  double expected_baseline_mm = 0;
  // The calibration in use until now, if any: where its lenses are these lenses, its baseline is expected,
  // unless expected_baseline_mm says another.
  std::optional<StereoCalibration> in_use{};
};

// What is black on a board: for a printer. Origin in the top left corner of the outer squares, x along
// a row, y down, mm; the field measures (columns + 1) x (rows + 1) squares.
struct BlackArea {
  double x_mm, y_mm, width_mm, height_mm;
};

// Errors: InvalidInput (wrong pattern), LibraryFailed.
Result<std::vector<BlackArea>> draw_board(const BoardPattern& pattern);

}  // namespace relievo::pipeline
