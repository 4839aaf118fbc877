// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/removable_media.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace relievo::hal {

Result<void> RemovableMedia::settle(const std::filesystem::path& folder) {
  const auto failed = [](const std::filesystem::path& at, int number) {
    return Error{Errc::IoFailed, "the stick does not take what is written: use another stick", number}.at(
        at.native());
  };
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code unknown;                 // then opening it says why
    if (entry->is_other(unknown)) continue;  // a pipe that somebody left there would wait for a writer
    const int file = ::open(entry->path().c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) return failed(entry->path(), errno);
    const int number = ::fsync(file) == 0 ? 0 : errno;
    ::posix_fadvise(file, 0, 0, POSIX_FADV_DONTNEED);
    ::close(file);
    if (number != 0) return failed(entry->path(), number);
  }
  if (error) return failed(folder, error.value());
  return {};
}

}  // namespace relievo::hal
