// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/technician/show/technician_figures.h"

#include <algorithm>
#include <bit>

#include "firmware/compare/page/maps.h"
#include "firmware/measure/match_figures.h"

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

}  // namespace relievo::firmware
