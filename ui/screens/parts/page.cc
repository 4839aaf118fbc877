// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/screens/parts/page.h"

#include <cmath>
#include <string>

namespace relievo::ui {
namespace {

constexpr Colour kNone{};
constexpr std::chrono::seconds kCamerasRest{2};
constexpr float kMostSignShare = 1.35F;  // signs on buttons that stay as large as they are grow no further

constexpr std::string_view kUnits[] = {"mm", "px", "sr", "%"};

bool begins_with_unit(std::string_view text) {
  return std::ranges::any_of(kUnits, [text](std::string_view unit) {
    return text.starts_with(unit) &&
           (text.size() == unit.size() ||
            std::string_view(" ,;:.)").find(text[unit.size()]) != std::string_view::npos);
  });
}

}  // namespace

float unit_of(const Rect& screen) {
  return screen.w >= screen.h ? std::min(screen.w / 1280, screen.h / 800)
                              : std::min(screen.w / 800, screen.h / 1280);
}

Page::Page(Tree& tree_in, const ViewState& view_in, const Visit& visit_in, const Palette& palette_in,
           const Rect& screen)
    : tree(tree_in),
      view(view_in),
      visit(visit_in),
      palette(palette_in),
      tr(visit_in.language),
      unit(unit_of(screen)),
      text_share(float(visit_in.text_percent()) / 100),
      width_dp(screen.w / unit),
      height_dp(screen.h / unit),
      portrait(screen.h > screen.w) {}

Node Page::box(Flow flow, float gap, float pad_x, float pad_y) const {
  Node node;
  node.box.flow = flow;
  node.box.gap = px(gap);
  node.box.pad_x = px(pad_x);
  node.box.pad_y = px(pad_y);
  return node;
}

Node Page::row_box(float gap, float pad_x, float pad_y) const {
  Node row = aligned(box(Flow::Row, gap, pad_x, pad_y), Align::Centre);
  return row;
}

Node Page::stage(float radius_dp, float grow) const {
  return painted(grown(box(Flow::Stack), grow), palette.stage, radius_dp);
}

Node Page::model(std::string_view id, const char* words, float radius_dp) const {
  Node face = box(Flow::Column);
  tell(face, Role::Picture, id, words, ActionKind::TurnFace);
  face.mark = Mark::Face;
  face.box.radius = px(radius_dp);
  return face;
}

Node Page::text(std::string_view words, float size, Weight weight, Colour colour, TextAlign align) const {
  Node node;
  node.role = Role::Text;
  node.text = words;
  node.colour = colour;
  // Arabic letters are smaller in their size than Latin ones.
  const float script = visit.language == Language::Arabic ? 1.1F : 1.0F;
  node.style.size_px = px(size * text_share * script);
  node.style.weight = weight;
  node.style.align = align;
  node.style.language = info_of(visit.language).code;
  return node;
}

void Page::heading(std::string_view id, std::string_view words, float size, TextAlign align) {
  // The largest letters grow less: they are read from afar already.
  Node node = text(words, size, Weight::Bold, palette.ink, align);
  if (size >= type::kTitle) node.style.size_px = px(size * (1 + (text_share - 1) * 0.5F));
  put(id, Role::Heading, node);
}

void Page::body(std::string_view id, std::string_view words, TextAlign align) {
  put(id, Role::Text, words, type::kBody, Weight::Regular, palette.ink_soft, align);
}

void Page::sign(const char* letter, float size, Colour colour) {
  Node node = text(letter, size, Weight::Regular, colour, TextAlign::Centre);
  node.role = Role::Icon;
  node.style.icon = true;
  tree.leaf(node);
}

void Page::button(std::string_view id, std::string_view label, const char* letter, ButtonLook look,
                  Action action, float grow, const ButtonSize& lengths, std::string_view value) {
  const float thin = std::max(1.5F, px(2));
  const struct {
    Colour fill, border, ink;
    float border_px;
  } looks[] = {
      {palette.accent, kNone, palette.accent_ink, 0},
      {palette.quiet, palette.quiet_border, palette.link, thin},
      {kNone, palette.quiet_border, palette.link, thin},
      {palette.quiet, palette.bad, palette.bad, std::max(2.0F, px(3))}};  // in the order of ButtonLook
  static_assert(std::size(looks) == std::size_t(ButtonLook::Grave) + 1);
  const auto& [fill, border, ink, border_px] = looks[std::size_t(look)];
  Node node = centred(box(Flow::Row, lengths.gap,
                          text_share > 1.3F ? std::min(14.0F, lengths.pad_x) : lengths.pad_x, lengths.pad_y));
  tell(node, Role::Button, id, label, action);
  node.value = value;
  frame(node, fill, border, border_px, px(lengths.radius));
  node.box.grow = grow;
  node.box.min_height = px(lengths.height);
  node.box.min_width = px(lengths.width);
  node.box.shadow = look == ButtonLook::Main && lengths.shadow;
  node.hold = node.slow_key = look == ButtonLook::Grave;
  node.filling = palette.bad;
  const auto in_node = tree.inside(node);
  if (letter != nullptr) sign(letter, lengths.sign, ink);
  if (!label.empty()) write(label, lengths.text, Weight::Medium, ink, TextAlign::Centre);
}

void Page::progress(std::string_view id, float share) {
  // A bar that grew with every pixel would have the whole page drawn each time, beside the work it waits for.
  constexpr float kParts = 100;
  const float done = std::floor(std::clamp(share, 0.0F, 1.0F) * kParts) / kParts;
  Node track = painted(box(Flow::Row), palette.track, 7);
  tell(track, Role::Status, id, tr("How far it is"));
  constexpr int kStep = 25;  // who listens is told of a quarter, not of every step
  track.value = filled("{} %", std::to_string(int(done * 100) / kStep * kStep));
  track.box.height = px(14);
  const auto in_track = tree.inside(track);
  if (share > 0) tree.leaf(painted(grown(box(Flow::Column), std::max(0.02F, done)), palette.accent, 7));
  if (done < 1) space(1 - done);
}

void Page::reading_tools() {
  bigger_text();
  more_contrast();
  square_button("language", tr("Language"), icon::kTranslate, ActionKind::ShowLanguages);
}

void Page::turning_tools() {
  square_button("turn_left", tr("Turn left"), icon::kTurnLeft, ActionKind::TurnLeft);
  square_button("turn_right", tr("Turn right"), icon::kTurnRight, ActionKind::TurnRight);
  square_button("zoom_out", tr("Smaller"), icon::kZoomOut, ActionKind::ZoomOut);
  square_button("zoom_in", tr("Larger"), icon::kZoomIn, ActionKind::ZoomIn);
  square_button("light", tr("Move the light"), icon::kSun, ActionKind::MoveLight);
}

void Page::bigger_text() {
  square_button("bigger", tr("Bigger text"), icon::kText, {ActionKind::BiggerText, int(text_sizes)},
                filled("{} %", std::to_string(kTextPercents[std::min(visit.text_size, text_sizes - 1)])));
}

void Page::more_contrast() {
  square_button("contrast", tr("More contrast"), icon::kContrast, ActionKind::Contrast,
                visit.high_contrast ? tr("yes") : tr("no"));
}

void Page::within_reach() {
  square_button("reach", tr("Controls lower or on the other side"), icon::kReach, ActionKind::Reach,
                share_of(std::size_t(visit.reach) + 1, 3));
}

void Page::cameras() {
  const bool on = view.cameras_on;
  const char* words = on ? tr("The cameras are on") : tr("The cameras are off");
  Node row = row_box(10);
  tell(row, Role::Status, "cameras", words);
  // They rest soon after somebody comes here who was before them: who listens is not told first that they are
  // on, unless they stay so.
  row.unspoken = on && view.now < visit.takes_touches_from + kCamerasRest;
  const auto in_row = tree.inside(row);
  sign(on ? icon::kCamera : icon::kCameraOff, 24, on ? palette.warn : palette.good);
  write(words, type::kSmall, Weight::Medium, on ? palette.warn : palette.good);
}

void Page::square_button(std::string_view id, std::string_view spoken, const char* letter, Action action,
                         std::string_view value) {
  Node node = centred(sized(box(Flow::Row), size::kTarget, size::kTarget));
  tell(node, Role::Button, id, spoken, action);
  node.value = value;
  frame(node, palette.quiet, palette.quiet_border, std::max(1.5F, px(2)), px(size::kRadius));
  const auto in_node = tree.inside(node);
  sign(letter, 34 * std::min(1.0F, kMostSignShare / text_share), palette.link);
}

std::string_view Page::filled(const char* words, std::span<const std::string_view> values) {
  std::string_view rest(words);
  const std::size_t from = tree.kept();
  for (const std::string_view value : values) {
    const std::size_t at = rest.find("{}");
    if (at == std::string_view::npos) break;
    // First strong isolate … pop: a name or number keeps its own direction.
    joined({rest.substr(0, at), isolate::kFirst, value, isolate::kEnd});
    rest.remove_prefix(at + 2);
    // A line never ends between a value and its unit.
    if (rest.starts_with(' ') && begins_with_unit(rest.substr(1))) tree.keep("\u00a0"), rest.remove_prefix(1);
  }
  tree.keep(rest);
  return tree.kept_since(from);
}

std::string_view Page::plural_tr(const char* one, const char* many, int count) {
  return filled(tr.plural(one, many, static_cast<unsigned long>(count)), std::to_string(count));
}

std::string_view Page::joined(std::initializer_list<std::string_view> parts) const {
  const std::size_t from = tree.kept();
  for (const std::string_view part : parts) tree.keep(part);
  return tree.kept_since(from);
}

std::string_view Page::left_to_right(std::initializer_list<std::string_view> parts) const {
  const std::size_t from = tree.kept();
  tree.keep(isolate::kLeft), joined(parts), tree.keep(isolate::kEnd);
  return tree.kept_since(from);
}

std::string_view Page::breakable(std::string_view names, std::string_view behind) const {
  const std::size_t from = tree.kept();
  for (const char& c : names) {
    const bool divided = behind.find(c) != std::string_view::npos;
    joined({{&c, 1}, divided ? "\u200b" : ""});
  }
  return tree.kept_since(from);
}

std::string_view Page::spelled(std::string_view code) {
  const std::size_t from = tree.kept();
  for (const char& c : code) joined({c == '-' ? "," : std::string_view(&c, 1), " "});
  return tree.kept_since(from);
}

std::string_view Page::share_of(std::size_t done, std::size_t all) {
  return filled(tr("{} of {}"), {std::to_string(done), std::to_string(all)});
}

void Page::open_page(Node root) {
  root.id = "page";
  root.box.fill = palette.ground;
  root.box.fill_end = palette.ground_end;
  tree.open(root);
}

void Page::begin(bool with_back) {
  open_page(box(Flow::Column, space::kM, kPageMargin, kPageTop));
  with_back_ = with_back;
  if (!low()) bar(with_back);
}

void Page::end() {
  if (low()) bar(with_back_);
  tree.close();
}

void Page::bar(bool with_back) {
  tree.open(sided(box(Flow::Row, space::kS)));
  tree.open(grown(row_box(space::kS)));
  constexpr float kNoRoomForWords = 1.6F;
  if (with_back && portrait && text_share > kNoRoomForWords)
    square_button("back", tr("Back"), backward(), ActionKind::Back);
  else if (with_back) button("back", tr("Back"), backward(), ButtonLook::Quiet, ActionKind::Back);
  if (!portrait || !with_back) steps();
  tree.close();
  reading_tools();
  square_button("help", tr("Help"), icon::kHelp, ActionKind::ShowHelp);
  // What is being stored is stored: who accepted gets their code.
  if (view.screen != Screen::Store)
    square_button("leave", tr("Stop and leave"), icon::kClose, ActionKind::Leave);
  tree.close();
}

// Where one is: four short bars, the done ones filled.
void Page::steps() {
  const int now = info_of(visit.step).number;
  if (now < 0) return;
  Node row = row_box(space::kXs, tree.find("back") != nullptr ? space::kM : 0.0F);
  tell(row, Role::Status, "steps", tr("How far it is"));
  row.value = share_of(std::size_t(now) + 1, 4);
  const auto in_row = tree.inside(row);
  for (int i = 0; i < 4; ++i)
    tree.leaf(painted(sized(box(Flow::Column), i == now ? 44.0F : 20.0F, 10),
                      i <= now ? palette.accent : palette.track, 5));
}

}  // namespace relievo::ui
