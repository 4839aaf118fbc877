// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// FaultyStick: a folder that plays a USB stick on which something goes wrong while a record is being read
// back, in the middle of an export or a recording. A stick that is pulled takes its folder along, as an
// unmounted one does. Thread: any; a fault is chosen before the export begins.
#pragma once

#include <atomic>
#include <filesystem>
#include <fstream>
#include <utility>

#include "hal/sim/replay/replay_device.h"

namespace relievo::test {

class FaultyStick final : public hal::RemovableMedia {
 public:
  enum class Fault : std::uint8_t {
    None,
    Pulled,   // a hand pulls it
    Forgets,  // it gives back other bytes than it took
    Waits,    // nothing goes on until let_go_on()
    Held,     // all is written, but the system still uses it
    // When it was let go and is to be read once more:
    ForgetsLater,  // it gives back other bytes then
    PulledLater,   // a hand was quicker
    NotAgain,      // the system does not mount it
  };
  explicit FaultyStick(std::filesystem::path folder) : folder_(std::move(folder)) { real_.plug(folder_); }

  // At the n-th record that is read back from now on.
  void fail(Fault fault, int at_record = 1) {
    fault_ = fault;
    records_left_ = at_record;
  }
  // At once, by a hand.
  void pull() { strike(Fault::Pulled, {}); }
  void plug_in_again() {
    if (std::filesystem::exists(pulled_folder())) {
      std::filesystem::remove_all(folder_);  // what was written into the empty place
      std::filesystem::rename(pulled_folder(), folder_);
    }
    real_.plug(folder_);
  }
  bool waits() const { return waits_.load(); }
  void let_go_on() {
    waits_.store(false);
    waits_.notify_all();
  }

  std::optional<std::filesystem::path> current() override { return real_.current(); }
  Result<void> settle(const std::filesystem::path& folder) override {
    const std::string hidden =
        folder.filename().string();  // ".CODE.part123": CODE is its name when it is whole
    newest_ = folder.parent_path() / hidden.substr(1, hidden.find('.', 1) - 1);
    if (--records_left_ == 0) strike(fault_, folder);
    return real_.settle(folder);
  }
  Result<void> flush_and_eject() override {
    if (fault_ == Fault::Held)
      return Error{Errc::IoFailed, "something still uses the stick, as the test says", EBUSY};
    return real_.flush_and_eject();
  }
  Result<void> take_up_again() override {
    ++taken_up_;
    if (fault_ == Fault::NotAgain)
      return Error{Errc::Unsupported, "it cannot be mounted again, as the test says", EPERM};
    if (fault_ == Fault::PulledLater) std::filesystem::rename(folder_, pulled_folder());
    if (fault_ == Fault::ForgetsLater) damage(newest_);
    return real_.take_up_again();
  }
  bool is_taken_up() override { return real_.is_taken_up(); }
  int taken_up() const { return taken_up_; }

 private:
  std::filesystem::path pulled_folder() const { return folder_.string() + " in a hand"; }
  void strike(Fault fault, const std::filesystem::path& folder) {
    switch (fault) {
      case Fault::None:
      case Fault::ForgetsLater:
      case Fault::PulledLater:
      case Fault::NotAgain:
      case Fault::Held: return;
      case Fault::Pulled:
        real_.unplug();
        std::filesystem::rename(folder_, pulled_folder());
        return;
      case Fault::Forgets: return damage(folder);
      case Fault::Waits:
        waits_.store(true);
        waits_.notify_all();
        waits_.wait(true);
        return;
    }
  }
  static void damage(const std::filesystem::path& folder) {
    const bool model = std::filesystem::exists(folder / "model.ply");
    const std::filesystem::path damaged = folder / (model ? "model.ply" : "right_000001.png");
    const std::streamoff back =
        model ? 1 : static_cast<std::streamoff>(std::filesystem::file_size(damaged) / 2);
    std::fstream file(damaged, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(-back, std::ios::end);
    const char last = static_cast<char>(file.get());
    file.seekp(-back, std::ios::end);
    file.put(static_cast<char>(last ^ 1));
  }

  std::filesystem::path folder_, newest_;
  int taken_up_ = 0;
  hal::FolderMedia real_;
  Fault fault_ = Fault::None;
  int records_left_ = 0;
  std::atomic<bool> waits_{false};
};

}  // namespace relievo::test
