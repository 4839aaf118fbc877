// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/kiosk/script/script_player.h"

#include <strings.h>
#include <time.h>

#include <algorithm>
#include <fstream>
#include <locale>
#include <sstream>

#include "hal/base/utf8.h"
#include "hal/base/words.h"

namespace relievo::firmware {
namespace {

using std::chrono::duration;
using std::chrono::steady_clock;

constexpr long kSettling = 10;  // frames of a page before it is as it stays

double thread_seconds() {
  timespec at{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &at);
  return double(at.tv_sec) + 1e-9 * double(at.tv_nsec);
}

using Kind = ScriptAction::Kind;

constexpr std::size_t kMostLines = 10'000, kMostBytes = 256;  // of a script, of a line
constexpr double kWaitAtMostS = 60, kLongestS = 3600;

struct Verb {
  const char* word;
  Kind kind;
  bool rest;  // its word is the rest of the line
};
constexpr Verb kVerbs[] = {{"wait", Kind::Wait, false},
                           {"tap", Kind::Tap, true},
                           {"hold", Kind::Hold, false},
                           {"drag", Kind::Drag, false},
                           {"type", Kind::Type, true},
                           {"pause", Kind::Pause, false},
                           {"screenshot", Kind::Screenshot, false},
                           {"plug", Kind::Plug, true},
                           {"unplug", Kind::Unplug, false}};

Error wrong(const std::string& where, Literal what) { return invalid(what).at(where); }

bool length_of(std::istringstream& words, double& seconds) {
  return (words >> seconds) && seconds >= 0 && seconds <= kLongestS;
}

std::string rest_of(std::istringstream& words) {
  std::string rest;
  std::getline(words >> std::ws, rest);
  while (!rest.empty() && (rest.back() == ' ' || rest.back() == '\r' || rest.back() == '\t')) rest.pop_back();
  return rest;
}

// What stands before so many numbers at the end of the line: ids have blanks in them.
std::string id_before(std::size_t numbers, std::istringstream& words) {
  std::string id = rest_of(words);
  std::size_t at = id.size();
  for (; numbers > 0 && at != std::string::npos; --numbers) {
    at = id.find_last_of(" \t", at - 1);
    if (at != std::string::npos) at = id.find_last_not_of(" \t", at) + 1;
  }
  if (at == std::string::npos || at == 0) return {};
  words = std::istringstream(id.substr(at));
  words.imbue(std::locale::classic());
  id.resize(at);
  return id;
}

Result<ScriptAction> numbers_of(ScriptAction action, std::istringstream& words) {
  switch (action.kind) {
    case Kind::Wait:
      action.seconds = kWaitAtMostS;
      if (!(words >> action.word)) return wrong(action.where, "wait for which state?");
      if (!(words >> std::ws).eof() && !length_of(words, action.seconds))
        return wrong(action.where, "wants a number of seconds, 0 to 3600");
      break;
    case Kind::Hold:
      action.word = id_before(1, words);
      if (action.word.empty() || !length_of(words, action.seconds))
        return wrong(action.where, "wants an id and a number of seconds, as hold staff 3");
      break;
    case Kind::Drag:
      action.word = id_before(2, words);
      if (action.word.empty() || !(words >> action.dx_px >> action.dy_px))
        return wrong(action.where, "wants an id and two numbers of pixels, as drag face 120 0");
      break;
    case Kind::Pause:
      if (!length_of(words, action.seconds))
        return wrong(action.where, "wants a number of seconds, 0 to 3600");
      break;
    case Kind::Screenshot:
      if (!(words >> action.word) || action.word.find_first_of("/\\") != std::string::npos ||
          action.word.front() == '.')
        return wrong(action.where, "wants a name without a folder, as screenshot review");
      break;
    case Kind::Tap:
    case Kind::Type:
    case Kind::Plug:
    case Kind::Unplug: break;
  }
  if (!(words >> std::ws).eof()) return wrong(action.where, "has words too many");
  return action;
}

constexpr double kOnTheScreenS = 20;  // an id is waited for
constexpr int kDragSteps = 8;
constexpr std::array<const char*, 3> kKeysToTry{"shift", "other_letters", "shift"};

bool same(std::string_view a, std::string_view b) {
  return a.size() == b.size() && strncasecmp(a.data(), b.data(), a.size()) == 0;
}

bool is_there(std::string_view state, const Kiosk& kiosk) {
  return same(state, ui::info_of(kiosk.ui().visit().step).name) ||
         same(state, name_of(kiosk.appliance().state()));
}

// Where a finger would go, if it can. Whoever reads the page comes no sooner.
const ui::Node* touchable(const Kiosk& kiosk, std::string_view id) {
  const ui::Node* node = kiosk.ui().tree().find(id);
  if (node == nullptr || kiosk.ui().has_just_come(kiosk.view().now)) return nullptr;
  const ui::Node* const met =
      kiosk.ui().tree().at(node->rect.x + node->rect.w / 2, node->rect.y + node->rect.h / 2);
  return met != nullptr && met->id == node->id ? node : nullptr;
}

}  // namespace

void VisitFigures::begin() {
  taken_before_ = allocations_ ? allocations_() : 0;
  begun_s_ = thread_seconds();
}

void VisitFigures::made() {
  made_s_ = thread_seconds();
  taken_after_ = allocations_ ? allocations_() : 0;
}

void VisitFigures::shown(const Kiosk& kiosk, bool drawn) {
  const auto now = steady_clock::now();
  const double drawn_s = thread_seconds();
  const ui::Step step = kiosk.ui().visit().step;
  PageCost& cost = pages_[std::size_t(step)];
  if (step != last_) cost.waited = 0;
  last_ = step;
  follow(kiosk, now);
  if (++cost.waited <= kSettling) {
    cost.from = cost.frames == 0 ? now : cost.from;
    return;
  }
  ++cost.frames;
  cost.drawn += drawn ? 1 : 0;
  cost.until = now;
  cost.turn_s += made_s_ - begun_s_;
  cost.most_turn_s = std::max(cost.most_turn_s, made_s_ - begun_s_);
  cost.draw_s += drawn_s - made_s_;
  cost.allocations += taken_after_ - taken_before_;
  cost.allocating_frames += taken_after_ > taken_before_ ? 1 : 0;
}

void VisitFigures::follow(const Kiosk& kiosk, steady_clock::time_point now) {
  const ui::Visit& visit = kiosk.ui().visit();
  const ui::ViewState& view = kiosk.view();
  if (visit.step == ui::Step::Consent) still_to_face_s_ = still_to_shot_s_ = std::nullopt;
  if (visit.step == ui::Step::Position && view.screen == ui::Screen::Position) {
    const bool still = view.live.advice == pipeline::Advice::None && view.live.steady_s > 0;
    if (!still) still_at_.reset();
    else if (!still_at_)
      still_at_ =
          now - std::chrono::duration_cast<steady_clock::duration>(duration<float>(view.live.steady_s));
  }
  // How long the head turns is the person's own time.
  if (visit.step == ui::Step::Turn && !turns_at_) turns_at_ = now;
  if (visit.step != ui::Step::Turn && turns_at_) {
    if (still_at_) *still_at_ += now - *turns_at_;
    turns_at_.reset();
  }
  const bool shot =
      view.screen == ui::Screen::Capture || visit.step == ui::Step::Turn || visit.step == ui::Step::Working;
  if (shot && still_at_ && !still_to_shot_s_) still_to_shot_s_ = duration<double>(now - *still_at_).count();
  const bool face = visit.step == ui::Step::Review && kiosk.ui().draw_list().faces[0].model != nullptr;
  if (face && still_at_) {
    still_to_face_s_ = duration<double>(now - *still_at_).count();
    still_at_.reset();
  }
  if (visit.step == ui::Step::Thanks) touches_ = visit.touches;
}

std::optional<double> VisitFigures::rate(const PageCost& page) {
  const double passed = duration<double>(page.until - page.from).count();
  return page.frames > 1 && passed > 0 ? std::optional<double>(double(page.frames) / passed) : std::nullopt;
}

std::vector<std::string> VisitFigures::lines() const {
  std::vector<std::string> said;
  if (touches_ > 0)
    said.push_back(printed("touches from yes to thanks, without text   %6d    bar 6", touches_));
  if (still_to_face_s_) {
    const double shot = still_to_shot_s_.value_or(0);
    said.push_back(printed(
        "standing still to the face on the screen   %6.2f s  bar 4 (%.2f s to the shot, %.2f s from there)",
        *still_to_face_s_, shot, *still_to_face_s_ - shot));
  }
  if (const auto live = rate(pages_[std::size_t(ui::Step::Position)]))
    said.push_back(printed("frames a second on the live page           %6.1f    bar 20", *live));
  said.push_back(
      "page       frames  a second  changed  ms of processor a frame: ours  most  drawing with the GL driver  heap blocks taken");
  for (std::size_t i = 0; i < kPages; ++i) {
    const PageCost& p = pages_[i];
    if (p.frames == 0) continue;
    const double n = double(p.frames);
    std::string row = printed("%-10s %6ld  %8.1f  %7ld  %29.3f %5.2f  %26.2f  ", ui::kSteps[i].name.data(),
                              p.frames, rate(p).value_or(0), p.drawn, 1e3 * p.turn_s / n, 1e3 * p.most_turn_s,
                              1e3 * p.draw_s / double(std::max(1L, p.drawn)));
    row += allocations_ ? printed("%ld in %ld frames", p.allocations, p.allocating_frames)
                        : std::string("not counted");
    said.push_back(std::move(row));
  }
  return said;
}

Result<std::optional<ScriptAction>> read_script_line(const std::string& line, const std::string& where) {
  if (line.size() > kMostBytes) return wrong(where, "is too long for a line of a script");
  std::istringstream words(line);
  words.imbue(std::locale::classic());
  std::string verb;
  if (!(words >> verb) || verb.front() == '#') return std::optional<ScriptAction>();
  for (const Verb& known : kVerbs) {
    if (verb != known.word) continue;
    ScriptAction action{known.kind, {}, 0, 0, 0, where};
    if (known.rest) {
      action.word = rest_of(words);
      if (action.word.empty()) return wrong(where, "wants a word after it");
    } else {
      RELIEVO_TRY_ASSIGN(action, numbers_of(std::move(action), words));
    }
    return std::optional(std::move(action));
  }
  return wrong(where, "is no action: use wait, tap, hold, drag, type, pause, screenshot, plug or unplug");
}

Result<std::vector<ScriptAction>> read_script(const std::filesystem::path& file) {
  std::ifstream source(file);
  if (!source) return Error{Errc::NotFound, "cannot be read: give the file of a script"}.at(file.string());
  std::string text(kMostLines * kMostBytes, '\0');  // what has no end is cut in a line too long
  source.read(text.data(), std::streamsize(text.size()));
  text.resize(std::size_t(source.gcount()));
  if (source.bad()) return Error{Errc::IoFailed, "could not be read to its end"}.at(file.string());
  std::istringstream in(std::move(text));
  std::vector<ScriptAction> script;
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    const std::string where = file.string() + ":" + std::to_string(number);
    if (number > kMostLines) return wrong(where, "is one line too many for a script");
    RELIEVO_TRY_ASSIGN(auto action, read_script_line(line, where));
    if (action) script.push_back(*std::move(action));
  }
  if (script.empty()) return wrong(file.string(), "has no action in it");
  return script;
}

