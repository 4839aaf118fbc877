// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/technician/test_capture.h"

#include <algorithm>
#include <string_view>

namespace relievo::firmware {
namespace {

constexpr std::size_t kMostTyped = 24;

bool contains(const std::vector<std::string>& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

bool belongs(std::string_view option, std::string_view kind, std::string_view name) {
  const std::string_view section = option.substr(0, option.find('.'));
  if (kind == "relief") return section == "relief" && name == "check";
  if (kind == "triangulator")
    return section == "face" || section == name;  // what is cut off belongs to the points
  return section == name;
}

// Rules in the order in which they judge.
std::string joined(const std::vector<std::string>& order, const std::vector<std::string>& chosen) {
  std::string text;
  for (const std::string& name : order) {
    if (name == "none" || !contains(chosen, name)) continue;
    text += (text.empty() ? "" : "+") + name;
  }
  return text.empty() ? "none" : text;
}

}  // namespace

AlgorithmController::AlgorithmController() : all_(pipeline::describe_algorithms()) {
  for (const auto& one : all_) {
    if (!one.is_option() && one.key != "fuser") kinds_.push_back(&one);  // the page takes one pair
  }
  rebuild();
}

void AlgorithmController::begin(const pipeline::AlgorithmSet& set) {
  set_ = set;
  editing_ = false;
  rebuild();
}

void AlgorithmController::rebuild() {
  kind_values_.clear();
  for (const auto* kind : kinds_) kind_values_.push_back(set_.get(kind->key));
  kind_views_.clear();
  for (std::size_t i = 0; i < kinds_.size(); ++i)
    kind_views_.push_back({kinds_[i]->key, kind_values_[i], kinds_[i]->sentence, kinds_[i]->several});
  const pipeline::OptionDescription& kind = *kinds_[kind_];
  const std::vector<std::string> chosen = pipeline::split_names(kind_values_[kind_]);
  names_.clear();
  for (const std::string& name : kind.names) names_.push_back({name, contains(chosen, name)});
  shown_.clear();
  for (const std::string& name : chosen) {
    for (const auto& option : all_) {
      const bool mine = option.is_option() && belongs(option.key, kind.key, name);
      if (mine && std::ranges::find(shown_, &option) == shown_.end()) shown_.push_back(&option);
    }
  }
  option_values_.clear();
  for (const auto* option : shown_) option_values_.push_back(set_.get(option->key));
  options_.clear();
  for (std::size_t i = 0; i < shown_.size(); ++i)
    options_.push_back({shown_[i]->key, option_values_[i], shown_[i]->sentence, shown_[i]->range.least,
                        shown_[i]->range.most, shown_[i]->text, option_values_[i] != shown_[i]->value});
  if (edited_ >= options_.size()) editing_ = false;
}

void AlgorithmController::choose_name(std::size_t index) {
  const pipeline::OptionDescription& kind = *kinds_[kind_];
  if (index >= kind.names.size()) return;
  std::string value = kind.names[index];
  if (kind.several && value != "none") {
    std::vector<std::string> chosen = pipeline::split_names(kind_values_[kind_]);
    const auto at = std::ranges::find(chosen, value);
    if (at == chosen.end()) chosen.push_back(value);
    else chosen.erase(at);
    value = joined(kind.names, chosen);
  }
  use(value);
}

void AlgorithmController::use(const std::string& value) {
  const std::string& key = editing_ ? shown_[edited_]->key : kinds_[kind_]->key;
  const Result<void> taken = set_.set(key, value);
  refused_ = taken ? "" : std::string(taken.error().where());
  if (taken) editing_ = false;
  rebuild();
}

void AlgorithmController::edit(std::size_t index) {
  if (index >= options_.size()) return;
  editing_ = true;
  edited_ = index;
  typed_.clear();
  refused_.clear();
  // Of a few names a tap takes the next.
  const std::vector<std::string>& names = shown_[index]->names;
  if (names.empty()) return;
  const auto now = std::ranges::find(names, option_values_[index]);
  use(now + 1 < names.end() ? *(now + 1) : names.front());
}

void AlgorithmController::type(char letter) {
  const bool fits = (letter >= '0' && letter <= '9') || letter == '.' || letter == '-' || letter == 'e';
  if (editing_ && fits && typed_.size() < kMostTyped) typed_ += letter;
  refused_.clear();
}

bool AlgorithmController::act(const ui::TechnicianRequest& request) {
  if (const auto* alone = std::get_if<ui::TechnicianAct>(&request)) return act_alone(*alone);
  if (const auto* kind = std::get_if<ui::ChooseKind>(&request)) {
    if (kind->index >= kinds_.size()) return true;
    kind_ = kind->index;
    editing_ = false;
    rebuild();
  } else if (const auto* name = std::get_if<ui::ChooseName>(&request)) {
    editing_ = false;
    choose_name(name->index);
  } else if (const auto* option = std::get_if<ui::EditOption>(&request)) edit(option->index);
  else if (const auto* typed = std::get_if<ui::TypeDigit>(&request)) type(typed->digit);
  else return false;
  return true;
}

bool AlgorithmController::act_alone(ui::TechnicianAct act) {
  using enum ui::TechnicianAct;
  const bool uses = act == UseTyped || act == UseDefault;
  if (act == EraseDigit && !typed_.empty()) typed_.pop_back();
  if (uses && editing_) use(act == UseTyped ? typed_ : shown_[edited_]->value);
  if (act == LeaveOption) editing_ = false;
  if (act == ResetSet) begin({});
  return uses || act == EraseDigit || act == LeaveOption || act == ResetSet;
}

ui::TechnicianChoice AlgorithmController::view() const {
  ui::TechnicianChoice view;
  view.kinds = kind_views_;
  view.kind = kind_;
  view.names = names_;
  view.options = options_;
  view.edited = editing_ ? &options_[edited_] : nullptr;
  view.typed = typed_;
  view.refused = refused_;
  return view;
}

}  // namespace relievo::firmware
