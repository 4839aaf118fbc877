// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the algorithms say of their options, in every language: every sentence of the catalogue of algorithms,
// and why values are refused; what the machine beneath cannot do, files and pictures, and where it was.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "firmware/capture/rig_cameras.h"
#include "hal/sim/optics/rig.h"
#include "pipeline/algorithms.h"
#include "pipeline/pipeline.h"
#include "pipeline/relief/relief_check.h"
#include "tests/support/rig_calibration.h"
#include "tests/support/stage_bench.h"
#include "ui/language/language.h"
#include "ui/screens/service/place_words.h"

namespace relievo::firmware {
namespace {

// A byte that begins a letter of a script.
bool has_lead(const std::string& text, unsigned first, unsigned last) {
  return std::any_of(text.begin(), text.end(), [=](char c) {
    return static_cast<unsigned char>(c) >= first && static_cast<unsigned char>(c) <= last;
  });
}

bool is_arabic(const std::string& text) { return has_lead(text, 0xD8, 0xDB); }
bool is_hebrew(const std::string& text) { return has_lead(text, 0xD7, 0xD7); }
bool is_east_asian(const std::string& text) { return has_lead(text, 0xE4, 0xE9); }  // Chinese letters

TEST(OptionWords, EverySentenceIsInEveryLanguage) {
  ASSERT_TRUE(ui::prepare_languages().has_value());
  std::set<std::string> sentences;
  for (const pipeline::OptionDescription& option : pipeline::describe_algorithms())
    sentences.insert(option.sentence);
  ASSERT_GT(sentences.size(), 100U);
  for (std::size_t i = 0; i < ui::kLanguages; ++i) {
    const auto language = static_cast<ui::Language>(i);
    if (language == ui::Language::English) continue;
    const ui::Words words(language);
    std::set<std::string> said;
    for (const std::string& sentence : sentences) {
      EXPECT_TRUE(words.knows(sentence.c_str())) << ui::info_of(language).code << ".po lacks: " << sentence;
      if (!words.knows(sentence.c_str())) continue;
      const std::string other = words(sentence.c_str());
      EXPECT_TRUE(said.insert(other).second) << "two sentences became one: " << other;
      EXPECT_EQ(is_arabic(other), language == ui::Language::Arabic) << other;
      EXPECT_EQ(is_hebrew(other), language == ui::Language::Hebrew) << other;
      EXPECT_EQ(is_east_asian(other), language == ui::Language::Chinese || language == ui::Language::Japanese)
          << other;
      // Figures and the words of files are the same everywhere.
      for (const char* kept : {"MODE_HH", "QUALITY:DISTANCE_PX", "2^scales", "195"}) {
        EXPECT_EQ(sentence.find(kept) == std::string::npos, other.find(kept) == std::string::npos) << other;
      }
    }
  }
}

void every_language_knows(const std::set<std::string>& texts) {
  for (std::size_t i = 0; i < ui::kLanguages; ++i) {
    const auto language = static_cast<ui::Language>(i);
    for (const std::string& text : texts)
      EXPECT_TRUE(language == ui::Language::English || ui::Words(language).knows(text.c_str()))
          << ui::info_of(language).code << ".po lacks: " << text;
  }
}

std::string section_of(const std::string& option) { return option.substr(0, option.find('.')); }

// The set with the algorithm chosen whose option it is.
pipeline::AlgorithmSet set_for(const std::vector<pipeline::OptionDescription>& all,
                               const std::string& section) {
  pipeline::AlgorithmSet set;
  for (const auto& kind : all) {
    const bool there = std::find(kind.names.begin(), kind.names.end(), section) != kind.names.end();
    EXPECT_TRUE(!there || set.set(kind.key, section));
  }
  return set;
}

std::vector<std::string> values_of(const pipeline::OptionDescription& option) {
  if (option.text) return {"?"};
  const double least = option.least, most = option.most;
  std::vector<std::string> values;
  for (const double value : {least, most, (least + most) / 2, least + 1, most - 1,
                             std::floor(std::sqrt(std::max(0.0, least * most)))})
    values.push_back(std::to_string(value));
  return values;
}

void note(const Error& error, std::set<std::string>& refusals) {
  if (error.code == Errc::InvalidInput) refusals.insert(std::string(error.what.view()));
}

void ask(const pipeline::AlgorithmSet& set, std::set<std::string>& refusals) {
  const auto judge = [&](const auto& made) {
    if (!made) note(made.error(), refusals);
  };
  judge(pipeline::make_preprocessor(set));
  judge(pipeline::make_selector(set));
  judge(pipeline::make_matcher(set));
  judge(pipeline::make_constraints(set));
  judge(pipeline::make_triangulator(set));
  judge(pipeline::make_outlier_filter(set));
  judge(pipeline::make_face_crop(set));
  judge(pipeline::make_mesher(set));
  judge(pipeline::make_completion(set));
  judge(pipeline::make_relief_check(set));
  judge(pipeline::make_texturer(set));
}

// Each value is possible by itself, and yet an algorithm may refuse it, or two of them beside each other:
// then a page says why.
TEST(OptionWords, WhatIsRefusedBesideTheOthersIsSaidInEveryLanguage) {
  ASSERT_TRUE(ui::prepare_languages().has_value());
  const auto all = pipeline::describe_algorithms();
  std::set<std::string> refusals;
  for (const auto& one : all) {
    if (!one.names.empty()) continue;
    pipeline::AlgorithmSet chosen = set_for(all, section_of(one.key));
    for (const std::string& value : values_of(one)) {
      pipeline::AlgorithmSet set = chosen;
      if (set.set(one.key, value)) ask(set, refusals);
    }
    if (one.text || !chosen.set(one.key, std::to_string(one.least))) continue;
    for (const auto& other : all) {
      pipeline::AlgorithmSet set = chosen;
      const bool beside = other.names.empty() && !other.text && other.key != one.key &&
                          section_of(other.key) == section_of(one.key);
      if (beside && set.set(other.key, std::to_string(other.most))) ask(set, refusals);
    }
  }
  pipeline::AlgorithmSet scattered;
  ASSERT_TRUE(scattered.set("selector", "harris"));
  const auto made = pipeline::Pipeline::make(scattered, test::true_calibration(hal::sim::make_rig({})));
  ASSERT_FALSE(made);
  note(made.error(), refusals);
  EXPECT_GE(refusals.size(), 10U);
  every_language_knows(refusals);
}

// Every fault a file of the source can tell of, literals that stand on end joined; not those of the codes
// left out.
void collect_faults(const std::filesystem::path& file, std::set<std::string>& faults,
                    const std::set<std::string>& left_out = {}) {
  static const std::regex fault(R"rx(Errc::(\w+),\s*((?:"[^"]*"\s*)+))rx"), one(R"rx("([^"]*)")rx");
  std::ifstream in(file);
  const std::string source{std::istreambuf_iterator<char>(in), {}};
  for (std::sregex_iterator at(source.begin(), source.end(), fault), end; at != end; ++at) {
    const std::string run = (*at)[2];
    std::string text;
    for (std::sregex_iterator part(run.begin(), run.end(), one); part != end; ++part) text += (*part)[1];
    if (left_out.count((*at)[1]) == 0) faults.insert(text);
  }
}

