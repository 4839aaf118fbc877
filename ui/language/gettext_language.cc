// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <libintl.h>
#include <stdlib.h>

#include <clocale>
#include <filesystem>
#include <string>

#include "hal/base/shared_files.h"
#include "ui/language/language.h"

namespace relievo::ui {
namespace {

struct Row {
  LanguageInfo info;
  const char* domain;  // of its words; English has them from the source
};
constexpr std::array<Row, kLanguages> kRows{{
    {{"en", "English", false, true, '.'}, nullptr},
    {{"de", "Deutsch", false, true, ','}, "relievo-de"},
    {{"fr", "Français", false, true, ','}, "relievo-fr"},
    {{"es", "Español", false, true, ','}, "relievo-es"},
    {{"ar", "العربية", true, false, '.'}, "relievo-ar"},
    {{"he", "עברית", true, false, '.'}, "relievo-he"},
    {{"zh-Hans", "简体中文", false, true, '.'}, "relievo-zh"},
    {{"ja", "日本語", false, true, '.'}, "relievo-ja"},
}};
static_assert(kRows.back().domain != nullptr);

const char* domain_of(Language language) { return kRows[std::size_t(language)].domain; }

}  // namespace

const LanguageInfo& info_of(Language language) { return kRows[std::size_t(language)].info; }

Result<void> prepare_languages() {
  unsetenv("LANGUAGE");  // the person chooses, not the shell
  // Numbers stay as C writes them: only words and letters change.
  if (std::setlocale(LC_CTYPE, "C.UTF-8") == nullptr || std::setlocale(LC_MESSAGES, "C.UTF-8") == nullptr)
    return Error{Errc::LibraryFailed, "the system has no locale C.UTF-8: install Debian's libc-bin"};
  const std::string folder = shared_files("RELIEVO_LOCALE_DIR", "locale", RELIEVO_LOCALE_DIR).string();
  for (const auto& [info, domain] : kRows) {
    if (domain == nullptr) continue;
    if (!std::filesystem::exists(std::filesystem::path(folder) / "C.UTF-8" / "LC_MESSAGES" /
                                 (std::string(domain) + ".mo")))
      return Error{Errc::NotFound,
                   "has no words in other languages: install Relievo whole, or set RELIEVO_LOCALE_DIR"}
          .at(folder);
    bindtextdomain(domain, folder.c_str());
    bind_textdomain_codeset(domain, "UTF-8");
  }
  return {};
}

const char* Words::operator()(const char* english) const {
  return language_ == Language::English ? english : dgettext(domain_of(language_), english);
}

const char* Words::plural(const char* one, const char* many, unsigned long number) const {
  if (language_ == Language::English) return number == 1 ? one : many;
  return dngettext(domain_of(language_), one, many, number);
}

bool Words::knows(const char* english) const {
  return language_ == Language::English || (*this)(english) != english;
}

}  // namespace relievo::ui
