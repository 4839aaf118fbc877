// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether the eyes of a head that turned were somebody's own: living eyes stay on the screen, painted ones
// turn with the head, closed ones show no iris. Each eye is looked at as a ball between its lids: for every
// pose, what stood around the pupil in the first photographs is looked for where it would be if it had turned
// with the head, and where it would be if it had stayed on the cameras (correlation). What is not told from a
// person: whatever has living eyes, as a soft mask with holes for them. Thread: any. Memory: the stack.
// Errors: none.
#pragma once

#include <optional>
#include <span>

#include "hal/base/result.h"
#include "pipeline/fuse/head_texturer.h"
#include "pipeline/model/landmarks.h"

namespace relievo::pipeline {

struct Aliveness {
  // Mean over the poses that turned: how much more alike the eyes are to eyes that stayed on the cameras than
  // to eyes that turned with the head, -2 to 2. None: no pose turned by 15 to 40 degrees.
  std::optional<double> eyes_follow{};
  // How much darker an iris is than what stands beside it, share; the more open eye. None: corners of eyes
  // were not found.
  std::optional<double> iris_contrast{};

  // Unjudged where either is none. Limits: pipeline/FIGURES.md.
  enum class Verdict : std::uint8_t { Alive, NotAlive, Unjudged };
  Verdict verdict() const;
};

// What to tell of one that is not alive: NoFace, with the figures as where().
Error error_of(const Aliveness& aliveness);

// `views`: both photographs of every pose, the master's first; `view_from_head` takes the mesh's frame.
// `head_from_camera` and `landmarks`: the master's face.
Aliveness measure_aliveness(std::span<const HeadView> views, const Landmarks& landmarks,
                            const RigidTransform& head_from_camera);

}  // namespace relievo::pipeline
