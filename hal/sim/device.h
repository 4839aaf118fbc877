// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The devices that need no hardware: a folder of recorded pictures, and a simulated rig. A frame is
// made when the trigger line pulses; without a pulse next_frame() meets its deadline.
// Thread: making: main; cameras: capture; the rest as hal/device.h says.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "hal/base/result.h"
#include "hal/device.h"
#include "hal/sim/render.h"

namespace relievo::hal {

// DIR holds left_NNNNNN.png and right_NNNNNN.png with an optional capture.json, or plain left* and
// right* pictures. The frames repeat for ever, in name order. Pictures are read when asked for.
// Errors: NotFound (no folder, no picture), InvalidInput (a name without its partner, a bad
// capture.json, pictures that differ in size).
Result<std::unique_ptr<Device>> make_folder_device(const std::filesystem::path& folder);

struct SimDeviceOptions {
  sim::SimulationOptions simulation;
  // Where an inserted stick is shown as a folder; none: no stick.
  std::optional<std::filesystem::path> media_folder;
  int threads = 2;
  // A folder where pictures of rendered heads are kept from run to run, so that the next need not render
  // them; empty: nowhere. To be emptied when what renders them changes.
  std::filesystem::path album;
};

// Turns the head of the simulated person, or shows the next side of a recorded one (capture.json), from where
// it stands, about its neck; the pictures show it when they are rendered, seconds later. Nothing where the
// device is another one, or holds a board. Thread: any.
void turn_simulated_head(Device& device, double yaw_deg);

// Renders at the first frame (seconds); later frames of the same scene only differ in noise.
Result<std::unique_ptr<Device>> make_sim_device(const SimDeviceOptions& options);

}  // namespace relievo::hal
