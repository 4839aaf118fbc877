// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What lies over a page: help, languages, "really leave?", "still there?". Nothing under it is touched.
#include <array>
#include <string>

#include "ui/screens/parts/page.h"

namespace relievo::ui {
namespace {

void language_key(Page& page, Language language) {
  const LanguageInfo& info = info_of(language);
  const bool now = language == page.visit.language;
  // Names of languages are short and many: they grow less than what is read.
  Node node = page.text(info.own_name, type::kBody, Weight::Medium,
                        now ? page.palette.accent_ink : page.palette.link, TextAlign::Centre);
  node.style.size_px = page.px(22 * (1 + (page.text_share - 1) * 0.4F));
  node.style.language = info.code;
  tell(node, Role::Button, info.code, {}, {ActionKind::ChooseLanguage, int(language)});
  if (now) node.value = page.tr("chosen");
  frame(node, now ? page.palette.accent : page.palette.quiet,
        now ? page.palette.accent : page.palette.quiet_border, page.px(2), page.px(size::kRadius));
  node.box.grow = 1;
  node.box.min_height = page.px(size::kTarget);
  node.box.pad_x = page.px(6);
  page.tree.leaf(node);
}

constexpr const char* kAskStaff = mark_tr("Please tell the staff.");

// In the order of Step.
constexpr std::array kHelp{
    mark_tr(
        "This device makes a three-dimensional portrait of your face. Touch Start. You can stop at any time."),
    mark_tr(
        "Read what happens, then choose. If you say no, nothing happens and nothing is kept. The staff will help you another way."),
    mark_tr("Type your name, or the number you were given. The arrow key erases a letter."),
    mark_tr(
        "Is that you? With the code you were given you can renew your portrait or add another one. Without it nothing from the record is shown."),
    mark_tr(
        "Stand about an arm's length away, so that your face fills the oval. Take off sunglasses and hat."),
    mark_tr(
        "Pictures from the sides show your whole head. Turn it slowly and hold it level: each side is taken by itself. If you cannot or do not want to, touch the button below."),
    mark_tr("Please wait a few seconds. To stop, touch the cross."),
    mark_tr("Turn the portrait with your finger. Nothing is stored until you say so."),
    mark_tr("To have it erased, quote this code to the staff. You can take a photo of it."),
    kAskStaff,
    kAskStaff,
    kAskStaff};
static_assert(kHelp.size() == kSteps.size());

void begin_card(Page& page) {
  Node veil = page.painted(centred(page.box(Flow::Column, 0, 40, 32)), page.palette.veil);
  if (page.low()) veil.box.justify = Justify::End;
  veil.id = "veil";
  veil.modal = true;
  page.tree.open(veil);
  Node card = page.box(Flow::Column, space::kM, 44, 40);
  frame(card, page.palette.card, page.palette.card_border, page.px(2), page.px(size::kCardRadius));
  card.id = "card";
  card.box.width = page.px(std::min(820.0F, page.width_dp - 80));
  card.box.shrink = true;
  card.box.shadow = true;
  page.tree.open(card);
}

// Two answers: side by side where there is room for their words.
void answers(Page& page, const char* quiet, Action quiet_action, const char* main, Action main_action) {
  const bool row = page.text_share < 1.4F && !(page.portrait && page.large_words());
  const auto in_box = page.tree.inside(page.box(row ? Flow::Row : Flow::Column, space::kS));
  page.button("answer_quiet", quiet, nullptr, ButtonLook::Quiet, quiet_action, row ? 1.0F : 0.0F);
  page.button("answer_main", main, nullptr, ButtonLook::Main, main_action, row ? 1.0F : 0.0F);
}

// For who listens: volume and speed, which all keypads reach.
void hearing(Page& page) {
  const auto percent = [&](int value) { return page.filled("{} %", std::to_string(value)); };
  const std::string_view volume = percent(kVolumePercents[page.visit.volume]);
  page.square_button("quieter", page.tr("Quieter"), icon::kQuieter, ActionKind::Quieter, volume);
  page.square_button("louder", page.tr("Louder"), icon::kSpeaker, ActionKind::Louder, volume);
  page.square_button("speed", page.tr("Speed of speech"), icon::kSpeed, ActionKind::Speed,
                     percent(kSpeedPercents[page.visit.speed]));
}

// Large letters may need more than the screen: then the words can be scrolled.
void help(Page& page) {
  page.heading("overlay_title", page.tr("Help"));
  page.tree.open(shrinking(scroller("overlay_words", page.box(Flow::Column, space::kM))));
  page.body("overlay_text", page.tr(kHelp[std::size_t(page.visit.step)]));
  if (page.visit.step == Step::Name)
    page.body("overlay_code",
              page.tr("You can also hold a QR code with your name or number up to the cameras."));
  if (page.visit.step == Step::Name && !page.visit.quotes_code())
    page.body("overlay_keypad",
              page.tr("On a keypad the digits type letters: press a key again for its next letter."));
  page.body(
      "overlay_staff",
      page.tr("If you would rather not use this screen, ask the staff: they can do every step for you."));
  page.tree.close();
  page.tree.open(page.box(Flow::Row, space::kS));
  page.within_reach();
  page.privacy();
  if (page.visit.spoken) hearing(page);
  page.tree.close();
  page.button("close", page.tr("Go on"), icon::kCheck, ButtonLook::Main, ActionKind::CloseOverlay);
}

void languages(Page& page) {
  page.heading("overlay_title", page.tr("Choose your language"));
  language_grid(page, 2);
}

void leave(Page& page) {
  page.heading("overlay_title", page.tr("Stop and leave"));
  page.body("overlay_text",
            page.tr("Everything you have entered and every picture are wiped at once. Nothing is kept."));
  answers(page, page.tr("Stop and leave"), ActionKind::LeaveNow, page.tr("Go on"), ActionKind::Stay);
}

// The code is seen nowhere else: it is in view to the last second.
void code_goes(Page& page, std::string_view seconds) {
  page.tree.open(shrinking(scroller("overlay_words", page.box(Flow::Column))));
  page.body("overlay_text",
            page.tr("To have it erased, quote this code to the staff. You can take a photo of it."));
  page.tree.close();
  page.tree.open(page.row_box(space::kM));
  Node code = page.text(page.filled("{}", page.view.receipt), type::kTitle, Weight::Bold, page.palette.ink);
  code.style.size_px = page.px(type::kTitle);
  code.secret = true;
  page.wide(code);
  page.put("seconds", Role::Status, page.tree.keep(seconds), type::kTitle, Weight::Bold, page.palette.warn);
  page.tree.close();
  answers(page, page.tr("Done"), ActionKind::Finish, page.tr("Go on"), ActionKind::Stay);
}

void told(Page& page, const char* asked, std::string_view words) {
  const auto in_block = page.tree.inside(page.box(Flow::Column, 2));
  page.write(asked, type::kSmall, Weight::Bold, page.palette.ink);
  page.write(words, type::kSmall, Weight::Regular, page.palette.ink_soft);
}

// How long a record is kept, as the staff have set it.
std::string_view kept_for(Page& page) {
  const int days = page.view.settings.of(Setting::KeepDays);
  if (days == 0) return page.tr("Until you have it erased.");
  return page.filled(page.tr("Until you have it erased, at most: {}"), page.days(days));
}

std::string_view host_of(Page& page) {
  if (page.view.consent == nullptr || page.view.consent->host.name.empty())
    return page.tr("Whoever runs this device: please ask the staff.");
  const Host& host = page.view.consent->host;
  return host.reached.empty() ? page.filled("{}", host.name)
                              : page.filled("{} · {}", {host.name, host.reached});
}

// The whole story on one page.
void privacy(Page& page) {
  const auto& tr = page.tr;
  page.heading("overlay_title", tr("Your data"), type::kHeading);
  page.tree.open(shrinking(scroller("overlay_words", page.box(Flow::Column, space::kS))));
  told(page, tr("Who keeps it"), host_of(page));
  told(page, tr("What for"),
       tr("A 3D portrait of you, if you want one. It is used to identify nobody here."));
  told(page, tr("What is kept"),
       tr("Only if you accept it are the portrait, your name and this consent stored, on this device."));
  told(page, tr("How long"), kept_for(page));
  told(page, tr("What leaves this device"),
       tr("It is connected to nothing. The staff can copy stored portraits to a stick."));
  const auto also = [&](std::string_view more) {
    page.write(more, type::kSmall, Weight::Regular, page.palette.ink_soft);
  };
  if (page.view.settings.is_on(Setting::TakeHome))
    also(tr("You can take a copy of yours on a stick of your own."));
  if (page.view.consent != nullptr && !page.view.consent->host.link.empty())
    also(page.filled(tr("The staff bring portraits to {}, where you can find yours."),
                     site_of(page.view.consent->host.link)));
  told(page, tr("How to withdraw"),
       tr("You get a code. Quote it to the staff at any time and everything about you is erased."));
  page.cameras();
  page.tree.close();
  page.button("close", tr("Go on"), icon::kCheck, ButtonLook::Main, ActionKind::CloseOverlay);
}

void lost_code(Page& page) {
  page.heading("overlay_title", page.tr("I lost my code"));
  page.body("overlay_text",
            page.tr("Please ask the staff: they can find your record by your name, and renew or erase it."));
  answers(page, page.tr("Stop and leave"), ActionKind::LeaveNow, page.tr("Go on"), ActionKind::CloseOverlay);
}

void still_there(Page& page) {
  const int left = page.visit.seconds_left(page.view.now);
  page.heading("overlay_title", page.tr("Are you still there?"));
  if (page.visit.step == Step::Thanks) return code_goes(page, std::to_string(left));
  page.put("overlay_text", Role::Status,
           page.plural_tr("Everything is wiped in {} second.", "Everything is wiped in {} seconds.", left),
           type::kBody, Weight::Regular, page.palette.ink_soft);
  answers(page, page.tr("Stop and leave"), ActionKind::LeaveNow, page.tr("Go on"), ActionKind::Stay);
}

// In the order of Overlay, behind None.
constexpr std::array kOverlays{help, languages, leave, still_there, lost_code, privacy};
static_assert(kOverlays.size() == std::size_t(Overlay::Privacy));

}  // namespace

// Rows of even length; each language keeps its place whichever is chosen.
void language_grid(Page& page, std::size_t columns) {
  const auto languages = page.visit.offered(page.view);
  std::array<Language, kLanguages> shown{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < kLanguages; ++i)
    if (languages[i]) shown[count++] = static_cast<Language>(i);
  const std::size_t rows = (count + columns - 1) / columns;
  const auto in_box = page.tree.inside(page.box(Flow::Column, space::kS));
  page.in_rows(count, (count + rows - 1) / rows, space::kS,
               [&](std::size_t i) { language_key(page, shown[i]); });
}

void overlay_screen(Page& page) {
  begin_card(page);
  kOverlays[std::size_t(page.visit.overlay) - 1](page);
  page.tree.close(2);
}

}  // namespace relievo::ui
