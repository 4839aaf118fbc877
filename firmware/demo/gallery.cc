// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/demo/gallery.h"

#include <algorithm>
#include <array>
#include <utility>

#include "firmware/kiosk/code/qr_code.h"
#include "firmware/technician/show/technician_pictures.h"

namespace relievo::firmware {
namespace {

using pipeline::Advice;
using ui::Overlay;
using ui::Screen;
using ui::Step;
using ui::Trouble;

// In the order of Language.
constexpr std::array kNames{"Ada Lovelace", "Jürgen Müller", "Zoé Lefèvre", "Iñaki Muñoz",
                            "ليلى حسن",     "נועה לוי",      "Wang Wei",    "Sato Yuki"};
static_assert(kNames.size() == ui::kLanguages);

class Gallery {
 public:
  Gallery(const ui::ViewState& review, ui::Language language, std::size_t text_size, bool high_contrast)
      : review_(review) {
    visit_.language = language;
    visit_.text_size = text_size;
    visit_.high_contrast = high_contrast;
    visit_.touched(review.now);
  }

  ui::ViewState idle() const {
    ui::ViewState view = review_;
    view.screen = Screen::Idle;
    view.model = nullptr;
    view.cameras_on = false;
    view.trouble = Trouble::None;
    view.stages = {};
    return view;
  }
  ui::Visit at(Step step, Overlay overlay = Overlay::None) const {
    ui::Visit visit = visit_;
    visit.step = step;
    visit.overlay = overlay;
    return visit;
  }
  // Long after the last person went.
  ui::Visit resting(const ui::ViewState& view) const {
    ui::Visit visit = at(Step::Attract);
    ui::ViewState seen = view;
    seen.home = visit.language;
    visit.follow(seen);
    return visit;
  }
  ui::Visit named() const {
    ui::Visit visit = at(Step::Name);
    visit.type(kNames[std::size_t(visit.language)]);
    return visit;
  }
  ui::Visit quoting(std::string_view code) const {
    ui::Visit visit = at(Step::Known);
    visit.act(ui::ActionKind::HaveCode, review_);
    visit.type(code);
    return visit;
  }
  void add(std::string_view name, const ui::ViewState& view, const ui::Visit& visit) {
    exhibits.push_back({name, view, visit, {}});
  }

  // Before the first picture the page says that the cameras are starting, and nothing of a face.
  ui::ViewState looked_at() const {
    ui::ViewState view = idle();
    view.live.number = std::max(1U, view.live.number);
    return view;
  }
  // `by_button`: the picture is not taken by itself.
  void add_position(std::string_view name, Advice advice, float face_x, float steady_s, int attempt,
                    bool by_button = false) {
    ui::ViewState view = looked_at();
    view.screen = Screen::Position;
    view.live.advice = advice;
    view.live.face_x = face_x;
    view.live.steady_s = steady_s;
    view.live.nearness = advice == Advice::TooClose ? 1.3F : advice == Advice::TooFar ? 0.7F : 1.0F;
    view.attempt = attempt;
    if (attempt > 0) view.trouble = Trouble::Refused;
    if (by_button) view.settings.set(ui::Setting::Automatic, 0);
    add(name, view, at(Step::Position));
  }
  void add_turn(std::string_view name, pipeline::TurnAdvice advice, float yaw_deg, unsigned long taken) {
    ui::ViewState view = looked_at();
    view.screen = Screen::Turn;
    view.live.turn = ui::TurnView{advice, yaw_deg, taken};
    view.live.nearness = 1;
    add(name, view, at(Step::Turn));
  }
  void add_working(std::string_view name, Screen screen, std::size_t born) {
    ui::ViewState view = idle();
    view.screen = screen;
    view.progress = screen == Screen::Store ? 1 : 0.1F + 0.2F * float(born);
    for (std::size_t i = 0; i <= born; ++i) view.stages[i] = review_.stages[i];
    add(name, view, at(Step::Working));
  }
  void add_trouble(std::string_view name, Trouble trouble, Screen screen) {
    ui::ViewState view = idle();
    view.screen = screen;
    view.trouble = trouble;
    add(name, view, at(Step::Trouble));
  }

