// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/service/consent_text_store.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include "firmware/base/output_folder.h"
#include "firmware/service/export_records.h"
#include "firmware/service/page_controller.h"
#include "hal/base/utf8.h"
#include "hal/base/whole_file.h"
#include "hal/picture_file.h"
#include "storage/export/bundle.h"
#include "storage/sodium_sha256.h"

namespace relievo::firmware {
namespace {

namespace fs = std::filesystem;

constexpr const char *kHostFile = "operator.txt", *kSignFile = "sign.png", *kLinkFile = "link.txt";
constexpr std::size_t kMostHostBytes = 80, kMostSignBytes = 1'000'000, kMostLinkBytes = 200;
constexpr int kMostSignPx = 1024;
constexpr std::string_view kConsentSetting = "consent-texts";  // "VERSION/LANGUAGE.txt SHA-256" a line

Error wrong(const fs::path& file, Literal what) { return invalid(what).at(file.string()); }

// A name that can stand in a record.
bool is_version(const std::string& name) { return name.size() <= 40 && storage::is_plain_name(name); }

// Whole UTF-8, and no control characters but the ends of lines.
bool is_text(std::string_view text) {
  for (Utf8Letter letter; !text.empty(); text.remove_prefix(letter.bytes)) {
    letter = first_letter_of(text);
    if (letter.bytes == 0 || (letter.code < 0x20 && letter.code != '\n')) return false;
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

// Of the words as they are read: the same from an editor that ends its lines in another way.
Result<std::string> text_sum(const fs::path& file) {
  RELIEVO_TRY_ASSIGN(const std::string text, read_consent_text(file));
  return storage::hex_of(storage::sha256(std::as_bytes(std::span(text))));
}

using TextSums = std::map<std::string, std::string>;  // VERSION/LANGUAGE.txt, SHA-256

Result<TextSums> known_texts(storage::Store& store) {
  RELIEVO_TRY_ASSIGN(const std::string kept, store.setting(kConsentSetting));
  TextSums sums;
  std::istringstream lines(kept);
  for (std::string file, sum; lines >> file >> sum;) sums[file] = sum;
  return sums;
}

// A language that comes later is remembered from then on.
Result<void> remember_texts(storage::Store& store, const fs::path& folder, const std::string& version) {
  RELIEVO_TRY_ASSIGN(TextSums sums, known_texts(store));
  const std::size_t before = sums.size();
  std::error_code error;
  for (fs::directory_iterator entry(folder / version, error), end; !error && entry != end;
       entry.increment(error)) {
    if (is_hidden(entry->path()) || !language_of(entry->path())) continue;
    RELIEVO_TRY_ASSIGN(const std::string sum, text_sum(entry->path()));
    sums.emplace(version + "/" + entry->path().filename().string(), sum);
  }
  if (error) return Error{Errc::IoFailed, "cannot be read"}.at((folder / version).string());
  if (sums.size() == before) return {};
  std::string lines;
  for (const auto& [file, sum] : sums) lines += file + " " + sum + "\n";
  return store.set_setting(kConsentSetting, lines);
}

Error not_kept() { return {Errc::IoFailed, "cannot be kept on this device: look at the room on its disk"}; }

// The first line of operator.txt is their name, the others say how they are reached.
Result<void> read_host(const fs::path& file, ui::Host& host) {
  RELIEVO_TRY_ASSIGN(const std::string text, read_consent_text(file));
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty()) continue;
    if (host.name.empty()) host.name = line;
    else host.reached += (host.reached.empty() ? "" : " ") + line;
  }
  if (host.name.empty() || host.name.size() > kMostHostBytes)
    return wrong(file, "has no name in its first line, or one of more than 80 bytes");
  return {};
}

// A site by its name alone, so that the page can say where it leads; then a path with the number in it.
Result<void> read_link(const fs::path& file, ui::Host& host) {
  RELIEVO_TRY_ASSIGN(const std::string text, read_consent_text(file));
  const std::string link = text.substr(0, text.find('\n'));
  const auto plain = [](char c) { return c > ' ' && c <= '~' && c != '"' && c != '<' && c != '>'; };
  const auto of_a_site = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' || c == '-';
  };
  const std::string_view site = ui::site_of(link);
  if (!link.starts_with(ui::kHttps) || link.size() > kMostLinkBytes || !std::ranges::all_of(link, plain) ||
      site.empty() || !std::ranges::all_of(site, of_a_site))
    return wrong(file, "is no https address of at most 200 bytes, as https://museum.example/heads/{model}");
  const std::size_t place = link.find(ui::kModelPlace);
  if (place == std::string::npos || link.find(ui::kModelPlace, place + 1) != std::string::npos)
    return wrong(file, "must have one place for the number of the portrait: write {model} there");
  host.link = link;
  return {};
}

Result<void> read_sign(const fs::path& file, ui::Host& host) {
  std::error_code error;
  if (!fs::is_regular_file(fs::symlink_status(file, error)) || fs::file_size(file, error) > kMostSignBytes)
    return wrong(file, "is no picture of at most 1 MB");
  auto picture = hal::read_picture(file);
  if (!picture || picture->format == PixelFormat::Grey16 ||
      std::max(picture->width_px, picture->height_px) > kMostSignPx)
    return wrong(file, "is no picture of at most 1024 pixels each way, 8 bits a channel");
  host.sign = std::move(picture->bytes);
  host.sign_width_px = picture->width_px;
  host.sign_height_px = picture->height_px;
  host.sign_format = picture->format;
  return {};
}

struct HostFile {
  const char* name;
  Result<void> (*read)(const fs::path& file, ui::Host& host);
};
constexpr HostFile kHostFiles[] = {{kHostFile, read_host}, {kLinkFile, read_link}, {kSignFile, read_sign}};

// The files of a version, from one folder to another; only text and picture are taken, not what else a file
// system knows of a file.
Result<void> copy_texts(const fs::path& from, const fs::path& to) {
  std::error_code error;
  for (fs::directory_iterator entry(from, error), end; !error && entry != end; entry.increment(error)) {
    if (is_hidden(entry->path())) continue;
    const fs::path name = entry->path().filename();
    if (name == kSignFile) {
      RELIEVO_TRY_ASSIGN(const hal::Picture sign, hal::read_picture(entry->path()));
      if (!hal::write_picture(to / name, sign.view())) return not_kept().at(name.string());
      continue;
    }
    RELIEVO_TRY_ASSIGN(const std::string text, read_consent_text(entry->path()));
    if (!write_text(to / name, text, name)) return not_kept().at(name.string());
  }
  if (error) return Error{Errc::IoFailed, "cannot be read", error.value()}.at(from.string());
  return sync_directory(to);
}

}  // namespace

