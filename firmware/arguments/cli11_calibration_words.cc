// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/arguments/command_words.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

#include "firmware/arguments/two_numbers.h"

namespace relievo::firmware {
namespace {

using Verb = CalibrationArgs::Verb;

// "1920x1200", 16 to 8192 each.
bool picture_size(const std::string& text, int& width, int& height) {
  const auto size = two_numbers(text, 'x');
  if (!size || std::min(size->first, size->second) < 16 || std::max(size->first, size->second) > 8192)
    return false;
  width = size->first, height = size->second;
  return true;
}

// CLI::Range lets "nan" through.
std::string check_unit(const std::string& word) {
  double unit = 0;
  const auto [end, bad] = std::from_chars(word.data(), word.data() + word.size(), unit);
  const bool good = bad == std::errc() && end == word.data() + word.size() && unit >= 1e-6 && unit <= 1e6;
  return good ? "" : "wants the millimetres of one unit, such as 1 or 1000, not " + word;
}

std::string check_revision(const std::string& word) {
  const bool good =
      !word.empty() && word.front() != '0' && word.find_first_not_of("0123456789") == std::string::npos;
  return good ? "" : "wants a number as 'relievo calibration list' has it, from 1 on, not " + word;
}

void add_import(CLI::App& command, CalibrationArgs& args) {
  command.add_option("file", args.file, "rig.yml; or one of intrinsics.yml, left.yaml")
      ->required()
      ->type_name("FILE");
  command.add_option("other", args.other, "the other half of a pair; default: beside the first, by its name")
      ->type_name("FILE");
  command
      .add_option_function<std::string>(
          "--image-size",
          [&args](const std::string& text) {
            if (!picture_size(text, args.width_px, args.height_px))
              throw CLI::ValidationError("--image-size",
                                         "wants the pictures' width and height, such as 1920x1200");
          },
          "of the pictures, where the files do not say")
      ->type_name("WIDTHxHEIGHT");
  command.add_option("--unit-mm", args.unit_mm, "millimetres of one unit of T; default 1, of ROS files 1000")
      ->check(check_unit)
      ->type_name("MM");
  command.add_option("--note", args.note, "what the list shall say of it")->type_name("TEXT");
}

void add_export(CLI::App& command, CalibrationArgs& args) {
  command.add_option("-o,--output", args.file, "the file; for ros the folder")->required()->type_name("PATH");
  CLI::Option* revision =
      command.add_option("revision", args.revision, "which; default the one in use")->check(check_revision);
  command.add_option("--calibration", args.source, "one of a file instead of the store's")
      ->type_name("FILE")
      ->excludes(revision);
  command
      .add_option_function<std::string>(
          "--as", [&args](const std::string& word) { args.ros = word == "ros"; },
          "rig: one file as OpenCV writes it; ros: left.yaml and right.yaml (camera_info)")
      ->check(CLI::IsMember({"rig", "ros"}))
      ->default_str("rig");
}

}  // namespace

void add_calibration(CLI::App& app, CommandArgs& chosen, CalibrationArgs& args) {
  CLI::App* command = app.add_subcommand("calibration", "the calibrations in the store");
  command->require_subcommand(1);
  const auto verb = [&](const char* name, const char* help, Verb which) -> CLI::App& {
    CLI::App* sub = command->add_subcommand(name, help);
    add_store(*sub, args.store);
    sub->callback([&args, &chosen, which] {
      args.verb = which;
      chosen = args;
    });
    return *sub;
  };
  verb("list", "every calibration, the newest last, and how good it was found", Verb::List);
  verb("show", "the numbers of one", Verb::Show)
      .add_option("revision", args.revision, "which; default the one in use")
      ->check(check_revision);
  verb("activate", "use an older one again", Verb::Activate)
      .add_option("revision", args.revision)
      ->required()
      ->check(check_revision);
  add_import(verb("import", "take one from a file, or two, into the store", Verb::Import), args);
  add_export(verb("export", "write one to a file, or two", Verb::Export), args);
}

}  // namespace relievo::firmware
