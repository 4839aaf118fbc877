// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/technician/test_capture.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "firmware/base/wall_time.h"
#include "firmware/work/session_document.h"

namespace relievo::firmware {
namespace {
using ui::TechnicianAct;
using ui::TechnicianPhase;
}  // namespace

TestCapture::TestCapture(TechnicianParts parts)
    : parts_(std::move(parts)),
      session_(parts_.appliance.session()),
      shot_(parts_.appliance.grabber(), session_, parts_.device, parts_.pool),
      run_(session_, parts_.pool, parts_.device.clock()),
      watch_(parts_.appliance.grabber(), session_, parts_.device),
      calibrate_(parts_.appliance.grabber(), session_, parts_.device, parts_.pool,
                 std::move(parts_.show_boards)),
      calibrations_(parts_, calibrate_),
      recording_(parts_.side_tasks, parts_.device) {
  algorithms_.begin(parts_.stages.algorithms());
}

// Nothing of it runs any longer than it lives.
TestCapture::~TestCapture() {
  parts_.side_tasks.cancel();
  for (const JobLane lane : {JobLane::Capture, JobLane::Worker, JobLane::Keeper})
    parts_.appliance.end_side_job(lane);
}

// What is measured with a calibration waits for one; the pages say so.
bool TestCapture::is_calibrated() {
  if (parts_.stages.calibration() != nullptr) return true;
  say({Errc::NotCalibrated, "this device has no calibration yet: calibrate its cameras first"});
  return false;
}

void TestCapture::opened(ui::StaffPage page) {
  recording_.hide();
  if (page == ui::StaffPage::Cameras) want_watch(true);
  if (page == ui::StaffPage::Calibrate) calibrations_.load_history();
  if (page == ui::StaffPage::Algorithms) algorithms_.act(TechnicianAct::LeaveOption);
  page_ = page;
  if (page == ui::StaffPage::Tables && at_rest()) tables_.refresh(source());
}

void TestCapture::closed(ui::StaffPage page) {
  if (page == ui::StaffPage::Cameras) want_watch(false);
  if (page != ui::StaffPage::Calibrate) return;
  if (next_ == Next::Calibration) next_ = Next::None;  // out of sight it would hold the cameras
  if (parts_.appliance.state() == State::Calibrate) calibrate_.finish();
}

void TestCapture::act(const ui::TechnicianRequest& request) {
  const auto* alone = std::get_if<ui::TechnicianAct>(&request);
  const bool ends = alone != nullptr &&
                    (*alone == TechnicianAct::StopCalibration || *alone == TechnicianAct::CancelCalibration);
  const bool calibrating = parts_.appliance.state() == State::Calibrate;
  if (ends ? !calibrating : parts_.appliance.state() != State::Staff) return;
  if (alone != nullptr) act_alone(*alone);
  if (const auto* again = std::get_if<ui::RunStages>(&request)) run(again->latest);
  if (const auto* shown = std::get_if<ui::ShowStage>(&request)) told_.stage = shown->stage;
  if (const auto* shown = std::get_if<ui::ShowTable>(&request)) tables_.show(shown->table, source());
  if (const auto* list = std::get_if<ui::ListRequest>(&request)) {
    if (page_ == ui::StaffPage::Tables && at_rest()) tables_.ask(*list, source());
    if (page_ == ui::StaffPage::Calibrate) calibrations_.walk(*list);
  }
  if (const auto* finger = std::get_if<ui::TouchPicture>(&request)) touch(*finger);
  if (const auto* dropped = std::get_if<ui::DropResult>(&request)) kept_.drop(dropped->index);
  if (const auto* saved = std::get_if<ui::LoadSaved>(&request)) load(saved->row, saved->beside);
  calibrations_.act(request);
  if (algorithms_.act(request)) told_.applied = false;
}

void TestCapture::act_alone(TechnicianAct act) {
  switch (act) {
    case TechnicianAct::Capture: return is_calibrated() ? wait_for_cameras(Next::Shot) : void();
    case TechnicianAct::AddSide: return may_add_side() ? wait_for_cameras(Next::Side) : void();
    case TechnicianAct::Stop: return stop();
    case TechnicianAct::RemovePair: return pairs_.remove();
    case TechnicianAct::ByHand: point_ = {}; return void(told_.by_hand = !told_.by_hand);
    case TechnicianAct::ApplySet: return apply_set();
    case TechnicianAct::KeepResult: return keep_result();
    case TechnicianAct::WatchCameras: return want_watch(!watch_wanted_);
    case TechnicianAct::ShowRelief: return watch_.show_relief(!watch_.shows_relief());
    case TechnicianAct::ShowDifference: return void(told_.differences = !told_.differences);
    case TechnicianAct::ShowEdges: return watch_.show_edges(!watch_.shows_edges());
    case TechnicianAct::BrighterShot: return watch_.change_light(1);
    case TechnicianAct::DarkerShot: return watch_.change_light(-1);
    case TechnicianAct::BeginCalibration: return wait_for_cameras(Next::Calibration);
    case TechnicianAct::StopCalibration: return calibrate_.finish();
    case TechnicianAct::CancelCalibration: return parts_.side_tasks.stop(taking_);
    case TechnicianAct::Record: return record();
    case TechnicianAct::StopRecording: return recording_.stop();
    case TechnicianAct::Save: return save();
    case TechnicianAct::ListSaved: told_.problem = {}; return recording_.list();
    case TechnicianAct::LeaveSaved: return recording_.hide();
    case TechnicianAct::StoreCalibration:  // the calibrations' own
    case TechnicianAct::SwitchCharuco:
    case TechnicianAct::SwitchMountedAnew:
    case TechnicianAct::ExportCalibration:
    case TechnicianAct::ImportCalibration:
    case TechnicianAct::EraseDigit:  // the algorithms' own
    case TechnicianAct::UseTyped:
    case TechnicianAct::UseDefault:
    case TechnicianAct::LeaveOption:
    case TechnicianAct::ResetSet: return;
  }
}

// What takes pictures begins when nobody else does any more. What was read from a stick waits for a run that
// has begun meanwhile, and is forgotten where a capture is wanted in its place.
void TestCapture::wait_for_cameras(Next what) {
  const bool loaded = what == Next::Loaded;
  const bool works = told_.phase == TechnicianPhase::Capturing || told_.phase == TechnicianPhase::Running;
  if (loaded || !works) next_ = what;
  if (!loaded && !works) saved_.reset();
  if (watching_) parts_.side_tasks.stop(taking_);
}

void TestCapture::keep_result() {
  if (!at_rest() || !run_.figures().view().there || kept_.has(model_number_)) return;
  const Products* made = products();
  kept_.keep(run_.figures(), run_.pictures(), made != nullptr && made->model ? &*made->model : nullptr,
             model_number_);
}

void TestCapture::record() {
  const Products* made = products();
  if (made == nullptr || !made->frame) return;
  hal::RecordedPair as_taken = loaded_ ? hal::RecordedPair() : shot_.as_taken();
  if (loaded_) {  // nobody knows its light
    as_taken.left_serial = calibration()->cameras.left;
    as_taken.right_serial = calibration()->cameras.right;
  }
  std::vector<pipeline::StereoFrame> shots{*made->frame};
  for (std::size_t i = 0; i < session_.sides().count(); ++i) shots.push_back(session_.sides().waiting(i));
  recording_.record(shots, as_taken);
}

// What fills the slot of the test capture waits until nobody else is at the cameras. What a calibration ends
// can be compared, where there is room.
void TestCapture::begin_next() {
  if (next_ == Next::None || parts_.side_tasks.busy(JobLane::Capture) ||
      parts_.side_tasks.busy(JobLane::Worker))
    return;
  const Next what = std::exchange(next_, Next::None);
  told_.problem = {};
  if (what == Next::Side) return may_add_side() ? shoot(true) : void();
  if (what == Next::Calibration || (what == Next::Loaded && saved_->beside)) keep_result();
  forget_capture();
  if (session_.is_open()) session_.retake();
  else if (const Result<void> opened = session_.open(""); !opened) return say(opened.error());
  if (what == Next::Shot) shoot(false);
  else if (what == Next::Calibration) calibrate();
  else take_over();
}

void TestCapture::forget_capture() {
  point_ = {};
  pairs_.forget();
  run_.change().forget();
  recording_.capture_gone();
  tables_.forget();
  run_.pictures().wipe();
  run_.figures().forget();
  told_.phase = TechnicianPhase::Empty;
  loaded_ = false;
}

void TestCapture::shoot(bool side) {
  told_.phase = TechnicianPhase::Capturing;
  shot_.order(side);
  if (!side) run_.name(stick_name_of(parts_.device.clock().wall_now()));
  taking_ = parts_.side_tasks.send(
      JobLane::Capture, [this](JobControl& control) { return shot_.run(control); },
      [this](const std::optional<Error>& error) { shot_done(error); });
}

void TestCapture::calibrate() {
  parts_.appliance.ask(ui::Intent::Calibrate);
  if (parts_.appliance.state() != State::Calibrate) return;
  calibrate_.order(calibrations_.order());
  calibrations_.begun();
  taking_ = parts_.side_tasks.send(
      JobLane::Capture, [this](JobControl& control) { return calibrate_.run(control); },
      [this](const std::optional<Error>& error) {
        calibrations_.ended();
        parts_.appliance.end_service_state(!error);
      });
}

// What a loaded reconstruction was made with, else what is in use.
const pipeline::StereoCalibration* TestCapture::calibration() const {
  return loaded_ ? &run_.making().calibration : parts_.stages.calibration();
}

// Nothing is done again that the algorithms have not changed, but for what is asked for by its stage.
void TestCapture::run(std::int64_t latest) {
  if (!at_rest() || !session_.is_open() || !session_.products().frame || (!loaded_ && !is_calibrated()))
    return;
  State changed = first_change(run_.making().set, algorithms_.set());
  if (pairs_.changed()) changed = std::min(changed, State::Reconstruct);
  // Of a head nothing is left to go on with; sides come to what is done.
  if (session_.products().registration) changed = State::Match;
  const bool only_sides = changed == State::Review && session_.sides().count() > 0;
  State first = changed == State::Review && !only_sides ? State::Match : changed;
  if (latest >= 1 && latest <= 4)
    first = std::min(changed, static_cast<State>(std::int64_t(State::Match) + latest - 1));
  run_.order(algorithms_.set(), *calibration(), first, pairs_.matches(), loaded_ && run_.making().whole_view);
  send_run();
}

void TestCapture::send_run() {
  told_.problem = {};
  point_ = {};
  tables_.forget();
  told_.phase = TechnicianPhase::Running;
  working_ = parts_.side_tasks.send(
      JobLane::Worker, [this](JobControl& control) { return run_.run(control); },
      [this](const std::optional<Error>& error) { run_done(error); });
}

void TestCapture::save() {
  const Products* made = products();
  if (made == nullptr || !made->frame) return;
  auto making = run_.making_with(pairs_.matches());  // a copy: the next run may be ordered meanwhile
  recording_.save([this, making = std::move(making)] { return make_document(session_.products(), making); });
}

// What is in the session stays until a whole document has been read.
void TestCapture::load(std::size_t row, bool beside) {
  const std::string name = recording_.saved_name(row);
  recording_.load(
      row,
      [this, name, beside](SavedBytes saved) {
        const auto document = storage::Document::open(saved);
        auto making = document ? making_of(*document) : Result<Making>(document.error());
        if (!making) return say(making.error());
        saved_ = {std::move(saved), name, *std::move(making), beside};
        wait_for_cameras(Next::Loaded);
      },
      [this](const Error& error) { say(error); });
}

void TestCapture::take_over() {
  Saved saved = *std::exchange(saved_, std::nullopt);
  algorithms_.begin(saved.making.set);
  run_.name(std::move(saved.name));
  run_.order(std::move(saved.bytes), std::move(saved.making));
  loaded_ = true;
  send_run();
}

void TestCapture::stop() {
  if (told_.phase == TechnicianPhase::Capturing) parts_.side_tasks.stop(taking_);
  if (told_.phase == TechnicianPhase::Running) parts_.side_tasks.stop(working_);
}

void TestCapture::shot_done(const std::optional<Error>& error) {
  told_.phase = shot_.is_side() ? TechnicianPhase::Ready : TechnicianPhase::Failed;
  if (error) return say(*error);
  if (!shot_.is_side()) run(1);
}

// A loaded reconstruction was made by other cameras, at another time.
bool TestCapture::may_add_side() const {
  return told_.phase == TechnicianPhase::Ready && !loaded_ && session_.is_open() && session_.has_sides() &&
         session_.products().model && session_.sides().count() < pipeline::kSides;
}

void TestCapture::run_done(const std::optional<Error>& error) {
  told_.phase = error ? TechnicianPhase::Failed : TechnicianPhase::Ready;
  ++model_number_;
  if (error) say(*error);
  const bool began = !run_.take_back();
  const Products* made = products();
  // Of a document that never came in nothing is there.
  loaded_ = loaded_ && made != nullptr && made->frame;
  if (began && made != nullptr && made->pair) {
    pairs_.show(*made->pair, run_.making().by_hand);
    run_.change().tell(pairs_.points());
  }
  tables_.show(tables_.view().table, source());
}

void TestCapture::touch(const ui::TouchPicture& touch) {
  const Products* made = products();
  if (made == nullptr || !made->pair) return;
  if (!told_.by_hand && !touch.right && !touch.dragged && made->matches)
    point_ = nearest_match(*made->pair, *made->matches, run_.figures(), touch.x, touch.y);
  if (!told_.by_hand) return;
  if (touch.dragged) pairs_.drag(*made->pair, !touch.right, touch.x, touch.y);
  else pairs_.touch(*made->pair, !touch.right, touch.x, touch.y);
}

// The keeper writes it down and makes the pipeline; from then on visitors are measured with it, also if the
// technician leaves meanwhile.
void TestCapture::apply_set() {
  if (applying_ || !is_calibrated()) return;
  applying_ = true;
  parts_.side_tasks.ask(
      JobLane::Keeper,
      [this, set = algorithms_.set()](JobControl&) -> Result<pipeline::Pipeline> {
        RELIEVO_TRY_ASSIGN(auto made, pipeline::Pipeline::make(set, *calibrations_.calibration()));
        RELIEVO_TRY(parts_.store.set_setting(kAlgorithmsSetting, set.to_text()));
        return made;
      },
      [this, visit = visit_](Result<pipeline::Pipeline> made) {
        if (made) calibrations_.use(*std::move(made), false);
        if (visit != visit_) {
          if (!made) parts_.log.fault(made.error());
          else if (!left_) algorithms_.begin(calibrations_.algorithms());
          return;
        }
        applying_ = false;
        if (!made) return say(made.error());
        told_.applied = true;
        told_.problem = {};
      },
      SideTasks::Whose::Device);
}

void TestCapture::want_watch(bool on) {
  watch_wanted_ = on;
  if (on) told_.problem = {};
  else if (watching_) parts_.side_tasks.stop(taking_);
}

// When nobody else is at the cameras any more.
void TestCapture::begin_watch() {
  if (!watch_wanted_ || watching_ || next_ != Next::None || told_.phase == TechnicianPhase::Capturing ||
      parts_.side_tasks.busy(JobLane::Capture))
    return;
  const Result<void> opened = session_.is_open() ? Result<void>() : session_.open("");
  if (!opened) {
    watch_wanted_ = false;
    return say(opened.error());
  }
  watch_.prepare(parts_.stages.calibration());
  watching_ = true;
  taking_ = parts_.side_tasks.send(
      JobLane::Capture, [this](JobControl& control) { return watch_.run(control); },
      [this](const std::optional<Error>& error) {
        watching_ = false;
        watch_.wipe();
        if (!error || error->code == Errc::Cancelled) return;
        watch_wanted_ = false;
        say(*error);
      });
}

// The appliance has stopped the work and closed the session on its way to another state.
void TestCapture::leave() {
  ++visit_;
  watch_.show_relief(false);
  watch_.show_edges(false);
  watch_wanted_ = watching_ = told_.by_hand = told_.applied = applying_ = told_.differences = false;
  next_ = Next::None;
  saved_.reset();
  watch_.wipe();
  kept_.wipe();
  calibrations_.forget();
  recording_.forget();
  run_.take_back();  // what was dropped while it waited, nobody hears of
  forget_capture();
  told_.problem = {};
  algorithms_.begin(parts_.stages.algorithms());
}

void TestCapture::turn() {
  calibrations_.turn();
  const State state = parts_.appliance.state();
  const bool mine = state == State::Staff || state == State::Calibrate || state == State::Export;
  if (!mine) {
    if (!std::exchange(left_, true)) leave();
    return;
  }
  // What the technician before has put into use may have come after they left.
  if (std::exchange(left_, false)) algorithms_.begin(calibrations_.algorithms());
  // It took longer than the state may: what has been seen is not worked out.
  if (calibrations_.running() && state == State::Staff) parts_.side_tasks.stop(taking_);
  begin_next();
  begin_watch();
  // Until they are compared the page shows them as they are.
  const Products* made = products();
  if (told_.differences && made != nullptr) kept_.compare_on_worker(parts_.side_tasks, *made, model_number_);
}

}  // namespace relievo::firmware
