// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/speech/narrator.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <utility>

#include "hal/base/utf8.h"
#include "ui/technician/technician_view.h"

namespace relievo::ui {
namespace {

bool is_one_of(std::string_view letter, std::initializer_list<std::string_view> letters) {
  return std::ranges::find(letters, letter) != letters.end();
}

bool steers_the_eye(std::string_view letter) {
  return is_one_of(
      letter, {"\u00ad", "\u200e", "\u200f", "\u2066", "\u2067", "\u2068", "\u2069", "\u2060", "\u200b"});
}

std::string_view as_spoken(std::string_view letter) {
  if (steers_the_eye(letter)) return {};
  if (is_one_of(letter, {"\u00a0", "\u202f"})) return " ";
  return letter == "\u2011" ? "-" : letter;
}

bool ends_a_sentence(std::string_view text) {
  constexpr std::string_view kEnds[] = {".", "!", "?", ":", "。", "！", "？", "：", "؟"};
  return std::ranges::any_of(kEnds, [text](std::string_view end) { return text.ends_with(end); });
}

// Said when it has the focus.
bool is_touched(const Node& node) { return node.role == Role::Button || node.role == Role::Key; }

void say_children(const Tree& tree, const Node& node, const Listener& to, Utterance& said) {
  for (std::int32_t i = node.first_child; i >= 0; i = tree.nodes()[std::size_t(i)].next) {
    const Node& child = tree.nodes()[std::size_t(i)];
    if (!is_touched(child)) say_node(tree, child, to, said);
  }
}

// A page is another one, too, when its heading is: while a portrait is made, then stored.
std::size_t print_of_page(const Tree& tree, const Narrator::Moment& moment, const Listener& to) {
  std::size_t print = moment.page * 31 + std::size_t(to.tr.language());
  for (const Node& node : tree.nodes()) {
    if (node.role == Role::Heading) print = print * 31 + print_of(node.text);
  }
  return print;
}

const Node* field_of(const Tree& tree) {
  const auto found = std::ranges::find(tree.nodes(), Role::Field, &Node::role);
  return found == tree.nodes().end() ? nullptr : &*found;
}

// How far from its place, where 1 is far, by what is to be mended first; negative where no tone can tell.
float away_of(const LiveView& live) {
  using pipeline::Advice;
  constexpr float kFarDeg = 45;
  if (live.advice == Advice::TooClose || live.advice == Advice::TooFar)
    return live.nearness > 0 ? 2 * std::abs(live.nearness - 1) : -1;
  if (live.advice == Advice::OffCentre) return std::hypot(live.face_x, live.face_y);
  if (live.advice == Advice::TurnedAside) return std::abs(live.yaw_deg) / kFarDeg;
  if (live.advice == Advice::LooksUpOrDown) return std::abs(live.pitch_deg) / kFarDeg;
  if (live.advice == Advice::Tilted) return std::abs(live.roll_deg) / kFarDeg;
  return -1;
}

}  // namespace

void Utterance::say(std::string_view words) {
  if (words.empty() || text().substr(last_) == words) return;
  if (!empty()) (void)text_.add(ends_a_sentence(text()) ? " " : ". ");
  last_ = text().size();
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t bytes = first_letter_of(words.substr(at)).bytes;
    const std::string_view letter = words.substr(at, std::max<std::size_t>(1, bytes));
    (void)text_.add(as_spoken(letter));
    at += letter.size();
  }
}

std::size_t print_of(std::string_view text) { return std::hash<std::string_view>{}(text); }

void say_node(const Tree& tree, const Node& node, const Listener& to, Utterance& said) {
  if (node.role == Role::Icon || node.unspoken) return;
  const bool types = node.action.kind == ActionKind::TypeKey, told = to.alone || !(node.secret || types);
  const auto own = [&](std::string_view words) {
    if (!words.empty()) said.say(told ? words : to.tr("Only said into headphones"));
  };
  if (node.name.empty() || types) own(node.name.empty() ? node.text : node.name);
  else said.say(node.name);
  own(node.value);
  if (node.name.empty() && node.text.empty()) say_children(tree, node, to, said);
}

void say_page(const Tree& tree, const Listener& to, Utterance& said) { say_node(tree, tree.top(), to, said); }

void say_focus(const Tree& tree, const Node& node, const Listener& to, Utterance& said) {
  say_node(tree, node, to, said);
  // A button with words of its own is a language, named in itself.
  if (node.role == Role::Button && node.text.empty()) said.say(to.tr("Button"));
}

void Narrator::read_again(std::string_view introduction) {
  again_ = true;
  introduction_ = introduction;
}

void Narrator::forget() {
  said_.clear();
  scratch_.clear();
  page_ = focus_ = focused_ = typed_ = typed_bytes_ = 0;
  told_.clear();
  read_again();
}

const Utterance& Narrator::follow(const Tree& tree, const Moment& moment, const Listener& to) {
  said_.clear();
  if (moment.busy && told_to_wait_) heard_ = moment.now;
  said_.language = info_of(to.tr.language()).code;
  const std::size_t page = print_of_page(tree, moment, to);
  if (std::exchange(page_, page) != page || again_) {
    read_page(tree, moment, to);
  } else {
    // A letter that was typed may have changed the key it is on: then it is the letter that counts.
    const bool typed = follow_typing(tree, to);
    if (!follow_focus(tree, moment.focus, to, typed) && !typed) follow_statuses(tree, moment, to, false);
  }
  return said_;
}

