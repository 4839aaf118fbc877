// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/power/power_cuts.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <unordered_set>

#include "tests/power/disk_log.h"
#include "tests/power/logged_device.h"
#include "tests/support/temporary_folder.h"

namespace relievo::test {
namespace {

namespace fs = std::filesystem;
using Kind = DiskChange::Kind;

constexpr int kMostFailures = 5;

std::uint32_t seeds() {
  const char* asked = std::getenv("RELIEVO_POWER_CUT_SEEDS");
  return asked == nullptr ? 4U : static_cast<std::uint32_t>(std::strtoul(asked, nullptr, 10));
}

bool is_point(const DiskChange& change) {
  return change.kind == Kind::Sync || change.kind == Kind::SyncAll || change.kind == Kind::Acknowledged;
}

std::size_t hash_of(const DiskTree& disk, int node = 0) {
  const auto& here = disk.nodes[static_cast<std::size_t>(node)];
  std::size_t hash = std::hash<std::string>{}(here.bytes) + (here.folder ? 1U : 0U);
  for (const auto& [name, child] : here.names)
    hash = (hash * 1'000'003) ^ std::hash<std::string>{}(name) ^ (hash_of(disk, child) << 1U);
  return hash;
}

// The first line in which two differ.
std::string difference(const std::string& seen, const std::string& wanted) {
  std::size_t at = 0, line = 0;
  for (; at < seen.size() && at < wanted.size() && seen[at] == wanted[at]; ++at)
    if (seen[at] == '\n') line = at + 1;
  const auto from = [&](const std::string& text) { return text.substr(line, text.find('\n', line) - line); };
  return "\"" + from(seen) + "\", not \"" + from(wanted) + "\"";
}

class Cutter {
 public:
  Cutter(const std::vector<PowerStep>& steps, const PowerLook& look) : steps_(steps), look_(look) {}

  // What it looks like between the steps.
  void expect(const DiskTree& disk) {
    const TemporaryFolder place;
    disk.write(place / "disk");
    expected_.push_back(look_.see(place / "disk"));
    EXPECT_FALSE(expected_.back().starts_with("!")) << expected_.back();
  }

  PowerCounts run(const DiskLog& log) {
    learn(log);
    CutDisk disk(log);
    std::size_t done = 0;
    const std::size_t stride = seeds() < 100 ? 9 : 1;
    for (std::size_t at = 0; at <= log.changes.size() && failures_ < kMostFailures; ++at) {
      disk.go_to(at);
      const bool end = at == log.changes.size(),
                 acknowledged = !end && log.changes[at].kind == Kind::Acknowledged;
      if (acknowledged) ++done;
      if (end || is_point(log.changes[at])) {
        ++counts_.points;
        for (std::uint32_t seed = 0; seed < seeds(); ++seed, ++counts_.cuts)
          judge(disk.cut(seed), at, done, acknowledged, "seed " + std::to_string(seed));
      } else if (at % stride == 0) {
        ++counts_.kills;
        judge(disk.killed(), at, done, false, "killed");
      }
    }
    return counts_;
  }

  PowerCounts run(LoggedDevice& device) {
    counts_.cuts = device.play(seeds(), [&](const fs::path& mounted, const LoggedDevice::Cut& cut) {
      ++counts_.different;
      if (look_.raw) fail(look_.raw(mounted, cut.done), cut.entry, cut.done, cut.acknowledged, cut.how);
      fail(wrong_in(mounted, cut.done, cut.acknowledged), cut.entry, cut.done, cut.acknowledged, cut.how);
      return failures_ < kMostFailures;
    });
    EXPECT_FALSE(!look_.never.empty() && device.wrote(look_.never)) << "it was written in the clear";
    return counts_;
  }

 private:
  void learn(const DiskLog& log) {
    CutDisk disk(log);
    for (std::size_t at = 0; at <= log.changes.size(); ++at) {
      disk.go_to(at);
      if (at == 0 || (at < log.changes.size() && log.changes[at].kind == Kind::Acknowledged))
        expect(disk.killed());
    }
  }

