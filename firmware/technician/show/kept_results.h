// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// KeptResults: results that were put aside, to be looked at beside the present one: figures, the left picture
// of every stage, and the model, to be turned. Each has its own memory of fixed size (budget::kKeptModelBytes
// and its pictures'); pages nobody touched cost nothing. A model that is larger is left out: its pictures are
// not. Thread: main, while no job runs. Errors: none.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

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
  // Until the next change.
  ui::TechnicianCompared view(std::size_t which, ui::TechnicianStage stage) const;

 private:
  struct One {
    One();
    void wipe();
    TechnicianFigures figures;
    TechnicianPictures pictures;
    std::unique_ptr<std::byte[]> block;  // not initialised: untouched
    Arena memory;
    std::optional<pipeline::FaceModel> model;
    std::uint32_t number = 0;
  };
  std::array<std::unique_ptr<One>, budget::kKeptResults> all_;
  std::size_t count_ = 0;
};

}  // namespace relievo::firmware
