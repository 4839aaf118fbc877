// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "pipeline/calibrate/file/calibration_fields.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "tests/support/temporary_folder.h"

namespace relievo::tests {
namespace {

using pipeline::parse_yaml_fields;

TEST(YamlFields, KnowsNumbersWordsAndMatrices) {
  const auto fields = parse_yaml_fields(
      "n: 3\nx: -1.5e-3\nword: plumb_bob\nquoted: \"12\"\nempty:\n"
      "m: {rows: 1, cols: 2, data: [1., +2]}\nmap: {rows: 2, else: {deep: [1, [2]]}}\nlist: [a, {b: c}]\nlast: 7\n");
  ASSERT_TRUE(fields) << fields.error().where() << fields.error().what.view();
  EXPECT_EQ(fields->numbers.at("n"), 3);
  EXPECT_EQ(fields->numbers.at("x"), -1.5e-3);
  EXPECT_EQ(fields->words.at("word"), "plumb_bob");
  EXPECT_EQ(fields->words.at("quoted"), "12");
  EXPECT_EQ(fields->matrices.at("m").values, (std::vector<double>{1, 2}));
  EXPECT_EQ(fields->matrices.size(), 1U);
  EXPECT_EQ(fields->numbers.at("last"), 7);
}

TEST(YamlFields, NamesTheLine) {
  const auto where = [](const char* text) { return std::string(parse_yaml_fields(text).error().where()); };
  EXPECT_EQ(where("a: 1\na: 2\n"), "line 2");
  EXPECT_EQ(where("%YAML:1.0\n---\na: 1\nb: 2\na: 3\n"), "line 5");
  EXPECT_EQ(where("a: 1\nm: !!opencv-matrix\n   rows: 1\n   cols: 1\n   dt: q\n   data: [1]\n"), "line 5");
  EXPECT_EQ(where("a: 1\n}\n"), "line 2");
}

TEST(YamlFields, RefusesWhatYamlLetsPass) {
  for (const char* text : {"a: 1",
                           "a: 1\nb",
                           "a: 1\n---\nb: 2\n",
                           "- a\n",
                           "plain\n",
                           "a: &x 1\n",
                           "a: 1\nb: *x\n",
                           "a: *x\n",
                           "[a]: 1\n",
                           "? [a]\n: 1\n",
                           "m: {rows: 1, cols: 1, data: [.nan]}\n",
                           "m: {rows: 1, cols: 1, data: [1e999]}\n",
                           "m: {rows: 1, cols: 1, data: [1, 2]}\n",
                           "m: {rows: 2, cols: 1, data: [1]}\n",
                           "m: {rows: 1, cols: 1, data: 1}\n",
                           "m: {rows: 1, cols: 1, data: [[1]]}\n",
                           "m: {rows: 1, rows: 1, cols: 1, data: [1]}\n",
                           "m: {rows: 1, cols: 1}\n",
                           "m: {rows: 1.0, cols: 1, data: [1]}\n",
                           "m: {rows: 99999999999, cols: 1, data: [1]}\n",
                           "m: !!opencv-matrix {rows: 1, cols: 1, dt: d, data: [1], more: 1}\n",
                           "\n",
                           "",
                           "   ",
                           "%YAML:1.0",
                           "\xff\xfe\x61"}) {
    const auto fields = parse_yaml_fields(text);
    ASSERT_FALSE(fields) << text;
    EXPECT_EQ(fields.error().code, Errc::InvalidInput) << text;
    EXPECT_EQ(fields.error().what.view().find('\n'), std::string_view::npos);
  }
}

// Memory and time stay small whatever comes; the sanitizers look on.
TEST(YamlFields, BombsDoNotGoOff) {
  const std::size_t most = pipeline::kMaxCalibrationFileBytes;
  std::string ladder;
  for (int i = 0; i < 700; ++i) ladder += std::string(static_cast<std::size_t>(i), ' ') + "a:\n";
  std::string keys;
  for (int i = 0; keys.size() < most - 20; ++i) keys += "k" + std::to_string(i) + ": 1\n";
  const std::vector<std::string> bombs{std::string(most, '['),
                                       "a: " + std::string(most - 10, '[') + "\n",
                                       "a: " + std::string(most - 10, '{') + "\n",
                                       "a: " + std::string(100, '[') + std::string(100, ']') + "\n",
                                       ladder,
                                       std::string(most, '-'),
                                       std::string(most, '?'),
                                       "a: \"" + std::string(most - 10, 'x') + "\n",
                                       std::string(most, '&'),
                                       std::string(most - 1, '#') + "\n",
                                       "a: [" + std::string(most - 10, ',') + "]\n",
                                       std::string(most, '\n'),
                                       "m: {rows: 4096, cols: 4096, data: [1]}\n"};
  for (const std::string& text : bombs) EXPECT_FALSE(parse_yaml_fields(text)) << text.substr(0, 20);
  EXPECT_TRUE(parse_yaml_fields(keys));
}

TEST(YamlFields, TenMegabytesOfBracketsAreNotEvenRead) {
  const test::TemporaryFolder here;
  test::write_text(here / "rig.yml", std::string(10'000'000, '['));
  const auto read = pipeline::read_calibration(here / "rig.yml");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, Errc::InvalidInput);
  EXPECT_NE(std::string(read.error().where()).find("rig.yml"), std::string::npos);
}

}  // namespace
}  // namespace relievo::tests
