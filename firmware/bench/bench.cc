// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/bench/bench.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "firmware/bench/show/touched_point.h"
#include "firmware/work/first_change.h"

namespace relievo::firmware {
namespace {

using ui::BenchAct;
using ui::BenchPhase;

constexpr float kTouchSteps = 4096;

struct Share {
  float x, y;
};
Share place_of(std::int64_t argument) {
  return {static_cast<float>(argument >> 12 & 0xFFF) / kTouchSteps,
          static_cast<float>(argument & 0xFFF) / kTouchSteps};
}

}  // namespace

Bench::Bench(Parts parts)
    : parts_(std::move(parts)),
      session_(parts_.appliance.session()),
      shot_(parts_.appliance.grabber(), session_, parts_.device, parts_.pool),
      run_(session_, parts_.pool, parts_.device.clock()),
      watch_(parts_.appliance.grabber(), session_, parts_.device),
      calibrate_(parts_.appliance.grabber(), session_, parts_.device, parts_.pool,
                 std::move(parts_.show_boards)),
      calibrations_({calibrate_, parts_.stages, parts_.store, parts_.errands, parts_.device.media(),
                     std::move(parts_.in_use)}),
      recording_(parts_.errands, parts_.device) {
  algorithms_.begin(parts_.stages.algorithms());
}

// Nothing of it runs any longer than it lives.
Bench::~Bench() {
  parts_.errands.cancel();
  for (const JobPlace place : {JobPlace::Capture, JobPlace::Worker, JobPlace::Keeper})
    parts_.appliance.end_side_job(place);
}

// What is measured with a calibration waits for one; the pages say so.
bool Bench::is_calibrated() {
  if (parts_.stages.calibration() != nullptr) return true;
  say({Errc::NotCalibrated, "this device has no calibration yet: calibrate its cameras first"});
  return false;
}

void Bench::say(const Error& error) { problem_ = ui::fault_of(error); }

void Bench::opened(ui::BenchPage page) {
  recording_.hide();
  if (page == ui::BenchPage::Cameras) watch_cameras(true);
  if (page == ui::BenchPage::Calibrate) calibrations_.load_history();
  if (page == ui::BenchPage::Algorithms) algorithms_.act({BenchAct::LeaveOption, 0});
  if (page == ui::BenchPage::Tables && at_rest()) tables_.turn(0, source());
}

void Bench::closed(ui::BenchPage page) {
  if (page == ui::BenchPage::Cameras) watch_cameras(false);
}

void Bench::act(ui::BenchOrder order) {
  const bool calibrating = parts_.appliance.state() == State::Calibrate;
  const bool ends = order.act == BenchAct::StopCalibration || order.act == BenchAct::CancelCalibration;
  if (ends ? !calibrating : parts_.appliance.state() != State::Staff) return;
  switch (order.act) {
    case BenchAct::None:
      break;
    case BenchAct::Capture:
      return is_calibrated() ? wait_for_cameras(Next::Shot) : void();
    case BenchAct::Run:
      return run(order.argument);
    case BenchAct::Stop:
      return stop();
    case BenchAct::ShowStage:
      if (order.argument >= 0 && order.argument < static_cast<std::int64_t>(ui::BenchStage::Count))
        stage_ = static_cast<ui::BenchStage>(order.argument);
      return;
    case BenchAct::Point:
    case BenchAct::PointRight:
    case BenchAct::Drag:
    case BenchAct::DragRight:
      return point(order);
    case BenchAct::RemovePair:
      return pairs_.remove();
    case BenchAct::ByHand:
      by_hand_ = !by_hand_;
      point_ = {};
      return;
    case BenchAct::ApplySet:
      return apply_set();
    case BenchAct::KeepResult:
      return keep_result();
    case BenchAct::DropResult:
      return kept_.drop(static_cast<std::size_t>(std::max<std::int64_t>(0, order.argument)));
    case BenchAct::ShowTable:
      if (order.argument >= 0 && order.argument < static_cast<std::int64_t>(ui::BenchTable::Count))
        tables_.show(static_cast<ui::BenchTable>(order.argument), source());
      return;
    case BenchAct::TurnPage:
      return tables_.turn(order.argument, source());
    case BenchAct::WatchCameras:
      return watch_cameras(!watching_);
    case BenchAct::ShowRelief:
      return watch_.show_relief(!watch_.shows_relief());
    case BenchAct::BrighterShot:
      return watch_.change_light(1);
    case BenchAct::DarkerShot:
      return watch_.change_light(-1);
    case BenchAct::BeginCalibration:
      return wait_for_cameras(Next::Calibration);
    case BenchAct::StopCalibration:
      return calibrate_.finish();
    case BenchAct::CancelCalibration:
      return parts_.errands.stop(JobPlace::Capture);
    case BenchAct::StoreCalibration:
    case BenchAct::Columns:
    case BenchAct::Rows:
    case BenchAct::Square:
    case BenchAct::Charuco:
    case BenchAct::ExportCalibration:
    case BenchAct::ImportCalibration:
    case BenchAct::Activate:
      return calibrations_.act(order);
    case BenchAct::Record:
      return record();
    case BenchAct::StopRecording:
      return recording_.stop();
    case BenchAct::Save:
      return save();
    case BenchAct::ListSaved:
      problem_ = {};
      return recording_.list();
    case BenchAct::LeaveSaved:
      return recording_.hide();
    case BenchAct::Load:
    case BenchAct::LoadBeside:
      return load(static_cast<std::size_t>(std::max<std::int64_t>(0, order.argument)),
                  order.act == BenchAct::LoadBeside);
    case BenchAct::ChooseKind:
    case BenchAct::ChooseName:
    case BenchAct::EditOption:
    case BenchAct::TypeDigit:
    case BenchAct::EraseDigit:
    case BenchAct::UseTyped:
    case BenchAct::UseDefault:
    case BenchAct::LeaveOption:
    case BenchAct::ResetSet:
      return choose(order);
  }
}

// What takes pictures begins when nobody else does any more.
void Bench::wait_for_cameras(Next what) {
  if (phase_ != BenchPhase::Capturing && phase_ != BenchPhase::Running) next_ = what;
  watch_cameras(false);
}

void Bench::choose(ui::BenchOrder order) {
  algorithms_.act(order);
  changed_ = first_change(run_.making().set, algorithms_.set()) != State::Review;
  applied_ = false;
}

void Bench::keep_result() {
  if (!at_rest() || !run_.figures().view().there || kept_.has(model_number_)) return;
  const Products* made = products();
  kept_.keep(run_.figures(), run_.pictures(), made != nullptr && made->model ? &*made->model : nullptr,
             model_number_);
}

void Bench::record() {
  const Products* made = products();
  if (made == nullptr || !made->frame) return;
  const bool set_by_hand = !parts_.errands.busy(JobPlace::Capture) && watch_.light().time.count() > 0;
  const hal::Exposure light =
      set_by_hand ? watch_.light() : hal::Exposure{parts_.device.preferred_mode().exposure, 1};
  hal::RecordedPair as_taken;
  as_taken.exposure_us = light.time.count();
  as_taken.gain = light.gain;
  as_taken.left_serial = loaded_ ? calibration()->cameras.left : shot_.serials().left;
  as_taken.right_serial = loaded_ ? calibration()->cameras.right : shot_.serials().right;
  recording_.record(*made->frame, std::move(as_taken));
}

// What fills the slot of the test capture waits until nobody else is at the cameras.
void Bench::begin_next() {
  if (next_ == Next::None || parts_.errands.busy(JobPlace::Capture) || parts_.errands.busy(JobPlace::Worker))
    return;
  const Next what = std::exchange(next_, Next::None);
  problem_ = {};
  point_ = {};
  pairs_.forget();
  run_.change().forget();
  recording_.capture_gone();
  tables_.forget();
  run_.pictures().wipe();
  run_.figures().forget();
  phase_ = BenchPhase::Empty;
  loaded_ = false;
  if (session_.is_open()) session_.retake();
  else if (const Result<void> opened = session_.open(""); !opened) return say(opened.error());
  if (what == Next::Shot) shoot();
  else if (what == Next::Calibration) calibrate();
  else take_over();
}

void Bench::shoot() {
  phase_ = BenchPhase::Capturing;
  run_.name(recording_.name_now());
  parts_.errands.send(
      JobPlace::Capture, [this](JobControl& control) { return shot_.run(control); },
      [this](const std::optional<Error>& error) { shot_done(error); });
}

void Bench::calibrate() {
  calibrate_.order(calibrations_.order());
  parts_.appliance.ask(ui::Intent::Calibrate);
  if (parts_.appliance.state() != State::Calibrate) return;
  calibrations_.begun();
  parts_.errands.send(
      JobPlace::Capture, [this](JobControl& control) { return calibrate_.run(control); },
      [this](const std::optional<Error>& error) {
        calibrations_.ended();
        parts_.appliance.end_service_state(!error);
      });
}

// What a loaded reconstruction was made with, else what is in use.
const pipeline::StereoCalibration* Bench::calibration() const {
  return loaded_ ? &run_.making().calibration : parts_.stages.calibration();
}

// Nothing is done again that the algorithms have not changed, but for what is asked for by its stage.
void Bench::run(std::int64_t latest) {
  if (!at_rest() || !session_.is_open() || !session_.products().frame || (!loaded_ && !is_calibrated()))
    return;
  State changed = first_change(run_.making().set, algorithms_.set());
  if (pairs_.changed()) changed = std::min(changed, State::Reconstruct);
  State first = changed == State::Review ? State::Match : changed;
  if (latest >= 1 && latest <= 4)
    first = std::min(changed, static_cast<State>(static_cast<std::int64_t>(State::Match) + latest - 1));
  run_.order(algorithms_.set(), *calibration(), first, pairs_.matches(), loaded_ && run_.making().whole_view);
  send_run();
}

void Bench::send_run() {
  problem_ = {};
  point_ = {};
  tables_.forget();
  changed_ = false;
  phase_ = BenchPhase::Running;
  parts_.errands.send(
      JobPlace::Worker, [this](JobControl& control) { return run_.run(control); },
      [this](const std::optional<Error>& error) { run_done(error); });
}

void Bench::save() {
  const Products* made = products();
  if (made == nullptr || !made->frame) return;
  recording_.save([this] { return make_document(session_.products(), run_.making()); });
}

// What is in the session stays until a whole document has been read.
void Bench::load(std::size_t row, bool beside) {
  const std::string name = recording_.saved_name(row);
  recording_.load(
      row,
      [this, name, beside](std::shared_ptr<const SavedBytes> saved) {
        const auto document = storage::Document::open(saved->bytes());
        auto making = document ? making_of(*document) : Result<Making>(document.error());
        if (!making) return say(making.error());
        if (beside) keep_result();
        saved_ = std::move(saved);
        saved_name_ = name;
        saved_making_ = *std::move(making);
        wait_for_cameras(Next::Loaded);
      },
      [this](const Error& error) { say(error); });
}

void Bench::take_over() {
  algorithms_.begin(saved_making_->set);
  run_.name(saved_name_);
  run_.order(std::exchange(saved_, nullptr), *std::exchange(saved_making_, std::nullopt));
  loaded_ = true;
  send_run();
}

void Bench::stop() {
  if (phase_ == BenchPhase::Capturing) parts_.errands.stop(JobPlace::Capture);
  if (phase_ == BenchPhase::Running) parts_.errands.stop(JobPlace::Worker);
}

void Bench::shot_done(const std::optional<Error>& error) {
  phase_ = BenchPhase::Failed;
  if (error) return say(*error);
  run(1);
}

void Bench::run_done(const std::optional<Error>& error) {
  phase_ = error ? BenchPhase::Failed : BenchPhase::Ready;
  ++model_number_;
  if (error) say(*error);
  if (const Products* made = products(); made != nullptr && made->pair) {
    pairs_.show(*made->pair, run_.making().by_hand);
    run_.change().tell(pairs_.points());
  }
  tables_.show(tables_.view().table, source());
}

void Bench::point(ui::BenchOrder order) {
  const Products* made = products();
  if (made == nullptr || !made->pair) return;
  const Share at = place_of(order.argument);
  if (!by_hand_ && order.act == BenchAct::Point && made->matches)
    point_ = nearest_match(*made->pair, *made->matches, run_.figures(), at.x, at.y);
  if (!by_hand_) return;
  const bool left = order.act == BenchAct::Point || order.act == BenchAct::Drag;
  if (order.act == BenchAct::Point || order.act == BenchAct::PointRight)
    pairs_.touch(*made->pair, left, at.x, at.y);
  else pairs_.drag(*made->pair, left, at.x, at.y);
}

// The keeper writes it down and makes the pipeline; from then on visitors are measured with it.
void Bench::apply_set() {
  if (applying_ || !is_calibrated()) return;
  applying_ = true;
  const auto made = std::make_shared<std::optional<pipeline::Pipeline>>();
  const pipeline::AlgorithmSet set = algorithms_.set();
  parts_.errands.send(
      JobPlace::Keeper,
      [this, made, set](JobControl&) -> Result<void> {
        RELIEVO_TRY_ASSIGN(*made, pipeline::Pipeline::make(set, *parts_.stages.calibration()));
        return parts_.store.set_setting(kAlgorithmsSetting, set.to_text());
      },
      [this, made](const std::optional<Error>& error) {
        applying_ = false;
        if (error) return say(*error);
        parts_.stages.replace(*std::move(*made));
        applied_ = true;
        problem_ = {};
      });
}

void Bench::watch_cameras(bool on) {
  if (on == watching_) return;
  if (!on) return parts_.errands.stop(JobPlace::Capture);
  if (parts_.errands.busy(JobPlace::Capture) || phase_ == BenchPhase::Capturing) return;
  if (!session_.is_open() && !session_.open("")) return;
  problem_ = {};
  watch_.prepare(parts_.stages.calibration());
  watching_ = true;
  parts_.errands.send(
      JobPlace::Capture, [this](JobControl& control) { return watch_.run(control); },
      [this](const std::optional<Error>& error) {
        watching_ = false;
        watch_.wipe();
        if (error && error->code != Errc::Cancelled) say(*error);
      });
}

// The appliance has stopped the work and closed the session on its way to another state.
void Bench::leave() {
  watch_.show_relief(false);
  watching_ = by_hand_ = changed_ = applied_ = applying_ = false;
  next_ = Next::None;
  saved_.reset();
  saved_making_.reset();
  loaded_ = false;
  watch_.wipe();
  run_.pictures().wipe();
  run_.figures().forget();
  kept_.wipe();
  tables_.forget();
  calibrations_.forget();
  recording_.forget();
  point_ = {};
  pairs_.forget();
  run_.change().forget();
  phase_ = BenchPhase::Empty;
  problem_ = {};
  algorithms_.begin(parts_.stages.algorithms());
}

void Bench::turn() {
  const State state = parts_.appliance.state();
  const bool mine = state == State::Staff || state == State::Calibrate || state == State::Export;
  if (!mine) {
    if (!std::exchange(left_, true)) leave();
    return;
  }
  left_ = false;
  // It took longer than the state may: what has been seen is not worked out.
  if (calibrations_.running() && state == State::Staff) parts_.errands.stop(JobPlace::Capture);
  begin_next();
}

}  // namespace relievo::firmware
