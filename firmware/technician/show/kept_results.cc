// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/technician/show/kept_results.h"

#include <algorithm>
#include <new>

namespace relievo::firmware {

KeptResults::One::One()
    : block(new std::byte[budget::kKeptModelBytes]), memory({block.get(), budget::kKeptModelBytes}) {}

void KeptResults::One::wipe() {
  figures.forget();
  pictures.wipe();
  model.reset();
  memory.wipe();
  number = 0;
}

KeptResults::KeptResults() {
  for (auto& one : all_) one = std::make_unique<One>();
}

void KeptResults::keep(const TechnicianFigures& figures, const TechnicianPictures& pictures,
                       const pipeline::FaceModel* model, std::uint32_t number) {
  if (full()) return;
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
  if (which >= count_) return;
  all_[which]->wipe();
  std::rotate(all_.begin() + static_cast<std::ptrdiff_t>(which),
              all_.begin() + static_cast<std::ptrdiff_t>(which) + 1, all_.end());
  --count_;
}

void KeptResults::wipe() {
  for (const auto& one : all_) one->wipe();
  count_ = 0;
}

bool KeptResults::has(std::uint32_t number) const {
  return std::any_of(all_.begin(), all_.begin() + static_cast<std::ptrdiff_t>(count_),
                     [number](const auto& one) { return one->number == number; });
}

ui::TechnicianCompared KeptResults::view(std::size_t which, ui::TechnicianStage stage) const {
  const One& one = *all_[which];
  return {one.figures.view(), one.pictures.picture(stage, 0), one.model ? &*one.model : nullptr, one.number};
}

}  // namespace relievo::firmware
