// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/staff/staff_controller.h"

#include <algorithm>
#include <span>

#include "firmware/base/wall_time.h"
#include "firmware/report/report.h"
#include "ui/device/settings.h"
#include "ui/screens/staff_screens.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {
namespace {

// The controllers of the staff's pages, one line each. Pages on which PINs are typed belong to SignIn.
// Thread: main. Errors: none.
using Pages = std::span<std::unique_ptr<PageController>>;

// What is in force and how the last try ended is in every view (StaffController).
class ConsentController final : public PageController {
 public:
  using PageController::PageController;
  void opened() override { services().consent.opened(); }
  void ask(const ui::StaffRequest& request) override {
    if (request.as<ui::TakeConsentText>() != nullptr) services().consent.take();
  }
  void show(ui::ServiceView&) override {}
};

// Each role changes those that are theirs.
class SettingsController final : public PageController {
 public:
  using PageController::PageController;
  void opened() override { outcome_ = ui::Outcome::None; }
  void ask(const ui::StaffRequest& request) override {
    const auto* asked = request.as<ui::ChangeSetting>();
    if (asked == nullptr) return;
    const ui::Setting setting = asked->setting;
    const ui::SettingInfo& info = info_of(setting);
    if (!(services().role == ui::StaffRole::Technician ? info.for_technician : info.for_operator)) return;
    const std::int32_t value = services().settings.wanted().beside(setting, asked->more ? 1 : -1);
    services().settings.change(setting, value, [this](const std::optional<Error>& error) {
      outcome_ = error ? outcome_of(*error) : ui::Outcome::Done;
    });
    if (setting == ui::Setting::KeepDays) services().retention.begin_anew();
  }
  void show(ui::ServiceView& view) override {
    view.work.outcome = outcome_;
    view_ = {services().settings.wanted(), services().retention.clock_jumped()};
    view.settings = &view_;
  }

 private:
  ui::Outcome outcome_ = ui::Outcome::None;
  ui::SettingsView view_;
};

class StatisticsController final : public PageController {
 public:
  using PageController::PageController;
  void show(ui::ServiceView& view) override {
    view_ = services().statistics.view(
        std::chrono::floor<std::chrono::days>(services().device.clock().wall_now()));
    view.statistics = &view_;
  }

 private:
  ui::StatisticsView view_;
};

// TouchTrial is abandoned with the page.
class TouchController final : public PageController {
 public:
  using PageController::PageController;
  void opened() override { services().touch.abandon(); }
  void closed() override { services().touch.abandon(); }
  void ask(const ui::StaffRequest& request) override {
    if (request.as<ui::BeginTouchTrial>() != nullptr) services().touch.begin();
    if (request.as<ui::TakePlainTouch>() != nullptr) services().touch.take_plain();
  }
  void show(ui::ServiceView& view) override { view.touch = &services().touch.view(); }
};

// Behind one of the technician's seven picture pages, which share one TestCapture.
class TechnicianController final : public PageController {
 public:
  TechnicianController(PageServices& services, TestCapture& test_capture, ui::StaffPage page)
      : PageController(services), test_capture_(test_capture), page_(page) {}
  void opened() override { test_capture_.opened(page_); }
  void ask(const ui::StaffRequest& request) override {
    if (const auto* asked = request.as<ui::TechnicianRequest>()) test_capture_.act(*asked);
    if (const auto* list = request.as<ui::ListRequest>()) test_capture_.act(ui::TechnicianRequest(*list));
  }
  void show(ui::ServiceView& view) override {
    view.technician = &test_capture_.view();
    if (page_ == ui::StaffPage::Stages || page_ == ui::StaffPage::Compare)
      view.work = view.technician->recording;
    view.inner = page_ == ui::StaffPage::Algorithms && view.technician->choice.edited != nullptr;
  }
  void closed() override { test_capture_.closed(page_); }

