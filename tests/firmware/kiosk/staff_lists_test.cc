// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Long lists through their pages: turned, jumped in and filtered, on a real store and a real log, by fingers
// and by a keypad.
#include <array>

#include "firmware/base/budget.h"
#include "tests/firmware/kiosk/staff_hands.h"
#include "tests/support/faulty_store.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {
namespace {

class StaffListsTest : public StaffHands {
 protected:
  static constexpr int kPeople = 120;  // three pages
  void fill_the_store() {
    auto store = storage::open_sqlite_store(args.store, wall(), {});
    ASSERT_TRUE(store.has_value());
    for (int i = 1; i <= kPeople; ++i)
      ASSERT_TRUE((*store)->add_subject({(i % 2 == 0 ? "Anna " : "Otto ") + std::to_string(i)}).has_value());
  }
  const ui::RecordsView& records() const { return *kiosk->view().service->records; }
  bool shows_first(const std::string& name) {
    return until([&] { return !records().rows.empty() && records().rows[0].name == name; });
  }
  void open_the_records() {
    fill_the_store();
    start();
    first_start();
    sign_in("80526", StaffRole::Operator);
    tap("open records");
    ASSERT_TRUE(until([this] { return kiosk->view().service->records != nullptr; }));
    ASSERT_TRUE(shows_first("Anna 120"));
  }
};

TEST_F(StaffListsTest, RecordsAreTurnedAndJumpedInAlsoWhereSomebodyWasSearchedFor) {
  open_the_records();
  EXPECT_EQ(records().place.pages, 3);
  EXPECT_EQ(find("page back"), nullptr) << "there is none before the first";
  EXPECT_TRUE(records().rows.front().since.ends_with(" UTC")) << "as the clock and the log tell it";
  tap("last page");
  ASSERT_TRUE(shows_first("Anna 20"));
  EXPECT_EQ(records().rows.size(), 20U);
  EXPECT_EQ(find("page on"), nullptr);
  tap("page back");
  ASSERT_TRUE(shows_first("Anna 70"));
  // By a keypad, to the third page.
  tap("page number");
  ASSERT_TRUE(until([this] { return find("stretch 2") != nullptr; }));
  EXPECT_EQ(records().place.stretches[2].label.substr(0, 2), "20") << "the date at its top";
  focus_on("stretch 2");
  kiosk->feed({ui::Input::Kind::Activate});
  kiosk->turn();
  ASSERT_TRUE(shows_first("Anna 20"));
  EXPECT_EQ(kiosk->ui().service().mode, 0) << "the list again";
  // Back out of the jump: nothing has moved.
  tap("page number");
  ASSERT_NE(find("stretches"), nullptr);
  tap("back");
  EXPECT_EQ(find("stretches"), nullptr);
  EXPECT_EQ(records().rows[0].name, "Anna 20");
  // Half of them are found: two pages, from the first on.
  tap("search");
  for (const char* key : {"key o", "key t", "key t"}) tap(key);
  tap("done");
  ASSERT_TRUE(shows_first("Otto 119"));
  EXPECT_EQ(records().place.page, 0);
  EXPECT_EQ(records().place.pages, 2);
  tap("last page");
  ASSERT_TRUE(until([this] { return records().rows.size() == 10; }));
  EXPECT_EQ(records().rows.back().name, "Otto 1");
  tap("all");
  ASSERT_TRUE(shows_first("Anna 120"));
  EXPECT_EQ(records().place.pages, 3);
  // Digits that nobody's name has are a code, or a part of one.
  for (const bool code : {true, false}) {
    tap("search");
    for (int i = 0; i < 4; ++i) tap("key 4");
    if (!code) tap("key x");
    tap("done");
    ASSERT_TRUE(until([this] { return records().rows.empty() && find("nobody") != nullptr; }));
    EXPECT_EQ(says("No record has this code"), code);
    EXPECT_EQ(says("There is nobody of that name"), !code);
    tap("all");
    ASSERT_TRUE(shows_first("Anna 120"));
  }
}

TEST_F(StaffListsTest, RecordsAreFilteredByTheFirstLetterAndByTheTextAgreedTo) {
  fill_the_store();
  enrol("ole", "2025-11");
  enrol("Örjan", "2026-03");
  start();
  first_start();
  sign_in("80526", StaffRole::Operator);
  tap("open records");
  ASSERT_TRUE(until([this] { return kiosk->view().service->records != nullptr; }));
  ASSERT_TRUE(shows_first("Örjan"));
  tap("filter");
  ASSERT_TRUE(until([this] { return find("filter 5") != nullptr; }));
  const auto& filters = records().filters;
  ASSERT_EQ(filters.size(), 5U);
  const std::array<std::string_view, 5> kThere{"2025-11", "2026-03", "A", "O", "Ö"};
  for (std::size_t i = 0; i < kThere.size(); ++i) {
    EXPECT_EQ(filters[i].text, kThere[i]);
    EXPECT_EQ(filters[i].letter, i > 1) << i;
  }
  tap("filter 4");
  ASSERT_TRUE(shows_first("ole")) << "small letters, too";
  EXPECT_EQ(records().place.pages, 2);
  tap("last page");
  ASSERT_TRUE(until([this] { return records().rows.size() == 11; }));
  EXPECT_EQ(records().rows.back().name, "Otto 1");
  tap("page number");
  ASSERT_TRUE(until([this] { return find("stretch 1") != nullptr; }));
  tap("stretch 0");
  ASSERT_TRUE(shows_first("ole"));
  tap("filter");
  tap("filter 2");
  ASSERT_TRUE(shows_first("Örjan")) << "who agreed to the second text";
  EXPECT_EQ(records().rows.size(), 1U);
  tap("search");
  for (const char* key : {"key a", "key n", "key n"}) tap(key);
  tap("done");
  ASSERT_TRUE(shows_first("Anna 120"));
  EXPECT_EQ(records().place.filter, 0U) << "one searches, or filters";
  EXPECT_EQ(find("filter"), nullptr);
  tap("all");
  ASSERT_TRUE(shows_first("Örjan"));
}

// Whose records are opened one by one, as many as a test allows.
class SlowStore final : public test::FaultyStore {
 public:
  SlowStore(std::unique_ptr<storage::Store> real, const std::atomic<std::optional<Errc>>& error,
            std::atomic<int>& allowed)
      : FaultyStore(std::move(real), error), allowed_(allowed) {}
  Result<void> for_each_subject(Opened opened, const Visit& visit) override {
    int read = 0;
    return FaultyStore::for_each_subject(
        opened, [&](storage::Subject& subject, const storage::Consent* newest) -> Result<void> {
          ++read;
          for (int allowed = allowed_; allowed < read; allowed = allowed_) allowed_.wait(allowed);
          return visit(subject, newest);
        });
  }

