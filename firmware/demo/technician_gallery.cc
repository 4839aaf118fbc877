// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "firmware/demo/gallery.h"
#include "firmware/technician/test_capture.h"

namespace relievo::firmware {
namespace {

using ui::StaffPage;
using ui::TechnicianPhase;
using ui::TechnicianStage;
using ui::TechnicianView;

constexpr std::array<std::string_view, 8> kHeads{"n",    "x₁ px", "y₁ px", "x₂ px",
                                                 "d px", "σ px",  "1 − ρ", "×"};
constexpr std::array<std::string_view, 80> kCells{
    "11",      "812.00",     "304.00",  "771.318", "40.682",  "0.041",      "0.012",   "",        "12",
    "814.00",  "304.00",     "773.297", "40.703",  "0.044",   "0.015",      "",        "13",      "816.00",
    "304.00",  "779.911",    "36.089",  "0.310",   "0.428",   "similarity", "14",      "818.00",  "304.00",
    "777.269", "40.731",     "0.043",   "0.014",   "",        "15",         "820.00",  "304.00",  "779.256",
    "40.744",  "0.042",      "0.011",   "",        "16",      "822.00",     "304.00",  "781.240", "40.760",
    "0.045",   "0.016",      "",        "17",      "824.00",  "304.00",     "782.098", "41.902",  "0.188",
    "0.093",   "uniqueness", "18",      "826.00",  "304.00",  "785.219",    "40.781",  "0.044",   "0.013",
    "",        "19",         "828.00",  "304.00",  "787.203", "40.797",     "0.041",   "0.012",   "",
    "20",      "830.00",     "304.00",  "789.185", "40.815",  "0.046",      "0.017",   ""};
constexpr std::array<std::string_view, 4> kCalibrationHeads{"", "1", "2", "1 → 2"};
constexpr std::array<std::string_view, 40> kCalibrationCells{
    "fx px", "2318.442",    "2321.107",    "R  +0.98172  +0.00218  -0.19030",
    "fy px", "2317.905",    "2320.664",    "R  -0.00301  +0.99999  -0.00409",
    "cx px", "958.310",     "961.774",     "R  +0.19029  +0.00459  +0.98172",
    "cy px", "601.228",     "598.913",     "t  -108.114  +0.062  +10.530 mm",
    "k₁",    "-0.081427",   "-0.080966",   "rms  0.118 px",
    "k₂",    "+0.104310",   "+0.101772",   "№  4",
    "p₁",    "+0.000214",   "-0.000087",   "",
    "p₂",    "-0.000391",   "+0.000146",   "",
    "k₃",    "-0.021508",   "-0.019944",   "",
    "px",    "1920 × 1200", "1920 × 1200", ""};

ui::TechnicianResult made_up_result() {
  return {.there = true,
          .name = "2026-03-12_09-14-07",
          .algorithms = {},
          .failure = {},
          .seconds = {1.42F, 0.18F, 0.31F, 0.42F, 0.24F},
          .made = {148220, 141873, 97342, 1048576},
          .arena_peak_mib = 147,
          .matches = 171004,
          .accepted = 148220,
          .rules = {{{"similarity", {31, 99, 173}, 17310},
                     {"uniqueness", {214, 96, 6}, 2204},
                     {"continuity", {134, 60, 156}, 3270}}},
          .rule_count = 3,
          .median_sigma_mm = 0.061F,
          .coverage = 0.957F,
          .sigma_percent = {0,    1,    14,   29,   22,   13,   8, 4, 3, 2, 1, 1,   0.5F,
                            0.5F, 0.4F, 0.2F, 0.1F, 0.1F, 0.1F, 0, 0, 0, 0, 0, 0.1F},
          .epipolar_px = 0.082F,
          .photo_correlation = 0.972F,
          .photo_windows = 2318};
}

TechnicianView ready(const ui::ViewState& review) {
  TechnicianView view;
  view.phase = TechnicianPhase::Ready;
  view.result = made_up_result();
  view.model = review.model;
  view.model_number = 900003;
  lend(review, TechnicianStage::Rectified, view);
  return view;
}

ui::TechnicianPoint touched() {
  ui::TechnicianPoint p;
  p.touched = p.matched = true;
  p.left_px = {812, 604};
  p.right_px = {771.318F, 604};
  p.left_x = 0.46F;
  p.right_x = 0.52F;
  p.y = 0.52F;
  p.disparity_px = 40.68F;
  p.sigma_px = 0.04F;
  p.cost = 0.012F;
  p.at_mm = {-12.4F, 31.8F, 557.2F};
  p.sigma_mm = 0.052F;
  return p;
}

// The first is the chosen one.
std::vector<ui::TechnicianPoint> by_hand() {
  std::vector<ui::TechnicianPoint> pairs(3, touched());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    ui::TechnicianPoint& p = pairs[i];
    p.by_hand = true;
    p.moved_mm = -1.84F;
    p.left_x += 0.05F * float(i);
    p.right_x += 0.05F * float(i);
    p.y -= 0.12F * float(i);
  }
  return pairs;
}

AlgorithmController edited(bool typing) {
  AlgorithmController controller;
  controller.act(ui::ChooseKind{2});
  controller.act(ui::ChooseName{2});
  if (!typing) return controller;
  controller.act(ui::EditOption{0});
  for (const char digit : {'9', '9', '9'}) controller.act(ui::TypeDigit{digit});
  controller.act(ui::TechnicianAct::UseTyped);
  return controller;
}

ui::TechnicianCameras watched(const ui::ViewState& review) {
  ui::TechnicianCameras c;
  c.watched = c.can_be_set = true;
  for (std::size_t i = 0; i < 2; ++i) {
    if (review.frame != nullptr)
      c.camera[i].picture = {i == 0 ? review.frame->left : review.frame->right, 900020 + std::uint32_t(i)};
    c.camera[i].mean = i == 0 ? 0.46F : 0.44F;
    c.camera[i].clipped = i == 0 ? 0.004F : 0.031F;
    c.camera[i].focus = i == 0 ? 0.98F : 0.84F;
    c.camera[i].frames = 1204;
  }
  c.skew_us = 18;
  c.pairs = 1203;
  c.pairs_per_second = 9.6F;
  c.exposure_us = 4000;
  return c;
}

ui::TechnicianCalibration calibrated(const ui::ViewState& review, bool running) {
  ui::TechnicianCalibration c;
  c.running = running;
  c.ended = !running;
  c.advice = pipeline::LiveAdvice::TiltRight;
  c.end = pipeline::LiveEnd::GoalReached;
  for (std::size_t i = 0; i < 2 && review.frame != nullptr; ++i)
    c.pictures[i] = {i == 0 ? review.frame->left : review.frame->right, 900030 + std::uint32_t(i)};
  c.views = 11;
  c.enough = true;
  c.bars = {0.82F, 0.64F, 1, 0.37F};
  for (std::size_t i = 0; i < 64; ++i)
    c.seen[0][i] = c.seen[1][63 - i] = i < 20 ? 0 : std::uint32_t(i % 24) * 3;
  c.error_mm = 0.118F;
  c.goal_mm = 0.1F;
  c.verdict = pipeline::CalibrationVerdict::Pass;
  c.depth_error_mm = 0.094F;
  c.rms_px = 0.021F;
  c.baseline_mm = 108.63F;
  static const std::vector<std::string> kGood{
      "all figures are good: reprojection error 0.021 px; epipolar error 0.018 px on views not used; at 560 mm depth is uncertain by 0.094 mm and was found within 0.061 mm of "
      "where the known squares put it; lengths are uncertain by 0.0113 %"};
  static constexpr std::array kViews{0.018F, 0.022F, 0.019F, 0.031F, 0.017F, 0.02F,
                                     0.016F, 0.021F, 0.024F, 0.018F, 0.019F};
  if (!running) c.reasons = kGood, c.views_px = kViews;
  c.history[0] = {4, true, "2026-03-12 09:14", 0.097F};
  c.history[1] = {3, false, "2026-01-30 16:40", 0.11F};
  c.history_count = 2;
  return c;
}

// Refused, for more than one reason.
ui::TechnicianCalibration refused(const ui::ViewState& review) {
  static const std::vector<std::string> kReasons{
      "left and right do not hold still relative to each other: they disagree 4.2 times more than the corners' noise explains, as cameras do that turn on their mounts; fasten them, and expose both at the same instant",
      "the cameras come out 102.11 mm apart, -6.0 % from the 108.63 mm they are known to be; measure a square of the board again: it would have to be 1.064 of what was said (if the cameras were mounted anew, say so: on the screen's page of calibration, or relievo calibrate --baseline-mm 0)",
      "only 5 of 14 pairs agree with each other"};
  ui::TechnicianCalibration c = calibrated(review, false);
  c.end = pipeline::LiveEnd::Plateau;
  c.verdict = pipeline::CalibrationVerdict::Refuse;
  c.depth_error_mm = 3.412F;
  c.rms_px = 0.41F;
  c.baseline_mm = 102.11F;
  c.reasons = kReasons;
  static constexpr std::array kDoubted{0.31F, 0.44F, 0.29F, 0.62F, 0.35F};
  c.views_px = kDoubted;
  return c;
}

void add_stages(const Lender& all, const ui::ViewState& review) {
  TechnicianView view;
  all.add("technician_empty", StaffPage::Stages, view);
  view.calibrated = false;
  all.add("technician_uncalibrated", StaffPage::Stages, view);
  view.calibrated = true;
  view.phase = TechnicianPhase::Running;
  view.working_on = 1;
  view.progress = 0.4F;
  all.add("technician_running", StaffPage::Stages, view);
  view = ready(review);
  view.point = touched();
  all.add("technician_rectified", StaffPage::Stages, view);
  static const std::vector<ui::TechnicianPoint> pairs = by_hand();
  view.by_hand = view.pairs_changed = true;
  view.pairs = pairs;
  view.point = pairs[0];
  view.change = {true, 143, 21, -1.84F, 1.84F};
  all.add("technician_by_hand", StaffPage::Stages, view);
  lend(review, TechnicianStage::Mesh, view);
  view.shown[1] = view.shown[0];
  all.add("technician_change", StaffPage::Stages, view);
  lend(review, TechnicianStage::Poses, view);
  view.by_hand = view.pairs_changed = false;
  view.pairs = {};
  view.can_add_side = true;
  view.sides = 2;
  view.shown = {};
  all.add("technician_no_poses", StaffPage::Stages, view);
  lend(review, TechnicianStage::Poses, view);
  view.shown[1] = view.shown[0];
  view.poses = {{{true, 0, {0, 0.048F, 0.052F, 0.21F}},
                 {true, 24.6F, {0.047F, 0, 0.061F, 0}},
                 {true, 26.1F, {0.052F, 0.064F, 0, 0.23F}},
                 {false, 41.3F, {}}}};
  view.pose_count = 4;
  view.full_residual_mm = 0.27F;
  all.add("technician_poses", StaffPage::Stages, view);
  view = ready(review);
  view.point = touched();
  view.can_record = true;
  view.recording = {{true, 0.6F}, {}};
  all.add("technician_recording", StaffPage::Stages, view);
  view.recording = {{false, 0, ui::Outcome::Done}, "captures/2026-03-12_09-14-07"};
  all.add("technician_recorded", StaffPage::Stages, view);
  view.recording = {{true, 0.3F}, {}};
  all.add("technician_loading", StaffPage::Stages, view);
  view.recording = {};
  static const std::vector<std::string> saved{"2026-03-12_09-14-07.relievo", "2026-03-11_16-40-52.relievo"};
  view.saved = {true, saved};
  all.add("technician_saved", StaffPage::Stages, view);
  view.saved = {true, {}};
  all.add("technician_none_saved", StaffPage::Stages, view);
  view.saved = {};
  for (const auto& [name, stage] : {std::pair{"technician_pictures", TechnicianStage::Input},
                                    std::pair{"technician_matches", TechnicianStage::Matches},
                                    std::pair{"technician_surface", TechnicianStage::Mesh}}) {
    lend(review, stage, view);
    all.add(name, StaffPage::Stages, view);
  }
}

// The model, the tables, the choice of algorithms, and results beside each other.
void add_results(const Lender& all, const ui::ViewState& review) {
  static const AlgorithmController chosen = edited(false), typing = edited(true);
  TechnicianView view = ready(review);
  all.add("technician_model", StaffPage::Model, view);
  all.add("technician_model_edges", StaffPage::Model, view).visit.look.edges = true;
  view.rows = {ui::TechnicianTable::Matches, kHeads, kCells, {.page = 1, .pages = 17101, .filter = 3}};
  all.add("technician_table", StaffPage::Tables, view);
  view.rows = {ui::TechnicianTable::Calibration, kCalibrationHeads, kCalibrationCells, {}};
  all.add("technician_calibration_table", StaffPage::Tables, view);
  view.choice = chosen.view();
  all.add("technician_algorithms", StaffPage::Algorithms, view);
  view.choice = typing.view();
  all.add("technician_option", StaffPage::Algorithms, view);
  add_comparisons(all, review, view);
}

void add_cameras(const Lender& all, const ui::ViewState& review) {
  TechnicianView view = ready(review);
  view.cameras = watched(review);
  all.add("technician_cameras", StaffPage::Cameras, view);
  view.cameras.edges_shown = true;
  view.cameras.camera[0].sharp_edges = 0.031F;
  view.cameras.camera[1].sharp_edges = 0.012F;
  all.add("technician_camera", StaffPage::Cameras, view, 1);
  view.cameras.edges_shown = false;
  view.cameras.relief_shown = true;
  view.cameras.relief = {review.stages[0].pixels, 900022};
  all.add("technician_relief", StaffPage::Cameras, view);
}

void add_calibrations(const Lender& all, const ui::ViewState& review) {
  TechnicianView view = ready(review);
  view.calibration = calibrated(review, true);
  all.add("technician_calibrating", StaffPage::Calibrate, view);
  view.calibration = calibrated(review, false);
  all.add("technician_calibrated", StaffPage::Calibrate, view);
  view.calibration = refused(review);
  all.add("technician_refused", StaffPage::Calibrate, view);
  view.calibration = calibrated(review, false);
  view.calibration.ended = false;
  all.add("technician_moved", StaffPage::Calibrate, view).view.calibration_note = {
      Errc::NotCalibrated,
      "the rows of both views disagree by 2.47 px (more than 1.5 px is refused): a camera has moved, calibrate again"};
  all.add("technician_exchanged", StaffPage::Calibrate, view).view.calibration_note = {
      Errc::NotCalibrated,
      "serial 4061 → serial 4088: the left camera is not the one that was calibrated: put that one back, or calibrate again"};
}

void add_failures(const Lender& all, const ui::ViewState& review) {
  TechnicianView view = ready(review);
  lend(review, TechnicianStage::Rectified, view);
  view.result.failed_at = 3;
  view.result.failure = {
      Errc::PoorGeometry,
      "1.84 mm off a plane; 0.31 mm off a bent sheet, a face at least 1.2, sigma 0.07; curved by 0.2 sr, a face at least 1.5: that looks like a picture of a face: please look into the cameras yourself"};
  view.result.made = {};
  all.add("technician_failed", StaffPage::Stages, view);
  view.model = nullptr;
  all.add("technician_no_model", StaffPage::Model, view);
}

}  // namespace

