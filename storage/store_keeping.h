// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is done with a store as a whole, by whoever looks after the device, while no kiosk has it open. Each
// verb opens the store by itself and closes it; all of it is on the disk when it returns without an error,
// none of it otherwise. Errors: as opening a store, and those named. Thread: one at a time.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "hal/base/result.h"
#include "storage/record.h"

namespace relievo::storage {

// Where the appliance's key moves to: a file as text, or beside the store, sealed by the board's TPM.
// Neither: it stays where and as it is.
struct KeyPlace {
  std::filesystem::path file{};
  bool sealed_by_tpm = false;
};

class StoreKeeping {
 public:
  virtual ~StoreKeeping() = default;

  // A copy as sealed as the store, whole or not there; opened by the same key and the same words.
  virtual Result<void> backup(const std::filesystem::path& file) = 0;
  // Whom the store has erased since that copy was made of it. InvalidInput: it is no copy of this store.
  virtual Result<std::vector<SubjectId>> erased_since(const std::filesystem::path& backup) = 0;

  // New keys for the appliance and the store; every wrapped key is wrapped anew. Older copies keep theirs.
  virtual Result<void> rekey(const KeyPlace& to) = 0;

  // A new appliance's key for a store whose own is lost, by its recovery words. NotFound: it has none.
  // Returns who was in it and is erased again, because they were after this copy of the store was made.
  virtual Result<std::vector<SubjectId>> recover(std::string_view words) = 0;
};

}  // namespace relievo::storage
