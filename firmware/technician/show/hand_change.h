// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// HandChange: the surface with the pairs made by hand against that of the same capture and the same
// algorithms without any, both as the left rectified view sees them. Depths along its z, millimetres. Thread:
// worker while a job runs, else main. Errors: none; without the other surface nothing is known.
#pragma once

#include <span>
#include <string>

#include "firmware/measure/disparity_map.h"
#include "firmware/session/session.h"
#include "firmware/work/session_document.h"
#include "ui/technician/technician_result.h"

namespace relievo::firmware {

class HandChange {
 public:
  // The surface without pairs is there.
  bool has_before(const pipeline::AlgorithmSet& set) const { return !set_.empty() && set_ == set.to_text(); }
  void before(const pipeline::AlgorithmSet& set, const pipeline::RectifiedPair& pair,
              const pipeline::FaceMesh& mesh);
  // With pairs; does nothing for a surface without any but keeping it as the one before.
  void measure(const Making& making, const Products& products);
  void forget();

  const ui::TechnicianChange& figures() const { return figures_; }
  // By how much the surface came nearer at a place of the view; NaN where one of the two is not there.
  float nearer_mm(int x, int y) const;
  // To the points of the pairs that were calculated with.
  void tell(std::span<ui::TechnicianPoint> points) const;

 private:
  compare::DisparityMap before_, now_;  // depths
  std::string set_;                     // the algorithms of `before_`
  ui::TechnicianChange figures_;
};

}  // namespace relievo::firmware
