// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/kiosk/moved_faces.h"

#include <sstream>
#include <string>

namespace relievo::firmware {
namespace {

constexpr const char* kMovedFacesSetting = "moved_faces";

}  // namespace

Result<MovedFaces::Said> MovedFaces::read(std::uint32_t revision) {
  revision_ = revision;
  kept_ = {};
  const Result<std::string> kept = store_.setting(kMovedFacesSetting);
  if (!kept && kept.error().code != Errc::NotFound) return kept.error();
  if (!kept) return kept_;
  std::istringstream in(*kept);
  int faces = 0;
  std::uint32_t of = 0;
  // Whatever else stands there was not written by this program: then the next faces say it again.
  if (!(in >> faces >> of) || of != revision || faces < 0) return kept_;
  kept_.faces = faces;
  if (in.get() == ' ') std::getline(in, kept_.note);
  return kept_;
}

void MovedFaces::keep(std::uint32_t revision, const Said& said, SideTasks& side_tasks, EventLog& log) {
  if (revision == revision_ && said == kept_) return;
  const bool news = said != kept_;  // another calibration of which nothing is said needs no line
  revision_ = revision;
  kept_ = said;
  if (!news && said == Said{}) return;
  side_tasks.send(
      JobLane::Keeper,
      [this, text = std::to_string(said.faces) + " " + std::to_string(revision) + " " +
                    said.note](JobControl&) { return store_.set_setting(kMovedFacesSetting, text); },
      [&log](const std::optional<Error>& error) {
        if (error) log.fault(*error);
      },
      SideTasks::Whose::Device);
}

}  // namespace relievo::firmware
