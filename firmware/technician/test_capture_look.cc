// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the picture pages show: borrowed from its parts, and from the session only while nobody works on it.
#include "firmware/technician/test_capture.h"

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
  if (!told_.differences || !kept_.is_compared_with(model_number_)) return view_;
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

}  // namespace relievo::firmware
