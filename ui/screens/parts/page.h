// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Page: what every screen is built with: the tree, the words, the palette, and the widgets. Lengths
// that go in are dp; text grows with the person's text size, pictures and gaps do not.
// Thread: main. Errors: none.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <span>
#include <string_view>

#include "ui/draw/theme.h"
#include "ui/language/language.h"
#include "ui/tree/tree.h"
#include "ui/view/view_state.h"
#include "ui/view/visit.h"

namespace relievo::ui {

namespace icon {  // letters of the icon font
inline constexpr const char *kBack = "\uf04d", *kNext = "\uf054", *kUp = "\uf05d", *kDown = "\uf045",
                            *kTranslate = "\uf5ca", *kHelp = "\uf2d7", *kGood = "\uf5e0", *kCheck = "\uf12c",
                            *kClose = "\uf156", *kCamera = "\uf100", *kAgain = "\uf450", *kErase = "\uf06e",
                            *kText = "\uf27f", *kAlert = "\uf028", *kSun = "\uf5a8", *kZoomIn = "\uf34b",
                            *kZoomOut = "\uf34a", *kWrench = "\uf5b7", *kShift = "\uf636",
                            *kContrast = "\uf197", *kLock = "\uf33e", *kWait = "\uf51f",
                            *kTurnLeft = "\uf465", *kTurnRight = "\uf467", *kShape = "\uf563",
                            *kNoCamera = "\uf5df", *kDisk = "\uf2ca", *kDark = "\uf594", *kInfo = "\uf2fc",
                            *kPerson = "\uf64a", *kStill = "\uf51f", *kBin = "\uf1c0", *kLess = "\uf374",
                            *kMore = "\uf415", *kSpeaker = "\uf57e", *kQuieter = "\uf57f", *kSpeed = "\uf4c5",
                            *kUndo = "\uf54c", *kReach = "\uf5a4", *kCameraOff = "\uf5df",
                            *kShield = "\uf498", *kPrinter = "\uf42a", *kStick = "\uf553",
                            *kSearch = "\uf349";
}  // namespace icon

// What keeps a text apart from the direction of the words around it, letter by letter: a literal with one of
// them alone would turn round the line it is read in. First: with the direction of its first letter; Left:
// from the left.
namespace isolate {
inline constexpr char kFirst[] = {'\xe2', '\x81', '\xa8', '\0'}, kLeft[] = {'\xe2', '\x81', '\xa6', '\0'},
                      kEnd[] = {'\xe2', '\x81', '\xa9', '\0'};
}  // namespace isolate

// Grave: of what nobody can undo. It has to be held, or waits as long for another key; a bar fills meanwhile.
enum class ButtonLook : std::uint8_t { Main, Quiet, Plain, Grave };

// Lengths of a button, in dp; of the letters, as they are at 100 %.
struct ButtonSize {
  float height = 0, width = 0;  // at least
  float pad_x = 0, pad_y = 0, gap = 0, radius = 0;
  float sign = 0, text = 0;
  bool shadow = false;
};
// Of every page a visitor reads: what it leaves free at its sides, and above and below.
inline constexpr float kPageMargin = 40, kPageTop = 24;

namespace size {
inline constexpr ButtonSize kMainButton{kBigTarget, kTarget, 26, 12, 14, kRadius, 34, type::kButton, true};
inline constexpr ButtonSize kOtherButton{kTarget, kTarget, 26, 12, 14, kRadius, 30, type::kBody};
}  // namespace size

// What a node is for tests and assistive use, and what touching it does.
inline void tell(Node& node, Role role, std::string_view id, std::string_view spoken, Action action = {}) {
  node.role = role, node.id = id, node.name = spoken, node.action = action;
}
// Where its children are: along its flow, across it; in its middle.
inline Node justified(Node node, Justify where) { return node.box.justify = where, node; }
inline Node aligned(Node node, Align where) { return node.box.align = where, node; }
inline Node centred(const Node& node) { return aligned(justified(node, Justify::Centre), Align::Centre); }
// A row whose first child lies on the left in every language: digits, keys, a camera beside the other.
inline Node left_first(Node row) { return row.box.left_to_right = true, row; }
// It goes on where it has no room.
inline Node scroller(std::string_view id, Node node) { return node.id = id, node.box.scroll = true, node; }
inline Node shrinking(Node node) { return node.box.shrink = true, node; }
// In a stack, with its middle at these shares of it.
inline Node pinned(Node node, float x, float y) {
  return node.pinned = true, node.pin_x = x, node.pin_y = y, node;
}
// Shows a picture; `aspect` as in Node.
inline void depict(Node& node, PictureSlot slot, float aspect = 0) {
  node.mark = Mark::Image, node.picture = slot, node.aspect = aspect;
}
inline float aspect_of(const ImageView& of, float of_none = 1) {
  return of.empty() ? of_none : float(of.width_px) / float(of.height_px);
}
// Lengths in pixels.
inline void frame(Node& node, Colour fill, Colour border, float border_px, float radius_px) {
  node.box.fill = fill, node.box.border = border, node.box.border_px = border_px, node.box.radius = radius_px;
}

// Pixels of one dp on a screen of this size.
float unit_of(const Rect& screen);

class Page {
 public:
  Page(Tree& tree, const ViewState& view, const Visit& visit, const Palette& palette, const Rect& screen);

