// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `relievo staff`: the way in of whoever administers the device, when the screen offers none. The store lets
// nobody else in while a kiosk has it.
#include <string>

#include "firmware/command/commands.h"
#include "firmware/records/event_log.h"
#include "firmware/service/access.h"
#include "firmware/service/touch_trial.h"

namespace relievo::firmware {
namespace {

// Both logs: the store's, which shows every edit, and the one the technician reads.
Result<void> note(storage::Store& store, const Path& folder, const hal::Clock& clock, const char* event,
                  const char* whose, ui::LogEvent line) {
  RELIEVO_TRY(store.append_audit({event, {}, whose}));
  EventLog log(clock, folder / kLogFile);
  log.say(line);
  return log.save();
}

}  // namespace

Result<void> run(const StaffArgs& args, Services& services) {
  const Path folder = store_folder(args.store);
  RELIEVO_TRY_ASSIGN(const auto store, open_kept_store(folder, services));
  if (args.verb == StaffArgs::Verb::PlainTouch) {
    RELIEVO_TRY(store->set_setting(kTouchSetting, ui::text_of(ui::TouchMap{})));
    RELIEVO_TRY(note(*store, folder, services.clock, "staff.plain_touch", "", ui::LogEvent::TouchPlain));
    services.console.say("the touch screen is taken as it is");
    return {};
  }
  const char* role = args.technician ? "technician" : "operator";
  if (const auto forgot = Access(*store, services.clock)
                              .forget(args.technician ? ui::StaffRole::Technician : ui::StaffRole::Operator);
      !forgot)
    return forgot.error().at(role);
  RELIEVO_TRY(
      note(*store, folder, services.clock, "staff.pin_forgotten", role,
           args.technician ? ui::LogEvent::TechnicianPinForgotten : ui::LogEvent::OperatorPinForgotten));
  services.console.say(
      "the " + std::string(role) +
      "'s PIN is forgotten: start the kiosk and choose a new one at its screen, before anybody else does");
  return {};
}

}  // namespace relievo::firmware
