// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The letters of the language, as its speakers know them from their own.
#include "ui/screens/parts/page.h"

#include <algorithm>
#include <array>

#include "hal/base/utf8.h"
#include "ui/language/language.h"

namespace relievo::ui {
namespace {

// Three rows, left to right as they lie on a desk.
using KeyRows = std::array<std::string_view, 3>;
struct Letters {
  KeyRows small, capital;    // without capital ones: the same
  const char* sign = "abc";  // on the key that leads to them
};
constexpr Letters kEnglish{{"qwertyuiop", "asdfghjkl-", "zxcvbnm'."},
                           {"QWERTYUIOP", "ASDFGHJKL-", "ZXCVBNM'."}},
    kGerman{{"qwertzuiopü", "asdfghjklöä", "yxcvbnmß-"}, {"QWERTZUIOPÜ", "ASDFGHJKLÖÄ", "YXCVBNMẞ-"}},
    kFrench{{"azertyuiopé", "qsdfghjklmè", "wxcvbnç'-"}, {"AZERTYUIOPÉ", "QSDFGHJKLMÈ", "WXCVBNÇ'-"}},
    kSpanish{{"qwertyuiop", "asdfghjklñ", "zxcvbnm'-"}, {"QWERTYUIOP", "ASDFGHJKLÑ", "ZXCVBNM'-"}},
    kArabic{{"ضصثقفغعهخحجد", "شسيبلاتنمكطذ", "ئءؤرىةوزظأإ"}, {}, "أبج"},
    kHebrew{{"קראטוןםפ'-", "שדגכעיחלךף", "זסבהנמצתץ"}, {}, "אבג"},
    kAccents{{"áàâäãåæçéèêë", "íìîïñóòôöõøœ", "úùûüýÿßšžł"}, {"ÁÀÂÄÃÅÆÇÉÈÊË", "ÍÌÎÏÑÓÒÔÖÕØŒ", "ÚÙÛÜÝŸẞŠŽŁ"}};
// In the order of Language. Chinese and Japanese have the Latin letters: names are typed as in a passport.
constexpr std::array kLettersOf{&kEnglish, &kGerman, &kFrench,  &kSpanish,
                                &kArabic,  &kHebrew, &kEnglish, &kEnglish};
static_assert(kLettersOf.size() == kLanguages);

const Letters& letters_of(Language language) { return *kLettersOf[std::size_t(language)]; }

Node& key(Page& page, std::string_view id, std::string_view letter, const char* spoken, bool sign,
          Action action, float grow = 1, bool mirrored = false) {
  Node node = page.text(letter, type::kButton, Weight::Medium, page.palette.link, TextAlign::Centre);
  // Twelve letters abreast have no room to grow on an upright screen.
  const float growth = page.portrait ? 0.15F : 0.6F;
  node.style.size_px = page.px(type::kButton * (1 + (page.text_share - 1) * growth));
  node.style.icon = sign;
  node.mirrored = mirrored;
  tell(node, Role::Key, id, spoken != nullptr ? spoken : "", action);
  page.card(node, 16);
  node.box.grow = grow;
  node.box.min_height = page.px(page.portrait ? size::kTarget : size::kKeyLeast);
  return page.tree.leaf(node);
}

// What a key switches on or off is seen by the letters; who listens is told.
const char* spoken_state(const Page& page, bool on) { return on ? page.tr("yes") : page.tr("no"); }

// What a voice would pass over.
const char* spoken_sign(const Page& page, std::string_view letter) {
  if (letter == "-") return page.tr("Hyphen");
  if (letter == "'") return page.tr("Apostrophe");
  return letter == "." ? page.tr("Full stop") : nullptr;
}

void letters(Page& page, std::string_view row) {
  for (; !row.empty(); row.remove_prefix(first_letter_of(row).bytes)) {
    const std::string_view letter = row.substr(0, first_letter_of(row).bytes);
    key(page, page.joined({"key ", letter}), letter, spoken_sign(page, letter), false, ActionKind::TypeKey);
  }
}

Node key_row(Page& page) {
  // Keys lie as on a desk, also where the words run to the left.
  return left_first(page.box(Flow::Row, 8));
}

void last_row(Page& page, Action done, Language language) {
  const auto in_box = page.tree.inside(page.box(Flow::Row, 10));
  const bool latin = info_of(language).latin, other = page.visit.other_letters;
  const char* sign = other                 ? letters_of(language).sign
                     : !latin              ? kEnglish.sign
                     : page.visit.capitals ? "ÁÑß"
                                           : "áñß";
  Node& others =
      key(page, "other_letters", sign,
          latin ? page.tr("Letters with accents") : info_of(other ? language : Language::English).own_name,
          false, ActionKind::OtherLetters, 0.6F);
  if (latin) others.value = spoken_state(page, other);
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
  Node board = justified(page.grown(page.box(Flow::Column, 8), page.portrait ? 0.0F : 1.0F), Justify::End);
  board.id = "keyboard";
  const auto in_board = page.tree.inside(board);
  page.tree.open(key_row(page));
  letters(page, "1234567890");
  page.tree.close();
  const Letters& shown = !page.visit.other_letters ? letters_of(language)
                         : info_of(language).latin ? kAccents
                                                   : kEnglish;
  const bool cased = !shown.capital[0].empty();
  const KeyRows& rows = cased && page.visit.capitals ? shown.capital : shown.small;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto in_box = page.tree.inside(key_row(page));
    const bool last = i == rows.size() - 1;
    if (last && cased)
      key(page, "shift", icon::kShift, page.tr("Capital letters"), true, ActionKind::Shift).value =
          spoken_state(page, page.visit.capitals);
    letters(page, rows[i]);
    // Its arrow points to where letters go: the last one of a word that runs to the left is erased to the
    // right.
    if (last) key(page, "erase", icon::kErase, page.tr("Erase"), true, ActionKind::Erase, 1, page.mirrored());
  }
  last_row(page, done, language);
}

void number_pad(Page& page, const PadIds& ids, Action done) {
  // Larger where there is more room.
  const float share = std::min(page.text_share, 1.5F) * (page.portrait ? 1.25F : 1.0F);
  Node pad = justified(page.box(Flow::Column, 10), Justify::Centre);
  pad.id = "keyboard";
  pad.box.width = page.px(360 * share);
  page.tree.open(pad);
  const auto shaped = [&](Node node, bool main) {
    frame(node, main ? page.palette.accent : page.palette.card, main ? Colour{} : page.palette.card_border,
          main ? 0 : page.px(1.5F), page.px(16));
    node.box.grow = 1;
    node.box.min_height = page.px(size::kKeyLeast * share);
    return node;
  };
  const auto digit = [&](std::string_view letter) {
    Node node = shaped(
        page.text(letter, type::kHeading, Weight::Medium, page.palette.link, TextAlign::Centre), false);
    tell(node, Role::Key, page.joined({ids.digit, letter}), {}, ActionKind::TypeKey);
    page.tree.leaf(node);
  };
  const auto sign = [&](std::string_view id, const char* spoken, const char* letter, Action action,
                        bool main) {
    Node node = centred(shaped(page.box(Flow::Row), main));
    tell(node, Role::Key, id, spoken, action);
    const auto in_node = page.tree.inside(node);
    page.sign(letter, 30, main ? page.palette.accent_ink : page.palette.link);
  };
  for (const std::string_view keys : {"123", "456", "789"}) {
    const auto in_box = page.tree.inside(key_row(page));
    for (const char& key : keys) digit({&key, 1});
  }
  page.tree.open(key_row(page));
  sign("erase", page.tr("Erase"), icon::kErase, ActionKind::Erase, false);
  digit("0");
  sign(ids.done, page.tr("Done"), icon::kCheck, done, true);
  page.tree.close(2);
}

}  // namespace relievo::ui
