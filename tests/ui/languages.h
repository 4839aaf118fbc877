// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every language, for tests that run in each.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "ui/language/language.h"

namespace relievo::ui {

inline const auto kEveryLanguage = [] {
  std::vector<Language> all;
  for (std::size_t i = 0; i < kLanguages; ++i) all.push_back(static_cast<Language>(i));
  return testing::ValuesIn(all);
}();

inline std::string language_code(const testing::TestParamInfo<Language>& info) {
  return std::string(info_of(info.param).code).substr(0, 2);
}

}  // namespace relievo::ui
