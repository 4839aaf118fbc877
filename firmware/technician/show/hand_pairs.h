// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// HandPairs: the matches that a technician makes on the rectified pair. A finger on the left picture begins a
// pair, and its partner is proposed by correlation along its row; a finger on the right one corrects the
// partner, which has no other row. Either end is dragged. A partner is set to the best likeness near the
// finger where there is one (match_on_row()), else where the finger says, with a pixel of sigma.
// Places are shares of the pictures. Thread: main, while no job runs. Errors: none.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "firmware/technician/show/technician_figures.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/rectified_pair.h"
#include "ui/technician/technician_view.h"

namespace relievo::firmware {

// What a finger on the rectified pair means: the match that is nearest to it, with the point in space it
// stands for: the left camera's frame, millimetres, sigma along the line of sight. Without a partner
// `matched` stays false.
ui::TechnicianPoint nearest_match(const pipeline::RectifiedPair& pair, const pipeline::MatchSet& matches,
                                  const TechnicianFigures& figures, float x, float y);

class HandPairs {
 public:
  // A finger came down: it takes hold of a pair there, else begins one (left) or moves the chosen one's
  // partner (right).
  void touch(const pipeline::RectifiedPair& pair, bool left, float x, float y);
  // It is there now.
  void drag(const pipeline::RectifiedPair& pair, bool left, float x, float y);
  // The chosen one goes, and the one before it is chosen.
  void remove();
  // What was calculated with; the chosen one stays.
  void show(const pipeline::RectifiedPair& pair, std::span<const pipeline::Match> matches);
  void forget() { *this = {}; }

  // With a partner, in the order in which they were begun.
  std::vector<pipeline::Match> matches() const;
  bool changed() const { return changed_; }  // since show()
  std::span<ui::TechnicianPoint> points() { return points_; }
  // An untouched one: there is none.
  ui::TechnicianPoint chosen() const {
    return chosen_ < points_.size() ? points_[chosen_] : ui::TechnicianPoint{};
  }

 private:
  void move_left(const pipeline::RectifiedPair& pair, float x, float y);
  void move_right(const pipeline::RectifiedPair& pair, float x);

  std::vector<ui::TechnicianPoint> points_;
  std::size_t chosen_ = 0;
  bool changed_ = false;
};

}  // namespace relievo::firmware
