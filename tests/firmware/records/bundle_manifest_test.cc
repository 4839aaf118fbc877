// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Copies that a store has signed and that lie all the same, and folders that are none.
#include "firmware/records/bundle_manifest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>

#include "storage/byte_order.h"
#include "storage/sqlite/sqlite_store.h"
#include "tests/storage/sample.h"
#include "tests/support/temporary_folder.h"

namespace relievo::firmware {
namespace {

using storage::BundleFile;
using storage::bytes_of;

BundleFile file(const char* name, std::string_view text) {
  const auto bytes = bytes_of(text);
  return {name, {bytes.begin(), bytes.end()}};
}

class BundleManifest : public ::testing::Test {
 protected:
  // The report, whose sum this is, and a manifest that says `sums`, signed.
  std::vector<BundleFile> copy(const std::string& sums) const {
    const BundleFile manifest = file("manifest.json", "{\"sha256\": " + sums + "}");
    return {file("report.json", "a file"), manifest, signature(*store->sign(manifest.bytes))};
  }
  static BundleFile signature(const storage::Signed& made, const std::string& more = "") {
    SigningKey halves[2];
    std::ranges::copy_n(made.signature.begin(), 32, halves[0].begin());
    std::ranges::copy_n(made.signature.begin() + 32, 32, halves[1].begin());
    return file("signature.json", "{\n \"of\": \"manifest.json\",\n \"by\": \"" + text_of(made.by) +
                                      "\",\n \"ed25519\": \"" + text_of(halves[0]) + text_of(halves[1]) +
                                      "\"" + more + "\n}\n");
  }
  static std::string refused(const std::vector<BundleFile>& files) {
    const auto key = check_bundle(files);
    EXPECT_FALSE(key);
    return key ? "" : std::string(key.error().where()) + ": " + std::string(key.error().what.view());
  }
  static std::string sum_of(std::string_view text) { return text_of(storage::sha256(bytes_of(text))); }

  test::TemporaryFolder folder;
  std::unique_ptr<storage::Store> store = storage::test::opened(folder / "store", {.reserve_bytes = 0});
  const std::string right = "{\"report.json\": \"" + sum_of("a file") + "\"}";
};

TEST_F(BundleManifest, TellsWhoSignedIt) {
  const auto key = check_bundle(copy(right));
  ASSERT_TRUE(key) << key.error().where() << key.error().what.view();
  EXPECT_EQ(*key, store->sign({})->by);
}

TEST_F(BundleManifest, OneThatNamesNoFilesIsRefused) {
  for (const char* sums : {"[]", "null", "7", "\"report.json\"", "nothing that can be read"})
    EXPECT_EQ(refused(copy(sums)).find("manifest.json: names no files"), 0U) << sums;
}

TEST_F(BundleManifest, OneThatSaysSomethingElseOfAFileIsRefused) {
  std::string capitals = sum_of("a file");
  std::ranges::transform(capitals, capitals.begin(), [](unsigned char c) { return char(std::toupper(c)); });
  for (const std::string& sum :
       {std::string("7"), std::string("null"), std::string("\"\""), "\"" + capitals + "\"",
        "\"" + sum_of("a file").substr(2) + "\"", "\"" + sum_of("a file") + "00\""})
    EXPECT_EQ(refused(copy("{\"report.json\": " + sum + "}")).find("report.json: is not in the manifest"), 0U)
        << sum;
  EXPECT_EQ(refused(copy("{}")).find("report.json: is not in the manifest"), 0U);
  EXPECT_EQ(refused(copy("{\"report.json\": \"" + sum_of("another") + "\"}"))
                .find("report.json: is not what the manifest says"),
            0U);
}

TEST_F(BundleManifest, OneThatNamesAFileThatIsNotThereOrThereTwiceIsRefused) {
  const std::string more = right.substr(0, right.size() - 1) + ", \"model.ply\": \"" + sum_of("") + "\"}";
  EXPECT_EQ(refused(copy(more)).find("model.ply: is missing"), 0U);
  auto twice = copy(right);
  twice.push_back(twice.front());
  EXPECT_EQ(refused(twice).find("report.json: is missing, or there twice"), 0U);
}

TEST_F(BundleManifest, ASignatureOfSomethingElseOrOfSomebodyElseIsRefused) {
  auto files = copy(right);
  files[2] = signature(*store->sign(bytes_of("another manifest")));
  EXPECT_EQ(refused(files).find("manifest.json: is not what was signed"), 0U);
  const auto other = storage::test::opened(folder / "other", {.reserve_bytes = 0});
  storage::Signed taken_for = *store->sign(files[1].bytes);
  taken_for.by = other->sign({})->by;
  files[2] = signature(taken_for);
  EXPECT_EQ(refused(files).find("manifest.json: is not what was signed"), 0U);
  // Words beside it that nobody has signed.
  files[2] = signature(*store->sign(files[1].bytes), ",\n \"name\": \"Ada\"");
  EXPECT_EQ(refused(files).find("signature.json: is no signature"), 0U);
  files[2] = file("signature.json", "{\"by\": 7}");
  EXPECT_EQ(refused(files).find("signature.json: is no signature"), 0U);
}

TEST_F(BundleManifest, AFolderIsReadButForWhatAComputerLeavesBehind) {
  const auto at = folder / "copy";
  std::filesystem::create_directory(at);
  test::write_text(at / "a.txt", "a");
  test::write_text(at / ".DS_Store", "of a computer");
  const auto files = read_bundle_folder(at);
  ASSERT_TRUE(files);
  ASSERT_EQ(files->size(), 1U);
  EXPECT_EQ(files->front().name, "a.txt");
  for (const std::string& name : {std::string("a b.txt"), std::string(101, 'a')}) {
    test::write_text(at / name, "b");
    EXPECT_EQ(read_bundle_folder(at).error().where(), name);
    std::filesystem::remove(at / name);
  }
  for (int i = 1; i < 100; ++i) test::write_text(at / std::to_string(i), "c");
  EXPECT_TRUE(read_bundle_folder(at));
  test::write_text(at / "one.more", "d");
  EXPECT_EQ(read_bundle_folder(at).error().code, Errc::InvalidInput) << "more than any copy has";
  EXPECT_EQ(sums_of(folder / "nowhere").error().code, Errc::IoFailed);
}

TEST_F(BundleManifest, OnAFullDiskItNamesWhatWasAskedFor) {
  const auto model = storage::test::sample_model(40);
  const auto id = store->add_enrolment(storage::NewSubject{"Ada"}, storage::test::sample_enrolment(model));
  ASSERT_TRUE(id);
  const auto enrolment = store->enrolment(*id);
  const auto ada = store->subject(enrolment->subject);
  const test::TinyDisk disk(std::size_t{8} << 10);
  if (!disk.mounted()) GTEST_SKIP() << disk.why_not();
  const auto written = write_manifest(*store, {*ada, *enrolment, {}}, disk.path(), "copy of Ada");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, Errc::MediaFull);
  EXPECT_EQ(written.error().where(), "copy of Ada");
  EXPECT_EQ(test::listing(disk.path()), "");
}

}  // namespace
}  // namespace relievo::firmware
