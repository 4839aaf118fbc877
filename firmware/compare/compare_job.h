// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// CompareJob: every set on every pair. A set that fails on a pair is a run that says why. Thread: worker;
// now() any; comparison() once done. Errors: Cancelled; those of `keep_model`.
#pragma once

#include <atomic>

#include "firmware/compare/set_run.h"

namespace relievo::firmware::compare {

class CompareJob final : public Job {
 public:
  CompareJob(std::vector<ComparedPair> pairs, std::vector<NamedSet> sets, RunOptions options);

  Result<void> run(JobControl& control) override;
  std::string_view now() const { return labels_[at_.load(std::memory_order_relaxed)]; }  // "pair, set"
  Comparison& comparison() { return comparison_; }

 private:
  std::vector<ComparedPair> pairs_;
  Comparison comparison_;
  std::vector<std::string> labels_;
  std::atomic<std::size_t> at_{0};
  RunOptions options_;
};

}  // namespace relievo::firmware::compare
