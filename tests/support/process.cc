// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/process.h"

#include <csignal>
#include <stdexcept>

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

namespace relievo::test {
namespace {

struct Child {
  pid_t pid = -1;
  int out = -1;
  int err = -1;
};

Child start(const std::vector<std::string>& words, const std::filesystem::path& folder) {
  int out[2];
  int err[2];
  if (::pipe(out) != 0 || ::pipe(err) != 0) throw std::runtime_error("no pipe");
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  const pid_t pid = ::fork();
  if (pid < 0) throw std::runtime_error("no process");
  if (pid == 0) {
    const int nothing = ::open("/dev/null", O_RDONLY);
    ::dup2(nothing, 0);
    ::dup2(out[1], 1);
    ::dup2(err[1], 2);
    for (const int fd : {out[0], out[1], err[0], err[1]}) ::close(fd);
    if (::chdir(folder.c_str()) == 0) ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  ::close(out[1]);
  ::close(err[1]);
  return {pid, out[0], err[0]};
}

// False at the end of the stream.
bool read_some(int fd, std::string& text) {
  char buffer[4096];
  const ssize_t n = ::read(fd, buffer, sizeof buffer);
  if (n > 0) text.append(buffer, static_cast<std::size_t>(n));
  return n > 0;
}

Said listen(const Child& child, int signal, const std::string& until) {
  Said said;
  bool sent = signal == 0;
  pollfd fds[2] = {{child.out, POLLIN, 0}, {child.err, POLLIN, 0}};
  while (fds[0].fd >= 0 || fds[1].fd >= 0) {
    if (!sent && (until.empty() || (said.out + said.err).find(until) != std::string::npos)) {
      ::kill(child.pid, signal);
      sent = true;
    }
    if (::poll(fds, 2, -1) < 0) continue;
    if (fds[0].revents != 0 && !read_some(child.out, said.out)) fds[0].fd = -1;
    if (fds[1].revents != 0 && !read_some(child.err, said.err)) fds[1].fd = -1;
  }
  int status = 0;
  ::waitpid(child.pid, &status, 0);
  said.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  ::close(child.out);
  ::close(child.err);
  return said;
}

}  // namespace

Said run_program(const std::vector<std::string>& words, const std::filesystem::path& folder) {
  return listen(start(words, folder), 0, "");
}

Said run_program_and_signal(const std::vector<std::string>& words, const std::filesystem::path& folder,
                            int signal, const std::string& until) {
  return listen(start(words, folder), signal, until);
}

}  // namespace relievo::test
