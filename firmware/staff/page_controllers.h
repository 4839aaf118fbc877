// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The controllers of the staff's pages, one line each. Pages on which PINs are typed belong to SignIn.
// Thread: main. Errors: none.
#pragma once

#include <memory>
#include <span>

#include "firmware/service/page_controller.h"
#include "firmware/technician/test_capture.h"

namespace relievo::firmware {

using Pages = std::span<std::unique_ptr<PageController>>;

// pages[page]: none where SignIn answers, or nobody.
void fill_page_controllers(PageServices& services, Pages pages);
// One for every picture page: StaffPage::Stages and those after it, in TechnicianPage's order.
void fill_technician_pages(PageServices& services, TestCapture& test_capture, Pages pages);
bool may_open(ui::StaffRole role, ui::StaffPage page);

}  // namespace relievo::firmware
