// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <system_error>

#include "firmware/base/version.h"
#include "firmware/base/wall_time.h"
#include "firmware/records/bundle_manifest.h"
#include "firmware/records/receipt.h"
#include "hal/base/whole_file.h"
#include "storage/cipher/seal.h"

namespace relievo::firmware {
namespace {

namespace fs = std::filesystem;

using Json = nlohmann::ordered_json;
using storage::BundleFile;
using storage::hex_of;

constexpr std::size_t kMostFileBytes = std::size_t{1} << 31, kMostFiles = 100;
constexpr const char *kManifest = "manifest.json", *kSignature = "signature.json";

bool from_hex(const Json& json, const char* key, std::span<std::byte> bytes) {
  return json.is_object() && json.contains(key) && json[key].is_string() &&
         storage::from_hex(json[key].get_ref<const std::string&>(), bytes);
}

BundleFile file_of(const char* name, const Json& json) {
  const std::string text = json.dump(1) + "\n";
  const auto bytes = std::as_bytes(std::span(text));
  return {name, {bytes.begin(), bytes.end()}};
}

BundleFile signature_of(const storage::Signed& made) {
  return file_of(kSignature,
                 {{"of", kManifest}, {"by", hex_of(made.by)}, {"ed25519", hex_of(made.signature)}});
}

Error wrong(const std::string& file, Literal what) { return invalid(what).at(file); }

Result<const BundleFile*> find(std::span<const BundleFile> files, const char* name) {
  const auto found = std::ranges::find(files, name, &BundleFile::name);
  if (found == files.end())
    return wrong(name, "is not there: this is no copy of a person as it was exported");
  return &*found;
}

Json json_in(const BundleFile& file) {
  const auto* text = reinterpret_cast<const char*>(file.bytes.data());
  return Json::parse(text, text + file.bytes.size(), nullptr, false);
}

}  // namespace

std::string text_of(const SigningKey& key) { return hex_of(key); }

Result<std::vector<BundleFile>> manifest_files(storage::Store& store, const CopyOf& of, Sums sums) {
  std::vector<BundleFile> files;
  RELIEVO_TRY_ASSIGN(const auto person, store.person(of.subject.id));
  files.push_back({storage::kPersonFile, encode_person(person)});
  sums[storage::kPersonFile] = storage::sha256(files.back().bytes);
  Json json;
  json["made_by"] = "Relievo " + std::string(kVersion);
  json["made_at"] = text_of(of.now);
  RELIEVO_TRY_ASSIGN(const std::string link, link_number_of(store, of.subject));
  json["person"] = {{"code", receipt_of(of.subject)}, {"name", of.subject.name}, {"link", link}};
  json["enrolled_at"] = text_of(of.enrolment.created_at);
  json["consent"] = {{"wording", of.enrolment.consent.wording},
                     {"language", of.enrolment.consent.language},
                     {"given_at", text_of(of.enrolment.consent.given_at)}};
  for (const auto& [name, sum] : sums) json["sha256"][name] = hex_of(sum);
  files.push_back(file_of(kManifest, json));
  RELIEVO_TRY_ASSIGN(const storage::Signed made, store.sign(files.back().bytes));
  files.push_back(signature_of(made));
  return files;
}

Result<Sums> sums_of(const fs::path& folder) {
  Sums sums;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    RELIEVO_TRY_ASSIGN(const auto bytes, read_whole_file(entry->path(), kMostFileBytes));
    sums[entry->path().filename().string()] = storage::sha256(bytes);
  }
  if (error) return Error{Errc::IoFailed, "the folder cannot be read back", error.value()};
  return sums;
}

Result<void> write_manifest(storage::Store& store, const CopyOf& of, const fs::path& folder,
                            const fs::path& place) {
  RELIEVO_TRY_ASSIGN(Sums sums, sums_of(folder));
  RELIEVO_TRY_ASSIGN(const auto files, manifest_files(store, of, std::move(sums)));
  for (const storage::BundleFile& file : files)
    RELIEVO_TRY(write_whole_file(folder / file.name, file.bytes).at(place.native()));
  return {};
}

Result<std::vector<storage::BundleFile>> read_bundle_folder(const fs::path& folder) {
  std::vector<storage::BundleFile> files;
  std::size_t left = kMostFileBytes;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.starts_with('.')) continue;  // what a computer leaves behind
    if (!storage::is_plain_name(name) || files.size() == kMostFiles ||
        !fs::is_regular_file(fs::symlink_status(entry->path(), error)))
      return invalid("is no file as it was exported: nothing was taken").at(name);
    RELIEVO_TRY_ASSIGN(auto bytes, read_whole_file(entry->path(), left));
    left -= bytes.size();
    files.push_back({name, std::move(bytes)});
  }
  if (error) return Error{Errc::IoFailed, "the folder cannot be read", error.value()}.at(folder.native());
  return files;
}

Result<void> log_export(storage::Store& store, const CopyOf& of) {
  return store.append_audit(
      {"enrolment.exported", of.subject.id, std::to_string(std::int64_t(of.enrolment.id))});
}

Result<SigningKey> check_bundle(std::span<const BundleFile> files) {
  RELIEVO_TRY_ASSIGN(const BundleFile* manifest, find(files, kManifest));
  RELIEVO_TRY_ASSIGN(const BundleFile* signature, find(files, kSignature));
  const Json claimed = json_in(*signature);
  storage::Signed by;
  if (!from_hex(claimed, "by", by.by) || !from_hex(claimed, "ed25519", by.signature) ||
      signature_of(by).bytes != signature->bytes)
    return wrong(kSignature, "is no signature as it was exported: it was changed or cut");
  if (!storage::is_signed(by, manifest->bytes))
    return wrong(kManifest, "is not what was signed: it was changed or cut");
  const Json json = json_in(*manifest);
  if (!json.is_object() || !json.contains("sha256") || !json["sha256"].is_object())
    return wrong(kManifest, "names no files: it is not of this program");
  const Json& sums = json["sha256"];
  for (const BundleFile& file : files) {
    if (&file == manifest || &file == signature) continue;
    storage::Sha256 sum{};
    if (!from_hex(sums, file.name.c_str(), sum)) return wrong(file.name, "is not in the manifest");
    if (sum != storage::sha256(file.bytes))
      return wrong(file.name, "is not what the manifest says: it was changed, cut or exchanged");
  }
  for (const auto& [name, sum] : sums.items())
    if (std::ranges::count(files, name, &BundleFile::name) != 1)
      return wrong(name, "is missing, or there twice");
  return by.by;
}

}  // namespace relievo::firmware
