// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The first four stages: of each the visitor's own photograph, until its picture is born.
#include <algorithm>

#include "ui/screens/visitor/visitor_screens.h"

namespace relievo::ui {
namespace {

constexpr float kMostGrowth = 1.5F;
constexpr float kWaits = 0.4F;  // so bright is the photograph where nothing has begun yet

// The first whose picture is not born.
int stage_under_way(const ViewState& view) {
  const auto made = view.stages.begin() + 1;
  return int(std::find_if(made, view.stages.end(), [](const Picture& one) { return one.pixels.empty(); }) -
             made);
}

// In a corner of the picture, so that the words below keep the whole width and stay where they are.
void tick(Page& page) {
  const float across_dp = 38 * page.text_share;
  const auto in_disc = page.tree.inside(page.painted(
      centred(page.sized(page.box(Flow::Column), across_dp, across_dp)), page.palette.card, across_dp / 2));
  page.sign(icon::kGood, 30, page.palette.good);
}

void card(Page& page, std::size_t stage, const char* words) {
  const int now = stage_under_way(page.view), at = int(stage);
  const Picture &made = page.view.stages[stage + 1], &photograph = page.view.stages[0];
  const bool born = !made.pixels.empty();
  const ImageView& shown = born ? made.pixels : photograph.pixels;
  constexpr std::string_view kIds[] = {"matches", "cloud", "mesh", "texture"};
  Node node = page.grown(page.box(Flow::Column, space::kS, 14, 14));
  tell(node, Role::Status, kIds[stage], words);
  node.value = at < now ? page.tr("done") : at == now ? page.tr("under way") : page.tr("waiting");
  frame(node, page.palette.card, at == now ? page.palette.accent : page.palette.card_border,
        page.px(at == now ? 3.0F : 1.5F), page.px(size::kCardRadius));
  const auto in_node = page.tree.inside(node);
  page.tree.open(page.stage(18));
  if (!shown.empty()) {
    Node picture = page.box(Flow::Column);
    tell(picture, Role::Picture, {}, words);
    depict(picture, static_cast<PictureSlot>(std::size_t(PictureSlot::Photograph) + (born ? stage + 1 : 0)),
           aspect_of(shown));
    picture.covers = true;
    picture.box.radius = page.px(18);
    if (at > now && !born) picture.colour = Colour{255, 255, 255, 255}.with_alpha(kWaits);
    page.tree.leaf(picture);
  }
  page.tree.open(aligned(justified(page.box(Flow::Column, 0, 8, 8), Justify::End), Align::End));
  if (at < now) tick(page);
  page.tree.close(2);
  Node row = centred(page.box(Flow::Row, 10));
  row.box.min_height = page.px(64 * page.text_share);
  const auto in_row = page.tree.inside(row);
  Node said = page.text(words, 22, Weight::Medium, at <= now ? page.palette.ink : page.palette.ink_soft,
                        TextAlign::Centre);
  said.style.size_px *= std::min(1.0F, kMostGrowth / page.text_share);  // four abreast have no room for more
  page.tree.leaf(said);
}

}  // namespace

void working_screen(Page& page) {
  const auto& tr = page.tr;
  page.begin(false);
  const bool storing = page.view.screen == Screen::Store;
  page.heading("title", storing ? tr("Your portrait is being stored") : tr("Your 3D portrait is being made"));
  page.body("what", storing ? tr("This takes a moment. Then you get your code.")
                            : tr("It takes a few seconds. You can move again."));
  const char* const words[] = {tr("Both pictures compared"), tr("Points in space"), tr("A closed surface"),
                               tr("The colours of your skin")};
  Node all = page.grown(page.abreast_box(space::kM));
  all.box.even = true;  // a tick moves nothing
  page.tree.open(all);
  for (std::size_t i = 0; i < 4; ++i) {
    if (page.portrait && i % 2 == 0) page.tree.open(page.grown(page.box(Flow::Row, space::kM)));
    card(page, i, words[i]);
    if (page.portrait && i % 2 == 1) page.tree.close();
  }
  page.tree.close();
  page.progress("progress", page.view.progress);
  page.end();
}

}  // namespace relievo::ui