// What the machine's drivers cannot do stands on the technician's pages, however rare: cameras, their
// pictures, the trigger's wire, the watchdog, the stick, the words of a rig.
TEST(OptionWords, EveryFaultOfTheMachineIsInEveryLanguage) {
  ASSERT_TRUE(ui::prepare_languages().has_value());
  const std::filesystem::path hal = std::filesystem::path(RELIEVO_SOURCE_DIR) / "hal";
  std::set<std::string> faults;
  collect_faults(hal / "trigger_line.h", faults);
  for (const char* room : {"linux", "raw"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(hal / room))
      if (entry.path().extension() == ".cc" || entry.path().extension() == ".h")
        collect_faults(entry.path(), faults);
  ASSERT_GE(faults.size(), 90U);
  every_language_knows(faults);
}

// Files and pictures: what an export, a recording, a stick or the store cannot do is noted in the log. Left
// out is what ends a command or a start before there is a screen, and what the store refuses of a programmer.
TEST(OptionWords, EveryFaultOfAFileOrAPictureIsInEveryLanguage) {
  ASSERT_TRUE(ui::prepare_languages().has_value());
  const std::filesystem::path source = RELIEVO_SOURCE_DIR;
  std::set<std::string> faults;
  for (const char* file :
       {"hal/opencv_picture_file.cc", "hal/picture_header.cc", "hal/whole_file.cc", "hal/removable_media.cc",
        "hal/recording/recording.cc", "hal/sim/replay/replay_camera.cc", "hal/sim/replay/silent_trigger.cc",
        "hal/sim/replay/folder_media.cc", "storage/model_blob.cc", "storage/calibration_record.cc",
        "firmware/base/output_folder.cc", "firmware/service/stick_folder.cc",
        "firmware/service/export_records.cc"})
    collect_faults(source / file, faults);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source / "storage" / "export"))
    if (entry.path().extension() == ".cc") collect_faults(entry.path(), faults);
  for (const auto& entry : std::filesystem::directory_iterator(source / "storage" / "sqlite")) {
    const std::string name = entry.path().filename().string();
    const bool of_a_start =
        name == "sqlite_migration.cc" || name == "store_directory.cc" || name == "sqlite_store.cc";
    if (entry.path().extension() == ".cc" && !of_a_start)
      collect_faults(entry.path(), faults, {"InvalidInput", "InvalidState"});
  }
  faults.erase("this setting is not set");  // asked for by a key, and then the usual holds
  EXPECT_GE(faults.size(), 60U);
  every_language_knows(faults);
}

