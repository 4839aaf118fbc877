// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// UniquenessConstraint ("uniqueness"): a place in the right view shows one surface only (Marr and
// Poggio 1976). Where several matches of a row land on the same right pixel, the nearest surface
// hides the others: what lies behind it by more than a margin is rejected.
#pragma once

#include "pipeline/base/options.h"
#include "pipeline/match/match_constraint.h"

namespace relievo::pipeline {

struct UniquenessConstraintOptions {
  float margin_px = 1.5F;  // a slanted surface may land twice on one pixel
  Result<void> check() const;
};

template <typename Field>
void describe(UniquenessConstraintOptions& o, Field&& field) {
  field("margin_px", o.margin_px, OptionRange{0, 64},
        "how far behind another surface a match counts as hidden, pixels");
}

class UniquenessConstraint final : public MatchConstraint {
 public:
  explicit UniquenessConstraint(const UniquenessConstraintOptions& options) : options_(options) {}
  std::string_view name() const override { return "uniqueness"; }
  void judge(const RectifiedPair& pair, std::span<Match> matches, int lattice_step_px, std::uint16_t bit,
             StageContext& context) const override;

 private:
  UniquenessConstraintOptions options_;
};

}  // namespace relievo::pipeline
