// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/recording/capture_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <new>
#include <span>
#include <system_error>

#include "hal/base/whole_file.h"
#include "hal/picture_file.h"

namespace relievo::hal {
namespace {

constexpr std::int64_t kMostNumber = 999'999;  // six digits in a picture's name
constexpr std::size_t kLimitBytes = 16U << 20;

}  // namespace

std::string recorded_name(const char* side, std::int64_t number) {
  char name[40];
  std::snprintf(name, sizeof name, "%s_%06lld.png", side, static_cast<long long>(number));
  return name;
}

Result<std::int64_t> record_pair(const std::filesystem::path& folder, const RecordedPair& pair) {
  if (pair.left.empty() || pair.right.empty())
    return invalid("a pair without pixels cannot be recorded").at(folder.string());
  if (pair.left.width_px != pair.right.width_px || pair.left.height_px != pair.right.height_px ||
      pair.left.format != pair.right.format)
    return invalid("the two views differ in size or format: they are no pair").at(folder.string());
  std::error_code failed;
  std::filesystem::create_directory(folder, failed);
  if (failed)
    return Error{Errc::IoFailed, "the folder for recordings cannot be made", failed.value()}.at(
        folder.string());
  RELIEVO_TRY_ASSIGN(CaptureFile capture, capture_file_in(folder));
  std::int64_t number = 1;
  for (const CaptureRecord& frame : capture.frames) number = std::max(number, frame.number + 1);
  if (number > kMostNumber)
    return invalid("this recording has no number left: begin another").at(folder.string());
  RELIEVO_TRY(write_picture(folder / recorded_name("left", number), pair.left));
  RELIEVO_TRY(write_picture(folder / recorded_name("right", number), pair.right));
  capture.left_serial = pair.left_serial;
  capture.right_serial = pair.right_serial;
  capture.head = pair.of_head;
  capture.frames.push_back({number, pair.left_ns, pair.right_ns, pair.exposure_us, pair.gain});
  RELIEVO_TRY(write_capture_file(folder / "capture.json", capture));
  return number;
}

Result<CaptureFile> read_capture_file(const std::filesystem::path& file) try {
  RELIEVO_TRY_ASSIGN(const std::vector<std::byte> bytes, read_whole_file(file, kLimitBytes));
  const auto* text = reinterpret_cast<const char*>(bytes.data());
  const nlohmann::json json = nlohmann::json::parse(text, text + bytes.size());
  CaptureFile capture;
  if (json.contains("cameras")) {
    capture.left_serial = json.at("cameras").at("left").value("serial", "");
    capture.right_serial = json.at("cameras").at("right").value("serial", "");
  }
  capture.head = json.value("head", false);
  for (const auto& frame : json.at("frames")) {
    capture.frames.push_back({.number = frame.at("number").get<std::int64_t>(),
                              .left_ns = frame.at("left_ns").get<std::int64_t>(),
                              .right_ns = frame.at("right_ns").get<std::int64_t>(),
                              .exposure_us = frame.value("exposure_us", std::int64_t{0}),
                              .gain = frame.value("gain", 1.0)});
    if (const auto number = capture.frames.back().number; number < 0 || number > kMostNumber)
      return invalid("a frame's number is 0 to 999999").at(file.native());
  }
  return capture;
} catch (const nlohmann::json::parse_error&) {
  return invalid("this is not valid JSON; record it again or remove it").at(file.native());
} catch (const nlohmann::json::exception&) {
  return invalid("a frame needs number, left_ns and right_ns, all numbers, and head is true or false")
      .at(file.native());
} catch (const std::bad_alloc&) {
  return Error{Errc::OutOfMemory, "no memory to read this file"}.at(file.native());
}

Result<CaptureFile> capture_file_in(const std::filesystem::path& folder) {
  Result<CaptureFile> capture = read_capture_file(folder / "capture.json");
  if (!capture && capture.error().code == Errc::NotFound) return CaptureFile{};
  return capture;
}

Result<void> write_capture_file(const std::filesystem::path& file, const CaptureFile& capture) try {
  nlohmann::ordered_json json;
  json["cameras"] = {{"left", {{"serial", capture.left_serial}}},
                     {"right", {{"serial", capture.right_serial}}}};
  json["frames"] = nlohmann::ordered_json::array();
  for (const CaptureRecord& r : capture.frames)
    json["frames"].push_back({{"number", r.number},
                              {"left_ns", r.left_ns},
                              {"right_ns", r.right_ns},
                              {"exposure_us", r.exposure_us},
                              {"gain", r.gain}});
  if (capture.head) json["head"] = true;
  const std::string text = json.dump(1) + "\n";
  return write_whole_file(file, std::as_bytes(std::span(text)));
} catch (const nlohmann::json::exception&) {
  return invalid("a camera's serial number is no UTF-8 and cannot be recorded").at(file.native());
} catch (const std::bad_alloc&) {
  return Error{Errc::OutOfMemory, "no memory to write this file"}.at(file.native());
}

Result<std::vector<std::filesystem::path>> recorded_pictures(const std::filesystem::path& folder) {
  RELIEVO_TRY_ASSIGN(const CaptureFile capture, read_capture_file(folder / "capture.json"));
  std::vector<std::filesystem::path> pictures;
  std::error_code failed;
  for (const CaptureRecord& frame : capture.frames)
    for (const char* side : {"left", "right"}) {
      pictures.push_back(folder / recorded_name(side, frame.number));
      if (!std::filesystem::is_regular_file(pictures.back(), failed))
        return Error{Errc::NotFound, "this picture of the recording is missing: copy the whole folder again"}
            .at(pictures.back().native());
    }
  if (pictures.empty()) return Error{Errc::NotFound, "this recording holds no pair"}.at(folder.native());
  return pictures;
}

}  // namespace relievo::hal
