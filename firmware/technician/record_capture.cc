// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/technician/record_capture.h"

#include <string.h>

#include <cstring>

#include "firmware/base/output_folder.h"
#include "firmware/service/stick_folder.h"
#include "hal/picture_file.h"

namespace relievo::firmware {
namespace {

namespace fs = std::filesystem;

// Rows without padding: what is compared and written is pixels alone.
ImageView copied(const ImageView& view, std::vector<std::byte>& room) {
  const auto row_bytes =
      static_cast<std::size_t>(view.width_px) * static_cast<std::size_t>(bytes_per_pixel(view.format));
  room.resize(row_bytes * static_cast<std::size_t>(view.height_px));
  for (int y = 0; y < view.height_px; ++y)
    std::memcpy(room.data() + row_bytes * static_cast<std::size_t>(y), view.row(y), row_bytes);
  return {room.data(), view.width_px, view.height_px, static_cast<int>(row_bytes), view.format};
}

bool same(const ImageView& a, const ImageView& b) {
  if (a.width_px != b.width_px || a.height_px != b.height_px || a.format != b.format) return false;
  const auto row_bytes =
      static_cast<std::size_t>(a.width_px) * static_cast<std::size_t>(bytes_per_pixel(a.format));
  for (int y = 0; y < a.height_px; ++y) {
    if (std::memcmp(a.row(y), b.row(y), row_bytes) != 0) return false;
  }
  return true;
}

Result<void> read_back(const fs::path& file, const ImageView& written) {
  const Result<hal::Picture> read = hal::read_picture(file);
  const bool unread = !read && (read.error().code == Errc::IoFailed || read.error().code == Errc::NotFound);
  if (unread) return read.error();
  return read && same(read->view(), written) ? Result<void>() : not_as_written(file);
}

Result<void> write(const hal::RecordedPair& pair, const fs::path& target, hal::RemovableMedia& media,
                   StickWork& work) {
  RELIEVO_TRY(work.reach(ExportStep::Write, 0.1F));
  RELIEVO_TRY_ASSIGN(OutputFolder folder, OutputFolder::begin(target));
  RELIEVO_TRY_ASSIGN(const std::int64_t number, hal::record_pair(folder.path(), pair));
  RELIEVO_TRY(work.reach(ExportStep::ReadBack, 0.6F));
  RELIEVO_TRY(media.settle(folder.path()));
  RELIEVO_TRY(read_back(folder.path() / hal::recorded_name("left", number), pair.left));
  RELIEVO_TRY(read_back(folder.path() / hal::recorded_name("right", number), pair.right));
  RELIEVO_TRY(work.reach(ExportStep::Write, 0.9F));
  return replace_folder(folder, target);
}

}  // namespace

CaptureCopy::CaptureCopy(const pipeline::StereoFrame& frame, hal::RecordedPair as_taken)
    : pair_(std::move(as_taken)) {
  pair_.left = copied(frame.left, left_);
  pair_.right = copied(frame.right, right_);
}

CaptureCopy::~CaptureCopy() {
  for (std::vector<std::byte>* room : {&left_, &right_}) explicit_bzero(room->data(), room->size());
}

Result<void> record_capture(const hal::RecordedPair& pair, const std::string& name,
                            hal::RemovableMedia& media, JobControl& control, ExportTrace& trace) {
  trace = {};
  StickWork work{control, trace};
  return put_on_stick(media, fs::path(kCapturesFolder) / name, &work,
                      [&](const fs::path& target) { return write(pair, target, media, work); });
}

}  // namespace relievo::firmware