  std::vector<Exhibit> exhibits;

 private:
  ui::ViewState review_;
  ui::Visit visit_;
};

// An operator with a name and a sign: a disc on white.
const ui::ConsentTexts& hosts_text() {
  static const ui::ConsentTexts texts = [] {
    ui::ConsentTexts made;
    made.host = {"Museum of Faces, Nottingham",
                 "faces@example.org",
                 "https://faces.example.org/heads/{model}",
                 {},
                 96,
                 96,
                 PixelFormat::Rgb8};
    for (int y = -48; y < 48; ++y)
      for (int x = -48; x < 48; ++x) {
        const int r = x * x + y * y;
        for (const int v :
             r > 46 * 46 || (r < 30 * 30 && y < 0) ? std::array{255, 255, 255} : std::array{11, 112, 80})
          made.host.sign.push_back(static_cast<std::byte>(v));
      }
    return made;
  }();
  return texts;
}

// From the invitation to the name.
void add_beginning(Gallery& g, const ui::ViewState& idle) {
  g.add("starting", idle, g.at(Step::Starting));
  g.add("attract", idle, g.at(Step::Attract));
  ui::ViewState hosted = idle;
  hosted.consent = &hosts_text();
  g.add("attract_host", hosted, g.at(Step::Attract));
  hosted.somebody_near = false;
  hosted.now += std::chrono::hours(1);
  g.add("attract_rests", hosted, g.resting(hosted));
  g.add("languages", idle, g.at(Step::Attract, Overlay::Languages));
  g.add("consent", idle, g.at(Step::Consent));
  g.add("declined", idle, g.at(Step::Declined));
  g.add("name_empty", idle, g.at(Step::Name));
  g.add("name", idle, g.named());
  ui::ViewState met = idle;
  met.known = ui::Known::Name;
  g.add("known_name", met, g.at(Step::Known));
  met.known = ui::Known::NoSuchCode;
  ui::Visit refused = g.quoting("4821-9037-5512-17");
  refused.act(ui::ActionKind::Done, met);
  g.add("wrong_code", met, refused);
  g.add("code", idle, g.quoting("4821-90"));
  g.add("lost_code", idle, g.at(Step::Known, Overlay::LostCode));
  met.known = ui::Known::Code;
  g.add("known_code", met, g.at(Step::Known));
}

void add_capture(Gallery& g) {
  g.add_position("position_look", Advice::NoFace, 0, 0, 0);
  g.add_position("position_aside", Advice::OffCentre, 0.5F, 0, 0);
  g.add_position("position_close", Advice::TooClose, 0, 0, 0);
  g.add_position("position_far", Advice::TooFar, 0, 0, 0);
  g.add_position("position_turned", Advice::TurnedAside, 0, 0, 0);
  g.add_position("position_chin", Advice::LooksUpOrDown, 0, 0, 0);
  g.add_position("position_again", Advice::Moved, 0, 0, 1);
  g.add_position("position_countdown", Advice::None, 0, ui::kSteadyFor + 0.6F, 0);
  g.add_position("position_button", Advice::None, 0, 0, 0, true);
  g.add_turn("turn_begin", pipeline::TurnAdvice::ToLeft, 0, 0);
  g.add_turn("turn", pipeline::TurnAdvice::Slower, 19, 0b0011);
  g.add_working("working_begin", Screen::Match, 0);
  g.add_working("working", Screen::Mesh, 2);
  g.add_working("working_head", Screen::Fuse, 4);
  g.add_working("storing", Screen::Store, 4);
}

// A stick of one's own, and a link, beside a printer.
void add_taking_home(Gallery& g, ui::ViewState done) {
  using ui::Outcome;
  using ui::Taking;
  const auto add = [&](std::string_view name, Taking taking, Outcome outcome = Outcome::None) {
    done.take_home.taking = taking;
    done.take_home.outcome = outcome;
    g.add(name, done, g.at(Step::Thanks));
  };
  add("thanks_stick", Taking::NoStick);
  add("thanks_stick_before", Taking::NotOurs);
  done.printing = ui::Printing::Ready;
  add("thanks_stick_ready", Taking::Ready);
  done.take_home.progress = 0.6F;
  add("thanks_stick_busy", Taking::Busy);
  add("thanks_stick_done", Taking::NoStick, Outcome::Done);
  for (const auto& [name, outcome] : {std::pair{"thanks_stick_held", Outcome::StickHeld},
                                      std::pair{"thanks_stick_full", Outcome::StickFull},
                                      std::pair{"thanks_stick_locked", Outcome::StickLocked},
                                      std::pair{"thanks_stick_bad", Outcome::StickBad}})
    add(name, Taking::Ready, outcome);
  add("thanks_stick_gone", Taking::NoStick, Outcome::StickGone);
  done.take_home.link = "https://faces.example.org/heads/0d4a8f6c2b9e7a5310c8f4d6b2a09e17";
  static const hal::Picture link = code_picture(done.take_home.link);
  done.take_home.link_code = {link.view(), 1};
  add("thanks_link_busy", Taking::Busy);
  done.printing = ui::Printing::None;
  add("thanks_link_stick", Taking::Ready);
  add("thanks_link", Taking::None);
}

void add_decision(Gallery& g, const ui::ViewState& review, const ui::ViewState& idle) {
  g.add("review", review, g.at(Step::Review));
  ui::ViewState full = review;
  full.trouble = Trouble::StorageFull;
  ui::Visit turned = g.at(Step::Review);
  turned.look = {.yaw_deg = 32, .pitch_deg = 6, .zoom = 1.1F, .light_deg = 25, .textured = false};
  for (const auto& [name, born] : {std::pair("review_points", 0.42F), {"review_surface", 0.75F}}) {
    ui::Visit birth = g.at(Step::Review);
    birth.look.born = born;
    g.add(name, review, birth);
  }
  g.add("review_turned", review, turned);
  g.add("review_store_full", full, g.at(Step::Review));
  static const pipeline::FaceModel without_a_side = [] {
    pipeline::FaceModel model(std::pmr::get_default_resource());
    model.poses_left_out = 1;
    return model;
  }();
  ui::ViewState lacking = review;
  lacking.model = &without_a_side;
  g.add("review_side_left_out", lacking, g.at(Step::Review));
  ui::ViewState done = idle;
  done.receipt = "4821-9037-5512-71";
  static const hal::Picture code = code_picture(done.receipt);
  done.receipt_code = {code.view(), 1};
  g.add("thanks", done, g.at(Step::Thanks));
  done.printing = ui::Printing::Ready;
  g.add("thanks_printer", done, g.at(Step::Thanks));
  done.printing = ui::Printing::Done;
  g.add("thanks_printed", done, g.at(Step::Thanks));
  add_taking_home(g, done);
  done.now += ui::kReceiptPatience + std::chrono::seconds(4);
  g.add("thanks_still_there", done, g.at(Step::Thanks, Overlay::StillThere));
}

// Where pages can be read aloud.
void add_heard(Gallery& g, const ui::ViewState& idle) {
  ui::ViewState heard = idle;
  heard.voices.set();
  ui::Visit help = g.at(Step::Consent, Overlay::Help);
  help.spoken = true;
  g.add("attract_heard", heard, g.at(Step::Attract));
  g.add("help_heard", heard, help);
}

// What lies over a page.
void add_overlays(Gallery& g, const ui::ViewState& review, const ui::ViewState& idle) {
  g.add("privacy", idle, g.at(Step::Consent, Overlay::Privacy));
  ui::ViewState hosted = idle;
  hosted.consent = &hosts_text();
  hosted.settings.set(ui::Setting::KeepDays, 365);
  hosted.settings.set(ui::Setting::TakeHome, 1);
  g.add("privacy_host", hosted, g.at(Step::Attract, Overlay::Privacy));
  g.add("help", idle, g.at(Step::Consent, Overlay::Help));
  g.add("leave", review, g.at(Step::Review, Overlay::Leave));
  ui::ViewState late = idle;
  late.now += std::chrono::seconds(late.settings.of(ui::Setting::PatienceS) + 4);
  g.add("still_there", late, g.at(Step::Consent, Overlay::StillThere));
}

void add_troubles(Gallery& g, const ui::ViewState& idle) {
  g.add_trouble("trouble_camera", Trouble::Camera, Screen::Fault);
  g.add_trouble("trouble_calibration", Trouble::Calibration, Screen::Fault);
  g.add_trouble("trouble_refused", Trouble::Refused, Screen::Idle);
  g.add_trouble("trouble_store", Trouble::Storage, Screen::Fault);
  g.add_trouble("trouble_time", Trouble::TookTooLong, Screen::Idle);
  ui::ViewState barred = idle;
  barred.out_of_order = Trouble::Uncalibrated;
  g.add("trouble_uncalibrated", barred, g.at(Step::Trouble));
  barred.out_of_order = Trouble::Clock;
  g.add("trouble_clock", barred, g.at(Step::Trouble));
  barred.out_of_order = Trouble::Restarted;
  g.add("trouble_restarted", barred, g.at(Step::Trouble));
  g.add_trouble("trouble_other", Trouble::Other, Screen::Fault);
}

// How the one put aside differs, and the present one by itself.
void add_differences(const Lender& all, const ui::ViewState& review, ui::TechnicianView view) {
  view.differences = true;
  view.full_colour_mm = 0.5F;
  view.scale = difference_scale();
  view.compared[0].difference = {true, -0.04F, 0.31F, {review.stages[1].pixels, 900041}, nullptr, 900041};
  view.compared[view.put_aside] = {view.result, view.shown[0], view.model, view.model_number, {}};
  all.add("technician_difference", ui::StaffPage::Compare, view);
  ui::FaceRuler& ruler = all.add("technician_compare_alone", ui::StaffPage::Compare, view, 1).service.ruler;
  ruler.on = true;
  ruler.set({-31, 34, 18});
  ruler.set({32, 33, 19});
}

}  // namespace

std::vector<Exhibit> gallery(const ui::ViewState& review, ui::Language language, std::size_t text_size,
                             bool high_contrast) {
  Gallery g(review, language, text_size, high_contrast);
  const ui::ViewState idle = g.idle();
  add_beginning(g, idle);
  add_capture(g);
  add_decision(g, review, idle);
  add_overlays(g, review, idle);
  add_heard(g, idle);
  add_troubles(g, idle);
  const ui::Visit visit = g.at(Step::Attract);
  const Lender staff{g.exhibits, idle, visit};
  add_staff_exhibits(staff);
  add_technician_exhibits(staff, review);
  return std::move(g.exhibits);
}

// The same capture by other algorithms, another document, and one whose matcher gave up.
void add_comparisons(const Lender& all, const ui::ViewState& review, ui::TechnicianView view) {
  const auto present = [&view] {
    return ui::TechnicianCompared{view.result, view.shown[0], view.model, view.model_number, {}};
  };
  const auto put_aside = [&] { view.compared[view.put_aside++] = present(); };
  const auto add_with_present = [&](std::string_view name) {
    view.compared[view.put_aside] = present();
    all.add(name, ui::StaffPage::Compare, view);
  };
  lend(review, ui::TechnicianStage::Mesh, view);
  put_aside();
  view.result.algorithms = "matcher = zmncc\nzmncc.window_px = 9";
  view.result.seconds[0] = 3.87F;
  view.result.accepted = view.result.made[0] = 96114;
  add_with_present("technician_compare");
  add_differences(all, review, view);
  put_aside();
  view.result.name = "2026-03-11_16-40-52";
  view.result.algorithms = {};
  add_with_present("technician_compare_three");
  lend(review, ui::TechnicianStage::Disparity, view);
  for (std::size_t i = 0; i < view.put_aside; ++i) view.compared[i].picture = view.shown[0];
  put_aside();
  view.result.algorithms = "matcher = sgm";
  view.result.failure = {
      Errc::NoFace,
      "the points form no surface of a face's size: look straight into the cameras and try again"};
  view.result.failed_at = 2;
  view.result.coverage = 0;
  view.model = nullptr;
  add_with_present("technician_compare_four");
}

}  // namespace relievo::firmware
