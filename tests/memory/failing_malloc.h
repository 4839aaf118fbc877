// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The C library's malloc and its kin for a test program, its libraries' too: counted, and refused as the test
// says. Not under a sanitizer, which has its own. Thread: any; a thread that is not counted is never refused.
#pragma once

namespace relievo::test {

// While one lives, this thread's allocations are neither counted nor refused: the test's own.
class Exempt {
 public:
  Exempt();
  ~Exempt();
  Exempt(const Exempt&) = delete;
  Exempt& operator=(const Exempt&) = delete;
};
// And while one lives inside an Exempt, they are again.
class Counted {
 public:
  Counted();
  ~Counted();
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

 private:
  int before_;
};

// Counts from one anew. The allocation of that number is refused, or from it on `refusals` on end; 0: none.
void refuse_allocation(long number, long refusals);
long allocations_counted();
// Has one been refused since? By which thread (its name), from where.
bool was_refused();
const char* refused_thread();
void print_refused_stack(int file);

}  // namespace relievo::test
