// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/screens/parts/overlay.h"

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
  tell(node, Role::Button, info.code, {}, {ActionKind::ChooseLanguage, static_cast<int>(language)});
  if (now) node.value = page.tr("chosen");
  frame(node, now ? page.palette.accent : page.palette.quiet,
        now ? page.palette.accent : page.palette.quiet_border, page.px(2), page.px(size::kRadius));
  node.box.grow = 1;
  node.box.min_height = page.px(size::kTarget);
  node.box.pad_x = page.px(6);
  page.tree.leaf(node);
}

}  // namespace

// Rows of even length; each language keeps its place whichever is chosen.
void language_grid(Page& page, std::size_t columns) {
  const auto languages = page.visit.offered(page.view);
  const std::size_t count = languages.count();
  const std::size_t rows = (count + columns - 1) / columns;
  const std::size_t abreast = (count + rows - 1) / rows;
  page.tree.open(page.box(Flow::Column, space::kS));
  std::size_t shown = 0;
  for (std::size_t i = 0; i < kLanguages; ++i) {
    if (!languages[i]) continue;
    if (shown % abreast == 0) page.tree.open(page.box(Flow::Row, space::kS));
    language_key(page, static_cast<Language>(i));
    if (++shown % abreast == 0) page.tree.close();
  }
  if (shown % abreast != 0) page.tree.close();
  page.tree.close();
}

}  // namespace relievo::ui