Result<std::optional<ui::ConsentTexts>> take_consent(const fs::path& stick, const fs::path& own,
                                                     const std::optional<ui::ConsentTexts>& now) {
  RELIEVO_TRY_ASSIGN(const auto found, read_consent(stick / "consent"));
  if (!found) return Error{Errc::NotFound, "the stick has no folder named consent"};
  if (now && found->version < now->version)
    return invalid("comes before the version in force: give the new one a name that comes after it")
        .at(found->version);
  if (now && found->version == now->version) {
    if (*found == *now) return std::optional<ui::ConsentTexts>{};
    return invalid("is in force already, with other words: give the new one a name of its own")
        .at(found->version);
  }
  Result<OutputFolder> folder = OutputFolder::begin(own / found->version);
  if (!folder) return not_kept().at(found->version);
  RELIEVO_TRY(copy_texts(stick / "consent" / found->version, folder->path()));
  const Result<ui::ConsentTexts> kept = read_consent_version(folder->path(), found->version);
  if (!kept || !(*kept == *found))
    return Error{Errc::IoFailed, "was read twice and was not the same: use another stick"}.at(found->version);
  if (!folder->commit()) return not_kept().at(found->version);
  return std::optional(*found);
}

bool is_hidden(const fs::path& path) { return path.filename().string().starts_with('.'); }

