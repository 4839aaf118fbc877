// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A tar whose headers lie, each with a checksum that is right: what a program can write that means harm.
#include "storage/export/bundle.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>

#include "storage/byte_order.h"

namespace relievo::storage {
namespace {

using Bytes = std::vector<std::byte>;

// Places in the header of POSIX ustar.
constexpr std::size_t kSize = 124, kModified = 136, kChecksum = 148, kKind = 156, kLink = 157, kOwner = 265,
                      kBlock = 512;

Bytes good() {
  const auto text = bytes_of("what is in it");
  return *bundle_bytes(std::vector<BundleFile>{{"a.txt", {text.begin(), text.end()}}, {"b.txt", {}}});
}

// The first file's header, changed.
Bytes lying(std::size_t at, std::string_view text) {
  Bytes tar = good();
  std::memcpy(tar.data() + at, text.data(), text.size());
  std::memset(tar.data() + kChecksum, ' ', 8);
  unsigned sum = 0;
  for (std::size_t i = 0; i < kBlock; ++i) sum += std::to_integer<unsigned>(tar[i]);
  char told[8];
  std::snprintf(told, sizeof told, "%06o", sum);
  std::memcpy(tar.data() + kChecksum, told, 7);
  return tar;
}

std::string refused(const Bytes& tar) {
  const auto files = bundle_files(tar);
  EXPECT_FALSE(files);
  if (files) return {};
  EXPECT_EQ(files.error().code, Errc::InvalidInput);
  return std::string(files.error().what.view());
}

TEST(Bundle, WhatWasPutInComesOut) {
  const auto files = bundle_files(good());
  ASSERT_TRUE(files);
  ASSERT_EQ(files->size(), 2U);
  EXPECT_EQ(files->front().name, "a.txt");
  EXPECT_EQ(files->front().bytes.size(), 13U);
  EXPECT_TRUE(bundle_files(lying(kKind, "0"))) << "the checksum is made as tar's";
}

TEST(Bundle, WhatIsNoFileIsRefused) {
  // A hard link, a symbolic one, two devices, a pipe.
  for (const char* kind : {"1/etc/passwd", "2/etc/passwd", "3", "4", "6"})
    EXPECT_NE(refused(lying(kKind, kind)).find("is no file but a link"), std::string::npos) << kind;
}

TEST(Bundle, ASizeThatLiesIsRefusedBeforeAnythingIsMadeForIt) {
  for (const char* size : {"77777777777", "00000100000", "00000004000"})
    EXPECT_NE(refused(lying(kSize, size)).find("is no bundle as it was exported"), std::string::npos) << size;
}

TEST(Bundle, WhatTarWouldTakeAndWasNotExportedIsRefused) {
  EXPECT_NE(refused(lying(kModified, "00000000001")).find("packed by another program"), std::string::npos);
  EXPECT_NE(refused(lying(kOwner, "root")).find("packed by another program"), std::string::npos);
  EXPECT_NE(refused(lying(kLink, "/etc/passwd")).find("packed by another program"), std::string::npos);
  EXPECT_NE(refused(Bytes(good().size() / 2)).find("packed by another program"), std::string::npos);
  // A folder, as tar puts it before what is in it.
  EXPECT_NE(refused(lying(kKind, "5")).find("unpack that and give the folder"), std::string::npos);
}

TEST(Bundle, OnlyAPlainNameIsOne) {
  EXPECT_TRUE(is_plain_name(std::string(100, 'a')));
  for (const std::string& name :
       {std::string(), std::string(101, 'a'), std::string(".hidden"), std::string("a b"), std::string("a/b"),
        std::string("ü.txt"), std::string("a\nb"), std::string("a\0b", 3)})
    EXPECT_FALSE(is_plain_name(name)) << name;
}

}  // namespace
}  // namespace relievo::storage
