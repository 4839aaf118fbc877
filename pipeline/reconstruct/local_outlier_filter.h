// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// LocalOutlierFilter ("local", the default): takes points out of a cloud that do not belong to its surface:
// flying ones without support among their neighbours, spikes off the plane their neighbours span, and islands
// (the dissertation's Constraint3D "NoOutliers"). Left-camera frame, millimetres; works on the lattice of the
// left view where the cloud has one, on buckets of left_px where it is scattered. Memory: scratch only; the
// cloud shrinks in place and keeps its order. Thread: any. Errors: InvalidInput (options), Cancelled; throws
// std::bad_alloc as every stage does.
#pragma once

#include <cstddef>

#include "pipeline/base/options.h"
#include "pipeline/reconstruct/outlier_filter.h"

namespace relievo::pipeline {

struct LocalOutlierFilterOptions {
  double max_incidence_deg =
      78;                     // neighbours steeper than this to the line of sight do not support each other
  double min_support = 0.34;  // share of the 24 places around a point that must support it
  double spike_sigmas = 4;    // distance from the neighbours' plane, in their own scatter; 0 keeps spikes
  double min_island = 0.01;   // islands with less than this share of the points go

  Result<void> check() const;
};

template <typename Field>
void describe(LocalOutlierFilterOptions& o, Field&& field) {
  field("max_incidence_deg", o.max_incidence_deg, OptionRange{30, 89},
        "steeper neighbours do not support each other");
  field("min_support", o.min_support, OptionRange{0, 1},
        "share of the places around a point that must support it");
  field("spike_sigmas", o.spike_sigmas, OptionRange{0, 100},
        "distance from the neighbours' plane, in their scatter; 0 keeps spikes");
  field("min_island", o.min_island, OptionRange{0, 1}, "islands with less than this share of the points go");
}

struct OutlierCounts {
  std::size_t unsupported = 0;
  std::size_t spikes = 0;
  std::size_t islands = 0;
};

Result<OutlierCounts> reject_outliers(PointCloud& cloud, const LocalOutlierFilterOptions& options,
                                      StageContext& context);

class LocalOutlierFilter final : public OutlierFilter {
 public:
  explicit LocalOutlierFilter(const LocalOutlierFilterOptions& options) : options_(options) {}
  std::string_view name() const override { return "local"; }
  Result<void> reject(PointCloud& cloud, StageContext& context) const override {
    RELIEVO_TRY(reject_outliers(cloud, options_, context));
    return {};
  }

 private:
  LocalOutlierFilterOptions options_;
};

}  // namespace relievo::pipeline
