// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A printed board in any pose and light. Board frame: origin in the first inner corner, x along a row
// of corners, y down the rows, z into the board; mm. Thread: any, once made.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/base/result.h"
#include "hal/sim/optics/rig.h"
#include "hal/sim/optics/scene.h"

namespace relievo::hal::sim {

// What is printed on a simulated board: chessboard or ChArUco, in the layout that OpenCV 4.6 draws
// (top left square black, marker numbers row by row).
enum class BoardKind : std::uint8_t { Chessboard, Charuco };

struct BoardPattern {
  int corners_x = 10, corners_y = 7;  // inner corners
  double square_mm = 20;
  double margin_mm = 15;  // white, around the outer squares
  BoardKind kind = BoardKind::Chessboard;
  double marker_mm = 0;        // ChArUco: side of a marker; 0: seven tenths of a square
  int marker_bits = 4;         // ChArUco: a side, 4 to 7
  Result<void> check() const;  // InvalidInput
  // The paper, with its margin.
  bool covers(double x_mm, double y_mm) const {
    const double low = -square_mm - margin_mm;
    return x_mm > low && y_mm > low && x_mm < corners_x * square_mm + margin_mm &&
           y_mm < corners_y * square_mm + margin_mm;
  }
  double marker_side_mm() const { return marker_mm > 0 ? marker_mm : 0.7 * square_mm; }
};

class BoardPrint {
 public:
  explicit BoardPrint(const BoardPattern& pattern);  // the pattern has been checked

  struct Spot {
    bool dark = false;
    std::int64_t cell = 0;  // two spots in one cell have one colour, and so has all between them
  };
  Spot at(double x_mm, double y_mm) const;

 private:
  BoardPattern pattern_;
  int modules_ = 0;                     // of a marker a side, with its border
  std::vector<std::uint64_t> markers_;  // white modules, as marker_modules() gives them
};

// OpenCV's predefined dictionary of `bits` a side: the first `count` markers, a bit for each module
// without the border, row by row from the lowest bit; set: white.
std::vector<std::uint64_t> marker_modules(int bits, int count);

BodyPose with_middle_at(Vec3 middle_mm, const Mat3& world_from_body, const BoardPattern& pattern);

// What a calibration has to bear; all 0: an even light on a clean board.
struct BoardLook {
  double lamp = 0;             // share of the light lost from the board's left edge to its right
  double shadow = 0;           // share of the light lost in a shadow over a slanting third of the board
  double highlight = 0;        // a lamp's mirror image, half a square wide, in units of white paper
  double cover = 0;            // share of the board's width that a hand reaches over it from the right
  Result<void> check() const;  // InvalidInput
};

class BoardScene final : public Scene {
 public:
  // Where `pixel_rad`, the angle of a pixel, is given, a ray collects the light of a whole pixel, and
  // the camera needs no more than one.
  BoardScene(const BoardPattern& pattern, const BodyPose& pose, const BoardLook& look = {},
             double pixel_rad = 0);
  RayHit look(Vec3 origin, Vec3 direction) const override;

 private:
  struct Hit {
    double distance = 0, x = 0, y = 0;  // mm, on the board
  };
  bool meet(Vec3 origin, Vec3 direction, Hit& hit) const;
  bool covered(const Hit& hit) const;
  double light(Vec3 origin, Vec3 direction, const Hit& hit) const;
  double dark_share(Vec3 origin, Vec3 direction, const Hit& hit) const;

  BoardPattern pattern_;
  BoardPrint print_;
  BodyPose pose_;
  BoardLook look_;
  double pixel_rad_;
};

// Poses that show the whole board to both cameras, tilted and spread as a good calibration wants.
// PoorGeometry when the rig cannot see this board whole.
Result<std::vector<BodyPose>> good_board_poses(const SimRig& rig, const BoardPattern& pattern, int count,
                                               std::uint32_t seed, double distance_mm = 560);

}  // namespace relievo::hal::sim
