// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the picture pages show: borrowed from its parts, and from the session only while nobody works on it;
// and the results that are put aside.
#include "firmware/technician/test_capture.h"

#include <algorithm>
#include <cmath>
#include <new>

namespace relievo::firmware {

static_assert(ui::kTechnicianPoses == pipeline::kMostPoses);

const ui::TechnicianView& TestCapture::view() {
  view_ = told_;
  view_.calibrated = calibration() != nullptr;
  view_.point = told_.by_hand ? pairs_.chosen() : point_;
  view_.recording = recording_.view();
  view_.saved = recording_.saved();
  view_.choice = algorithms_.view();
  view_.calibration = calibrations_.view();
  view_.rows = tables_.view();
  if (watching_ && watch_wanted_) view_.cameras = watch_.newest();
  view_.cameras.starting = watch_wanted_ && !view_.cameras.watched;
  view_.put_aside = kept_.count();
  for (std::size_t i = 0; i < view_.put_aside; ++i) view_.compared[i] = kept_.view(i, told_.stage);
  if (told_.phase == ui::TechnicianPhase::Running) {
    view_.working_on = std::uint8_t(number_of(run_.stage()));
    view_.progress = parts_.side_tasks.progress(JobLane::Worker);
  }
  const Products* made = products();
  if (made == nullptr) return view_;
  view_.can_record = made->frame.has_value();
  view_.result = run_.figures().view();
  for (std::size_t side = 0; side < 2; ++side) view_.shown[side] = run_.pictures().picture(told_.stage, side);
  if (made->model) view_.model = &*made->model;
  if (made->cloud) view_.cloud = &*made->cloud;
  view_.model_number = model_number_;
  view_.pairs = pairs_.points();
  view_.pairs_changed = pairs_.changed();
  view_.change = run_.change().figures();
  view_.can_add_side = may_add_side();
  view_.sides = session_.sides().count();
  if (made->registration) look_at_poses(*made->registration);
  view_.compared[view_.put_aside] = {
      view_.result, run_.pictures().picture(told_.stage, 0), view_.model, model_number_, {}};
  if (!view_.result.there || !told_.differences || !kept_.is_compared_with(model_number_)) return view_;
  for (std::size_t i = 0; i < view_.put_aside; ++i) view_.compared[i].difference = kept_.difference(i);
  view_.full_colour_mm = kept_.full_colour_mm();
  view_.scale = difference_scale();
  return view_;
}

void TestCapture::look_at_poses(const pipeline::Registration& registration) {
  view_.pose_count = registration.poses.size();
  view_.full_residual_mm = full_residual_mm(registration);
  for (std::size_t a = 0; a < view_.pose_count; ++a) {
    const pipeline::RegisteredPose& pose = registration.poses[a];
    view_.poses[a].joined = pose.joined;
    view_.poses[a].turned_deg = float(pipeline::turned_deg(pose.first_from_pose.rotation));
    for (std::size_t b = 0; b < view_.pose_count; ++b) view_.poses[a].rms_mm[b] = float(pose.meets[b].rms_mm);
  }
}

namespace {

constexpr float kLeastScaleMm = 0.1F;
constexpr std::uint32_t kColouredFrom = 0x40000000;  // no model has such a number

// To 1, 2 or 5 times a power of ten.
float round_up(float mm) {
  if (!(mm > 0)) return 0;
  const float power = std::pow(10.0F, std::floor(std::log10(mm)));
  for (const float times : {1.0F, 2.0F, 5.0F})
    if (times * power >= mm) return times * power;
  return 10 * power;
}

}  // namespace

KeptResults::One::One() : block(budget::kKeptModelBytes), memory(block.bytes()) {}

void KeptResults::One::wipe() {
  figures.forget();
  pictures.wipe();
  model.reset();
  memory.wipe();
  number = compared_with = 0;
  difference.forget();
}

KeptResults::KeptResults() {
  for (auto& one : all_) one = std::make_unique<One>();
}

void KeptResults::keep(const TechnicianFigures& figures, const TechnicianPictures& pictures,
                       const pipeline::FaceModel* model, std::uint32_t number) {
  if (full() || comparing_) return;
  One& one = *all_[count_++];
  one.figures = figures;
  one.pictures.copy_from(pictures);
  one.number = number;
  if (model == nullptr) return;
  try {
    pipeline::FaceModel& copy = one.model.emplace(&one.memory);
    copy.mesh = model->mesh;
    copy.texture = model->texture;
    copy.head_from_camera = model->head_from_camera;
  } catch (const std::bad_alloc&) {
    one.model.reset();
    one.memory.wipe();
  }
}

void KeptResults::drop(std::size_t which) {
  if (which >= count_ || comparing_) return;
  all_[which]->wipe();
  std::rotate(all_.begin() + std::ptrdiff_t(which), all_.begin() + std::ptrdiff_t(which) + 1, all_.end());
  --count_;
}

void KeptResults::wipe() {
  for (const auto& one : all_) one->wipe();
  count_ = 0;
  comparing_ = false;
}

bool KeptResults::has(std::uint32_t number) const {
  return std::ranges::any_of(kept(), [number](const auto& one) { return one->number == number; });
}

bool KeptResults::is_compared_with(std::uint32_t number) const {
  return !comparing_ &&
         std::ranges::all_of(kept(), [number](const auto& one) { return one->compared_with == number; });
}

void KeptResults::compare_on_worker(SideTasks& tasks, const Products& present, std::uint32_t number) {
  if (comparing_ || !present.pair || !present.model || is_compared_with(number)) return;
  comparing_ = true;
  tasks.send(
      JobLane::Worker,
      [this, &present, number](JobControl& control) -> Result<void> {
        compare(*present.pair, present.model->mesh, number, control.cancelled);
        return {};
      },
      [this](const std::optional<Error>&) { comparing_ = false; });
}

void KeptResults::compare(const pipeline::RectifiedPair& pair, const pipeline::FaceMesh& present,
                          std::uint32_t number, const std::atomic<bool>& cancelled) {
  const compare::DisparityMap depths = depths_of(pair, present);
  full_colour_mm_ = kLeastScaleMm;
  for (const auto& one : kept()) {
    if (cancelled.load(std::memory_order_relaxed)) break;
    one->compared_with = number;
    if (!one->model) continue;
    one->difference.measure(pair, one->model->mesh, depths, kColouredFrom + ++coloured_);
    full_colour_mm_ = std::max(full_colour_mm_, round_up(one->difference.view().most_mm));
  }
  for (const auto& one : kept())
    if (one->model && one->difference.view().known)
      one->difference.draw(pair, one->model->mesh, full_colour_mm_);
}

ui::TechnicianCompared KeptResults::view(std::size_t which, ui::TechnicianStage stage) const {
  const One& one = *all_[which];
  return {
      one.figures.view(), one.pictures.picture(stage, 0), one.model ? &*one.model : nullptr, one.number, {}};
}

}  // namespace relievo::firmware
