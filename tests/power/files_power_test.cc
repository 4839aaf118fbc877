// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Power cuts while files are written: settings, logs, calibrations, exports. Each is as before or as after.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

#include "firmware/base/output_folder.h"
#include "firmware/kiosk/stored_visits.h"
#include "firmware/records/event_log.h"
#include "firmware/records/receipt.h"
#include "firmware/service/consent_text_store.h"
#include "firmware/service/export_records.h"
#include "firmware/technician/stick_files.h"
#include "hal/base/whole_file.h"
#include "hal/sim/replay/replay_device.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "storage/export/model_files.h"
#include "tests/power/power_cuts.h"
#include "tests/storage/sample.h"
#include "tests/support/temporary_folder.h"

namespace relievo::firmware {
namespace {

namespace fs = std::filesystem;
using storage::test::sample_calibration;
using storage::test::sample_model;
using test::cut_power;
using test::PowerStep;
using test::TemporaryFolder;

// Every file whose way is not hidden, with what is in it.
std::string files_in(const fs::path& folder) {
  std::string all;
  std::vector<fs::path> entries;
  for (const auto& entry : fs::directory_iterator(folder)) entries.push_back(entry.path());
  std::sort(entries.begin(), entries.end());
  for (const fs::path& entry : entries) {
    if (entry.filename().string().starts_with('.')) continue;
    const auto inside = fs::is_directory(entry)
                            ? files_in(entry)
                            : std::to_string(std::hash<std::string>{}(test::read_text(entry)));
    if (!inside.empty()) all += entry.filename().string() + ":" + inside + "\n";
  }
  return all;
}

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

class FilesPower : public ::testing::Test {
 protected:
  FilesPower() { fs::create_directory(disk); }
  TemporaryFolder folder;
  fs::path disk = folder / "disk";
  storage::test::StillClock clock;
};

TEST_F(FilesPower, OneFile) {
  const auto counts = cut_power(
      disk,
      {
          {"file",
           [&] { return write_whole_file(disk / "a", bytes_of(std::string(3000, 'a'))).has_value(); }},
          {"file",
           [&] { return write_whole_file(disk / "a", bytes_of(std::string(2000, 'b'))).has_value(); }},
          {"whole file",
           [&] { return write_whole_file(disk / "b", bytes_of(std::string(3000, 'a'))).has_value(); }},
          {"whole file",
           [&] { return write_whole_file(disk / "b", bytes_of(std::string(9, 'b'))).has_value(); }},
          {"calibration",
           [&] { return pipeline::write_calibration(disk / "rig.yml", sample_calibration()).has_value(); }},
          {"log",
           [&] {
             EventLog log(clock, disk / kLogFile);
             log.say(ui::LogEvent{});
             return log.save().has_value();
           }},
          {"log",
           [&] {
             EventLog log(clock, disk / kLogFile);
             log.say(ui::LogEvent{});
             return log.save().has_value();
           }},
      },
      {files_in});
  EXPECT_GT(counts.as_before, 10);
  EXPECT_GT(counts.as_after, 3);
}

TEST_F(FilesPower, AFolderThatACommandMakes) {
  const auto write = [&](const char* text) {
    auto out = OutputFolder::begin(disk / "reports/today/out");
    return out && write_text(out->path() / "report.json", text, "out") &&
           write_text(out->path() / "model.ply", text, "out") && out->commit();
  };
  const auto counts = cut_power(disk, {{"made", [&] { return write("one"); }}}, {files_in});
  EXPECT_GT(counts.as_before, 3);
  EXPECT_GT(counts.as_after, 0);
}

// Several files in a folder that is there: each of them by itself.
TEST_F(FilesPower, ModelFiles) {
  std::vector<std::string> wholes;
  for (const int side : {8, 9}) {
    ASSERT_TRUE(storage::write_model_files(sample_model(side), folder / "whole", storage::ExportFrame::Head));
    for (const auto& entry : fs::directory_iterator(folder / "whole"))
      wholes.push_back(entry.path().filename().string() + test::read_text(entry.path()));
  }
  const auto write = [&](int side) {
    return storage::write_model_files(sample_model(side), disk, storage::ExportFrame::Head).has_value();
  };
  const auto counts = cut_power(
      disk, {{"old", [&] { return write(8); }}, {"new", [&] { return write(9); }}}, {[&](const fs::path& at) {
        for (const auto& entry : fs::directory_iterator(at)) {
          const std::string name = entry.path().filename().string();
          if (!name.starts_with('.') &&
              std::find(wholes.begin(), wholes.end(), name + test::read_text(entry.path())) == wholes.end())
            return "!half: " + name;
        }
        return std::string();
      }});
  EXPECT_GT(counts.different, 20);
}

// Visitors read a whole text, the one before or the new one.
TEST_F(FilesPower, TheConsentTextOfAStick) {
  const auto on_stick = [&](const char* version, const char* words) {
    fs::create_directories(folder / "stick/consent" / version);
    for (const char* name : {"en.txt", "de.txt"})
      test::write_text(folder / "stick/consent" / version / name,
                       std::string(words) + "\n\nA point\nIts words\n");
  };
  const auto take = [&]() {
    const auto now = own_consent(disk / "consent");
    return now && take_consent(folder / "stick", disk / "consent", *now);
  };
  const auto counts = cut_power(disk,
                                {
                                    {"first", [&] { return on_stick("2026-03", "The first"), take(); }},
                                    {"second", [&] { return on_stick("2026-09", "The second"), take(); }},
                                },
                                {[](const fs::path& at) {
                                  const auto seen = own_consent(at / "consent");
                                  if (!seen) return "!" + std::string(seen.error().what.view());
                                  std::string all;
                                  if (*seen)
                                    for (const auto& text : (*seen)->in)
                                      all += (text ? text->title : "-") + "|";
                                  return *seen ? (*seen)->version + all : all;
                                }});
  EXPECT_GT(counts.as_before, 3);
  EXPECT_GT(counts.as_after, 1);
}

// A kiosk that ran when the power went is known by it, one that had ended is not.
TEST_F(FilesPower, TheMarkOfARun) {
  std::unique_ptr<RunMark> mark;
  const auto set = [&] {
    auto made = RunMark::set(disk);
    if (made) mark = std::move(*made);
    return made.has_value();
  };
  const auto counts = cut_power(disk,
                                {
                                    {"begins", set},
                                    {"ends", [&] { return mark.reset(), true; }},
                                    {"begins", set},
                                },
                                {files_in});
  EXPECT_FALSE(mark->ended_early());
  EXPECT_GT(counts.as_before, 1);
  EXPECT_GT(counts.as_after, 1);
}

// Whoever plugs the stick in again tidies it first.
TEST_F(FilesPower, RecordsAndCalibrationsOnAStick) {
  const auto store = storage::test::opened(folder / "store", {.reserve_bytes = 0});
  const auto enrol = [&](const storage::SubjectChoice& who, int side) {
    const auto model = sample_model(side);
    return store->add_enrolment(who, storage::test::sample_enrolment(model)).has_value();
  };
  const auto give = [&](std::int64_t who) {
    hal::FolderMedia stick(disk);
    const std::atomic<bool> cancelled = false;
    pipeline::Progress progress;
    JobControl control{cancelled, progress};
    ExportTrace trace;
    return export_records(*store, clock, stick, {storage::SubjectId{who}}, {}, control, trace).has_value();
  };
  const auto calibration = [&](double rms) {
    hal::FolderMedia stick(disk);
    auto changed = sample_calibration();
    changed.rms_px = rms;
    return export_calibration(changed, "today", stick).has_value();
  };
  ASSERT_TRUE(enrol(storage::NewSubject{"Ada"}, 8) && enrol(storage::NewSubject{"Bob"}, 9));
  const auto counts =
      cut_power(disk,
                {
                    {"Ada", [&] { return give(1); }},
                    {"Bob", [&] { return give(2); }},
                    {"Ada again", [&] { return enrol(storage::SubjectId{1}, 10) && give(1); }},
                    {"calibration", [&] { return calibration(0.1); }},
                    {"another", [&] { return calibration(0.2); }},
                },
                {[](const fs::path& at) {
                  tidy_folder(at / "relievo", is_receipt);
                  tidy_folder(at / kCalibrationsFolder);
                  return files_in(at);
                }});
  EXPECT_GT(counts.as_before, 30);
  EXPECT_GT(counts.as_after, 3);
}

}  // namespace
}  // namespace relievo::firmware
