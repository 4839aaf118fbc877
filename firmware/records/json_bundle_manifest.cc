// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include <string>

#include "firmware/base/version.h"
#include "firmware/base/wall_time.h"
#include "firmware/records/bundle_manifest.h"
#include "firmware/records/receipt.h"
#include "storage/sodium_sha256.h"

namespace relievo::firmware {
namespace {

std::string hex_of(std::span<const std::byte> bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string hex;
  for (const std::byte byte : bytes) {
    const auto value = std::to_integer<std::size_t>(byte);
    hex += {kDigits[value >> 4U], kDigits[value & 15U]};
  }
  return hex;
}

storage::BundleFile file_of(const char* name, const nlohmann::ordered_json& json) {
  const std::string text = json.dump(1) + "\n";
  const auto bytes = std::as_bytes(std::span(text));
  return {name, {bytes.begin(), bytes.end()}};
}

}  // namespace

Result<void> add_manifest(storage::Store& store, const storage::Subject& subject,
                          const storage::Enrolment& enrolment, storage::WallTime now,
                          std::vector<storage::BundleFile>& files) {
  nlohmann::ordered_json json;
  json["made_by"] = "Relievo " + std::string(kVersion);
  json["made_at"] = text_of(now);
  json["person"] = {{"code", receipt_of(subject)}, {"name", subject.name}};
  json["enrolled_at"] = text_of(enrolment.created_at);
  json["consent"] = {{"wording", enrolment.consent.wording},
                     {"language", enrolment.consent.language},
                     {"given_at", text_of(enrolment.consent.given_at)}};
  for (const storage::BundleFile& file : files)
    json["sha256"][file.name] = hex_of(storage::sha256(file.bytes));
  files.push_back(file_of("manifest.json", json));
  RELIEVO_TRY_ASSIGN(const storage::Signed made, store.sign(files.back().bytes));
  files.push_back(
      file_of("signature.json",
              {{"of", "manifest.json"}, {"by", hex_of(made.by)}, {"ed25519", hex_of(made.signature)}}));
  return {};
}

}  // namespace relievo::firmware
