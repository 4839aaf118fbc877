// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// By libgpiod 1.6, that of Debian 12; version 2 has other names for everything.
#include "hal/linux/wire/gpio_trigger_line.h"

#include <fcntl.h>
#include <gpiod.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <vector>

#include "hal/base/words.h"

namespace relievo::hal {

Result<LastWill> LastWill::make(const std::function<void()>& will) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    return Error{Errc::IoFailed, "no pipe to notice the end of this process", errno};
  const pid_t child = ::fork();
  if (child < 0) {
    ::close(ends[0]);
    ::close(ends[1]);
    return Error{Errc::IoFailed, "no process to notice the end of this one", errno};
  }
  if (child == 0) {
    ::close(ends[1]);
    // What stops the parent from the keyboard or by its service must not stop this one first.
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) (void)::signal(signal, SIG_IGN);
    char byte = 0;
    while (::read(ends[0], &byte, 1) < 0 && errno == EINTR) {
    }
    will();
    ::_exit(0);
  }
  ::close(ends[0]);
  return LastWill(child, ends[1]);
}

LastWill::~LastWill() {
  if (child_ <= 0) return;
  ::close(alive_);
  ::waitpid(child_, nullptr, 0);
}

namespace {

constexpr const char* kConsumer = "relievo";

Error chip_error(int number) {
  constexpr Meaning kRows[] = {
      {{ENOENT, ENXIO, ENODEV}, Errc::NotFound, "there is no such GPIO chip: see gpiodetect"},
      {{ENOTTY}, Errc::NotFound, "there is no such GPIO chip: see gpiodetect"},
      {{EACCES, EPERM}, Errc::IoFailed, "this GPIO chip may not be opened: add the user to the group gpio"},
      {{}, Errc::IoFailed, "this GPIO chip cannot be opened"}};
  return meaning_of(number, kRows);
}

Error line_error(int number) {
  constexpr Meaning kRows[] = {
      {{EINVAL, ENOENT}, Errc::NotFound, "this GPIO chip has no such line, or it is no output: see gpioinfo"},
      {{EBUSY}, Errc::IoFailed, "another program drives this GPIO line: close it"},
      {{}, Errc::IoFailed, "this GPIO line cannot be driven"}};
  return meaning_of(number, kRows);
}

// The lines of one chip, requested one by one.
class Lines {
 public:
  static Result<Lines> request(const GpioOptions& options) {
    Lines lines;
    lines.chip_.reset(gpiod_chip_open(options.chip.c_str()));
    if (lines.chip_ == nullptr) return chip_error(errno);
    std::vector<unsigned> offsets{options.trigger};
    if (options.lamp) offsets.push_back(*options.lamp);
    for (const unsigned offset : offsets) {
      gpiod_line* const line = gpiod_chip_get_line(lines.chip_.get(), offset);
      if (line == nullptr) return line_error(errno);
      const int flags = options.active_low ? GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW : 0;
      if (gpiod_line_request_output_flags(line, kConsumer, flags, 0) != 0) return line_error(errno);
      lines.lines_.push_back(line);
    }
    return lines;
  }
  std::size_t count() const { return lines_.size(); }
  bool set(std::size_t line, bool active) { return gpiod_line_set_value(lines_[line], active ? 1 : 0) == 0; }

 private:
  // Closed, it releases its lines.
  std::unique_ptr<gpiod_chip, void (*)(gpiod_chip*)> chip_{nullptr, gpiod_chip_close};
  std::vector<gpiod_line*> lines_;
};

void set_all_inactive(Lines& lines) {
  for (std::size_t i = 0; i < lines.count(); ++i) (void)lines.set(i, false);
}

class GpiodOutputLines final : public OutputLines {
 public:
  GpiodOutputLines(Lines lines, LastWill will) : lines_(std::move(lines)), will_(std::move(will)) {}
  ~GpiodOutputLines() override { set_all_inactive(lines_); }

  Result<void> set(Wire wire, bool active) override {
    const std::size_t line = wire == Wire::Trigger ? 0 : 1;
    if (line >= lines_.count()) return {};  // no lamp
    if (lines_.set(line, active)) return {};
    if (errno == ENODEV) return Error{Errc::Disconnected, "the GPIO chip is gone: check its plug", errno};
    return Error{Errc::IoFailed, "the GPIO line does not answer", errno};
  }

 private:
  Lines lines_;
  LastWill will_;
};

}  // namespace

Result<std::unique_ptr<OutputLines>> request_gpiod_lines(const GpioOptions& options) {
  RELIEVO_TRY_ASSIGN(Lines lines, Lines::request(options).at(options.chip));
  // The child shares the requested lines, so that the kernel does not give them free before it has set them.
  RELIEVO_TRY_ASSIGN(LastWill will, LastWill::make([&lines] { set_all_inactive(lines); }));
  return std::unique_ptr<OutputLines>(std::make_unique<GpiodOutputLines>(std::move(lines), std::move(will)));
}

}  // namespace relievo::hal
