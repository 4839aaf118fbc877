// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Gallery: every screen there is, each as the view and the visit that lead to it; for screenshots and
// for tests that go over all of them. Built upon one real view (of Review), which lends its pictures.
#pragma once

#include <string_view>
#include <vector>

#include "ui/ui.h"

namespace relievo::firmware {

struct Exhibit {
  std::string_view name;
  ui::ViewState view;
  ui::Visit visit;
  ui::Service service;  // closed, but for the staff's pages
};

std::vector<Exhibit> gallery(const ui::ViewState& review, ui::Language language, std::size_t text_size,
                             bool high_contrast);

}  // namespace relievo::firmware
