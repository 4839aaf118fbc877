// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/power/logged_device.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <random>
#include <set>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <unordered_set>

namespace relievo::test {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kSector = 512, kBlock = 4096, kBytes = std::size_t{32} << 20,
                      kLogBytes = std::size_t{128} << 20;
// The kernel's own numbers (drivers/md/dm-log-writes.c).
constexpr std::uint64_t kFlush = 1, kFua = 2, kDiscard = 4, kMark = 8;

void run(const std::string& command) {
  if (std::system((command + " >/dev/null").c_str()) != 0)  // NOLINT(cert-env33-c): a test's own words
    throw std::runtime_error(command);
}

std::uint64_t number_at(const std::string& bytes, std::size_t at) {
  std::uint64_t number = 0;
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

}  // namespace

bool on_device() {
  static const bool asked = std::getenv("RELIEVO_POWER_CUT_DEVICE") != nullptr;
  return asked;
}

LoggedDevice::LoggedDevice(const fs::path& folder)
    : folder_(folder), name_("power" + work_.path().filename().string()) {
  const std::string device = work_ / "device", log = work_ / "log";
  run("mkfs.ext4 -qF -b 4096 -d " + folder.string() + " " + device + " " + std::to_string(kBytes >> 10) +
      "k");
  run("debugfs -w -R 'rmdir lost+found' " + device + " 2>/dev/null");
  durable_ = read_text(device);
  std::ofstream(log).close();
  fs::resize_file(log, kLogBytes);
  run("dmsetup create " + name_ + " --table \"0 " + std::to_string(kBytes / kSector) +
      " log-writes $(losetup -f --show " + device + ") $(losetup -f --show " + log + ")\"");
  run("mount -t ext4 /dev/mapper/" + name_ + " " + folder.string());
}

// The store may still be open on it: the system takes it away with the last file.
LoggedDevice::~LoggedDevice() {
  (void)std::system(("umount -l " + folder_.string()).c_str());  // NOLINT(cert-env33-c)
}

void LoggedDevice::acknowledge() {
  run("dmsetup message " + name_ + " 0 mark done");
  ++acknowledged_;
}

std::vector<LoggedDevice::Entry> LoggedDevice::entries() const {
  std::vector<Entry> all;
  std::size_t at = kSector;
  for (std::uint64_t left = number_at(log_, 16); left > 0; --left) {
    const Entry entry{number_at(log_, at), number_at(log_, at + 8), number_at(log_, at + 16), at + kSector};
    all.push_back(entry);
    at = entry.data + ((entry.flags & kDiscard) != 0 ? 0 : entry.sectors * kSector);
  }
  return all;
}

void LoggedDevice::apply(std::string& disk, const Entry& entry, std::uint64_t sectors) const {
  if ((entry.flags & kDiscard) != 0) return;  // what was given up may stay
  disk.replace(entry.sector * kSector, sectors * kSector, log_, entry.data, sectors * kSector);
}

void LoggedDevice::mount_copy(const std::string& disk, const fs::path& place) const {
  fs::remove(work_ / "cut");
  std::ofstream cut(work_ / "cut", std::ios::binary);
  for (const std::size_t at : blocks_) cut.seekp(static_cast<long>(at)).write(&disk[at], kBlock);
  cut.close();
  fs::resize_file(work_ / "cut", kBytes);
  run("mount -t ext4 -o loop " + (work_ / "cut").string() + " " + place.string());
}

std::size_t LoggedDevice::hash_of(const std::string& disk) const {
  std::size_t hash = 0;
  for (const std::size_t at : blocks_)
    hash = hash * 1'000'003 + std::hash<std::string_view>{}(std::string_view(disk).substr(at, kBlock));
  return hash;
}

long LoggedDevice::play(std::uint32_t seeds, const std::function<bool(const fs::path&, const Cut&)>& look) {
  // The kernel writes its log by a thread of its own.
  const auto complete = [&] {
    log_ = read_text(work_ / "log");
    const auto all = entries();
    return static_cast<std::size_t>(std::ranges::count_if(
               all, [](const Entry& one) { return one.flags == kMark; })) == acknowledged_;
  };
  for (int i = 0; !complete(); ++i) {
    if (i == 100) throw std::runtime_error("the kernel's log is not complete");
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  log_ = read_text(work_ / "log");  // what was on its way when its end was seen

  // Everything else is zero on every disk.
  const std::string nothing(kBlock, '\0');
  std::set<std::size_t> used;
  for (std::size_t at = 0; at < kBytes; at += kBlock)
    if (durable_.compare(at, kBlock, nothing) != 0) used.insert(at);
  for (const Entry& entry : entries())
    for (std::uint64_t k = 0; (entry.flags & kDiscard) == 0 && k < entry.sectors; ++k)
      used.insert((entry.sector + k) * kSector / kBlock * kBlock);
  blocks_.assign(used.begin(), used.end());

  std::vector<Entry> pending;
  std::unordered_set<std::size_t> seen;
  Cut cut{0, 0, false, ""};
  long cuts = 0;
  const auto judge = [&](const std::string& disk, const std::string& how) {
    ++cuts;
    if (!seen.insert(std::hash<std::string>{}(disk)*31 + cut.done * 2 + (cut.acknowledged ? 1U : 0U)).second)
      return true;
    const TemporaryFolder place;
    mount_copy(disk, place.path());
    cut.how = how;
    const bool goes_on = look(place.path(), cut);
    run("umount " + place.path().string());
    return goes_on;
  };
  for (const Entry& entry : entries()) {
    ++cut.entry;
    cut.acknowledged = entry.flags == kMark;
    if (cut.acknowledged) ++cut.done;
    const bool flush = (entry.flags & kFlush) != 0, fua = (entry.flags & kFua) != 0;
    if (flush || cut.acknowledged)
      for (std::uint32_t seed = 0; seed < seeds; ++seed) {
        std::mt19937 random(static_cast<std::uint32_t>(cut.entry) * 1'000 + seed);
        std::string disk = durable_;
        for (const Entry& one : pending)
          apply(disk, one, std::min<std::uint64_t>(one.sectors, random() % (2 * one.sectors + 1)));
        if (!judge(disk, "a part, seed " + std::to_string(seed))) return cuts;
      }
    if (flush) {
      for (const Entry& one : pending) apply(durable_, one, one.sectors);
      pending.clear();
    }
    if (fua) apply(durable_, entry, entry.sectors);
    else if (!cut.acknowledged) pending.push_back(entry);
    if ((flush || fua || cut.acknowledged) && !judge(durable_, "what was flushed")) return cuts;
  }
  return cuts;
}

}  // namespace relievo::test
