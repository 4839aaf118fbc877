// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Texts: settings, the device's file, consent, scripts, recordings, matches by hand, the log, words and
// codes.
#include "firmware/arguments/algorithm_choice.h"
#include "firmware/kiosk/code/code_scanner.h"
#include "firmware/kiosk/script/script_player.h"
#include "firmware/records/event_log.h"
#include "firmware/service/consent_text_store.h"
#include "hal/base/assert.h"
#include "hal/linux/device.h"
#include "hal/recording/capture_file.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "pipeline/match/file/match_text.h"
#include "storage/cipher/recovery.h"
#include "tests/fuzz/fuzz_targets.h"
#include "tests/storage/sample.h"

namespace relievo::test {
namespace {

using namespace firmware;

bool settings(FuzzBytes input) { return parse_settings(text_of(input), "a.toml").has_value(); }
bool sets(FuzzBytes input) { return parse_sets(text_of(input), "a.toml").has_value(); }
bool device(FuzzBytes input) {
  return hal::read_linux_device_file(in_file("device.toml", input)).has_value();
}
bool script(FuzzBytes input) { return read_script(in_file("visit", input)).has_value(); }

bool consent(FuzzBytes input) {
  const auto file = in_file("en.txt", input);
  const auto text = read_consent_text(file);
  const auto taken = read_consent_version(file.parent_path(), "1");
  RELIEVO_ASSERT(text.has_value() || !taken.has_value());
  return taken.has_value();
}

bool recording(FuzzBytes input) {
  const auto taken = hal::read_capture_file(in_file("capture.json", input));
  if (!taken) return false;
  RELIEVO_ASSERT(hal::write_capture_file(in_file("again.json", input), *taken).has_value());
  return true;
}

bool by_hand(FuzzBytes input) {
  static const auto windows = [] {
    pipeline::RectifiedPair pair(std::pmr::get_default_resource());
    RELIEVO_ASSERT(pipeline::lay_windows(storage::test::sample_calibration(), {}, pair).has_value());
    return pair;
  }();
  return pipeline::matches_in(text_of(input), "a.txt", windows, 0.5F, std::pmr::get_default_resource())
      .has_value();
}

bool log_line(FuzzBytes input) { return entry_of(text_of(input)).code.has_value(); }

bool words(FuzzBytes input) {
  const auto bits = storage::bits_of(text_of(input));
  if (!bits) return false;
  const auto again = storage::bits_of(storage::words_of(*bits));
  RELIEVO_ASSERT(again.has_value() && *again == *bits);
  return true;
}

bool code(FuzzBytes input) {
  const auto text = code_text(text_of(input));
  if (!text) return false;
  // What is put in order is in order.
  RELIEVO_ASSERT(!text->empty() && code_text(*text) == text);
  return true;
}

}  // namespace

std::vector<FuzzTarget> text_targets() {
  return {
      {"settings",
       settings,
       {"[matcher]\nname = \"zmncc\"\n[zmncc]\nwindow_px = 15\nthree = true\nratio = 0.5\n"}},
      {"sets", sets, {"[\"SSD 21\"]\nmatcher = \"ssd\"\nssd.window_px = 21\n[other]\nmatcher = \"sgm\"\n"}},
      {"device",
       device,
       {"[mode]\nwidth_px = 32\nheight_px = 48\nexposure_us = 4000\n[left]\ndevice = \"/dev/a\"\nserial = "
        "\"L\"\n[right]\ndevice = \"/dev/b\"\nformat = \"GREY\"\n[trigger]\nchip = \"/dev/gpiochip0\"\n"
        "line = 17\ndelay_us = 20\n[lamp]\nline = 18\nlead_us = 200\n"}},
      {"consent",
       consent,
       {"What happens here\n\nWe take one picture\nTwo cameras photograph your face.\n\nIt is kept\nUntil you say "
        "no.\n"}},
      {"script",
       script,
       {"wait idle 20\ntap begin\nhold code 2\ndrag model 30 -4\ntype Ada\npause 0.5\nscreenshot front\nplug stick\n"
        "unplug\n# no more\n"}},
      {"recording",
       recording,
       {"{\"cameras\": {\"left\": {\"serial\": \"A\"}, \"right\": {\"serial\": \"B\"}},\n\"frames\": [{\"number\": 0, "
        "\"left_ns\": 0, \"right_ns\": 180000, \"exposure_us\": 4000, \"gain\": 1.0}]}"}},
      {"matches", by_hand, {"# left x, y, disparity\n640 480 300 0.5\n641 480 300.5\n"}},
      {"log", log_line, {"2026-03-01 12:00:00.000  fault: the disk is full\tf3"}},
      {"words",
       words,
       {"abandon abandon abandon abandon abandon abandon abandon abandon abandon abandon abandon about"}},
      {"code", code, {"Ada  Lovelace", "424 200 000 001"}},
  };
}

}  // namespace relievo::test
