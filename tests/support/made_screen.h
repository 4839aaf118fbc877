// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A Ui that lays pages out as on the device, without a window.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "ui/ui.h"

namespace relievo::test {

// Throws where languages or fonts are missing: the test fails, and says why.
inline std::unique_ptr<ui::Ui> make_screen() {
  const auto prepared = ui::prepare_languages();
  if (!prepared) throw std::runtime_error(std::string(prepared.error().what.view()));
  auto text = ui::TextEngine::make();
  if (!text) throw std::runtime_error(std::string(text.error().what.view()));
  return std::make_unique<ui::Ui>(*std::move(text));
}

}  // namespace relievo::test