void Narrator::read_page(const Tree& tree, const Moment& moment, const Listener& to) {
  again_ = false;
  said_.say(std::exchange(introduction_, {}));
  say_page(tree, to, said_);
  told_.clear();
  follow_statuses(tree, moment, to, true);
  // Whatever has the focus now, or stands in the field, was there when the page was read.
  const Node* field = field_of(tree);
  typed_ = field != nullptr ? print_of(field->value) : 0;
  typed_bytes_ = field != nullptr ? field->value.size() : 0;
  (void)follow_focus(tree, moment.focus, to, true);
}

bool Narrator::follow_focus(const Tree& tree, std::string_view focus, const Listener& to, bool was_there) {
  const Node* node = focus.empty() ? nullptr : tree.find(focus);
  scratch_.clear();
  if (node != nullptr) say_focus(tree, *node, to, scratch_);
  const std::size_t words = print_of(scratch_.text()), id = print_of(focus);
  const bool same = focus_ == id && (node == nullptr || focused_ == words);
  focus_ = id;
  focused_ = words;
  if (same || was_there || node == nullptr) return false;
  if (node->role == Role::Button && !node->text.empty()) said_.language = node->style.language;
  said_.say(scratch_.text());
  scratch_.clear();
  return true;
}

bool Narrator::follow_typing(const Tree& tree, const Listener& to) {
  const Node* field = field_of(tree);
  if (field == nullptr) return false;
  const std::string_view typed = field->value;
  const std::size_t before = std::exchange(typed_bytes_, typed.size());
  if (std::exchange(typed_, print_of(typed)) == print_of(typed)) return false;
  if (typed.size() < before) said_.say(to.tr("Erased"));
  else if (!to.alone) said_.say(to.tr("Typed"));
  else if (const std::size_t last = last_letter_at(typed); last <= before) said_.say(typed.substr(last));
  else said_.say(typed);
  return true;
}

Narrator::Told& Narrator::told_of(std::size_t id) {
  const auto known = std::ranges::find(told_, id, &Told::id);
  return known != told_.end() ? *known : told_.emplace_back(Told{.id = id});
}

void Narrator::follow_statuses(const Tree& tree, const Moment& moment, const Listener& to, bool said_all) {
  for (Told& told : told_) told.there = false;
  for (const Node& node : tree.nodes()) {
    if ((node.role != Role::Status && node.role != Role::Alert) || node.unspoken || node.id.empty() ||
        !tree.is_on_top(node))
      continue;
    Told& told = told_of(print_of(node.id));
    told.there = true;
    told.alert = node.role == Role::Alert;
    scratch_.clear();
    say_node(tree, node, to, scratch_);
    const std::size_t words = print_of(scratch_.text());
    if (std::exchange(told.seen, words) != words) told.since = moment.now;
    const auto stands = moment.now - told.since;
    const bool obeyed = !node.waits || moment.now - heard_ >= kReacts || stands >= kCutsShort;
    const bool due = node.role == Role::Alert ? stands >= kSettled && obeyed : !moment.busy;
    const bool again = node.insists && !moment.busy && moment.now - told.last >= kAgain;
    if ((words == told.said && !again) || (!due && !said_all)) continue;
    told.said = words;
    told.last = moment.now;
    if (!said_all) said_.say(scratch_.text());
    told_to_wait_ = node.waits && !said_all;
  }
  // An alert that comes again is new: the second wrong code is told as the first was.
  std::erase_if(told_, [](const Told& told) { return told.alert && !told.there; });
  scratch_.clear();
}

Cues cues_of(const ViewState& view, const Visit& visit) {
  Cues now{.screen = view.screen, .step = visit.step, .trouble = view.trouble};
  if (visit.step == Step::Position) now.number = visit.countdown_number(view.live);
  if (view.live.turn) now.sides = view.live.turn->taken.count();
  if (view.service != nullptr && view.service->technician != nullptr)
    now.views = view.service->technician->calibration.views;
  return now;
}

Cue cue(const Cues& before, const Cues& now) {
  const bool other_screen = before.screen != now.screen, other_step = before.step != now.step;
  if (other_step && now.step == Step::Thanks) return Cue::Done;
  const bool begun = before.step != Step::Starting && before.step != Step::Attract;
  if (other_step && now.step == Step::Trouble && begun) return Cue::Refused;
  const auto not_stored = [](Trouble t) { return t == Trouble::Storage || t == Trouble::StorageFull; };
  if (!not_stored(before.trouble) && not_stored(now.trouble)) return Cue::Refused;
  if (other_screen && now.screen == Screen::Position && now.trouble == Trouble::Refused) return Cue::Refused;
  // Only what is over was taken.
  if (before.screen == Screen::Capture && (now.screen == Screen::Turn || now.screen == Screen::Match))
    return Cue::Shutter;
  if (now.screen == Screen::Turn && now.sides > before.sides) return Cue::Shutter;
  if (now.views > before.views) return Cue::Taken;
  return now.number != 0 && now.number != before.number ? Cue::Tick : Cue::None;
}

std::optional<float> guide_pitch(const ViewState& view, const Visit& visit) {
  if (visit.step != Step::Position || visit.overlay != Overlay::None) return std::nullopt;
  const float away = away_of(view.live);
  if (away < 0) return std::nullopt;
  return std::exp2(1 - 2 * std::min(1.0F, away));
}

}  // namespace relievo::ui
