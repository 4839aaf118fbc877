// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/demo/gallery.h"

#include <algorithm>
#include <array>
#include <limits>

#include "firmware/kiosk/code/qr_code.h"
#include "firmware/service/statistics.h"
#include "storage/cipher/recovery.h"
#include "ui/device/settings.h"
#include "ui/device/touch_map.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {
namespace {

using ui::Mood;
using ui::ServiceView;
using ui::StaffPage;
using ui::StaffRole;

const ui::StatisticsView& statistics_seen() {
  static const ui::StatisticsView kSeen = [] {
    Statistics days;
    ui::StatisticsView seen = days.view(std::chrono::year{2026} / 3 / 14);
    seen.since = "2026-03-02";
    seen.visits = 412, seen.captures = 455, seen.models = 398, seen.stored = 371, seen.left = 27;
    seen.refused = {21, 14, 9, 0, 2, 6, 5};
    seen.median_s = 2.75, seen.slow_s = 4.25;
    constexpr std::array<float, 13> kVisits{22, 31, 35, 28, 41, 52, 0, 30, 33, 37, 29, 44, 30},
        kStored{19, 29, 32, 24, 38, 47, 0, 27, 30, 33, 27, 39, 26},
        kRefused{4, 3, 6, 5, 2, 9, 0, 4, 3, 5, 4, 7, 5};
    const auto last = [](const auto& from, auto& to) {
      std::ranges::copy(from, to.end() - std::ptrdiff_t(from.size()));
    };
    last(kVisits, seen.days.visits), last(kStored, seen.days.stored), last(kRefused, seen.days.refused);
    return seen;
  }();
  return kSeen;
}
// A warm afternoon; the disk fills, and is made room on.
constexpr auto kDays = [] {
  std::array<std::array<float, 144>, 2> days{};
  for (int i = 0; i < 144; ++i) {
    const int warm = i < 40 ? 0 : i < 90 ? i - 40 : 140 - i;
    days[0][std::size_t(i)] =
        i < 12 ? std::numeric_limits<float>::quiet_NaN() : 42 + 0.5F * float(warm) + float(i * 7 % 5);
    days[1][std::size_t(i)] =
        i < 12 ? std::numeric_limits<float>::quiet_NaN() : 100000 + 63.0F * float(i - 12);
  }
  return days;
}();
constexpr std::array kGauges{
    ui::GaugeRow{ui::Gauge::Stages, {}, 311, 960, Mood::Good},
    ui::GaugeRow{ui::Gauge::Process, {}, 894, 1536, Mood::Good},
    ui::GaugeRow{ui::Gauge::Disk, {}, 108320, 119000, Mood::Warn, kDays[1]},
    ui::GaugeRow{ui::Gauge::Temperature, "x86_pkg_temp", 44, 90, Mood::Good, kDays[0]},
    ui::GaugeRow{ui::Gauge::Temperature, "acpitz", 41, 90, Mood::Good},
};
constexpr const char *kAway = "the camera is away: check its plug; it is tried again by itself",
                     *kSlow = "took longer than its limit: try again";
const std::array kFaults{ui::LogLine{"2026-03-14 10:21:09", true, kAway, Errc::Disconnected, {}, {}},
                         ui::LogLine{"2026-03-14 09:02:44", true, kSlow, Errc::Timeout, {}, {}}};
constexpr ui::VisitCostsView kCosts{
    16,
    {{{1.2F, 206}, {0.3F, 311}, {0.6F, 288}, {0.4F, 241}, {0.1F, 187}, {1.9F, 296}, {2.4F, 302}}},
    894,
    60,
    960};
const ui::HealthView kHealth{kGauges, kCosts, kFaults};

const std::array kPeople{
    ui::RecordRow{431, "Ada Lovelace", "2026-03-14 09:12", "4821-9037-5512-71", 1},
    ui::RecordRow{430, "Jürgen Müller", "2026-03-14 09:03", "0094-2650-7731-77", 2},
    ui::RecordRow{429, "ليلى حسن", "2026-03-13 16:48", "7315-0086-2249-30", 1},
    ui::RecordRow{428, "148 220", "2026-03-13 16:31", "000428-93", 1},
    ui::RecordRow{427, "Maximiliane von und zu Hohenwaldeck-Eulenstein", "2026-03-13 15:55", "000427-95", 3},
};
constexpr ui::ListPlace kPlace{.page = 1239,
                               .pages = 2000,
                               .stretches = {{{1200, 1219, "2026-03-14 09:12"},
                                              {1220, 1239, "2026-03-02 16:40"},
                                              {1240, 1240, "2026-02-27 11:05"}}},
                               .stretch_count = 3};
const std::array kFilters = [] {
  std::array<ui::RecordFilter, 33> filters{{{false, "2025-11"}, {false, "2026-03"}}};
  constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ";
  filters[2] = {true, "1"};
  for (std::size_t i = 0; i < kLetters.size(); ++i) filters[3 + i] = {true, std::string(1, kLetters[i])};
  constexpr std::array<const char*, 4> kFurther{"Ö", "י", "ل", "佐"};
  for (std::size_t i = 0; i < kFurther.size(); ++i) filters[29 + i] = {true, kFurther[i]};
  return filters;
}();
const ui::RecordsView kList{kPeople, kPlace, {}, nullptr, {}, {}, false, false, 0, 0, kFilters};
const ui::RecordsView kNobody{{}, {}, "Zuse", nullptr, {}, {}, false, false, 0, 0};
const ui::RecordsView kOne{kPeople, kPlace, {}, &kPeople[4], "sample-1 (de)", "2026-03-13 15:54", false,
                           false,   0,      0};
const ui::RecordsView kTaken{kPeople, kPlace, {}, &kPeople[4], "sample-1 (de)", "2026-03-13 15:54", false,
                             true,    0,      0};

const ui::SelfTestView kTested{
    {ui::CheckState::Good, ui::CheckState::Good, ui::CheckState::Bad, ui::CheckState::Running,
     ui::CheckState::NotTested},
    {{{}, {}, {Errc::NotFound, "the store holds no calibration: calibrate first"}, {}, {}}}};
constexpr ui::TriggerView kPulsed{10, 10, 0.012, 48.3, 0, 0, 0, true};
constexpr ui::TriggerView kMissed{10, 7, 0.012, 1850.0, 3, 2, 1, true};
const std::array kLines{
    ui::LogLine{"2026-03-14 10:21:09", true, kAway, Errc::Disconnected, {}, {}},
    ui::LogLine{"2026-03-14 10:20:44", false, "", {}, ui::LogEvent::SettingChanged, {"patience_s", "30"}},
    ui::LogLine{"2026-03-14 10:20:31", false, "", {}, ui::LogEvent::TechnicianSignedIn, {}},
    ui::LogLine{"2026-03-14 10:20:20", false, "", {}, ui::LogEvent::WrongPin, {}},
    ui::LogLine{"2026-03-13 18:02:11", false, "noted by an earlier version", {}, {}, {}},
    ui::LogLine{"2026-03-13 07:58:02", false, "", {}, ui::LogEvent::Started, {}}};
const ui::LogView kLog{kLines, {.page = 0, .pages = 4}};

ui::Settings kept_for_a_year() {
  ui::Settings settings;
  settings.set(ui::Setting::KeepDays, 365);
  return settings;
}

const ui::ConsentTexts& own_text() {
  static const ui::ConsentTexts kOwn = [] {
    ui::ConsentTexts own;
    own.version = "2026-03";
    const auto say = [&](ui::Language language, const char* title) {
      own.in[std::size_t(language)] = ui::ConsentText{title, {{"1", "2"}}};
    };
    say(ui::Language::English, "What we do with your portrait");
    say(ui::Language::German,
        "Was mit Ihrem Bildnis geschieht, wie lange es aufbewahrt wird und wie Sie es löschen lassen");
    say(ui::Language::Arabic, "ماذا يحدث لصورتك");
    return own;
  }();
  return kOwn;
}

// The same in every language.
const ui::ConsentTexts& whole_text() {
  static const ui::ConsentTexts kWhole = [] {
    ui::ConsentTexts whole = own_text();
    for (auto& text : whole.in) text = whole.in[0];
    return whole;
  }();
  return kWhole;
}

ServiceView at(StaffRole role) {
  ServiceView view;
  view.role = role;
  return view;
}

void add_touch(const Lender& all) {
  static const ui::TouchView kCross{ui::TouchStep::Cross, {}, 1, 12},
      kTest{ui::TouchStep::Test, {}, 4, 9, false, ui::TouchFit{{}, 0.004, 90}},
      kKept{ui::TouchStep::Rest, ui::TouchVerdict::Kept, 0, 0, true, ui::TouchFit{{}, 0.0041, 90}},
      kMisfit{ui::TouchStep::Rest, ui::TouchVerdict::Misfit, 0, 0, true};
  ServiceView touch = at(StaffRole::Technician);
  for (const auto& [name, view] :
       {std::pair{"staff_touch_cross", &kCross}, std::pair{"staff_touch_test", &kTest},
        std::pair{"staff_touch_kept", &kKept}, std::pair{"staff_touch_misfit", &kMisfit}}) {
    touch.touch = view;
    all.add(name, StaffPage::Touch, touch);
  }
}

// How an export of everyone ended.
void add_sticks(const Lender& all, ServiceView records) {
  static const ui::RecordsView kTwoOfFive{kPeople, kPlace, {}, nullptr, {}, {}, false, false, 5, 2};
  using ui::Outcome;
  records.records = &kTwoOfFive;
  for (const auto& [name, outcome] :
       {std::pair{"staff_stick_gone", Outcome::StickGone}, std::pair{"staff_stick_full", Outcome::StickFull},
        std::pair{"staff_stick_locked", Outcome::StickLocked},
        std::pair{"staff_stick_bad", Outcome::StickBad}, std::pair{"staff_stick_held", Outcome::StickHeld},
        std::pair{"staff_stick_unchecked", Outcome::StickUnchecked},
        std::pair{"staff_export_stopped", Outcome::Cancelled}}) {
    records.work.outcome = outcome;
    all.add(name, StaffPage::Records, records);
  }
}

// The recovery sheet, of which nobody's words are shown.
void add_recovery(const Lender& all) {
  static const std::array<std::string_view, storage::kRecoveryWords> kWords{
      "legal", "winner", "thank", "year",   "wave",  "sausage",
      "worth", "useful", "legal", "winner", "thank", "yellow"};
  static const hal::Picture code =
      code_picture("legal winner thank year wave sausage worth useful legal winner thank yellow");
  static ui::RecoveryView sheet{kWords, {code.view(), 1}, 5}, wrong = sheet, done;
  wrong.state = ui::SheetState::Wrong;
  done.state = ui::SheetState::Done;
  ServiceView recovery = at(StaffRole::Operator);
  recovery.access.words_due = true;
  recovery.recovery = &sheet;
  all.add("staff_recovery", StaffPage::Recovery, recovery);
  all.add("staff_recovery_word", StaffPage::Recovery, recovery, 1);
  recovery.recovery = &wrong;
  all.add("staff_recovery_wrong", StaffPage::Recovery, recovery, 1);
  recovery.recovery = &done;
  all.add("staff_recovery_done", StaffPage::Recovery, recovery, 1);
}

// The way in: PINs, the first start, a PIN that was forgotten.
void add_sign_in(const Lender& all) {
  ServiceView sign_in;
  all.add("staff_pin", StaffPage::Pin, sign_in);
  sign_in.access.locked = true;
  sign_in.access.wait_s = 300;
  all.add("staff_pin_locked", StaffPage::Pin, sign_in);
  sign_in.access.wait_s = 0;
  sign_in.access.failed = Errc::MediaFull;
  all.add("staff_pin_failed", StaffPage::Pin, sign_in);
  ServiceView fresh;
  fresh.access.set_up = false;
  fresh.access.clock = "2026-03-14 10:21:09";
  all.add("staff_first_start", StaffPage::FirstStart, fresh);
  all.add("staff_first_clock", StaffPage::FirstStart, fresh, 1);
  fresh.access.clock_right = true;
  static const ui::Fault kNoLanguage{
      Errc::InvalidInput,
      "zh.txt: is no text in a language: call it en.txt, de.txt, fr.txt, es.txt, ar.txt, he.txt, zh-Hans.txt or ja.txt"};
  static const ui::ConsentTextsView kUntouched{}, kWrong{false, ui::Outcome::Refused, &kNoLanguage};
  fresh.consent = &kUntouched;
  all.add("staff_first_consent", StaffPage::FirstStart, fresh, 1);
  fresh.consent = &kWrong;
  all.add("staff_first_consent_wrong", StaffPage::FirstStart, fresh, 1);
  fresh.access.consent_right = true;
  fresh.access.fault = ui::PinFault::Simple;
  all.add("staff_first_pin", StaffPage::FirstStart, fresh, 1);
  fresh.access.forgotten = true;
  fresh.access.fault = ui::PinFault::None;
  fresh.access.step = ui::PinStep::Operator;
  all.add("staff_forgotten_pin", StaffPage::FirstStart, fresh);
}

void add_menus(const Lender& all) {
  static const ui::StatusView kWell{.looked = true, .free_mib = 40960}, kIll{.looked = true,
                                                                             .camera_away = true,
                                                                             .pairs = 400,
                                                                             .missed = 31,
                                                                             .free_mib = 2560,
                                                                             .hottest_c = 78,
                                                                             .calibration_days = 512,
                                                                             .clock_jumped = true,
                                                                             .device_faults = 3};
  ServiceView technician = at(StaffRole::Technician);
  technician.status = &kWell;
  all.add("staff_technician", StaffPage::Menu, technician).view.consent = &whole_text();
  technician.status = &kIll;
  technician.access.words_due = technician.access.demanded = true;
  all.add("staff_technician_needed", StaffPage::Menu, technician);
  ServiceView leaving = at(StaffRole::Operator);
  leaving.status = &kIll;
  leaving.access.words_due = true;
  all.add("staff_operator_needed", StaffPage::Menu, leaving);
  leaving.status = &kWell;
  leaving.access.words_due = false;
  leaving.leaves_in_s = 9;
  all.add("staff_operator", StaffPage::Menu, leaving).view.consent = &whole_text();
}

void add_records(const Lender& all) {
  ServiceView records = at(StaffRole::Operator);
  records.records = &kList;
  all.add("staff_records", StaffPage::Records, records);
  all.add("staff_search", StaffPage::Records, records, 1);
  all.add("staff_records_jump", StaffPage::Records, records, 100);
  all.add("staff_records_filter", StaffPage::Records, records, 101);
  static const ui::RecordsView kLooks = [] {
    ui::RecordsView looks = kList;
    looks.looks = true;
    return looks;
  }();
  records.records = &kLooks;
  records.work.progress = 0.4F;
  all.add("staff_records_looks", StaffPage::Records, records);
  records.records = &kList;
  add_sticks(all, records);
  records.work = {true, 0.6F, ui::Outcome::None};
  all.add("staff_export", StaffPage::Records, records);
  records.work = {};
  records.records = &kNobody;
  all.add("staff_nobody", StaffPage::Records, records);
  records.records = &kOne;
  records.model = all.idle.invitation_head;
  records.model_number = 1;
  all.add("staff_record", StaffPage::Records, records);
  all.add("staff_erase", StaffPage::Records, records, 2);
  records.records = &kTaken;
  records.work.outcome = ui::Outcome::Done;
  all.add("staff_exported", StaffPage::Records, records);
}

void add_figures(const Lender& all) {
  ServiceView statistics = at(StaffRole::Operator);
  statistics.statistics = &statistics_seen();
  all.add("staff_statistics", StaffPage::Statistics, statistics);
  ServiceView health = at(StaffRole::Technician);
  health.health = &kHealth;
  all.add("staff_health", StaffPage::Health, health);
}

void add_tests(const Lender& all) {
  ServiceView tests = at(StaffRole::Technician);
  tests.self_test = &kTested;
  tests.log = &kLog;
  tests.trigger = &kPulsed;
  all.add("staff_self_test", StaffPage::SelfTest, tests);
  all.add("staff_trigger", StaffPage::Trigger, tests);
  tests.trigger = &kMissed;
  all.add("staff_trigger_missed", StaffPage::Trigger, tests);
  all.add("staff_log", StaffPage::Log, tests);
  all.add("staff_log_filter", StaffPage::Log, tests, 101);
}

void add_settings(const Lender& all) {
  ServiceView settings = at(StaffRole::Technician);
  static const ui::SettingsView kUsual{}, kJumped{kept_for_a_year(), true};
  settings.settings = &kUsual;
  all.add("staff_settings", StaffPage::Settings, settings);
  settings.role = StaffRole::Operator;
  settings.settings = &kJumped;
  settings.work.outcome = ui::Outcome::Done;
  all.add("staff_settings_operator", StaffPage::Settings, settings);
  static const ui::ConsentTextsView kInForce{false, ui::Outcome::Done, nullptr};
  settings.consent = &kInForce;
  all.add("staff_consent", StaffPage::Consent, settings).view.consent = &own_text();
}

}  // namespace

void add_staff_exhibits(const Lender& all) {
  add_sign_in(all);
  add_recovery(all);
  add_menus(all);
  add_records(all);
  add_figures(all);
  add_tests(all);
  add_settings(all);
  add_touch(all);
  ServiceView pins = at(StaffRole::Operator);
  pins.access.step = ui::PinStep::Own;
  all.add("staff_new_pin", StaffPage::Pins, pins);
}

}  // namespace relievo::firmware
