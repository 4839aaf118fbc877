// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/technician/test_capture.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "firmware/base/wall_time.h"
#include "firmware/reconstruct/reconstruction.h"
#include "firmware/technician/stick_files.h"

namespace relievo::firmware {
namespace {

constexpr int kLeastCorners = 3, kMostCorners = 30;
constexpr double kLeastSquareMm = 4, kMostSquareMm = 100;

}  // namespace

void CalibrationController::act(const ui::TechnicianRequest& request) {
  if (running_) return;
  if (const auto* change = std::get_if<ui::ChangeBoard>(&request)) change_board(*change);
  if (const auto* use = std::get_if<ui::UseCalibration>(&request)) activate(use->index);
  const auto* alone = std::get_if<ui::TechnicianAct>(&request);
  if (alone == nullptr) return;
  if (*alone == ui::TechnicianAct::SwitchCharuco) board_.charuco = !board_.charuco;
  if (*alone == ui::TechnicianAct::SwitchMountedAnew) mounted_anew_ = !mounted_anew_;
  if (*alone == ui::TechnicianAct::StoreCalibration) store();
  if (*alone == ui::TechnicianAct::ExportCalibration) export_in_use();
  if (*alone == ui::TechnicianAct::ImportCalibration) import_one();
}

void CalibrationController::change_board(const ui::ChangeBoard& change) {
  if (change.measure == ui::BoardMeasure::Square) {
    board_.square_mm =
        std::clamp(std::round(10 * board_.square_mm + change.step) / 10, kLeastSquareMm, kMostSquareMm);
    return;
  }
  int& corners = change.measure == ui::BoardMeasure::Columns ? board_.corners_across : board_.corners_down;
  corners = std::clamp(corners + change.step, kLeastCorners, kMostCorners);
}

CalibrateJob::Order CalibrationController::order() const {
  CalibrateJob::Order order;
  order.board = board_;
  const auto* in_use = parts_.stages.calibration();
  if (in_use != nullptr && !mounted_anew_) order.in_use = *in_use;
  return order;
}

void CalibrationController::begun() {
  ++runs_;
  running_ = true;
  ended_ = stored_ = false;
  reasons_.clear();
  views_px_.clear();
  problem_ = {};
}

void CalibrationController::ended() {
  running_ = false;
  const Result<void>& outcome = job_.outcome();
  if (!outcome) {
    if (outcome.error().code != Errc::Cancelled) problem_ = ui::fault_of(outcome.error());
    return;
  }
  ended_ = job_.result().has_value();
  if (!ended_) return;
  if (ui::Fault trouble = job_.newest().problem; !trouble.empty()) problem_ = std::move(trouble);
  const pipeline::CalibrationQuality& quality = job_.result()->quality;
  reasons_ = quality.reasons;
  for (const pipeline::ViewQuality& view : quality.views)
    if (view.used)
      views_px_.push_back(float(std::hypot(view.left_rms_px, view.right_rms_px) / std::sqrt(2.0)));
}

void CalibrationController::load_history() {
  exported_.clear();
  using Rows = std::vector<Row>;
  parts_.side_tasks.ask(
      JobLane::Keeper,
      [this](JobControl&) -> Result<Rows> {
        RELIEVO_TRY_ASSIGN(const auto all, parts_.store.calibrations());
        Rows rows;
        for (const storage::CalibrationInfo& info : all) rows.push_back({info, text_of(info.created_at)});
        return rows;
      },
      [this](Result<Rows> rows) {
        if (rows) history_ = *std::move(rows);
        else problem_ = ui::fault_of(rows.error());
        walk_.set_rows(std::int64_t(history_.size()));
      });
}

void CalibrationController::walk(const ui::ListRequest& request) {
  if (walk_.ask(request) != ListWalk::Ask::Labels) return;
  walk_.label_each(
      [this](std::size_t top) { return top < history_.size() ? history_[top].made_at : std::string(); });
}

void CalibrationController::use(pipeline::Pipeline pipeline, bool calibrated) {
  next_ = std::move(pipeline);
  next_calibrated_ = next_calibrated_ || calibrated;
  turn();
}

// A visitor's stages run with what it replaces, and a task on the keeper may be looking at both.
void CalibrationController::turn() {
  const State state = parts_.appliance.state();
  const bool nobody_is_measured =
      state == State::Idle || state == State::Staff || state == State::Calibrate || state == State::Export;
  if (!next_ || !nobody_is_measured || parts_.side_tasks.busy(JobLane::Keeper)) return;
  parts_.stages.replace(*std::exchange(next_, std::nullopt));
  if (std::exchange(next_calibrated_, false)) parts_.in_use(*parts_.stages.calibration());
}

const pipeline::AlgorithmSet& CalibrationController::algorithms() const {
  return next_ ? next_->algorithms() : parts_.stages.algorithms();
}

const pipeline::StereoCalibration* CalibrationController::calibration() const {
  return next_ ? &next_->calibration() : parts_.stages.calibration();
}

// The device's task: who leaves meanwhile has it done, in the store and for visitors alike.
void CalibrationController::adopt(std::function<Result<std::uint32_t>()> first, std::uint32_t calibrated) {
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
        RELIEVO_TRY_ASSIGN(made->pipeline, pipeline::Pipeline::make(algorithms(), calibration));
        return {};
      },
      [this, made, calibrated, visit = visit_](const std::optional<Error>& error) {
        if (!error) {
          use(*std::move(made->pipeline), true);
          parts_.log.say(ui::LogEvent::CalibrationUsed);
        }
        if (visit != visit_) return error ? parts_.log.fault(*error) : void();
        if (!error) mounted_anew_ = false;
        stored_ = stored_ || (calibrated != 0 && calibrated == runs_ && made->revision != 0);
        busy_ = false;
        problem_ = error ? ui::fault_of(*error) : ui::Fault{};
        if (!error) load_history();
      },
      SideTasks::Whose::Device);
}

