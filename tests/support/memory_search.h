// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Looks for what must have been wiped in everything this process can write to: heap, stacks, pools, the
// driver's memory. A Canary is kept in disguise, so that the search does not find its own copy. Pages that
// nobody has touched are left out. Thread: one at a time; the other threads should rest.
#pragma once

#include <fcntl.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace relievo::test {

class Canary {
 public:
  Canary(std::string what, std::span<const std::byte> bytes) : what_(std::move(what)) {
    for (const std::byte b : bytes) hidden_.push_back(b ^ kDisguise);
  }
  Canary(std::string what, std::string_view text)
      : Canary(std::move(what), std::as_bytes(std::span(text.data(), text.size()))) {}
  const std::string& what() const { return what_; }
  std::size_t size() const { return hidden_.size(); }
  void show_in(std::byte* room) const {
    std::transform(hidden_.begin(), hidden_.end(), room, [](std::byte b) { return b ^ kDisguise; });
  }

 private:
  static constexpr std::byte kDisguise{0xA5};
  std::string what_;
  std::vector<std::byte> hidden_;
};

class MemorySearch {
 public:
  MemorySearch()
      : room_(static_cast<std::byte*>(
            mmap(nullptr, kRoom, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0))) {}
  ~MemorySearch() {
    munmap(room_, kRoom);
    close(memory_);
    close(pages_);
  }
  MemorySearch(const MemorySearch&) = delete;
  MemorySearch& operator=(const MemorySearch&) = delete;

  // A line for each canary that is there: where, and what stands around it.
  std::vector<std::string> find(std::span<const Canary> canaries) {
    std::vector<std::string> found;
    searched_bytes_ = 0;
    std::ifstream maps("/proc/self/maps");
    std::string line;
    std::vector<std::string> lines;
    while (std::getline(maps, line)) lines.push_back(line);
    for (const std::string& of : lines) {
      std::uintptr_t begin = 0, end = 0;
      char may[5] = {};
      if (std::sscanf(of.c_str(), "%lx-%lx %4s", &begin, &end, may) != 3) continue;
      const bool readable = may[0] == 'r' && may[1] == 'w';
      if (!readable || end - begin > kMostBytes) continue;  // more: a sanitizer's own
      look_through(begin, end, of, canaries, found);
    }
    explicit_bzero(room_, kRoom);
    return found;
  }
  std::size_t searched_bytes() const { return searched_bytes_; }

 private:
  static constexpr std::size_t kPage = 4096, kChunk = std::size_t{1} << 20, kMostCanary = 256;
  static constexpr std::size_t kRoom = kChunk + 2 * kMostCanary + kPage;
  static constexpr std::size_t kMostBytes = std::size_t{1} << 33;

  void look_through(std::uintptr_t begin, std::uintptr_t end, const std::string& mapping,
                    std::span<const Canary> canaries, std::vector<std::string>& found) {
    std::vector<std::uint64_t> flags((end - begin) / kPage);
    const auto bytes = static_cast<ssize_t>(flags.size() * sizeof(flags[0]));
    if (pread(pages_, flags.data(), static_cast<std::size_t>(bytes),
              static_cast<off_t>(begin / kPage * sizeof(flags[0]))) != bytes)
      return;
    const auto touched = [&](std::size_t i) { return (flags[i] >> 62) != 0; };  // in memory, or swapped
    for (std::size_t i = 0; i < flags.size();) {
      if (!touched(i)) {
        ++i;
        continue;
      }
      std::size_t past = i;
      while (past < flags.size() && touched(past)) ++past;
      search(begin + i * kPage, begin + past * kPage, mapping, canaries, found);
      i = past;
    }
  }
  void search(std::uintptr_t begin, std::uintptr_t end, const std::string& mapping,
              std::span<const Canary> canaries, std::vector<std::string>& found) {
    const auto own = reinterpret_cast<std::uintptr_t>(room_);
    std::byte* const needle = room_;
    std::byte* const hay = room_ + kMostCanary;
    std::size_t kept = 0;  // of the chunk before: a canary may lie across
    for (std::uintptr_t at = begin; at < end;) {
      if (at >= own && at < own + kRoom) return;
      std::size_t size = std::min(end - at, kChunk);
      if (at < own && own < at + size) size = own - at;
      const ssize_t got = pread(memory_, hay + kept, size, static_cast<off_t>(at));
      if (got <= 0) return;  // it has gone meanwhile
      const std::size_t all = kept + static_cast<std::size_t>(got);
      searched_bytes_ += static_cast<std::size_t>(got);
      for (const Canary& canary : canaries) {
        canary.show_in(needle);
        const auto* hit = static_cast<const std::byte*>(memmem(hay, all, needle, canary.size()));
        if (hit == nullptr) continue;
        const auto address = at - kept + static_cast<std::uintptr_t>(hit - hay);
        found.push_back(canary.what() + " at " + hex(address) + " of " + mapping + thread_of(address) + ": " +
                        around(hit, hay, hay + all, canary.size()));
      }
      at += static_cast<std::uintptr_t>(got);
      kept = std::min(all, kMostCanary);
      memmove(hay, hay + all - kept, kept);
    }
  }
  // Whose stack that is, if it is one's.
  static std::string thread_of(std::uintptr_t address) {
    std::string named;
    for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
      std::string word, name;
      std::ifstream call(task.path() / "syscall");
      std::uintptr_t stack = 0;
      for (int i = 0; i < 9 && call >> word; ++i)
        if (i == 7) stack = std::strtoul(word.c_str(), nullptr, 16);
      std::getline(std::ifstream(task.path() / "comm") >> std::ws, name);
      constexpr std::uintptr_t kStack = std::uintptr_t{8} << 20;
      if (stack != 0 && address < stack && stack - address < kStack) named = ", below the stack of " + name;
    }
    return named;
  }
  static std::string hex(std::uintptr_t number) {
    char text[20];
    std::snprintf(text, sizeof(text), "%lx", number);
    return text;
  }
  // In disguise, too: letters in lower case are said in upper case and the other way round.
  static std::string around(const std::byte* hit, const std::byte* begin, const std::byte* end,
                            std::size_t size) {
    std::string text;
    const std::byte* from = std::max(begin, hit - 48);
    for (; from < end && from < hit + size + 48; ++from) {
      const char c = static_cast<char>(*from);
      const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
      text += letter ? static_cast<char>(c ^ 0x20) : c > ' ' && c < 0x7F ? c : '.';
    }
    return text;
  }

  int memory_ = open("/proc/self/mem", O_RDONLY | O_CLOEXEC);
  int pages_ = open("/proc/self/pagemap", O_RDONLY | O_CLOEXEC);
  std::byte* room_;
  std::size_t searched_bytes_ = 0;
};

}  // namespace relievo::test
