// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The recovery sheet at the screen: shown until two of its words were typed, and then never again.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory_resource>
#include <vector>

#include "firmware/kiosk/code/qr_code.h"
#include "storage/store.h"
#include "tests/firmware/kiosk/staff_hands.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {
namespace {

class StaffRecovery : public StaffHands {
 protected:
  void sign_in_to(const char* pin, StaffPage page) {
    if (!kiosk->ui().service().open) knock();
    type_pin(pin);
    ASSERT_TRUE(until(
        [&] { return kiosk->ui().service().page == page && kiosk->appliance().state() == State::Staff; }));
    kiosk->turn();
  }
  std::vector<std::string> sheet() {
    std::vector<std::string> words;
    if (const ui::RecoveryView* seen = kiosk->view().service->recovery)
      for (const std::string_view word : seen->words) words.emplace_back(word);
    return words;
  }
  int asked() { return kiosk->view().service->recovery->asked; }
  void type_word(const std::string& word) {
    for (const char letter : word) {
      const std::string small = std::string("key ") + letter,
                        large = std::string("key ") + static_cast<char>(letter - 32);
      tap(find(small) != nullptr ? small : large);
    }
    tap("done");
  }
  bool kept() const {
    auto store = storage::open_sqlite_store(args.store, wall(), {.mode = storage::OpenMode::ReadOnly});
    EXPECT_TRUE(store.has_value());
    return *(*store)->has_recovery_words();
  }
};

TEST_F(StaffRecovery, ComesFirstBeforeRealPeopleUntilTwoOfItsWordsWereTyped) {
  changes.live = true;
  start();
  kiosk->turn();
  choose_pins();
  sign_in_to("4711", StaffPage::Menu);
  EXPECT_EQ(find("open recovery"), nullptr) << "the operator's";
  sign_out();

  sign_in_to("80526", StaffPage::Recovery);
  const auto first = sheet();
  ASSERT_EQ(first.size(), 12U);
  for (const std::string& word : first) EXPECT_TRUE(says(word)) << word;
  std::string all;
  for (const std::string& word : first) all += (all.empty() ? "" : " ") + word;
  EXPECT_EQ(read_code(kiosk->view().service->recovery->code.pixels), all);
  tap("back");
  EXPECT_EQ(kiosk->ui().service().page, StaffPage::Menu) << "later";
  EXPECT_EQ(sheet().size(), 0U);
  EXPECT_FALSE(kept());
  sign_out();

  sign_in_to("80526", StaffPage::Recovery);
  const auto words = sheet();
  ASSERT_EQ(words.size(), 12U);
  EXPECT_NE(words, first) << "what was left is worth nothing";
  tap("written");
  const int one = asked();
  type_word("zebra");
  EXPECT_TRUE(says("That was not right."));
  EXPECT_EQ(asked(), one);
  type_word(words[static_cast<std::size_t>(one - 1)]);
  const int other = asked();
  EXPECT_NE(other, one);
  EXPECT_FALSE(kept());
  type_word(words[static_cast<std::size_t>(other - 1)]);
  ASSERT_TRUE(until([this] { return kiosk->view().service->recovery->state == ui::SheetState::Done; }));
  EXPECT_TRUE(kept());
  kiosk->turn();
  EXPECT_EQ(sheet().size(), 0U) << "never again";
  // One of them may be a usual word that the page has, too.
  EXPECT_LT(std::ranges::count_if(words, [&](const std::string& word) { return says(word); }), 4);
  tap("go on");
  EXPECT_EQ(kiosk->ui().service().page, StaffPage::Menu);
  EXPECT_EQ(find("open recovery"), nullptr);
  sign_out();
  sign_in_to("80526", StaffPage::Menu);
  sign_out();
  kiosk.reset();

  // They open the store whose key is lost.
  all.clear();
  for (const std::string& word : words) all += word + " ";
  std::filesystem::remove(args.store / "relievo.key");
  EXPECT_FALSE(storage::open_sqlite_store(args.store, wall(), {}));
  ASSERT_TRUE(storage::keep_sqlite_store(args.store, wall(), {})->recover(all));
  EXPECT_TRUE(storage::open_sqlite_store(args.store, wall(), {}));
}

TEST_F(StaffRecovery, ADeviceThatPlaysOffersItInTheMenu) {
  start();
  first_start();
  sign_in("80526", StaffRole::Operator);
  tap("open recovery");
  kiosk->turn();
  EXPECT_EQ(sheet().size(), 12U);
}

}  // namespace
}  // namespace relievo::firmware
