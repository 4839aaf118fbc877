// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The operator's consent text, from a stick to the visitor's page: at the first start and later. What is
// wrong with it is said, and then nothing has changed.
#include "hal/picture_file.h"
#include "tests/firmware/kiosk/staff_hands.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {
namespace {

using ui::Outcome;

// Gone as soon as it has been looked at.
class PulledAtOnce final : public hal::RemovableMedia {
 public:
  explicit PulledAtOnce(Path root) : root_(std::move(root)) {}
  std::optional<std::filesystem::path> current() override {
    if (!std::filesystem::exists(root_)) return std::nullopt;
    const Path there = root_.string() + " in a hand";
    std::filesystem::rename(root_, there);
    return root_;
  }
  Result<void> flush_and_eject() override { return {}; }

 private:
  Path root_;
};

class StaffConsentTest : public StaffHands {
 protected:
  static constexpr const char* kGood = "Was hier geschieht\r\n\r\nEin Punkt\r\nund seine Worte.\r\n";
  void write(const std::string& version, const std::string& file, const std::string& words) {
    std::filesystem::create_directories(stick() / "consent" / version);
    std::ofstream(stick() / "consent" / version / file, std::ios::binary) << words;
  }
  const ui::ConsentTextsView& texts() const { return *kiosk->view().service->consent; }
  Outcome take() {
    tap("take consent");
    EXPECT_TRUE(until([this] { return !texts().taking; }));
    kiosk->turn();
    return texts().outcome;
  }
  // The detail where the page shows one, else how the try ended.
  std::string said() const {
    if (const ui::Fault* fault = texts().fault; fault != nullptr && says(fault->detail)) return fault->detail;
    const ui::Node* node = find("outcome");
    std::string words(node == nullptr ? std::string_view() : node->name);
    for (const char* mark : {"\u2066", "\u2068", "\u2069"})
      for (std::size_t at = words.find(mark); at != std::string::npos; at = words.find(mark))
        words.erase(at, 3);
    return words;
  }
  // First start, up to the consent text.
  void come_to_it() {
    start();
    knock();
    tap("go on");
    tap("clock right");
    ASSERT_NE(find("take consent"), nullptr);
  }
  void choose_pins_alone() {
    for (const char* pin : {"4711", "4711", "80526", "80526"}) type_pin(pin);
    ASSERT_TRUE(until([this] { return kiosk->ui().service().page == StaffPage::Pin; }));
  }
  void sample_is_in_force() {
    EXPECT_EQ(kiosk->view().consent, nullptr);
    EXPECT_TRUE(says("not reviewed by a lawyer"));
    EXPECT_FALSE(std::filesystem::exists(args.store / "consent" / "2026-03"));
  }
};

TEST_F(StaffConsentTest, TheFirstStartGoesOnWithTheSampleMarkedAsOne) {
  come_to_it();
  sample_is_in_force();
  tap("consent right");
  choose_pins_alone();
  tap("sign out");
  tap("start");
  EXPECT_TRUE(says("Sample text, not reviewed by a lawyer"));
}

TEST_F(StaffConsentTest, TheFirstStartTakesTheOperatorsTextAndItStays) {
  write("2026-03", "de.txt", kGood);
  write("2026-03", ".de.txt.swp", "\xFF what a computer leaves");
  write("2026-03", "operator.txt", "Museum der Gesichter\nRaum 7, Montag bis Freitag\n");
  const std::vector<std::byte> sign(std::size_t{3} * 40 * 20, std::byte{77});
  ASSERT_TRUE(hal::write_picture(stick() / "consent" / "2026-03" / "sign.png",
                                 {sign.data(), 40, 20, 120, PixelFormat::Rgb8})
                  .has_value());
  write("2025-11", "en.txt", "An older one\n\nA point\n");
  come_to_it();
  EXPECT_EQ(take(), Outcome::Done);
  EXPECT_TRUE(says("2026-03"));
  EXPECT_TRUE(says("Was hier geschieht")) << "the title, to be looked at";
  EXPECT_EQ(take(), Outcome::Done) << "once more is no harm";
  tap("consent right");
  choose_pins_alone();
  tap("sign out");
  kiosk->turn();
  EXPECT_EQ(kiosk->ui().visit().language, ui::Language::German) << "the only one that can be agreed to";
  EXPECT_TRUE(says("Museum der Gesichter")) << "on the page that invites";
  EXPECT_EQ(kiosk->ui().draw_list().pictures[static_cast<std::size_t>(ui::PictureSlot::Sign)].pixels.width_px,
            40);
  tap("start");
  EXPECT_TRUE(says("und seine Worte."));
  EXPECT_FALSE(says("Mustertext"));
  kiosk.reset();
  start();
  ASSERT_NE(kiosk->view().consent, nullptr) << "over a restart";
  EXPECT_EQ(kiosk->view().consent->version, "2026-03");
}

TEST_F(StaffConsentTest, WhatPeopleAgreedToStaysAsItWas) {
  write("2026-03", "de.txt", kGood);
  come_to_it();
  EXPECT_EQ(take(), Outcome::Done);
  const Path own = args.store / "consent", text = own / "2026-03" / "de.txt";
  const auto started = [&] {
    kiosk.reset();
    testing::internal::CaptureStderr();
    auto opened = Kiosk::open(args, services);
    const std::string said = testing::internal::GetCapturedStderr();
    if (!opened) return std::string(opened.error().where()) + ": " + std::string(opened.error().what.view());
    kiosk = std::move(*opened);
    return said;
  };
  std::ofstream(text, std::ios::binary) << "Was hier geschieht\n\nEin Punkt\nund seine Worte.\n";
  EXPECT_EQ(started(), "") << "the same words, from another editor";
  std::ofstream(text) << "Was hier geschieht\n\nEin Punkt\nund andere Worte.\n";
  EXPECT_EQ(started().find(text.string() + ": has other words"), 0U);
  EXPECT_EQ(kiosk, nullptr) << "it does not start";
  // Under a name of their own they may be shown. What people agreed to has to be put back all the same.
  std::filesystem::rename(own / "2026-03", own / "2026-04");
  EXPECT_EQ(started().find("relievo: " + text.string() + ": is gone"), 0U);
  ASSERT_NE(kiosk, nullptr);
  EXPECT_EQ(kiosk->view().consent->version, "2026-04");
  std::filesystem::create_directory(own / "2026-03");
  std::ofstream(text) << kGood;
  EXPECT_EQ(started(), "");
  std::ofstream(text) << "Etwas anderes\n\nEin Punkt\n";
  EXPECT_EQ(started().find("relievo: " + text.string() + ": has other words"), 0U);
  // Nor does the sample come without a word where the operator's texts are gone.
  std::filesystem::rename(own, args.store / "elsewhere");
  const std::string said = started();
  EXPECT_NE(said.find("2026-03"), std::string::npos) << said;
  EXPECT_NE(said.find("2026-04"), std::string::npos) << said;
  EXPECT_EQ(kiosk->view().consent, nullptr);
}

TEST_F(StaffConsentTest, WhatIsWrongIsSaidAndNothingChanges) {
  come_to_it();
  EXPECT_EQ(take(), Outcome::NotFound);
  EXPECT_NE(said().find("no folder named consent"), std::string::npos) << said();
  const std::string long_text = "T\n\nP\n" + std::string(20'000, 'x');
  std::string many = "T\n";
  for (int i = 0; i < 25; ++i) many += "\nP\n";
  const struct {
    const char* file;
    std::string words;
    const char* reason;
  } wrong[] = {
      {"de.txt", "T\n\n\xFF\xFE", "is not UTF-8"},
      {"de.txt", "", "is empty"},
      {"de.txt", "T\n", "no points"},
      {"de.txt", long_text, "longer than"},
      {"de.txt", many, "more than 24"},
      {"german.txt", "T\n\nP\n", "call it en.txt"},
      {"operator.txt", "\n", "has no name"},
      {"sign.png", "no picture", "1024 pixels"},
      {"link.txt", "http://museum.example/heads/{model}", "is no https address"},
      {"link.txt", "https:///heads/{model}", "is no https address"},
      {"link.txt", "https://us@museum.example/{model}", "is no https address"},
      {"link.txt", "https://{model}.example/heads", "is no https address"},
      {"link.txt", "https://museum.example/our heads/{model}", "is no https address"},
      {"link.txt", "https://museum.example/" + std::string(200, 'x') + "{model}", "is no https address"},
      {"link.txt", "https://museum.example/heads/", "write {model} there"},
      {"link.txt", "https://museum.example/{model}/{model}", "write {model} there"},
      {"de.txt", std::string("T\n\nP\0\n", 7), "is not UTF-8"}};
  for (const auto& one : wrong) {
    std::filesystem::remove_all(stick() / "consent");
    write("2026-03", one.file, one.words);
    EXPECT_EQ(take(), Outcome::Refused);
    EXPECT_EQ(said().find(one.file), 0U) << said();
    EXPECT_NE(said().find(one.reason), std::string::npos) << said();
    EXPECT_TRUE(says("Nothing was changed."));
    sample_is_in_force();
  }
  std::filesystem::remove_all(stick() / "consent");
  write("Fassung März", "de.txt", kGood);
  EXPECT_EQ(take(), Outcome::Refused);
  EXPECT_NE(said().find("letters, digits"), std::string::npos) << said();
  std::filesystem::remove_all(stick() / "consent");
  std::filesystem::create_directories(stick() / "consent" / "2026-03");
  EXPECT_EQ(take(), Outcome::Refused);
  EXPECT_NE(said().find("LANGUAGE.txt is missing"), std::string::npos) << said();
  write("2026-03", "secret", kGood);
  std::filesystem::rename(stick() / "consent" / "2026-03" / "secret", folder.path() / "secret");
  std::filesystem::create_symlink(folder.path() / "secret", stick() / "consent" / "2026-03" / "de.txt");
  EXPECT_EQ(take(), Outcome::Refused) << "a stick leads to no file of the device";
  sample_is_in_force();
  media->unplug();
  EXPECT_EQ(take(), Outcome::NoStick);
  EXPECT_NE(said().find("No stick is ready"), std::string::npos) << said();
  sample_is_in_force();
}

TEST_F(StaffConsentTest, AStickPulledInTheMiddleChangesNothing) {
  PulledAtOnce pulled(stick());
  changes.media = &pulled;
  write("2026-03", "de.txt", kGood);
  come_to_it();
  EXPECT_EQ(take(), Outcome::StickGone);
  EXPECT_NE(said().find("pulled out too early"), std::string::npos) << said();
  sample_is_in_force();
}

TEST_F(StaffConsentTest, WhatTheDeviceCannotKeepIsNotInForce) {
  write("2026-03", "de.txt", kGood);
  come_to_it();
  std::ofstream(args.store / "consent") << "in the way";
  EXPECT_EQ(take(), Outcome::Failed);
  EXPECT_NE(said().find("cannot be kept on this device"), std::string::npos) << said();
  sample_is_in_force();
  std::filesystem::remove(args.store / "consent");
  EXPECT_EQ(take(), Outcome::Done);
}

TEST_F(StaffConsentTest, TheOperatorChangesItLaterByAVersionThatComesAfter) {
  write("2026-03", "en.txt", "The first\n\nA point\n");
  come_to_it();
  EXPECT_EQ(take(), Outcome::Done);
  tap("consent right");
  choose_pins_alone();
  sign_in("80526", StaffRole::Operator);
  tap("open settings");
  EXPECT_TRUE(says("2026-03"));
  tap("consent");
  ASSERT_EQ(kiosk->ui().service().page, StaffPage::Consent);
  EXPECT_EQ(texts().outcome, Outcome::None) << "what happened at the first start is no news";

  write("2026-03", "en.txt", "The first, but not the same\n\nA point\n");
  EXPECT_EQ(take(), Outcome::Refused) << "records name this version: it keeps its words";
  EXPECT_NE(said().find("with other words"), std::string::npos) << said();
  std::filesystem::remove_all(stick() / "consent");
  write("2025-12", "en.txt", "An older one\n\nA point\n");
  EXPECT_EQ(take(), Outcome::Refused);
  EXPECT_NE(said().find("comes before"), std::string::npos) << said();
  EXPECT_EQ(kiosk->view().consent->version, "2026-03");
  write("2026-09", "en.txt", "The second\n\nA point\n");
  EXPECT_EQ(take(), Outcome::Done);
  EXPECT_EQ(kiosk->view().consent->version, "2026-09");
  sign_out();
  tap("start");
  EXPECT_TRUE(says("The second"));
  kiosk.reset();
  EXPECT_NE(text_of_file(args.store / "relievo.log").find("Consent text 2026-09 was taken over"),
            std::string::npos);
}

}  // namespace
}  // namespace relievo::firmware