Result<bool> ScriptPlayer::turn(const Kiosk& kiosk, hal::Instant now) {
  if (next_ == script_.size()) return false;
  if (!since_) since_ = now;
  RELIEVO_TRY_ASSIGN(const bool done, act(script_[next_], kiosk, now));
  if (!done) return true;
  ++next_;
  since_.reset();
  typed_ = 0;
  return true;
}

Result<bool> ScriptPlayer::act(const ScriptAction& action, const Kiosk& kiosk, hal::Instant now) {
  const double passed = duration<double>(now - *since_).count();
  switch (action.kind) {
    case Kind::Wait:
      if (is_there(action.word, kiosk)) return true;
      if (passed > action.seconds)
        return Error{Errc::Timeout, "the state was not reached in time"}.at(action.where);
      return false;
    case Kind::Tap:
    case Kind::Hold:
    case Kind::Drag: return touch(action, kiosk, now);
    case Kind::Type: return type(action, kiosk, now);
    case Kind::Pause: return passed >= action.seconds;
    case Kind::Screenshot: screenshot_ = action.word; return true;
    case Kind::Plug:
    case Kind::Unplug:
      if (!hands_.plug)
        return Error{Errc::Unsupported, "these cameras have no stick that a script could plug"}.at(
            action.where);
      RELIEVO_TRY(hands_.plug(action.word));
      return true;
  }
  return true;
}

