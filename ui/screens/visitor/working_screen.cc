// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The first four stages, each with its picture as it is born.
#include <algorithm>
#include <string>

#include "ui/screens/visitor/visitor_screens.h"

namespace relievo::ui {
namespace {

int stage_under_way(Screen screen) {
  switch (screen) {
    case Screen::Match:
      return 0;
    case Screen::Reconstruct:
      return 1;
    case Screen::Mesh:
      return 2;
    case Screen::Texture:
      return 3;
    case Screen::Fuse:
    case Screen::Review:
    case Screen::Store:
      return 4;
    case Screen::SelfTest:
    case Screen::Idle:
    case Screen::Calibrate:
    case Screen::Position:
    case Screen::Capture:
    case Screen::Turn:
    case Screen::Export:
    case Screen::Staff:
    case Screen::Fault:
      break;
  }
  return -1;
}

// In a corner of the picture, so that the words below keep the whole width and stay where they are.
void tick(Page& page) {
  const float across_dp = 38 * page.text_share;
  Node disc = page.sized(page.box(Flow::Column), across_dp, across_dp);
  disc.box.justify = Justify::Centre;
  disc.box.align = Align::Centre;
  disc.box.radius = page.px(across_dp / 2);
  disc.box.fill = page.palette.card;
  page.tree.open(disc);
  page.sign(icon::kGood, 30, page.palette.good);
  page.tree.close();
}

void card(Page& page, int stage, const char* words) {
  const int now = stage_under_way(page.view.screen);
  const StageView& born = page.view.stages[static_cast<std::size_t>(stage)];
  constexpr std::string_view kIds[] = {"matches", "cloud", "mesh", "texture"};
  Node node = page.grown(page.box(Flow::Column, space::kS, 14, 14));
  node.id = kIds[stage];
  node.role = Role::Status;
  node.name = words;
  node.value = stage < now ? page.tr("done") : stage == now ? page.tr("under way") : page.tr("waiting");
  node.box.fill = page.palette.card;
  node.box.border = stage == now ? page.palette.accent : page.palette.card_border;
  node.box.border_px = page.px(stage == now ? 3.0F : 1.5F);
  node.box.radius = page.px(size::kCardRadius);
  page.tree.open(node);
  Node picture = page.grown(page.box(Flow::Column));
  picture.box.radius = page.px(18);
  picture.box.fill = page.palette.stage;
  picture.box.justify = Justify::Centre;
  picture.box.align = Align::Centre;
  if (!born.picture.empty()) {
    picture.role = Role::Picture;
    picture.name = words;
    picture.mark = Mark::Image;
    picture.picture = static_cast<PictureSlot>(static_cast<int>(PictureSlot::Matches) + stage);
    picture.aspect = static_cast<float>(born.picture.width_px) / static_cast<float>(born.picture.height_px);
    picture.covers = true;
  }
  if (stage < now)
    picture.box.justify = Justify::End, picture.box.align = Align::End,
    picture.box.pad_x = picture.box.pad_y = page.px(8);
  page.tree.open(picture);
  if (stage < now) tick(page);
  else if (born.picture.empty()) page.sign(icon::kWait, 40, {150, 164, 190, 255});
  page.tree.close();
  Node row = page.box(Flow::Row, 10);
  row.box.align = Align::Centre;
  row.box.justify = Justify::Centre;
  row.box.min_height = page.px(64 * page.text_share);
  page.tree.open(row);
  page.tree.leaf(page.text(words, 22, Weight::Medium, stage <= now ? page.palette.ink : page.palette.ink_soft,
                           TextAlign::Centre));
  page.tree.close();
  page.tree.close();
}

void progress(Page& page) {
  const int now = stage_under_way(page.view.screen);
  const float done = now < 0                            ? 0
                     : page.view.screen == Screen::Fuse ? page.view.progress
                     : now >= 4                         ? 1
                                                        : (static_cast<float>(now) + page.view.progress) / 4;
  Node track = page.box(Flow::Row);
  track.id = "progress";
  track.role = Role::Status;
  track.name = page.tr("How far it is");
  constexpr int kStep = 25;  // who listens is told of a quarter, not of every step
  track.value =
      page.filled("{} %", std::to_string(static_cast<int>(std::min(1.0F, done) * 100) / kStep * kStep));
  track.box.height = page.px(14);
  track.box.radius = page.px(7);
  track.box.fill = page.palette.track;
  page.tree.open(track);
  if (done > 0) {
    Node bar = page.grown(page.box(Flow::Column), std::max(0.02F, done));
    bar.box.radius = page.px(7);
    bar.box.fill = page.palette.accent;
    page.tree.leaf(bar);
  }
  if (done < 1) page.space(1 - done);
  page.tree.close();
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
  Node all = page.grown(page.box(page.portrait ? Flow::Column : Flow::Row, space::kM));
  all.box.even = true;  // a tick moves nothing
  page.tree.open(all);
  for (int i = 0; i < 4; ++i) {
    if (page.portrait && i % 2 == 0) page.tree.open(page.grown(page.box(Flow::Row, space::kM)));
    card(page, i, words[i]);
    if (page.portrait && i % 2 == 1) page.tree.close();
  }
  page.tree.close();
  progress(page);
  page.end();
}

}  // namespace relievo::ui
