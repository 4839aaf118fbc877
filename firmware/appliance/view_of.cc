// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>

#include "firmware/appliance/appliance.h"

namespace relievo::firmware {
namespace {

// In the order of State; who waits need not tell an assembly from the texture before it.
constexpr std::array kScreens = [] {
  using enum ui::Screen;
  return std::array{SelfTest, Idle,    Calibrate, Position, Capture, Turn,   Match, Reconstruct, Mesh,
                    Texture,  Texture, Fuse,      Review,   Store,   Export, Staff, Fault};
}();
static_assert(kScreens.size() == std::size_t(State::Count));

ui::Screen screen_of(State state) {
  return state < State::Count ? kScreens[std::size_t(state)] : ui::Screen::Fault;
}

ui::Trouble trouble_of(const Error& problem, State state) {
  if (state == State::Review || state == State::Store)
    return problem.code == Errc::MediaFull ? ui::Trouble::StorageFull : ui::Trouble::Storage;
  if (state == State::Fault && problem.code == Errc::OutOfMemory) return ui::Trouble::Other;
  switch (problem.code) {
    case Errc::Disconnected: return ui::Trouble::Camera;
    case Errc::NotCalibrated: return ui::Trouble::Calibration;
    case Errc::NoFace:
    case Errc::TooFewMatches:
    case Errc::PoorGeometry:
    case Errc::LibraryFailed:
    case Errc::OutOfMemory:
    case Errc::InvalidInput: return ui::Trouble::Refused;
    case Errc::MediaFull:
    case Errc::MediaMissing:
    case Errc::StoreCorrupt:
    case Errc::StoreNewer: return ui::Trouble::Storage;
    case Errc::Timeout: return ui::Trouble::TookTooLong;
    case Errc::Cancelled: return ui::Trouble::None;
    case Errc::NotFound:
    case Errc::IoFailed:
    case Errc::InvalidState:
    case Errc::Unsupported:
    case Errc::Count: break;
  }
  return ui::Trouble::Other;
}

// Pictures whose thread has reported: the photograph, then those of the stages that are done.
std::size_t pictures_done(const Appliance& appliance) {
  const State state = appliance.state();
  if (state == State::Turn || state == State::Fuse)
    return 1 + std::min(kStagePictures - 1, appliance.parts_done());
  if (is_stage(state)) return 1 + number_of(state);
  return state == State::Review || state == State::Store ? kStagePictures : 0;
}

}  // namespace

ui::ViewState view_of(Appliance& appliance) {
  ui::ViewState view;
  view.screen = screen_of(appliance.state());
  view.progress = appliance.progress();
  view.attempt = appliance.attempt();
  if (appliance.problem()) view.trouble = trouble_of(*appliance.problem(), appliance.state());
  view.calibration_note = {Errc::NotCalibrated, appliance.calibration_note()};
  if (!appliance.session().is_open()) return view;
  view.live = appliance.live().newest();
  const StagePictures& pictures = appliance.session().stage_pictures();
  for (std::size_t i = 0; i < pictures_done(appliance); ++i) {
    if (pictures.number(i) != 0) view.stages[i] = {pictures.view(i), pictures.number(i)};
  }
  // While a job runs, the products are the worker's; before Review nothing of them is shown.
  if (appliance.state() != State::Review && appliance.state() != State::Store) return view;
  const Products& products = appliance.session().products();
  if (products.frame) view.frame = &*products.frame;
  if (products.model) {
    view.model = &*products.model;
    view.model_number = pictures.number(kStagePictures - 1) + 1;
  }
  return view;
}

}  // namespace relievo::firmware
