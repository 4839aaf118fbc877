// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/storage/cut_writes.h"

#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

namespace relievo::storage::test {
namespace {

constexpr int kCut = 9;
long g_left = 0;

ssize_t cut_pwrite(int fd, const void* bytes, std::size_t count, off_t at) {
  if (--g_left > 0) return ::pwrite(fd, bytes, count, at);
  (void)!::pwrite(fd, bytes, count / 2, at);
  ::_exit(kCut);
}
ssize_t cut_write(int fd, const void* bytes, std::size_t count) {
  if (--g_left > 0) return ::write(fd, bytes, count);
  (void)!::write(fd, bytes, count / 2);
  ::_exit(kCut);
}
int cut_ftruncate(int fd, off_t size) {
  if (--g_left > 0) return ::ftruncate(fd, size);
  ::_exit(kCut);
}

}  // namespace

Ended cut_at_write(long write, const std::function<bool()>& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    g_left = write;
    auto* vfs = sqlite3_vfs_find(nullptr);
    const auto put = [&](const char* name, auto* call) {
      vfs->xSetSystemCall(vfs, name, reinterpret_cast<sqlite3_syscall_ptr>(call));
    };
    put("write", cut_write);
    put("pwrite", cut_pwrite);
    put("pwrite64", cut_pwrite);
    put("ftruncate", cut_ftruncate);
    ::_exit(work() ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  if (!WIFEXITED(status)) return Ended::Failed;
  return WEXITSTATUS(status) == 0      ? Ended::Finished
         : WEXITSTATUS(status) == kCut ? Ended::Cut
                                       : Ended::Failed;
}

}  // namespace relievo::storage::test
