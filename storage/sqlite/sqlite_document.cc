// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What of a document SQLite sees: a table of named parts. One transaction makes it, in memory of the size it
// will have. The bytes of a face are wiped as they go (firmware/base/wiping_heap.cc).
#include <algorithm>
#include <utility>

#include "storage/byte_order.h"
#include "storage/calibration_record.h"
#include "storage/document/document.h"
#include "storage/document/product_bytes.h"
#include "storage/model_blob.h"
#include "storage/sodium_sha256.h"
#include "storage/sqlite/sqlite_database.h"

namespace relievo::storage {
namespace {

constexpr std::string_view kMagic{"SQLite format 3\0", 16};
constexpr std::uint32_t kDocumentId = 0x524C564F;  // "RLVO"
constexpr std::uint32_t kForm = 3;
constexpr std::string_view kTextPart{"text "};  // before the option that names its file
constexpr std::size_t kHeaderBytes = 100;       // of SQLite's file: its file format, section 1.3
constexpr const char* kSchema =
    "PRAGMA application_id = 1380734543; PRAGMA user_version = 3;"
    "CREATE TABLE part (id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE, sha256 BLOB NOT NULL, data BLOB "
    "NOT NULL) STRICT;";
static_assert(kDocumentId == 1380734543 && kForm == 3);

Error damaged() {
  return invalid("this saved reconstruction is cut off or damaged: take another copy of it");
}

// All is in memory: but for memory itself, what SQLite finds wrong is wrong with the bytes.
Error of_bytes(const Error& error) {
  if (error.code == Errc::OutOfMemory)
    return {Errc::OutOfMemory, "not enough memory for this saved reconstruction"};
  return damaged();
}

// Which parts there are follows from how far the stages came.
std::vector<std::string_view> names_of(std::size_t stages) {
  std::vector<std::string_view> names{"head", "calibration", "left", "right"};
  if (stages >= 1) names.insert(names.end(), {"pair", "matches"});
  if (stages >= 2) names.emplace_back("cloud");
  if (stages == 3) names.emplace_back("mesh");
  if (stages == kDocumentStages) names.insert(names.end(), {"model", "backdrop"});
  return names;
}

// A part that was put in another's place is noticed, too.
Sha256 digest_of(std::string_view name, std::span<const std::byte> data) {
  const Sha256 of_data = sha256(data);
  std::vector<std::byte> both;
  ByteWriter to(both);
  to.put(bytes_of(name));
  to.put(of_data);
  return sha256(both);
}

std::vector<std::byte> head_bytes(const DocumentHead& head) {
  std::vector<std::byte> bytes;
  bytes.reserve(256 + head.version.size() + head.algorithms.size() + 16 * head.by_hand.size());
  ByteWriter to(bytes);
  to.text(head.version);
  to.text(head.algorithms);
  to.flag(head.whole_view);
  to.numbers(head.skew_ns, std::uint8_t(head.stages.size()));
  for (const DocumentStage& stage : head.stages)
    to.numbers(std::int64_t(stage.took.count()), stage.in, stage.out, stage.arena_peak_bytes);
  for (const pipeline::Match& m : head.by_hand)
    to.numbers(m.left_px.x, m.left_px.y, m.disparity_px, m.sigma_px);
  return bytes;
}

Result<DocumentHead> head_from(std::span<const std::byte> bytes) {
  ByteReader from(bytes);
  DocumentHead head;
  from.text(head.version);
  from.text(head.algorithms);
  from.flag(head.whole_view);
  from.numbers(head.skew_ns);
  const auto stages = from.get<std::uint8_t>();
  if (stages > kDocumentStages) return damaged();
  for (std::size_t i = 0; i < stages; ++i) {
    DocumentStage& stage = head.stages.emplace_back();
    stage.took = std::chrono::nanoseconds(from.get<std::int64_t>());
    from.numbers(stage.in, stage.out, stage.arena_peak_bytes);
  }
  while (from.ok() && from.left() > 0) {
    pipeline::Match& m = head.by_hand.emplace_back();
    from.numbers(m.left_px.x, m.left_px.y, m.disparity_px, m.sigma_px);
  }
  if (!from.ok()) return damaged();
  return head;
}

Result<std::vector<std::byte>> bytes_of_part(const DocumentParts& parts, std::string_view name) {
  if (name == "head") return head_bytes(parts.head);
  if (name == "calibration") return encode_calibration(parts.head.calibration);
  if (name == "left") return picture_bytes(parts.frame.left);
  if (name == "right") return picture_bytes(parts.frame.right);
  if (name == "pair") return product_bytes(*parts.pair);
  if (name == "matches") return product_bytes(*parts.matches);
  if (name == "cloud") return product_bytes(*parts.cloud);
  if (name == "mesh") return product_bytes(*parts.mesh);
  if (name == "backdrop") return product_bytes(parts.model->backdrop);
  return encode_model(*parts.model);
}

// At least what all the parts will take, SQLite's own pages with them.
std::size_t room_for(const DocumentParts& parts) {
  const auto picture = [](const ImageView& v) {
    return std::size_t(v.width_px) * std::size_t(v.height_px) * 3;
  };
  std::size_t bytes = picture(parts.frame.left) + picture(parts.frame.right) + parts.head.algorithms.size() +
                      parts.head.by_hand.size() * 16;
  for (const auto& [option, text] : parts.head.texts) bytes += text->size();
  if (parts.pair != nullptr) bytes += parts.pair->left.grey.size() * 17;
  if (parts.matches != nullptr) bytes += parts.matches->matches.size() * 22;
  if (parts.cloud != nullptr) bytes += parts.cloud->points.size() * 24;
  if (parts.mesh != nullptr) bytes += parts.mesh->vertices_mm.size() * 29 + parts.mesh->triangles.size() * 12;
  if (parts.model != nullptr) {
    const pipeline::FaceMesh& mesh = parts.model->mesh;
    const pipeline::TextureAtlas& texture = parts.model->texture;
    bytes += mesh.vertices_mm.size() * 32 + mesh.triangles.size() * 36 + texture.rgb.size() +
             texture.origin.size() + parts.model->backdrop.at_mm.size() * 16;
  }
  return bytes + bytes / 256 + std::size_t{256} * 1024;
}

Result<void> put(Database& database, std::string_view name, std::span<const std::byte> data) {
  const Sha256 digest = digest_of(name, data);
  RELIEVO_TRY(database.run("INSERT INTO part (name, sha256, data) VALUES (?, ?, ?)", name, digest,
                           Zeros{std::int64_t(data.size())}));
  RELIEVO_TRY_ASSIGN(auto blob, Blob::open(database, "part", "data", database.last_row_id(), true));
  return blob.write(0, data);
}

// Of a number in SQLite's header, which is big-endian.
template <typename T>
T header(std::span<const std::byte> bytes, std::size_t at) {
  T value = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i)
    value = static_cast<T>(value << 8 | std::to_integer<T>(bytes[at + i]));
  return value;
}

Result<void> check_header(std::span<const std::byte> bytes) {
  const bool ours = bytes.size() >= kHeaderBytes &&
                    std::ranges::equal(bytes.first(kMagic.size()), bytes_of(kMagic)) &&
                    header<std::uint32_t>(bytes, 68) == kDocumentId;
  if (!ours)
    return invalid(
        "this is no saved reconstruction: choose a file that the technician's page or 'relievo "
        "reconstruct --save' has written");
  if (header<std::uint32_t>(bytes, 60) > kForm)
    return Error{Errc::Unsupported, "this reconstruction was saved by a newer version: update Relievo"};
  const std::size_t page = header<std::uint16_t>(bytes, 16);
  if (page * header<std::uint32_t>(bytes, 28) != bytes.size()) return damaged();
  return {};
}

}  // namespace

