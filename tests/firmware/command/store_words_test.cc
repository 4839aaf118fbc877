// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a person types to get a lost store back is nowhere on the stack of the command that has ended.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "firmware/command/commands.h"
#include "hal/base/wiped_text.h"
#include "hal/clock.h"
#include "tests/support/stack_search.h"

namespace relievo::firmware {
namespace {

#ifndef RELIEVO_SANITIZED

constexpr std::string_view kLastWord = "qvwordxz";

[[gnu::noinline]] void leave_the_word() {
  std::array<char, kLastWord.size()> word{};
  std::ranges::copy(kLastWord, word.begin());
  asm volatile("" : : "r"(word.data()) : "memory");  // written, though nobody reads it
}

// A store that no words open.
class NoStoreToKeep final : public storage::StoreKeeping {
 public:
  explicit NoStoreToKeep(bool& heard) : heard_(heard) {}
  Result<void> backup(const std::filesystem::path&) override { return refused(); }
  Result<std::vector<storage::SubjectId>> erased_since(const std::filesystem::path&) override {
    return refused();
  }
  Result<void> rekey(const storage::KeyPlace&) override { return refused(); }
  Result<std::vector<storage::SubjectId>> recover(std::string_view words) override {
    heard_ = words.find(kLastWord) != std::string_view::npos;
    return refused();
  }

 private:
  static Error refused() { return {Errc::InvalidInput, "as the test says"}; }
  bool& heard_;
};

TEST(StoreWords, AreNotLeftOnTheStackOfTheCommand) {
  std::vector<std::byte> disguised;
  for (const char letter : kLastWord)
    disguised.push_back(std::byte(static_cast<unsigned char>(letter)) ^ test::kStackDisguise);
  test::call_deep([] { leave_the_word(); });
  const int found = test::left_on_stack(disguised);
  EXPECT_GT(found, 0) << "it is not found where it is: this test shows nothing";
  wipe_stack();
  std::string typed;
  for (int word = 1; word < 12; ++word) typed += "aaa ";
  typed += std::string(kLastWord) + "\n";
  std::istringstream hand(typed);
  std::streambuf* const before = std::cin.rdbuf(hand.rdbuf());
  const hal::MonotonicClock clock;
  Console console;
  bool heard = false;
  Services services{.console = console, .clock = clock};
  services.keep_store = [&heard](const Path&) -> std::unique_ptr<storage::StoreKeeping> {
    return std::make_unique<NoStoreToKeep>(heard);
  };
  StoreArgs args;
  args.verb = StoreArgs::Verb::Recover;
  args.store = "/nowhere";
  bool done = true;
  test::call_deep([&] { done = run(args, services).has_value(); });
  const int left = test::left_on_stack(disguised);
  std::cin.rdbuf(before);
  EXPECT_FALSE(done);
  EXPECT_TRUE(heard);
  EXPECT_EQ(left, 0);
}

#endif

}  // namespace
}  // namespace relievo::firmware