 private:
  TestCapture& test_capture_;
  ui::StaffPage page_;
};

// pages[page]: none where SignIn answers, or nobody.
void fill_page_controllers(PageServices& services, Pages pages) {
  const auto at = [&](ui::StaffPage page) -> std::unique_ptr<PageController>& {
    return pages[std::size_t(page)];
  };
  for (const auto page : {ui::StaffPage::Menu, ui::StaffPage::Recovery, ui::StaffPage::SelfTest,
                          ui::StaffPage::Trigger, ui::StaffPage::Log})
    at(page) = device_controller(services, page);
  at(ui::StaffPage::Records) = records_controller(services);
  at(ui::StaffPage::Statistics) = std::make_unique<StatisticsController>(services);
  at(ui::StaffPage::Consent) = std::make_unique<ConsentController>(services);
  at(ui::StaffPage::Health) = health_controller(services);
  at(ui::StaffPage::Touch) = std::make_unique<TouchController>(services);
  at(ui::StaffPage::Settings) = std::make_unique<SettingsController>(services);
}

// One table says who may open what: the menu's.
bool may_open(ui::StaffRole role, ui::StaffPage page) {
  for (const ui::StaffPageInfo& info : ui::staff_pages()) {
    if (info.page == page) return ui::may_open(role, info);
  }
  return false;
}

using ui::StaffPage;
using ui::StaffRole;

constexpr std::chrono::seconds kWarning{15};  // before somebody is signed out

bool is_service(State state) {
  return state == State::Staff || state == State::Calibrate || state == State::Export;
}

}  // namespace

ui::Outcome outcome_of(const Error& error) {
  switch (error.code) {
    case Errc::Cancelled: return ui::Outcome::Cancelled;
    case Errc::MediaMissing: return ui::Outcome::NoStick;
    case Errc::MediaFull: return ui::Outcome::StickFull;
    case Errc::Disconnected: return ui::Outcome::StickGone;
    case Errc::NotFound: return ui::Outcome::NotFound;
    case Errc::InvalidInput:
    case Errc::InvalidState:
    case Errc::Unsupported: return ui::Outcome::Refused;
    case Errc::Timeout:
    case Errc::NotCalibrated:
    case Errc::NoFace:
    case Errc::TooFewMatches:
    case Errc::PoorGeometry:
    case Errc::LibraryFailed:
    case Errc::OutOfMemory:
    case Errc::StoreCorrupt:
    case Errc::StoreNewer:
    case Errc::IoFailed:
    case Errc::Count: break;
  }
  return ui::Outcome::Failed;
}

StaffController::StaffController(Parts parts)
    : parts_(std::move(parts)),
      log_(parts_.device.clock(), parts_.folder / kLogFile),
      side_tasks_(parts_.appliance),
      settings_(parts_.store, side_tasks_, log_, parts_.device.clock()),
      retention_(parts_.store, side_tasks_, log_, parts_.device.clock()),
      touch_(parts_.store, side_tasks_, log_, parts_.device.clock()),
      consent_(parts_.store, parts_.folder, parts_.device.media(), side_tasks_, log_),
      services_{parts_.appliance, parts_.device, parts_.store,      side_tasks_, log_,
                statistics_,      costs_,        settings_,         retention_,  touch_,
                consent_,         parts_.folder, parts_.calibration},
      sign_in_(services_, parts_.set_clock) {
  fill_page_controllers(services_, pages_);
  parts_.appliance.on_change([this](const Transition& change) { noted(change); });
}

StaffController::~StaffController() {
  parts_.appliance.on_change({});
  close_page();
  for (const JobLane lane : {JobLane::Capture, JobLane::Worker, JobLane::Keeper})
    parts_.appliance.end_side_job(lane);  // it uses what is below
  // One that never came to rest has written nothing yet; one that never had a screen has nothing to say.
  if (turned_ && log_.unsaved()) (void)log_.save();
}