Result<std::vector<std::byte>> make_document(const DocumentParts& parts) {
  return without_exceptions({}, [&]() -> Result<std::vector<std::byte>> {
    std::vector<std::byte> room(room_for(parts));
    if (room.size() > kMaxDocumentBytes) return invalid("this reconstruction is too large to be saved");
    Database database(":memory:");
    RELIEVO_TRY(database.open(true));
    RELIEVO_TRY(database.lie_in(room, 0, true));
    Transaction transaction(database);
    RELIEVO_TRY(transaction.begin());
    RELIEVO_TRY(database.run(kSchema));
    for (const std::string_view name : names_of(parts.head.stages.size())) {
      RELIEVO_TRY_ASSIGN(const std::vector<std::byte> data, bytes_of_part(parts, name));
      RELIEVO_TRY(put(database, name, data));
    }
    for (const auto& [option, text] : parts.head.texts)
      RELIEVO_TRY(put(database, std::string(kTextPart) + option, bytes_of(*text)));
    RELIEVO_TRY(transaction.commit());
    RELIEVO_TRY_ASSIGN(const std::int64_t pages, database.integer("PRAGMA page_count"));
    RELIEVO_TRY_ASSIGN(const std::int64_t page_bytes, database.integer("PRAGMA page_size"));
    database.close();
    room.resize(std::size_t(pages * page_bytes));
    return room;
  });
}

struct Document::Inside {
  Database database{":memory:"};

