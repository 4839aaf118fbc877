// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// RemovableMedia: the USB stick, as far as an export cares.
#pragma once
#include <filesystem>
#include <optional>
#include "hal/base/result.h"
namespace relievo::hal {

class RemovableMedia {
 public:
  virtual ~RemovableMedia() = default;
  virtual std::optional<std::filesystem::path> current() = 0;  // its root; cheap; asked on every tick
  // Every file of this folder on the stick is on the medium; who reads one next reads what the stick kept,
  // not what memory still has. IoFailed: it cannot be written through.
  virtual Result<void> settle(const std::filesystem::path& folder);
  virtual Result<void> flush_and_eject() = 0;  // safe to pull out afterwards
  // What was ejected last is there once more, to be read only: who reads a file now reads what the stick has
  // kept, whatever the system remembered of it. Eject it again. MediaMissing: it is not there any more, or
  // none was ejected; Unsupported: the system does not give it back, or this device cannot.
  virtual Result<void> take_up_again() {
    return Error{Errc::Unsupported, "this board cannot take up a stick again"};
  }
  // Whether what current() has found is what was taken up again: nobody has plugged it.
  virtual bool is_taken_up() { return false; }
};
}  // namespace relievo::hal
