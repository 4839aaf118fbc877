// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/compare/dissertation_job.h"

#include "firmware/base/boot_memory.h"
#include "firmware/compare/suites.h"
#include "firmware/jobs/pool_size.h"
#include "hal/base/thread_pool.h"

namespace relievo::firmware::compare {
namespace {

Result<void> go_on(const JobControl& control) {
  if (control.cancelled.load()) return Error{Errc::Cancelled, "cancelled: nothing was written"};
  return {};
}

Result<Comparison> compared(const ComparedPair& pair, std::vector<NamedSet> sets, const RunOptions& options,
                            JobControl& control) {
  CompareJob job({pair}, std::move(sets), options);
  RELIEVO_TRY(job.run(control));
  return std::move(job.comparison());
}

}  // namespace

std::string_view DissertationJob::now() const {
  switch (at_.load(std::memory_order_relaxed)) {
    case At::Tables:
      return "tables 1 and 2";
    case At::Person:
      return "simulated person";
    case At::Rules:
      return "figures 6 to 12";
    case At::Face:
      break;
  }
  return "figure 17";
}

Result<void> DissertationJob::make_tables(JobControl& control) {
  RELIEVO_TRY_ASSIGN(const VirtualRig rig, calibrate_virtual_rig(simulate_, order_.work / "virtual rig"));
  result_.rig = rig_table(rig);
  BootMemory memory(0, std::size_t{64} << 20, std::size_t{32} << 20);
  Arena output(memory.output());
  Arena scratch(memory.scratch());
  ThreadPool pool(pool_size());
  pipeline::StageContext context{output, scratch, pool, control.progress, control.cancelled};
  RELIEVO_TRY_ASSIGN(result_.cube, cube_table(rig, context));
  return {};
}

Result<ComparedPair> DissertationJob::simulated_person(JobControl& control) {
  const Path folder = order_.work / "simulated person";
  SimulateArgs args;
  args.truth = true;
  RELIEVO_TRY(simulate_(args, folder));
  RELIEVO_TRY(go_on(control));
  CompareArgs read;
  read.pictures = {folder / "left.png", folder / "right.png"};
  read.calibrations = {folder / "rig.yml"};
  read.truths = {folder};
  RELIEVO_TRY_ASSIGN(auto pairs, read_pairs(read));
  return std::move(pairs.front());
}

Result<void> DissertationJob::run(JobControl& control) {
  const Result<void> done = run_all(control);
  // A stage says what it was at; who stopped it wants to know what is left.
  return !done && done.error().code == Errc::Cancelled ? go_on(control) : done;
}

Result<void> DissertationJob::run_all(JobControl& control) {
  RELIEVO_TRY(make_tables(control));
  RELIEVO_TRY(go_on(control));
  std::optional<ComparedPair> person;
  if (!order_.pair || !order_.pair->calibration) {
    at_ = At::Person;
    RELIEVO_TRY_ASSIGN(person, simulated_person(control));
  }
  at_ = At::Rules;
  RELIEVO_TRY_ASSIGN(result_.rules, compared(order_.pair ? *order_.pair : *person, order_.rule_sets,
                                             {order_.whole_view, order_.limit_px, false}, control));
  at_ = At::Face;
  RELIEVO_TRY_ASSIGN(result_.face, compared(person ? *person : *order_.pair, order_.face_sets,
                                            {!person && order_.whole_view, order_.limit_px}, control));
  return {};
}

}  // namespace relievo::firmware::compare
