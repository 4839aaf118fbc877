// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A person as one store hands them to another: every row and model, without loss; the numbers of records stay
// behind. As bytes, little-endian, texts behind their length (u32):
//   "RPERSN" u16 version | name | i64 receipt | i64 created, ms | u32 portraits | for each: i64 created, ms
//   | i64 consent given, ms | wording | language | algorithms | report | u64 size and a calibration_record.h
//   | u64 size and a model_blob.h
// No checksum: what carries it is signed (a bundle's manifest). Thread: any. May throw std::bad_alloc.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "hal/base/result.h"
#include "storage/record.h"

namespace relievo::storage {

struct PersonRecord {
  struct Portrait {
    WallTime created_at;
    Consent consent;
    std::string algorithms;
    std::string report_json;
    std::vector<std::byte> calibration;  // none: made with one that is in no store
    std::vector<std::byte> model;
    bool operator==(const Portrait&) const = default;
  };
  std::string name;
  std::int64_t receipt = 0;
  WallTime created_at;
  std::vector<Portrait> portraits;  // oldest first
  bool operator==(const PersonRecord&) const = default;
};

inline constexpr const char* kPersonFile = "person.record";  // in a bundle

std::vector<std::byte> encode_person(const PersonRecord& person);
// InvalidInput: no such bytes, cut, longer. StoreNewer: a version not known here. What is in it is the
// store's to judge (Store::add_person).
Result<PersonRecord> decode_person(std::span<const std::byte> bytes);

}  // namespace relievo::storage
