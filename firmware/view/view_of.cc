// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/view/view_of.h"

namespace relievo::firmware {
namespace {

ui::Screen screen_of(State state) {
  switch (state) {
    case State::SelfTest: return ui::Screen::SelfTest;
    case State::Idle: return ui::Screen::Idle;
    case State::Calibrate: return ui::Screen::Calibrate;
    case State::Capture: return ui::Screen::Capture;
    case State::Match: return ui::Screen::Match;
    case State::Reconstruct: return ui::Screen::Reconstruct;
    case State::Mesh: return ui::Screen::Mesh;
    case State::Texture: return ui::Screen::Texture;
    case State::Review: return ui::Screen::Review;
    case State::Store: return ui::Screen::Store;
    case State::Export: return ui::Screen::Export;
    case State::Technician: return ui::Screen::Technician;
    case State::Fault:
    case State::Count: break;
  }
  return ui::Screen::Fault;
}

}  // namespace

ui::ViewState view_of(const Appliance& appliance) {
  ui::ViewState view;
  view.screen = screen_of(appliance.state());
  view.progress = appliance.progress();
  view.attempt = appliance.attempt();
  if (appliance.problem()) {
    view.problem = appliance.problem()->what.view();
    if (appliance.problem()->code == Errc::NoFace) view.advice = pipeline::Advice::NoFace;
  }
  // What was wrong first counts less than what is wrong now.
  if (const std::string_view gone = sentence_of(appliance.cameras()); !gone.empty()) view.problem = gone;
  view.calibration_note = appliance.calibration_note();
  if (!appliance.session().is_open()) return view;
  view.subject = appliance.session().subject();
  // While a job runs, the products are the worker's; before Review nothing of them is shown.
  const bool at_rest = appliance.state() == State::Review || appliance.state() == State::Store;
  const Products& products = appliance.session().products();
  if (at_rest && products.frame) view.frame = &*products.frame;
  if (at_rest && products.model) view.model = &*products.model;
  return view;
}

}  // namespace relievo::firmware