Result<std::unique_ptr<StaffController>> StaffController::open(Parts parts) {
  std::unique_ptr<StaffController> staff(new StaffController(std::move(parts)));
  RELIEVO_TRY(staff->sign_in_.look());
  RELIEVO_TRY(staff->settings_.look());
  RELIEVO_TRY(staff->touch_.look());
  RELIEVO_TRY(staff->consent_.look(staff->parts_.console));
  RELIEVO_TRY_ASSIGN(const std::string kept, staff->parts_.store.setting(kStatisticsSetting));
  if (!staff->statistics_.read(kept))
    staff->statistics_.begin(text_of(stored_time(staff->parts_.device.clock().wall_now())).substr(0, 10));
  RELIEVO_TRY_ASSIGN(const std::string costs, staff->parts_.store.setting(kVisitCostsSetting));
  (void)staff->costs_.read(costs);
  RELIEVO_TRY_ASSIGN(const bool words, staff->parts_.store.has_recovery_words());
  staff->services_.words_due = !words;
  staff->log_.say(ui::LogEvent::Started);
  return staff;
}

void StaffController::set_test_capture(std::unique_ptr<TestCapture> test_capture) {
  test_capture_ = std::move(test_capture);
  for (auto i = std::size_t(StaffPage::Stages); i <= std::size_t(StaffPage::Calibrate); ++i)
    pages_[i] = std::make_unique<TechnicianController>(services_, *test_capture_, static_cast<StaffPage>(i));
}

void StaffController::noted(const Transition& change) {
  std::chrono::nanoseconds total{0};
  for (const StageRecord& record : parts_.appliance.records()) total += record.took;
  const auto& problem = parts_.appliance.problem();
  // From other states, and on the way to Fuse, the problem is still that of a visit before.
  const bool newly = !is_service(change.from) && change.from != State::Fault && change.to != State::Fuse;
  const bool wrong = newly && (change.event == Event::Failed || change.event == Event::StageFailed ||
                               change.event == Event::AdviceGiven || change.event == Event::Timeout);
  statistics_.noted(change, problem ? &*problem : nullptr, total,
                    std::chrono::floor<std::chrono::days>(parts_.device.clock().wall_now()));
  if (change.to == State::Idle) fault_.reset();
  if (wrong && problem) note_fault(change, *problem);
  const bool ends = change.to == State::Idle || change.to == State::Fault;
  if (ends && is_of_a_visit(change.from)) costs_.noted(parts_.appliance.records(), peak_rss_bytes());
}

// A fault tests itself again every few seconds: what it finds each time is said once.
void StaffController::note_fault(const Transition& change, const Error& problem) {
  const bool tested = change.from == State::SelfTest;
  if (tested && fault_ && fault_->code == problem.code && fault_->what.view() == problem.what.view()) return;
  log_.fault(problem);
  if (change.to != State::Fault) return;
  fault_ = problem;
  // The place may be somebody's, but for the self-test's, which are the cameras.
  parts_.console.fail(tested ? problem : Error{problem.code, problem.what});
}

void StaffController::clock_is(bool right, storage::WallTime newest_record) {
  if (std::exchange(clock_right_, right) == right || right) return;
  const Error wrong{
      Errc::InvalidState,
      "the clock is before 2026, or a day before the newest record: nobody can enrol until it is set, or the staff say that it is right"};
  const auto now = stored_time(parts_.device.clock().wall_now());
  log_.fault(wrong);
  const bool any = newest_record != storage::WallTime{};
  parts_.console.fail(wrong.at("the clock says " + text_of(now) +
                               (any ? ", the newest record is of " + text_of(newest_record) : "")));
}

void StaffController::touched() {
  last_touch_ = parts_.device.clock().now();
  // The machine's limit comes after this clock's; an export has more time by its progress alone.
  if (inside() && parts_.appliance.state() != State::Export) parts_.appliance.ask(ui::Intent::StillHere);
}

void StaffController::ask(const ui::StaffRequest& request) {
  touched();
  if (request.as<ui::PageLeft>() != nullptr) return leave();
  const bool signs_in = request.page == StaffPage::Pin || request.page == StaffPage::FirstStart ||
                        request.page == StaffPage::Pins || request.page == StaffPage::Clock;
  if (!inside() && request.page != StaffPage::Pin && request.page != StaffPage::FirstStart) return;
  if (request.as<ui::PageOpened>() != nullptr) {
    close_page();
    if (signs_in) sign_in_.opened(request.page);
    const bool may = request.page == StaffPage::Menu ? inside() : may_open(role_, request.page);
    page_ = may ? pages_[std::size_t(request.page)].get() : nullptr;
    if (page_ != nullptr) page_->opened();
    return;
  }
  if (signs_in) return sign_in_.ask(request, role_);
  if (page_ != nullptr && page_ == pages_[std::size_t(request.page)].get()) page_->ask(request);
}

