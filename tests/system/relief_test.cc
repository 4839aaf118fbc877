// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A person comes, and then somebody with that person's photograph.
#include <filesystem>

#include "hal/picture_file.h"
#include "tests/system/relievo_process.h"

namespace relievo::test {
namespace {

using RelievoRelief = RelievoProcess;

TEST_F(RelievoRelief, APhotographOfAFaceIsRefusedAndTheFaceIsNot) {
  simulated({"face", "--seed", "8", "--scale", "0.4"}, "face");
  const auto reconstruct = [](const std::string& from, std::string to) {
    return std::vector<std::string>{"reconstruct",   from + "/left.png", from + "/right.png",
                                    "--calibration", from + "/rig.yml",  "-o",
                                    std::move(to)};
  };
  done(reconstruct("face", "model"));
  const std::string report = read_text(here / "model/report.json");
  EXPECT_NE(report.find("\"off_sheet_mm\""), std::string::npos);

  // 360 mm: what the picture shows is as large as life again.
  done({"simulate", "photograph", "face/left.png", "--width-mm", "360", "--scale", "0.4", "-o", "flat"});
  done({"simulate", "photograph", "face/left.png", "--width-mm", "360", "--scale", "0.4", "--radius-mm",
        "110", "--gloss", "0.02", "-o", "bent"});
  for (const char* held : {"flat", "bent"}) {
    refused(reconstruct(held, "none"), "off a bent sheet", "please look into the cameras yourself");
    EXPECT_FALSE(std::filesystem::exists(here / "none"));
  }
  const Said enrolled = relievo({"enrol", "--board", "folder:flat", "--calibration", "flat/rig.yml",
                                 "--subject", "Ada", "--store", "store"});
  EXPECT_EQ(enrolled.exit_code, 1);
  EXPECT_NE(enrolled.err.find("please look into the cameras yourself"), std::string::npos) << enrolled.err;
  EXPECT_EQ(done({"subjects", "list", "--store", "store"}).out.find("Ada"), std::string::npos);

  // The technician may want to see it all the same, though it may have neither nose nor symmetry.
  for (const std::string held : {"flat", "bent"}) {
    auto words = reconstruct(held, held + "_anyway");
    words.insert(words.end(), {"--set", "relief=off"});
    done(words);
    EXPECT_TRUE(std::filesystem::exists(here / (held + "_anyway/model.ply")));
  }
}

TEST_F(RelievoRelief, WhatCannotBeHeldIsRefused) {
  refused({"simulate", "photograph", "nobody.png", "-o", "out"}, "nobody.png");
}

}  // namespace
}  // namespace relievo::test
