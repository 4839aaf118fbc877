// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Services: what a command needs from the outside, as main.cc wired it: only main.cc names an
// implementation. Tests put their own in.
#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "firmware/arguments/command_line.h"
#include "firmware/base/console.h"
#include "firmware/calibrate/calibrate_command.h"
#include "firmware/checks/optical_check.h"
#include "hal/clock.h"
#include "hal/device.h"
#include "hal/speaker.h"
#include "storage/store.h"
#include "ui/display.h"

namespace relievo::firmware {

class Kiosk;

struct Services {
  // "sim", "folder:DIR", "linux" or "linux:FILE". Errors: InvalidInput (no such device), the device's own.
  std::function<Result<std::unique_ptr<hal::Device>>(std::string_view device)> open_device{};
  // Errors: the store's own. To write makes the folder; to read needs it.
  std::function<Result<std::unique_ptr<storage::Store>>(const Path& folder, bool to_write)> open_store{};
  // For `relievo store` alone; may be empty.
  std::function<std::unique_ptr<storage::StoreKeeping>(const Path& folder)> keep_store{};
  // Photographs with the simulated rig, into the folder. Errors: the rig's and the disk's.
  std::function<Result<void>(const SimulateArgs& args, const Path& folder)> simulate{};
  // Photographs the targets of the optical self-test with the simulated rig.
  Photograph photograph{};
  // Pairs of a board in a hand before the simulated rig; may be empty. Errors: InvalidInput (no such board).
  std::function<Result<std::unique_ptr<LivePairs>>(const CalibrateLiveArgs& args)> hold_board{};
  // The calibration of the simulated rig of open_device("sim"), as exactly known as it is; may be empty: it
  // has to be calibrated.
  std::function<Result<pipeline::StereoCalibration>()> simulated_calibration{};
  // Window, device, or nothing to be seen: as the environment says. Errors: LibraryFailed.
  std::function<Result<std::unique_ptr<ui::Display>>(const ui::DisplayOptions&)> open_display{};
  // Where texts and sounds are heard; may be empty, or give none: then nothing is.
  std::function<std::unique_ptr<hal::Speaker>()> open_speaker{};
  // For the visitor's code on paper; may be empty.
  std::function<std::unique_ptr<hal::Printer>()> make_printer{};
  // Tells whether somebody is near; may be empty, or give none: then somebody may always be.
  std::function<std::unique_ptr<hal::InputSwitch>()> find_presence_sensor{};
  Console& console;
  const hal::Clock& clock;
  // Sets the system's clock; may be empty. Errors: Unsupported (it may not).
  std::function<Result<void>(std::chrono::system_clock::time_point)> set_clock{};
  // For scripted visits. Plugs a folder that plays a USB stick into a device without hardware; no name pulls
  // it. Errors: Unsupported (a device with hardware).
  std::function<Result<void>(hal::Device& device, const std::string& folder)> plug_stick{};
  // The simulated person turns the head so far (+ to the picture's right), a moment later; may be empty.
  // Nothing where the device is no simulated rig.
  std::function<void(hal::Device& device, double yaw_deg)> turn_head{};
  // Pictures of every page, for people to look at (firmware/demo/gallery.h); may be empty.
  std::function<Result<void>(const KioskArgs& args, Kiosk& kiosk, Console& console)> take_screenshots{};
  // How often this thread has taken memory from the heap; may be empty.
  std::function<long()> allocations{};
};

}  // namespace relievo::firmware
