// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/kiosk/script/script.h"

#include <fstream>
#include <locale>
#include <sstream>

namespace relievo::firmware {
namespace {

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

Error wrong(const std::string& where, Literal what) { return Error{Errc::InvalidInput, what}.at(where); }

bool length_of(std::istringstream& words, double& seconds) {
  return (words >> seconds) && seconds >= 0 && seconds <= kLongestS;
}

std::string rest_of(std::istringstream& words) {
  std::string rest;
  std::getline(words >> std::ws, rest);
  while (!rest.empty() && (rest.back() == ' ' || rest.back() == '\r' || rest.back() == '\t')) rest.pop_back();
  return rest;
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
      if (!(words >> action.word) || !length_of(words, action.seconds))
        return wrong(action.where, "wants an id and a number of seconds, as hold staff 3");
      break;
    case Kind::Drag:
      if (!(words >> action.word >> action.dx_px >> action.dy_px))
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
    case Kind::Unplug:
      break;
  }
  if (!(words >> std::ws).eof()) return wrong(action.where, "has words too many");
  return action;
}

}  // namespace

Result<std::vector<ScriptAction>> read_script_line(const std::string& line, const std::string& where) {
  if (line.size() > kMostBytes) return wrong(where, "is too long for a line of a script");
  std::istringstream words(line);
  words.imbue(std::locale::classic());
  std::string verb;
  if (!(words >> verb) || verb.front() == '#') return std::vector<ScriptAction>{};
  for (const Verb& known : kVerbs) {
    if (verb != known.word) continue;
    ScriptAction action{known.kind, {}, 0, 0, 0, where};
    if (!known.rest) {
      RELIEVO_TRY_ASSIGN(auto whole, numbers_of(std::move(action), words));
      return std::vector<ScriptAction>{std::move(whole)};
    }
    action.word = rest_of(words);
    if (action.word.empty()) return wrong(where, "wants a word after it");
    return std::vector<ScriptAction>{std::move(action)};
  }
  return wrong(where, "is no action: use wait, tap, hold, drag, type, pause, screenshot, plug or unplug");
}

Result<std::vector<ScriptAction>> read_script(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) return Error{Errc::NotFound, "cannot be read: give the file of a script"}.at(file.string());
  std::vector<ScriptAction> script;
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    const std::string where = file.string() + ":" + std::to_string(number);
    if (number > kMostLines) return wrong(where, "is one line too many for a script");
    RELIEVO_TRY_ASSIGN(auto actions, read_script_line(line, where));
    for (ScriptAction& action : actions) script.push_back(std::move(action));
  }
  if (in.bad()) return Error{Errc::IoFailed, "could not be read to its end"}.at(file.string());
  if (script.empty()) return wrong(file.string(), "has no action in it");
  return script;
}

}  // namespace relievo::firmware
