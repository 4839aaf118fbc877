// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/kiosk/take_home.h"

#include <algorithm>
#include <cmath>

#include "firmware/base/budget.h"
#include "firmware/kiosk/code/qr_code.h"
#include "firmware/service/access.h"

namespace relievo::firmware {

void TakeHome::look(bool visited) {
  const bool there = parts_.media.current().has_value();
  if (there && !there_) {
    // The staff's export, which may go on after they have left, lets its stick go and takes it up again.
    ours_ = visited && !parts_.media.is_taken_up();
    writing_.reset();  // how it went with another stick is no news
    given_up_ = false;
  }
  there_ = there;
  ours_ = ours_ && visited && there;
}

void TakeHome::follow(ui::ViewState& view, bool visited) {
  ui::TakeHomeView& home = view.take_home;
  // A visit that ends while its copy is still being stopped leaves its stick to nobody.
  ours_ = ours_ && visited;
  const bool left = view.receipt.empty();
  if (writes()) {
    if (left || view.now - begun_ > budget::kTakeHomeLimit) {
      given_up_ = true;
      stop();
    }
  } else {
    if (left) {
      writing_.reset();
      given_up_ = false;
    }
    if (!view.settings.is_on(ui::Setting::TakeHome)) {
      ours_ = false;
      there_ = true;
      return;
    }
    // The staff's export may hold its stick for long; what is there afterwards is no visitor's.
    if (!visited && parts_.side_tasks.busy(JobLane::Keeper)) {
      there_ = true;
    } else if (wrote_ || view.now - looked_ >= budget::kStickLook) {
      looked_ = view.now;
      look(visited);
    }
  }
  wrote_ = writes();
  if (left) return;
  using ui::Taking;
  if (writes() && !given_up_) {
    home.taking = Taking::Busy;
    home.progress = parts_.side_tasks.progress(JobLane::Keeper);
    return;
  }
  home.taking = writes() || !there_ ? Taking::NoStick : ours_ ? Taking::Ready : Taking::NotOurs;
  if (given_up_) home.outcome = ui::Outcome::Failed;
  else if (writing_ != nullptr) home.outcome = writing_->outcome;
}

void TakeHome::take(storage::EnrolmentId enrolment, const ui::Settings& settings) {
  if (writes() || !ours_) return;
  writing_ = std::make_shared<Writing>();
  given_up_ = false;
  begun_ = parts_.clock.now();
  const FurtherModels further{.watertight = settings.is_on(ui::Setting::Solids)};
  task_ = parts_.side_tasks.send(
      JobLane::Keeper,
      [parts = parts_, writing = writing_, enrolment, further](JobControl& control) -> Result<void> {
        RELIEVO_TRY_ASSIGN(const storage::Enrolment stored, parts.store.enrolment(enrolment));
        return export_records(parts.store, parts.clock, parts.media, {stored.subject}, further, control,
                              writing->trace);
      },
      [&log = parts_.log, writing = writing_](const std::optional<Error>& error) {
        writing->ended = true;
        // A stick that was there for the touch and is not for the keeper was pulled out.
        writing->outcome = !error                              ? ui::Outcome::Done
                           : error->code == Errc::MediaMissing ? ui::Outcome::StickGone
                                                               : outcome_of_export(*error, writing->trace);
        if (writing->trace.whole > 0) log.say(ui::LogEvent::TakenHome);
        if (error && error->code != Errc::Cancelled) log.fault(*error);
      },
      SideTasks::Whose::Device);
}

// It may still wait for the keeper behind others' work, which goes on.
void TakeHome::stop() {
  if (writes()) parts_.side_tasks.stop(task_);
}

namespace {

constexpr int kWidthPx = 576, kMarginPx = 24, kGapPx = 20, kHighPx = 1600;

// A long white slip; cut where the writing ends.
class Paper {
 public:
  Paper(ui::TextEngine& text, ui::Language language) : text_(text), language_(language) {
    picture_.format = PixelFormat::Grey8;
    picture_.width_px = kWidthPx;
    picture_.bytes.assign(std::size_t(kWidthPx) * kHighPx, std::byte{255});
  }
  void write(std::string_view words, float size_px, ui::Weight weight) {
    const ui::LanguageInfo& info = ui::info_of(language_);
    ui::TextStyle style;
    style.size_px = size_px;
    style.weight = weight;
    style.align = ui::TextAlign::Centre;
    style.right_to_left = info.right_to_left;
    style.language = info.code;
    const ui::TextLabel& label = text_.label(words, style, kWidthPx - 2 * kMarginPx);
    const int left = int(std::lround((kWidthPx - label.size.width_px) / 2 + label.ink.x)),
              top = y_ + int(std::lround(label.ink.y));
    for (int y = 0; y < int(label.atlas.h); ++y)
      for (int x = 0; x < int(label.atlas.w); ++x)
        put(left + x, top + y, 255 - *text_.atlas().row(int(label.atlas.x) + x, int(label.atlas.y) + y));
    y_ += int(std::ceil(label.size.height_px)) + kGapPx;
  }
  void paste(const ImageView& picture) {
    for (int y = 0; y < picture.height_px; ++y)
      for (int x = 0; x < picture.width_px; ++x)
        put((kWidthPx - picture.width_px) / 2 + x, y_ + y, *(picture.row(y) + x));
    y_ += picture.height_px;
  }
  hal::Picture take() {
    picture_.height_px = std::min(y_ + kGapPx, kHighPx);
    picture_.bytes.resize(std::size_t(kWidthPx) * std::size_t(picture_.height_px));
    return std::move(picture_);
  }

