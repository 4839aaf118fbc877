// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Visits in which an allocation fails, the kiosk's or a library's, on whichever thread, once and for good
// (until the visitor is back). Each must end in one of these, and the next visit must work:
//
//   went on    it was stored all the same
//   apology    back at the invitation, told so, nothing stored
//   restart    the program aborted: a library that does so by design; it starts anew, nothing half stored
//
//   failing_visits POINTS [FIRST]   of POINTS allocations, evenly over a visit; 0: every one, from FIRST on
//
// A child does the visits; this process starts it anew when it aborts, as what supervises the kiosk would.
#include <execinfo.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "storage/sqlite/sqlite_store.h"
#include "tests/memory/failing_malloc.h"
#include "tests/memory/visitor.h"
#include "tests/support/temporary_folder.h"

namespace relievo::test {
namespace {

constexpr long kForGood = 1L << 40;

void say(const std::string& line) {
  const std::string text = line + "\n";
  (void)!write(STDOUT_FILENO, text.data(), text.size());
}

void died(int number) {
  signal(number, SIG_DFL);
  const char* thread = refused_thread();
  (void)!write(STDOUT_FILENO, "stack ", 6);
  (void)!write(STDOUT_FILENO, thread, strlen(thread));
  (void)!write(STDOUT_FILENO, "\n", 1);
  print_refused_stack(STDOUT_FILENO);
  // Where it ends is another place than where it began.
  const Exempt own;
  static std::array<void*, 64> frames;
  (void)!write(STDOUT_FILENO, "end\n", 4);
  backtrace_symbols_fd(frames.data(), backtrace(frames.data(), static_cast<int>(frames.size())),
                       STDOUT_FILENO);
  raise(number);
}

// The visits of the points that are asked for; prints a line each.
int child(const char* folder, const std::vector<long>& points, bool for_good) {
  const Exempt own;
  auto visitor = Visitor::at(folder);
  if (!visitor) return say("cannot open: " + std::string(visitor.error().what.view())), 1;
  say("invites " + std::to_string((*visitor)->until_invited().count()));
  // Without memory GLib's last words ask for memory, whose refusal it says, until the stack is used up.
  static std::array<char, 1 << 16> other_stack;
  const stack_t there{other_stack.data(), 0, other_stack.size()};
  sigaltstack(&there, nullptr);
  struct sigaction dies {};
  dies.sa_handler = died;
  dies.sa_flags = SA_ONSTACK;
  for (const int number : {SIGABRT, SIGTRAP, SIGSEGV, SIGBUS}) sigaction(number, &dies, nullptr);
  // The first makes the simulated person, too: the second is one as the others, and is counted.
  for (int visit = 0; visit < (points.empty() ? 2 : 1); ++visit) {
    refuse_allocation(0, 0);
    const VisitEnd first = (*visitor)->visit();
    say("first " + std::to_string(visit * allocations_counted()) + (first.stored ? " stored" : " failed"));
  }
  for (const long point : points) {
    say("at " + std::to_string(point));
    refuse_allocation(point, for_good ? kForGood : 1);
    const VisitEnd end = (*visitor)->visit();
    const bool was = was_refused();
    refuse_allocation(0, 0);
    if (end.stuck) {
      say(std::string("stuck in ") + std::string(firmware::name_of((*visitor)->kiosk().appliance().state())));
      print_refused_stack(STDOUT_FILENO);
      return 3;
    }
    say(std::string(!was             ? "beyond"
                    : end.stored     ? "stored"
                    : end.apologised ? "apology"
                                     : "silent") +
        " " + std::to_string(end.told.count()) + " " + refused_thread());
    if (was && !end.stored && !end.apologised) print_refused_stack(STDOUT_FILENO);
  }
  // On a busy machine a visitor may be asked to come again: that is no want of memory.
  VisitEnd last = (*visitor)->visit();
  for (int again = 0; again < 2 && !last.stored; ++again) last = (*visitor)->visit();
  say(last.stored ? "last stored" : "last not stored");
  return last.stored ? 0 : 4;
}

struct Sum {
  long total = 0, stored = 0, restarts = 0;
  std::map<std::string, long> ends, aborts;
  long worst_told_ms = 0, worst_restart_ms = 0;
  int wrong = 0;
  void bad(const std::string& what) {
    ++wrong;
    std::printf("WRONG: %s\n", what.c_str());
  }
};

// Who ended the program, by the stack it ended on: GLib (with Pango) wherever it gets no memory, in its last
// words or with the stack used up by them; the kiosk (Kiosk::guarded) when it could do nothing for too long.
// Empty: neither, which is a crash.
std::string who_ended(int number, const std::string& stack) {
  const std::size_t end = stack.find("\n  end\n");
  const auto has = [&](const char* library) { return stack.find(library, end) != std::string::npos; };
  if (end == std::string::npos) return "";
  if (has("libglib")) return "GLib";
  return number == SIGABRT && has("libstdc++") ? "the kiosk" : "";
}

// Runs one child; returns how many of the points it has dealt with.
std::size_t run(const std::string& folder, const std::vector<long>& points, bool for_good, Sum& sum) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) std::abort();
  const pid_t pid = fork();
  if (pid == 0) {
    dup2(ends[1], STDOUT_FILENO);
    std::vector<std::string> words{"failing_visits", "child", folder, for_good ? "good" : "once"};
    for (const long point : points) words.push_back(std::to_string(point));
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    execv("/proc/self/exe", argv.data());
    _exit(127);
  }
  close(ends[1]);
  FILE* said = fdopen(ends[0], "r");
  char line[1024];
  std::size_t done = 0;
  std::string at, stack, thread;
  while (fgets(line, sizeof line, said) != nullptr) {
    line[strcspn(line, "\n")] = 0;
    long number = 0;
    char word[32] = "", who[32] = "";
    if (sscanf(line, "at %ld", &number) == 1) {
      at = std::to_string(number) + (for_good ? " for good" : " once");
    } else if (sscanf(line, "invites %ld", &number) == 1) {
      sum.worst_restart_ms = std::max(sum.worst_restart_ms, number);
    } else if (sscanf(line, "first %ld %31s", &number, word) == 2) {
      sum.total = std::max(sum.total, number);
      sum.stored += strcmp(word, "stored") == 0 ? 1 : 0;
    } else if (strncmp(line, "last", 4) == 0) {
      if (strcmp(line, "last stored") == 0) ++sum.stored;
      else sum.bad("the last visit was not stored");
    } else if (sscanf(line, "stack %31s", who) == 1) {
      thread = who;
    } else if (strncmp(line, "stuck", 5) == 0) {
      sum.bad(at + ": " + line);
    } else if (sscanf(line, "%31s %ld %31s", word, &number, who) == 3 &&
               (!strcmp(word, "stored") || !strcmp(word, "apology") || !strcmp(word, "silent") ||
                !strcmp(word, "beyond"))) {
      ++done;
      ++sum.ends[std::string(word) + ", " + who];
      if (!strcmp(word, "stored") || !strcmp(word, "beyond")) ++sum.stored;
      if (!strcmp(word, "apology")) sum.worst_told_ms = std::max(sum.worst_told_ms, number);
      if (!strcmp(word, "silent")) sum.bad(at + ": ended and nobody was told, " + who);
    } else {
      stack += std::string("  ") + line + "\n";
    }
  }
  fclose(said);
  int status = 0;
  waitpid(pid, &status, 0);
  if (WIFSIGNALED(status)) {
    const int number = WTERMSIG(status);
    const std::string who = who_ended(number, stack);
    ++sum.restarts;
    ++sum.ends["restart by " + (who.empty() ? "?" : who) + ", " + (thread.empty() ? "?" : thread)];
    std::printf("%s: signal %d on %s\n%s", at.c_str(), number, thread.c_str(), stack.c_str());
    if (who.empty()) sum.bad(at + ": a crash");
    ++done;
  } else if (WEXITSTATUS(status) != 0) {
    sum.bad("a child ended with " + std::to_string(WEXITSTATUS(status)));
    std::printf("%s", stack.c_str());
    ++done;
  }
  return done;
}

