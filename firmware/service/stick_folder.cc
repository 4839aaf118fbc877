// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/service/stick_folder.h"

#include <cerrno>
#include <string>
#include <system_error>
#include <vector>

namespace relievo::firmware {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBefore = ".before";

fs::path before(const fs::path& target) {
  return target.parent_path() / ("." + target.filename().string() + kBefore);
}

// The name in ".NAME.part123" or ".NAME.before"; empty in any other.
std::string name_in(const std::string& entry) {
  const std::size_t end =
      entry.ends_with(kBefore) ? entry.size() - std::string_view(kBefore).size() : entry.rfind(".part");
  return entry.starts_with('.') && end != std::string::npos && end > 1 ? entry.substr(1, end - 1)
                                                                       : std::string();
}

Result<void> replace_folder(OutputFolder& made, const fs::path& target) {
  std::error_code error;
  const bool replaces = fs::exists(target, error);
  if (replaces) {
    fs::rename(target, before(target), error);
    if (error)
      return Error{Errc::IoFailed, "the folder of an earlier export cannot be replaced: use another stick",
                   error.value()}
          .at(target.native());
  }
  if (const Result<void> done = made.commit(); !done) {
    if (replaces) fs::rename(before(target), target, error);
    return done;
  }
  fs::remove_all(before(target), error);
  return {};
}

}  // namespace

Result<fs::path> place_on_stick(const fs::path& root, const fs::path& place) {
  fs::path way = root;
  std::error_code error;
  for (const fs::path& step : place) {
    way /= step;
    if (fs::is_symlink(fs::symlink_status(way, error)))
      return Error{Errc::IoFailed, "is a link on the stick, which may lead anywhere: use another stick",
                   ELOOP}
          .at(step.native());
  }
  return way;
}

Result<void> StickWork::reach(ExportStep step, float share) {
  // What has its name stays: its stick is let go, whoever stops it now.
  if (step < ExportStep::LetGo && control.cancelled.load())
    return Error{Errc::Cancelled, "nothing was stored"};
  trace.step = step;
  control.progress.done.store(share);
  return {};
}

Result<Sums> keep_folder(OutputFolder& made, const fs::path& target, hal::RemovableMedia& media,
                         StickWork* work, float done, float share) {
  RELIEVO_TRY_ASSIGN(Sums written, sums_of(made.path()));
  if (work != nullptr) RELIEVO_TRY(work->reach(ExportStep::ReadBack, done + 0.6F * share));
  RELIEVO_TRY(media.settle(made.path()));
  if (work != nullptr) RELIEVO_TRY(work->reach(ExportStep::ReadBack, done + 0.8F * share));
  RELIEVO_TRY_ASSIGN(const Sums read, sums_of(made.path()));
  if (read != written) return not_as_written(target);
  RELIEVO_TRY(plugged_in(media));  // else it all lies in the empty place, on the device
  if (work != nullptr) RELIEVO_TRY(work->reach(ExportStep::Write, done + 0.9F * share));
  RELIEVO_TRY(replace_folder(made, target));
  return written;
}

Result<void> put_on_stick(hal::RemovableMedia& media, const fs::path& place, StickWork* work,
                          const std::function<Result<void>(const fs::path& target)>& write) {
  RELIEVO_TRY_ASSIGN(const fs::path stick, plugged_in(media));
  RELIEVO_TRY_ASSIGN(const fs::path target, place_on_stick(stick, place));
  tidy_folder(target.parent_path());
  const Result<void> written = write(target);
  // Whatever failed: a stick that is gone is the reason.
  std::error_code error;
  if (!media.current() || (written && !fs::exists(target, error))) return pulled_too_early();
  RELIEVO_TRY(written);
  if (work != nullptr) RELIEVO_TRY(work->reach(ExportStep::LetGo, 1));
  return media.flush_and_eject();
}

Result<fs::path> plugged_in(hal::RemovableMedia& media) {
  if (auto stick = media.current()) return *std::move(stick);
  return Error{Errc::MediaMissing, "there is no stick: plug one in"};
}

Error pulled_too_early() {
  return {Errc::Disconnected, "the stick was pulled out too early: plug it in and try again"};
}

Error not_as_written(const fs::path& file) {
  return Error{Errc::IoFailed, "what was read back from the stick is not what was written: use another stick"}
      .at(file.filename().string());
}

void tidy_folder(const fs::path& folder, bool (*ours)(std::string_view name)) {
  std::error_code error;
  std::vector<fs::path> left;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = name_in(entry->path().filename().string());
    if (!name.empty() && ours(name)) left.push_back(entry->path());
  }
  for (const fs::path& one : left) {
    const fs::path target = folder / name_in(one.filename().string());
    if (one.filename().string().ends_with(kBefore) && !fs::exists(target, error))
      fs::rename(one, target, error);
    else fs::remove_all(one, error);
  }
}

}  // namespace relievo::firmware
