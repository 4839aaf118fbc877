// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "firmware/calibrate/calibrate_command.h"
#include "firmware/calibrate/print_pattern.h"
#include "firmware/command/commands.h"
#include "hal/whole_file.h"

namespace relievo::firmware {

Result<void> run(const PrintPatternArgs& args, Services& services) {
  RELIEVO_TRY_ASSIGN(const PageFormat format, page_format(args.output.filename().native()));
  const pipeline::BoardPattern pattern = pattern_of(args.board);
  RELIEVO_TRY_ASSIGN(const PatternPage page, lay_out_pattern(pattern));
  RELIEVO_TRY_ASSIGN(const auto bytes, draw_page(page, pattern, format));
  RELIEVO_TRY(hal::write_whole_file(args.output, bytes));
  const bool upright = page.height_mm > page.width_mm;
  services.console.say(args.output.string() + ": one page " + page.paper +
                       (upright ? " portrait" : " landscape") + "; print it at 100 % and measure its ruler");
  return {};
}

}  // namespace relievo::firmware
