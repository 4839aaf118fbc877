// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The letters of the language, as its speakers know them from their own.
#include "ui/screens/parts/keyboard.h"

#include <algorithm>
#include <array>
#include <span>

#include "ui/language/language.h"

namespace relievo::ui {
namespace {

// The letters of the keyboard on the screen, as the speakers of a language know them from their own:
// three rows, left to right as they lie on a desk.

using KeyRow = std::span<const char* const>;
using KeyRows = std::array<KeyRow, 3>;

constexpr const char* kEn1[] = {"q", "w", "e", "r", "t", "y", "u", "i", "o", "p"};
constexpr const char* kEn2[] = {"a", "s", "d", "f", "g", "h", "j", "k", "l", "-"};
constexpr const char* kEn3[] = {"z", "x", "c", "v", "b", "n", "m", "'", "."};
constexpr const char* kEn1Big[] = {"Q", "W", "E", "R", "T", "Y", "U", "I", "O", "P"};
constexpr const char* kEn2Big[] = {"A", "S", "D", "F", "G", "H", "J", "K", "L", "-"};
constexpr const char* kEn3Big[] = {"Z", "X", "C", "V", "B", "N", "M", "'", "."};
constexpr const char* kDe1[] = {"q", "w", "e", "r", "t", "z", "u", "i", "o", "p", "ü"};
constexpr const char* kDe2[] = {"a", "s", "d", "f", "g", "h", "j", "k", "l", "ö", "ä"};
constexpr const char* kDe3[] = {"y", "x", "c", "v", "b", "n", "m", "ß", "-"};
constexpr const char* kDe1Big[] = {"Q", "W", "E", "R", "T", "Z", "U", "I", "O", "P", "Ü"};
constexpr const char* kDe2Big[] = {"A", "S", "D", "F", "G", "H", "J", "K", "L", "Ö", "Ä"};
constexpr const char* kDe3Big[] = {"Y", "X", "C", "V", "B", "N", "M", "ẞ", "-"};
constexpr const char* kFr1[] = {"a", "z", "e", "r", "t", "y", "u", "i", "o", "p", "é"};
constexpr const char* kFr2[] = {"q", "s", "d", "f", "g", "h", "j", "k", "l", "m", "è"};
constexpr const char* kFr3[] = {"w", "x", "c", "v", "b", "n", "ç", "'", "-"};
constexpr const char* kFr1Big[] = {"A", "Z", "E", "R", "T", "Y", "U", "I", "O", "P", "É"};
constexpr const char* kFr2Big[] = {"Q", "S", "D", "F", "G", "H", "J", "K", "L", "M", "È"};
constexpr const char* kFr3Big[] = {"W", "X", "C", "V", "B", "N", "Ç", "'", "-"};
constexpr const char* kEs1[] = {"q", "w", "e", "r", "t", "y", "u", "i", "o", "p"};
constexpr const char* kEs2[] = {"a", "s", "d", "f", "g", "h", "j", "k", "l", "ñ"};
constexpr const char* kEs3[] = {"z", "x", "c", "v", "b", "n", "m", "'", "-"};
constexpr const char* kEs1Big[] = {"Q", "W", "E", "R", "T", "Y", "U", "I", "O", "P"};
constexpr const char* kEs2Big[] = {"A", "S", "D", "F", "G", "H", "J", "K", "L", "Ñ"};
constexpr const char* kEs3Big[] = {"Z", "X", "C", "V", "B", "N", "M", "'", "-"};
constexpr const char* kAccent1[] = {"á", "à", "â", "ä", "ã", "å", "æ", "ç", "é", "è", "ê", "ë"};
constexpr const char* kAccent2[] = {"í", "ì", "î", "ï", "ñ", "ó", "ò", "ô", "ö", "õ", "ø", "œ"};
constexpr const char* kAccent3[] = {"ú", "ù", "û", "ü", "ý", "ÿ", "ß", "š", "ž", "ł"};
constexpr const char* kAccent1Big[] = {"Á", "À", "Â", "Ä", "Ã", "Å", "Æ", "Ç", "É", "È", "Ê", "Ë"};
constexpr const char* kAccent2Big[] = {"Í", "Ì", "Î", "Ï", "Ñ", "Ó", "Ò", "Ô", "Ö", "Õ", "Ø", "Œ"};
constexpr const char* kAccent3Big[] = {"Ú", "Ù", "Û", "Ü", "Ý", "Ÿ", "ẞ", "Š", "Ž", "Ł"};
constexpr const char* kAr1[] = {"ض", "ص", "ث", "ق", "ف", "غ", "ع", "ه", "خ", "ح", "ج", "د"};
constexpr const char* kAr2[] = {"ش", "س", "ي", "ب", "ل", "ا", "ت", "ن", "م", "ك", "ط", "ذ"};
constexpr const char* kAr3[] = {"ئ", "ء", "ؤ", "ر", "ى", "ة", "و", "ز", "ظ", "أ", "إ"};
constexpr const char* kHe1[] = {"ק", "ר", "א", "ט", "ו", "ן", "ם", "פ", "'", "-"};
constexpr const char* kHe2[] = {"ש", "ד", "ג", "כ", "ע", "י", "ח", "ל", "ך", "ף"};
constexpr const char* kHe3[] = {"ז", "ס", "ב", "ה", "נ", "מ", "צ", "ת", "ץ"};

// Chinese and Japanese have the Latin letters: names are typed as in a passport.
KeyRows key_rows(Language language, bool capitals) {
  switch (language) {
    case Language::German: return capitals ? KeyRows{kDe1Big, kDe2Big, kDe3Big} : KeyRows{kDe1, kDe2, kDe3};
    case Language::French: return capitals ? KeyRows{kFr1Big, kFr2Big, kFr3Big} : KeyRows{kFr1, kFr2, kFr3};
    case Language::Spanish: return capitals ? KeyRows{kEs1Big, kEs2Big, kEs3Big} : KeyRows{kEs1, kEs2, kEs3};
    case Language::Arabic: return {kAr1, kAr2, kAr3};
    case Language::Hebrew: return {kHe1, kHe2, kHe3};
    case Language::English:
    case Language::Chinese:
    case Language::Japanese:
    case Language::Count: break;
  }
  return capitals ? KeyRows{kEn1Big, kEn2Big, kEn3Big} : KeyRows{kEn1, kEn2, kEn3};
}

// The letters with accents, of all languages with Latin letters.
KeyRows accent_rows(bool capitals) {
  return capitals ? KeyRows{kAccent1Big, kAccent2Big, kAccent3Big} : KeyRows{kAccent1, kAccent2, kAccent3};
}

// Does the language write in large and small letters?
bool has_capitals(Language language) { return language != Language::Arabic && language != Language::Hebrew; }

constexpr const char* kDigits[] = {"1", "2", "3", "4", "5", "6", "7", "8", "9", "0"};

void key(Page& page, std::string_view id, std::string_view letter, const char* spoken, bool sign,
         Action action, float grow = 1, bool mirrored = false) {
  Node node = page.text(letter, type::kButton, Weight::Medium, page.palette.link, TextAlign::Centre);
  // Twelve letters abreast have no room to grow on an upright screen.
  const float growth = page.portrait ? 0.15F : 0.6F;
  node.style.size_px = page.px(type::kButton * (1 + (page.text_share - 1) * growth));
  node.style.icon = sign;
  node.mirrored = mirrored;
  node.id = id;
  if (spoken != nullptr) node.name = spoken;
  frame(node, page.palette.card, page.palette.card_border, page.px(1.5F), page.px(16));
  node.role = Role::Key;
  node.action = action;
  node.box.grow = grow;
  node.box.min_height = page.px(page.portrait ? size::kTarget : size::kKeyLeast);
  page.tree.leaf(node);
}

// What a voice would pass over.
const char* spoken_sign(const Page& page, std::string_view letter) {
  if (letter == "-") return page.tr("Hyphen");
  if (letter == "'") return page.tr("Apostrophe");
  return letter == "." ? page.tr("Full stop") : nullptr;
}

void letters(Page& page, KeyRow row) {
  for (const char* letter : row) {
    const std::string_view id = page.tree.keep("key ");
    const std::string_view rest = page.tree.keep(letter);
    key(page, {id.data(), id.size() + rest.size()}, letter, spoken_sign(page, letter), false,
        {ActionKind::TypeKey, 0});
  }
}

Node row_box(Page& page) {
  Node row = page.box(Flow::Row, 8);
  row.box.left_to_right = true;  // keys lie as on a desk, also where the words run to the left
  return row;
}

void last_row(Page& page, Action done, Language language) {
  const auto in_box = page.tree.inside(page.box(Flow::Row, 10));
  if (has_capitals(language)) {
    const char* sign = page.visit.accents ? "abc" : page.visit.capitals ? "ÁÑß" : "áñß";
    key(page, "accents", sign, page.tr("Letters with accents"), false, {ActionKind::Accents, 0}, 0.6F);
  }
  key(page, "space", page.tr("Space"), nullptr, false, {ActionKind::TypeKey, ' '}, 2);
  page.button("done", page.tr("Done"), icon::kGood, ButtonLook::Main,
              done.kind == ActionKind::Done && page.visit.name().empty() ? Action{} : done,
              !page.portrait           ? 1.0F
              : page.text_share > 1.6F ? 2.4F
                                       : 1.5F);
}

}  // namespace

void keyboard(Page& page, Action done) { keyboard(page, done, page.visit.language); }

void keyboard(Page& page, Action done, Language language) {
  Node board = page.grown(page.box(Flow::Column, 8), page.portrait ? 0.0F : 1.0F);
  board.id = "keyboard";
  board.box.justify = Justify::End;
  const auto in_board = page.tree.inside(board);
  page.tree.open(row_box(page));
  letters(page, kDigits);
  page.tree.close();
  const bool cased = has_capitals(language);
  const KeyRows rows = page.visit.accents && cased ? accent_rows(page.visit.capitals)
                                                   : key_rows(language, page.visit.capitals);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto in_box = page.tree.inside(row_box(page));
    const bool last = i == rows.size() - 1;
    if (last && cased)
      key(page, "shift", icon::kShift, page.tr("Capital letters"), true, {ActionKind::Shift, 0});
    letters(page, rows[i]);
    // Its arrow points to where letters go: the last one of a word that runs to the left is erased to the
    // right.
    if (last)
      key(page, "erase", icon::kErase, page.tr("Erase"), true, {ActionKind::Erase, 0}, 1, page.mirrored());
  }
  last_row(page, done, language);
}

