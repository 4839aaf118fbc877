// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/kiosk/receipt_slip.h"

#include <algorithm>
#include <cmath>

#include "firmware/kiosk/code/qr_code.h"
#include "firmware/service/access.h"

namespace relievo::firmware {
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
