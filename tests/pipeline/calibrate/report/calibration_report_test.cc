// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/report/calibration_report.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include <gtest/gtest.h>

#include "tests/pipeline/calibrate/report/reported_set.h"
#include "tests/support/html_reader.h"
#include "tests/support/lying_sensor.h"

namespace relievo::tests {
namespace {

using pipeline::CalibrationVerdict;

bool holds(const std::string& text, std::string_view words) { return text.find(words) != std::string::npos; }

int count(const std::string& text, std::string_view words) {
  int found = 0;
  for (auto at = text.find(words); at != std::string::npos; at = text.find(words, at + words.size())) ++found;
  return found;
}

// The numbers of a path, letters aside: x and y in turn.
std::vector<double> numbers(const std::string& path) {
  std::string plain = path;
  std::replace_if(
      plain.begin(), plain.end(), [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; },
      ' ');
  std::istringstream in(plain);
  std::vector<double> all;
  for (double value = 0; in >> value;) all.push_back(value);
  return all;
}

TEST(CalibrationReport, IsWellFormedAndNeedsNothingElse) {
  ReportedSet set;
  const std::string html = pipeline::calibration_report_html(set.report());
  const HtmlReader page(html);
  EXPECT_EQ(page.error(), "");
  EXPECT_FALSE(holds(html, "http")) << "no network";
  EXPECT_FALSE(holds(html, "url("));
  EXPECT_FALSE(holds(html, "@import"));
  for (const HtmlElement& element : page.elements()) {
    for (const char* name : {"script", "link", "iframe", "object", "img"}) EXPECT_NE(element.name, name);
    for (const auto& [name, value] : element.attributes) {
      EXPECT_FALSE(name.starts_with("on")) << name;
      EXPECT_NE(name, "style");
    }
  }
  EXPECT_FALSE(holds(page.text(), "nan"));
  EXPECT_FALSE(holds(page.text(), "inf"));
}

TEST(CalibrationReport, EscapesNamesOfFiles) {
  ReportedSet set;
  pipeline::CalibrationReport report = set.report();
  report.pictures.resize(15);
  report.pictures[12].corners_file = "corners_" + std::string(kWickedName) + ".png";
  const std::string html = pipeline::calibration_report_html(report);
  const HtmlReader page(html);
  EXPECT_EQ(page.error(), "");
  EXPECT_FALSE(holds(html, "<script"));
  EXPECT_TRUE(holds(page.text(), kWickedName)) << "it is still called what it is called";
  EXPECT_TRUE(holds(page.text(), "caf\xEF\xBF\xBD"));
  EXPECT_TRUE(holds(page.text(), "boards <i>of</i> March"));
  const auto link = std::find_if(page.elements().begin(), page.elements().end(), [](const HtmlElement& e) {
    return e.name == "a" && !e.attributes.at("href").starts_with("#");
  });
  ASSERT_NE(link, page.elements().end());
  EXPECT_EQ(link->attributes.at("href"), "corners_%3Cscript%3Ealert%28%22%261%27%22%29%3C%2Fscript%3E.png");
}

TEST(CalibrationReport, SaysTheVerdictInWordAndShape) {
  ReportedSet set;
  std::vector<std::string> icons;
  for (const auto& [verdict, word] : {std::pair{CalibrationVerdict::Pass, "Pass"},
                                      {CalibrationVerdict::Usable, "Usable"},
                                      {CalibrationVerdict::Refuse, "Refuse"}}) {
    set.output.quality.verdict = verdict;
    set.output.quality.reasons = {"view " + std::string(kWickedName) + " is at fault"};
    const std::string html = pipeline::calibration_report_html(set.report());
    const HtmlReader page(html);
    EXPECT_EQ(page.error(), "");
    EXPECT_TRUE(holds(page.text(), word));
    EXPECT_TRUE(holds(page.text(), "View " + std::string(kWickedName) + " is at fault.")) << "as a sentence";
    const auto begin = html.find("viewBox=\"0 0 48 48\"");
    icons.push_back(html.substr(begin, html.find("</svg>", begin) - begin));
  }
  EXPECT_NE(icons[0], icons[1]);
  EXPECT_NE(icons[1], icons[2]);
  EXPECT_NE(icons[0], icons[2]);
}

TEST(CalibrationReport, TellsOfEveryView) {
  ReportedSet set;
  const auto& q = set.output.quality;
  const HtmlReader page(pipeline::calibration_report_html(set.report()));
  EXPECT_EQ(page.with_class("out").size(), q.views.size() - static_cast<std::size_t>(q.used));
  EXPECT_GE(page.with_class("out").size(), 2U);
  for (const auto& view : q.views) {
    if (view.used) continue;
    std::string reason = view.reason;
    reason.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(reason.front())));
    EXPECT_TRUE(holds(page.text(), reason)) << reason;
  }
  const std::string verdict = page.text().substr(0, page.text().find("How wrong it may be"));
  for (const auto& view : q.views)
    if (!view.used) {
      EXPECT_TRUE(holds(verdict, view.name)) << "named where the verdict is";
    }
  EXPECT_TRUE(holds(page.text(), "1 stray corner dropped."));
  EXPECT_EQ(page.with_class("found").size(), 2 * q.views.size() - 1) << "corners in every picture but one";
}

