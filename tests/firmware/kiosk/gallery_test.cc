// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every screen in every language, size and text size: nothing is cut, nothing overlaps, everything can
// be touched, spoken and read. No GL.
#include "firmware/demo/gallery.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "firmware/records/event_log.h"
#include "tests/support/made_screen.h"
#include "tests/ui/languages.h"
#include "ui/screens/visitor/visitor_screens.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {
namespace {

constexpr float kTouchDp = 72, kStaffTouchDp = 56;

struct Shown {
  int width_px, height_px;
};
constexpr Shown kScreens[] = {{1280, 800}, {1920, 1080}, {1080, 1920}};

bool in_a_scroller(const ui::Tree& tree, const ui::Node& node) {
  for (std::int32_t at = node.parent; at >= 0; at = tree.nodes()[static_cast<std::size_t>(at)].parent) {
    if (tree.nodes()[static_cast<std::size_t>(at)].box.scroll) return true;
  }
  return false;
}

// What lies in a scroller is seen only within it.
ui::Rect seen_of(const ui::Node& node) {
  const float x = std::max(node.rect.x, node.clip.x), y = std::max(node.rect.y, node.clip.y);
  return {x, y, std::min(node.rect.right(), node.clip.right()) - x,
          std::min(node.rect.bottom(), node.clip.bottom()) - y};
}

bool goes_on(const ui::Node& node) { return node.box.scroll && node.content_height > node.rect.h + 1; }

// Where the content of a scroller ends, as far as it is scrolled.
float end_of(const ui::Tree& tree, const ui::Node& scroller) {
  float end = scroller.rect.y;
  for (const ui::Node& node : tree.nodes()) {
    if (node.parent >= 0 && &tree.nodes()[static_cast<std::size_t>(node.parent)] == &scroller)
      end = std::max(end, node.rect.bottom());
  }
  return end + scroller.box.pad_y;
}

bool overlap(const ui::Rect& a, const ui::Rect& b) {
  if (a.h <= 0 || b.h <= 0) return false;
  return a.x + 1 < b.right() && b.x + 1 < a.right() && a.y + 1 < b.bottom() && b.y + 1 < a.bottom();
}

class GalleryTest : public testing::TestWithParam<ui::Language> {
 protected:
  static void SetUpTestSuite() { screen_ = test::make_screen().release(); }
  static void TearDownTestSuite() { delete screen_; }

