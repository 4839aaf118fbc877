// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TechnicianFigures: what a set of algorithms cost and made, as the technician reads it: times, counts, what
// each rule rejected, and what the result says of itself where nothing is known to be true
// (firmware/measure). Its texts stay where they are: view() borrows them.
// Thread: worker while a job runs, else main. Errors of measure(): Cancelled, OutOfMemory.
#pragma once

#include <string>
#include <vector>

#include "firmware/machine/machine.h"
#include "firmware/session/session.h"
#include "firmware/work/stage_runner.h"
#include "pipeline/algorithms.h"
#include "pipeline/base/stage.h"
#include "ui/technician/technician_view.h"

namespace relievo::firmware {

// How uncertain the measured vertices are, as TechnicianResult has it.
std::array<float, ui::kSigmaBins> sigma_percent(const pipeline::FaceMesh& mesh);

class TechnicianFigures {
 public:
  // `name`: of the capture.
  void begin(const pipeline::AlgorithmSet& set, const std::string& name);
  void add(const StageRecord& record);
  void fail(State stage, const Error& error);
  Result<void> measure(const Products& products, pipeline::StageContext& context);
  void forget() { *this = {}; }

  // Until the next change.
  ui::TechnicianResult view() const;
  // That took a match first; empty: none did.
  std::string_view rule_of(const pipeline::Match& match) const;

 private:
  pipeline::AlgorithmSet set_;
  ui::TechnicianResult result_;
  std::size_t stages_ = 0;
  std::string name_, difference_;
  ui::Fault failure_;
  std::vector<std::string> rules_;
};

}  // namespace relievo::firmware
