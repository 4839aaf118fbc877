// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// DissertationJob: all of the dissertation's tables and figures. Figures 6 to 12 are done on the pair given;
// figure 17 too, where that is calibrated. What is left is done on a simulated person, whose truth is known.
// Thread: worker; now() any; result() once done. Errors: Cancelled; those of virtual_rig.h and of the disk.
#pragma once

#include <atomic>
#include <optional>
#include <string_view>

#include "firmware/compare/compare_job.h"
#include "firmware/compare/virtual_rig.h"

namespace relievo::firmware::compare {

struct DissertationOrder {
  std::optional<ComparedPair> pair;
  std::vector<NamedSet> rule_sets, face_sets;  // suites.h
  bool whole_view = false;
  double limit_px = 1;
  Path work;  // a folder of its own, for simulated pictures
};

class DissertationJob final : public Job {
 public:
  DissertationJob(DissertationOrder order, Simulate simulate)
      : order_(std::move(order)), simulate_(std::move(simulate)) {}
  Result<void> run(JobControl& control) override;
  std::string_view now() const;
  const Dissertation& result() const { return result_; }

 private:
  Result<void> run_all(JobControl& control);
  enum class At : std::uint8_t { Tables, Person, Rules, Face };
  Result<void> make_tables(JobControl& control);
  Result<ComparedPair> simulated_person(JobControl& control);

  DissertationOrder order_;
  Simulate simulate_;
  Dissertation result_;
  std::atomic<At> at_{At::Tables};
};

}  // namespace relievo::firmware::compare
