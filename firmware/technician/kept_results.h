// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// KeptResults: results that were put aside, to be looked at beside the present one: figures, the left picture
// of every stage, and the model, to be turned. Each has its own memory of fixed size (budget::kKeptModelBytes
// and its pictures'); pages nobody touched cost nothing. A model that is larger is left out: its pictures are
// not. A comparison with the present surface runs on the worker; until it has ended they stay as they are.
// Thread: main, while no other job runs. Errors: none.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>

#include "firmware/base/boot_memory.h"
#include "firmware/service/side_tasks.h"
#include "firmware/technician/show/surface_difference.h"
#include "firmware/technician/show/technician_figures.h"
#include "firmware/technician/show/technician_pictures.h"
#include "hal/base/arena.h"
#include "ui/technician/technician_view.h"

namespace relievo::firmware {

class KeptResults {
 public:
  static_assert(ui::kCompared == budget::kKeptResults + 1);

  KeptResults();
  // Behind the others; nothing happens where there is no room. `model` may be missing; no two have the same
  // number.
  void keep(const TechnicianFigures& figures, const TechnicianPictures& pictures,
            const pipeline::FaceModel* model, std::uint32_t number);
  // Those behind it move up.
  void drop(std::size_t which);
  void wipe();
  std::size_t count() const { return count_; }
  bool full() const { return count_ == all_.size(); }
  bool has(std::uint32_t number) const;
  // Each surface against the present one of that number, as the present capture's left view sees both; once
  // a number. `present` stays as it is until then.
  void compare_on_worker(SideTasks& tasks, const Products& present, std::uint32_t number);
  bool is_compared_with(std::uint32_t number) const;
  ui::TechnicianDifference difference(std::size_t which) const { return all_[which]->difference.view(); }
  float full_colour_mm() const { return full_colour_mm_; }  // of all differences
  // Until the next change.
  ui::TechnicianCompared view(std::size_t which, ui::TechnicianStage stage) const;

 private:
  void compare(const pipeline::RectifiedPair& pair, const pipeline::FaceMesh& present, std::uint32_t number,
               const std::atomic<bool>& cancelled);

  struct One {
    One();
    void wipe();
    TechnicianFigures figures;
    TechnicianPictures pictures{false};
    PageBlock block;
    Arena memory;
    std::optional<pipeline::FaceModel> model;
    std::uint32_t number = 0;
    SurfaceDifference difference;
    std::uint32_t compared_with = 0;
  };
  std::array<std::unique_ptr<One>, budget::kKeptResults> all_;
  std::size_t count_ = 0;
  bool comparing_ = false;
  float full_colour_mm_ = 0;
  std::uint32_t coloured_ = 0;  // so many surfaces have been
};

}  // namespace relievo::firmware
