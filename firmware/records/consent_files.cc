// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/records/consent_files.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

namespace relievo::firmware {
namespace {

namespace fs = std::filesystem;

Error wrong(const fs::path& file, Literal what) { return Error{Errc::InvalidInput, what}.at(file.string()); }

// A name that can stand in a record: letters of ASCII, digits, dot, dash, underscore.
bool is_version(const std::string& name) {
  const auto good = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '-' || c == '_';
  };
  return !name.empty() && name.size() <= 40 && name.front() != '.' &&
         std::all_of(name.begin(), name.end(), good);
}

// Whole UTF-8, as RFC 3629 has it, and no control characters but the ends of lines.
bool is_text(const std::string& text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    if (first < 0x20 && first != '\n') return false;
    const std::size_t more = first < 0x80                    ? 0
                             : first >= 0xC2 && first < 0xE0 ? 1
                             : first >= 0xE0 && first < 0xF0 ? 2
                             : first >= 0xF0 && first < 0xF5 ? 3
                                                             : 9;
    if (more == 9 || i + more >= text.size()) return false;
    for (std::size_t k = 1; k <= more; ++k) {
      if ((static_cast<unsigned char>(text[i + k]) & 0xC0U) != 0x80U) return false;
    }
    i += more + 1;
  }
  return true;
}

Result<ui::ConsentText> parse(const fs::path& file) {
  RELIEVO_TRY_ASSIGN(const std::string text, read_consent_text(file));
  std::istringstream lines(text);
  ui::ConsentText consent;
  bool in_block = false;
  for (std::string line; std::getline(lines, line);) {
    while (!line.empty() && line.back() == ' ') line.pop_back();
    if (line.empty()) {
      in_block = false;
    } else if (consent.title.empty()) {
      consent.title = line;
    } else if (!in_block) {
      consent.points.push_back({line, {}});
      in_block = true;
    } else {
      std::string& words = consent.points.back().words;
      words += (words.empty() ? "" : " ") + line;
    }
  }
  if (consent.title.empty()) return wrong(file, "is empty: its first line is the page's title");
  if (consent.points.empty())
    return wrong(file, "has a title and no points: after an empty line, a point's title and its words");
  if (consent.points.size() > kMostConsentPoints)
    return wrong(file, "has more than 24 points: a visitor would not read them");
  return consent;
}

std::optional<std::size_t> language_of(const fs::path& file) {
  for (std::size_t i = 0; i < ui::kLanguages; ++i) {
    if (file.filename() == std::string(ui::info_of(static_cast<ui::Language>(i)).code) + ".txt") return i;
  }
  return std::nullopt;
}

}  // namespace

bool is_hidden(const fs::path& path) { return path.filename().string().starts_with('.'); }

Result<std::string> read_consent_text(const fs::path& file) {
  std::error_code error;
  // A link on a stick would lead to a file of the device.
  if (!fs::is_regular_file(fs::symlink_status(file, error)))
    return wrong(file, "is no file: a text in a language is a file of its own");
  std::ifstream in(file, std::ios::binary);
  std::string text(kMostConsentBytes + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad() || (!in.eof() && in.fail())) return Error{Errc::IoFailed, "cannot be read"}.at(file.string());
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (text.size() > kMostConsentBytes)
    return wrong(file, "is longer than 20000 bytes: a visitor would not read it");
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  std::erase(text, '\r');
  if (!is_text(text)) return wrong(file, "is not UTF-8 text: save it as UTF-8");
  return text;
}

Result<ui::ConsentTexts> read_consent_version(const fs::path& folder, const std::string& version) {
  std::error_code error;
  ui::ConsentTexts texts;
  texts.version = version;
  bool any = false;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (is_hidden(entry->path())) continue;
    const auto language = language_of(entry->path());
    if (!language)
      return wrong(
          entry->path(),
          "is no text in a language: call it en.txt, de.txt, fr.txt, es.txt, ar.txt, he.txt, zh-Hans.txt or ja.txt");
    RELIEVO_TRY_ASSIGN(texts.in[*language], parse(entry->path()));
    any = true;
  }
  if (error) return Error{Errc::IoFailed, "cannot be read"}.at(folder.string());
  if (!any) return wrong(folder, "has no text in it: LANGUAGE.txt is missing");
  return texts;
}

Result<std::optional<ui::ConsentTexts>> read_consent(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) return std::optional<ui::ConsentTexts>{};
  fs::path newest;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (is_hidden(entry->path())) continue;
    if (!is_version(entry->path().filename().string()) || !entry->is_directory(error))
      return wrong(
          entry->path(),
          "is no version of a consent text: a folder, named with letters, digits, dot, dash and underscore");
    newest = std::max(newest, entry->path());
  }
  if (error) return Error{Errc::IoFailed, "cannot be read"}.at(folder.string());
  if (newest.empty())
    return wrong(folder, "has no version in it: make VERSION/LANGUAGE.txt, or remove it to show the sample");
  RELIEVO_TRY_ASSIGN(auto texts, read_consent_version(newest, newest.filename().string()));
  return std::optional(std::move(texts));
}

}  // namespace relievo::firmware
