// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/technician/show/technician_figures.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "firmware/compare/page/maps.h"
#include "firmware/measure/comparison.h"
#include "pipeline/match/window/window_correlation.h"

namespace relievo::firmware {

// What differs from the default, one "key = value" a line.
static std::string difference_of(const pipeline::AlgorithmSet& set) {
  std::string text;
  for (const pipeline::OptionDescription& option : pipeline::describe_algorithms()) {
    const std::string value = set.get(option.key);
    if (value == option.value) continue;
    if (!text.empty()) text += '\n';
    text += option.key + " = " + value;
  }
  return text;
}

std::array<float, ui::kSigmaBins> sigma_percent(const pipeline::FaceMesh& mesh) {
  std::array<float, ui::kSigmaBins> share{};
  float measured = 0;
  for (std::size_t i = 0; i < std::min(mesh.sigma_mm.size(), mesh.measured.size()); ++i) {
    if (mesh.measured[i] == 0) continue;
    const float bin = std::clamp(mesh.sigma_mm[i] / ui::kSigmaBinMm, 0.0F, ui::kSigmaBins - 1.0F);
    ++share[std::size_t(bin)], ++measured;
  }
  for (float& one : share) one *= measured > 0 ? 100 / measured : 0;
  return share;
}

void TechnicianFigures::begin(const pipeline::AlgorithmSet& set, const std::string& name) {
  forget();
  name_ = name;
  set_ = set;
  result_.there = true;
  difference_ = difference_of(set);
}

void TechnicianFigures::add(const StageRecord& record) {
  if (stages_ == result_.seconds.size()) return;
  result_.seconds[stages_] = std::chrono::duration<float>(record.took).count();
  result_.made[stages_++] = record.out;
  result_.arena_peak_mib =
      std::max(result_.arena_peak_mib, float(record.arena_peak_bytes) / float(budget::kMiB));
}

void TechnicianFigures::fail(State stage, const Error& error) {
  failure_ = ui::fault_of(error);
  result_.failed_at = number_of(stage);
}

Result<void> TechnicianFigures::measure(const Products& products, pipeline::StageContext& context) {
  if (!products.pair || !products.matches) return {};
  const pipeline::Keypoints nothing(&context.scratch);
  const compare::MatchFigures figures =
      compare::figures_of({"", set_}, nothing, *products.matches, std::nullopt, 1);
  result_.matches = figures.matches;
  result_.accepted = figures.accepted;
  result_.rule_count = std::min(figures.rules.size(), ui::kTechnicianRules);
  rules_.clear();
  for (std::size_t i = 0; i < result_.rule_count; ++i) {
    rules_.push_back(figures.rules[i].name);
    result_.rules[i].rejected = figures.rules[i].rejected;
    result_.rules[i].rgb = compare::rule_colour(i);
  }
  if (products.matches->epipolar_shift.measured())
    result_.epipolar_px = float(products.matches->epipolar_shift.residual_px);
  if (!products.model) return {};
  result_.median_sigma_mm = float(products.model->quality.median_sigma_mm);
  result_.sigma_percent = sigma_percent(products.model->mesh);
  result_.coverage = float(products.model->quality.coverage);
  return pipeline::run_stage(context, [&](pipeline::StageContext& c) -> Result<void> {
    Arena::Mark mark(c.output);
    const auto photo =
        compare::photo_figures(*products.pair, compare::model_view(*products.pair, products.model->mesh), c);
    result_.photo_correlation = float(photo.median);
    result_.photo_windows = photo.asked;
    return {};
  });
}

std::string_view TechnicianFigures::rule_of(const pipeline::Match& match) const {
  const auto rule = std::size_t(std::countr_zero(match.rejected_by));
  return match.rejected_by == 0 ? "" : rule < rules_.size() ? std::string_view(rules_[rule]) : "?";
}

ui::TechnicianResult TechnicianFigures::view() const {
  ui::TechnicianResult view = result_;
  view.name = name_;
  view.algorithms = difference_;
  view.failure = failure_;
  for (std::size_t i = 0; i < rules_.size(); ++i) view.rules[i].name = rules_[i];
  return view;
}

namespace {

constexpr float kFingerShare = 0.02F;  // of the picture's width: what a finger may miss a place by
constexpr int kRadiusPx = 7;           // of the windows
constexpr float kMostUnlike = 0.5F;    // cost beyond which the finger is believed, not the windows
constexpr float kFingerSigmaPx = 1;

float pixel_at(float share, int pixels) { return std::clamp(share * float(pixels), 0.0F, float(pixels - 1)); }

void place(const pipeline::RectifiedPair& pair, ui::TechnicianPoint& point) {
  point.right_px = {point.left_px.x - point.disparity_px, point.left_px.y};
  point.left_x = point.left_px.x / float(pair.width_px);
  point.right_x = point.right_px.x / float(pair.width_px);
  point.y = point.left_px.y / float(pair.height_px);
}

// As RectifiedPair says it.
void reconstruct(const pipeline::RectifiedPair& pair, ui::TechnicianPoint& point) {
  const double z = pair.depth_mm(point.disparity_px);
  if (!std::isfinite(z) || z <= 0) return;
  const double across = (point.left_px.x - pair.left_centre_px.x) / pair.focal_px,
               down = (point.left_px.y - pair.left_centre_px.y) / pair.focal_px;
  const pipeline::Vec3d p =
      apply(transposed(pair.rectified_from_left), pipeline::Vec3d{across * z, down * z, z});
  point.at_mm = {float(p.x), float(p.y), float(p.z)};
  const double slant = std::sqrt(1 + across * across + down * down);
  point.sigma_mm = float(z * z / (pair.focal_px * pair.baseline_mm) * point.sigma_px * slant);
}

// A place without a match.
ui::TechnicianPoint point_at(const pipeline::RectifiedPair& pair, float x, float y) {
  ui::TechnicianPoint point;
  point.touched = true;
  point.left_px = {pixel_at(x, pair.width_px), pixel_at(y, pair.height_px)};
  place(pair, point);
  return point;
}

// The point is this match's.
void set_match(const pipeline::RectifiedPair& pair, const pipeline::Match& match,
               ui::TechnicianPoint& point) {
  point.matched = true;
  point.left_px = match.left_px;
  point.disparity_px = match.disparity_px;
  point.sigma_px = match.sigma_px;
  point.cost = match.cost;
  place(pair, point);
  reconstruct(pair, point);
}

std::optional<pipeline::Match> alike(const pipeline::RectifiedPair& pair, pipeline::Vec2f left_px,
                                     double least, double most) {
  auto found = pipeline::match_on_row(pair, left_px, least, most, kRadiusPx);
  const bool taken = found && found->cost <= kMostUnlike && found->disparity_px <= left_px.x &&
                     left_px.x - found->disparity_px <= float(pair.width_px - 1);
  return taken ? found : std::nullopt;
}

ui::TechnicianPoint begun(const pipeline::RectifiedPair& pair, float x, float y) {
  ui::TechnicianPoint point = point_at(pair, x, y);
  point.by_hand = point.waits_for_right = true;
  return point;
}

}  // namespace

ui::TechnicianPoint nearest_match(const pipeline::RectifiedPair& pair, const pipeline::MatchSet& matches,
                                  const TechnicianFigures& figures, float x, float y) {
  ui::TechnicianPoint point = point_at(pair, x, y);
  const float reach = kFingerShare * float(pair.width_px);
  float best = reach * reach;
  const pipeline::Match* nearest = nullptr;
  for (const pipeline::Match& m : matches.matches) {
    const float dx = m.left_px.x - point.left_px.x, dy = m.left_px.y - point.left_px.y, d = dx * dx + dy * dy;
    if (d >= best) continue;
    best = d;
    nearest = &m;
  }
  if (nearest == nullptr) return point;
  set_match(pair, *nearest, point);
  point.rejected_by = figures.rule_of(*nearest);
  return point;
}

void HandPairs::touch(const pipeline::RectifiedPair& pair, bool left, float x, float y) {
  const float high = float(pair.height_px) / float(pair.width_px);
  float nearest = kFingerShare;
  std::size_t held = points_.size();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const ui::TechnicianPoint& p = points_[i];
    if (!left && !p.matched) continue;
    const float off = std::hypot((left ? p.left_x : p.right_x) - x, (p.y - y) * high);
    if (off < nearest) nearest = off, held = i;
  }
  if (held < points_.size()) {
    chosen_ = held;
  } else if (!left) {
    move_right(pair, x);
  } else if (points_.size() < ui::kMostPairs) {
    chosen_ = points_.size();
    points_.push_back(begun(pair, x, y));
    move_left(pair, x, y);
  }
}

