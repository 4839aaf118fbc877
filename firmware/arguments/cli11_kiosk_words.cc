// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/arguments/command_words.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <string>

#include "firmware/arguments/two_numbers.h"

namespace relievo::firmware {
namespace {

// "1280x800", 640x480 or more.
bool window_size(const std::string& text, int& width, int& height) {
  const auto size = two_numbers(text, 'x');
  if (!size || size->first < 640 || size->second < 480) return false;
  width = size->first, height = size->second;
  return true;
}

}  // namespace

void add_kiosk(CLI::App& app, KioskArgs& args) {
  app.add_option("--board", args.device, "the kiosk's cameras: " + std::string(kDevices))
      ->type_name("BOARD")
      ->capture_default_str();
  app.add_option("--calibration", args.calibration,
                 "default: the one in the store; of the simulated rig, its own")
      ->type_name("rig.yml");
  add_store(app, args.store);
  app.add_option_function<std::string>(
         "--windowed",
         [&args](const std::string& size) {
           if (!window_size(size, args.width_px, args.height_px))
             throw CLI::ValidationError("--windowed", "give a size such as 1280x800, of 640x480 or more");
         },
         "a window instead of the whole screen")
      ->type_name("WxH");
  app.add_option("--screenshots", args.screenshots, "pictures of all screens in all languages, as files")
      ->type_name("DIR");
  app.add_option("--script", args.script,
                 "a visit by synthetic fingers, and what it cost; its pictures go to --screenshots")
      ->type_name("FILE");
  app.add_option(
         "--only", args.only,
         "of those, the sheets with this in their name, as 1280x800_100_de; behind a slash, the pages with this in theirs: 1280x800_100_de/thanks")
      ->type_name("TEXT");
  app.add_flag_function(
      "--tell-nobody", [&args](std::int64_t) { args.tells_known = false; },
      "who types a name is not told that it is in the records already");
  app.add_flag("--showpiece", args.write_invitation_head,
               "with --screenshots: only the head of the page that invites")
      ->group("");
}

}  // namespace relievo::firmware