// Where it was stands in parentheses behind the sentence: figures and names, and no English between them.
TEST(OptionWords, WhereItWasIsSaidInEveryLanguage) {
  ASSERT_TRUE(ui::prepare_languages().has_value());
  const pipeline::RigCameras calibrated{"serial 4061", "at /dev/v4l/by-path/b"};
  std::vector<std::string> places;
  for (const pipeline::RigCameras& found : {pipeline::RigCameras{"serial 4088", calibrated.right},
                                            pipeline::RigCameras{calibrated.left, "at /dev/v4l/by-path/c"},
                                            pipeline::RigCameras{"serial 4088", "serial 4090"},
                                            pipeline::RigCameras{calibrated.right, calibrated.left}}) {
    const auto checked = check_cameras(calibrated, found);
    ASSERT_FALSE(checked);
    places.emplace_back(checked.error().where());
  }
  places.emplace_back(pipeline::error_of(pipeline::ReliefVerdict::Picture,
                                         pipeline::ReliefFigures{1, 0.1, 0.2, 0.2, 0.5, 0.4},
                                         pipeline::ReliefOptions{})
                          .where());
  test::StageBench bench;
  const auto calibration = test::true_calibration(hal::sim::make_rig({}));
  const auto pipeline = pipeline::Pipeline::make({}, calibration);
  ASSERT_TRUE(pipeline);
  const auto empty = pipeline->rectify({}, bench.context);
  ASSERT_FALSE(empty);
  places.emplace_back(empty.error().where());
  ui::Tree tree;
  ui::ViewState view;
  ui::Visit visit;
  ui::ServiceView staff;
  view.service = &staff;
  static const std::regex kept(R"rx(serial|at|sr|mm|/dev/[a-z0-9/-]+)rx"), word("[A-Za-z]{2,}");
  for (std::size_t i = 0; i < ui::kLanguages; ++i) {
    visit.language = static_cast<ui::Language>(i);
    tree.begin(ui::info_of(visit.language).right_to_left);
    ui::StaffFrame page{tree, view, visit, {}, ui::kLight, ui::Rect{0, 0, 1280, 800}};
    for (const std::string& place : places) {
      const std::string said(ui::said_place(page, place));
      EXPECT_EQ(said.find("→"), std::string::npos) << said;
      if (visit.language == ui::Language::English) continue;
      EXPECT_NE(said, place) << ui::info_of(visit.language).code;
      const bool latin = !is_arabic(said) && !is_hebrew(said) && !is_east_asian(said);
      const std::string rest = std::regex_replace(said, kept, "");
      EXPECT_TRUE(latin || !std::regex_search(rest, word)) << said;
    }
  }
}

}  // namespace
}  // namespace relievo::firmware