TEST(CalibrationReport, SaysInMillimetresHowWrongAFaceMayBe) {
  ReportedSet set;
  auto& q = set.output.quality;
  q.face_depth_sigma_mm = 0.5;
  q.uncertainty.scale_percent = 0.2;
  q.measured_depth_mm = 0.37;
  const HtmlReader page(pipeline::calibration_report_html(set.report()));
  const std::string& text = page.text();
  const auto begin = text.find("How wrong it may be at a face, 560 mm away");
  ASSERT_NE(begin, std::string::npos);
  EXPECT_LT(begin, text.find("The figures that matter"));
  const std::string face = text.substr(begin, text.find("The figures that matter") - begin);
  EXPECT_TRUE(holds(face, "±0.98 mm")) << "1.96 sigma: " << face;
  EXPECT_TRUE(holds(face, "±0.59 mm")) << "0.2 % of 150 mm: " << face;
  EXPECT_TRUE(holds(face, "0.37 mm")) << face;
}

TEST(CalibrationReport, JudgesEachFigureByWhatIsGood) {
  ReportedSet set;
  auto& q = set.output.quality;
  const auto marks = [&](const char* which) {
    return HtmlReader(pipeline::calibration_report_html(set.report())).with_class(which).size();
  };
  const std::size_t bad = marks("bad");
  const std::size_t fair = marks("fair");
  q.held_out_epipolar_px = 0.3;
  EXPECT_EQ(marks("fair"), fair + 1);
  q.held_out_epipolar_px = 0.9;
  EXPECT_EQ(marks("bad"), bad + 1);
  q.tilt_spread_deg = 3;
  EXPECT_EQ(marks("bad"), bad + 2);
  q.expected_baseline_mm = 1.02 * q.baseline_mm;
  EXPECT_EQ(marks("bad"), bad + 3);
  q.expected_baseline_mm = 1.005 * q.baseline_mm;
  EXPECT_EQ(marks("bad"), bad + 2);
  q.measured_depth_mm = 6;
  EXPECT_EQ(marks("bad"), bad + 3);
  q.face_depth_sigma_mm = std::nan("");
  EXPECT_EQ(marks("bad"), bad + 4) << "what is no number is not good";
}

TEST(CalibrationReport, DrawsEveryResidualAsItIs) {
  ReportedSet set;
  const HtmlReader page(pipeline::calibration_report_html(set.report()));
  const std::string& text = page.text();
  const auto times = text.find(" times as long as it is");
  ASSERT_NE(times, std::string::npos);
  const double magnified = std::atof(text.substr(text.rfind(' ', times - 1) + 1).c_str());
  EXPECT_GT(magnified, 1);
  const auto arrows = page.with_class("arrows");
  ASSERT_EQ(arrows.size(), 4U) << "two cameras, and a key for each";
  const double scale = 480.0 / 1024;
  std::vector<double> drawn = numbers(arrows[0].attributes.at("d"));
  constexpr std::size_t kNumbers = 10;  // of an arrow: base, tip, one barb, tip, other barb
  std::size_t next = 0;
  for (std::size_t v = 0; v < set.output.views.size(); ++v) {
    if (!set.output.quality.views[v].used) continue;
    for (const auto& corner : set.output.views[v].left) {
      if (!pipeline::seen(corner.at)) continue;
      ASSERT_LE(next + kNumbers, drawn.size());
      EXPECT_NEAR(drawn[next], (corner.at.x + 0.5) * scale, 0.051);
      EXPECT_NEAR(drawn[next + 1], (corner.at.y + 0.5) * scale, 0.051);
      EXPECT_NEAR(drawn[next + 2] - drawn[next], corner.off.x * scale * magnified, 0.11);
      EXPECT_NEAR(drawn[next + 3] - drawn[next + 1], corner.off.y * scale * magnified, 0.11);
      next += kNumbers;
    }
  }
  EXPECT_EQ(next, drawn.size());
}

TEST(CalibrationReport, DrawsTheRigToScale) {
  ReportedSet set;
  const HtmlReader page(pipeline::calibration_report_html(set.report()));
  const auto at = [](const HtmlElement& line, const char* name) {
    return std::atof(line.attributes.at(name).c_str());
  };
  const auto measures = page.with_class("measure");
  const auto rulers = page.with_class("ruler");
  ASSERT_EQ(measures.size(), 1U);
  ASSERT_EQ(rulers.size(), 3U);
  const double ruler = at(rulers[0], "x2") - at(rulers[0], "x1");
  const double drawn = std::hypot(at(measures[0], "x2") - at(measures[0], "x1"),
                                  at(measures[0], "y2") - at(measures[0], "y1"));
  const pipeline::Vec3d right = inverse(set.output.calibration.right_from_left).translation_mm;
  EXPECT_NEAR(100 * drawn / ruler, std::hypot(right.x, right.z), 0.1);
  EXPECT_EQ(page.with_class("board").size(), 15U);
}

