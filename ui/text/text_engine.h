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
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "hal/base/result.h"
#include "ui/draw/draw_list.h"

namespace relievo::ui {

// TextAtlas: one grey picture with all the text that is on the screen, packed in shelves. When it is
// full it starts anew (generation grows) and what is shown is drawn into it again.
// Memory: one byte a texel, taken once. Texels; origin top left. Thread: main.
struct AtlasPlace {
  int x = 0, y = 0;
};

class TextAtlas {
 public:
  explicit TextAtlas(int side_px = 2048)
      : side_(side_px), texels_(std::size_t(side_px) * std::size_t(side_px)) {}

  int side_px() const { return side_; }
  const std::uint8_t* texels() const { return texels_.data(); }
  std::uint32_t generation() const { return generation_; }

  // Room for a label; nothing when there is none: reset() and draw everything again.
  std::optional<AtlasPlace> place(int width_px, int height_px);
  std::uint8_t* row(int x, int y) { return texels_.data() + std::size_t(y) * std::size_t(side_) + x; }
  void reset();

  // Rows that changed since the last call: [first, last). Empty when first >= last.
  struct Rows {
    int first = 0, last = 0;
  };
  Rows take_changed();

 private:
  int side_;
  std::vector<std::uint8_t> texels_;
  struct Shelf {
    int y = 0, height = 0, used = 0;
  };
  std::vector<Shelf> shelves_;
  int shelf_end_ = 0;
  Rows changed_;
  std::uint32_t generation_ = 1;
};

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

// A part of a label: `ink` as there. `atlas` has no width where the part is not written.
struct TextPiece {
  Rect ink;
  Rect atlas;
};

class TextEngine {
 public:
  static Result<std::unique_ptr<TextEngine>> make();
  virtual ~TextEngine() = default;

  // No wider than max_width_px unless a single word is.
  virtual TextSize measure(std::string_view text, const TextStyle& style, float max_width_px) = 0;
  // The same, in the atlas, as far as it fits there. Valid until the next call.
  virtual const TextLabel& label(std::string_view text, const TextStyle& style, float max_width_px) = 0;
  // The same in pieces, so that a text may be larger than the atlas: those are written that meet `seen`,
  // which is relative to the top left corner of the text's box. Valid until the next call.
  virtual std::span<const TextPiece> pieces(std::string_view text, const TextStyle& style, float max_width_px,
                                            const Rect& seen) = 0;
  virtual TextAtlas& atlas() = 0;
  // Nothing that was written stays in memory.
  virtual void forget() = 0;
};

}  // namespace relievo::ui
