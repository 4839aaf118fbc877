// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/technician/calibration_controller.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "firmware/base/wall_time.h"
#include "firmware/calibrate/calibration_history.h"
#include "firmware/technician/calibration_stick.h"

namespace relievo::firmware {
namespace {

constexpr int kLeastCorners = 3, kMostCorners = 30;
constexpr double kLeastSquareMm = 4, kMostSquareMm = 100;

ui::TechnicianVerdict verdict_of(pipeline::CalibrationVerdict verdict) {
  switch (verdict) {
    case pipeline::CalibrationVerdict::Pass:
      return ui::TechnicianVerdict::Good;
    case pipeline::CalibrationVerdict::Usable:
      return ui::TechnicianVerdict::Warn;
    case pipeline::CalibrationVerdict::Refuse:
      break;
  }
  return ui::TechnicianVerdict::Refuse;
}

}  // namespace

void CalibrationController::act(const ui::TechnicianRequest& request) {
  if (running_) return;
  if (const auto* change = std::get_if<ui::ChangeBoard>(&request)) change_board(*change);
  if (const auto* use = std::get_if<ui::UseCalibration>(&request)) activate(use->row);
  const auto* alone = std::get_if<ui::DoTechnician>(&request);
  if (alone == nullptr) return;
  if (alone->act == ui::TechnicianAct::SwitchCharuco) board_.charuco = !board_.charuco;
  if (alone->act == ui::TechnicianAct::StoreCalibration) store();
  if (alone->act == ui::TechnicianAct::ExportCalibration) export_in_use();
  if (alone->act == ui::TechnicianAct::ImportCalibration) import_one();
}

void CalibrationController::change_board(const ui::ChangeBoard& change) {
  switch (change.measure) {
    case ui::BoardMeasure::Columns:
      board_.corners_across = std::clamp(board_.corners_across + change.step, kLeastCorners, kMostCorners);
      return;
    case ui::BoardMeasure::Rows:
      board_.corners_down = std::clamp(board_.corners_down + change.step, kLeastCorners, kMostCorners);
      return;
    case ui::BoardMeasure::Square:
      board_.square_mm =
          std::clamp(std::round(10 * board_.square_mm + change.step) / 10, kLeastSquareMm, kMostSquareMm);
      return;
  }
}

CalibrateJob::Order CalibrationController::order() const {
  CalibrateJob::Order order;
  order.board = board_;
  if (const auto* in_use = parts_.stages.calibration()) order.in_use = *in_use;
  return order;
}

void CalibrationController::begun() {
  running_ = true;
  ended_ = stored_ = false;
  reasons_.clear();
  problem_ = {};
}

void CalibrationController::ended() {
  running_ = false;
  const Result<void>& outcome = parts_.job.outcome();
  if (!outcome) {
    if (outcome.error().code != Errc::Cancelled) problem_ = ui::fault_of(outcome.error());
    return;
  }
  ended_ = parts_.job.result().has_value();
  if (!ended_) return;
  reasons_ = parts_.job.result()->quality.reasons;
}

void CalibrationController::load_history() {
  exported_.clear();
  const auto rows = std::make_shared<std::vector<Row>>();
  parts_.side_tasks.send(
      JobLane::Keeper,
      [this, rows](JobControl&) -> Result<void> {
        RELIEVO_TRY_ASSIGN(auto all, parts_.store.calibrations());
        for (auto& info : all) {
          std::string made_at = text_of(info.created_at);
          rows->push_back({std::move(info), std::move(made_at)});
        }
        return {};
      },
      [this, rows](const std::optional<Error>& error) {
        if (error) problem_ = ui::fault_of(*error);
        else history_.swap(*rows);
      });
}

void CalibrationController::adopt(std::function<Result<std::uint32_t>()> first) {
  if (busy_) return;
  busy_ = true;
  struct Made {
    std::uint32_t revision = 0;
    std::optional<pipeline::Pipeline> pipeline;
  };
  const auto made = std::make_shared<Made>();
  parts_.side_tasks.send(
      JobLane::Keeper,
      [this, made, first = std::move(first)](JobControl&) -> Result<void> {
        RELIEVO_TRY_ASSIGN(made->revision, first());
        RELIEVO_TRY_ASSIGN(const auto calibration, parts_.store.calibration(made->revision));
        RELIEVO_TRY_ASSIGN(made->pipeline, pipeline::Pipeline::make(parts_.stages.algorithms(), calibration));
        return {};
      },
      [this, made](const std::optional<Error>& error) {
        busy_ = false;
        problem_ = error ? ui::fault_of(*error) : ui::Fault{};
        if (error) return;
        parts_.stages.replace(*std::move(made->pipeline));
        parts_.in_use(*parts_.stages.calibration());
        load_history();
      });
}

void CalibrationController::store() {
  if (!ended_ || stored_ || !parts_.job.result() ||
      parts_.job.result()->quality.verdict == pipeline::CalibrationVerdict::Refuse || busy_)
    return;
  stored_ = true;
  const pipeline::CalibratorOutput result = *parts_.job.result();
  adopt([this, result]() -> Result<std::uint32_t> {
    return parts_.store.save_calibration(result.calibration, "calibrated at the screen",
                                         figures_of(result.quality));
  });
}

void CalibrationController::activate(std::size_t row) {
  if (row >= history_.size() || history_[row].info.active) return;
  const std::uint32_t revision = history_[row].info.revision;
  adopt([this, revision]() -> Result<std::uint32_t> {
    RELIEVO_TRY(parts_.store.activate_calibration(revision));
    return revision;
  });
}

void CalibrationController::export_in_use() {
  const pipeline::StereoCalibration* in_use = parts_.stages.calibration();
  if (busy_ || in_use == nullptr) return;
  busy_ = true;
  exported_.clear();
  char name[24];
  std::snprintf(name, sizeof name, "%04u",
                static_cast<unsigned>(in_use->revision));  // so that their names have their order
  const std::string folder = name;
  parts_.side_tasks.send(
      JobLane::Keeper,
      [this, calibration = *in_use, folder](JobControl&) {
        return export_calibration(calibration, folder, parts_.media);
      },
      [this, folder](const std::optional<Error>& error) {
        busy_ = false;
        problem_ = error ? ui::fault_of(*error) : ui::Fault{};
        if (!error) exported_ = std::string(kCalibrationsFolder) + "/" + folder;
      });
}

void CalibrationController::import_one() {
  adopt([this]() -> Result<std::uint32_t> {
    RELIEVO_TRY_ASSIGN(const StickCalibration found, import_calibration(parts_.media));
    return parts_.store.save_calibration(found.calibration, "imported from " + found.file);
  });
}

ui::TechnicianCalibration CalibrationController::view() {
  ui::TechnicianCalibration view = parts_.job.newest();
  view.columns = board_.corners_across;
  view.rows = board_.corners_down;
  view.square_mm = static_cast<float>(board_.square_mm);
  view.charuco = board_.charuco;
  view.running = running_;
  view.ended = ended_;
  view.stored = stored_;
  view.reasons = reasons_;
  view.problem = problem_;
  view.exported = exported_;
  if (ended_) {
    const pipeline::CalibrationQuality& q = parts_.job.result()->quality;
    view.verdict = verdict_of(q.verdict);
    view.depth_error_mm = static_cast<float>(q.face_depth_sigma_mm);
    view.rms_px = static_cast<float>(q.pair_rms_px);
    view.baseline_mm = static_cast<float>(q.baseline_mm);
  }
  view.history_count = std::min(history_.size(), view.history.size());
  for (std::size_t i = 0; i < view.history_count; ++i) {
    const storage::CalibrationInfo& info = history_[i].info;
    view.history[i] = {info.revision,
                       info.active,
                       history_[i].made_at,
                       info.note,
                       static_cast<float>(info.rms_px),
                       static_cast<float>(info.figures.depth_sigma_mm)};
  }
  return view;
}

void CalibrationController::forget() {
  parts_.job.wipe();
  running_ = ended_ = stored_ = busy_ = false;
  history_.clear();
  exported_.clear();
}

}  // namespace relievo::firmware