 private:
  std::atomic<int>& allowed_;
};

class StaffSearchTest : public StaffListsTest {
 protected:
  StaffSearchTest() {
    changes.clock = &time;
    services.open_store = [this](const Path& at, bool) -> Result<std::unique_ptr<storage::Store>> {
      RELIEVO_TRY_ASSIGN(auto real, storage::open_sqlite_store(at, wall(), {}));
      return std::unique_ptr<storage::Store>(std::make_unique<SlowStore>(std::move(real), none, allowed));
    };
  }
  void TearDown() override {
    read(kPeople);
    StaffListsTest::TearDown();
  }
  void search() {
    open_the_records();
    tap("search");
    for (const char* key : {"key t", "key t", "key o"}) tap(key);
    tap("done");
  }
  void read(int records) {
    allowed = records;
    allowed.notify_all();
  }
  bool is_at(float share) {
    return until([&] { return kiosk->view().service->work.progress >= share; });
  }
  bool signed_in() { return kiosk->view().service->role == StaffRole::Operator; }

  const std::atomic<std::optional<Errc>> none{};
  std::atomic<int> allowed{0};
  hal::ManualClock time;
};

TEST_F(StaffSearchTest, WhoSearchesForLongSeesHowFarItIs) {
  search();
  read(kPeople / 4);
  ASSERT_TRUE(is_at(0.25F));
  kiosk->turn();
  EXPECT_EQ(find("look progress"), nullptr) << "a short one is not worth a word";
  time.advance(std::chrono::seconds(1));
  kiosk->turn();
  ASSERT_NE(find("look progress"), nullptr);
  EXPECT_NE(find("look progress")->value.find("25"), std::string_view::npos) << find("look progress")->value;
  EXPECT_EQ(records().rows[0].name, "Anna 120") << "until there is something new";
  read(kPeople);
  ASSERT_TRUE(shows_first("Otto 119"));
  kiosk->turn();
  EXPECT_EQ(find("look progress"), nullptr);
  // What there is to choose among is read for as long.
  tap("all");
  ASSERT_TRUE(shows_first("Anna 120"));
  read(kPeople / 2);
  tap("filter");
  ASSERT_TRUE(is_at(0.5F));
  time.advance(std::chrono::seconds(1));
  kiosk->turn();
  ASSERT_NE(find("look progress"), nullptr);
}

TEST_F(StaffSearchTest, WhoSearchesForLongIsNotSignedOutUntilItStands) {
  search();
  const std::chrono::seconds patience(kiosk->staff().settings().of(ui::Setting::StaffPatienceS));
  // Longer than the machine's Staff lasts, too.
  for (const int records : {20, 40, 60, 80, 100}) {
    read(records);
    ASSERT_TRUE(is_at(float(records) / kPeople));
    kiosk->turn();
    time.advance(patience - std::chrono::seconds(1));
    kiosk->turn();
    ASSERT_TRUE(signed_in()) << records;
  }
  ASSERT_GT(5 * (patience - std::chrono::seconds(1)), budget::kStaffLimit);
  time.advance(std::chrono::seconds(1));
  kiosk->turn();
  kiosk->turn();
  EXPECT_FALSE(signed_in()) << "nothing has come of it since: who has gone leaves nobody's page open";
}

TEST_F(StaffListsTest, TheLogGoesBackToItsFirstLineAndShowsFaultsAlone) {
  start();
  first_start();
  EventLog& log = const_cast<EventLog&>(kiosk->staff().log());
  for (int i = 0; i < 90; ++i) log.say(ui::LogEvent::RecordErased, {std::to_string(i)});
  log.fault({Errc::Disconnected, "as the test says"});
  for (int i = 90; i < 100; ++i) log.say(ui::LogEvent::RecordErased, {std::to_string(i)});
  sign_in("4711", StaffRole::Technician);
  tap("open log");
  const auto& seen = [this]() -> const ui::LogView& { return *kiosk->view().service->log; };
  EXPECT_GE(seen().place.pages, 3);
  tap("last page");
  EXPECT_EQ(seen().lines.back().event, ui::LogEvent::Started) << "its first line";
  tap("page number");
  tap("stretch 0");
  EXPECT_EQ(seen().place.page, 0);
  tap("filter");
  tap("filter 1");
  ASSERT_EQ(seen().lines.size(), 1U);
  EXPECT_EQ(seen().lines[0].code, Errc::Disconnected);
  EXPECT_EQ(find("page number"), nullptr) << "one page has no others";
  tap("filter");
  tap("filter 0");
  EXPECT_GE(seen().place.pages, 3);
}

}  // namespace
}  // namespace relievo::firmware
