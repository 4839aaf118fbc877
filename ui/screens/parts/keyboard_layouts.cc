// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/screens/parts/keyboard_layouts.h"

namespace relievo::ui {
namespace {

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

}  // namespace

KeyRows key_rows(Language language, bool capitals) {
  switch (language) {
    case Language::German:
      return capitals ? KeyRows{kDe1Big, kDe2Big, kDe3Big} : KeyRows{kDe1, kDe2, kDe3};
    case Language::French:
      return capitals ? KeyRows{kFr1Big, kFr2Big, kFr3Big} : KeyRows{kFr1, kFr2, kFr3};
    case Language::Spanish:
      return capitals ? KeyRows{kEs1Big, kEs2Big, kEs3Big} : KeyRows{kEs1, kEs2, kEs3};
    case Language::Arabic:
      return {kAr1, kAr2, kAr3};
    case Language::Hebrew:
      return {kHe1, kHe2, kHe3};
    case Language::English:
    case Language::Chinese:
    case Language::Japanese:
    case Language::Count:
      break;
  }
  return capitals ? KeyRows{kEn1Big, kEn2Big, kEn3Big} : KeyRows{kEn1, kEn2, kEn3};
}

KeyRows accent_rows(bool capitals) {
  return capitals ? KeyRows{kAccent1Big, kAccent2Big, kAccent3Big} : KeyRows{kAccent1, kAccent2, kAccent3};
}

bool has_capitals(Language language) { return language != Language::Arabic && language != Language::Hebrew; }

}  // namespace relievo::ui
