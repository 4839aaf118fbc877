// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Narrator: what is to be said now, from what was said and the tree as it is. In this order, one thing at a
// time:
//
//   another page, or asked to read it again  ->  the page
//   something was typed                      ->  the letter
//   another focus, or what has it changed    ->  what has the focus
//   a status changed                         ->  the status: an alert as soon as it has stood for kSettled
//                                                (one that waits leaves time to do what was heard before),
//                                                any other when nothing is being said
//   an alert that insists still stands       ->  the same again, every kAgain
//
// Nothing is said twice without one of these, but an alert that went and came again. It keeps prints of
// texts, no texts. Thread: main. Errors: none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "hal/base/wiped_text.h"
#include "hal/clock.h"
#include "ui/language/language.h"
#include "ui/tree/tree.h"
#include "ui/view/visit.h"

namespace relievo::ui {

// What nodes say: the words of a page in reading order, of one node, of a button that has the focus. Pure
// functions of the tree. What is a person's own (Node::secret) is told to headphones alone; a loudspeaker
// says that there is something. Thread: main. Errors: none: what does not fit is not said.

// Sentences to be spoken, UTF-8 without what only steers the eye (isolates, soft hyphens). In memory of its
// own that is wiped.
class Utterance {
 public:
  void clear() {
    text_.cut(0);
    last_ = 0;
  }
  // As a sentence of its own, where there are any; not the same one twice.
  void say(std::string_view words);
  std::string_view text() const { return text_.view(); }
  bool empty() const { return text_.empty(); }
  std::string_view language;  // BCP 47

 private:
  ShortWipedText<24 * 1024> text_;  // an operator's consent text has 20,000 bytes
  std::size_t last_ = 0;            // where the last sentence begins
};

struct Listener {
  Words tr{Language::English};
  bool alone = false;  // with headphones
};

// All that the page says of itself, or what lies over it: not its buttons.
void say_page(const Tree& tree, const Listener& to, Utterance& said);
// One node: its name and value, or the words in it.
void say_node(const Tree& tree, const Node& node, const Listener& to, Utterance& said);
// The node that has the focus; a button says that it is one.
void say_focus(const Tree& tree, const Node& node, const Listener& to, Utterance& said);

// Of a text, as far as it matters whether it was said already.
std::size_t print_of(std::string_view text);

inline constexpr std::chrono::milliseconds kSettled{350};  // an advice that is gone by then helps nobody
inline constexpr std::chrono::seconds kAgain{5};           // what insists is said again
// From the end of what was said until it is done; what stands so long cuts it short.
inline constexpr std::chrono::milliseconds kReacts{700}, kCutsShort{1200};

class Narrator {
 public:
  struct Moment {
    std::size_t page = 0;      // another number for every page and what lies over it
    std::string_view focus{};  // id; empty: none
    hal::Instant now{};
    bool busy = false;  // something is being said
  };
  // Empty: nothing. The utterance holds until the next call.
  const Utterance& follow(const Tree& tree, const Moment& moment, const Listener& to);
  // The page is read again, with an introduction before it if there is one.
  void read_again(std::string_view introduction = {});
  void forget();
  const Utterance& nothing() {
    said_.clear();
    return said_;
  }
  // These words alone, whatever the page.
  const Utterance& tell(std::string_view words, const Listener& to) {
    said_.clear();
    said_.language = info_of(to.tr.language()).code;
    said_.say(words);
    return said_;
  }

 private:
  struct Told {
    std::size_t id = 0, said = 0, seen = 0;  // prints
    hal::Instant since{}, last{};            // seen; said
    bool there = false, alert = false;       // as last looked at
  };
  void read_page(const Tree& tree, const Moment& moment, const Listener& to);
  bool follow_focus(const Tree& tree, std::string_view focus, const Listener& to, bool was_there);
  bool follow_typing(const Tree& tree, const Listener& to);
  void follow_statuses(const Tree& tree, const Moment& moment, const Listener& to, bool said_all);
  Told& told_of(std::size_t id);

  Utterance said_, scratch_;
  std::size_t page_ = 0, focus_ = 0, focused_ = 0, typed_ = 0, typed_bytes_ = 0;
  std::vector<Told> told_;
  hal::Instant heard_{};
  bool told_to_wait_ = false;  // what was said last was such an alert
  bool again_ = true;
  std::string_view introduction_;
};

// Cue: the sign that everybody hears when something has happened, from what was and what is: pure functions.
// And for who listens, how near the face is to its place. Thread: any. Errors: none.
enum class Cue : std::uint8_t {
  None,
  Tick,     // a number of the countdown
  Shutter,  // a picture was taken, of the front or a side
  Taken,    // a view was taken in calibration
  Done,     // the portrait is stored
  Refused   // once more, or not at all
};

// What of a moment makes a difference.
struct Cues {
  Screen screen = Screen::SelfTest;
  Step step = Step::Starting;
  Trouble trouble = Trouble::None;
  int number = 0;  // of the countdown; 0: there is none
  std::size_t sides = 0;
  int views = 0;
};
Cues cues_of(const ViewState& view, const Visit& visit);
Cue cue(const Cues& before, const Cues& now);

// While place, distance or the head's pose is to be mended: 0.5 far from where it should be, 2 there, an
// octave each half of the way. Nothing where the cameras see no face, or something else is amiss.
std::optional<float> guide_pitch(const ViewState& view, const Visit& visit);

}  // namespace relievo::ui
