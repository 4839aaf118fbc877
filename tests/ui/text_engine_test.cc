// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/text/text_engine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "ui/text/pango_paragraph.h"

namespace relievo::ui {
namespace {

class TextEngineTest : public testing::Test {
 protected:
  void SetUp() override {
    auto made = TextEngine::make();
    ASSERT_TRUE(made.has_value()) << made.error().what.view();
    engine = std::move(*made);
  }
  // Where the ink of a label is densest, left to right, 0 to 1.
  double ink_middle(const TextLabel& label) const {
    double sum = 0, weighted = 0;
    for (int y = 0; y < static_cast<int>(label.atlas.h); ++y) {
      const std::uint8_t* row =
          engine->atlas().row(static_cast<int>(label.atlas.x), static_cast<int>(label.atlas.y) + y);
      for (int x = 0; x < static_cast<int>(label.atlas.w); ++x) sum += row[x], weighted += row[x] * (x + 0.5);
    }
    return sum > 0 ? weighted / sum / label.atlas.w : -1;
  }
  std::unique_ptr<TextEngine> engine;
};

TEST_F(TextEngineTest, EveryScriptHasItsLetters) {
  for (const char* text : {"Grüße, ẞ", "العربية ١٢٣", "עברית", "简体中文", "日本語", "Ελληνικά"}) {
    const TextLabel& label = engine->label(text, {}, 800);
    EXPECT_EQ(label.missing, 0) << text;
    EXPECT_GT(ink_middle(label), 0) << text;
  }
  EXPECT_GT(engine->label("\U000F1234", {}, 800).missing, 0) << "a letter nobody has";
}

TEST_F(TextEngineTest, ArabicIsJoinedNotSpelt) {
  const float whole = engine->measure("سلام", {}, 800).width_px;
  float spelt = 0;
  for (const char* letter : {"س", "ل", "ا", "م"}) spelt += engine->measure(letter, {}, 800).width_px;
  EXPECT_LT(whole, 0.8F * spelt);
}

TEST_F(TextEngineTest, NoWordStandsAlone) {
  const TextStyle style;
  const std::string text = "Two cameras look at you for a moment and then a word";
  for (float width = 200; width < 700; width += 37) {
    const TextSize size = engine->measure(text, style, width);
    EXPECT_LE(size.width_px, width + 1);
    if (size.lines > 1) {
      EXPECT_GT(size.width_px * static_cast<float>(size.lines),
                0.9F * engine->measure(text, style, 5000).width_px);
      // Even lines: the box is not much wider than its share.
      EXPECT_LT(size.width_px,
                1.45F * engine->measure(text, style, 5000).width_px / static_cast<float>(size.lines))
          << width;
    }
  }
}

// A soft hyphen shows, and has a width, only where its word has to end a line; evening out lines uses none.
TEST_F(TextEngineTest, SoftHyphensSayWhereAWordMayBreakAndOnlyWhereItMust) {
  const std::string word = "Appa\u00adrie\u00adments";
  const float whole = engine->measure("Appariements", {}, 5000).width_px;
  const TextLabel& free = engine->label(word, {}, 5000);
  EXPECT_EQ(free.missing, 0);
  EXPECT_EQ(free.size.lines, 1);
  EXPECT_FLOAT_EQ(free.size.width_px, whole);
  const TextSize tight = engine->measure(word, {}, 0.95F * whole);
  EXPECT_EQ(tight.lines, 2);
  EXPECT_NEAR(tight.width_px, engine->measure("Apparie-", {}, 5000).width_px, 2);
  const TextSize even = engine->measure(word + " unis", {}, whole + 4);
  EXPECT_EQ(even.lines, 2);
  EXPECT_NEAR(even.width_px, whole, 2);
}

std::vector<std::string> phrases(const std::string& text, bool japanese) {
  std::vector<std::string> all;
  std::size_t from = 0;
  for (const std::size_t to : phrase_starts(text, japanese))
    all.push_back(text.substr(from, to - from)), from = to;
  all.push_back(text.substr(from));
  return all;
}

TEST(Phrases, SentencesBeginBehindWhatEndsOne) {
  using Starts = std::vector<std::size_t>;
  EXPECT_EQ(sentence_starts("Thank you. Your portrait is stored"), Starts{11});
  EXPECT_EQ(sentence_starts("Is it you? Yes! 3.5 mm, e.g.x"), (Starts{11, 16}));
  EXPECT_EQ(sentence_starts("شكرًا. حُفظت"), Starts{std::string_view("شكرًا. ").size()});
  EXPECT_TRUE(sentence_starts("One sentence.").empty());
  EXPECT_TRUE(sentence_starts("").empty());
}

TEST(Phrases, AreWhatIsReadInOneBreath) {
  using Words = std::vector<std::string>;
  EXPECT_EQ(phrases("正面を見て動かないでください", true), (Words{"正面を", "見て", "動かないでください"}));
  EXPECT_EQ(phrases("ここに入力、またはQRコードを提示", true),
            (Words{"ここに", "入力、", "または", "QRコードを", "提示"}));
  EXPECT_EQ(phrases("するかどうかをお決めください。撮り直す", true),
            (Words{"するかどうかを", "お決めください。", "撮り直す"}));
  EXPECT_EQ(phrases("触れると「はじめる」です", true), (Words{"触れると", "「はじめる」", "です"}));
  EXPECT_EQ(phrases("動かずにもう一度お願いします。", true),
            (Words{"動かずに", "もう一度", "お願いします。"}));
  EXPECT_EQ(phrases("続きました。あと300秒で", true), (Words{"続きました。", "あと300秒で"}));
  EXPECT_EQ(phrases("記録には何も保存されません", true), (Words{"記録には", "何も保存されません"}));
  EXPECT_EQ(phrases("很好。请目视前方，保持不动", false), (Words{"很好。", "请目视前方，", "保持不动"}));
  EXPECT_EQ(phrases("", true), Words{""});
}

// Where it costs no line, a line ends with a phrase; a column too narrow for one is still filled.
TEST_F(TextEngineTest, ChineseAndJapaneseBreakBetweenPhrases) {
  const struct {
    const char* language;
    const char* text;
    const char* longest;
  } cases[] = {{"ja", "そのままです。正面を見て動かないでください", "見て動かないでください"},
               {"zh-Hans", "很好。请目视前方，保持不动", "很好。请目视前方，"}};
  for (const auto& one : cases) {
    TextStyle style;
    style.language = one.language;
    const float longest = engine->measure(one.longest, style, 5000).width_px;
    const TextSize size = engine->measure(one.text, style, 1.02F * longest + 4);
    EXPECT_EQ(size.lines, 2) << one.text;
    EXPECT_NEAR(size.width_px, longest, 3) << one.text;
    EXPECT_LE(engine->measure(one.text, style, 60).width_px, 61) << one.text;
  }
}

TEST(Phrases, FillLinesFullOrEvenly) {
  using Starts = std::vector<std::size_t>;
  const std::vector<float> widths = {40, 30, 20, 10, 60};
  EXPECT_EQ(fill_lines(widths, 100, false), (Starts{4})) << "40 30 20 10 | 60";
  EXPECT_EQ(fill_lines(widths, 100, true), (Starts{3})) << "40 30 20 | 10 60";
  EXPECT_EQ(fill_lines(widths, 65, true), (Starts{1, 4})) << "40 | 30 20 10 | 60";
  EXPECT_EQ(fill_lines(widths, 200, true), Starts{});
  EXPECT_EQ(fill_lines(widths, 15, true), (Starts{1, 2, 3, 4})) << "each too wide: a line of its own";
  EXPECT_EQ(fill_lines({}, 15, true), Starts{});
}

// Whatever an operator writes in a heading and whoever's name stands in it: every language, both directions
// mixed, every width. Pango itself ended the program at some of these when it was told where it must not
// break.
TEST_F(TextEngineTest, HeadingsOfMixedScriptsAreSetAtEveryWidth) {
  const char* const texts[] = {"תודה, Ada-Marie Lovelace-Byron. הדיוקן שלכם נשמר.",
                               "שלום! Portrait 3D של أحمد بن يوسف. הבט קדימה?",
                               "شكرًا يا Grace Hopper. حُفظت صورتك (ID-148 220).",
                               "Thank you, أحمد بن عبد الله. Your portrait is stored. 谢谢。",
                               "ありがとうございます、Ada Lovelaceさん。אברהם様の「肖像」は保存されました。",
                               "谢谢，محمد。您的 3D 肖像（第 2 版）已保存。",
                               "Donau­dampf­schiff­fahrts­gesell­schaft. ב",
                               "A. B. C! D? E. \u2067א. ב.\u2069 \u2066c. d.\u2069",
                               ". . ? ! .",
                               "x. \u202eabc. def\u202c. y",
                               "\u2028. \u2029. a\n. b. c"};
  for (const char* language : {"en", "ar", "he", "zh-Hans", "ja"}) {
    for (const Weight weight : {Weight::Regular, Weight::Bold}) {
      TextStyle style;
      style.language = language;
      style.weight = weight;
      style.size_px = 40;
      style.right_to_left = std::string_view(language) == "ar" || std::string_view(language) == "he";
      for (const char* text : texts) {
        const float whole = engine->measure(text, style, 5000).width_px;
        for (float width = 30; width < whole + 40; width += 17) {
          const TextSize size = engine->measure(text, style, width);
          EXPECT_GE(size.lines, 1);
          EXPECT_TRUE(size.lines > 1 || size.width_px <= width + 1) << text << ' ' << width;
        }
      }
    }
  }
}

// Two lines end the first with its sentence where both fit, in either direction.
TEST_F(TextEngineTest, TwoLinesArePartedBetweenTheirSentences) {
  for (const bool right_to_left : {false, true}) {
    TextStyle style;
    style.weight = Weight::Bold;
    style.right_to_left = right_to_left;
    style.language = right_to_left ? "he" : "en";
    const std::string first = right_to_left ? "תודה." : "Thank you.",
                      second = right_to_left ? "הדיוקן שלכם נשמר במכשיר הזה"
                                             : "Your portrait is stored on this kiosk";
    const float longest = engine->measure(second, style, 5000).width_px;
    const TextSize size = engine->measure(first + " " + second, style, longest + 8);
    EXPECT_EQ(size.lines, 2);
    EXPECT_NEAR(size.width_px, longest, 2);
  }
}

TEST_F(TextEngineTest, InkLiesInsideTheBox) {
  for (const bool right_to_left : {false, true}) {
    for (const TextAlign align : {TextAlign::Start, TextAlign::Centre}) {
      TextStyle style;
      style.right_to_left = right_to_left;
      style.align = align;
      const TextLabel& label = engine->label(right_to_left ? "يستغرق ذلك حوالي دقيقة واحدة. نصنع صورة"
                                                           : "It takes about a minute. We make a picture",
                                             style, 260);
      EXPECT_GT(label.size.lines, 1);
      EXPECT_GE(label.ink.x, -3) << right_to_left;
      EXPECT_LE(label.ink.right(), label.size.width_px + 4) << right_to_left;
      EXPECT_LE(label.ink.bottom(), label.size.height_px + 4);
    }
  }
}

// "148 220" stays "148 220" in a line of Arabic: isolated, its digits keep their order.
TEST_F(TextEngineTest, NumbersKeepTheirOrderInArabic) {
  TextStyle style;
  style.right_to_left = true;
  const TextLabel in_order = engine->label("\u2068111\u00a0888\u2069", style, 800);
  const double heavy_right = ink_middle(in_order);
  const TextLabel reversed = engine->label("\u2068888\u00a0111\u2069", style, 800);
  EXPECT_GT(heavy_right, ink_middle(reversed) + 0.1) << "888 has more ink than 111";
}

// The page tells the direction of a paragraph, whatever stands in it: names, figures and what is isolated are
// no words from which it could be read.
TEST_F(TextEngineTest, ALabelWithoutALetterOfItsScriptStillRunsFromTheRight) {
  TextStyle from_right, from_left;
  from_right.right_to_left = true;
  for (const char* text :
       {"\u2066MMMM\u2069 \u2066i\u2069", "\u2068MMMM\u2069 \u2068i\u2069", "\u2066MMMM\u2069: \u20661\u2069",
        "\u2066MMMM\u2069 ———", "MMMM ———", "8888 ———"}) {
    EXPECT_GT(ink_middle(engine->label(text, from_right, 800)),
              ink_middle(engine->label(text, from_left, 800)) + 0.05)
        << text << ": what comes first stands on the right";
  }
  // Of one run its letters keep their order.
  EXPECT_LT(ink_middle(engine->label("MMMM i", from_right, 800)), 0.5);
  EXPECT_LT(ink_middle(engine->label("\u2066MMMM i\u2069", from_right, 800)), 0.5);
  // Divided, each line runs so.
  const TextLabel divided = engine->label(
      "\u2066MMMMMMMM\u2069 \u2066iiiiiiii\u2069 \u2066MMMMMMMM\u2069 \u2066iiiiiiii\u2069", from_right, 300);
  EXPECT_EQ(divided.size.lines, 2);
  EXPECT_GT(ink_middle(divided), 0.5);
}

TEST_F(TextEngineTest, AFullAtlasStartsAnew) {
  const std::uint32_t before = engine->atlas().generation();
  TextStyle style;
  style.size_px = 90;
  for (int i = 0; i < 200; ++i) (void)engine->label("number " + std::to_string(i), style, 2000);
  EXPECT_GT(engine->atlas().generation(), before);
  EXPECT_GT(ink_middle(engine->label("number 3", style, 2000)), 0.1) << "written again";
}

// Seen through a window that moves over it, a text that is larger than the atlas is the same as its lines
// written one by one.
TEST_F(TextEngineTest, ATextLargerThanTheAtlasIsWrittenWhereItIsSeen) {
  TextStyle style;
  style.size_px = 60;
  constexpr int kLines = 60;
  constexpr float kWidth = 3000, kWindow = 400;
  std::string text;
  const auto words_of = [](int line) {
    return std::string(90, char('A' + line % 26)) + std::to_string(line);
  };
  for (int i = 0; i < kLines; ++i) text += (i > 0 ? "\n" : "") + words_of(i);
  const float high = engine->measure(text, style, 1e5F).height_px;
  const float wide = engine->measure(text, style, 1e5F).width_px;
  ASSERT_GT(high, 2.0F * float(engine->atlas().side_px()));
  ASSERT_GT(wide, kWidth);
  std::vector<double> ink(kLines, 0), by_row;
  for (float top = 0; top < high; top += kWindow) {
    const Rect seen{-10, top, wide + 20, kWindow};
    const std::uint32_t before = engine->atlas().generation();
    (void)engine->pieces(text, style, 1e5F, seen);
    const std::uint32_t between = engine->atlas().generation();
    const auto pieces = engine->pieces(text, style, 1e5F, seen);
    EXPECT_LE(between, before + 1);
    EXPECT_EQ(engine->atlas().generation(), between) << "one window has room, as a page's second round";
    std::vector<double> rows(std::size_t(kWindow), 0);
    for (const TextPiece& piece : pieces) {
      const bool meets = piece.ink.y < seen.bottom() && piece.ink.bottom() > seen.y;
      EXPECT_TRUE(!meets || piece.atlas.w > 0) << "seen, and not written";
      if (piece.atlas.w <= 0) continue;
      EXPECT_EQ(piece.atlas.w, piece.ink.w);
      EXPECT_EQ(piece.atlas.h, piece.ink.h);
      for (int y = 0; y < int(piece.ink.h); ++y) {
        const int at = int(piece.ink.y) + y - int(top);
        if (at < 0 || at >= int(kWindow)) continue;
        const std::uint8_t* row = engine->atlas().row(int(piece.atlas.x), int(piece.atlas.y) + y);
        for (int x = 0; x < int(piece.ink.w); ++x) rows[std::size_t(at)] += row[x];
      }
    }
    by_row.insert(by_row.end(), rows.begin(), rows.end());
  }
  const double apart = double(high - engine->measure("A", style, 1e5F).height_px) / (kLines - 1);
  for (std::size_t y = 0; y < by_row.size(); ++y)
    ink[std::min<std::size_t>(kLines - 1, std::size_t(double(y) / apart))] += by_row[y];
  for (int i = 0; i < kLines; ++i) {
    const TextLabel& one = engine->label(std::string(10, char('A' + i % 26)), style, 1e5F);
    double alone = 0;
    for (int y = 0; y < int(one.atlas.h); ++y)
      for (int x = 0; x < int(one.atlas.w); ++x)
        alone += *engine->atlas().row(int(one.atlas.x) + x, int(one.atlas.y) + y);
    EXPECT_GT(ink[std::size_t(i)], 8.5 * alone) << "line " << i << " misses letters";
    EXPECT_LT(ink[std::size_t(i)], 11.5 * alone) << "line " << i << " has others' letters";
  }
}

TEST_F(TextEngineTest, ForgettingLeavesNoInk) {
  (void)engine->label("Ada Lovelace", {}, 800);
  engine->forget();
  const std::uint8_t* all = engine->atlas().texels();
  const std::size_t count = static_cast<std::size_t>(engine->atlas().side_px()) *
                            static_cast<std::size_t>(engine->atlas().side_px());
  EXPECT_TRUE(std::all_of(all, all + count, [](std::uint8_t v) { return v == 0; }));
}

}  // namespace
}  // namespace relievo::ui
