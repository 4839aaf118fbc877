// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a person types to get a lost store back: it is taken as the sheet has it, and is nowhere on the stack
// of the command that has ended.
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

// A store that no words open.
class NoStoreToKeep final : public storage::StoreKeeping {
 public:
  explicit NoStoreToKeep(std::string& heard) : heard_(heard) {}
  Result<void> backup(const std::filesystem::path&) override { return refused(); }
  Result<std::vector<storage::SubjectId>> erased_since(const std::filesystem::path&) override {
    return refused();
  }
  Result<void> rekey(const storage::KeyPlace&) override { return refused(); }
  Result<std::vector<storage::SubjectId>> recover(std::string_view words) override {
    heard_ = words;
    return refused();
  }

 private:
  static Error refused() { return {Errc::InvalidInput, "as the test says"}; }
  std::string& heard_;
};

// What the store is asked to be recovered by, when that is typed. The command is run by `call`.
template <typename Call>
std::string heard_of(const std::string& typed, const Call& call) {
  std::istringstream hand(typed);
  std::streambuf* const before = std::cin.rdbuf(hand.rdbuf());
  const hal::MonotonicClock clock;
  Console console;
  std::string heard;
  Services services{.console = console, .clock = clock};
  services.keep_store = [&heard](const Path&) -> std::unique_ptr<storage::StoreKeeping> {
    return std::make_unique<NoStoreToKeep>(heard);
  };
  StoreArgs args;
  args.verb = StoreArgs::Verb::Recover;
  args.store = "/nowhere";
  bool done = true;
  call([&] { done = run(args, services).has_value(); });
  EXPECT_FALSE(done);
  std::cin.rdbuf(before);
  std::cin.clear();
  return heard;
}

TEST(StoreWords, AreTakenAsTheSheetHasThem) {
  const auto call = [](const auto& work) { work(); };
  const std::string plain = "a b c d e f g h i j k l ";
  EXPECT_EQ(heard_of("a b c d e f\ng h i j\nk l\n", call), plain);
  std::string sheet;
  for (int word = 1; word <= 12; ++word)
    sheet += std::to_string(word) + ". " + std::string(1, char('a' + word - 1)) + "\n";
  EXPECT_EQ(heard_of(sheet, call), plain);
  EXPECT_EQ(heard_of("a b c d e f g h i j k l m\n", call), plain + "m ") << "one too many is not left out";
}

#ifndef RELIEVO_SANITIZED

constexpr std::string_view kLastWord = "qvwordxz";

[[gnu::noinline]] void leave_the_word() {
  std::array<char, kLastWord.size()> word{};
  std::ranges::copy(kLastWord, word.begin());
  asm volatile("" : : "r"(word.data()) : "memory");  // written, though nobody reads it
}

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
  int left = -1;
  const std::string heard = heard_of(typed, [&](const auto& work) {
    test::call_deep(work);
    left = test::left_on_stack(disguised);
  });
  EXPECT_NE(heard.find(kLastWord), std::string::npos);
  EXPECT_EQ(left, 0);
}

#endif

}  // namespace
}  // namespace relievo::firmware