  // The cameras show something: it takes room on the pages where a code may be held up.
  static ui::ViewState seen() {
    static const std::array<std::byte, 3UL * 16 * 10> pixels{};
    ui::ViewState view;
    view.live.picture = {pixels.data(), 16, 10, 48, PixelFormat::Rgb8};
    return view;
  }
  // One pass over all screens: to lay them out costs more than to look at them.
  template <typename Look>
  void over_all(Look look) {
    for (const Shown shown : kScreens) {
      for (std::size_t text = 0; text < ui::kTextPercents.size(); ++text) {
        if (text == 1 && shown.width_px != 1280) continue;  // 125 %: where there is least room
        for (const Exhibit& exhibit : gallery(seen(), GetParam(), text, false)) {
          screen_->resize(shown.width_px, shown.height_px);
          screen_->show(exhibit.view, exhibit.visit, exhibit.service);
          SCOPED_TRACE(std::string(exhibit.name) + " " + std::to_string(shown.width_px) + "x" +
                       std::to_string(shown.height_px) + " " + std::to_string(ui::kTextPercents[text]) +
                       " %");
          look(screen_->tree(),
               ui::Rect{0, 0, static_cast<float>(shown.width_px), static_cast<float>(shown.height_px)});
        }
      }
    }
  }
  static void lies_on_the_screen(const ui::Tree& tree, const ui::Rect& screen);
  static void every_text_has_its_room(const ui::Tree& tree);
  static void buttons_are_large_apart_and_named(const ui::Tree& tree, const ui::Rect& screen);
  static void keypad_reaches_every_button(const ui::Tree& tree);
  static void nothing_lies_on_the_oval(const ui::Tree& tree);
  static void nothing_sticks_out_of_its_card(const ui::Tree& tree);
  static ui::Ui* screen_;
};
ui::Ui* GalleryTest::screen_ = nullptr;

void GalleryTest::lies_on_the_screen(const ui::Tree& tree, const ui::Rect& screen) {
  for (const ui::Node& node : tree.nodes()) {
    if (in_a_scroller(tree, node)) continue;
    EXPECT_GE(node.rect.x, -1) << node.id << " " << node.text;
    EXPECT_GE(node.rect.y, -1) << node.id << " " << node.text;
    EXPECT_LE(node.rect.right(), screen.w + 1) << node.id << " " << node.text;
    EXPECT_LE(node.rect.bottom(), screen.h + 1) << node.id << " " << node.text;
  }
}

void GalleryTest::every_text_has_its_room(const ui::Tree& tree) {
  for (const ui::Node& node : tree.nodes()) {
    if (node.text.empty()) continue;
    const ui::TextLabel& label =
        screen_->text().label(node.text, node.style, std::max(1.0F, node.rect.w - 2 * node.box.pad_x));
    EXPECT_EQ(label.missing, 0) << node.text;
    EXPECT_EQ(label.torn, 0) << node.text;
    EXPECT_LE(label.size.height_px, node.rect.h + 2) << node.text;
    EXPECT_LE(label.size.width_px, node.rect.w + 2) << node.text;
  }
}

void GalleryTest::buttons_are_large_apart_and_named(const ui::Tree& tree, const ui::Rect& screen) {
  const float unit = ui::unit_of(screen);
  const float least = tree.find("sign out") != nullptr ? kStaffTouchDp : kTouchDp;
  std::set<std::string> ids;
  std::vector<const ui::Node*> buttons;
  for (const ui::Node& node : tree.nodes()) {
    if (node.action.kind == ui::ActionKind::None || node.action.kind == ui::ActionKind::TurnFace) continue;
    EXPECT_GE(node.rect.h, least * unit - 1) << node.id;
    EXPECT_GE(node.rect.w, (node.role == ui::Role::Key ? 44 : least) * unit - 1) << node.id;
    EXPECT_FALSE(node.name.empty() && node.text.empty()) << node.id << " says nothing";
    buttons.push_back(&node);
  }
  const bool modal = tree.find("veil") != nullptr;
  if (modal) return;
  for (std::size_t i = 0; i < buttons.size(); ++i) {
    EXPECT_TRUE(ids.insert(std::string(buttons[i]->id)).second) << buttons[i]->id << " twice";
    for (std::size_t k = i + 1; k < buttons.size(); ++k)
      EXPECT_FALSE(overlap(seen_of(*buttons[i]), seen_of(*buttons[k])))
          << buttons[i]->id << " " << buttons[k]->id;
  }
}

void GalleryTest::keypad_reaches_every_button(const ui::Tree& tree) {
  std::set<std::string> reached;
  const ui::Node* at = tree.after(nullptr, 1);
  while (at != nullptr && reached.insert(std::string(at->id)).second) at = tree.after(at, 1);
  const bool modal = tree.find("veil") != nullptr;
  for (const ui::Node& node : tree.nodes()) {
    const bool wanted =
        node.action.kind != ui::ActionKind::None && node.action.kind != ui::ActionKind::TurnFace && !modal;
    EXPECT_TRUE(!wanted || reached.count(std::string(node.id)) == 1) << node.id;
  }
  EXPECT_FALSE(modal && reached.empty());
}

// A person's face is seen in it; buttons and advice stay outside.
void GalleryTest::nothing_lies_on_the_oval(const ui::Tree& tree) {
  const ui::Node* oval = tree.find("oval");
  if (oval == nullptr || tree.find("veil") != nullptr) return;
  const float x = oval->rect.x + oval->rect.w / 2, y = oval->rect.y + oval->rect.h / 2;
  for (const char* id :
       {"advice", "again", "back", "bigger", "language", "help", "leave", "shoot", "enough", "sides"}) {
    const ui::Node* node = tree.find(id);
    if (node == nullptr) continue;
    // Its nearest point, where the oval is a circle.
    const float dx = (std::clamp(x, node->rect.x, node->rect.right()) - x) / (oval->rect.w / 2),
                dy = (std::clamp(y, node->rect.y, node->rect.bottom()) - y) / (oval->rect.h / 2);
    EXPECT_GT(dx * dx + dy * dy, 1) << id;
  }
}

// What lies over a page: no answer stands below it, or on what else it says.
void GalleryTest::nothing_sticks_out_of_its_card(const ui::Tree& tree) {
  const ui::Node* card = tree.find("veil") != nullptr ? tree.find("card") : nullptr;
  if (card == nullptr) return;
  const auto place = static_cast<std::int32_t>(card - tree.nodes().data());
  for (const ui::Node& node : tree.nodes()) {
    std::int32_t above = node.parent;
    while (above >= 0 && above != place) above = tree.nodes()[static_cast<std::size_t>(above)].parent;
    if (above < 0 || in_a_scroller(tree, node)) continue;
    EXPECT_LE(node.rect.bottom(), card->rect.bottom() + 1) << node.id << " " << node.text;
  }
}

TEST_P(GalleryTest, NothingIsCutOrOverlapsAndAllIsReachedSpokenAndRead) {
  over_all([](const ui::Tree& tree, const ui::Rect& screen) {
    lies_on_the_screen(tree, screen);
    every_text_has_its_room(tree);
    buttons_are_large_apart_and_named(tree, screen);
    keypad_reaches_every_button(tree);
    nothing_lies_on_the_oval(tree);
    nothing_sticks_out_of_its_card(tree);
  });
}

// The code, what is said of a stick, and that the cameras are off: in letters of the usual size at one look.
TEST_P(GalleryTest, TheLastPageIsSeenAtOneLook) {
  screen_->resize(1280, 800);
  std::size_t looked_at = 0;
  for (const Exhibit& exhibit : gallery({}, GetParam(), 0, false)) {
    if (exhibit.visit.step != ui::Step::Thanks) continue;
    SCOPED_TRACE(exhibit.name);
    screen_->show(exhibit.view, exhibit.visit, exhibit.service);
    const ui::Tree& tree = screen_->tree();
    EXPECT_FALSE(goes_on(*tree.find("message")));
    EXPECT_FALSE(in_a_scroller(tree, *tree.find("cameras"))) << "seen in larger letters, too";
    ++looked_at;
  }
  EXPECT_GT(looked_at, 10U);
}

// Presses the keypad's "on" until everything was there; what was in view, scroller by scroller, is struck off
// `unread`.
void read_by_keypad(ui::Ui& screen, const Exhibit& exhibit, std::set<std::string>& unread) {
  std::set<std::pair<std::string, float>> seen;  // what had the focus, and how far its scroller was
  std::string before;
  for (;;) {
    screen.feed({ui::Input::Kind::Next}, exhibit.view);
    screen.show(exhibit.view, exhibit.visit, exhibit.service);
    const ui::Tree& tree = screen.tree();
    const ui::Node* at = tree.find(screen.focus());
    ASSERT_NE(at, nullptr);
    const ui::Node* scroller = goes_on(*at) ? at : tree.scroller_around(*at);
    const float end = scroller != nullptr ? end_of(tree, *scroller) : 0;
    if (scroller != nullptr && scroller != at && at->id != before) {
      EXPECT_GE(at->rect.y, scroller->rect.y - 1) << at->id;
      EXPECT_LE(at->rect.bottom(), scroller->rect.bottom() + 1) << at->id;
    }
    if (scroller != nullptr && end <= scroller->rect.bottom() + 1) unread.erase(std::string(scroller->id));
    if (!seen.emplace(at->id, end).second) return;
    before = at->id;
  }
}

// Without a finger, in large letters: the focus is seen wherever it goes, and what goes on is read to its
// end. In the longest words, from right to left, and without spaces: it takes longest of all.
using GalleryKeypadTest = GalleryTest;
TEST_P(GalleryKeypadTest, AKeypadSeesItsFocusAndReadsEveryScrollerToItsEnd) {
  for (const Exhibit& exhibit : gallery({}, GetParam(), ui::kTextPercents.size() - 1, false)) {
    SCOPED_TRACE(exhibit.name);
    const auto made = test::make_screen();
    ui::Ui& screen = *made;
    screen.show(exhibit.view, exhibit.visit, exhibit.service);
    const bool modal = screen.tree().find("veil") != nullptr;
    std::set<std::string> unread;
    for (const ui::Node& node : screen.tree().nodes()) {
      if (goes_on(node) && (!modal || node.id == "overlay_words")) unread.insert(std::string(node.id));
    }
    if (!unread.empty()) read_by_keypad(screen, exhibit, unread);
    EXPECT_TRUE(unread.empty()) << *unread.begin();
  }
}

// As many lines as a log keeps, each as long as one may be, faults all of them.
TEST_P(GalleryTest, AFullLogHasRoom) {
  const std::string sentence(EventLog::kTextBytes, 'x');
  const ui::LogLine line{"2026-03-14 10:21:09", true, sentence, Errc::IoFailed, {}, {}};
  const std::vector<ui::LogLine> lines(EventLog::kLines, line);
  const ui::LogView log{lines, {}};
  ui::ServiceView staff;
  staff.role = ui::StaffRole::Technician;
  staff.log = &log;
  ui::ViewState view;
  view.screen = ui::Screen::Staff;
  view.service = &staff;
  ui::Visit visit;
  visit.language = GetParam();
  ui::Service service;
  service.show(ui::StaffPage::Log, 0);
  screen_->resize(1280, 800);
  screen_->show(view, visit, service);
  std::size_t dates = 0;
  for (const ui::Node& node : screen_->tree().nodes())
    dates += node.text.find("10:21:09") != std::string_view::npos ? 1 : 0;
  EXPECT_EQ(dates, EventLog::kLines);
}

bool three_latin_words(std::string_view text) {
  int words = 0;
  std::size_t letters = 0;
  for (const char c : text) {
    if (c >= 'a' && c <= 'z') {
      if (++letters == 2 && ++words == 3) return true;
      continue;
    }
    if (c != ' ' && c != ',' && c != ':' && c != ';') words = 0;
    if (c == ' ' && letters == 1) words = 0;
    letters = 0;
  }
  return false;
}

// In scripts that are not Latin, three Latin words on end are a sentence nobody translated. Names, keys,
// units and files are fewer; what the engine says in English is set as English; what a person wrote stays.
TEST_P(GalleryTest, NoSentenceStaysEnglishButTheEnginesDetails) {
  using enum ui::Language;
  if (GetParam() != Arabic && GetParam() != Hebrew && GetParam() != Chinese && GetParam() != Japanese) return;
  constexpr const char* kKept[] = {"What we do with your portrait", "Was mit Ihrem Bildnis",
                                   "Museum of Faces", "Maximiliane von und zu"};
  screen_->resize(1280, 800);
  std::size_t looked_at = 0, details = 0;
  for (const Exhibit& exhibit : gallery({}, GetParam(), 0, false)) {
    screen_->show(exhibit.view, exhibit.visit, exhibit.service);
    for (const ui::Node& node : screen_->tree().nodes()) {
      const bool detail = !node.text.empty() && node.style.language == std::string_view("en");
      details += detail ? 1 : 0;
      const bool language = node.text == ui::info_of(ui::Language::English).own_name;
      EXPECT_FALSE(detail && !language && exhibit.view.service == nullptr)
          << "visitors see none: " << node.text;
      if (detail) continue;
      for (const std::string_view said : {node.text, node.name, node.value}) {
        const bool kept = std::any_of(std::begin(kKept), std::end(kKept), [&](const char* one) {
          return said.find(one) != std::string_view::npos;
        });
        EXPECT_FALSE(!kept && three_latin_words(said)) << exhibit.name << ": " << said;
        ++looked_at;
      }
    }
  }
  EXPECT_GT(looked_at, 1000U);
  EXPECT_GT(details, 10U);
}

TEST_P(GalleryTest, RightToLeftMirrorsThePage) {
  const auto exhibits = gallery({}, GetParam(), 0, false);
  screen_->resize(1280, 800);
  for (const Exhibit& exhibit : exhibits) {
    if (exhibit.name != "consent") continue;
    screen_->show(exhibit.view, exhibit.visit, exhibit.service);
    const bool back_is_right = screen_->tree().find("back")->rect.x > 640;
    EXPECT_EQ(back_is_right, ui::info_of(GetParam()).right_to_left);
  }
}

// On an upright screen, whose upper third hangs high; and for whoever has the other hand.
TEST_P(GalleryTest, ControlsComeDownAndToTheOtherSide) {
  constexpr float kWidth = 1080, kHeight = 1920;
  for (Exhibit& exhibit : gallery({}, GetParam(), 0, false)) {
    if (exhibit.service.open) continue;
    SCOPED_TRACE(exhibit.name);
    screen_->resize(static_cast<int>(kWidth), static_cast<int>(kHeight));
    exhibit.visit.reach = ui::Reach::Low;
    screen_->show(exhibit.view, exhibit.visit, exhibit.service);
    const ui::Tree& tree = screen_->tree();
    lies_on_the_screen(tree, {0, 0, kWidth, kHeight});
    for (const ui::Node& node : tree.nodes()) {
      if (node.action.kind == ui::ActionKind::None || node.action.kind == ui::ActionKind::TurnFace) continue;
      EXPECT_TRUE(node.id == "staff" || !tree.is_on_top(node) || node.rect.y >= kHeight / 3) << node.id;
    }
    if (exhibit.visit.step == ui::Step::Attract && exhibit.visit.overlay == ui::Overlay::None) {
      const float here = tree.find("help")->rect.x;
      exhibit.visit.reach = ui::Reach::LowOther;
      screen_->show(exhibit.view, exhibit.visit, exhibit.service);
      EXPECT_GT(std::abs(tree.find("help")->rect.x - here), kWidth / 4) << "whoever touches it sees it";
      exhibit.visit.reach = ui::Reach::Low;
    }
    screen_->resize(1280, 800);
    screen_->show(exhibit.view, exhibit.visit, exhibit.service);
    const ui::Node* before = tree.find(exhibit.visit.step == ui::Step::Review ? "accept" : "leave");
    if (before == nullptr || !tree.is_on_top(*before)) continue;
    const float middle = before->rect.x + before->rect.w / 2;
    const std::string id(before->id);
    exhibit.visit.reach = ui::Reach::LowOther;
    screen_->show(exhibit.view, exhibit.visit, exhibit.service);
    lies_on_the_screen(tree, {0, 0, 1280, 800});
    const ui::Rect& after = tree.find(id)->rect;
    EXPECT_NE(middle < 640, after.x + after.w / 2 < 640) << id;
  }
}

INSTANTIATE_TEST_SUITE_P(Languages, GalleryTest, ui::kEveryLanguage, ui::language_code);
INSTANTIATE_TEST_SUITE_P(Languages, GalleryKeypadTest,
                         testing::Values(ui::Language::German, ui::Language::Arabic, ui::Language::Japanese),
                         ui::language_code);

}  // namespace
}  // namespace relievo::firmware