  Result<std::vector<std::byte>> part(std::string_view name) {
    return without_exceptions({}, [&]() -> Result<std::vector<std::byte>> {
      RELIEVO_TRY_ASSIGN(auto find,
                         database.prepare("SELECT id, sha256, length(data) FROM part WHERE name = ?", name));
      RELIEVO_TRY_ASSIGN(const bool there, find.step());
      const auto size = there ? std::size_t(find.integer(2)) : 0;
      if (size == 0 || size > kMaxDocumentBytes) return damaged();
      std::vector<std::byte> data(size);
      RELIEVO_TRY_ASSIGN(auto blob, Blob::open(database, "part", "data", find.integer(0), false));
      RELIEVO_TRY(blob.read(0, data));
      if (!std::ranges::equal(digest_of(name, data), find.blob(1))) return damaged();
      return data;
    });
  }
  // Those of the parts that hold the text of a file.
  Result<std::vector<std::string>> text_parts() {
    std::vector<std::string> names;
    RELIEVO_TRY(database.each("SELECT name FROM part WHERE name GLOB 'text *' ORDER BY name",
                              [&](const Statement& row) { names.emplace_back(row.text(0)); }));
    return names;
  }
  // With the one error a reader of bytes can have.
  template <typename Read>
  auto read(std::string_view name, const Read& from) -> decltype(from(std::span<const std::byte>())) {
    auto data = part(name);
    if (!data) return of_bytes(data.error());
    auto product = without_exceptions({}, [&] { return from(std::span<const std::byte>(*data)); });
    if (!product) return of_bytes(product.error());
    return product;
  }
  template <typename Product>
  Result<Product> product(std::string_view name, std::pmr::memory_resource* memory, const auto&... beside) {
    return read(name, [&](auto data) { return product_from<Product>(data, memory, beside...); });
  }
};

Result<Document> Document::open(std::span<const std::byte> bytes) {
  RELIEVO_TRY(check_header(bytes));
  Document document;
  document.inside_ = std::make_shared<Inside>();
  Inside& inside = *document.inside_;
  // Read-only: SQLite asks for bytes it might write to, and does not.
  const std::span<std::byte> room(const_cast<std::byte*>(bytes.data()), bytes.size());
  if (const auto opened = inside.database.open(true); !opened) return of_bytes(opened.error());
  if (const auto laid = inside.database.lie_in(room, room.size(), false); !laid)
    return of_bytes(laid.error());
  RELIEVO_TRY_ASSIGN(document.head_, inside.read("head", head_from));
  RELIEVO_TRY_ASSIGN(const StoredCalibration stored, inside.read("calibration", decode_calibration));
  document.head_.calibration = stored.calibration;
  if (!check_calibration(stored.calibration)) return damaged();
  for (const std::string_view name : names_of(document.head_.stages.size())) {
    const auto whole =
        inside.read(name, [](std::span<const std::byte> data) { return Result<std::size_t>(data.size()); });
    if (!whole) return whole.error();
  }
  const auto texts = inside.text_parts();
  if (!texts) return of_bytes(texts.error());
  for (const std::string& name : *texts) {
    RELIEVO_TRY_ASSIGN(document.head_.texts[name.substr(kTextPart.size())],
                       inside.read(name, [](std::span<const std::byte> data) {
                         return Result(std::make_shared<const std::string>(text_of(data)));
                       }));
  }
  return document;
}

Result<Document::Picture> Document::picture(bool left) const {
  auto data = inside_->part(left ? "left" : "right");
  if (!data) return of_bytes(data.error());
  const auto view = picture_from(*data);
  if (!view) return damaged();
  return Picture{*std::move(data), *view};
}

Result<pipeline::RectifiedPair> Document::pair(std::pmr::memory_resource* memory) const {
  return inside_->product<pipeline::RectifiedPair>("pair", memory);
}

Result<pipeline::MatchSet> Document::matches(const pipeline::RectifiedPair& of,
                                             std::pmr::memory_resource* memory) const {
  return inside_->product<pipeline::MatchSet>("matches", memory, of);
}

Result<pipeline::PointCloud> Document::cloud(const pipeline::RectifiedPair& of,
                                             std::pmr::memory_resource* memory) const {
  return inside_->product<pipeline::PointCloud>("cloud", memory, of);
}

Result<pipeline::FaceMesh> Document::mesh(std::pmr::memory_resource* memory) const {
  return inside_->product<pipeline::FaceMesh>("mesh", memory);
}

Result<pipeline::FaceModel> Document::model(std::pmr::memory_resource* memory) const {
  RELIEVO_TRY_ASSIGN(pipeline::FaceModel model,
                     inside_->read("model", [&](auto data) { return decode_model(data, memory); }));
  RELIEVO_TRY_ASSIGN(model.backdrop, inside_->product<pipeline::Backdrop>("backdrop", memory));
  return model;
}

}  // namespace relievo::storage
