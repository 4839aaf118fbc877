// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the kiosk does with a stick, on one that the kernel has mounted:
//   stick_export make STORE [0]   two people, one of them with a larger model, or nobody
//   stick_export serve STORE      stays, as a kiosk does, and does what a line of its input says:
//     give MOUNTED                  both records onto the stick, read back, unmounted, read once more
//     look MOUNTED                  how many records are there, each whole and signed; none may be half
// One line says how each ended, and before that whether it was done: 0, else 1.
#include <atomic>
#include <cstdio>
#include <iostream>
#include <string>
#include <string_view>

#include "firmware/records/bundle_manifest.h"
#include "firmware/records/receipt.h"
#include "firmware/service/export_records.h"
#include "hal/base/words.h"
#include "hal/clock.h"
#include "hal/linux/mounted_stick.h"
#include "storage/sqlite/sqlite_store.h"
#include "tests/storage/sample.h"

namespace {

using namespace relievo;            // NOLINT(google-build-using-namespace)
using namespace relievo::firmware;  // NOLINT(google-build-using-namespace)

Result<void> make(storage::Store& store) {
  for (const auto& [name, side] : {std::pair{"Ada", 20}, std::pair{"Bob", 70}}) {
    const auto model = storage::test::sample_model(side);
    RELIEVO_TRY(store.add_enrolment(storage::NewSubject{name}, storage::test::sample_enrolment(model)));
  }
  return {};
}

struct Answer {
  bool done;
  std::string words;
};
Answer failed(const Error& error, const std::string& more = {}) { return {false, detail_of(error) + more}; }

Answer give(storage::Store& store, const hal::Clock& clock, const std::string& mounted) {
  hal::MountedStick stick(mounted);
  const std::atomic<bool> cancelled = false;
  pipeline::Progress progress;
  JobControl control{cancelled, progress};
  ExportTrace trace;
  const auto done =
      export_records(store, clock, stick, {storage::SubjectId{1}, storage::SubjectId{2}}, {}, control, trace);
  const std::string whole = "whole " + std::to_string(trace.whole);
  if (done) return {true, whole};
  return failed(done.error(), "; " + whole + ", outcome " +
                                  std::to_string(static_cast<int>(outcome_of_export(done.error(), trace))));
}

Answer look(const std::filesystem::path& mounted) {
  tidy_folder(mounted / "relievo", is_receipt);  // as the next export does
  int whole = 0;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(mounted / "relievo", error), end; !error && entry != end;
       entry.increment(error)) {
    const auto files = read_bundle_folder(entry->path());
    if (!files) return failed(files.error(), " in " + entry->path().string());
    if (const auto signer = check_bundle(*files); !signer)
      return failed(signer.error(), " in " + entry->path().string());
    ++whole;
  }
  return {true, "whole records: " + std::to_string(whole)};
}

void serve(storage::Store& store, const hal::Clock& clock) {
  for (std::string verb, mounted; std::cin >> verb >> mounted;) {
    const Answer answer = verb == "give" ? give(store, clock, mounted) : look(mounted);
    std::cout << (answer.done ? 0 : 1) << ' ' << answer.words << std::endl;
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view verb = argc > 2 ? argv[1] : "";
  if (verb != "make" && verb != "serve") return 2;
  const hal::MonotonicClock clock;
  const auto store = storage::open_sqlite_store(argv[2], clock, {.reserve_bytes = 0});
  Result<void> done;
  if (!store) done = store.error();
  else if (verb == "serve") serve(**store, clock);
  else if (argc == 3) done = make(**store);  // else nobody is in it
  if (!done) std::fprintf(stderr, "%s\n", detail_of(done.error()).c_str());
  return done ? 0 : 1;
}
