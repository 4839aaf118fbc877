// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ViewState: everything a screen may draw, as plain data made anew for every frame. A screen reads
// it, draws, and answers with an Intent: it decides nothing and remembers nothing about the person.
// Thread: main. Ownership: the model is borrowed for the length of one frame.
#pragma once

#include <cstdint>
#include <string_view>

#include "pipeline/model/advice.h"
#include "pipeline/model/face_model.h"
#include "pipeline/model/stereo_frame.h"

namespace relievo::ui {

// The states a person or a technician can see: the same words as the machine's states.
enum class Screen : std::uint8_t {
  SelfTest, Idle, Calibrate, Capture, Match, Reconstruct, Mesh, Texture, Review, Store, Export,
  Technician, Fault
};
std::string_view name_of(Screen screen);

struct ViewState {
  Screen screen = Screen::SelfTest;
  float progress = 0;                  // 0 to 1 within the present state; 0 where nothing runs
  pipeline::Advice advice = pipeline::Advice::None;
  std::string_view problem;            // one sentence for a person; empty when all is well
  std::string_view calibration_note;   // for the technician: the cameras have moved; empty when all is well
  std::string_view subject;            // who is being enrolled
  int attempt = 0;                     // 1 for the first capture of a session
  const pipeline::StereoFrame* frame = nullptr;  // the pictures of this session, once taken
  const pipeline::FaceModel* model = nullptr;    // from Review on
};

}  // namespace relievo::ui
