// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/technician/kept_results.h"

#include <algorithm>
#include <cmath>
#include <new>

namespace relievo::firmware {
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
  return std::any_of(all_.begin(), all_.begin() + std::ptrdiff_t(count_),
                     [number](const auto& one) { return one->number == number; });
}

bool KeptResults::is_compared_with(std::uint32_t number) const {
  return !comparing_ && std::all_of(all_.begin(), all_.begin() + std::ptrdiff_t(count_),
                                    [number](const auto& one) { return one->compared_with == number; });
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
  const auto kept = std::span(all_).first(count_);
  const compare::DisparityMap depths = depths_of(pair, present);
  full_colour_mm_ = kLeastScaleMm;
  for (const auto& one : kept) {
    if (cancelled.load(std::memory_order_relaxed)) break;
    one->compared_with = number;
    if (!one->model) continue;
    one->difference.measure(pair, one->model->mesh, depths, kColouredFrom + ++coloured_);
    full_colour_mm_ = std::max(full_colour_mm_, round_up(one->difference.view().most_mm));
  }
  for (const auto& one : kept)
    if (one->model && one->difference.view().known)
      one->difference.draw(pair, one->model->mesh, full_colour_mm_);
}

ui::TechnicianCompared KeptResults::view(std::size_t which, ui::TechnicianStage stage) const {
  const One& one = *all_[which];
  return {
      one.figures.view(), one.pictures.picture(stage, 0), one.model ? &*one.model : nullptr, one.number, {}};
}

}  // namespace relievo::firmware
