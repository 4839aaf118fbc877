// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/kiosk/moved_faces.h"

#include <sstream>
#include <string>

namespace relievo::firmware {
namespace {

constexpr const char* kMovedFacesSetting = "moved_faces";

}  // namespace

Result<int> MovedFaces::read(std::uint32_t revision) {
  revision_ = revision;
  faces_ = 0;
  const Result<std::string> kept = store_.setting(kMovedFacesSetting);
  if (!kept && kept.error().code != Errc::NotFound) return kept.error();
  if (!kept) return 0;
  std::istringstream in(*kept);
  int faces = 0;
  std::uint32_t of = 0;
  // Whatever else stands there was not written by this program: then the next faces say it again.
  if (in >> faces >> of && of == revision && faces > 0) faces_ = faces;
  return faces_;
}

void MovedFaces::keep(std::uint32_t revision, int faces, Errands& errands, EventLog& log) {
  if (revision == revision_ && faces == faces_) return;
  const bool news = faces != 0 || faces_ != 0;
  revision_ = revision;
  faces_ = faces;
  if (!news) return;
  errands.send(
      JobPlace::Keeper, [this, text = std::to_string(faces) + " " + std::to_string(revision)](JobControl&) { return store_.set_setting(kMovedFacesSetting, text); },
      [&log](const std::optional<Error>& error) {
        if (error) log.fault(*error);
      },
      Errands::Whose::Device);
}

}  // namespace relievo::firmware
