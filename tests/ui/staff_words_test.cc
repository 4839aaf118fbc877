// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers, dates and what the appliance says of itself, as each language writes them.
#include <gtest/gtest.h>

#include <string>

#include "hal/base/sentence.h"
#include "ui/screens/service/place_words.h"
#include "ui/screens/service/setting_words.h"
#include "ui/screens/service/staff_frame.h"
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

TEST_F(StaffWordsTest, BehindAColonFrenchAndSpanishGoOnSmall) {
  constexpr const char* kPhotograph =
      "that looks like a picture of a face: please look into the cameras yourself";
  EXPECT_TRUE(in(Language::French).said(kPhotograph, false).starts_with("cela ressemble"));
  EXPECT_TRUE(in(Language::Spanish).said(kPhotograph, false).starts_with("parece"));
  EXPECT_TRUE(in(Language::German).said(kPhotograph, false).starts_with("Das sieht"));
  EXPECT_TRUE(in(Language::English).said(kPhotograph, false).starts_with("that looks"));
  EXPECT_TRUE(in(Language::French).said(kPhotograph).starts_with("Cela")) << "a sentence of its own";
  StaffFrame page = in(Language::French);
  EXPECT_STREQ(page.continued("Échec"), "échec");
  for (const char* same : {"OpenCV a renoncé", "×", "où", "", "1 px"})
    EXPECT_STREQ(page.continued(same), same);
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

TEST_F(StaffWordsTest, ASentenceIsSaidWithItsValuesAndWhereItWas) {
  const std::string few = Sentence("only {} of {} pairs agree with each other", {"5", "14"}).packed();
  EXPECT_EQ(bare(in(Language::English).said(few)), "Only 5 of 14 pairs agree with each other");
  EXPECT_EQ(bare(in(Language::German).said(few)), "Nur 5 von 14 Paaren stimmen miteinander überein");
  const std::string moved =
      Sentence(Error{Errc::NotCalibrated, "a camera has moved since it was calibrated: calibrate again"}.at(
                   "2.47 px"))
          .packed();
  EXPECT_EQ(bare(in(Language::German).said(moved)),
            "Eine Kamera hat sich seit der Kalibrierung bewegt: Kalibrieren Sie neu (2,47 px)");
  const std::string arabic(in(Language::Arabic).said(moved));
  EXPECT_FALSE(arabic.starts_with("\u2068"))
      << "its own words tell the direction, not what stands behind them";
  EXPECT_EQ(in(Language::German).said(""), "");
  EXPECT_STREQ(in(Language::French).begun("écart"), "Écart");
  EXPECT_STREQ(in(Language::French).begun("à côté"), "À côté");
  for (const char* same : {"", "÷ 2", "ßig", "Écart", "2 px", "左"})
    EXPECT_STREQ(in(Language::French).begun(same), same);
  EXPECT_EQ(bare(in(Language::German).said("nobody translated {}\tthis")), "Nobody translated this");
}

TEST_F(StaffWordsTest, NoLineEndsBetweenAValueAndItsUnit) {
  StaffFrame page = in(Language::English);
  EXPECT_EQ(bare(page.filled("{} mm, {} % or {} mms at {} px", {"1", "2", "3", "4"})),
            "1\u00a0mm, 2\u00a0% or 3 mms at 4\u00a0px");
  EXPECT_EQ(bare(in(Language::German).filled("{} sr (um {})", {"1", "2"})), "1\u00a0sr (um 2)");
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
  for (const auto& [key, value] : {std::pair{"no_such", "1"}, std::pair{"language", "8"},
                                   std::pair{"patience_s", "30 s"}, std::pair{"patience_s", ""}})
    EXPECT_EQ(said_change(page, key, value), "") << key << value;
}

TEST_F(StaffWordsTest, TheLogSaysAChangedSettingInWords) {
  StaffFrame page = in(Language::German);
  page.begin("", nullptr);
  page.logged(
      {"2026-03-14 10:20:44", false, "setting patience_s is 30", "setting {} is {}", {"patience_s", "30"}});
  page.logged({"2026-03-14 10:20:44", false, "setting gone is 7", "setting {} is {}", {"gone", "7"}});
  page.end();
  std::string all;
  for (const Node& node : tree_.nodes()) all += bare(node.text) + "\n";
  EXPECT_NE(all.find(std::string("Einstellung „") + name_of(page.tr, Setting::PatienceS) + "“: 30\u00a0s"),
            std::string::npos)
      << all;
  EXPECT_EQ(all.find("patience_s"), std::string::npos);
  EXPECT_NE(all.find("Einstellung gone ist 7"), std::string::npos) << "an older version's";
}

TEST_F(StaffWordsTest, WherePartsAreWordsTheyAreSaid) {
  StaffFrame page = in(Language::German);
  const auto german = [&](std::string_view place) { return bare(said_place(page, place)); };
  EXPECT_EQ(german("serial 4061 → serial 4088"), "Seriennummer 4088 statt Seriennummer 4061");
  EXPECT_EQ(german("serial 1 → at /dev/a; at /dev/b → serial 2"),
            "links an /dev/a statt Seriennummer 1, rechts Seriennummer 2 statt an /dev/b");
  EXPECT_EQ(german("left picture"), "linkes Bild");
  EXPECT_EQ(german("2.47 px"), "2,47 px");
  for (const char* same : {"/dev/video0", "", "serial 4061", "left pictures", "mesher.grid", "zh.txt"})
    EXPECT_EQ(german(same), same);
}

TEST(SentenceTest, PackedItIsOneLine) {
  const Sentence said("the {} of {}", {"a\tb", "c\nd"});
  EXPECT_EQ(said.packed(), "the {} of {}\ta b\tc d");
  EXPECT_EQ(Sentence("two {}", {"1", "2"}).text(), "two 1 (2)");
  EXPECT_EQ(Sentence("none", {"here"}).text(), "none (here)");
  EXPECT_EQ(decimal(0.125, 2) + decimal(1.5, 1, true), "0.12+1.5");
}

}  // namespace
}  // namespace relievo::ui
