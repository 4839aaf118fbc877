// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The halves behind the staff's pages, one line each. Pages on which PINs are typed are the Door's.
// Thread: main. Errors: none.
#pragma once

#include <memory>
#include <span>

#include "firmware/service/desk_page.h"

namespace relievo::firmware {

// pages[page]: none where the Door answers, or nobody.
void fill_desk_pages(DeskTools& tools, std::span<std::unique_ptr<DeskPage>> pages);
bool may_open(ui::StaffRole role, ui::StaffPage page);

}  // namespace relievo::firmware
