// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/compare/compare_job.h"

#include <utility>

#include "firmware/jobs/job_thread.h"

namespace relievo::firmware::compare {

CompareJob::CompareJob(std::vector<ComparedPair> pairs, std::vector<NamedSet> sets, RunOptions options)
    : pairs_(std::move(pairs)), options_(std::move(options)) {
  comparison_.sets = std::move(sets);
  comparison_.limit_px = options_.limit_px;
  for (const ComparedPair& pair : pairs_)
    for (const NamedSet& set : comparison_.sets) labels_.push_back(pair.name + ", " + set.name);
}

Result<void> CompareJob::run(JobControl& control) {
  ThreadPool pool(pool_size());
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    PairFacts& facts = comparison_.pairs.emplace_back();
    facts.name = pairs_[p].name;
    for (std::size_t s = 0; s < comparison_.sets.size(); ++s) {
      at_.store(comparison_.runs.size(), std::memory_order_relaxed);
      Run& run = comparison_.runs.emplace_back();
      run.set = s;
      run.pair = p;
      RELIEVO_TRY(run_set({pairs_[p], comparison_.sets[s], options_}, pool, control, facts, run));
    }
    pairs_[p] = {};  // what is looked at again lies in the facts
  }
  return {};
}

}  // namespace relievo::firmware::compare
