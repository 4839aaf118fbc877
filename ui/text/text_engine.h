// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TextEngine: writes a line or a paragraph in any script: shaped, in the right order, broken into
// lines of even length so that no word stands alone. What was written once is found again without an
// allocation. Fonts are an explicit list (kFamilies); an icon is a letter of the icon font.
// Pixels. Thread: main. Errors of make(): NotFound names the font package that is missing.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "hal/base/result.h"
#include "ui/draw/draw_list.h"
#include "ui/text/text_atlas.h"

namespace relievo::ui {

inline constexpr const char* kFamilies =
    "Inter, Noto Sans Arabic, Noto Sans Hebrew, Noto Sans, Noto Sans CJK SC";
// Japanese writes some letters it shares with Chinese in forms of its own.
inline constexpr const char* kJapaneseFamilies =
    "Inter, Noto Sans Arabic, Noto Sans Hebrew, Noto Sans, Noto Sans CJK JP";
inline constexpr const char* kIconFamily = "Material Design Icons";

enum class Weight : std::uint8_t { Regular, Medium, Bold };
enum class TextAlign : std::uint8_t { Start, Centre, End };

struct TextStyle {
  float size_px = 24;
  Weight weight = Weight::Regular;
  TextAlign align = TextAlign::Start;
  bool icon = false;
  bool right_to_left = false;
  bool tabular = false;  // all digits as wide as each other: figures under figures, and those that change
  const char* language = "en";  // BCP 47: chooses the forms of Chinese and Japanese letters
};

struct TextSize {
  float width_px = 0, height_px = 0;
  int lines = 0;
};

// A label in the atlas: `ink` is where its pixels lie, relative to the top left corner of its box.
struct TextLabel {
  TextSize size;
  Rect ink;
  Rect atlas;       // texels
  int missing = 0;  // letters no font has
  int torn = 0;     // words that end on one line and go on the next without a hyphen: no room for them
};

class TextEngine {
 public:
  static Result<std::unique_ptr<TextEngine>> make();
  virtual ~TextEngine() = default;

  // No wider than max_width_px unless a single word is.
  virtual TextSize measure(std::string_view text, const TextStyle& style, float max_width_px) = 0;
  // The same, in the atlas. Valid until the next call.
  virtual const TextLabel& label(std::string_view text, const TextStyle& style, float max_width_px) = 0;
  virtual TextAtlas& atlas() = 0;
  // Nothing that was written stays in memory.
  virtual void forget() = 0;
};

}  // namespace relievo::ui
