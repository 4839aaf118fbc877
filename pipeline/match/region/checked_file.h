// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A cascade's file as text, read whole and checked by its SHA-256 before any library parses it.
// Thread: any. Errors: NotFound (no such file), StoreCorrupt (not the file we know).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "hal/base/result.h"

namespace relievo::pipeline {

// Of opencv-data 4.6.0. Other files may be good too, but nobody has measured them here.
enum class FaceCascade : std::uint8_t { Alt2, Default, Alt, Profile };
inline constexpr std::size_t kFaceCascades = 4;

Result<std::string> read_cascade(const std::filesystem::path& folder, FaceCascade which);

}  // namespace relievo::pipeline
