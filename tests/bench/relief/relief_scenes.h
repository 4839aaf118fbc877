// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What stands before the rig in the relief proof: people, and photographs of other people printed flat,
// printed and bent, or shown on a screen. Everything random comes from the number of the trial.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hal/picture_file.h"
#include "hal/sim/head/head_scene.h"
#include "hal/sim/optics/exposure.h"
#include "hal/sim/optics/rig.h"
#include "hal/sim/sheet/sheet_photo.h"

namespace relievo::bench {

enum class Shown : std::uint8_t { Face, PrintedFlat, PrintedBent, Screen, TurningPerson, TurningMask };
const char* name_of(Shown shown);

struct Trial {
  std::unique_ptr<hal::sim::Scene> scene;
  hal::sim::RigOptions rig;
  hal::sim::SensorOptions sensor;
  std::uint64_t noise_seed = 0;
  std::string what;  // for the log: every number that was drawn
};

// Frontal photographs of simulated people, taken as for a passport.
class Album {
 public:
  Album(std::uint32_t first_person, int count, ThreadPool& pool);
  const hal::Picture& of(std::size_t k) const { return photographs_[k % photographs_.size()]; }
  std::size_t size() const { return photographs_.size(); }

 private:
  std::vector<hal::Picture> photographs_;
};

// Half size: 960 x 600.
Trial show_picture(Shown shown, const Album& album, std::uint64_t number);
// The same person stands `kStands` times in a row before the head is made anew.
class People {
 public:
  static constexpr int kStands = 5;
  People(std::uint32_t first_person, ThreadPool& pool) : first_(first_person), pool_(pool) {}
  Trial show(std::uint64_t number);

 private:
  std::uint32_t first_;
  ThreadPool& pool_;
  std::uint32_t made_ = 0;
  std::shared_ptr<const hal::sim::HeadModel> head_;
};

// Three pairs of somebody who turns, in front and 25 degrees to either side, half size. A person blinks and
// speaks between them; a mask is rigid, its eyes closed.
std::array<Trial, 3> show_turning(Shown shown, std::uint32_t first_person, std::uint64_t number,
                                  ThreadPool& pool);

}  // namespace relievo::bench