void number_pad(Page& page, const PadIds& ids, Action done) {
  // Larger where there is more room.
  const float share = std::min(page.text_share, 1.5F) * (page.portrait ? 1.25F : 1.0F);
  Node pad = page.box(Flow::Column, 10);
  pad.id = "keyboard";
  pad.box.width = page.px(360 * share);
  pad.box.justify = Justify::Centre;
  page.tree.open(pad);
  const auto shaped = [&](Node node, bool main) {
    frame(node, main ? page.palette.accent : page.palette.card, main ? Colour{} : page.palette.card_border,
          main ? 0 : page.px(1.5F), page.px(16));
    node.box.grow = 1;
    node.box.min_height = page.px(size::kKeyLeast * share);
    return node;
  };
  const auto digit = [&](const char* letter) {
    Node node = shaped(
        page.text(letter, type::kHeading, Weight::Medium, page.palette.link, TextAlign::Centre), false);
    const std::string_view key = page.tree.keep(ids.digit), rest = page.tree.keep(letter);
    tell(node, Role::Key, {key.data(), key.size() + rest.size()}, {}, {ActionKind::TypeKey, 0});
    page.tree.leaf(node);
  };
  const auto sign = [&](std::string_view id, const char* spoken, const char* letter, Action action,
                        bool main) {
    Node node = shaped(page.box(Flow::Row), main);
    tell(node, Role::Key, id, spoken, action);
    centre(node);
    const auto in_node = page.tree.inside(node);
    page.sign(letter, 30, main ? page.palette.accent_ink : page.palette.link);
  };
  constexpr const char* kRows[3][3] = {{"1", "2", "3"}, {"4", "5", "6"}, {"7", "8", "9"}};
  for (const auto& keys : kRows) {
    const auto in_box = page.tree.inside(row_box(page));
    for (const char* key : keys) digit(key);
  }
  page.tree.open(row_box(page));
  sign("erase", page.tr("Erase"), icon::kErase, {ActionKind::Erase, 0}, false);
  digit("0");
  sign(ids.done, page.tr("Done"), icon::kCheck, done, true);
  page.tree.close();
  page.tree.close();
}

}  // namespace relievo::ui
