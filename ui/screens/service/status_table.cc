// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/screens/service/status_table.h"

#include <algorithm>

namespace relievo::ui {
namespace {

using To = StaffPage;
using View = const ViewState&;
using Status = const StatusView&;

constexpr int kOldCalibrationDays = 365;
constexpr std::uint64_t kMissedShare = 100;  // one of so many pairs is no fault yet

Mood bad_if(bool wrong) { return wrong ? Mood::Bad : Mood::Plain; }
Mood warn_if(bool doubtful) { return doubtful ? Mood::Warn : Mood::Plain; }
// Before real people it must not be so.
Mood grave_before_people(View view, bool wrong) {
  return !wrong ? Mood::Plain : view.service->access.demanded ? Mood::Bad : Mood::Warn;
}
double least_mib(View view) { return view.settings.of(Setting::LeastRoomMib); }
std::size_t languages_of(View view) {
  return std::size_t(
      std::ranges::count_if(view.consent->in, [](const auto& one) { return one.has_value(); }));
}
std::string_view free_room(StaffFrame& page, Status seen) { return page.number(seen.free_mib, 0, "MiB"); }

constexpr StatusRule kRules[] = {
    {"clock", mark_tr("The clock of this device is wrong"), To::Clock, To::Clock,
     [](View view, Status) { return bad_if(view.out_of_order == Trouble::Clock); }},
    {"uncalibrated", mark_tr("The cameras must be calibrated"), To::Calibrate, To::Menu,
     [](View view, Status) { return bad_if(view.out_of_order == Trouble::Uncalibrated); }},
    {"moved", mark_tr("The cameras need adjusting"), To::Calibrate, To::Menu,
     [](View view, Status) {
       return view.out_of_order == Trouble::Calibration ? Mood::Bad : warn_if(!view.calibration_note.empty());
     }},
    {"camera", mark_tr("A camera does not answer"), To::Cameras, To::Menu,
     [](View, Status seen) { return bad_if(seen.camera_away); }},
    {"store", mark_tr("The store is damaged"), To::SelfTest, To::Menu,
     [](View, Status seen) { return bad_if(seen.store_damaged); }},
    {"no room", mark_tr("There is no room left"), To::Health, To::Records,
     [](View view, Status seen) { return bad_if(seen.free_mib < least_mib(view)); }, free_room},
    {"hot", mark_tr("Temperature"), To::Health, To::Menu,
     [](View view, Status seen) {
       const bool off = view.out_of_order == Trouble::Other || seen.hottest_c >= kHotCelsius;
       return off ? Mood::Bad : warn_if(seen.hottest_c >= kWarmCelsius);
     },
     [](StaffFrame& page, Status seen) {
       return seen.hottest_c > 0 ? page.number(seen.hottest_c, 0, "°C") : std::string_view();
     }},
    {"recovery", mark_tr("Recovery words"), To::Menu, To::Recovery,
     [](View view, Status) { return grave_before_people(view, view.service->access.words_due); },
     [](StaffFrame& page, Status) { return std::string_view(page.tr("Something is missing")); }},
    {"sample", mark_tr("Sample text, not reviewed by a lawyer: the operator puts their own here."), To::Menu,
     To::Consent, [](View view, Status) { return grave_before_people(view, view.consent == nullptr); }},
    {"languages", mark_tr("Consent text"), To::Menu, To::Consent,
     [](View view, Status) { return warn_if(view.consent != nullptr && languages_of(view) < kLanguages); },
     [](StaffFrame& page, Status) { return page.share_of(languages_of(page.view), kLanguages); }},
    {"jumped",
     mark_tr("The clock has jumped ahead: nothing is erased. Check the clock, then choose the time again."),
     To::Clock, To::Settings, [](View, Status seen) { return warn_if(seen.clock_jumped); }},
    {"little room", mark_tr("Room on the disk"), To::Health, To::Records,
     [](View view, Status seen) {
       return warn_if(seen.free_mib >= least_mib(view) && seen.free_mib < 2 * least_mib(view));
     },
     free_room},
    {"trigger", mark_tr("Some pulses were not seen by both cameras."), To::Trigger, To::Menu,
     [](View, Status seen) { return warn_if(seen.missed * kMissedShare > seen.pairs); }},
    {"old", mark_tr("Calibration"), To::Calibrate, To::Menu,
     [](View, Status seen) { return warn_if(seen.calibration_days > kOldCalibrationDays); },
     [](StaffFrame& page, Status seen) {
       const auto days = static_cast<unsigned long>(seen.calibration_days);
       return page.filled(page.tr.plural("{} day", "{} days", days), page.number(seen.calibration_days));
     }},
    {"restarted", mark_tr("This device has just restarted"), To::Log, To::Menu,
     [](View view, Status) { return warn_if(view.out_of_order == Trouble::Restarted); }},
    {"faults", mark_tr("Last faults"), To::Log, To::Menu,
     [](View, Status seen) { return warn_if(seen.device_faults > 0); },
     [](StaffFrame& page, Status seen) { return page.number(seen.device_faults); }},
};
static_assert(std::size(kRules) <= kMostFindings);

}  // namespace

std::span<const StatusRule> status_rules() { return kRules; }

std::span<const Finding> find_status(const ViewState& view, const StatusView& status,
                                     std::array<Finding, kMostFindings>& found) {
  std::size_t count = 0;
  for (const Mood mood : {Mood::Bad, Mood::Warn}) {
    for (const StatusRule& rule : kRules) {
      if (rule.mood(view, status) == mood) found[count++] = {&rule, mood};
    }
  }
  return {found.data(), count};
}

}  // namespace relievo::ui
