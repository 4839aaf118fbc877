// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Prints the table of faults and compares it with firmware/FAULTS.md. RELIEVO_RENEW_GOLDENS=1 writes it
// there.
#include "tests/firmware/faults/fault_table.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace relievo::firmware {
namespace {

constexpr std::array<const char*, kFaults> kWords{
    "nothing",
    "a camera is pulled",
    "a camera's pictures do not come",
    "both cameras see nothing",
    "the cameras' plugs change places",
    "the trigger's pulse arrives nowhere",
    "the trigger cannot be driven",
    "a stage works on past its limit",
    "the store is full",
    "the store is damaged",
    "the store is locked by another program",
    "the stick is pulled",
    "the date jumps 40 days ahead",
    "the date jumps 40 days back",
    "the GL context is lost",
    "the machine is too hot",
    "SIGTERM",
    "SIGHUP",
    "the main thread hangs",
    "the thread of the cameras hangs",
    "the worker hangs",
    "the keeper hangs",
};

std::string words_of(Fate fate) {
  if (fate == kEnds) return "the end, exit code 0";
  if (fate == kRestarts) return "a restart";
  return std::string(name_of(fate.state));
}

// Of each fate, in the order of the states, those that lead to it.
std::string row_of(Fault fault) {
  std::vector<Fate> fates;
  std::vector<std::string> from;
  bool everywhere = true;
  for (std::size_t s = 0; s < kStates; ++s) {
    const auto state = static_cast<State>(s);
    const Fate fate = fate_of(state, fault);
    everywhere = everywhere && fate == fate_of(State::Idle, fault);
    if (fault != Fault::None && fate == fate_of(state, Fault::None)) continue;
    std::size_t i = 0;
    while (i < fates.size() && !(fates[i] == fate)) ++i;
    if (i == fates.size()) {
      fates.push_back(fate);
      from.emplace_back();
    }
    from[i] += (from[i].empty() ? "" : " ") + std::string(name_of(state));
  }
  std::string row = "| " + std::string(kWords[static_cast<std::size_t>(fault)]) + " | ";
  if (fates.empty()) return row + "as nothing |\n";
  if (everywhere) return row + "**" + words_of(fates[0]) + "** from everywhere |\n";
  for (std::size_t i = 0; i < fates.size(); ++i)
    row += (i == 0 ? "**" : "; **") + words_of(fates[i]) + "** from " + from[i];
  return row + " |\n";
}

std::string table() {
  std::string text = "| what happens | leads to |\n| --- | --- |\n";
  for (std::size_t f = 0; f < kFaults; ++f) text += row_of(static_cast<Fault>(f));
  return text;
}

TEST(FaultTable, StandsInItsPageAsItIs) {
  const std::filesystem::path file = std::filesystem::path(RELIEVO_SOURCE_DIR) / "firmware/FAULTS.md";
  std::ifstream in(file);
  std::string page(std::istreambuf_iterator<char>(in), {});
  const std::string head = "| what happens |";
  const std::size_t begin = page.find(head), end = page.find("\n\n", begin);
  ASSERT_NE(begin, std::string::npos);
  ASSERT_NE(end, std::string::npos);
  if (const char* renew = std::getenv("RELIEVO_RENEW_GOLDENS"); renew != nullptr) {
    page.replace(begin, end + 1 - begin, table());
    std::ofstream(file) << page;
    return;
  }
  EXPECT_EQ(page.substr(begin, end + 1 - begin), table()) << "RELIEVO_RENEW_GOLDENS=1 writes it anew";
}

}  // namespace
}  // namespace relievo::firmware
