// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TechnicianTables: the numbers behind the pictures, a page at a time: pixel coordinates of the matches,
// points in millimetres, the model's vertices in the head frame and normalised, the calibration. Normalised:
// from the middle of the model's box, in halves of its longest side, so within -1 .. 1. Thread: main, while
// no job runs. Memory: one page of texts; with a filter four bytes a row. Errors: none.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "firmware/base/list_walk.h"
#include "firmware/session/session.h"
#include "firmware/technician/show/technician_figures.h"
#include "pipeline/model/calibration.h"
#include "ui/technician/technician_view.h"

namespace relievo::firmware {

inline constexpr std::size_t kTableRows = 10;  // of a page

class TechnicianTables {
 public:
  struct Source {
    const Products* products = nullptr;  // may be missing, and parts of it
    const TechnicianFigures& figures;
    const pipeline::StereoCalibration* calibration = nullptr;  // may be missing
  };
  void show(ui::TechnicianTable table, const Source& from);
  void ask(const ui::ListRequest& request, const Source& from);
  void refresh(const Source& from);
  void forget();
  // Until the next change.
  ui::TechnicianRows view() const;

 private:
  void select(const Source& from);
  void fill(const Source& from);
  void fill_row(const Source& from, std::size_t row);
  std::string label_of(const Source& from, std::size_t row);
  void fill_matches(const Source& from, std::size_t row);
  void fill_points(const pipeline::PointCloud& cloud, std::size_t row);
  void fill_model(const pipeline::FaceModel& model, std::size_t row);
  void fill_poses(const pipeline::Registration& registration, std::size_t row);
  void fill_calibration(const pipeline::StereoCalibration& calibration);
  void cell(const char* format, double value);
  void word(std::string_view text) { texts_.emplace_back(text); }

  ui::TechnicianTable table_ = ui::TechnicianTable::Matches;
  ListWalk walk_{kTableRows};
  std::vector<std::uint32_t> selected_;  // rows that pass the filter; where there is one
  std::vector<std::string> texts_;
  std::vector<std::string_view> cells_;
  struct Box {
    pipeline::Vec3d middle;
    double half = 0;  // 0: not measured yet
    const void* of = nullptr;
  } box_;
};

}  // namespace relievo::firmware
