// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where nothing was measured stands the head that is usual for what was: the generic head (generic_head.h) is
// fitted to the measured radii by robust least squares with its modes' own spread as prior, moved by what it
// differs along the seam (unrolled_head.h), and sewn on (head_sewing.h). Its sigma is the posterior's, with
// what the model cannot show. Errors: those of Completion. Thread: any.
#pragma once

#include "pipeline/base/options.h"
#include "pipeline/mesh/completion/completion.h"

namespace relievo::pipeline {

struct GenericHeadOptions {
  double cell_mm = 2;           // between completed vertices
  double longest_edge_mm = 12;  // wider gaps stay open
  double misfit_mm = 1.5;  // what a person differs by from all that the model can be, one standard deviation
  Result<void> check() const;
};

template <typename Field>
void describe(GenericHeadOptions& o, Field&& field) {
  field("cell_mm", o.cell_mm, OptionRange{0.5, 10}, "between completed vertices, mm");
  field("longest_edge_mm", o.longest_edge_mm, OptionRange{1, 50}, "longer edges join nothing, mm");
  field("misfit_mm", o.misfit_mm, OptionRange{0.1, 20}, "what a person differs by from the model, mm");
}

class GenericHeadCompletion final : public Completion {
 public:
  explicit GenericHeadCompletion(const GenericHeadOptions& options) : options_(options) {}
  std::string_view name() const override { return "generic-head"; }
  Result<FaceMesh> complete(FaceMesh mesh, const Vec3d& across, StageContext& context) const override;

 private:
  GenericHeadOptions options_;
};

}  // namespace relievo::pipeline
