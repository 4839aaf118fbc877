// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/session/session.h"

#include <string.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <utility>

#include "hal/base/assert.h"

namespace relievo::firmware {
namespace {

constexpr std::size_t kCopyShare = 10;
static_assert(budget::kLargestPlan.sides / kCopyShare >= 2 * budget::kFrameBytes,
              "no room for a pair of the largest sensor");
static_assert(budget::kHeadPoses == SidePairs::kPoses, "the plan is for another number of sides");

// Cut into so many alike.
template <typename Room, std::size_t... I>
std::array<Room, sizeof...(I)> rooms(std::span<std::byte> block, std::index_sequence<I...>) {
  const std::size_t each = block.size() / sizeof...(I);
  return {Room(block.subspan(I * each, each))...};
}

std::size_t row_bytes(const ImageView& view) {
  return std::size_t(view.width_px * bytes_per_pixel(view.format));
}

}  // namespace

std::size_t packed_bytes(const ImageView& view) { return row_bytes(view) * std::size_t(view.height_px); }

ImageView packed(const ImageView& view, std::byte* to) {
  const std::size_t row = row_bytes(view);
  for (int y = 0; y < view.height_px; ++y) std::memcpy(to + std::size_t(y) * row, view.row(y), row);
  return {to, view.width_px, view.height_px, int(row), view.format};
}

SidePairs::SidePairs(std::span<std::byte> block)
    : copy_(block.first(block.size() / kCopyShare)),
      rooms_(rooms<std::span<std::byte>>(block.subspan(copy_.size()), std::make_index_sequence<kPoses>())),
      kept_(rooms<Arena>(block.subspan(copy_.size()), std::make_index_sequence<kPoses>())) {}

void SidePairs::begin() {
  const std::lock_guard lock(mutex_);
  added_ = handed_out_ = 0;
  ended_ = false;
}

Result<void> SidePairs::add(const pipeline::StereoFrame& pair) {
  const std::size_t left = packed_bytes(pair.left), both = left + packed_bytes(pair.right);
  const std::size_t at = count();  // nobody else touches the room of a pair that was not added yet
  if (at == pipeline::kSides) return Error{Errc::InvalidState, "every side has its pair already"};
  std::span<std::byte> room = rooms_[at + 1];
  if (both > std::min(room.size(), copy_.size()))
    return Error{Errc::OutOfMemory,
                 "the sides' pictures are larger than those that memory was taken for at the start"};
  pairs_[at] = pair;
  pairs_[at].left = packed(pair.left, room.data());
  pairs_[at].right = packed(pair.right, room.data() + left);
  const std::lock_guard lock(mutex_);
  ++added_;
  changed_.notify_one();
  return {};
}

void SidePairs::end() {
  const std::lock_guard lock(mutex_);
  ended_ = true;
  changed_.notify_one();
}

std::size_t SidePairs::count() const {
  const std::lock_guard lock(mutex_);
  return added_;
}

std::optional<pipeline::StereoFrame> SidePairs::next(const std::atomic<bool>& cancelled) {
  std::unique_lock lock(mutex_);
  while (handed_out_ == added_ && !ended_ && !cancelled.load(std::memory_order_relaxed))
    changed_.wait_for(lock, budget::kTick);
  if (cancelled.load(std::memory_order_relaxed) || handed_out_ == added_) return std::nullopt;
  const std::size_t at = handed_out_++;
  lock.unlock();
  pipeline::StereoFrame pair = pairs_[at];
  pair.left = packed(pair.left, copy_.data());
  pair.right = packed(pair.right, copy_.data() + packed_bytes(pair.left));
  return pair;
}

void SidePairs::wipe() {
  std::size_t most = 0;
  for (std::size_t i = 0; i < pipeline::kSides; ++i) {
    const std::size_t bytes = packed_bytes(pairs_[i].left) + packed_bytes(pairs_[i].right);
    explicit_bzero(rooms_[i + 1].data(), bytes);
    most = std::max(most, bytes);
    pairs_[i] = {};
  }
  explicit_bzero(copy_.data(), most);
  for (Arena& kept : kept_) kept.wipe();
  begin();
}

Result<void> EnrolmentSession::open(std::string_view subject) {
  if (is_open()) return Error{Errc::InvalidState, "a session is open already: close it first"};
  if (subject.size() > budget::kSubjectNameBytes) {
    return invalid("the name is longer than 200 bytes: choose a shorter one");
  }
  RELIEVO_ASSERT(output_.used() == 0 && scratch_touched_ == 0);
  subject.copy(subject_.data(), subject.size());
  make_products();
  open_ = true;
  return {};
}

void EnrolmentSession::make_products() {
  products_ =
      std::construct_at(static_cast<Products*>(output_.allocate(sizeof(Products), alignof(Products))));
}

Products& EnrolmentSession::products() const {
  RELIEVO_ASSERT(is_open());
  return *products_;
}

void EnrolmentSession::retake(bool keep_mirror) {
  RELIEVO_ASSERT(is_open());
  if (keep_mirror) {
    wipe_taken();
    live_.forget_guidance();
  } else {
    wipe();
  }
  make_products();
}

void EnrolmentSession::took(const pipeline::StereoFrame& frame) {
  products().frame = frame;
  holds_ = spare_slot_.holds(frame.left) ? &spare_slot_ : &slot_;
}

void EnrolmentSession::rework(State from) {
  Products& made = products();
  if (from <= State::Match) {  // the pictures alone stay
    const auto frame = made.frame;
    wipe_products();
    make_products();
    products_->frame = frame;
    return;
  }
  if (from > State::Mesh && made.model) {  // they were taken over unchanged
    made.mesh = std::move(made.model->mesh);
    made.texture = std::move(made.model->texture);
  }
  made.model.reset();
  made.registration.reset();
  if (from <= State::Texture) made.texture.reset();
  if (from <= State::Mesh) made.mesh.reset();
  if (from <= State::Reconstruct) made.cloud.reset();
  output_.wipe(stage_begins_.at(number_of(from)));
}

void EnrolmentSession::close() {
  if (!is_open()) return;
  wipe();
  open_ = false;
  explicit_bzero(subject_.data(), subject_.size());
}

void EnrolmentSession::wipe() {
  wipe_taken();
  live_.wipe();
}

void EnrolmentSession::wipe_taken() {
  wipe_products();
  holds_ = nullptr;
  slot_.wipe();
  spare_slot_.wipe();
  sides_.wipe();
}

void EnrolmentSession::wipe_products() {
  std::destroy_at(products_);
  products_ = nullptr;
  stage_pictures_.wipe();
  output_.wipe();
  explicit_bzero(scratch_block_.data(), scratch_touched_);
  scratch_touched_ = 0;
}

namespace {

constexpr std::size_t kRoom = std::size_t{budget::kLiveSidePx} * budget::kLiveSidePx * 3;

// Means over step x step pixels.
void shrink(const ImageView& from, int step, int width, int height, std::uint8_t* to) {
  const int bytes = bytes_per_pixel(from.format);
  const unsigned count = unsigned(step) * unsigned(step);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x, to += 3) {
      unsigned sum[3] = {0, 0, 0};
      for (int v = 0; v < step; ++v) {
        const std::uint8_t* at = from.row(y * step + v) + std::ptrdiff_t(x) * step * bytes;
        for (int u = 0; u < step; ++u, at += bytes) {
          // Of 16 bits the upper ones: the second byte.
          for (int c = 0; c < 3; ++c)
            sum[c] +=
                from.format == PixelFormat::Rgb8 ? at[c] : at[from.format == PixelFormat::Grey16 ? 1 : 0];
        }
      }
      for (int c = 0; c < 3; ++c) to[c] = std::uint8_t(sum[c] / count);
    }
  }
}

}  // namespace

