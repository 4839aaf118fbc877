// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/session/session.h"

#include <memory>
#include <utility>

#include <string.h>

#include "hal/base/assert.h"

namespace relievo::firmware {

Result<void> EnrolmentSession::open(std::string_view subject) {
  if (is_open()) return Error{Errc::InvalidState, "a session is open already: close it first"};
  if (subject.size() > budget::kSubjectNameBytes) {
    return Error{Errc::InvalidInput, "the name is longer than 128 bytes: choose a shorter one"};
  }
  RELIEVO_ASSERT(output_.used() == 0 && scratch_touched_ == 0);
  subject.copy(subject_.data(), subject.size());
  make_products();
  open_ = true;
  return {};
}

void EnrolmentSession::make_products() {
  products_ =
      std::construct_at(static_cast<Products*>(output_.allocate(sizeof(Products), alignof(Products))));
}

Products& EnrolmentSession::products() const {
  RELIEVO_ASSERT(is_open());
  return *products_;
}

void EnrolmentSession::retake() {
  RELIEVO_ASSERT(is_open());
  wipe();
  make_products();
}

void EnrolmentSession::took(const pipeline::StereoFrame& frame) {
  products().frame = frame;
  holds_ = spare_slot_.holds(frame.left) ? &spare_slot_ : &slot_;
}

void EnrolmentSession::rework() {
  const auto frame = products().frame;
  wipe_products();
  make_products();
  products_->frame = frame;
}

void EnrolmentSession::begins(State stage) { stage_begins_.at(number_of(stage)) = output_.used(); }

void EnrolmentSession::rework(State from) {
  if (from <= State::Match) return rework();
  Products& made = products();
  if (from > State::Mesh && made.model) {  // they were taken over unchanged
    made.mesh = std::move(made.model->mesh);
    made.texture = std::move(made.model->texture);
  }
  made.model.reset();
  if (from <= State::Texture) made.texture.reset();
  if (from <= State::Mesh) made.mesh.reset();
  if (from <= State::Reconstruct) made.cloud.reset();
  output_.wipe(stage_begins_.at(number_of(from)));
}

void EnrolmentSession::close() {
  if (!is_open()) return;
  wipe();
  open_ = false;
  explicit_bzero(subject_.data(), subject_.size());
}

void EnrolmentSession::wipe() {
  wipe_products();
  holds_ = nullptr;
  slot_.wipe();
  live_.wipe();
  spare_slot_.wipe();
  sides_.wipe();
}

void EnrolmentSession::wipe_products() {
  std::destroy_at(products_);
  products_ = nullptr;
  stage_pictures_.wipe();
  output_.wipe();
  explicit_bzero(scratch_block_.data(), scratch_touched_);
  scratch_touched_ = 0;
}

}  // namespace relievo::firmware
