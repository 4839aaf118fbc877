// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where things are when nobody says otherwise.
#pragma once

#include <filesystem>

namespace relievo::firmware {

// $XDG_DATA_HOME/relievo, ~/.local/share/relievo, or relievo-store where there is no home.
std::filesystem::path default_store_folder();

}  // namespace relievo::firmware