void check_store(const std::string& folder, Sum& sum) {
  const hal::MonotonicClock clock;
  auto store = storage::open_sqlite_store(folder, clock, {});
  if (!store || !(*store)->check()) return sum.bad("the store is not in order");
  const auto subjects = (*store)->subjects({});
  // Who accepted is stored before being thanked: a restart may come between the two.
  const long there = static_cast<long>(subjects->size());
  std::printf("%ld records; %ld thanked for, %ld stored before a restart\n", there, sum.stored,
              there - sum.stored);
  if (there < sum.stored || there > sum.stored + sum.restarts) sum.bad("records were lost, or are nobody's");
  for (const storage::Subject& subject : *subjects) {
    const auto enrolments = (*store)->enrolments(subject.id);
    std::pmr::monotonic_buffer_resource memory;
    if (enrolments->size() != 1 || !(*store)->load_model(enrolments->front().id, &memory))
      sum.bad("half an enrolment");
  }
}

int supervise(long points, long begin) {
  const TemporaryFolder folder;
  Sum sum;
  run(folder.path() / "store", {}, false, sum);
  const long total = sum.total;
  if (total == 0) return std::puts("no visit could be counted"), 1;
  std::printf("a visit makes about %ld allocations\n", total);
  for (const bool for_good : {false, true}) {
    std::vector<long> left;
    const long step = points == 0 ? 1 : std::max(1L, total / points);
    for (long at = begin + (for_good ? step / 2 : 0); at <= total; at += step) left.push_back(at);
    while (!left.empty() && sum.wrong < 20) {
      const std::size_t most = std::min<std::size_t>(left.size(), 200);
      const std::vector<long> now(left.begin(), left.begin() + static_cast<long>(most));
      const std::size_t done = std::max<std::size_t>(1, run(folder.path() / "store", now, for_good, sum));
      left.erase(left.begin(), left.begin() + static_cast<long>(std::min(done, left.size())));
      std::fflush(stdout);
    }
  }
  check_store(folder.path() / "store", sum);
  for (const auto& [end, count] : sum.ends) std::printf("%6ld %s\n", count, end.c_str());
  std::printf("told at the latest after %ld ms, a start to the invitation %ld ms at most; %d wrong\n",
              sum.worst_told_ms, sum.worst_restart_ms, sum.wrong);
  return sum.wrong == 0 ? 0 : 1;
}

}  // namespace
}  // namespace relievo::test

int main(int argc, char** argv) {
  using namespace relievo::test;
  if (argc > 3 && !strcmp(argv[1], "child")) {
    std::vector<long> points;
    for (int i = 4; i < argc; ++i) points.push_back(std::atol(argv[i]));
    return child(argv[2], points, !strcmp(argv[3], "good"));
  }
  if (argc < 2) return std::puts("failing_visits POINTS [FIRST]"), 2;
  return supervise(std::atol(argv[1]), argc > 2 ? std::atol(argv[2]) : 1);
}