Result<std::string> read_consent_text(const fs::path& file) {
  std::error_code error;
  // A link on a stick would lead to a file of the device.
  if (!fs::is_regular_file(fs::symlink_status(file, error)))
    return wrong(file, "is no file: a text in a language is a file of its own");
  std::ifstream in(file, std::ios::binary);
  std::string text(kMostConsentBytes + 1, '\0');
  in.read(text.data(), std::streamsize(text.size()));
  if (in.bad() || (!in.eof() && in.fail())) return Error{Errc::IoFailed, "cannot be read"}.at(file.string());
  text.resize(std::size_t(in.gcount()));
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
    const auto of_host = std::ranges::find(kHostFiles, entry->path().filename(), &HostFile::name);
    if (of_host != std::end(kHostFiles)) {
      RELIEVO_TRY(of_host->read(entry->path(), texts.host));
      continue;
    }
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
  if (fs::is_symlink(fs::symlink_status(folder, error)))
    return wrong(folder, "is no file: a text in a language is a file of its own");
  fs::path newest;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (is_hidden(entry->path())) continue;
    if (!is_version(entry->path().filename().string()) ||
        !fs::is_directory(fs::symlink_status(entry->path(), error)))
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

Result<std::optional<ui::ConsentTexts>> own_consent(const fs::path& folder) {
  std::error_code ignored;
  tidy_folder(folder);
  if (fs::is_directory(fs::symlink_status(folder, ignored)) && fs::is_empty(folder, ignored))
    fs::remove(folder, ignored);
  return read_consent(folder);
}

Result<std::vector<Error>> broken_consents(storage::Store& store, const fs::path& folder) {
  std::vector<Error> broken;
  RELIEVO_TRY_ASSIGN(const TextSums sums, known_texts(store));
  for (const auto& [file, sum] : sums) {
    const auto now = text_sum(folder / file);
    if (!now)
      broken.push_back(wrong(folder / file, "is gone, and people agreed to it: put it back from a copy"));
    else if (*now != sum)
      broken.push_back(wrong(
          folder / file,
          "has other words than when people agreed to it: put them back, and give new ones a version of their own"));
  }
  return broken;
}

Result<void> ConsentTextStore::look(Console& console) {
  RELIEVO_TRY_ASSIGN(now_, own_consent(folder_));
  RELIEVO_TRY_ASSIGN(const auto broken, broken_consents(store_, folder_));
  std::error_code ignored;
  for (const Error& error : broken) {
    const fs::path file = error.where();
    if (now_ && file.parent_path() == folder_ / now_->version && fs::exists(file, ignored)) return error;
    console.fail(error);
    log_.fault(error);
  }
  return now_ ? remember_texts(store_, folder_, now_->version) : Result<void>();
}

void ConsentTextStore::opened() {
  view_.outcome = ui::Outcome::None;
  view_.fault = nullptr;
}

void ConsentTextStore::take() {
  if (view_.taking) return;
  opened();
  view_.taking = true;
  using Taken = std::optional<ui::ConsentTexts>;
  side_tasks_.ask(
      JobLane::Keeper,
      [this, now = now_](JobControl&) -> Result<Taken> {
        RELIEVO_TRY_ASSIGN(const std::filesystem::path stick, plugged_in(media_));
        auto taken = take_consent(stick, folder_, now);
        if (taken && *taken) RELIEVO_TRY(remember_texts(store_, folder_, (*taken)->version));
        // Whatever failed: a stick that is gone is the reason.
        if (!taken && !media_.current()) return pulled_too_early();
        return taken;
      },
      [this](Result<Taken> taken) {
        view_.taking = false;
        if (!taken) return failed(taken.error());
        view_.outcome = ui::Outcome::Done;
        if (!*taken) return;
        log_.say(ui::LogEvent::ConsentTaken, {(*taken)->version});
        next_ = *std::move(taken);
      },
      SideTasks::Whose::Device);
}

void ConsentTextStore::failed(const Error& error) {
  view_.outcome = outcome_of(error);
  // A file is known to the operator by its name, wherever the stick is mounted.
  fault_ = ui::fault_of(error.at(fs::path(error.where()).filename().string()));
  view_.fault = &fault_;
  if (error.code != Errc::MediaMissing) log_.fault(error);
}

void ConsentTextStore::adopt() {
  if (!next_) return;
  now_ = std::move(next_);
  next_.reset();
}

}  // namespace relievo::firmware