// Cameras on their sides stand one above the other by their own axes: across is then along those.
TEST(CalibrationReport, DrawsARigOfLyingSensorsFromAboveToo) {
  for (const test::Side side : {test::Side::Clockwise, test::Side::Counterclockwise}) {
    ReportedSet set;
    set.output.calibration = test::laid(set.output.calibration, side);
    const HtmlReader page(pipeline::calibration_report_html(set.report()));
    const auto measure = page.with_class("measure").at(0).attributes,
               ruler = page.with_class("ruler").at(0).attributes;
    const auto over = [](const auto& line, const char* from, const char* to) {
      return std::atof(line.at(to).c_str()) - std::atof(line.at(from).c_str());
    };
    const pipeline::Vec3d right = inverse(set.output.calibration.right_from_left).translation_mm;
    EXPECT_NEAR(100 * over(measure, "x1", "x2") / over(ruler, "x1", "x2"), std::hypot(right.y, right.z), 0.1);
    EXPECT_NEAR(over(measure, "y1", "y2"), 0, 0.11);
    const std::vector<double> faces = numbers(page.with_class("volume").at(0).attributes.at("d"));
    ASSERT_GE(faces.size(), 8U);
    for (std::size_t i = 0; i + 1 < faces.size(); i += 2) {
      EXPECT_TRUE(faces[i] > 0 && faces[i] < 480) << faces[i];
      EXPECT_TRUE(faces[i + 1] > 0 && faces[i + 1] < 462) << faces[i + 1];
    }
  }
}

TEST(CalibrationReport, DrawsUncertaintyInProportion) {
  ReportedSet set;
  auto& depth = set.output.quality.uncertainty.depth;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    depth[i].sigma_mm = 0.1 + 0.1 * static_cast<double>(i);
    depth[i].worst_sigma_mm = 2 * depth[i].sigma_mm;
  }
  const HtmlReader page(pipeline::calibration_report_html(set.report()));
  const auto series = page.with_class("series");
  ASSERT_GE(series.size(), 2U);
  const std::vector<double> worst = numbers(series[0].attributes.at("d"));
  const std::vector<double> rms = numbers(series[1].attributes.at("d"));
  ASSERT_EQ(worst.size(), 16U);
  ASSERT_EQ(rms.size(), 16U);
  const double floor = 2 * rms[1] - worst[1];  // worst is twice rms: nought lies as far below
  for (std::size_t i = 1; i < 8; ++i) {
    EXPECT_NEAR(floor - rms[2 * i + 1], (floor - rms[1]) * (1.0 + static_cast<double>(i)), 0.5)
        << "nought is on the axis";
    EXPECT_NEAR(rms[2 * i] - rms[2 * i - 2], rms[2] - rms[0], 0.11) << "steps of 50 mm";
  }
}

TEST(CalibrationReport, StaysReadableForVeryManyCorners) {
  ReportedSet set;
  const auto corners = [](const std::string& html) {
    int all = 0;
    for (const HtmlElement& dots : HtmlReader(html).with_class("dots"))
      all += count(dots.attributes.at("d"), "M");
    return all;
  };
  const std::string few = pipeline::calibration_report_html(set.report());
  // The same views forty times over.
  pipeline::CalibratorInput& input = set.boards.input();
  const auto views = input.views;
  const auto judged = set.output.quality.views;
  const auto fitted = set.output.views;
  for (int i = 1; i < 40; ++i) {
    input.views.insert(input.views.end(), views.begin(), views.end());
    set.output.quality.views.insert(set.output.quality.views.end(), judged.begin(), judged.end());
    set.output.views.insert(set.output.views.end(), fitted.begin(), fitted.end());
  }
  const std::string many = pipeline::calibration_report_html(set.report());
  EXPECT_EQ(HtmlReader(many).error(), "");
  EXPECT_TRUE(holds(many, "One corner in 2 is drawn."));
  EXPECT_FALSE(holds(few, "is drawn."));
  EXPECT_NEAR(corners(many), 20 * corners(few), 0.03 * 20 * corners(few));
}

TEST(CalibrationReport, HoldsThePicturesItIsGiven) {
  ReportedSet set;
  pipeline::CalibrationReport report = set.report();
  report.pictures.resize(15);
  report.pictures[0].left_jpeg = {std::byte{'f'}, std::byte{'o'}, std::byte{'o'}};
  const HtmlReader page(pipeline::calibration_report_html(report));
  EXPECT_EQ(page.error(), "");
  std::vector<std::string> images;
  for (const HtmlElement& element : page.elements())
    if (element.name == "image") images.push_back(element.attributes.at("href"));
  EXPECT_EQ(images, std::vector<std::string>{"data:image/jpeg;base64,Zm9v"});
}

}  // namespace
}  // namespace relievo::tests
