// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cmath>
#include <numbers>
#include <span>

#include <nlohmann/json.hpp>

#include "firmware/arguments/algorithm_choice.h"
#include "firmware/base/version.h"
#include "firmware/report/report.h"
#include "hal/base/words.h"
#include "storage/model_blob.h"

namespace relievo::firmware {
namespace {

constexpr double kWorthSayingPx = 0.1;  // less is within what matching follows, and no advice makes it better
constexpr double kWorthSayingShare = 0.02;  // a shine on the nose is less

// Of the registration: of the worst of three axes.
double worst_sigma(const pipeline::RegisteredPose& pose, std::size_t from) {
  const auto& c = pose.covariance;
  return std::sqrt(std::max({c[7 * from], c[7 * (from + 1)], c[7 * (from + 2)]}));
}
double sigma_deg(const pipeline::RegisteredPose& pose) {
  return worst_sigma(pose, 0) * 180 / std::numbers::pi;
}
double sigma_mm(const pipeline::RegisteredPose& pose) { return worst_sigma(pose, 3); }

double milliseconds_of(std::chrono::nanoseconds time) { return double(time.count()) * 1e-6; }

nlohmann::ordered_json drift_json(const std::optional<pipeline::DriftJudgement>& drift) {
  if (!drift) return nullptr;
  return {{"verdict", word(drift->verdict)},  {"residual_px", drift->residual_px},
          {"sigma_px", drift->sigma_px},      {"offset_px", drift->offset_px},
          {"slope_x", drift->slope_x},        {"slope_y", drift->slope_y},
          {"expected_px", drift->expected_px}};
}

nlohmann::ordered_json quality_json(const pipeline::ModelQuality& quality) {
  nlohmann::ordered_json all;
  for (const storage::QualityFigure& figure : storage::kQualityFigures) all[figure.name] = quality.*figure.of;
  const pipeline::ReliefFigures& r = quality.relief;
  all["relief"] = {{"covered", r.covered},
                   {"sigma_mm", r.sigma_mm},
                   {"off_plane_mm", r.off_plane_mm},
                   {"off_sheet_mm", r.off_sheet_mm},
                   {"sheet_range_mm", r.sheet_range_mm},
                   {"curvature_sr", r.curvature_sr}};
  return all;
}

// In the head frame, whatever frame the files are in.
nlohmann::ordered_json landmarks_json(const Report& report) {
  auto all = nlohmann::ordered_json::object();
  for (std::size_t k = 0; k < pipeline::kLandmarkCount; ++k) {
    const pipeline::Landmark& l = report.landmarks[k];
    const std::string name(word(static_cast<pipeline::LandmarkName>(k)));
    all[name] = nullptr;
    if (!l.found) continue;
    const pipeline::Vec3d at = apply(report.head_from_camera, {l.at_mm.x, l.at_mm.y, l.at_mm.z});
    all[name] = {{"at_mm", {at.x, at.y, at.z}}, {"sigma_mm", l.sigma_mm}};
  }
  return all;
}

nlohmann::ordered_json poses_json(const std::vector<pipeline::RegisteredPose>& poses) {
  auto all = nlohmann::ordered_json::array();
  for (const pipeline::RegisteredPose& pose : poses) {
    const auto& [rotation, moved] = pose.first_from_pose;
    auto meets = nlohmann::ordered_json::array();
    for (const pipeline::PoseMeeting& m : std::span(pose.meets).first(poses.size()))
      meets.push_back({{"overlap_mm2", m.overlap_mm2}, {"rms_mm", m.rms_mm}, {"p95_mm", m.p95_mm}});
    all.push_back({{"joined", pose.joined},
                   {"turned_deg", pipeline::turned_deg(rotation)},
                   {"rotation", rotation.m},
                   {"translation_mm", {moved.x, moved.y, moved.z}},
                   {"rms_mm", pose.rms_mm},
                   {"sigma_deg", sigma_deg(pose)},
                   {"sigma_mm", sigma_mm(pose)},
                   {"meets", meets}});
  }
  return all;
}

nlohmann::ordered_json aliveness_json(const Report& report) {
  if (!report.aliveness) return nullptr;
  const auto value = [](const std::optional<double>& v) {
    return v ? nlohmann::ordered_json(*v) : nlohmann::ordered_json();
  };
  constexpr std::array kVerdicts{"alive", "not alive", "unjudged"};
  return {{"verdict", kVerdicts.at(std::size_t(report.aliveness->verdict()))},
          {"eyes_follow", value(report.aliveness->eyes_follow)},
          {"iris_contrast", value(report.aliveness->iris_contrast)},
          {"skin_moved_mm", report.skin_moved_mm}};
}

}  // namespace

std::string line_of(const StageRecord& stage) {
  return printed("%-12.*s %8.0f ms %10" PRIu64 " -> %" PRIu64, int(stage.name.size()), stage.name.data(),
                 double(stage.took.count()) * 1e-6, stage.in, stage.out);
}

std::string line_of(std::size_t pair, const pipeline::RegisteredPose& pose) {
  if (!pose.joined)
    return printed("Pair %-7zu left out: it meets none of the others, or the skin moved by more than 1.5 mm",
                   pair);
  return printed(
      "Pair %-7zu turned by %.1f degrees, %.3f mm rms from the others; placed to %.3f degrees, %.3f mm", pair,
      pipeline::turned_deg(pose.first_from_pose.rotation), pose.rms_mm, sigma_deg(pose), sigma_mm(pose));
}

std::string line_of(const pipeline::DriftJudgement& drift) {
  return "Calibration  " + std::string(word(drift.verdict)) + ": " + sentence(drift);
}

std::string line_of_motion(double motion_px) {
  if (motion_px < kWorthSayingPx) return {};
  return printed(
      "Motion       the face moved between the two exposures, %.2f px rms: what moved is less certain. "
      "Hold still, or expose both cameras together",
      motion_px);
}

std::string line_of_light(const pipeline::Overexposure& white) {
  const bool left = white.left >= white.right;
  const double share = left ? white.left : white.right;
  if (share < kWorthSayingShare) return {};
  return printed(
      "Light        %.0f %% of the face is white in the %s picture and cannot be measured there: less light, or a shorter exposure",
      100 * share, left ? "left" : "right");
}

std::uint64_t peak_rss_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::uint64_t(usage.ru_maxrss) * 1024;
}

std::string report_json(const Report& report) {
  using Json = nlohmann::ordered_json;
  Json stages = Json::array();
  for (const StageRecord& stage : report.stages) {
    stages.push_back({{"name", stage.name},
                      {"ms", milliseconds_of(stage.took)},
                      {"in", stage.in},
                      {"out", stage.out},
                      {"arena_peak_bytes", stage.arena_peak_bytes}});
  }
  const Json json{
      {"version", kVersion},
      {"calibration", report.calibration},
      {"algorithms", choices_in(report.algorithms)},
      {"stages", stages},
      {"matches_by_hand", report.by_hand},
      {"total_ms", milliseconds_of(report.total)},
      {"peak_rss_bytes", report.peak_rss_bytes},
      {"quality", quality_json(report.quality)},
      {"landmarks", landmarks_json(report)},
      {"poses", poses_json(report.poses)},
      {"aliveness", aliveness_json(report)},
      {"motion_px", report.motion_px ? Json(*report.motion_px) : Json()},
      {"overexposed",
       report.white ? Json{{"left", report.white->left}, {"right", report.white->right}} : Json()},
      {"drift", drift_json(report.drift)}};
  // A path may hold bytes that are no UTF-8: they are replaced, never thrown about.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace relievo::firmware
