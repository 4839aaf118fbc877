// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/arguments/command_line.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace relievo::firmware {
namespace {

CommandLine parse(std::vector<const char*> words) {
  words.insert(words.begin(), "relievo");
  return parse_command_line(static_cast<int>(words.size()), words.data());
}

TEST(CommandLine, Reconstruct) {
  const auto line =
      parse({"reconstruct", "l.png", "--set", "matcher=zmncc", "r.png", "--set", "zmncc.window_px=15",
             "--calibration", "rig.yml", "-o", "out", "--frame", "camera", "--region", "all"});
  const auto& args = std::get<ReconstructArgs>(line.command);
  EXPECT_EQ(args.pictures, (std::vector<Path>{"l.png", "r.png"}));
  EXPECT_EQ(args.calibrations, std::vector<Path>{"rig.yml"});
  EXPECT_EQ(args.output, "out");
  EXPECT_TRUE(args.camera_frame);
  EXPECT_TRUE(args.algorithms.whole_view);
  EXPECT_EQ(args.algorithms.settings, (std::vector<std::string>{"matcher=zmncc", "zmncc.window_px=15"}));
}

TEST(CommandLine, AHeadThatTurned) {
  const auto good =
      parse({"reconstruct", "l0", "r0", "l1", "r1", "--calibration", "a.yml", "b.yml", "-o", "out"});
  const auto& args = std::get<ReconstructArgs>(good.command);
  EXPECT_EQ(args.pictures, (std::vector<Path>{"l0", "r0", "l1", "r1"}));
  EXPECT_EQ(args.calibrations, (std::vector<Path>{"a.yml", "b.yml"}));
  const auto before = parse({"reconstruct", "--calibration", "a.yml", "l0", "r0", "-o", "out"});
  EXPECT_EQ(std::get<ReconstructArgs>(before.command).pictures, (std::vector<Path>{"l0", "r0"}));
  EXPECT_EQ(std::get<ReconstructArgs>(before.command).calibrations, std::vector<Path>{"a.yml"});
  const std::vector<std::vector<const char*>> wrong{
      {"reconstruct", "--calibration", "a.yml", "-o", "out"},
      {"reconstruct", "l0", "r0", "l1", "--calibration", "a.yml", "-o", "out"},
      {"reconstruct", "l0", "r0", "l1", "r1", "l2", "r2", "--calibration", "a.yml", "b.yml", "-o", "out"},
      {"reconstruct", "l0", "r0", "l1", "r1", "--calibration", "a.yml", "-o", "out", "--by-hand", "f"},
      {"reconstruct", "1",  "2",  "3",  "4",  "5",  "6",  "7",  "8",
       "9",           "10", "11", "12", "13", "14", "15", "16", "--calibration",
       "a.yml",       "-o", "out"}};
  for (const auto& words : wrong) EXPECT_EQ(parse(words).exit_code, 2) << words.size();
}

// What the file system refuses to look at is a wrong word, too.
TEST(CommandLine, APictureThatCannotBeAFolderIsNone) {
  const std::string longer_than_any_name(300, 'x');
  testing::internal::CaptureStderr();
  const auto line =
      parse({"reconstruct", longer_than_any_name.c_str(), "--calibration", "rig.yml", "-o", "out"});
  EXPECT_NE(testing::internal::GetCapturedStderr().find("a left one and a right one each"),
            std::string::npos);
  EXPECT_EQ(line.exit_code, 2);
}

TEST(CommandLine, TheMemoryOfAStoreWhoseKeyLiesElsewhere) {
  const auto line = parse({"memory", "--store", "s", "--key", "k"});
  ASSERT_TRUE(std::holds_alternative<MemoryArgs>(line.command));
  EXPECT_EQ(std::get<MemoryArgs>(line.command).store, "s");
  EXPECT_EQ(line.key, "k");
  EXPECT_TRUE(std::get<MemoryArgs>(parse({"memory"}).command).store.empty()) << "the plan alone";
}

TEST(CommandLine, ALimitThatIsNoNumberIsRefused) {
  for (const char* option : {"--bad-px", "--truth-scale"}) {
    EXPECT_EQ(parse({"compare", "l", "r", "--rectified", "-o", "out", option, "2"}).exit_code, 0);
    for (const char* value : {"nan", "inf", "0"}) {
      testing::internal::CaptureStderr();
      EXPECT_EQ(parse({"compare", "l", "r", "--rectified", "-o", "out", option, value}).exit_code, 2)
          << option << ' ' << value;
      (void)testing::internal::GetCapturedStderr();
    }
  }
}

TEST(CommandLine, ALighterModelBesideIt) {
  const auto reconstruct = parse({"reconstruct", "l.png", "r.png", "--calibration", "rig.yml", "-o", "out",
                                  "--lod", "40000", "--watertight"});
  EXPECT_EQ(std::get<ReconstructArgs>(reconstruct.command).further.lod, 40'000);
  EXPECT_TRUE(std::get<ReconstructArgs>(reconstruct.command).further.watertight);
  const auto exported = parse({"subjects", "export", "Ada", "-o", "out", "--lod", "20000"});
  EXPECT_EQ(std::get<SubjectsArgs>(exported.command).further.lod, 20'000);
}

TEST(CommandLine, Calibrate) {
  const auto line = parse({"calibrate", "dir", "--corners", "10x7", "--square-mm", "20", "-o", "rig.yml"});
  const auto& args = std::get<CalibrateArgs>(line.command);
  EXPECT_EQ(args.board.corners_across, 10);
  EXPECT_EQ(args.board.corners_down, 7);
  EXPECT_EQ(args.board.square_mm, 20);
  EXPECT_FALSE(args.baseline_mm) << "0 would say: let it come out as it will";
}

TEST(CommandLine, CalibrateWithAKnownBaseline) {
  for (const auto& [word, mm] : {std::pair{"137.2", 137.2}, {"0", 0.0}}) {
    const auto line = parse({"calibrate", "dir", "--corners", "10x7", "--square-mm", "20", "-o", "rig.yml",
                             "--baseline-mm", word});
    EXPECT_EQ(std::get<CalibrateArgs>(line.command).baseline_mm, mm);
  }
}

TEST(CommandLine, VerbsOfCalibration) {
  using Verb = CalibrationArgs::Verb;
  const auto args = [](std::vector<const char*> words) {
    words.insert(words.begin(), "calibration");
    return std::get<CalibrationArgs>(parse(words).command);
  };
  EXPECT_EQ(args({"list"}).verb, Verb::List);
  EXPECT_EQ(args({"activate", "3", "--store", "s"}).revision, 3);
  const auto import = args({"import", "intrinsics.yml", "extrinsics.yml", "--image-size", "640x480",
                            "--unit-mm", "25.4", "--note", "rig 2"});
  EXPECT_EQ(import.verb, Verb::Import);
  EXPECT_EQ(import.file, "intrinsics.yml");
  EXPECT_EQ(import.other, "extrinsics.yml");
  EXPECT_EQ(import.width_px, 640);
  EXPECT_EQ(import.height_px, 480);
  EXPECT_EQ(import.unit_mm, 25.4);
  EXPECT_EQ(import.note, "rig 2");
  const auto out = args({"export", "-o", "folder", "--as", "ros", "--calibration", "rig.yml"});
  EXPECT_TRUE(out.ros);
  EXPECT_EQ(out.source, "rig.yml");
  for (const std::vector<const char*>& wrong :
       std::vector<std::vector<const char*>>{{"calibration", "activate"},
                                             {"calibration", "activate", "0"},
                                             {"calibration", "import"},
                                             {"calibration", "import", "a.yml", "--image-size", "640"},
                                             {"calibration", "import", "a.yml", "--image-size", "4x4"},
                                             {"calibration", "import", "a.yml", "--unit-mm", "nan"},
                                             {"calibration", "import", "a.yml", "--unit-mm", "0"},
                                             {"calibration", "export", "-o", "x", "--as", "xml"},
                                             {"calibration", "export", "-o", "x", "2", "--calibration", "y"}})
    EXPECT_EQ(parse(wrong).exit_code, 2) << wrong.back();
}

TEST(CommandLine, CalibrateWithCharuco) {
  const auto line = parse({"calibrate", "dir", "--pattern", "charuco", "--corners", "10x7", "--square-mm",
                           "20", "--marker-mm", "15", "--marker-bits", "5", "-o", "rig.yml"});
  const auto& args = std::get<CalibrateArgs>(line.command);
  EXPECT_TRUE(args.board.charuco);
  EXPECT_EQ(args.board.marker_mm, 15);
  EXPECT_EQ(args.board.marker_bits, 5);
}

TEST(CommandLine, PrintPattern) {
  const auto line = parse({"calibrate", "--print-pattern", "charuco", "--corners", "7x5", "--square-mm", "30",
                           "-o", "board.pdf"});
  const auto& args = std::get<PrintPatternArgs>(line.command);
  EXPECT_TRUE(args.board.charuco);
  EXPECT_EQ(args.board.corners_across, 7);
  EXPECT_EQ(args.board.corners_down, 5);
  EXPECT_EQ(args.board.square_mm, 30);
  EXPECT_EQ(args.output, "board.pdf");
}

TEST(CommandLine, SimulatedBoard) {
  const auto plain = std::get<SimulateArgs>(parse({"simulate", "board", "-o", "out"}).command);
  EXPECT_EQ(plain.printed.corners_across, 10);
  EXPECT_EQ(plain.printed.square_mm, 20);
  EXPECT_FALSE(plain.printed.charuco);
  const auto line = parse({"simulate", "board", "-o", "out", "--pattern", "charuco", "--corners", "8x6",
                           "--lamp", "0.5", "--cover", "0.3", "--blur-px", "1.5"});
  const auto& args = std::get<SimulateArgs>(line.command);
  EXPECT_TRUE(args.printed.charuco);
  EXPECT_EQ(args.printed.corners_down, 6);
  EXPECT_EQ(args.lamp, 0.5);
  EXPECT_EQ(args.cover, 0.3);
  EXPECT_EQ(args.blur_px, 1.5);
}

TEST(CommandLine, SimulatedPhotograph) {
  EXPECT_TRUE(std::get<SimulateArgs>(parse({"simulate", "face", "-o", "out"}).command).held.picture.empty());
  const auto line = parse({"simulate", "photograph", "ada.png", "-o", "out", "--radius-mm", "-80", "--axis",
                           "30", "--screen", "--yaw", "5"});
  const auto& args = std::get<SimulateArgs>(line.command);
  EXPECT_EQ(args.held.picture, "ada.png");
  EXPECT_EQ(args.held.radius_mm, -80);
  EXPECT_EQ(args.held.axis_deg, 30);
  EXPECT_TRUE(args.held.screen);
  EXPECT_EQ(args.yaw_deg, 5);
  const auto plus = parse({"simulate", "face", "-o", "out", "--yaw", "+10", "--roll", "+.5"});
  ASSERT_EQ(plus.exit_code, 0);
  EXPECT_EQ(std::get<SimulateArgs>(plus.command).yaw_deg, 10);
  EXPECT_EQ(std::get<SimulateArgs>(plus.command).roll_deg, 0.5);
  EXPECT_FALSE(args.board);
}

TEST(CommandLine, SimulatesUprightCameras) {
  EXPECT_FALSE(std::get<SimulateArgs>(parse({"simulate", "face", "-o", "out"}).command).portrait);
  EXPECT_TRUE(
      std::get<SimulateArgs>(parse({"simulate", "face", "-o", "out", "--portrait"}).command).portrait);
  EXPECT_TRUE(
      std::get<SimulateArgs>(parse({"simulate", "board", "-o", "out", "--portrait"}).command).portrait);
}

TEST(CommandLine, VerbsOfSubjects) {
  EXPECT_EQ(std::get<SubjectsArgs>(parse({"subjects", "list"}).command).verb, SubjectsArgs::Verb::List);
  const auto line = parse({"subjects", "export", "Ada", "-o", "out", "--store", "s"});
  const auto& args = std::get<SubjectsArgs>(line.command);
  EXPECT_EQ(args.verb, SubjectsArgs::Verb::Export);
  EXPECT_EQ(args.subject, "Ada");
  EXPECT_EQ(args.store, "s");
}

TEST(CommandLine, VerbsOfTheStaff) {
  const auto forget = parse({"staff", "forget-pin", "technician", "--store", "s"});
  EXPECT_EQ(std::get<StaffArgs>(forget.command).verb, StaffArgs::Verb::ForgetPin);
  EXPECT_TRUE(std::get<StaffArgs>(forget.command).technician);
  EXPECT_EQ(std::get<StaffArgs>(forget.command).store, "s");
  EXPECT_FALSE(std::get<StaffArgs>(parse({"staff", "forget-pin", "operator"}).command).technician);
  EXPECT_EQ(std::get<StaffArgs>(parse({"staff", "plain-touch"}).command).verb, StaffArgs::Verb::PlainTouch);
  const std::vector<std::vector<const char*>> wrong{
      {"staff"}, {"staff", "forget-pin"}, {"staff", "forget-pin", "visitor"}};
  for (const auto& words : wrong) EXPECT_EQ(parse(words).exit_code, 2);
}

TEST(CommandLine, HelpIsNoError) {
  testing::internal::CaptureStdout();
  const auto line = parse({"reconstruct", "--help"});
  EXPECT_NE(testing::internal::GetCapturedStdout().find("--calibration"), std::string::npos);
  EXPECT_TRUE(std::holds_alternative<NothingArgs>(line.command));
  EXPECT_EQ(line.exit_code, 0);
}

TEST(CommandLine, HelpNamesTheProgramTheBoardsAndTheDefaults) {
  const auto help_of = [](std::vector<const char*> words) {
    words.push_back("--help");
    testing::internal::CaptureStdout();
    EXPECT_EQ(parse(words).exit_code, 0);
    return testing::internal::GetCapturedStdout();
  };
  const auto says = [&](const std::vector<const char*>& words, const std::string& what) {
    const std::string help = help_of(words);
    EXPECT_NE(help.find(what), std::string::npos) << what << " is not in\n" << help;
  };
  says({}, "Usage: relievo ");
  says({"enrol"}, "Usage: relievo enrol ");
  says({"simulate", "board"}, "Usage: relievo simulate board ");
  says({}, "linux:FILE");
  says({"enrol"}, "linux:FILE");
  says({"calibrate"}, "linux:FILE");
  for (const char* named : {"=10x7", "=20\n", "=chessboard", "=0.55", "=14"})
    says({"simulate", "board"}, named);
  says({"compare"}, "=0:256");
  says({"reconstruct"}, "=face");
}

TEST(CommandLine, AWrongRangeIsNamedWithTheRightOneAndItsHelp) {
  for (const char* range : {"50:10", "9", "0:9999", "a:b"}) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(
        parse({"compare", "l.png", "r.png", "--rectified", "--disparities", range, "-o", "out"}).exit_code,
        2);
    const std::string said = testing::internal::GetCapturedStderr();
    for (const std::string& part : {std::string("--disparities"), std::string(range),
                                    std::string("such as 0:256"), std::string("relievo compare --help")})
      EXPECT_NE(said.find(part), std::string::npos) << said;
  }
}

TEST(CommandLine, WithoutACommandItIsTheKiosk) {
  const auto plain = parse({});
  ASSERT_TRUE(std::holds_alternative<KioskArgs>(plain.command));
  EXPECT_EQ(std::get<KioskArgs>(plain.command).width_px, 0) << "the whole screen";
  const auto named = parse(
      {"--board", "folder:pairs", "--calibration", "rig.yml", "--windowed", "1280x800", "--store", "st"});
  ASSERT_TRUE(std::holds_alternative<KioskArgs>(named.command));
  const auto& args = std::get<KioskArgs>(named.command);
  EXPECT_EQ(args.device, "folder:pairs");
  EXPECT_EQ(args.calibration, "rig.yml");
  EXPECT_EQ(args.store, "st");
  EXPECT_EQ(args.width_px, 1280);
  EXPECT_EQ(args.height_px, 800);
  EXPECT_EQ(std::get<KioskArgs>(parse({"--screenshots", "shots"}).command).screenshots, "shots");
}

// They would not reach it: somebody would be erased from the usual store.
TEST(CommandLine, WhatStandsBeforeACommandIsAUsageError) {
  EXPECT_EQ(parse({"subjects", "erase", "Ada", "--store", "st"}).exit_code, 0);
  EXPECT_EQ(parse({"--store", "st", "subjects", "erase", "Ada"}).exit_code, 2);
  EXPECT_EQ(parse({"--key", "k", "memory", "--store", "st"}).exit_code, 2);
}

// A script's variable was empty. Taken for a word that is not there it would mean the only person of a store,
// the usual store, a model that is not saved, a person's copy that is not sealed.
TEST(CommandLine, AnEmptyWordIsNoPlace) {
  const std::vector<std::vector<const char*>> calls{
      {"subjects", "erase", "X"},
      {"subjects", "show", "X"},
      {"subjects", "export", "X", "-o", "out"},
      {"subjects", "erase", "Ada", "--store", "X"},
      {"subjects", "list", "--key", "X"},
      {"subjects", "export", "Ada", "-o", "X"},
      {"subjects", "export", "Ada", "-o", "out", "--to", "X"},
      {"subjects", "export", "Ada", "-o", "out", "--passphrase-file", "X"},
      {"store", "backup", "X"},
      {"store", "check", "--backup", "X"},
      {"store", "rekey", "--new-key", "X"},
      {"reconstruct", "l.png", "X", "--calibration", "rig.yml", "-o", "out"},
      {"reconstruct", "l.png", "r.png", "--calibration", "rig.yml", "-o", "X"},
      {"reconstruct", "l.png", "r.png", "--calibration", "X", "-o", "out"},
      {"reconstruct", "l.png", "r.png", "--calibration", "rig.yml", "-o", "out", "--save", "X"},
      {"reconstruct", "--load", "X", "-o", "out"},
      {"compare", "l.png", "r.png", "--calibration", "rig.yml", "-o", "out", "--truth", "X"},
      {"simulate", "face", "-o", "X"},
      {"calibrate", "X", "--corners", "10x7", "--square-mm", "20", "-o", "rig.yml"},
      {"--screenshots", "X"}};
  for (std::vector<const char*> words : calls) {
    EXPECT_EQ(parse(words).exit_code, 0) << words.front() << ' ' << words.back();
    std::ranges::replace_if(
        words, [](const char* word) { return std::string_view(word) == "X"; }, "");
    testing::internal::CaptureStderr();
    EXPECT_EQ(parse(words).exit_code, 2) << words.front() << ' ' << words[1];
    EXPECT_NE(testing::internal::GetCapturedStderr().find("an empty word"), std::string::npos);
  }
}

TEST(CommandLine, WrongWordsAreUsageErrorsInOneLine) {
  const std::vector<std::vector<const char*>> wrong{
      {"--windowed", "wide"},
      {"--windowed", "100x100"},
      {"--windowed", "1280x800px"},
      {"--windowed", "1280x99999999999"},
      {"bogus"},
      {"reconstruct"},
      {"reconstruct", "l.png", "r.png", "-o", "out"},
      {"reconstruct", "l.png", "r.png", "x.png", "--calibration", "rig.yml", "-o", "out"},
      {"reconstruct", "l.png", "r.png", "--calibration", "rig.yml", "-o", "out", "--frame", "sideways"},
      {"reconstruct", "l.png", "r.png", "--calibration", "rig.yml", "-o", "out", "--lod", "3"},
      {"calibrate", "dir", "--corners", "10", "--square-mm", "20", "-o", "rig.yml"},
      {"calibrate", "--corners", "10x7", "--square-mm", "20", "-o", "rig.yml"},
      {"calibrate", "dir", "--pattern", "circles", "--corners", "10x7", "--square-mm", "20", "-o", "rig.yml"},
      {"calibrate", "dir", "--print-pattern", "charuco", "--corners", "10x7", "--square-mm", "20", "-o",
       "board.pdf"},
      {"simulate", "board", "-o", "out", "--lamp", "nan"},
      {"simulate", "face", "-o", "out", "--yaw", "++10"},
      {"simulate", "face", "-o", "out", "--yaw", "+-10"},
      {"simulate", "photograph", "-o", "out"},
      {"calibrate", "dir", "--corners", "10x7x3", "--square-mm", "20", "-o", "rig.yml"},
      {"calibrate", "dir", "--corners", "-4x7", "--square-mm", "20", "-o", "rig.yml"},
      {"calibrate", "dir", "--corners", "10x7", "--square-mm", "-1", "-o", "rig.yml"},
      {"calibrate", "dir", "--corners", "10x7", "--square-mm", "nan", "-o", "rig.yml"},
      {"calibrate", "dir", "--corners", "10x7", "--square-mm", "0x14", "-o", "rig.yml"},
      {"calibrate", "dir", "--corners", "10x7", "--square-mm", "20", "-o", "rig.yml", "--baseline-mm", "-5"},
      {"subjects"},
      {"subjects", "show"},
      {"enrol", "--board", "sim"},
      {"simulate", "board", "-o", "out", "--pairs", "0"},
      {"version", "more"}};
  for (const auto& words : wrong) {
    testing::internal::CaptureStderr();
    const auto line = parse(words);
    const std::string said = testing::internal::GetCapturedStderr();
    const std::string first = words.empty() ? "" : words.front();
    EXPECT_EQ(line.exit_code, 2) << first;
    EXPECT_TRUE(std::holds_alternative<NothingArgs>(line.command)) << first;
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  }
}

}  // namespace
}  // namespace relievo::firmware