LiveFeed::LiveFeed(int side_px) : side_px_(side_px) {
  for (Slot& slot : slots_) slot.rgb.resize(kRoom);
}

ImageView LiveFeed::fill(const ImageView& picture) {
  Slot& slot = slots_[filling_];
  const int longer = std::max(picture.width_px, picture.height_px);
  const int step = (longer + side_px_ - 1) / side_px_;
  const int width = picture.width_px / step, height = picture.height_px / step;
  const auto bytes = std::size_t(width) * std::size_t(height) * 3;
  if (slot.rgb.size() < bytes) slot.rgb.resize(bytes);
  shrink(picture, step, width, height, slot.rgb.data());
  slot.live.picture = {reinterpret_cast<const std::byte*>(slot.rgb.data()), width, height, 3 * width,
                       PixelFormat::Rgb8};
  return slot.live.picture;
}

void LiveFeed::publish(ui::LiveView guidance) {
  ui::LiveView& live = slots_[filling_].live;
  guidance.picture = live.picture;
  guidance.number = ++count_;
  live = guidance;
  const std::lock_guard lock(mutex_);
  std::swap(filling_, newest_);
  fresh_ = true;
}

ui::LiveView LiveFeed::newest() {
  const std::lock_guard lock(mutex_);
  if (std::exchange(fresh_, false)) std::swap(shown_, newest_);
  return slots_[shown_].live;
}

void LiveFeed::wipe() {
  const std::lock_guard lock(mutex_);
  for (Slot& slot : slots_) {
    if (slot.live.picture.empty()) continue;
    explicit_bzero(slot.rgb.data(), slot.rgb.size());
    slot.live = {};
  }
  fresh_ = false;
}

void LiveFeed::forget_guidance() {
  const std::lock_guard lock(mutex_);
  for (Slot& slot : slots_) {
    ui::LiveView bare;
    bare.picture = slot.live.picture;
    bare.number = slot.live.number;
    bare.ideal_width = slot.live.ideal_width;  // the oval stays as large
    slot.live = bare;
  }
}

}  // namespace relievo::firmware
