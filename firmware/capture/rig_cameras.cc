// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/capture/rig_cameras.h"

#include <algorithm>
#include <string>

namespace relievo::firmware {
namespace {

using pipeline::RigCameras;

std::string words(std::string_view kind, std::string_view name) {
  const std::size_t room = pipeline::kMaxCameraWords - kind.size();
  if (name.size() > room) name.remove_prefix(name.size() - room);  // names of sockets differ in their ends
  std::string text(kind);
  std::transform(name.begin(), name.end(), std::back_inserter(text),
                 [](char c) { return c >= ' ' && c <= '~' ? c : '?'; });
  return text;
}

std::string words_of(const hal::Camera& camera, bool by_serial) {
  if (by_serial && !camera.serial().empty()) return words("serial ", camera.serial());
  return camera.socket().empty() ? std::string() : words("at ", camera.socket());
}

// Of nobody known there is nothing to say.
bool another(const std::string& calibrated, const std::string& found) {
  return !calibrated.empty() && !found.empty() && calibrated != found;
}

}  // namespace

RigCameras cameras_of(const hal::Camera& left, const hal::Camera& right) {
  const bool one_device = left.socket() == right.socket();
  const bool by_serial = one_device || left.serial() != right.serial();
  return {words_of(left, by_serial), words_of(right, by_serial)};
}

Result<void> check_cameras(const RigCameras& calibrated, const RigCameras& found) {
  const bool left = another(calibrated.left, found.left), right = another(calibrated.right, found.right);
  if (!left && !right) return {};
  const std::string at_left = calibrated.left + " → " + found.left,
                    at_right = calibrated.right + " → " + found.right;
  if (left && right && calibrated.left == found.right && calibrated.right == found.left)
    return Error{Errc::NotCalibrated,
                 "the left and the right camera have changed places: swap their plugs, or calibrate again"}
        .at(at_left + "; " + at_right);
  if (left && right)
    return Error{Errc::NotCalibrated,
                 "neither camera is the one that was calibrated: put those back, or calibrate again"}
        .at(at_left + "; " + at_right);
  if (left)
    return Error{Errc::NotCalibrated,
                 "the left camera is not the one that was calibrated: put that one back, or calibrate again"}
        .at(at_left);
  return Error{Errc::NotCalibrated,
               "the right camera is not the one that was calibrated: put that one back, or calibrate again"}
      .at(at_right);
}

}  // namespace relievo::firmware