void StaffController::close_page() {
  if (page_ != nullptr) page_->closed();
  page_ = nullptr;
}

// The machine lets somebody in from Idle or Fault only; from a self-test as soon as it has ended.
void StaffController::let_in() {
  if (const StaffRole entered = sign_in_.take_entered(); entered != StaffRole::None) waiting_ = entered;
  if (waiting_ == StaffRole::None) return;
  parts_.appliance.ask(ui::Intent::OpenStaff);
  if (parts_.appliance.state() != State::Staff) return;
  role_ = services_.role = std::exchange(waiting_, StaffRole::None);
  touched();
}

void StaffController::leave() {
  waiting_ = StaffRole::None;
  sign_in_.forget();
  if (!inside()) return;
  if (parts_.appliance.state() != State::Staff) parts_.appliance.ask(ui::Intent::Cancel);
  parts_.appliance.ask(ui::Intent::LeaveStaff);
}

int StaffController::seconds_left() const {
  const auto left = std::chrono::ceil<std::chrono::seconds>(
      last_touch_ + std::chrono::seconds(settings().of(ui::Setting::StaffPatienceS)) -
      parts_.device.clock().now());
  return int(std::max<std::int64_t>(0, left.count()));
}

void StaffController::turn() {
  turned_ = true;
  side_tasks_.turn();
  touch_.turn();
  let_in();
  const State state = parts_.appliance.state();
  // A calibration is somebody's, even if nobody touches the screen; so is an export or a long search of the
  // records, as long as it goes on: no limit of the machine's ends that either.
  const float kept = side_tasks_.progress(JobLane::Keeper);
  const bool goes_on = kept > std::exchange(kept_, kept);
  if (inside() && goes_on) parts_.appliance.ask(ui::Intent::StillHere);
  if (state == State::Calibrate || state == State::Export || goes_on) touched();
  if (inside() && state == State::Staff && seconds_left() == 0) leave();
  if (inside() && !is_service(parts_.appliance.state())) {
    close_page();
    side_tasks_.cancel();
    sign_in_.forget();
    role_ = services_.role = StaffRole::None;
    log_.say(ui::LogEvent::SignedOut);
  }
  if (test_capture_ != nullptr) test_capture_->turn();
  if (state == State::Idle || state == State::Staff || state == State::Fault) save_what_changed();
  if (state == State::Idle || state == State::Staff) {
    for (const auto& page : pages_)
      if (page != nullptr) page->turn();
  }
  if (state == State::Idle) retention_.turn(settings());
}

void StaffController::save_what_changed() {
  if (side_tasks_.busy(JobLane::Keeper)) return;
  const bool counted = statistics_.take_changed(), cost = costs_.take_changed();
  if (!counted && !cost && !log_.unsaved()) return;
  side_tasks_.send(
      JobLane::Keeper,
      [this, counts = counted ? statistics_.text() : std::string(),
       costs = cost ? costs_.text() : std::string()](JobControl&) -> Result<void> {
        // Each by itself: a log that cannot be written takes no count with it. Nothing is said of it either:
        // a full disk must not fill the log with its own complaint.
        (void)log_.save();
        if (!costs.empty()) (void)parts_.store.set_setting(kVisitCostsSetting, costs);
        if (!counts.empty()) (void)parts_.store.set_setting(kStatisticsSetting, counts);
        return {};
      },
      [](const std::optional<Error>&) {}, SideTasks::Whose::Device);
}

const ui::ServiceView& StaffController::view() {
  view_ = {};
  view_.role = role_;
  if (inside() && parts_.appliance.state() == State::Staff && seconds_left() <= kWarning.count())
    view_.leaves_in_s = seconds_left();
  sign_in_.show(view_.access);
  view_.access.words_due = services_.words_due;
  view_.consent = &consent_.view();
  if (page_ != nullptr) page_->show(view_);
  return view_;
}

}  // namespace relievo::firmware
