// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/view/keypad_letters.h"

#include <array>

#include "hal/base/utf8.h"

namespace relievo::ui {
namespace {

// Keys 1 to 9.
using Keys = std::array<std::string_view, 9>;
constexpr Keys kPlain{" -'.1", "acb2", "edf3", "ihg4", "lkj5", "nom6", "rspq7", "tuv8", "wyzx9"},
    kPlainBig{" -'.1", "ACB2", "EDF3", "IHG4", "LKJ5", "NOM6", "RSPQ7", "TUV8", "WYZX9"},
    kGerman{" -'.1", "aäcb2", "edf3", "ihg4", "lkj5", "nomö6", "rsßpq7", "tüuv8", "wyzx9"},
    kGermanBig{" -'.1", "AÄCB2", "EDF3", "IHG4", "LKJ5", "MNOÖ6", "RSPQẞ7", "TUÜV8", "WYZX9"},
    kFrench{" -'.1", "acbçâà2", "eédfèêë3", "ihgîï4", "lkj5", "nomôœ6", "rspq7", "tuvûùü8", "yzwxÿ9"},
    kFrenchBig{" -'.1", "ACBÇÂÀ2", "EÉDFÈÊË3", "IHGÎÏ4", "LKJ5", "NOMÔŒ6", "RSPQ7", "TUVÛÙÜ8", "YZWXŸ9"},
    kSpanish{" -'.1", "acáb2", "edéf3", "iíhg4", "lkj5", "noñóm6", "rspq7", "tuvúü8", "yzwx9"},
    kSpanishBig{" -'.1", "ACBÁ2", "EDFÉ3", "IHGÍ4", "LKJ5", "MNOÑÓ6", "RSPQ7", "TUVÚÜ8", "YZWX9"},
    kArabic{" -1", "تبةث2", "اأءإآئؤ3", "سشصض4", "ردزذ5", "حجخ6", "نيهوى7", "لمقفك8", "عطغظ9"},
    kHebrew{" -'1", "ודה2", "אבג3", "נמןם4", "ילכך5", "חטז6", "רתש7", "קצץ8", "עפסף9"};

const Keys& keys_of(Language language, bool capital) {
  switch (language) {
    case Language::German: return capital ? kGermanBig : kGerman;
    case Language::French: return capital ? kFrenchBig : kFrench;
    case Language::Spanish: return capital ? kSpanishBig : kSpanish;
    case Language::Arabic: return kArabic;
    case Language::Hebrew: return kHebrew;
    case Language::English:
    case Language::Chinese:
    case Language::Japanese:
    case Language::Count: break;
  }
  return capital ? kPlainBig : kPlain;
}

}  // namespace

std::string_view keypad_letter(Language language, char digit, std::size_t times, bool capital) {
  const std::string_view key = keys_of(language, capital)[std::size_t(digit - '1')];
  std::size_t at = 0;
  for (std::size_t i = 0; i < times; ++i) {
    at += first_letter_of(key.substr(at)).bytes;
    if (at == key.size()) at = 0;
  }
  return key.substr(at, first_letter_of(key.substr(at)).bytes);
}

}  // namespace relievo::ui
