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
// en de fr es ar he zh-Hans ja. Names that begin with a dot are somebody else's (a copy that was not
// finished, what a computer leaves on a stick). Thread: any.
// Errors: InvalidInput names the file and what is wrong with it; IoFailed. Their sentences are keys of
// the staff's catalogues (ui/language).
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "hal/base/result.h"
#include "ui/view/consent_text.h"

namespace relievo::firmware {

inline constexpr std::size_t kMostConsentBytes = 20'000;  // of one text
inline constexpr std::size_t kMostConsentPoints = 24;

// Nothing where there is no such folder: then the sample is shown, and says that it is one.
Result<std::optional<ui::ConsentTexts>> read_consent(const std::filesystem::path& folder);

// One folder of LANGUAGE.txt, under that name.
Result<ui::ConsentTexts> read_consent_version(const std::filesystem::path& folder,
                                              const std::string& version);
// A file as it is taken for text: UTF-8 without its mark, ends of lines as here, at most kMostConsentBytes.
Result<std::string> read_consent_text(const std::filesystem::path& file);
bool is_hidden(const std::filesystem::path& path);

}  // namespace relievo::firmware