  std::string wrong_in(const fs::path& folder, std::size_t done, bool acknowledged) {
    const std::string seen = look_.see(folder);
    const std::string& before = expected_[done];
    const std::string& after = expected_[acknowledged || done == steps_.size() ? done : done + 1];
    if (seen.starts_with("!")) return seen;
    if (before != after) ++(seen == before ? counts_.as_before : counts_.as_after);
    return seen == before || seen == after ? "" : difference(seen, after);
  }

  void fail(const std::string& wrong, std::size_t at, std::size_t done, bool acknowledged,
            const std::string& how) {
    if (wrong.empty() || ++failures_ > kMostFailures) return;
    const std::size_t step = acknowledged ? done - 1 : done;
    ADD_FAILURE() << (step < steps_.size() ? steps_[step].name : "the end") << (acknowledged ? " (done)" : "")
                  << ", change " << at << ", " << how << ": " << wrong;
  }

  void judge(const DiskTree& left, std::size_t at, std::size_t done, bool acknowledged,
             const std::string& how) {
    if (!seen_.insert(hash_of(left) * 31 + done * 2 + (acknowledged ? 1U : 0U)).second) return;
    ++counts_.different;
    const TemporaryFolder place;
    const fs::path folder = place / "disk";
    left.write(folder);
    const auto wrong_is = [&](const std::string& wrong) { fail(wrong, at, done, acknowledged, how); };
    if (look_.raw) wrong_is(look_.raw(folder, done));
    DiskLog again;
    {
      WatchedDisk watched(folder);
      wrong_is(wrong_in(folder, done, acknowledged));
      again = watched.log();
    }
    if (counts_.different % 4 != 0) return;
    std::vector<std::size_t> points;
    for (std::size_t i = 0; i < again.changes.size(); ++i)
      if (is_point(again.changes[i])) points.push_back(i);
    if (points.empty()) return;
    ++counts_.cut_again;
    CutDisk disk(again);
    const auto number = static_cast<std::size_t>(counts_.different);
    disk.go_to(points[number / 4 % points.size()]);
    disk.cut(static_cast<std::uint32_t>(number)).write(folder);
    const auto wrong = wrong_in(folder, done, acknowledged);
    wrong_is(wrong.empty() ? "" : "cut again: " + wrong);
  }

  const std::vector<PowerStep>& steps_;
  const PowerLook& look_;
  std::vector<std::string> expected_;
  std::unordered_set<std::size_t> seen_;
  int failures_ = 0;
  PowerCounts counts_;
};

}  // namespace

PowerCounts cut_power(const fs::path& folder, const std::vector<PowerStep>& steps, const PowerLook& look) {
  Cutter cutter(steps, look);
  PowerCounts counts;
  if (on_device()) {
    std::vector<DiskTree> between;
    LoggedDevice device(folder);
    between.push_back(DiskTree::of(folder));
    for (const PowerStep& step : steps) {
      EXPECT_TRUE(step.work()) << step.name;
      device.acknowledge();
      between.push_back(DiskTree::of(folder));
    }
    for (const DiskTree& disk : between) cutter.expect(disk);
    counts = cutter.run(device);
  } else {
    DiskLog log;
    {
      WatchedDisk watched(folder);
      for (std::size_t i = 0; i < steps.size(); ++i) {
        EXPECT_TRUE(steps[i].work()) << steps[i].name;
        watched.acknowledge(i);
      }
      EXPECT_EQ(watched.unseen(), "") << "changed by a call that is not watched";
      log = watched.log();
    }
    counts = cutter.run(log);
  }
  std::cout << ::testing::UnitTest::GetInstance()->current_test_info()->name() << ": " << counts.points
            << " points, " << counts.cuts << " cuts and " << counts.kills << " kills left "
            << counts.different << " different disks, " << counts.cut_again
            << " of them cut again: " << counts.as_before << " as before the step, " << counts.as_after
            << " as after it" << std::endl;
  return counts;
}

}  // namespace relievo::test
