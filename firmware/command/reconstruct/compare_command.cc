// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>

#include "firmware/command/commands.h"
#include "firmware/command/output_folder.h"
#include "firmware/command/reconstruct/measurement_report.h"
#include "firmware/command/reconstruct/reconstruction.h"
#include "firmware/command/watched_job.h"
#include "firmware/measure/true_surface.h"
#include "storage/export/model_files.h"

namespace relievo::firmware {
namespace {

class MeasureJob final : public Job {
 public:
  MeasureJob(const pipeline::FaceMesh& mesh, const measure::TruthView& truth, const measure::Surface& head)
      : mesh_(mesh), truth_(truth), head_(head) {}
  const measure::Measurement& measurement() const { return measurement_; }
  Result<void> run(JobControl& control) override {
    measurement_ = measure::measure(mesh_, truth_, head_);
    if (control.cancelled.load()) return Error{Errc::Cancelled, "cancelled: nothing was written"};
    return {};
  }

 private:
  const pipeline::FaceMesh& mesh_;
  const measure::TruthView& truth_;
  const measure::Surface& head_;
  measure::Measurement measurement_;
};

}  // namespace

Result<void> run_compare(const CompareArgs& args, Services& services) {
  RELIEVO_TRY_ASSIGN(const auto truth, measure::TruthView::read(args.truth));
  RELIEVO_TRY_ASSIGN(const auto head, measure::read_true_surface(args.truth / "head.ply"));
  Reconstruction reconstruction;
  RELIEVO_TRY(reconstruction.run(args.left, args.right, args.calibration, args.algorithms, services.console, WhenMoved::GoOn));
  MeasureJob job(reconstruction.model().mesh, truth, head);
  RELIEVO_TRY(run_watched(job, services.console, [] { return "Measure"; }));

  RELIEVO_TRY_ASSIGN(OutputFolder folder, OutputFolder::begin(args.output));
  const auto files = storage::write_model_files(reconstruction.model(), folder.path(), storage::ExportFrame::Camera);
  if (!files) return files.error().at(args.output.string());
  const measure::Measurement& m = job.measurement();
  RELIEVO_TRY(write_text(folder.path() / "compare.json", measurement_json(m, report_json(reconstruction.report())), args.output));
  RELIEVO_TRY(folder.commit());

  char line[200];
  std::snprintf(line, sizeof line, "interior median %.4f mm, accuracy p95 %.4f mm, complete at 0.5 mm %.4f, outliers %.5f",
                m.interior_median_mm, m.accuracy_p95_mm, m.complete_half_mm, m.outliers_3mm);
  services.console.say(line);
  std::snprintf(line, sizeof line, "within sigma %.3f, within 1.96 sigma %.3f, total %.0f ms", m.within_sigma,
                m.within_196_sigma, static_cast<double>(reconstruction.report().total.count()) * 1e-6);
  services.console.say(line);
  services.console.say("model and measurement: " + args.output.string());
  return {};
}

}  // namespace relievo::firmware
