// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>

#include "firmware/arguments/command_words.h"

namespace relievo::firmware {

void add_held_picture(CLI::App& command, HeldPictureArgs& args) {
  command.add_option("picture", args.picture, "what is held: a photograph of a face, PNG or JPEG")
      ->required()
      ->type_name("PICTURE");
  command.add_option("--width-mm", args.width_mm, "of the picture as it is held; its height follows")
      ->capture_default_str();
  command
      .add_option("--radius-mm", args.radius_mm,
                  "bent: 30 or more towards the cameras, -30 or less away; 0 flat")
      ->capture_default_str();
  command
      .add_option("--axis", args.axis_deg, "of the bend: 0 as on a column, 90 as on a lying roll, degrees")
      ->capture_default_str();
  command.add_option("--apex-mm", args.apex_mm, "bent to a cone with its apex this far away; 0 a roll")
      ->capture_default_str();
  command.add_option("--wave-mm", args.wave_mm, "bent to and fro, a wave this long; 0 one way")
      ->capture_default_str();
  command.add_option("--gloss", args.gloss, "share of the lamps' light that it mirrors: 0 matt, 0.04 glass")
      ->capture_default_str();
  command.add_flag("--screen", args.screen, "it shines by itself");
}

}  // namespace relievo::firmware
