// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/kiosk/kiosk.h"

#include <string.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <thread>

#include "firmware/arguments/algorithm_choice.h"
#include "firmware/base/budget.h"
#include "firmware/base/settings.h"
#include "firmware/base/wall_time.h"
#include "firmware/jobs/job_thread.h"
#include "hal/recording/capture_file.h"
#include "pipeline/calibrate/file/calibration_file.h"

namespace relievo::firmware {

Result<std::unique_ptr<Kiosk>> Kiosk::open(const KioskArgs& args, Services& services) {
  std::unique_ptr<Kiosk> kiosk(new Kiosk);
  RELIEVO_TRY(kiosk->prepare(args, services));
  return kiosk;
}

Result<Kiosk::MaybeCalibration> Kiosk::find_calibration(const KioskArgs& args, const MaybeCalibration& given,
                                                        Services& services) {
  std::string named = args.calibration.filename().string();
  auto found = given ? Result(*given) : store_->active_calibration();
  if (!given && !found && found.error().code == Errc::NotCalibrated) {
    if (args.device != "sim" || !services.simulated_calibration) return MaybeCalibration();
    found = services.simulated_calibration();
    named = "of the simulated rig";
  }
  if (!found) return found.error();
  revision_ = found->revision;
  if (!named.empty()) {
    RELIEVO_TRY_ASSIGN(revision_, store_->know_calibration(*found, named));
  }
  return std::optional(*found);
}

// What the technician has chosen, as far as this program knows it: only their page can mend the rest.
Result<pipeline::AlgorithmSet> Kiosk::chosen_algorithms(std::vector<std::string>& unknown) {
  RELIEVO_TRY_ASSIGN(const std::string kept, store_->setting(kAlgorithmsSetting));
  RELIEVO_TRY_ASSIGN(auto set, pipeline::AlgorithmSet::from_text(kept, &unknown));
  (void)read_texts(set);  // a file that went away keeps nobody out: its algorithm says so
  return set;
}

// Without a calibration everything is made that needs none: the rest comes with the first one
// (make_test_capture).
Result<void> Kiosk::set_up_measuring(const KioskArgs& args, const MaybeCalibration& given, Services& services,
                                     std::vector<std::string>& unknown) {
  RELIEVO_TRY_ASSIGN(const MaybeCalibration calibration, find_calibration(args, given, services));
  RELIEVO_TRY_ASSIGN(pipeline::AlgorithmSet set, chosen_algorithms(unknown));
  RELIEVO_TRY_ASSIGN(auto judge, calibration ? LiveJudge::open(*calibration)
                                             : LiveJudge::open(device_->preferred_mode().width_px));
  judge_ = std::make_unique<LiveJudge>(std::move(judge));
  auto made = pipeline::Pipeline::make(set, calibration.value_or(pipeline::StereoCalibration{}));
  if (!made) {  // what is left of a choice need not fit together
    services.console.fail(made.error());
    unknown.emplace_back(kAlgorithmsSetting);
    set = {};
    made = pipeline::Pipeline::make(set, calibration.value_or(pipeline::StereoCalibration{}));
  }
  if (!made) return made.error();
  stages_ = std::make_unique<PipelineStages>(set);
  if (calibration) stages_->replace(*std::move(made));
  return {};
}

namespace {

bool is_recorded_head(const std::string& device) {
  constexpr std::string_view kFolder = "folder:";
  if (!device.starts_with(kFolder)) return false;
  const auto capture = hal::read_capture_file(Path(device.substr(kFolder.size())) / "capture.json");
  return capture && capture->head;
}

constexpr std::chrono::seconds kShownInVain{4};  // a side of a recording, before its next is shown

}  // namespace

Result<void> Kiosk::prepare(const KioskArgs& args, Services& services) {
  RELIEVO_TRY_ASSIGN(auto text, ui::TextEngine::make());
  ui_ = std::make_unique<ui::Ui>(std::move(text));
  // Before the store: a trigger line leaves a process with a copy of all memory, and no key may be in it.
  RELIEVO_TRY_ASSIGN(device_, services.open_device(args.device));
  MaybeCalibration given;  // read before a store is made
  if (const hal::CaptureMode mode = device_->preferred_mode(); !args.calibration.empty()) {
    RELIEVO_TRY_ASSIGN(given,
                       pipeline::read_calibration(args.calibration, {mode.width_px, mode.height_px, 0}));
  }
  RELIEVO_TRY_ASSIGN(const Path folder, store_folder(args.store));
  RELIEVO_TRY_ASSIGN(store_, services.open_store(folder, true));
  may_tell_known_ = args.tells_known;
  RELIEVO_TRY_ASSIGN(newest_record_, store_->last_added_at());
  if (services.turn_head && (args.device == "sim" || is_recorded_head(args.device)))
    turn_head_ = [this, turn = services.turn_head](double yaw_deg) { turn(*device_, yaw_deg); };
  std::vector<std::string> unknown;
  RELIEVO_TRY(set_up_measuring(args, given, services, unknown));
  open_speaker_ = services.open_speaker;
  if (services.find_presence_sensor) presence_ = services.find_presence_sensor();
  memory_ = std::make_unique<BootMemory>(budget::plan_of_a_head(device_->preferred_mode().pixels()));
  std::thread([this] {
    stand_behind_the_page();
    pool_ = std::make_unique<ThreadPool>(pool_size());
  }).join();
  if (auto piece = InvitationHead::read(asset_folder())) invitation_head_ = std::move(*piece);
  else services.console.fail(piece.error());  // a page without its head is still a page
  visits_ = std::make_unique<StoredVisits>(*store_, device_->clock(), folder);
  appliance_ = std::make_unique<Appliance>(
      Appliance::Parts{*device_, *stages_, *memory_, *pool_, *visits_, judge_.get()});
  moved_faces_ = std::make_unique<MovedFaces>(*store_);
  RELIEVO_TRY_ASSIGN(MovedFaces::Said moved, moved_faces_->read(revision_));
  appliance_->remember_moved(moved.faces, std::move(moved.note));
  if (const auto* calibration = stages_->calibration()) appliance_->grabber().expect(calibration->cameras);
  RELIEVO_TRY_ASSIGN(staff_, StaffController::open({*appliance_, *device_, *store_, folder, revision_,
                                                    services.set_clock, services.console}));
  for (const std::string& line : unknown) staff_->log().say(ui::LogEvent::SettingUnknown, {line});
  staff_->set_test_capture(make_test_capture(args, services));
  code_scanner_ = std::make_unique<CodeScanner>(*appliance_, *device_);
  slip_ = std::make_unique<ReceiptSlip>(staff_->side_tasks(),
                                        services.make_printer ? services.make_printer() : nullptr);
  take_home_ = std::make_unique<TakeHome>(
      TakeHome::Parts{staff_->side_tasks(), device_->media(), *store_, device_->clock(), staff_->log()});
  rest_cameras_ = std::make_unique<FunctionJob>([this](JobControl&) {
    appliance_->grabber().stop();
    return Result<void>();
  });
  look_at_cameras_ = std::make_unique<FunctionJob>([this](JobControl& control) -> Result<void> {
    RELIEVO_TRY(take_and_forget(appliance_->grabber(), appliance_->session(), *device_, control.cancelled));
    return {};
  });
  // Last: a start that fails leaves the mark as it was.
  RELIEVO_TRY_ASSIGN(run_mark_, RunMark::set(folder));
  if (restarted_ = run_mark_->ended_early(); restarted_) staff_->log().say(ui::LogEvent::EndedEarly);
  look();
  return {};
}

// Before the simulated rig somebody holds a board when it is calibrated.
std::unique_ptr<TestCapture> Kiosk::make_test_capture(const KioskArgs& args, Services& services) {
  ShowBoards show;
  if (args.device == "sim" && services.hold_board) {
    show = [hold = services.hold_board](const BoardArgs& board) -> Result<std::unique_ptr<LivePairs>> {
      CalibrateLiveArgs held;
      held.board = board;
      return hold(held);
    };
  }
  return std::make_unique<TestCapture>(
      TechnicianParts{*appliance_, staff_->side_tasks(), *device_, *stages_, *pool_, *store_, staff_->log(),
                      std::move(show), [this](const pipeline::StereoCalibration& calibration) {
                        revision_ = calibration.revision;
                        judge_->use(calibration);
                        appliance_->grabber().expect(calibration.cameras);
                        appliance_->calibrated_anew();
                      }});
}

VisitRecord Kiosk::record_of(const ui::VisitRequest& request) const {
  VisitRecord record;
  const bool known = request.enrolment_kind != ui::EnrolmentKind::NewSubject;
  record.name = known ? claimed_.view() : request.name;
  if (known) record.whose = appliance_->answer().record;
  record.renews = request.enrolment_kind == ui::EnrolmentKind::Renewal;
  record.consent = {view_.consent != nullptr ? view_.consent->version : std::string(request.wording),
                    std::string(request.language), stored_time(request.agreed_at)};
  record.calibration = revision_;
  record.calibration_note = "store revision " + std::to_string(revision_);
  record.algorithms = stages_->algorithms().to_text();
  record.least_room_mib = view_.settings.of(ui::Setting::LeastRoomMib);
  return record;
}

// A consent must not bear a date before the newest record came in, nor one before this program was; nobody is
// photographed by cameras that cannot measure.
ui::Trouble Kiosk::out_of_order() const {
  using namespace std::chrono_literals;
  constexpr std::chrono::sys_days kNoEarlier{std::chrono::year{2026} / 1 / 1};
  const auto now = device_->clock().wall_now();
  if (now < kNoEarlier || now < newest_record_ - 24h) return ui::Trouble::Clock;
  if (stages_->calibration() == nullptr) return ui::Trouble::Uncalibrated;
  if (!exchanged_.empty() || appliance_->moved_in_a_row() >= budget::kMovedFaces)
    return ui::Trouble::Calibration;
  return unwell_ == ui::Trouble::None && restarted_ ? ui::Trouble::Restarted : unwell_;
}

void Kiosk::look() {
  view_ = view_of(*appliance_);
  view_.now = device_->clock().now();
  view_.wall_now = device_->clock().wall_now();
  if (appliance_->state() != State::Store) view_.receipt = appliance_->kept().receipt.view();
  if (!view_.receipt.empty()) newest_record_ = std::max(newest_record_, appliance_->kept().at);
  if (ui_->service().open || ui_->visit().step == ui::Step::Attract) staff_->consent().adopt();
  view_.consent = staff_->consent().now();
  view_.cameras_on = appliance_->grabber().streams();
  slip_->follow(view_, appliance_->kept().link.view());
  // The staff read their pages in languages of their own; a visitor what can be consented to.
  for (std::size_t i = 0; i < ui::kLanguages; ++i)
    view_.languages[i] = ui_->service().open || view_.consent == nullptr || view_.consent->in[i].has_value();
  view_.settings = staff_->settings();
  const ui::Step step = ui_->visit().step;
  take_home_->follow(view_, step != ui::Step::Starting && step != ui::Step::Attract &&
                                step != ui::Step::Trouble && !ui_->service().open);
  appliance_->set_attempts(view_.settings.of(ui::Setting::Attempts));
  // Recorded pictures turn nowhere.
  appliance_->ask_for_sides(view_.settings.is_on(ui::Setting::Sides) && (device_->is_live() || turn_head_));
  std::size_t home = std::size_t(view_.settings.of(ui::Setting::Language));
  while (!view_.languages[home]) home = (home + 1) % ui::kLanguages;
  view_.home = static_cast<ui::Language>(home);
  view_.known = appliance_->answer().known;
  if (code_scanner_->is_looking()) view_.live = appliance_->live().newest();
  const Result<void> cameras = appliance_->grabber().check_cameras();
  exchanged_ = cameras ? ui::Fault{} : ui::fault_of(cameras.error());
  if (!cameras) view_.calibration_note = exchanged_;
  view_.service = &staff_->view();
  // Whoever says that the clock is right knows better than a record that was made while it was ahead.
  const auto now = stored_time(view_.wall_now);
  if (staff_->take_clock_confirmed()) newest_record_ = std::min(newest_record_, now);
  view_.out_of_order = out_of_order();
  staff_->clock_is(view_.out_of_order != ui::Trouble::Clock, newest_record_);
  if (invitation_head_) view_.invitation_head = &invitation_head_->model();
  if (voice_) voice_->look(view_);
  view_.somebody_near = presence_ == nullptr || presence_->is_on();
}

// A page that cannot be made for want of memory is left out; the visit that wanted it ends with an apology.
// Where even that cannot be shown, the program ends, to be started anew.
template <typename Work>
void Kiosk::guarded(const Work& work) {
  try {
    work();
  } catch (const std::bad_alloc&) {
    const hal::Instant now = device_->clock().now();
    // A page that is made is drawn without memory, though no finger is answered: not every turn fails.
    if (!short_since_ || now - short_last_ > budget::kMemoryIsBack) short_since_ = now;
    short_last_ = now;
    if (now - *short_since_ > budget::kShortOfMemory) throw;
    if (appliance_->session().is_open())
      appliance_->give_up({Errc::OutOfMemory, "the appliance's memory is used up: begin again"});
  }
}

void Kiosk::feed(const ui::Input& input) {
  guarded([&] { hear(input); });
}

void Kiosk::turn() {
  guarded([this] { turn_once(); });
}

void Kiosk::hear(const ui::Input& input) {
  const float w = float(ui_->width_px()), h = float(ui_->height_px());
  const bool finger = (input.kind == ui::Input::Kind::Down || input.kind == ui::Input::Kind::Move ||
                       input.kind == ui::Input::Kind::Up) &&
                      input.finger != ui::kMouse;
  if (finger && staff_->touch().takes_fingers()) {
    const ui::Node* cross = ui_->tree().find("cross");
    if (input.kind != ui::Input::Kind::Down || cross == nullptr) return;
    staff_->touched();
    return staff_->touch().touched({input.x / w, input.y / h}, {(cross->rect.x + cross->rect.w / 2) / w,
                                                                (cross->rect.y + cross->rect.h / 2) / h});
  }
  ui_->feed(finger ? staff_->touch().placed(input, ui_->width_px(), ui_->height_px()) : input, view_);
  if (ui_->service().open) staff_->touched();
}

// Before the consent, and when all is over, the cameras are off.
void Kiosk::rest_cameras() {
  const ui::Step step = ui_->visit().step;
  const bool consented = step == ui::Step::Name || step == ui::Step::Known;
  // One that is out of order is watched until it is back.
  const bool well = view_.out_of_order == ui::Trouble::None && appliance_->cameras() == CameraWatch::Well;
  if (appliance_->state() == State::Idle && well && !consented && appliance_->grabber().streams())
    (void)appliance_->start_side_job(JobLane::Capture, *rest_cameras_);
}

void Kiosk::ask(ui::Intent intent) {
  if (intent == ui::Intent::Print) return slip_->print(ui_->text(), ui_->visit().language, view_);
  if (intent == ui::Intent::TakeHome) return take_home_->take(appliance_->kept().enrolment, view_.settings);
  if (intent == ui::Intent::StopTaking) return take_home_->stop();
  const bool measures = stages_->calibration() != nullptr && exchanged_.empty() &&
                        appliance_->moved_in_a_row() < budget::kMovedFaces;
  if (!measures && appliance_->state() == State::Idle &&
      (intent == ui::Intent::Pose || intent == ui::Intent::Begin))
    return;
  if (intent == ui::Intent::Pose && appliance_->state() == State::Idle)
    appliance_->expect(record_of(ui_->request()));
  if (intent == ui::Intent::LookUp) return look_up();
  appliance_->ask(intent);
}

// Who touches "Done" once more has asked already; another name or code is another question.
void Kiosk::look_up() {
  const ui::VisitRequest request = ui_->request();
  const bool asked = request.quotes_code ? quoted_.view() == request.name
                                         : quoted_.empty() && claimed_.view() == request.name;
  if (asked && appliance_->answer().known == ui::Known::Asking) return;
  if (!request.quotes_code) quoted_.wipe();
  (request.quotes_code ? quoted_ : claimed_) = request.name;
  const bool tells = may_tell_known_ && view_.settings.is_on(ui::Setting::TellsKnown);
  appliance_->ask_records({claimed_, quoted_, tells});
}

// Before the simulated rig, and in a recorded head, somebody does as the page says: on to the nearest side
// that is not taken. A recording may show another one, or none: then its next is asked for.
void Kiosk::turn_simulated_head() {
  double to_deg = 0;
  std::size_t taken = 0;
  if (const auto& turn = view_.live.turn; turn && appliance_->state() == State::Turn) {
    taken = turn->taken.count();
    const auto far = [&](std::size_t i) {
      return turn->taken[i] ? 1e3 : std::abs(pipeline::kSidesDeg[i] - turned_to_deg_);
    };
    std::array<std::size_t, pipeline::kSides> sides{};
    std::iota(sides.begin(), sides.end(), 0);
    to_deg = pipeline::kSidesDeg[*std::ranges::min_element(sides, {}, far)];
  }
  const bool waits = to_deg != 0 && view_.now - turned_at_ > kShownInVain;
  if (to_deg == turned_to_deg_ && taken == turned_with_ && !waits) return;
  turned_with_ = taken, turned_at_ = view_.now;
  turn_head_(turned_to_deg_ = to_deg);
}

// Who is spoken to is there, whatever the clocks of visit and machine say.
void Kiosk::speak() {
  if (!voice_->turn(*ui_, view_) || ui_->visit().overlay == ui::Overlay::StillThere) return;
  ui_->visit().listens(view_.now);
  appliance_->ask(ui::Intent::StillHere);
}

void Kiosk::turn_once() {
  if (!voice_) voice_ = std::make_unique<Voice>(open_speaker_ ? open_speaker_() : nullptr);
  appliance_->step(std::chrono::milliseconds(0));
  // Nobody uses cameras that are not the calibrated ones: that those are back must be noticed all the same.
  if (exchanged_.empty()) {
    rest_cameras();
  } else if (appliance_->state() == State::Idle && view_.now >= next_camera_look_) {
    next_camera_look_ = view_.now + budget::kCameraReturn;
    (void)appliance_->start_side_job(JobLane::Capture, *look_at_cameras_);
  }
  if (appliance_->state() == State::Idle && view_.now >= next_health_look_) {
    const auto look = [this, least_mib = view_.settings.of(ui::Setting::LeastRoomMib)](JobControl&) {
      const auto room = visits_->has_room(least_mib) ? ui::Trouble::None : ui::Trouble::Storage;
      return Result(device_->too_hot() ? ui::Trouble::Other : room);
    };
    const auto seen = [this](const Result<ui::Trouble>& unwell) {
      if (unwell) unwell_ = *unwell;
      next_health_look_ = view_.now + budget::kHealthLook;
    };
    staff_->side_tasks().ask(JobLane::Keeper, look, seen, SideTasks::Whose::Device);
    next_health_look_ = hal::Instant::max();  // until then: a keeper that hangs is asked once
  }
  if (turn_head_) turn_simulated_head();
  staff_->turn();
  if (appliance_->state() == State::Idle || appliance_->state() == State::Staff)
    moved_faces_->keep(revision_, appliance_->moved_in_a_row(), appliance_->calibration_note(),
                       staff_->side_tasks(), staff_->log(), view_.now);
  if (told_ && ui_->visit().step != ui::Step::Trouble)
    restarted_ = false;  // told once: it was read, or nobody is there
  look();
  if (const WipedText code = code_scanner_->turn(ui_->visit(), view_.now); !code.empty())
    ui_->visit().enter(code.view(), view_.now);
  // What fingers asked for comes first: a frame must not take an older answer for the new one's.
  while (const auto intent = ui_->take_intent()) {
    ask(*intent);
    look();
  }
  ui_->frame(view_);
  while (const auto request = ui_->take_staff_request()) {
    staff_->ask(*request);
    staff_->turn();
    look();
    ui_->frame(view_);
  }
  // What was asked for may have wiped what the frame shows: then it is made again.
  while (const auto intent = ui_->take_intent()) {
    ask(*intent);
    look();
    ui_->frame(view_);
  }
  speak();
  told_ = told_ || ui_->visit().step == ui::Step::Trouble;
  if (ui_->take_forgotten()) {
    appliance_->forget_kept();
    appliance_->forget_answer();
    claimed_.wipe();
    quoted_.wipe();
    forgotten_ = true;
  }
}

}  // namespace relievo::firmware