// A frame with the finger down, one without: as the screen sees a person.
Result<bool> ScriptPlayer::touch(const ScriptAction& action, const Kiosk& kiosk, hal::Instant now) {
  if (!down_at_) {
    const ui::Node* const node = touchable(kiosk, action.word);
    if (node == nullptr) {
      if (duration<double>(now - *since_).count() > kOnTheScreenS)
        return Error{Errc::Timeout, "is not on the screen, or lies under something"}.at(action.where + ": " +
                                                                                        action.word);
      return false;
    }
    x_ = node->rect.x + node->rect.w / 2;
    y_ = node->rect.y + node->rect.h / 2;
    finger(ui::Input::Kind::Down);
    down_at_ = now;
    moved_ = 0;
    return false;
  }
  if (action.kind == Kind::Drag && moved_ < kDragSteps) {
    ++moved_;
    x_ += action.dx_px / kDragSteps;
    y_ += action.dy_px / kDragSteps;
    finger(ui::Input::Kind::Move);
    return false;
  }
  if (action.kind == Kind::Hold && duration<double>(now - *down_at_).count() < action.seconds) return false;
  finger(ui::Input::Kind::Up);
  down_at_.reset();
  return true;
}

// Letter by letter; for one that is not on the keyboard the other sets of keys are tried.
Result<bool> ScriptPlayer::type(const ScriptAction& action, const Kiosk& kiosk, hal::Instant now) {
  const std::size_t bytes = first_letter_of(std::string_view(action.word).substr(typed_)).bytes;
  const std::string letter = action.word.substr(typed_, std::max<std::size_t>(1, bytes));
  const std::string own = letter == " " ? "space" : "key " + letter;
  if (!down_at_) {
    const ui::Tree& tree = kiosk.ui().tree();
    const bool there = tree.find(own) != nullptr || tree.find("keyboard") == nullptr;
    if (!there && turned_ == kKeysToTry.size())
      return invalid("no key of this keyboard has this letter").at(action.where + ": " + letter);
    key_ = there ? own : kKeysToTry[turned_++];
  }
  RELIEVO_TRY_ASSIGN(const bool tapped, touch({Kind::Tap, key_, 0, 0, 0, action.where}, kiosk, now));
  if (!tapped || key_ != own) return false;
  typed_ += letter.size();
  turned_ = 0;
  since_ = now;
  return typed_ >= action.word.size();
}

}  // namespace relievo::firmware
