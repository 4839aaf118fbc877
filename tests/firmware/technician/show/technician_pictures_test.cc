// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/technician/show/technician_pictures.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>

namespace relievo::firmware {
namespace {

// A stage that is drawn on the right and not named where the room is given out.
TEST(TechnicianPictures, WhereThereIsNoRoomNothingIsDrawn) {
  const std::array<std::byte, 4> grey{};
  Products products;
  products.frame.emplace();
  products.frame->left = products.frame->right = {grey.data(), 2, 2, 2, PixelFormat::Grey8};
  TechnicianPictures both;
  both.draw(products, {});
  EXPECT_FALSE(both.picture(ui::TechnicianStage::Input, 1).pixels.empty());
  TechnicianPictures left(false);
  EXPECT_DEATH(left.draw(products, {}), "relievo: bug");
}

}  // namespace
}  // namespace relievo::firmware
