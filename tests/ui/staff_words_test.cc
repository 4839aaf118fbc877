// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers, dates and what the appliance says of itself, as each language writes them.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "ui/screens/service/staff_frame.h"
#include "ui/screens/service/technician/technician_frame.h"
#include "ui/view/staff_views.h"

namespace relievo::ui {
namespace {

class StaffWordsTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { ASSERT_TRUE(prepare_languages().has_value()); }
  StaffFrame in(Language language) {
    visit_.language = language;
    view_.service = &staff_;
    tree_.begin(info_of(language).right_to_left);
    return {tree_, view_, visit_, service_, kLight, Rect{0, 0, 1280, 800}};
  }
  // Without the marks that keep it apart from the direction of the words around.
  static std::string bare(std::string_view text) {
    std::string all(text);
    for (const char* mark : {"\u2066", "\u2068", "\u2069"}) {
      for (std::size_t at = all.find(mark); at != std::string::npos; at = all.find(mark))
        all.erase(at, std::string(mark).size());
    }
    return all;
  }

  Tree tree_;
  ViewState view_;
  Visit visit_;
  Service service_;
  ServiceView staff_;
};

TEST_F(StaffWordsTest, NumbersHaveTheMarkOfTheLanguageAndGroupsOfThree) {
  EXPECT_EQ(bare(in(Language::English).number(0.094, 3, "mm")), "0.094\u00a0mm");
  EXPECT_EQ(bare(in(Language::German).number(0.094, 3, "mm")), "0,094\u00a0mm");
  EXPECT_EQ(bare(in(Language::French).number(1048576)), "1\u202f048\u202f576");
  EXPECT_EQ(bare(in(Language::Spanish).number(9999)), "9999") << "four digits are read at once";
  EXPECT_EQ(bare(in(Language::Japanese).number(-12345.5, 1)), "\u221212\u202f345.5");
  EXPECT_EQ(bare(in(Language::German).number(-0.5, 1)), "\u22120,5");
}

TEST_F(StaffWordsTest, AnAngleStandsAtItsNumberATemperatureDoesNot) {
  EXPECT_EQ(bare(in(Language::English).number(90, 1, "°")), "90.0°");
  EXPECT_EQ(bare(in(Language::Arabic).number(-2.25, 2, "°")), "\u22122.25°");
  EXPECT_EQ(bare(in(Language::German).number(41.5, 1, "°C")), "41,5\u00a0°C");
  EXPECT_EQ(bare(in(Language::French).number(7, 0, "%")), "7\u00a0%");
}

TEST_F(StaffWordsTest, OnlyWhatIsANumberGetsTheMark) {
  StaffFrame page = in(Language::German);
  EXPECT_EQ(bare(page.as_number("+0.42")), "+0,42");
  EXPECT_EQ(bare(page.as_number("-6.0 px")), "\u22126,0 px");
  for (const char* same : {"", ".", "7", "1.", ".5", "1.2.3", "4.6.0-rc1", "serial 4.2", "sample-1"})
    EXPECT_EQ(page.as_number(same), same);
}

TEST_F(StaffWordsTest, DatesHaveTheOrderOfTheLanguage) {
  EXPECT_EQ(bare(in(Language::English).date("2026-03-14 09:12")), "2026-03-14\u00a009:12");
  EXPECT_EQ(bare(in(Language::German).date("2026-03-14 09:12")), "14.03.2026\u00a009:12");
  EXPECT_EQ(bare(in(Language::French).date("2026-03-14")), "14/03/2026");
  EXPECT_EQ(bare(in(Language::Chinese).date("2026-03-14")), "2026/03/14");
  for (const char* none : {"", "2026-03", "yesterday, at 9", "20x6-03-14"})
    EXPECT_EQ(in(Language::German).date(none), none);
}

// The code's sentence in the reader's language, and the detail as the engine wrote it, from left to right and
// quieter: whoever adds an error translates nothing.
TEST_F(StaffWordsTest, AnErrorNobodyKnowsIsSaidByItsCodeWithItsDetailInEnglish) {
  const Fault fault = fault_of(Error{Errc::MediaFull, "the flux is full: empty it"}.at("/flux"));
  for (const auto& [language, sentence] :
       {std::pair{Language::German, "Es ist kein Platz mehr"}, std::pair{Language::Arabic, "لم تبق مساحة"}}) {
    StaffFrame page = in(language);
    TechnicianView technician;
    technician.problem = fault;
    staff_.technician = &technician;
    page.begin("", nullptr);
    TechnicianFrame(page).problem(technician.problem);
    page.end();
    const Node *said = nullptr, *detail = nullptr;
    for (const Node& node : tree_.nodes()) {
      if (node.text == sentence) said = &node;
      if (node.text == "\u2066/flux: the flux is full: empty it\u2069") detail = &node;
    }
    ASSERT_NE(said, nullptr) << sentence;
    ASSERT_NE(detail, nullptr) << sentence;
    EXPECT_LT(said, detail) << "below it";
    EXPECT_STREQ(detail->style.language, "en");
    EXPECT_EQ(detail->style.size_px, in(Language::English).english("x", 17).style.size_px);
  }
}

TEST_F(StaffWordsTest, EveryCodeAndEveryEventHasASentenceOfItsOwn) {
  for (std::size_t l = 0; l < kLanguages; ++l) {
    const Words tr(static_cast<Language>(l));
    std::set<std::string> said;
    for (int code = 0; code < static_cast<int>(Errc::Count); ++code)
      EXPECT_TRUE(said.insert(words_of(tr, static_cast<Errc>(code))).second) << code;
    for (int event = 0; event < static_cast<int>(LogEvent::Count); ++event) {
      const LogWords words = words_of(tr, static_cast<LogEvent>(event));
      const char* role = words.role != nullptr ? words.role : "";
      EXPECT_TRUE(said.insert(std::string(words.pattern) + role).second) << event;
    }
    EXPECT_FALSE(said.contains(""));
  }
}

TEST_F(StaffWordsTest, NoLineEndsBetweenAValueAndItsUnit) {
  StaffFrame page = in(Language::English);
  EXPECT_EQ(bare(page.filled("{} mm, {} % or {} mms at {} px", {"1", "2", "3", "4"})),
            "1\u00a0mm, 2\u00a0% or 3 mms at 4\u00a0px");
  EXPECT_EQ(bare(in(Language::German).filled("{} sr (um {})", {"1", "2"})), "1\u00a0sr (um 2)");
}

// What a finger or a keypad was on is remembered by its id, longer than the page stands.
TEST_F(StaffWordsTest, NoIdHoldsTheCodeOfARecord) {
  const std::array rows{RecordRow{7, "Ada Lovelace", "2026-03-14 09:12", "4821-9037-5512-71", 1}};
  RecordsView records;
  records.rows = rows;
  staff_.records = &records;
  StaffFrame page = in(Language::English);
  page.begin("", nullptr);
  records_page(page);
  page.end();
  EXPECT_NE(tree_.find("record 7"), nullptr);
  for (const Node& node : tree_.nodes()) EXPECT_EQ(node.id.find(rows[0].code), std::string_view::npos);
}

// The log keeps a change by the setting's key; it is read as the settings page names it.
TEST_F(StaffWordsTest, AChangedSettingIsCalledAsOnItsPage) {
  for (std::size_t l = 0; l < kLanguages; ++l) {
    StaffFrame page = in(static_cast<Language>(l));
    for (std::size_t i = 0; i < kSettings; ++i) {
      const SettingInfo& info = info_of(static_cast<Setting>(i));
      for (const std::int32_t value : info.values) {
        const std::string figure = std::to_string(value), said = bare(said_change(page, info.key, figure));
        EXPECT_NE(said.find(name_of(page.tr, info.setting)), std::string::npos) << said;
        EXPECT_NE(said.find(bare(said_value(page, info.setting, value))), std::string::npos) << said;
        if (info.key.find('_') != std::string_view::npos) {
          EXPECT_EQ(said.find(info.key), std::string::npos) << said;
        }
      }
    }
  }
  StaffFrame page = in(Language::German);
  for (const auto& [key, value] :
       {std::pair{"no_such", std::string("1")}, std::pair{"language", std::to_string(kLanguages)},
        std::pair{"patience_s", std::string("30 s")}, std::pair{"patience_s", std::string()}})
    EXPECT_EQ(said_change(page, key, value), "") << key << value;
}

TEST_F(StaffWordsTest, TheLogSaysEventsAndFaultsInWords) {
  StaffFrame page = in(Language::German);
  page.begin("", nullptr);
  const auto changed = [](std::string_view key, std::string_view value) {
    return LogLine{"2026-03-14 10:20:44",    false,
                   "as in the file",         {},
                   LogEvent::SettingChanged, {std::string(key), std::string(value)}};
  };
  page.logged(changed("patience_s", "30"));
  page.logged(changed("gone", "7"));
  page.logged({"2026-03-14 10:20:44", false, "", {}, LogEvent::OperatorSignedIn, {}});
  page.logged({"2026-03-14 10:20:44", true, "the plug is out", Errc::Disconnected, {}, {}});
  page.logged({"2026-03-14 10:20:44", true, "of an older version", {}, {}, {}});
  page.end();
  std::string all;
  for (const Node& node : tree_.nodes()) all += bare(node.text) + "\n";
  for (const std::string& said :
       {std::string("Einstellung „") + name_of(page.tr, Setting::PatienceS) + "“: 30\u00a0s",
        std::string("Einstellung „gone“: 7"), std::string("Angemeldet: Betreuung"),
        std::string("Ein Gerät wurde abgezogen oder antwortet nicht\nthe plug is out"),
        std::string("\nof an older version")})
    EXPECT_NE(all.find(said), std::string::npos) << said << " in " << all;
  EXPECT_EQ(all.find("as in the file"), std::string::npos);
}

}  // namespace
}  // namespace relievo::ui