void HandPairs::drag(const pipeline::RectifiedPair& pair, bool left, float x, float y) {
  if (chosen_ >= points_.size()) return;
  if (left) move_left(pair, x, y);
  else move_right(pair, x);
}

void HandPairs::remove() {
  if (chosen_ >= points_.size()) return;
  points_.erase(points_.begin() + std::ptrdiff_t(chosen_));
  chosen_ -= chosen_ > 0 ? 1 : 0;
  changed_ = true;
}

// The partner is looked for where it was, else on all of the row.
void HandPairs::move_left(const pipeline::RectifiedPair& pair, float x, float y) {
  const ui::TechnicianPoint before = points_[chosen_];
  ui::TechnicianPoint& point = points_[chosen_] = begun(pair, x, y);
  changed_ = true;
  std::optional<pipeline::Match> found;
  if (before.matched) {
    const double reach = double(kFingerShare) * pair.width_px, was = double(before.disparity_px);
    found = alike(pair, point.left_px, was - reach, was + reach);
  }
  const pipeline::CandidateRange range = pipeline::disparity_range(pair);
  if (!found) found = alike(pair, point.left_px, range.first, range.last);
  if (!found) return;
  set_match(pair, *found, point);
  point.waits_for_right = false;
}

void HandPairs::move_right(const pipeline::RectifiedPair& pair, float x) {
  if (chosen_ >= points_.size()) return;
  const pipeline::Vec2f left_px = points_[chosen_].left_px;
  const double reach = double(kFingerShare) * pair.width_px,
               said = double(left_px.x - pixel_at(x, pair.width_px));
  const auto found = alike(pair, left_px, said - reach, said + reach);
  const auto disparity = float(said);
  ui::TechnicianPoint point;
  point.touched = point.by_hand = true;
  set_match(
      pair,
      found.value_or(pipeline::Match{
          left_px, disparity, pipeline::window_cost(pair, left_px, disparity, kRadiusPx), kFingerSigmaPx, 0}),
      point);
  points_[chosen_] = point;
  changed_ = true;
}

void HandPairs::show(const pipeline::RectifiedPair& pair, std::span<const pipeline::Match> matches) {
  points_.clear();
  changed_ = false;
  for (pipeline::Match match : matches) {
    match.cost = pipeline::window_cost(pair, match.left_px, match.disparity_px, kRadiusPx);
    ui::TechnicianPoint& point = points_.emplace_back();
    point.touched = point.by_hand = true;
    set_match(pair, match, point);
  }
  chosen_ = std::min(chosen_, points_.empty() ? 0 : points_.size() - 1);
}

std::vector<pipeline::Match> HandPairs::matches() const {
  std::vector<pipeline::Match> all;
  for (const ui::TechnicianPoint& p : points_)
    if (p.matched) all.push_back({p.left_px, p.disparity_px, 0, p.sigma_px, 0});
  return all;
}

}  // namespace relievo::firmware
