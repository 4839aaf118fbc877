// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The operator's consent text: consent/VERSION/LANGUAGE.txt in the folder of the store, UTF-8.
//
//   What happens here             the first line: the page's title
//                                 an empty line, then one block for each point:
//   We take one picture           its first line is its title,
//   Two cameras photograph ...    the others, joined, its words
//
// The version is the folder's name; in use is the last in the order of their names. LANGUAGE is one of
// en de fr es ar he zh-Hans ja. Thread: main.
// Errors: InvalidInput names the file and what is wrong with it; IoFailed.
#pragma once

#include <filesystem>
#include <optional>

#include "hal/base/result.h"
#include "ui/consent_text.h"

namespace relievo::firmware {

inline constexpr std::size_t kMostConsentBytes = 20'000;   // of one text
inline constexpr std::size_t kMostConsentPoints = 24;

// Nothing where there is no such folder: then the sample is shown, and says that it is one.
Result<std::optional<ui::ConsentTexts>> read_consent(const std::filesystem::path& folder);

}  // namespace relievo::firmware
