// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/technician/stick_files.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <functional>
#include <system_error>
#include <utility>

#include "firmware/base/output_folder.h"
#include "hal/base/whole_file.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "storage/document/document.h"

namespace relievo::firmware {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPieceBytes = std::size_t{1} << 20;
constexpr const char *kRig = "rig.yml", *kLeft = "left.yaml", *kRight = "right.yaml";

// What lies in a folder and is not hidden; nothing where there is none.
std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> all;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (!entry->path().filename().string().starts_with('.')) all.push_back(entry->path());
  return all;
}

Error unread(const fs::path& file) {
  return Error{Errc::IoFailed, "cannot be read from the stick: pull it out, plug it in and try again", errno}
      .at(file.filename().string());
}

// Who opens a pipe waits for its other end.
Result<void> check_regular(const fs::path& file) {
  std::error_code error;
  if (const auto status = fs::status(file, error); fs::exists(status) && !fs::is_regular_file(status))
    return invalid("this is not a file").at(file.filename().string());
  return {};
}

// Every piece of the file, in its order, until `take` says no.
template <typename Take>
Result<void> each_piece(const fs::path& file, JobControl& control, float from_share, float to_share,
                        const Take& take) {
  RELIEVO_TRY(check_regular(file));
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in) return unread(file);
  const auto size = std::size_t(in.tellg());
  if (size > storage::kMaxDocumentBytes)
    return invalid("this file is too large for a saved reconstruction").at(file.filename().string());
  in.seekg(0);
  std::vector<std::byte> piece(std::min(size, kPieceBytes));
  for (std::size_t at = 0; at < size; at += kPieceBytes) {
    if (control.cancelled.load()) return Error{Errc::Cancelled, "it was stopped"};
    const std::size_t bytes = std::min(kPieceBytes, size - at);
    if (!in.read(reinterpret_cast<char*>(piece.data()), std::streamsize(bytes))) return unread(file);
    RELIEVO_TRY(take(std::span<const std::byte>(piece).first(bytes), at, size));
    control.progress.done.store(from_share + (to_share - from_share) * float(at + bytes) / float(size));
  }
  return {};
}

Result<void> write(std::span<const std::byte> bytes, const fs::path& target, hal::RemovableMedia& media,
                   StickWork& work) {
  RELIEVO_TRY(work.reach(ExportStep::Write, 0));
  std::error_code error;
  fs::create_directories(target.parent_path(), error);
  RELIEVO_TRY_ASSIGN(PendingFile file, PendingFile::create(target));
  for (std::size_t at = 0; at < bytes.size(); at += kPieceBytes) {
    RELIEVO_TRY(work.reach(ExportStep::Write, 0.5F * float(at) / float(bytes.size())));
    RELIEVO_TRY(file.write(bytes.subspan(at, std::min(kPieceBytes, bytes.size() - at))));
  }
  RELIEVO_TRY(file.finish());
  RELIEVO_TRY(work.reach(ExportStep::ReadBack, 0.5F));
  RELIEVO_TRY(media.settle(target.parent_path()));
  RELIEVO_TRY(
      each_piece(file.temporary(), work.control, 0.5F, 0.95F,
                 [&](std::span<const std::byte> piece, std::size_t at, std::size_t size) -> Result<void> {
                   if (size != bytes.size() || !std::ranges::equal(piece, bytes.subspan(at, piece.size())))
                     return not_as_written(target);
                   return {};
                 }));
  RELIEVO_TRY(plugged_in(media));  // else it lies in the empty place, on the device
  RELIEVO_TRY(work.reach(ExportStep::Write, 0.95F));
  RELIEVO_TRY(file.publish());
  return sync_renamed(target);
}

Result<void> write(const pipeline::StereoCalibration& calibration, const fs::path& target,
                   hal::RemovableMedia& media) {
  RELIEVO_TRY_ASSIGN(const auto ros, pipeline::camera_info_texts(calibration));
  const std::pair<const char*, std::string> files[] = {
      {kRig, pipeline::calibration_text(calibration)}, {kLeft, ros.left}, {kRight, ros.right}};
  RELIEVO_TRY_ASSIGN(OutputFolder folder, OutputFolder::begin(target));
  for (const auto& [name, text] : files) RELIEVO_TRY(write_text(folder.path() / name, text, target));
  RELIEVO_TRY(keep_folder(folder, target, media, nullptr));
  return {};
}

// The top first, then the folders of calibrations, the last name first.
std::vector<fs::path> places(const fs::path& root) {
  std::vector<fs::path> folders = entries_of(root / kCalibrationsFolder);
  std::sort(folders.rbegin(), folders.rend());
  folders.insert(folders.begin(), root);
  return folders;
}

}  // namespace

Result<void> save_reconstruction(const SavedBytes& document, const std::string& name,
                                 hal::RemovableMedia& media, JobControl& control, ExportTrace& trace) {
  trace = {};
  StickWork work{control, trace};
  return put_on_stick(media, fs::path(kSavedFolder) / (name + kSavedEnding), &work,
                      [&](const fs::path& target) { return write(document, target, media, work); });
}

Result<std::vector<std::string>> saved_reconstructions(hal::RemovableMedia& media, std::size_t most) {
  RELIEVO_TRY_ASSIGN(const fs::path stick, plugged_in(media));
  std::vector<std::string> names;
  std::error_code error;
  for (const fs::path& entry : entries_of(stick / kSavedFolder))
    if (entry.string().ends_with(kSavedEnding) && fs::is_regular_file(entry, error))
      names.push_back(entry.filename().string());
  std::ranges::sort(names, std::greater<>());  // a name is the time at which it was saved
  names.resize(std::min(names.size(), most));
  return names;
}

Result<SavedBytes> read_saved(const std::string& name, hal::RemovableMedia& media, JobControl& control) {
  RELIEVO_TRY_ASSIGN(const fs::path stick, plugged_in(media));
  SavedBytes saved;
  RELIEVO_TRY(
      each_piece(stick / kSavedFolder / name, control, 0, 0.9F,
                 [&saved](std::span<const std::byte> piece, std::size_t, std::size_t size) -> Result<void> {
                   saved.reserve(size);
                   saved.insert(saved.end(), piece.begin(), piece.end());
                   return {};
                 }));
  RELIEVO_TRY(storage::Document::open(saved).at(name));
  return saved;
}

Result<void> export_calibration(const pipeline::StereoCalibration& calibration, const std::string& name,
                                hal::RemovableMedia& media) {
  return put_on_stick(media, fs::path(kCalibrationsFolder) / name, nullptr,
                      [&](const fs::path& target) { return write(calibration, target, media); });
}

Result<StickCalibration> import_calibration(hal::RemovableMedia& media) {
  RELIEVO_TRY_ASSIGN(const fs::path stick, plugged_in(media));
  for (const fs::path& place : places(stick))
    for (const char* name : {kRig, kLeft}) {
      std::error_code error;
      if (!fs::exists(place / name, error)) continue;
      const std::string file = (place / name).lexically_relative(stick).string();
      const auto read = pipeline::read_calibration(place / name);
      if (!read) return read.error();
      return StickCalibration{*read, file};
    }
  return Error{Errc::NotFound,
               "no calibration is on the stick: put rig.yml, or left.yaml and right.yaml, at its top"};
}

}  // namespace relievo::firmware
