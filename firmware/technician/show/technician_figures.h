// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TechnicianFigures: what a set of algorithms cost and made, as the technician reads it: times, counts, what
// each rule rejected, and what the result says of itself where nothing is known to be true
// (firmware/measure). Its texts stay where they are: view() borrows them.
// Thread: worker while a job runs, else main. Errors of measure(): Cancelled, OutOfMemory.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/base/list_walk.h"
#include "firmware/machine/machine.h"
#include "firmware/session/session.h"
#include "firmware/work/stage_runner.h"
#include "pipeline/algorithms.h"
#include "pipeline/base/stage.h"
#include "pipeline/model/calibration.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/rectified_pair.h"
#include "ui/technician/technician_view.h"

namespace relievo::firmware {

// How uncertain the measured vertices are, as TechnicianResult has it.
std::array<float, ui::kSigmaBins> sigma_percent(const pipeline::FaceMesh& mesh);

class TechnicianFigures {
 public:
  // `name`: of the capture.
  void begin(const pipeline::AlgorithmSet& set, const std::string& name);
  void add(const StageRecord& record);
  void fail(State stage, const Error& error);
  Result<void> measure(const Products& products, pipeline::StageContext& context);
  void forget() { *this = {}; }

  // Until the next change.
  ui::TechnicianResult view() const;
  // That took a match first; empty: none did.
  std::string_view rule_of(const pipeline::Match& match) const;

 private:
  pipeline::AlgorithmSet set_;
  ui::TechnicianResult result_;
  std::size_t stages_ = 0;
  std::string name_, difference_;
  ui::Fault failure_;
  std::vector<std::string> rules_;
};

// TechnicianTables: the numbers behind the pictures, a page at a time: pixel coordinates of the matches,
// points in millimetres, the model's vertices in the head frame and normalised, the calibration. Normalised:
// from the middle of the model's box, in halves of its longest side, so within -1 .. 1. Thread: main, while
// no job runs. Memory: one page of texts; with a filter four bytes a row. Errors: none.

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

// HandPairs: the matches that a technician makes on the rectified pair. A finger on the left picture begins a
// pair, and its partner is proposed by correlation along its row; a finger on the right one corrects the
// partner, which has no other row. Either end is dragged. A partner is set to the best likeness near the
// finger where there is one (match_on_row()), else where the finger says, with a pixel of sigma.
// Places are shares of the pictures. Thread: main, while no job runs. Errors: none.

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