void CalibrationController::store() {
  if (!ended_ || stored_ || !job_.result() ||
      job_.result()->quality.verdict == pipeline::CalibrationVerdict::Refuse)
    return;
  adopt(
      [this, result = *job_.result()]() -> Result<std::uint32_t> {
        return parts_.store.save_calibration(result.calibration, "calibrated at the screen",
                                             figures_of(result.quality));
      },
      runs_);
}

void CalibrationController::activate(std::size_t row) {
  row += std::size_t(walk_.first_row());
  if (row >= history_.size() || history_[row].info.active) return;
  const std::uint32_t revision = history_[row].info.revision;
  adopt([this, revision]() -> Result<std::uint32_t> {
    RELIEVO_TRY_ASSIGN(const auto calibration, parts_.store.calibration(revision));
    RELIEVO_TRY(check_size(calibration, parts_.device.preferred_mode(), "cameras"));
    RELIEVO_TRY(parts_.store.activate_calibration(revision));
    return revision;
  });
}

void CalibrationController::export_in_use() {
  const pipeline::StereoCalibration* in_use = parts_.stages.calibration();
  if (busy_ || in_use == nullptr) return;
  busy_ = true;
  exported_.clear();
  // Not by the revision: those of two appliances are alike.
  const std::string folder = stick_name_of(parts_.device.clock().wall_now());
  parts_.side_tasks.send(
      JobLane::Keeper,
      [this, calibration = *in_use, folder](JobControl&) {
        return export_calibration(calibration, folder, parts_.device.media());
      },
      [this, folder](const std::optional<Error>& error) {
        busy_ = false;
        problem_ = error ? ui::fault_of(*error) : ui::Fault{};
        if (!error) exported_ = std::string(kCalibrationsFolder) + "/" + folder;
      });
}

void CalibrationController::import_one() {
  adopt([this]() -> Result<std::uint32_t> {
    RELIEVO_TRY_ASSIGN(const StickCalibration found, import_calibration(parts_.device.media()));
    RELIEVO_TRY(check_size(found.calibration, parts_.device.preferred_mode(), "cameras"));
    return parts_.store.save_calibration(found.calibration, "imported from " + found.file);
  });
}

ui::TechnicianCalibration CalibrationController::view() {
  ui::TechnicianCalibration view = job_.newest();
  view.columns = board_.corners_across;
  view.rows = board_.corners_down;
  view.square_mm = float(board_.square_mm);
  view.charuco = board_.charuco;
  view.mounted_anew = mounted_anew_;
  view.running = running_;
  view.ended = ended_;
  view.stored = stored_;
  view.reasons = reasons_;
  view.views_px = views_px_;
  if (!running_ || !problem_.empty()) view.problem = problem_;
  view.exported = exported_;
  if (ended_) {
    const pipeline::CalibrationQuality& q = job_.result()->quality;
    view.verdict = q.verdict;
    view.depth_error_mm = float(q.face_depth_sigma_mm);
    view.rms_px = float(q.pair_rms_px);
    view.baseline_mm = float(q.baseline_mm);
  }
  view.place = walk_.view();
  view.history_count = std::size_t(walk_.end_row() - walk_.first_row());
  for (std::size_t i = 0; i < view.history_count; ++i) {
    const Row& row = history_[std::size_t(walk_.first_row()) + i];
    const storage::CalibrationInfo& info = row.info;
    view.history[i] = {info.revision, info.active, row.made_at, float(info.figures.depth_sigma_mm)};
  }
  return view;
}

void CalibrationController::forget() {
  ++visit_;
  job_.wipe();
  running_ = ended_ = stored_ = busy_ = mounted_anew_ = false;
  problem_ = {};
  reasons_.clear();
  views_px_.clear();
  history_.clear();
  walk_.begin_anew();
  walk_.set_rows(0);
  exported_.clear();
}

}  // namespace relievo::firmware
