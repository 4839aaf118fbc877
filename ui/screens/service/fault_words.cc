// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/screens/service/staff_frame.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace relievo::ui {
namespace {

// In the order of Errc.
constexpr std::array kFaultWords{
    mark_tr("This cannot be accepted."),
    mark_tr("Something is missing"),
    mark_tr("It took too long"),
    mark_tr("A device was pulled out or does not answer"),
    mark_tr("The cameras must be calibrated"),
    mark_tr("No face found"),
    mark_tr("Too little could be matched"),
    mark_tr("The measurement is not good enough"),
    mark_tr("The program could not finish this"),
    mark_tr("Not enough memory"),
    mark_tr("No stick is ready. Plug one in, or pull this one out and plug it in again."),
    mark_tr("There is no room left"),
    mark_tr("The store is damaged"),
    mark_tr("The store is from a newer version"),
    mark_tr("Reading or writing failed"),
    mark_tr("It was stopped"),
    mark_tr("This is not possible now"),
    mark_tr("This device cannot do that")};
static_assert(kFaultWords.size() == std::size_t(Errc::Count));

// In the order of LogEvent: what is said, and of whom.
constexpr std::array<std::array<const char*, 2>, std::size_t(LogEvent::Count)> kLogWords{
    {{mark_tr("Started")},
     {mark_tr("Signed out")},
     {mark_tr("Signed in: {}"), mark_tr("Technician")},
     {mark_tr("Signed in: {}"), mark_tr("Operator")},
     {mark_tr("A wrong PIN was typed")},
     {mark_tr("The clock was set")},
     {mark_tr("A new PIN was chosen: {}"), mark_tr("Technician")},
     {mark_tr("A new PIN was chosen: {}"), mark_tr("Operator")},
     {mark_tr("The PIN was forgotten: {}"), mark_tr("Technician")},
     {mark_tr("The PIN was forgotten: {}"), mark_tr("Operator")},
     {mark_tr("The touch screen is taken as it is.")},
     {mark_tr("The touch screen was corrected")},
     {mark_tr("Setting “{}”: {}")},
     {mark_tr("Records exported: {}")},
     {mark_tr("Records erased for their age: {}")},
     {mark_tr("Record #{} was erased")},
     {mark_tr("Self-test")},
     {mark_tr("Consent text {} was taken over")},
     {mark_tr("The setting “{}” is not one: what is usual holds")},
     {mark_tr("A visitor took their portrait on a stick")},
     {mark_tr("This device has just restarted")},
     {mark_tr("Calibration")}}};
static_assert(kLogWords.back()[0] != nullptr);

// In the order of Setting.
constexpr std::array kSettingNames{mark_tr("Language"),
                                   mark_tr("Size of the text"),
                                   mark_tr("More contrast"),
                                   mark_tr("Pictures that move by themselves"),
                                   mark_tr("Visitors are asked whether they are still there after"),
                                   mark_tr("The picture is taken by itself"),
                                   mark_tr("Countdown before the picture"),
                                   mark_tr("Pictures of the sides of the head"),
                                   mark_tr("Tries, if a picture is refused"),
                                   mark_tr("Staff are signed out after"),
                                   mark_tr("Visitors are told that their name is already in the records"),
                                   mark_tr("Records are erased by themselves after"),
                                   mark_tr("A solid for printing with each exported portrait"),
                                   mark_tr("Quiet sounds for the countdown, the shutter and success"),
                                   mark_tr("Room kept free on the disk"),
                                   mark_tr("Visitors may take their portrait on a stick of their own")};
static_assert(kSettingNames.size() == std::size_t(Setting::Count));

}  // namespace

const char* words_of(const Words& tr, Errc code) { return one_of(tr, kFaultWords, code); }

LogWords words_of(const Words& tr, LogEvent event) {
  if (event >= LogEvent::Count) return {""};
  const auto& [words, whom] = kLogWords[std::size_t(event)];
  return {tr(words), whom != nullptr ? tr(whom) : nullptr};
}

const char* name_of(const Words& tr, Setting setting) { return one_of(tr, kSettingNames, setting); }

std::string_view said_value(StaffFrame& page, Setting setting, std::int32_t value) {
  const bool is_switch = info_of(setting).values.size() == 2;
  if (is_switch) return value != 0 ? page.tr("yes") : page.tr("no");
  if (setting == Setting::Language) return info_of(static_cast<Language>(value)).own_name;
  if (setting == Setting::TextPercent) return page.number(value, 0, "%");
  if (setting == Setting::PatienceS || setting == Setting::StaffPatienceS) return page.number(value, 0, "s");
  if (setting == Setting::CountdownMs) return page.number(value * 1e-3, 1, "s");
  if (setting == Setting::KeepDays) return value == 0 ? page.tr("never") : page.days(value);
  if (setting == Setting::LeastRoomMib) return page.number(value, 0, "MiB");
  return page.number(value);
}

std::string_view said_change(StaffFrame& page, std::string_view key, std::string_view value) {
  std::int32_t figure = 0;
  if (std::from_chars(value.data(), value.data() + value.size(), figure).ptr != value.data() + value.size())
    return {};
  for (std::size_t i = 0; i < kSettings; ++i) {
    const auto setting = static_cast<Setting>(i);
    const SettingInfo& info = info_of(setting);
    if (info.key != key) continue;
    if (std::ranges::find(info.values, figure) == info.values.end()) return {};
    return page.filled(page.tr("Setting “{}”: {}"),
                       {name_of(page.tr, setting), said_value(page, setting, figure)});
  }
  return {};
}

}  // namespace relievo::ui
