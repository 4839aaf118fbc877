// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/view/visit.h"

#include <utility>

namespace relievo::ui {
namespace {

bool is_stage(Screen screen) {
  return screen == Screen::Capture || screen == Screen::Match || screen == Screen::Reconstruct ||
         screen == Screen::Mesh || screen == Screen::Texture || screen == Screen::Fuse;
}

}  // namespace

int Visit::seconds_left(hal::Instant now) const {
  const auto left =
      std::chrono::ceil<std::chrono::seconds>(last_touch_ + patience() + kLastCall - now).count();
  return int(std::clamp<long>(left, 0, kLastCall.count()));
}

std::optional<float> Visit::countdown(const LiveView& live) const {
  if (!settings_.is_on(Setting::Automatic) || overlay != Overlay::None ||
      live.advice != pipeline::Advice::None || live.steady_s < kSteadyFor)
    return std::nullopt;
  return std::max(0.0F, kSteadyFor + countdown_s() - live.steady_s);
}

int Visit::countdown_number(const LiveView& live) const {
  const auto left = countdown(live);
  return left ? 1 + std::clamp(int(*left / countdown_s() * 3), 0, 2) : 0;
}

void Visit::touched(hal::Instant now) {
  if (by_itself_) look = shown_look(now);  // it stays as it stood
  by_itself_ = false;
  last_touch_ = by_hand_ = now;
  if (overlay == Overlay::StillThere) overlay = Overlay::None;
}

void Visit::forget() {
  forget_person();
  look_as_set();
  shot_in_the_dark = has_sides_ = false;
}

void Visit::forget_person() {
  name_.wipe();
  enrolment_kind_ = EnrolmentKind::NewSubject;
  quotes_code_ = code_handed_in_ = looking_up_ = false;
  look_ups_ = 0;
  agreed_at_ = {};
  look = {};
  by_itself_ = false;
  touches = 0;
  shot_ = false;
  overlay = Overlay::None;
  capitals = true;
  other_letters = false;
}

void Visit::go(Step to, hal::Instant now) {
  step = to;
  entered_ = now;
  overlay = Overlay::None;
  if (to == Step::Attract) forget();
  if (to == Step::Trouble || to == Step::Declined)
    forget_person();  // who reads it reads it in their language
  if (to == Step::Consent) read_ = false;
}

std::optional<Intent> Visit::back(const ViewState& view) {
  if (std::exchange(overlay, Overlay::None) != Overlay::None) return std::nullopt;
  const Step before = step;
  if (before == Step::Consent) {  // they look at the first page once more, and read it as before
    step = Step::Attract;
    entered_ = view.now;
    forget_person();
  }
  if (before == Step::Name) looking_up_ = false;  // what was asked there is not wanted any more
  if (before == Step::Name && quotes_code_) {     // a name again: it may be another one
    name_.wipe();
    quotes_code_ = false;
    capitals = true;
    return std::nullopt;
  }
  if (before == Step::Name) step = Step::Consent;
  if (before == Step::Known || before == Step::Position) step = Step::Name;
  if (before == Step::Position) return Intent::Cancel;
  return before == Step::Review ? std::optional(Intent::Pose) : std::nullopt;
}

std::optional<Intent> Visit::act(Action action, const ViewState& view) {
  switch (action.kind) {
    // How it is read, and what lies over it: wherever the person is.
    case ActionKind::BiggerText: {
      const std::size_t sizes = action.value > 0 ? std::size_t(action.value) : kTextPercents.size();
      text_size = text_size + 1 < sizes ? text_size + 1 : 0;
      break;
    }
    case ActionKind::Contrast: high_contrast = !high_contrast; break;
    case ActionKind::Reach: reach = static_cast<Reach>((int(reach) + 1) % 3); break;
    case ActionKind::ShowLanguages: overlay = Overlay::Languages; break;
    case ActionKind::ShowHelp: overlay = Overlay::Help; break;
    case ActionKind::Leave: overlay = Overlay::Leave; break;
    case ActionKind::LostCode: overlay = Overlay::LostCode; break;
    case ActionKind::ShowPrivacy: overlay = Overlay::Privacy; break;
    case ActionKind::CloseOverlay:
    case ActionKind::Stay: overlay = Overlay::None; break;
    case ActionKind::ChooseLanguage:
      overlay = Overlay::None;
      other_letters = false;
      if (offered(view)[std::size_t(action.value)]) language = static_cast<Language>(action.value);
      break;
    case ActionKind::Speech: spoken = !spoken && voices_; break;
    case ActionKind::Quieter: volume -= volume > 0 ? 1 : 0; break;
    case ActionKind::Louder: volume = std::min(volume + 1, kVolumePercents.size() - 1); break;
    case ActionKind::Speed: speed = (speed + 1) % kSpeedPercents.size(); break;
    case ActionKind::Print: return step == Step::Thanks ? std::optional(Intent::Print) : std::nullopt;
    case ActionKind::TakeHome: return step == Step::Thanks ? std::optional(Intent::TakeHome) : std::nullopt;
    case ActionKind::StopTaking: return Intent::StopTaking;
    case ActionKind::LeaveNow: return leave_now(view);
    case ActionKind::Back: return back(view);
    case ActionKind::TurnLeft: turn_face(-25, 0, 75); break;
    case ActionKind::TurnRight: turn_face(25, 0, 75); break;
    case ActionKind::ZoomIn: look.zoom = std::min(3.0F, look.zoom * 1.25F); break;
    case ActionKind::ZoomOut: look.zoom = std::max(0.8F, look.zoom / 1.25F); break;
    case ActionKind::MoveLight: look.light_deg = look.light_deg >= 55 ? -55 : look.light_deg + 30; break;
    case ActionKind::LookPoints: look.points = !look.points; break;
    case ActionKind::LookEdges: look.edges = !look.edges; break;
    case ActionKind::LookFill: look.fill = !look.fill; break;
    case ActionKind::LookLight: look.lit = !look.lit; break;
    case ActionKind::ShowShape: look.textured = !look.textured; break;
    case ActionKind::LookAtFirst: look = {}; break;
    case ActionKind::Erase: erase_letter(); break;
    case ActionKind::Shift: capitals = !capitals; break;
    case ActionKind::OtherLetters: other_letters = !other_letters; break;
    case ActionKind::Start:
    case ActionKind::Agree:
    case ActionKind::Decline:
    case ActionKind::Done:
    case ActionKind::TakePicture:
    case ActionKind::EnoughSides:
    case ActionKind::Accept:
    case ActionKind::Retake:
    case ActionKind::Finish: return act_on_path(action.kind, view);
    case ActionKind::HaveCode:
    case ActionKind::SomebodyElse:
    case ActionKind::Renew:
    case ActionKind::AddAnother: return act_on_record(action.kind);
    case ActionKind::ReadOn:
    case ActionKind::TypeKey:
    case ActionKind::TurnFace:
    case ActionKind::StaffEnter:
    case ActionKind::StaffLeave:
    case ActionKind::StaffOpen:
    case ActionKind::StaffDo:
    case ActionKind::StaffAnswer:
    case ActionKind::StaffMode:
    case ActionKind::StaffMeasure:
    case ActionKind::None: break;
  }
  return std::nullopt;
}

std::optional<Intent> Visit::leave_now(const ViewState& view) {
  go(Step::Attract, view.now);
  return Intent::Cancel;
}

std::optional<Intent> Visit::act_on_path(ActionKind kind, const ViewState& view) {
  ++touches;
  if (kind == ActionKind::Start && step == Step::Attract) go(Step::Consent, view.now);
  if (kind == ActionKind::Decline) go(Step::Declined, view.now);
  // A touch that was meant for "Stop" does not take the code away.
  if (kind == ActionKind::Finish && view.now - waited_until_ >= kTooLate) go(Step::Attract, view.now);
  if (kind == ActionKind::Agree && has_read()) {
    // A clock that went wrong on this page would date the consent.
    if (view.out_of_order == Trouble::Clock) {
      go(Step::Trouble, view.now);
    } else {
      touches = 1;
      agreed_at_ = view.wall_now;
      step = Step::Name;
    }
  }
  if (kind == ActionKind::Done) {
    while (name().ends_with(' ')) erase_letter();
    if (name().empty() || (quotes_code_ && name().size() < kCodeDigits)) return std::nullopt;
    // Who tries many codes is not the one they were given to; who tries many names is told nothing more.
    if (++look_ups_ > kMostLookUps && quotes_code_) return leave_now(view);
    if (look_ups_ > kMostLookUps) return Intent::Pose;
    looking_up_ = true;
    code_handed_in_ = quotes_code_;
    return Intent::LookUp;
  }
  if (kind == ActionKind::TakePicture) {
    shot_ = true;
    shot_in_the_dark = view.live.advice == pipeline::Advice::TooDark;
    return Intent::Begin;
  }
  if (kind == ActionKind::EnoughSides) return Intent::Enough;
  if (kind == ActionKind::Accept) return Intent::Accept;
  if (kind == ActionKind::Retake) {
    look = {};
    return Intent::Pose;
  }
  return std::nullopt;
}

std::optional<Intent> Visit::act_on_record(ActionKind kind) {
  ++touches;
  if (step != Step::Known) return std::nullopt;
  if (kind == ActionKind::HaveCode) {
    name_.wipe();
    quotes_code_ = true;
    code_handed_in_ = false;
    step = Step::Name;
    return std::nullopt;
  }
  enrolment_kind_ = kind == ActionKind::Renew        ? EnrolmentKind::Renewal
                    : kind == ActionKind::AddAnother ? EnrolmentKind::Addition
                                                     : EnrolmentKind::NewSubject;
  return Intent::Pose;
}

// The records have answered: who is new goes on, who is not is asked. What they say of a code is no answer to
// a name.
std::optional<Intent> Visit::follow_look_up(const ViewState& view) {
  if (!looking_up_ || view.known == Known::NotAsked || view.known == Known::Asking) return std::nullopt;
  if (!quotes_code_ && (view.known == Known::Code || view.known == Known::NoSuchCode)) return std::nullopt;
  looking_up_ = false;
  if (step != Step::Name || overlay == Overlay::Leave) return std::nullopt;
  enrolment_kind_ = EnrolmentKind::NewSubject;
  if (view.known == Known::Nobody) return Intent::Pose;
  if (view.known == Known::Name || view.known == Known::Code) step = Step::Known;
  return std::nullopt;
}

// A language the operator's text does not exist in, or who listens cannot hear, cannot be chosen.
void Visit::follow_language(const ViewState& view) {
  if (home_ != view.home && (step == Step::Attract || step == Step::Starting)) language = view.home;
  home_ = view.home;
  const auto languages = offered(view);
  if (languages[std::size_t(language)]) return;
  language = home_;
  for (std::size_t i = 0; i < kLanguages && !languages[std::size_t(language)]; ++i)
    language = static_cast<Language>(i);
}

// Whose face is before the cameras is there, and has no hand free for the screen.
std::optional<Intent> Visit::follow_face(const ViewState& view) {
  const bool fresh = std::exchange(live_number_, view.live.number) != view.live.number;
  // Off the centre and at no known distance there may be a chair.
  const bool face = view.live.advice != pipeline::Advice::NoFace &&
                    !(view.live.advice == pipeline::Advice::OffCentre && view.live.nearness == 0);
  if (step != Step::Position || !fresh || !face || view.now - by_hand_ > kFaceAlone ||
      view.now - last_touch_ < std::chrono::seconds(1))
    return std::nullopt;
  last_touch_ = view.now;
  if (overlay == Overlay::StillThere) overlay = Overlay::None;
  return Intent::StillHere;
}

// Where the machine leads, the visit goes.
void Visit::follow_machine(const ViewState& view) {
  const Screen before = std::exchange(last_screen_, view.screen);
  if (before == view.screen) return;
  // Where the head is to be turned next, nobody is shown and told for a moment that all is taken.
  if (view.screen == Screen::Capture && step == Step::Position && settings_.is_on(Setting::Sides)) return;
  if (view.screen == Screen::Position) {
    go(Step::Position, view.now);
    last_touch_ = by_hand_ = view.now;
    shot_ = has_sides_ = false;
  } else if (view.screen == Screen::Turn) go(Step::Turn, view.now);
  else if (is_stage(view.screen) || view.screen == Screen::Store) go(Step::Working, view.now);
  else if (view.screen == Screen::Review) {
    go(Step::Review, view.now);
    last_touch_ = view.now;
    by_itself_ = before != Screen::Store && settings_.is_on(Setting::Motion);
  } else if (view.screen == Screen::Fault) go(Step::Trouble, view.now);
  else if (view.screen == Screen::Idle && before == Screen::Store && step == Step::Working &&
           view.trouble == Trouble::None) {
    go(Step::Thanks, view.now);
    last_touch_ = view.now;
  } else if (view.screen == Screen::Idle && step != Step::Name && step != Step::Known &&
             step != Step::Attract) {
    const bool told = view.trouble != Trouble::None && step != Step::Starting && step != Step::Trouble;
    go(told ? Step::Trouble : Step::Attract, view.now);
  }
}

std::optional<Intent> Visit::follow(const ViewState& view) {
  follow_headphones(view);
  follow_presence(view);
  follow_language(view);
  follow_settings(view);
  follow_machine(view);
  if (step == Step::Turn && view.live.turn) has_sides_ = view.live.turn->taken.any();
  // Out of order is said before anybody begins, and to who is in the middle only when they are done.
  const bool idle = view.screen == Screen::Idle;
  if (idle && step == Step::Attract && view.out_of_order != Trouble::None) go(Step::Trouble, view.now);
  if (idle && step == Step::Trouble && view.out_of_order == Trouble::None && view.trouble == Trouble::None)
    go(Step::Attract, view.now);
  const bool barred = idle && step == Step::Trouble && bars_the_way(view.out_of_order);
  if ((step == Step::Declined || (step == Step::Trouble && idle && !barred)) &&
      view.now - std::max(entered_, last_touch_) > kToldFor)
    go(Step::Attract, view.now);
  const auto face = follow_face(view);
  if (view.take_home.taking == Taking::Busy) {  // who waits for their stick is there
    listens(view.now);
    waited_until_ = view.now;
  }
  if (info_of(step).person_expected) {
    const auto silent = view.now - last_touch_;
    if (silent > patience() + kLastCall) return leave_now(view);
    if (silent > patience()) overlay = Overlay::StillThere;
  } else if ((step == Step::Attract || step == Step::Trouble) &&
             (overlay != Overlay::None || !looks_as_set()) && view.now - last_touch_ > patience()) {
    forget();
  }
  if (const auto intent = follow_look_up(view)) return intent;
  if (step == Step::Position && !shot_) {
    const auto left = countdown(view.live);
    if (left && *left <= 0) {
      shot_ = true;
      shot_in_the_dark = false;
      return Intent::Begin;
    }
  }
  return face;
}

}  // namespace relievo::ui