  Tree& tree;
  const ViewState& view;
  const Visit& visit;
  const Palette& palette;
  Words tr;
  float unit;                                     // pixels of a dp
  float text_share;                               // 1 to 2, on the staff's pages to 1.5
  std::size_t text_sizes = kTextPercents.size();  // of kTextPercents those that look different here
  float width_dp, height_dp;
  bool portrait;

  float px(float dp) const { return dp * unit; }
  // Then less stands beside each other.
  bool large_words() const { return text_share > 1.2F; }
  bool little_room() const { return portrait || large_words(); }
  bool mirrored() const { return info_of(visit.language).right_to_left; }
  // A box with nothing in it yet; gap and padding in dp.
  Node box(Flow flow, float gap = 0, float pad_x = 0, float pad_y = 0) const;
  // Beside each other; on an upright screen one below the other.
  Node abreast_box(float gap) const { return box(portrait ? Flow::Column : Flow::Row, gap); }
  // A row whose children stand in the middle of its height.
  Node row_box(float gap = 0, float pad_x = 0, float pad_y = 0) const;
  Node grown(Node node, float share = 1) const {
    node.box.grow = share;
    return node;
  }
  Node sized(Node node, float width_dp_, float height_dp_) const {
    node.box.width = px(width_dp_), node.box.height = px(height_dp_);
    return node;
  }
  // Filled; round corners in dp.
  Node painted(Node node, Colour fill, float radius_dp = 0) const {
    node.box.fill = fill, node.box.radius = px(radius_dp);
    return node;
  }
  // Makes a card of it.
  void card(Node& node, float radius_dp) const {
    frame(node, palette.card, palette.card_border, px(1.5F), px(radius_dp));
  }
  // A dark card, for a picture or a model that fills it and what lies on that.
  Node stage(float radius_dp, float grow = 1) const;
  // A model, to be turned.
  Node model(std::string_view id, const char* words, float radius_dp) const;
  void space(float grow_share) { tree.leaf(grown(box(Flow::Column), grow_share)); }
  // Under a name of its own: what tests look for, or a voice is to tell.
  void put(std::string_view id, Role role, Node node) const {
    node.id = id, node.role = role;
    tree.leaf(node);
  }
  void put(std::string_view id, Role role, std::string_view words, float size, Weight weight, Colour colour,
           TextAlign align = TextAlign::Start) const {
    put(id, role, text(words, size, weight, colour, align));
  }
  // Words that have the room which others leave in a row.
  void wide(const Node& words) const {
    const auto in_box = tree.inside(grown(box(Flow::Column)));
    tree.leaf(words);
  }
  // So many things, `across` of them in a row.
  template <typename Draw>
  void in_rows(std::size_t count, std::size_t across, float gap, const Draw& draw) const {
    for (std::size_t first = 0; first < count; first += across) {
      const auto in_row = tree.inside(box(Flow::Row, gap));
      for (std::size_t i = first; i < std::min(first + across, count); ++i) draw(i);
    }
  }
  // The same; the last row is filled up, so that all are as wide.
  template <typename Draw>
  void in_full_rows(std::size_t count, std::size_t across, float gap, const Draw& draw) {
    in_rows((count + across - 1) / across * across, across, gap, [&](std::size_t i) {
      if (i < count) draw(i);
      else space(1);
    });
  }