 private:
  void put(int x, int y, int level) {
    if (x < 0 || y < 0 || x >= kWidthPx || y >= kHighPx) return;
    std::byte& at = picture_.bytes[std::size_t(y) * kWidthPx + std::size_t(x)];
    at = std::min(at, static_cast<std::byte>(level));
  }
  ui::TextEngine& text_;
  ui::Language language_;
  hal::Picture picture_;
  int y_ = kGapPx;
};

}  // namespace

hal::Picture draw_slip(ui::TextEngine& text, ui::Language language, const ui::ViewState& view) {
  const ui::Words tr(language);
  Paper paper(text, language);
  if (view.consent != nullptr && !view.consent->host.name.empty())
    paper.write(view.consent->host.name, 34, ui::Weight::Bold);
  paper.write(tr("Your code"), 30, ui::Weight::Medium);
  paper.paste(view.receipt_code.pixels);
  paper.write(view.receipt, 46, ui::Weight::Bold);
  paper.write(tr("You get a code. Quote it to the staff at any time and everything about you is erased."), 26,
              ui::Weight::Regular);
  const ui::TakeHomeView& home = view.take_home;
  if (home.link_code.pixels.empty()) return paper.take();
  paper.write(tr("Your portrait"), 30, ui::Weight::Medium);
  paper.paste(home.link_code.pixels);
  paper.write(ui::site_of(home.link), 30, ui::Weight::Bold);
  return paper.take();
}

void ReceiptSlip::wipe() {
  wipe_text(receipt_);
  wipe_text(link_);
  code_ = {};
  link_code_ = {};
  printing_ = std::make_shared<ui::Printing>(ui::Printing::None);
}

void ReceiptSlip::follow(ui::ViewState& view, std::string_view number) {
  if (view.receipt != receipt_) {
    wipe();
    receipt_ = view.receipt;
    if (receipt_.empty()) return;
    code_ = code_picture(receipt_);
    if (view.consent != nullptr && !number.empty()) link_ = view.consent->host.link;
    if (!link_.empty()) {
      link_.replace(link_.find(ui::kModelPlace), ui::kModelPlace.size(), number);
      link_code_ = code_picture(link_);
    }
    ++number_;
    ask_printer();
  }
  if (!code_.bytes.empty()) view.receipt_code = {code_.view(), number_};
  if (!link_code_.bytes.empty()) {
    view.take_home.link = link_;
    view.take_home.link_code = {link_code_.view(), number_};
  }
  view.printing = *printing_;
}

// Who left while it was asked is told nothing: what is heard goes to their visit's state alone.
void ReceiptSlip::ask_printer() {
  if (printer_ == nullptr) return;
  side_tasks_.ask(
      JobLane::Keeper, [printer = printer_](JobControl&) { return Result(printer->is_there()); },
      [state = printing_](const Result<bool>& there) {
        if (there && *there) *state = ui::Printing::Ready;
      },
      SideTasks::Whose::Device);
}

void ReceiptSlip::print(ui::TextEngine& text, ui::Language language, const ui::ViewState& view) {
  if (receipt_.empty() || *printing_ == ui::Printing::None || *printing_ == ui::Printing::Busy) return;
  auto png = hal::encode_png(draw_slip(text, language, view).view());
  if (!png) return void(*printing_ = ui::Printing::Failed);
  *printing_ = ui::Printing::Busy;
  const auto bytes = std::make_shared<std::vector<std::byte>>(std::move(*png));
  side_tasks_.send(
      JobLane::Keeper, [printer = printer_, bytes](JobControl&) { return printer->print(*bytes); },
      [state = printing_](const std::optional<Error>& error) {
        *state = error ? ui::Printing::Failed : ui::Printing::Done;
      },
      SideTasks::Whose::Device);
}

}  // namespace relievo::firmware
