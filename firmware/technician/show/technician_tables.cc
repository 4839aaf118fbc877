// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/technician/show/technician_figures.h"
#include "hal/base/words.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace relievo::firmware {
namespace {

using ui::TechnicianTable;
using Heads = std::span<const std::string_view>;

// Symbols and units: the same in every language.
constexpr std::array<std::string_view, 8> kMatches{"n",    "x₁ px", "y₁ px", "x₂ px",
                                                   "d px", "σ px",  "1 − ρ", "×"};
constexpr std::array<std::string_view, 7> kPoints{"n", "X mm", "Y mm", "Z mm", "σ mm", "x₁ px", "y₁ px"};
constexpr std::array<std::string_view, 8> kModel{"n", "X mm", "Y mm", "Z mm", "x", "y", "z", "σ mm"};
constexpr std::array<std::string_view, 6> kPoses{"n", "1 – 2", "°", "cm²", "rms mm", "95 % mm"};
constexpr std::array<std::string_view, 4> kCalibration{"", "1", "2", "1 → 2"};

// In the order of TechnicianTable.
constexpr std::array<Heads, ui::kTechnicianTables> kHeads{kMatches, kPoints, kModel, kPoses, kCalibration};
static_assert(!kHeads.back().empty());

std::size_t rows_of(TechnicianTable table, const TechnicianTables::Source& from) {
  if (table == TechnicianTable::Calibration) return from.calibration != nullptr ? kTableRows : 0;
  const Products* products = from.products;
  if (products == nullptr) return 0;
  if (table == TechnicianTable::Matches) return products->matches ? products->matches->matches.size() : 0;
  if (table == TechnicianTable::Poses) {
    const std::size_t poses = products->registration ? products->registration->poses.size() : 0;
    return poses == 0 ? 0 : poses * (poses - 1) / 2;  // each with each
  }
  if (table == TechnicianTable::Points) return products->cloud ? products->cloud->points.size() : 0;
  return products->model ? products->model->mesh.vertices_mm.size() : 0;
}

}  // namespace

void TechnicianTables::show(TechnicianTable table, const Source& from) {
  table_ = table;
  walk_.begin_anew();
  refresh(from);
}

void TechnicianTables::ask(const ui::ListRequest& request, const Source& from) {
  const ListWalk::Ask asked = walk_.ask(request);
  if (asked == ListWalk::Ask::Rows) return refresh(from);
  if (asked != ListWalk::Ask::Labels) return;
  walk_.label_each([&](std::size_t top) { return label_of(from, top); });
}

void TechnicianTables::refresh(const Source& from) {
  select(from);
  fill(from);
}

// Of matches: those that were accepted (filter 1), or rejected by the rule that took them first.
void TechnicianTables::select(const Source& from) {
  selected_.clear();
  std::size_t rows = rows_of(table_, from);
  const std::size_t filter = walk_.filter();
  if (table_ == TechnicianTable::Matches && filter > 0) {
    for (std::size_t row = 0; row < rows; ++row) {
      const auto rejected = from.products->matches->matches[row].rejected_by;
      const std::size_t passes = rejected == 0 ? 1 : 2 + std::size_t(std::countr_zero(rejected));
      if (passes == filter) selected_.push_back(std::uint32_t(row));
    }
    rows = selected_.size();
  }
  walk_.set_rows(std::int64_t(table_ == TechnicianTable::Calibration ? std::min(rows, kTableRows) : rows));
}

void TechnicianTables::forget() {
  texts_.clear();
  cells_.clear();
  selected_.clear();
  walk_.begin_anew();
  walk_.set_rows(0);
  box_ = {};
}

void TechnicianTables::cell(const char* format, double value) { texts_.push_back(printed(format, value)); }

void TechnicianTables::fill(const Source& from) {
  texts_.clear();
  if (table_ == TechnicianTable::Calibration) {
    if (from.calibration != nullptr) fill_calibration(*from.calibration);
  } else {
    for (std::int64_t row = walk_.first_row(); row < walk_.end_row(); ++row) fill_row(from, std::size_t(row));
  }
  cells_.assign(texts_.begin(), texts_.end());
}

void TechnicianTables::fill_row(const Source& from, std::size_t row) {
  if (!selected_.empty()) row = selected_[row];
  cell("%.0f", double(row + 1));
  if (table_ == TechnicianTable::Matches) fill_matches(from, row);
  if (table_ == TechnicianTable::Points) fill_points(*from.products->cloud, row);
  if (table_ == TechnicianTable::Model) fill_model(*from.products->model, row);
  if (table_ == TechnicianTable::Poses) fill_poses(*from.products->registration, row);
}

// Its number and its place.
std::string TechnicianTables::label_of(const Source& from, std::size_t row) {
  constexpr std::size_t kTold = 3;
  std::vector<std::string> shown = std::move(texts_);
  texts_.clear();
  fill_row(from, row);
  std::string label;
  for (std::size_t i = 0; i < std::min(kTold, texts_.size()); ++i) label += (i == 0 ? "" : " ") + texts_[i];
  texts_ = std::move(shown);
  return label;
}

