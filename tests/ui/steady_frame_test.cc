// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Once a page has been drawn, drawing it again takes nothing from the heap.
#include <gtest/gtest.h>

#ifndef RELIEVO_SANITIZED  // sanitizers bring their own heap

#include <atomic>
#include <cstdlib>
#include <new>

#include "tests/support/made_screen.h"

namespace {
std::atomic<long> allocations{0};
}

// Not inlined: g++ would take them for a new and a delete that do not belong together.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  void* memory = std::malloc(size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace relievo::ui {
namespace {

TEST(SteadyFrame, TakesNothingFromTheHeap) {
  const auto made = test::make_screen();
  Ui& ui = *made;
  ViewState view;
  for (const Language language : {Language::English, Language::Arabic}) {
    for (const Step step : {Step::Attract, Step::Consent, Step::Name, Step::Position, Step::Working,
                            Step::Review, Step::Thanks}) {
      Visit visit;
      visit.step = step;
      visit.language = language;
      for (int warm = 0; warm < 2; ++warm) ui.show(view, visit);
      const long before = allocations.load();
      for (int frame = 0; frame < 20; ++frame) ui.show(view, visit);
      EXPECT_EQ(allocations.load(), before) << "step " << static_cast<int>(step);
    }
  }
  const long before = allocations.load();
  EXPECT_NE(std::make_unique<int>(1), nullptr);
  EXPECT_GT(allocations.load(), before) << "the counter counts";
}

}  // namespace
}  // namespace relievo::ui

#endif
