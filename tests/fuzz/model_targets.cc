// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Models as they are stored, and saved reconstructions.
#include <algorithm>
#include <array>

#include "hal/base/assert.h"
#include "storage/document/document.h"
#include "storage/document/product_bytes.h"
#include "storage/model_blob.h"
#include "storage/sodium_sha256.h"
#include "tests/fuzz/fuzz_targets.h"
#include "tests/storage/raw_database.h"
#include "tests/storage/sample.h"
#include "tests/support/temporary_folder.h"

namespace relievo::test {
namespace {

using namespace storage;

std::pmr::memory_resource* heap() { return std::pmr::get_default_resource(); }

// Its checksum is made to hold: whoever changes a store on purpose does the same.
bool model(FuzzBytes input) {
  std::vector<std::byte> bytes(bytes_of(input).begin(), bytes_of(input).end());
  const auto sum = sha256(bytes);
  bytes.insert(bytes.end(), sum.begin(), sum.end());
  const auto taken = decode_model(bytes, heap());
  if (!taken) return false;
  // Whoever draws or exports it relies on that.
  for (const auto& triangle : taken->mesh.triangles)
    for (const auto corner : triangle) RELIEVO_ASSERT(corner < taken->mesh.vertices_mm.size());
  RELIEVO_ASSERT(encode_model(*taken).has_value());
  return true;
}

struct SavedReconstruction {
  std::vector<std::byte> picture = std::vector<std::byte>(4 * 3 * 3, std::byte{7});
  DocumentHead head{"1.2", "matcher = zmncc\n", true, storage::test::sample_calibration(),
                    5,     {{}, {}, {}},        {},   {}};
  pipeline::RectifiedPair pair{heap()};
  pipeline::MatchSet matches{heap()};
  pipeline::PointCloud cloud{heap()};
  pipeline::FaceModel face = storage::test::sample_model(4);
  SavedReconstruction() {
    pair.width_px = 4, pair.height_px = 3;
    for (auto* view : {&pair.left, &pair.right}) {
      view->grey.assign(12, 0.5F);
      view->rgb.assign(36, 9);
      view->valid.assign(12, 1);
    }
    pair.region.assign(12, 1);
    matches.lattice_step_px = 2;
    matches.matches = {{{1, 2}, 0.5F, 0.1F, 0.2F, 1}};
    cloud.points = {{{1, 2, 600}, {1, 2}, 0.1F}};
    head.by_hand = {{{1, 2}, 0.5F, 0, 0.2F, 0}};
    head.texts["file-matches.path"] = std::make_shared<const std::string>("1 2 3\n");
  }
  std::string bytes() const {
    const ImageView view{picture.data(), 4, 3, 12, PixelFormat::Rgb8};
    return text_of(std::span<const std::byte>(
        *make_document({head, {view, view, 0, 5}, &pair, &matches, &cloud, &face.mesh, nullptr})));
  }
};

const SavedReconstruction& saved() {
  static const SavedReconstruction one;
  return one;
}

bool all_of(std::span<const std::byte> bytes) {
  const auto document = Document::open(bytes);
  if (!document) return false;
  const auto left = document->picture(true), right = document->picture(false);
  const auto pair = document->pair(heap());
  return left && right && pair && document->matches(*pair, heap()) && document->cloud(*pair, heap()) &&
         document->mesh(heap());
}

bool document(FuzzBytes input) {
  static const std::string good = saved().bytes();
  const std::string bytes = patched(good, input);
  return all_of(std::as_bytes(std::span(bytes)));
}

constexpr std::array kParts{"head",    "calibration", "left", "right",   "pair",
                            "matches", "cloud",       "mesh", "text a.b"};

// One part is the input's, under a checksum that holds.
bool part(FuzzBytes input) {
  if (input.empty()) return false;
  const std::string name = kParts[input[0] % kParts.size()];
  const auto data = bytes_of(input.subspan(1));
  static const std::string good = saved().bytes();
  const auto file = in_file("document", {reinterpret_cast<const std::uint8_t*>(good.data()), good.size()});
  std::string both = name + text_of(std::span<const std::byte>(sha256(data)));
  const auto sum = sha256(std::as_bytes(std::span(both)));
  {
    storage::test::Raw raw(file);
    raw.run("PRAGMA journal_mode = MEMORY");
    raw.run("INSERT OR REPLACE INTO part (name, sha256, data) VALUES ('" + name + "', x'00', ?)", data);
    raw.run("UPDATE part SET sha256 = ? WHERE name = '" + name + "'", sum);
  }
  const std::string bytes = read_text(file);
  return all_of(std::as_bytes(std::span(bytes)));
}

std::vector<std::string> parts() {
  const auto& s = saved();
  const ImageView view{s.picture.data(), 4, 3, 12, PixelFormat::Rgb8};
  std::vector<std::string> all;
  const auto add = [&](char number, const std::vector<std::byte>& bytes) {
    all.push_back(number + text_of(std::span<const std::byte>(bytes)));
  };
  add(2, picture_bytes(view));
  add(4, product_bytes(s.pair));
  add(5, product_bytes(s.matches));
  add(6, product_bytes(s.cloud));
  add(7, product_bytes(s.face.mesh));
  all.push_back("\x08some text");
  return all;
}

std::vector<std::string> models() {
  std::vector<std::string> all;
  for (const int side : {2, 4}) {
    const std::string whole =
        text_of(std::span<const std::byte>(*encode_model(storage::test::sample_model(side))));
    all.push_back(whole.substr(0, whole.size() - sizeof(Sha256)));
  }
  return all;
}

}  // namespace

std::vector<FuzzTarget> model_targets() {
  return {{"model", model, models()}, {"document", document, {""}}, {"document-part", part, parts()}};
}

}  // namespace relievo::test
