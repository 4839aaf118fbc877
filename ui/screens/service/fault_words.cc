// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/screens/service/fault_words.h"

#include <array>

namespace relievo::ui {
namespace {

// In the order of Errc.
constexpr std::array kFaultWords{mark_tr("This cannot be used"),
                                 mark_tr("Something is missing"),
                                 mark_tr("It took too long"),
                                 mark_tr("A device was pulled out or does not answer"),
                                 mark_tr("The cameras must be calibrated"),
                                 mark_tr("No face found"),
                                 mark_tr("Too little could be matched"),
                                 mark_tr("The measurement is not good enough"),
                                 mark_tr("The program could not finish this"),
                                 mark_tr("Not enough memory"),
                                 mark_tr("There is no stick. Plug one in, then try again."),
                                 mark_tr("There is no room left"),
                                 mark_tr("The store is damaged"),
                                 mark_tr("The store is from a newer version"),
                                 mark_tr("Reading or writing failed"),
                                 mark_tr("It was stopped"),
                                 mark_tr("This is not possible now"),
                                 mark_tr("This device cannot do that")};
static_assert(kFaultWords.size() == static_cast<std::size_t>(Errc::Unsupported) + 1);

// In the order of LogEvent: what is said, and of whom.
constexpr std::array<std::array<const char*, 2>, static_cast<std::size_t>(LogEvent::Count)> kLogWords{
    {{mark_tr("Started")},
     {mark_tr("Signed out")},
     {mark_tr("Signed in: {}"), mark_tr("Technician")},
     {mark_tr("Signed in: {}"), mark_tr("Operator")},
     {mark_tr("A wrong PIN was typed")},
     {mark_tr("The clock was set")},
     {mark_tr("A new PIN was chosen: {}"), mark_tr("Technician")},
     {mark_tr("A new PIN was chosen: {}"), mark_tr("Operator")},
     {mark_tr("The PIN was forgotten: {}"), mark_tr("Technician")},
     {mark_tr("The PIN was forgotten: {}"), mark_tr("Operator")},
     {mark_tr("The touch screen is taken as it is.")},
     {mark_tr("The touch screen was corrected")},
     {mark_tr("Setting “{}”: {}")},
     {mark_tr("Records exported: {}")},
     {mark_tr("Records erased for their age: {}")},
     {mark_tr("Record #{} was erased")},
     {mark_tr("Self-test begun")},
     {mark_tr("Consent text {} was taken over")},
     {mark_tr("The setting “{}” is not one: what is usual holds")}}};
static_assert(kLogWords.back()[0] != nullptr);

}  // namespace

const char* words_of(const Words& tr, Errc code) { return tr(kFaultWords[static_cast<std::size_t>(code)]); }

LogWords words_of(const Words& tr, LogEvent event) {
  if (event >= LogEvent::Count) return {""};
  const auto& [words, whom] = kLogWords[static_cast<std::size_t>(event)];
  return {tr(words), whom != nullptr ? tr(whom) : nullptr};
}

}  // namespace relievo::ui
