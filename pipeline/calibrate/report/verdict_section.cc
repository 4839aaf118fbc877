// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/report/sections.h"
#include "pipeline/report/text.h"

namespace relievo::pipeline::report {
namespace {

struct Words {
  std::string_view style;
  std::string_view word;
  std::string_view means;
  std::string_view icon;  // told apart by outline, too: disc, triangle, octagon
};

Words words_of(CalibrationVerdict verdict) {
  switch (verdict) {
    case CalibrationVerdict::Pass:
      return {"pass", "Pass", "Fit for measuring faces.",
              "<circle cx=\"24\" cy=\"24\" r=\"21\"/><path d=\"M14 25l7 7 14-16\"/>"};
    case CalibrationVerdict::Usable:
      return {"usable", "Usable", "It measures, less well than it could.",
              "<path class=\"body\" d=\"M24 4L46 43H2Z\"/><path d=\"M24 17v13M24 36.5v.5\"/>"};
    case CalibrationVerdict::Refuse:
      break;
  }
  return {"refuse", "Refuse", "Not to be measured with.",
          "<path class=\"body\" d=\"M15 3h18l12 12v18L33 45H15L3 33V15Z\"/><path d=\"M16 16l16 16M32 16L16 "
          "32\"/>"};
}

// Empty where all were used.
std::string left_out(const CalibrationQuality& q) {
  constexpr int kMostNames = 30;
  std::string names;
  int count = 0;
  for (const ViewQuality& view : q.views) {
    if (view.used) continue;
    if (++count <= kMostNames) names += (names.empty() ? "<bdi>" : ", <bdi>") + escaped(view.name) + "</bdi>";
  }
  if (count == 0) return {};
  if (count > kMostNames) names += " and " + std::to_string(count - kMostNames) + " more";
  return "<p class=\"omitted\"><b>Left out:</b> " + counted(count, "pair", "pairs") + ": " + names +
         ". Why, and by which rule, is told under <a href=\"#views\">The views</a>.</p>\n";
}

}  // namespace

std::string verdict_section(const CalibrationReport& r) {
  const CalibrationQuality& q = r.output.quality;
  const Words words = words_of(q.verdict);
  std::string out = "<section class=\"verdict " + std::string(words.style) + "\">\n<div class=\"stamp\">";
  out += "<svg viewBox=\"0 0 48 48\" aria-hidden=\"true\">" + std::string(words.icon) + "</svg>";
  out += "<div><h2>" + std::string(words.word) + "</h2><p>" + std::string(words.means) +
         "</p></div></div>\n<ul>\n";
  for (const std::string& reason : q.reasons) out += "<li>" + escaped(sentence(reason)) + "</li>\n";
  return out + "</ul>\n" + left_out(q) + "</section>\n";
}

}  // namespace relievo::pipeline::report
