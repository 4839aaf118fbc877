// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Who is kept here: search, look at one with the portrait to be turned, export to a stick, erase.
#include "ui/view/staff_views.h"

#include <array>

#include "ui/screens/parts/page.h"
#include "ui/screens/service/staff_frame.h"

namespace relievo::ui {
namespace {

enum RecordsMode : int { kList, kTyping, kErasing };

// What one has typed, and the keys.
void typing(StaffFrame& page) {
  const Action done(FindRecords{}, true);
  page.typed_field("search field", page.tr("Search"), done);
  if (page.portrait) page.space(1);
  keyboard(page, done);
}

void working(StaffFrame& page) {
  page.tree.open(justified(page.grown(page.box(Flow::Column, space::kM, space::kXl, 0)), Justify::Centre));
  page.heading("writing", page.tr("Writing to the stick"), type::kHeading, TextAlign::Centre);
  page.body("do not pull", page.tr("Please do not pull it out."), TextAlign::Centre);
  page.progress("export progress", page.staff.work.progress);
  page.tree.close();
  page.button("stop export", page.tr("Stop"), icon::kClose, ButtonLook::Quiet, StopExport{});
}

void whole_of(StaffFrame& page, const RecordsView& seen) {
  page.put("whole", Role::Status,
           page.filled(page.tr("Complete on the stick: {} of {}. Nothing else on it counts."),
                       {page.number(seen.whole), page.number(seen.asked)}),
           type::kSmall, Weight::Regular, page.palette.ink);
}

void said(StaffFrame& page, const RecordsView& seen) {
  const Outcome outcome = page.staff.work.outcome;
  if (outcome == Outcome::Done && (seen.erased || seen.exported)) {
    const char* words = seen.erased
                            ? page.tr("Erased. Nothing of this person is left.")
                            : page.tr("It is all there and has been read back. You can pull out the stick.");
    page.status("outcome", words, Mood::Good);
    return;
  }
  // Of an export it matters what the stick has; one that was pulled out has nothing that is sure.
  if (seen.asked > 0 && outcome == Outcome::StickFull)
    page.status("outcome", page.tr("The stick is full. Please use another one."), Mood::Bad);
  else page.outcome();
  const bool counts = outcome == Outcome::StickFull || outcome == Outcome::Cancelled ||
                      outcome == Outcome::Failed || outcome == Outcome::StickBad;
  if (seen.asked > 1 && counts) whole_of(page, seen);
}

// The text of a consent, as filters and the record itself name it.
using FilterNames = std::array<std::string_view, 1 + kRecordFilters>;
ListFilters filters_of(StaffFrame& page, const RecordsView& seen, FilterNames& names) {
  names[0] = page.tr("All");
  for (std::size_t i = 0; i < seen.filters.size(); ++i)
    names[1 + i] =
        seen.filters[i].letter
            ? seen.filters[i].text
            : page.joined({page.tr("Consent text"), " ", page.left_to_right(seen.filters[i].text)});
  return {names.data(), 1 + seen.filters.size()};
}

// What nobody was found for: digits are those of a code, or of a part of one.
const char* nobody(const Words& tr, const RecordsView& seen) {
  if (seen.searched.empty() && seen.place.filter == 0) return tr("There is none yet");
  const bool code = seen.searched.find_first_of("0123456789") != std::string_view::npos &&
                    seen.searched.find_first_not_of("0123456789 -") == std::string_view::npos;
  return code ? tr("No record has this code. Please check it, or ask the staff.")
              : tr("There is nobody of that name.");
}

void list(StaffFrame& page, const RecordsView& seen, ListFilters filters) {
  const auto& tr = page.tr;
  said(page, seen);
  if (!seen.searched.empty()) {
    const auto in_row = page.tree.inside(page.row_box(space::kXs));
    page.sign(icon::kSearch, 22, page.palette.ink_soft);
    page.put("searched", Role::Status, seen.searched, type::kSmall, Weight::Medium, page.palette.ink);
  }
  page.begin_list("records");
  for (const RecordRow& row : seen.rows)
    page.row(page.id("record", std::size_t(row.number)), row.name, page.date(row.since), Mood::Plain,
             ShowRecord{row.number});
  if (seen.rows.empty()) page.nothing("nobody", icon::kPerson, nobody(tr, seen));
  page.tree.close();
  // One filters, or searches; where there is nobody there is nothing to be chosen among.
  const bool filtered = seen.place.filter > 0;
  list_pager(page, seen.place,
             seen.searched.empty() && (filtered || !seen.rows.empty()) ? filters : ListFilters());
  const bool narrow = page.little_room();
  const float share = narrow ? 1.0F : 0.0F;
  const auto in_box = page.tree.inside(page.box(Flow::Row, space::kS));
  page.small_button("search", tr("Search"), icon::kSearch, ButtonLook::Main, {ActionKind::StaffMode, kTyping},
                    share);
  if (!seen.searched.empty())
    page.small_button("all", tr("All"), nullptr, ButtonLook::Quiet, FindRecords{}, share);
  if (narrow) {
    page.tree.close();
    page.tree.open(page.box(Flow::Row, space::kS));
  } else {
    page.space(1);
  }
  if (!seen.rows.empty())
    page.small_button("export all", tr("Export all to the stick"), icon::kStick, ButtonLook::Quiet,
                      ExportFound{}, share);
}

void portrait_of(StaffFrame& page) {
  const auto in_card = page.tree.inside(page.stage(size::kCardRadius, 1.1F));
  Node face = page.model("face", page.tr("The model: turn it with a finger"), size::kCardRadius);
  if (page.staff.model == nullptr) face.mark = Mark::Shape;
  page.tree.leaf(face);
}

void record(StaffFrame& page, const RecordsView& seen) {
  const auto& tr = page.tr;
  const auto in_box = page.tree.inside(page.grown(page.abreast_box(space::kM)));
  portrait_of(page);
  const auto in_box_2 = page.tree.inside(page.grown(page.box(Flow::Column, space::kS)));
  page.begin_panel("record");
  page.row("name", seen.shown->name, {});
  page.row("code", tr("Code for the erasure"), seen.shown->code);
  page.row("since", tr("Kept since"), page.date(seen.shown->since));
  page.row("portraits", tr("Portraits"), page.number(seen.shown->portraits));
  page.row("consent", tr("Consent"), page.date(seen.consented_at));
  page.row("consent text", tr("Consent text"), seen.consent);
  page.tree.close();
  said(page, seen);
  page.small_button("export", tr("Export to the stick"), icon::kStick, ButtonLook::Main,
                    ExportRecord{seen.shown->number});
  page.small_button("erase", tr("Erase this record"), icon::kBin, ButtonLook::Quiet,
                    {ActionKind::StaffMode, kErasing});
}

// A big question in place of the page, of what nobody can undo. Who it is about stays in view: the portrait,
// too, where there is room.
void erasing(StaffFrame& page, const RecordRow& shown) {
  const auto& tr = page.tr;
  const bool narrow = page.portrait || page.text_share > 1.3F;
  page.tree.open(page.grown(page.box(Flow::Row, space::kM)));
  if (!narrow) portrait_of(page);
  page.tree.open(
      scroller("question", justified(page.grown(page.box(Flow::Column, space::kM)), Justify::Centre)));
  page.heading("question title", tr("Erase this record"), type::kHeading);
  page.heading("question about", page.filled("{}", shown.name), type::kBody);
  page.body("question code", page.filled("{}", shown.code));
  page.body("question words",
            tr("Name, consent and every portrait of this person are erased. Nobody can bring them back."));
  const char* how = tr(
      "Hold the button for three seconds; let go sooner and nothing happens. With keys: press once and wait; any other key calls it back.");
  page.put("question hint", Role::Text, how, type::kSmall, Weight::Medium, page.palette.ink);
  page.tree.close(2);
  const auto in_row = page.tree.inside(page.box(narrow ? Flow::Column : Flow::Row, space::kS));
  const float share = narrow ? 0.0F : 1.0F;
  page.button("no", tr("Back"), nullptr, ButtonLook::Main, {ActionKind::StaffMode, kList}, share);
  page.button("yes", tr("Hold to erase"), icon::kBin, ButtonLook::Grave, {EraseRecord{shown.number}, true},
              share);
}

}  // namespace

void records_page(StaffFrame& page) {
  const auto& tr = page.tr;
  const RecordsView* seen = page.staff.records;
  if (seen == nullptr) return page.body("wait", tr("One moment, please"));
  if (page.staff.work.running) return working(page);
  if (page.service.mode == kTyping) return typing(page);
  FilterNames names;
  const ListFilters filters = filters_of(page, *seen, names);
  if (seen->looks) page.progress("look progress", page.staff.work.progress);
  if (seen->shown == nullptr && list_choice(page, seen->place, filters)) return;
  if (seen->shown == nullptr) return list(page, *seen, filters);
  if (page.service.mode != kErasing) return record(page, *seen);
  erasing(page, *seen->shown);
}

}  // namespace relievo::ui
