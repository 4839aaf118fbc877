// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "firmware/demo/gallery.h"
#include "firmware/kiosk/invitation_head.h"
#include "hal/base/result.h"
#include "hal/base/whole_file.h"
#include "hal/picture_file.h"
#include "pipeline/mesh/detail/level_of_detail.h"
#include "pipeline/model/face_model.h"
#include "storage/model_blob.h"
#include "ui/render/renderer.h"

namespace relievo::firmware {
namespace {

// The head of the page that invites (firmware/kiosk/invitation_head.h): a lighter form of a model, as two
// files in the folder, which must exist.
constexpr int kTriangles = 9000;  // seen from across a room
constexpr int kTexturePx = 768;
constexpr int kJpegPercent = 88;

Result<void> make_invitation_head(const pipeline::FaceModel& model, const std::filesystem::path& folder) {
  std::pmr::monotonic_buffer_resource memory;
  pipeline::DetailOptions options;
  options.triangles = kTriangles;
  RELIEVO_TRY_ASSIGN(pipeline::LighterModel light, pipeline::lighten(model, options, &memory));
  pipeline::TextureAtlas& atlas = light.model.texture;
  const ImageView skin{reinterpret_cast<const std::byte*>(atlas.rgb.data()), atlas.width_px, atlas.height_px,
                       3 * atlas.width_px, PixelFormat::Rgb8};
  const int step = std::max(1, std::max(atlas.width_px, atlas.height_px) / kTexturePx);
  RELIEVO_TRY_ASSIGN(const hal::Picture small,
                     hal::reduced(skin, atlas.width_px / step, atlas.height_px / step));
  RELIEVO_TRY_ASSIGN(const auto jpeg, hal::encode_jpeg(small.view(), kJpegPercent));
  atlas.width_px = atlas.height_px = 1;
  atlas.rgb.assign(3, 0);
  atlas.origin.clear();
  light.model.landmarks = {};
  RELIEVO_TRY_ASSIGN(const auto mesh, storage::encode_model(light.model));
  RELIEVO_TRY(write_whole_file(folder / kInvitationHeadMesh, mesh));
  return write_whole_file(folder / kInvitationHeadTexture, jpeg);
}

struct Size {
  int width_px, height_px;
};
constexpr Size kSizes[] = {{1280, 800}, {1920, 1080}, {1080, 1920}};
constexpr std::size_t kTexts[] = {0, 2, 3};  // 100, 150 and 200 %
constexpr int kMostTroubles = 3;
constexpr int kThumbAcross = 6, kMostRows = 10, kThumbWidthPx = 480;

void tap(Kiosk& kiosk, std::string_view id) {
  const ui::Node* node = kiosk.ui().tree().find(id);
  if (node == nullptr || kiosk.ui().has_just_come(kiosk.view().now)) return;
  const float x = node->rect.x + node->rect.w / 2, y = node->rect.y + node->rect.h / 2;
  kiosk.feed({ui::Input::Kind::Down, 1, x, y});
  kiosk.feed({ui::Input::Kind::Up, 1, x, y});
}

// What a person would do who reads it: pass by that the run before this one ended in the middle, and try
// again what took too long on a busy machine or was refused. What nobody can pass by, and what happens again
// and again, ends it.
Result<void> may_be_passed_by(Kiosk& kiosk, int& troubles) {
  const ui::ViewState& view = kiosk.view();
  if (view.out_of_order == ui::Trouble::Clock)
    return Error{Errc::InvalidState, "the clock is wrong: set it, then take the pictures"};
  if (ui::bars_the_way(view.out_of_order))
    return Error{Errc::NotCalibrated,
                 "these cameras measure nothing now: calibrate them, or give --store a new folder"};
  if (view.out_of_order != ui::Trouble::Restarted && ++troubles > kMostTroubles)
    return kiosk.appliance().problem() ? *kiosk.appliance().problem()
                                       : Error{Errc::InvalidState, "the enrolment ended early"};
  return {};
}

Result<void> not_cancelled() {
  if (interrupted().load()) return Error{Errc::Cancelled, "the screenshots were cancelled"};
  return {};
}

// One whole visit up to Review, by touch. The live picture is copied: it is wiped when the real one is taken.
Result<void> reach_review(Kiosk& kiosk, hal::Picture& live, ui::ViewState& view, Console& console) {
  kiosk.ui().resize(1280, 800);
  int troubles = 0;
  ui::Step before = ui::Step::Starting;
  while (kiosk.appliance().state() != State::Review) {
    RELIEVO_TRY(not_cancelled());
    kiosk.turn();
    const ui::Step step = kiosk.ui().visit().step;
    console.progress(name_of(kiosk.appliance().state()), 0);
    if (step == ui::Step::Trouble && before != step) RELIEVO_TRY(may_be_passed_by(kiosk, troubles));
    if (step == ui::Step::Trouble) tap(kiosk, "finish");  // in a fault there is none: that ends by itself
    before = step;
    if (step == ui::Step::Attract) tap(kiosk, "start");
    if (step == ui::Step::Known) tap(kiosk, "somebody_else");
    if (step == ui::Step::Consent) tap(kiosk, "agree");
    const ImageView& picture = kiosk.view().live.picture;
    if (step == ui::Step::Position && !picture.empty()) {
      const auto bytes = std::size_t(picture.stride_bytes) * std::size_t(picture.height_px);
      live.bytes.assign(picture.bytes, picture.bytes + bytes);
      live.width_px = picture.width_px;
      live.height_px = picture.height_px;
      view.live = kiosk.view().live;
    }
    if (step == ui::Step::Turn) tap(kiosk, "enough");
    if (step == ui::Step::Name) {
      if (kiosk.ui().visit().name().empty()) kiosk.ui().visit().type("1");
      kiosk.turn();
      tap(kiosk, "done");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  kiosk.turn();
  console.clear_progress();
  const ui::LiveView seen = view.live;
  view = kiosk.view();
  view.live = seen;
  view.live.picture = live.view();
  return {};
}

class Sheet {
 public:
  // More pages, more of them beside each other, and smaller where the sheet would be too large a picture.
  Sheet(std::size_t count, Size size)
      : across_(std::max(kThumbAcross, (int(count) + kMostRows - 1) / kMostRows)) {
    const int rows = (int(count) + across_ - 1) / across_;
    for (thumb_w_ = kThumbWidthPx;; thumb_w_ -= 8) {
      thumb_h_ = thumb_w_ * size.height_px / size.width_px;
      sheet_.width_px = across_ * (thumb_w_ + 8);
      sheet_.height_px = rows * (thumb_h_ + 8);
      if (std::max(sheet_.width_px, sheet_.height_px) <= hal::kMaxPictureSidePx &&
          long(sheet_.width_px) * sheet_.height_px <= hal::kMaxPictureAreaPx)
        break;
    }
    sheet_.bytes.assign(std::size_t{3} * std::size_t(sheet_.width_px) * std::size_t(sheet_.height_px),
                        std::byte{90});
  }
  Result<void> add(const hal::Picture& picture) {
    RELIEVO_TRY_ASSIGN(const hal::Picture small, hal::reduced(picture.view(), thumb_w_, thumb_h_));
    const int x0 = count_ % across_ * (thumb_w_ + 8) + 4, y0 = count_ / across_ * (thumb_h_ + 8) + 4;
    ++count_;
    for (int y = 0; y < thumb_h_; ++y)
      std::copy_n(
          small.bytes.begin() + std::ptrdiff_t{3} * y * thumb_w_, std::ptrdiff_t{3} * thumb_w_,
          sheet_.bytes.begin() + std::ptrdiff_t{3} * ((y0 + y) * std::ptrdiff_t(sheet_.width_px) + x0));
    return {};
  }
  const hal::Picture& picture() const { return sheet_; }

 private:
  hal::Picture sheet_;
  int across_, thumb_w_ = 0, thumb_h_ = 0;
  int count_ = 0;
};

// "1280x800_100_de/07": of the pages in a folder of that name those with this in their own.
struct Only {
  std::string pages, page;
};
Only only_of(const std::string& text) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  return {text.substr(0, slash), text.substr(std::min(slash + 1, text.size()))};
}

std::string file_of(int number, std::string_view name) {
  char page[96];
  std::snprintf(page, sizeof page, "%02d_%.*s", number, int(name.size()), name.data());
  return page;
}

class Photographer {
 public:
  Photographer(std::unique_ptr<ui::Renderer> renderer, std::unique_ptr<ui::TextEngine> text,
               const KioskArgs& args)
      : renderer_(std::move(renderer)),
        ui_(std::move(text)),
        folder_(args.screenshots),
        only_(only_of(args.only)) {}

  Result<void> take(const ui::ViewState& review, Size size, std::size_t text_size, ui::Language language,
                    bool contrast, Console& console) {
    char words[64];
    std::snprintf(words, sizeof words, "%dx%d_%d%s_%s", size.width_px, size.height_px,
                  ui::kTextPercents[text_size], contrast ? "_contrast" : "", ui::info_of(language).code);
    if (std::string_view(words).find(only_.pages) == std::string_view::npos) return {};
    const auto exhibits = gallery(review, language, text_size, contrast);
    std::error_code error;
    std::filesystem::create_directories(folder_ / words, error);
    if (error)
      return Error{Errc::IoFailed, "no folder can be made there: choose another"}.at(
          (folder_ / words).string());
    ui_.resize(size.width_px, size.height_px);
    RELIEVO_TRY_ASSIGN(const auto target, ui::Offscreen::make(size.width_px, size.height_px));
    std::vector<std::pair<std::string, const Exhibit*>> wanted;
    for (int number = 0; const Exhibit& exhibit : exhibits) {
      const std::string page = file_of(++number, exhibit.name);
      if (page.find(only_.page) != std::string::npos) wanted.emplace_back(page, &exhibit);
    }
    if (wanted.empty()) {
      for (const Exhibit& exhibit : exhibits) others_.emplace(exhibit.name);
      return {};
    }
    took_any_ = true;
    Sheet sheet(wanted.size(), size);
    hal::Picture picture;
    picture.width_px = size.width_px;
    picture.height_px = size.height_px;
    picture.bytes.resize(std::size_t{3} * std::size_t(size.width_px) * std::size_t(size.height_px));
    for (const auto& [page, exhibit] : wanted) {
      RELIEVO_TRY(not_cancelled());
      ui_.show(exhibit->view, exhibit->visit, exhibit->service);
      target->begin();
      renderer_->draw(ui_.draw_list(), ui_.text().atlas(), size.width_px, size.height_px);
      renderer_->read_back({reinterpret_cast<std::uint8_t*>(picture.bytes.data()), picture.bytes.size()},
                           size.width_px, size.height_px);
      target->end();
      const Path file = folder_ / words / page;
      RELIEVO_TRY(hal::write_picture(Path(file) += ".png", picture.view()));
      const std::string nodes = ui_.tree().to_json();
      RELIEVO_TRY(write_whole_file(Path(file) += ".json", std::as_bytes(std::span(nodes))));
      RELIEVO_TRY(sheet.add(picture));
    }
    const std::string name = std::string("sheet_") + words + ".png";
    console.say(name);
    return hal::write_picture(folder_ / name, sheet.picture().view());
  }

  // InvalidInput, and says what there is, where nothing is called as was asked.
  Result<void> done(Console& console) const {
    if (took_any_) return {};
    std::string names;
    for (const std::string& name : others_) names += (names.empty() ? "pages: " : " ") + name;
    if (!names.empty()) console.say(names);
    return invalid(
        "nothing is called as --only asks: SIZE_TEXT_LANGUAGE or SIZE_TEXT_LANGUAGE/PAGE, a part of each");
  }

 private:
  std::unique_ptr<ui::Renderer> renderer_;
  ui::Ui ui_;
  Path folder_;
  Only only_;
  bool took_any_ = false;
  std::set<std::string> others_;  // of pages that were not asked for
};

}  // namespace

Result<void> take_screenshots(const KioskArgs& args, Kiosk& kiosk, Console& console) {
  hal::Picture live;
  ui::ViewState review;
  RELIEVO_TRY(reach_review(kiosk, live, review, console));
  if (args.write_invitation_head) return make_invitation_head(*kiosk.view().model, args.screenshots);
  RELIEVO_TRY_ASSIGN(auto renderer, ui::Renderer::make());
  RELIEVO_TRY_ASSIGN(auto text, ui::TextEngine::make());
  Photographer photographer(std::move(renderer), std::move(text), args);
  for (const Size size : kSizes) {
    for (const std::size_t text_size : kTexts) {
      for (std::size_t i = 0; i < ui::kLanguages; ++i) {
        RELIEVO_TRY(photographer.take(review, size, text_size, static_cast<ui::Language>(i), false, console));
      }
    }
  }
  // High contrast changes colours alone: one size, one language; asked for by name, every other language,
  // too.
  const bool asked = args.only.find("contrast") != std::string::npos;
  for (std::size_t i = 0; i < (asked ? ui::kLanguages : 1); ++i) {
    RELIEVO_TRY(photographer.take(review, kSizes[0], 0, static_cast<ui::Language>(i), true, console));
  }
  return photographer.done(console);
}

}  // namespace relievo::firmware
