// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The .sql files, as they were when this program was built.
#pragma once

#include <span>
#include <string_view>

namespace relievo::storage {

std::string_view schema_sql();

// migrations()[n - 1] takes a store from version n - 1 to version n.
std::span<const std::string_view> migrations();

}  // namespace relievo::storage
