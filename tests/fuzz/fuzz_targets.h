// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Everything of ours that reads what others wrote, as functions of bytes. A target dies of what it finds: a
// sanitizer's report, an exception that comes out, or a promise that does not hold of what was taken. Used by
// libfuzzer.cc for as long as one likes, and by fuzz_test.cc on what is known. Thread: one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace relievo::test {

using FuzzBytes = std::span<const std::uint8_t>;

struct FuzzTarget {
  std::string name;
  bool (*run)(FuzzBytes input);    // whether it was taken for what it says it is
  std::vector<std::string> seeds;  // inputs that are taken
};

void PrintTo(const FuzzTarget& target, std::ostream* out);  // for GoogleTest

std::vector<FuzzTarget> fuzz_targets();

// What they are made of, one function a file.
std::vector<FuzzTarget> picture_targets();
std::vector<FuzzTarget> calibration_targets();
std::vector<FuzzTarget> text_targets();
std::vector<FuzzTarget> model_targets();
std::vector<FuzzTarget> store_targets();

inline std::string_view text_of(FuzzBytes input) {
  return {reinterpret_cast<const char*>(input.data()), input.size()};
}
inline std::span<const std::byte> bytes_of(FuzzBytes input) { return std::as_bytes(input); }
inline std::string text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}
// The input in a file of this name, alone in a folder; the same file every time.
std::filesystem::path in_file(const std::string& name, FuzzBytes input);
// `good` with some of it changed as the input says: 3 bytes where, 1 how many, these; 0xFF at the end: cut
// off there.
std::string patched(std::string good, FuzzBytes input);

}  // namespace relievo::test
