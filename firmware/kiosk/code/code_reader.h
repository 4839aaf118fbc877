// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// CodeReader: the text of a QR code in a picture, Grey8 or Rgb8. The picture is as the camera
// has it, not mirrored. Thread: one at a time. Errors: none: what cannot be read is not there.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "hal/base/image_view.h"

namespace relievo::firmware {

class CodeReader {
 public:
  static std::unique_ptr<CodeReader> make();
  virtual ~CodeReader() = default;
  virtual std::optional<std::string> read(const ImageView& picture) = 0;
};

}  // namespace relievo::firmware
