// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Somebody's copy is whole or not there: also after Ctrl-C, and never among a store's own files. The log
// tells of it.
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

#include "firmware/command/commands.h"
#include "storage/sqlite/sqlite_store.h"
#include "tests/storage/sample.h"
#include "tests/support/temporary_folder.h"

namespace relievo::firmware {
namespace {

namespace fs = std::filesystem;

// Somebody presses Ctrl-C when the time is asked: after the store was opened, before anything is written.
class CtrlC final : public hal::Clock {
 public:
  explicit CtrlC(bool pressed) : pressed_(pressed) {}
  hal::Instant now() const override { return {}; }
  std::chrono::system_clock::time_point wall_now() const override {
    if (pressed_) std::raise(SIGINT);
    return {};
  }

 private:
  bool pressed_;
};

Result<void> export_ada(const fs::path& from, const fs::path& to, const fs::path& passphrase,
                        bool ctrl_c = false) {
  static const storage::test::StillClock still;
  const CtrlC clock(ctrl_c);
  Console console;
  Services services{.console = console, .clock = clock};
  services.open_store = [](const Path& at, bool to_write) {
    return storage::open_sqlite_store(
        at, still, {.mode = to_write ? storage::OpenMode::ReadWrite : storage::OpenMode::ReadOnly});
  };
  SubjectsArgs args;
  args.verb = SubjectsArgs::Verb::Export;
  args.subject = "Ada Canary";
  args.output = to;
  args.store = from;
  args.passphrase = passphrase;
  return run(args, services);
}

struct WithAda {
  WithAda() {
    const auto store = storage::test::opened(folder / "from", storage::test::kNoReserve);
    const auto model = storage::test::sample_model(5);
    EXPECT_TRUE(
        store->add_enrolment(storage::NewSubject{"Ada Canary"}, storage::test::sample_enrolment(model)));
    test::write_text(folder / "passphrase", "long live the queen\n");
    fs::create_directory(folder / "to");
  }
  test::TemporaryFolder folder;
};

TEST(SubjectsExportDeathTest, CtrlCLeavesNothing) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto interrupted_export = [](bool sealed) {
    const WithAda ada;
    const auto done = export_ada(ada.folder / "from", ada.folder / "to/ada",
                                 sealed ? ada.folder / "passphrase" : fs::path(), true);
    const bool clean =
        !done && done.error().code == Errc::Cancelled && test::listing(ada.folder / "to").empty();
    fs::remove_all(ada.folder.path());
    std::_Exit(clean ? 0 : 1);
  };
  EXPECT_EXIT(interrupted_export(false), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(interrupted_export(true), testing::ExitedWithCode(0), "");
}

TEST(SubjectsExport, WritesNothingAmongAStoresFiles) {
  const WithAda ada;
  const auto store = ada.folder / "from";
  const std::string key = test::read_text(store / "relievo.key");
  const auto refused = [&](const fs::path& to, const fs::path& passphrase) {
    const auto done = export_ada(store, to, passphrase);
    ASSERT_FALSE(done) << to;
    EXPECT_EQ(done.error().code, Errc::InvalidInput);
  };
  refused(store, {});
  for (const char* name : {"relievo.key", "relievo.db", "ada.age"})
    refused(store / name, ada.folder / "passphrase");
  for (const char* name : {"ada.age", "model.ply"}) EXPECT_FALSE(fs::exists(store / name));
  EXPECT_EQ(test::read_text(store / "relievo.key"), key);
  EXPECT_TRUE(export_ada(store, ada.folder / "to/ada", {}));
  EXPECT_TRUE(export_ada(store, ada.folder / "to/ada.age", ada.folder / "passphrase"));
}

TEST(SubjectsExport, LeavesALineOfTheLog) {
  const WithAda ada;
  const auto exports = [&] {
    const auto store = storage::test::opened(ada.folder / "from", storage::test::kNoReserve);
    const auto log = store->audit(0, -1);
    EXPECT_TRUE(log);
    std::vector<std::string> told;
    for (const auto& one : *log)
      if (one.event.what == "enrolment.exported")
        told.push_back(std::to_string(std::int64_t(one.event.subject)) + ":" + one.event.detail);
    return told;
  };
  const std::vector<std::string> one{"1:1"}, two{"1:1", "1:1"};
  EXPECT_TRUE(exports().empty());
  ASSERT_TRUE(export_ada(ada.folder / "from", ada.folder / "to/ada", {}));
  EXPECT_EQ(exports(), one);
  ASSERT_TRUE(export_ada(ada.folder / "from", ada.folder / "to/ada.age", ada.folder / "passphrase"));
  EXPECT_EQ(exports(), two);
}

}  // namespace
}  // namespace relievo::firmware
