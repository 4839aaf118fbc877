// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include <new>
#include <span>

#include "hal/recording/capture_file.h"
#include "hal/whole_file.h"

namespace relievo::hal {
namespace {

constexpr std::size_t kLimitBytes = 16U << 20;

CaptureRecord record_of(const nlohmann::json& frame) {
  CaptureRecord r;
  r.number = frame.at("number").get<std::int64_t>();
  r.left_ns = frame.at("left_ns").get<std::int64_t>();
  r.right_ns = frame.at("right_ns").get<std::int64_t>();
  r.exposure_us = frame.value("exposure_us", std::int64_t{0});
  r.gain = frame.value("gain", 1.0);
  return r;
}

}  // namespace

Result<CaptureFile> read_capture_file(const std::filesystem::path& file) try {
  RELIEVO_TRY_ASSIGN(const std::vector<std::byte> bytes, read_whole_file(file, kLimitBytes));
  const auto* text = reinterpret_cast<const char*>(bytes.data());
  const nlohmann::json json = nlohmann::json::parse(text, text + bytes.size());
  CaptureFile capture;
  if (json.contains("cameras")) {
    capture.left_serial = json.at("cameras").at("left").value("serial", "");
    capture.right_serial = json.at("cameras").at("right").value("serial", "");
  }
  for (const auto& frame : json.at("frames")) capture.frames.push_back(record_of(frame));
  return capture;
} catch (const nlohmann::json::parse_error&) {
  return Error{Errc::InvalidInput, "this is not valid JSON; record it again or remove it"}.at(file.native());
} catch (const nlohmann::json::exception&) {
  return Error{Errc::InvalidInput, "a frame needs number, left_ns and right_ns, all numbers"}.at(
      file.native());
} catch (const std::bad_alloc&) {
  return Error{Errc::OutOfMemory, "no memory to read this file"}.at(file.native());
}

Result<void> write_capture_file(const std::filesystem::path& file, const CaptureFile& capture) {
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
  const std::string text = json.dump(1) + "\n";
  return write_whole_file(file, std::as_bytes(std::span(text)));
}

}  // namespace relievo::hal