// The rectified pair looks nearly as the pictures do; stages after it are the visitor's own pictures.
void lend(const ui::ViewState& review, TechnicianStage stage, TechnicianView& view) {
  view.stage = stage;
  view.shown = {};
  if (stage <= TechnicianStage::Rectified) {
    if (review.frame != nullptr)
      view.shown = {ui::Picture{review.frame->left, 900001}, ui::Picture{review.frame->right, 900002}};
    return;
  }
  const std::size_t last =
      stage == TechnicianStage::Matches || stage == TechnicianStage::Disparity
          ? 0
          : std::min(std::size_t(stage) - std::size_t(TechnicianStage::Cloud) + 1, review.stages.size() - 1);
  view.shown[0] = {review.stages[last].pixels, 900010 + std::uint32_t(last)};
}

Exhibit& Lender::add(std::string_view name, StaffPage page, const ui::ServiceView& view, int mode) const {
  const auto lent = std::make_shared<Exhibit::Lent>(Exhibit::Lent{{}, view});
  Exhibit& exhibit = exhibits.emplace_back(Exhibit{name, idle, visit, {}, lent});
  exhibit.view.screen = ui::Screen::Staff;
  exhibit.view.service = &lent->staff;
  exhibit.service.show(page, mode);
  return exhibit;
}

Exhibit& Lender::add(std::string_view name, StaffPage page, const TechnicianView& view, int mode) const {
  Exhibit& exhibit = add(name, page, ui::ServiceView{}, mode);
  exhibit.lent->technician = view;
  exhibit.lent->staff.role = ui::StaffRole::Technician;
  exhibit.lent->staff.technician = &exhibit.lent->technician;
  exhibit.view.calibration_note = {};
  return exhibit;
}

void add_technician_exhibits(const Lender& all, const ui::ViewState& review) {
  add_stages(all, review);
  add_results(all, review);
  add_cameras(all, review);
  add_calibrations(all, review);
  add_failures(all, review);
}

}  // namespace relievo::firmware
