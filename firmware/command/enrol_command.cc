// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>
#include <string>
#include <utility>

#include "firmware/appliance/appliance.h"
#include "firmware/arguments/algorithm_choice.h"
#include "firmware/base/settings.h"
#include "firmware/base/wall_time.h"
#include "firmware/command/commands.h"
#include "firmware/jobs/job_thread.h"
#include "firmware/kiosk/stored_visits.h"
#include "firmware/report/report.h"
#include "firmware/work/pipeline_stages.h"
#include "pipeline/algorithms.h"
#include "pipeline/calibrate/file/calibration_file.h"

namespace relievo::firmware {
namespace {

// Which wording a person has agreed to when an operator enrols them by command.
constexpr const char* kConsentWording = "operator-1";

struct Calibrated {
  pipeline::StereoCalibration calibration;
  std::string name;            // for the report
  std::string note;            // for the store: without the folders, which may be somebody's
  std::uint32_t revision = 0;  // 0: of a file, and the store does not know it yet
};

// Looked for before anything is made: without one no store appears.
Result<Calibrated> find_calibration(const EnrolArgs& args, const Path& folder, const hal::CaptureMode& mode,
                                    Services& services) {
  Calibrated found;
  if (!args.calibration.empty()) {
    RELIEVO_TRY_ASSIGN(found.calibration,
                       pipeline::read_calibration(args.calibration, {mode.width_px, mode.height_px, 0}));
    found.name = args.calibration.string();
    found.note = args.calibration.filename().string();
    return found;
  }
  RELIEVO_TRY_ASSIGN(const auto kept, known_calibration(folder, services));
  if (kept) {
    found.calibration = *kept;
    found.revision = kept->revision;
    found.name = found.note = "store revision " + std::to_string(found.revision);
    return found;
  }
  if (args.device != "sim" || !services.simulated_calibration)
    return Error{
        Errc::NotCalibrated,
        "no calibration is in use: name one with --calibration, or 'relievo calibrate', 'relievo calibration import' or 'activate' with --store"}
        .at(folder.string());
  // Nobody has to calibrate what is known exactly; the kiosk does the same.
  RELIEVO_TRY_ASSIGN(found.calibration, services.simulated_calibration());
  found.name = found.note = "the simulated rig";
  return found;
}

// What a person decides at the screen is decided here: whoever gives the command has the consent,
// and the first model is accepted.
Result<void> drive(Appliance& appliance, Console& console) {
  const std::atomic<bool>& stop = interrupted();
  bool begun = false;
  for (;;) {
    appliance.step(budget::kTick);
    if (stop.load()) appliance.ask(ui::Intent::Cancel);
    const State state = appliance.state();
    if (state == State::Fault) return *appliance.problem();
    if (state == State::Review) {
      if (appliance.problem()) return *appliance.problem();  // it could not be stored
      appliance.ask(ui::Intent::Accept);
    } else if (state != State::Idle) {
      console.progress(name_of(state), appliance.progress());
    } else {
      if (appliance.kept().enrolment != storage::EnrolmentId{}) return {};  // whenever it was to stop
      if (stop.load()) return Error{Errc::Cancelled, "the enrolment was cancelled: nothing was stored"};
      if (begun) return *appliance.problem();
      begun = true;
      appliance.ask(ui::Intent::Begin);
    }
  }
}

// One line for each thing that is done, so that a log shows the way too.
void tell(const Transition& change, const Appliance& appliance, Console& console) {
  if (change.event == Event::Triggered) {
    console.say("Capture      attempt " + std::to_string(appliance.attempt()));
  } else if (change.event == Event::StageDone && change.from != State::Store) {
    console.say(line_of(appliance.records().back()));
    if (change.from == State::Match && appliance.drift()) console.say(line_of(*appliance.drift()));
  } else if (change.event == Event::StageFailed && change.to == State::Capture) {
    console.say(std::string(name_of(change.from)) + ": " + std::string(appliance.problem()->what.view()) +
                "; once more");
  }
}

// What a model was measured with must be found again, also when its file is gone.
class EnrolledVisits final : public StoredVisits {
 public:
  EnrolledVisits(storage::Store& store, const hal::Clock& clock, const Path& folder, const Calibrated& used)
      : StoredVisits(store, clock, folder), store_(store), used_(used) {}
  Result<KeptVisit> keep(const VisitRecord& record, const pipeline::FaceModel& model) override {
    VisitRecord known = record;
    if (known.calibration == 0) {
      RELIEVO_TRY_ASSIGN(known.calibration,
                         store_.know_calibration(used_.calibration, "of an enrolment, from " + used_.note));
    }
    return StoredVisits::keep(known, model);
  }

 private:
  storage::Store& store_;
  const Calibrated& used_;
};

// The log of events remembers every face that spoke against the calibration; nobody's name goes into it.
Result<void> log_drift(const Appliance& appliance, const Calibrated& calibrated, storage::Store& store) {
  using pipeline::DriftVerdict;
  const auto& drift = appliance.drift();
  if (!drift || (drift->verdict != DriftVerdict::Warn && drift->verdict != DriftVerdict::Refuse)) return {};
  return store.append_audit({"calibration.drift", {}, calibrated.note + ": " + sentence(*drift)});
}

}  // namespace

Result<void> run(const EnrolArgs& args, Services& services) {
  RELIEVO_TRY(check_subject(args.subject));
  RELIEVO_TRY_ASSIGN(const pipeline::AlgorithmSet chosen, choose_algorithms(args.algorithms));
  RELIEVO_TRY(pipeline::make_algorithms(chosen));  // what cannot be is said before a camera is opened
  RELIEVO_TRY_ASSIGN(const Path folder, store_folder(args.store));
  RELIEVO_TRY_ASSIGN(const auto device, services.open_device(args.device));
  const hal::CaptureMode mode = device->preferred_mode();
  RELIEVO_TRY_ASSIGN(const Calibrated calibrated, find_calibration(args, folder, mode, services));
  RELIEVO_TRY_ASSIGN(auto pipeline, make_pipeline(args.algorithms, calibrated.calibration));
  RELIEVO_TRY_ASSIGN(const auto store, services.open_store(folder, true));
  RELIEVO_TRY_ASSIGN(const std::optional<storage::SubjectId> subject, choose_subject(*store, args.subject));

  const BootMemory memory(budget::plan_of_a_face(mode.pixels()));
  ThreadPool pool(pool_size());
  PipelineStages stages(std::move(pipeline));
  EnrolledVisits visits(*store, device->clock(), folder, calibrated);
  Appliance appliance({*device, stages, memory, pool, visits});
  appliance.grabber().expect(calibrated.calibration.cameras);
  VisitRecord record;
  record.name = std::string_view(args.subject);
  record.whose = subject;
  record.consent = {kConsentWording, "en", stored_time(device->clock().wall_now())};
  record.calibration = calibrated.revision;
  record.calibration_note = calibrated.name;
  record.algorithms = stages.algorithms().to_text();
  appliance.expect(record);
  appliance.on_change([&](const Transition& change) { tell(change, appliance, services.console); });
  const Result<void> done = drive(appliance, services.console);
  const Result<void> logged = log_drift(appliance, calibrated, *store);
  if (!done) return done.error().where().empty() ? done.error().at(args.device) : done.error();
  services.console.say("stored: " + args.subject + ", enrolment " +
                       std::to_string(std::int64_t(appliance.kept().enrolment)));
  return logged;
}

}  // namespace relievo::firmware
