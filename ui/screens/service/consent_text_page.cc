// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which consent text visitors read, and how the operator's own comes from a stick: the operator's page, and a
// step of the first start.
#include "ui/screens/service/fault_words.h"
#include "ui/screens/service/pin_entry.h"
#include "ui/screens/service/staff_pages.h"
#include "ui/view/staff_views.h"

namespace relievo::ui {
namespace {

constexpr const char* kFetch = "\uf553";

// Every language with the title its visitors read.
void titles(StaffFrame& page, const ConsentTexts& own) {
  for (std::size_t i = 0; i < kLanguages; ++i) {
    const auto language = static_cast<Language>(i);
    const ConsentText* text = own.of(language);
    if (text != nullptr) page.row(info_of(language).code, info_of(language).own_name, text->title);
  }
}

void ended(StaffFrame& page, const ConsentTextsView& seen) {
  const auto& tr = page.tr;
  if (seen.taking) return page.status("outcome", tr("One moment, please"), Mood::Plain);
  if (seen.outcome == Outcome::None) return;
  if (seen.outcome == Outcome::Done)
    return page.status("outcome", tr("Visitors read the text that is on the stick."), Mood::Good);
  if (seen.outcome == Outcome::NoStick) {
    page.status("outcome", tr("There is no stick. Plug one in, then try again."), Mood::Bad);
  } else if (seen.outcome == Outcome::StickGone) {
    page.status("outcome", tr("The stick was pulled out too early. Plug it in, then try again."), Mood::Bad);
  } else if (seen.fault != nullptr) {
    page.status("outcome", words_of(tr, seen.fault->code), Mood::Bad);
    page.detail(seen.fault->detail);
  }
  page.line(tr("Nothing was changed."));
}

}  // namespace

void consent_in_force(StaffFrame& page) {
  const auto& tr = page.tr;
  const ConsentTexts* own = page.view.consent;
  page.begin_list("consent");
  if (page.staff.consent != nullptr) ended(page, *page.staff.consent);
  if (own == nullptr)
    page.status("in force", tr("Visitors read our sample. No lawyer has reviewed it; it says so."),
                Mood::Warn);
  else
    page.status("in force",
                page.filled(tr("Visitors read your text, version {}. They are offered these languages:"),
                            own->version),
                Mood::Good);
  if (own != nullptr) titles(page, *own);
  page.section(tr("A text of your own"));
  page.line(tr(
      "On a stick, in the folder consent/VERSION, a file for each language, saved as UTF-8: en.txt, de.txt, fr.txt, es.txt, ar.txt, he.txt, zh-Hans.txt, ja.txt. VERSION is a name of your choice, such as 2026-03; of several the last in order is taken."));
  page.line(tr(
      "The first line is the title. Then, after an empty line each, the points: a title, and the words below it."));
  page.tree.close();
  const bool busy = page.staff.consent == nullptr || page.staff.consent->taking;
  page.small_button("take consent", tr("Load from the stick"), kFetch, ButtonLook::Quiet,
                    busy ? Action{} : Action(TakeConsentText{}));
}

void consent_text_page(StaffFrame& page) { consent_in_force(page); }

}  // namespace relievo::ui
