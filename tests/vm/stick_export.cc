// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the kiosk does with a stick, on one that the kernel has mounted:
//   stick_export make STORE [0]         two people, one of them with a large model, or nobody
//   stick_export give STORE MOUNTED     both records onto the stick, read back, unmounted, read once more
//   stick_export look MOUNTED           how many records are there, each whole and signed; none may be half
// One line says how it ended. Exit code 0: done.
#include <atomic>
#include <cstdio>
#include <string>
#include <string_view>

#include "firmware/records/bundle_manifest.h"
#include "firmware/records/receipt.h"
#include "firmware/service/export_records.h"
#include "firmware/service/stick_folder.h"
#include "hal/base/words.h"
#include "hal/linux/mounted_stick.h"
#include "hal/monotonic_clock.h"
#include "storage/sqlite/sqlite_store.h"
#include "tests/storage/sample.h"

namespace {

using namespace relievo;            // NOLINT(google-build-using-namespace)
using namespace relievo::firmware;  // NOLINT(google-build-using-namespace)

int ended(const Result<void>& done, const std::string& more) {
  std::printf("%s%s\n", done ? "done" : detail_of(done.error()).c_str(), more.c_str());
  return done ? 0 : 1;
}

Result<void> make(storage::Store& store) {
  for (const auto& [name, side] : {std::pair{"Ada", 40}, std::pair{"Bob", 150}}) {
    const auto model = storage::test::sample_model(side);
    RELIEVO_TRY(store.add_enrolment(storage::NewSubject{name}, storage::test::sample_enrolment(model)));
  }
  return {};
}

int give(storage::Store& store, const hal::Clock& clock, const char* mounted) {
  hal::MountedStick stick(mounted);
  const std::atomic<bool> cancelled = false;
  pipeline::Progress progress;
  JobControl control{cancelled, progress};
  ExportTrace trace;
  const auto done =
      export_records(store, clock, stick, {storage::SubjectId{1}, storage::SubjectId{2}}, {}, control, trace);
  const int outcome =
      done ? static_cast<int>(ui::Outcome::Done) : static_cast<int>(outcome_of_export(done.error(), trace));
  return ended(done, "; whole " + std::to_string(trace.whole) + ", outcome " + std::to_string(outcome));
}

int look(const std::filesystem::path& mounted) {
  tidy_folder(mounted / "relievo", is_receipt);  // as the next export does
  int whole = 0;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(mounted / "relievo", error), end; !error && entry != end;
       entry.increment(error)) {
    const auto files = read_bundle_folder(entry->path());
    if (!files) return ended(files.error(), " in " + entry->path().string());
    if (const auto signer = check_bundle(*files); !signer)
      return ended(signer.error(), " in " + entry->path().string());
    ++whole;
  }
  std::printf("whole records: %d\n", whole);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view verb = argc > 1 ? argv[1] : "";
  if (verb == "look" && argc == 3) return look(argv[2]);
  if (argc < 3) return 2;
  const hal::MonotonicClock clock;
  const auto store = storage::open_sqlite_store(argv[2], clock, {.reserve_bytes = 0});
  if (!store) return ended(store.error(), "");
  if (verb == "make" && argc == 4) return 0;  // nobody in it
  if (verb == "make") return ended(make(**store), "");
  if (verb == "give" && argc == 4) return give(**store, clock, argv[3]);
  return 2;
}