  Node text(std::string_view words, float size, Weight weight, Colour colour,
            TextAlign align = TextAlign::Start) const;
  void write(std::string_view words, float size, Weight weight, Colour colour,
             TextAlign align = TextAlign::Start) const {
    tree.leaf(text(words, size, weight, colour, align));
  }
  void heading(std::string_view id, std::string_view words, float size = type::kTitle,
               TextAlign align = TextAlign::Start);
  void body(std::string_view id, std::string_view words, TextAlign align = TextAlign::Start);
  void sign(const char* letter, float size, Colour colour);
  // A bar, filled from the side at which reading begins.
  void progress(std::string_view id, float share);
  // An icon that points along the line of reading, turned for right-to-left.
  const char* onward() const { return mirrored() ? icon::kBack : icon::kNext; }
  const char* backward() const { return mirrored() ? icon::kNext : icon::kBack; }

  void button(std::string_view id, std::string_view label, const char* letter, ButtonLook look, Action action,
              float grow = 0, std::string_view value = {}) {
    button(id, label, letter, look, action, grow,
           look == ButtonLook::Main || look == ButtonLook::Grave ? size::kMainButton : size::kOtherButton,
           value);
  }
  void square_button(std::string_view id, std::string_view spoken, const char* letter, Action action,
                     std::string_view value = {});
  // What everybody needs who reads: larger letters, more contrast, another language. In an open row.
  void reading_tools();
  // What turns a model and moves its light, for who has no finger for it. In an open row.
  void turning_tools();
  void bigger_text();
  void more_contrast();
  void within_reach();
  void privacy() { square_button("privacy", tr("Your data"), icon::kShield, ActionKind::ShowPrivacy); }
  // Whether the cameras are off, before the consent and when all is over.
  void cameras();
  // "… {} …" with the value in it, kept apart from the direction of the words around.
  std::string_view filled(const char* words, std::string_view value) { return filled(words, {value}); }
  // The same for several, in the order of their places.
  std::string_view filled(const char* words, std::initializer_list<std::string_view> values) {
    return filled(words, std::span(values.begin(), values.size()));
  }
  std::string_view filled(const char* words, std::span<const std::string_view> values);
  // The form that belongs to the number, with the number in it.
  std::string_view plural_tr(const char* one, const char* many, int count);
  std::string_view days(int count) { return plural_tr("{} day", "{} days", count); }
  // The parts one after the other, kept for the frame.
  std::string_view joined(std::initializer_list<std::string_view> parts) const;
  // Figures and identifiers: left to right in every language.
  std::string_view left_to_right(std::initializer_list<std::string_view> parts) const;
  std::string_view left_to_right(std::string_view text) const { return left_to_right({text}); }
  // Long names, which may be divided behind these letters.
  std::string_view breakable(std::string_view names, std::string_view behind = "._+") const;
  // A code as it is spoken: digit by digit, with a pause between groups.
  std::string_view spelled(std::string_view code);
  // "3 of 4": what a gauge says to who does not see it.
  std::string_view share_of(std::size_t done, std::size_t all);

  // The page itself, on the ground of the palette.
  void open_page(Node root);
  // The frame of every page on the way: bar at the top, room for the rest. Closed by end().
  void begin(bool with_back);
  void end();
  bool low() const { return visit.reach != Reach::Usual; }
  // A row that comes to the other side with the controls in it.
  Node sided(Node row) const {
    row.box.other_side = visit.reach == Reach::LowOther;
    return row;
  }

 protected:
  void button(std::string_view id, std::string_view label, const char* letter, ButtonLook look, Action action,
              float grow, const ButtonSize& lengths, std::string_view value = {});

  bool with_back_ = false;

 private:
  void bar(bool with_back);
  void steps();
};

// What lies over a page of visitors and staff: help, languages, "leave?", "still there?".
void overlay_screen(Page& page);
// The languages a visitor may choose, each in its own letters, so many abreast.
void language_grid(Page& page, std::size_t columns);

// The keyboard on the screen, as visitors and staff type on it. Thread: main. Errors: none.

// `done` is what the key that ends typing does; the visitor's does nothing before there is a name. `letters`:
// whose; most pages have those of the reader.
void keyboard(Page& page, Action done = ActionKind::Done);
void keyboard(Page& page, Action done, Language letters);

// Digits, and a tick for `done`.
struct PadIds {
  std::string_view digit, done;  // of the keys: the first goes before the digit
};
void number_pad(Page& page, const PadIds& ids, Action done);

}  // namespace relievo::ui