void TechnicianTables::fill_matches(const Source& from, std::size_t row) {
  const pipeline::Match& m = from.products->matches->matches[row];
  for (const float v : {m.left_px.x, m.left_px.y}) cell("%.2f", v);
  for (const float v : {m.left_px.x - m.disparity_px, m.disparity_px, m.sigma_px, m.cost}) cell("%.3f", v);
  word(from.figures.rule_of(m));
}

void TechnicianTables::fill_points(const pipeline::PointCloud& cloud, std::size_t row) {
  const pipeline::CloudPoint& p = cloud.points[row];
  for (const float v : {p.at_mm.x, p.at_mm.y, p.at_mm.z, p.sigma_mm}) cell("%.3f", v);
  for (const float v : {p.left_px.x, p.left_px.y}) cell("%.2f", v);
}

void TechnicianTables::fill_model(const pipeline::FaceModel& model, std::size_t row) {
  const auto in_head = [&](std::size_t i) {
    const pipeline::Vec3f& v = model.mesh.vertices_mm[i];
    return apply(model.head_from_camera, pipeline::Vec3d{v.x, v.y, v.z});
  };
  if (box_.of != &model || box_.half <= 0) {
    constexpr double kFar = std::numeric_limits<double>::max();
    pipeline::Vec3d low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};
    for (std::size_t i = 0; i < model.mesh.vertices_mm.size(); ++i) {
      const pipeline::Vec3d p = in_head(i);
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    box_ = {{(low.x + high.x) / 2, (low.y + high.y) / 2, (low.z + high.z) / 2},
            std::max({high.x - low.x, high.y - low.y, high.z - low.z, 1e-9}) / 2,
            &model};
  }
  const pipeline::Vec3d p = in_head(row);
  for (const double v : {p.x, p.y, p.z}) cell("%.3f", v);
  for (const double v : {p.x - box_.middle.x, p.y - box_.middle.y, p.z - box_.middle.z})
    cell("%.4f", v / box_.half);
  if (model.mesh.measured[row] != 0) cell("%.3f", model.mesh.sigma_mm[row]);
  else word("–");
}

// Who agrees with whom.
void TechnicianTables::fill_poses(const pipeline::Registration& registration, std::size_t row) {
  std::size_t b = 1;
  for (; row >= b; ++b) row -= b;
  const pipeline::RegisteredPose &one = registration.poses[row], &other = registration.poses[b];
  const pipeline::PoseMeeting& meeting = one.meets[b];
  word(std::to_string(row + 1) + " – " + std::to_string(b + 1));
  cell("%.1f", pipeline::turned_deg(
                   product(transposed(one.first_from_pose.rotation), other.first_from_pose.rotation)));
  if (meeting.overlap_mm2 <= 0) {
    for (int i = 0; i < 3; ++i) word("–");
    return;
  }
  cell("%.1f", meeting.overlap_mm2 / 100);
  cell("%.3f", meeting.rms_mm);
  cell("%.3f", meeting.p95_mm);
}

void TechnicianTables::fill_calibration(const pipeline::StereoCalibration& c) {
  const auto line = [this](std::string_view name, const char* format, double left, double right,
                           std::string_view third) {
    word(name);
    cell(format, left);
    cell(format, right);
    word(third);
  };
  std::array<std::string, kTableRows> text;
  const auto& r = c.right_from_left.rotation.m;
  const auto& t = c.right_from_left.translation_mm;
  for (std::size_t i = 0; i < 3; ++i)
    text[i] = printed("R  %+.5f  %+.5f  %+.5f", r[3 * i], r[3 * i + 1], r[3 * i + 2]);
  text[3] = printed("t  %+.3f  %+.3f  %+.3f mm", t.x, t.y, t.z);
  text[4] = printed("rms  %.3f px", c.rms_px);
  text[5] = printed("№  %u", c.revision);
  line("fx px", "%.3f", c.left.focal_px.x, c.right.focal_px.x, text[0]);
  line("fy px", "%.3f", c.left.focal_px.y, c.right.focal_px.y, text[1]);
  line("cx px", "%.3f", c.left.centre_px.x, c.right.centre_px.x, text[2]);
  line("cy px", "%.3f", c.left.centre_px.y, c.right.centre_px.y, text[3]);
  const char* const names[] = {"k₁", "k₂", "p₁", "p₂", "k₃"};
  for (std::size_t i = 0; i < 5; ++i)
    line(names[i], "%+.6f", c.left.distortion[i], c.right.distortion[i], text[4 + i]);
  word("px");
  for (const auto* camera : {&c.left, &c.right})
    word(printed("%d × %d", camera->width_px, camera->height_px));
  word("");
}

ui::TechnicianRows TechnicianTables::view() const {
  ui::TechnicianRows view;
  view.table = table_;
  view.heads = kHeads.at(std::size_t(table_));
  view.cells = cells_;
  view.place = walk_.view();
  return view;
}

}  // namespace relievo::firmware
