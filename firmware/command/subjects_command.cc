// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <iterator>
#include <memory_resource>
#include <optional>
#include <span>
#include <string>

#include "firmware/base/budget.h"
#include "firmware/base/output_folder.h"
#include "firmware/base/settings.h"
#include "firmware/base/version.h"
#include "firmware/base/wall_time.h"
#include "firmware/command/commands.h"
#include "firmware/records/bundle_manifest.h"
#include "firmware/records/receipt.h"
#include "firmware/service/export_records.h"
#include "hal/base/whole_file.h"
#include "hal/base/wiped_text.h"
#include "pipeline/recognition/recognition_images.h"
#include "storage/cipher/age.h"
#include "storage/export/model_files.h"
#include "storage/store_folder.h"
#include "storage/text.h"

namespace relievo::firmware {
namespace {

// Whom the store takes, the session takes: nobody is refused once the cameras are open.
static_assert(budget::kSubjectNameBytes == storage::kMaxNameBytes);

std::optional<storage::SubjectId> number_in(std::string_view text) {
  if (text.size() < 2 || text.front() != '#') return std::nullopt;
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return storage::SubjectId{number};
}

Result<storage::Subject> find_subject(storage::Store& store, const std::string& name_or_number) {
  RELIEVO_TRY_ASSIGN(const auto known, choose_subject(store, name_or_number));
  if (!known) return Error{Errc::NotFound, "nobody of this name is in the store"}.at(name_or_number);
  return store.subject(*known);
}

std::string number_of(storage::SubjectId id) { return "#" + std::to_string(std::int64_t(id)); }

void say_subject(const storage::Subject& subject, Console& console) {
  console.say(number_of(subject.id) + "  " + text_of(subject.created_at) + "  " +
              std::to_string(subject.enrolments) +
              (subject.enrolments == 1 ? " enrolment   " : " enrolments  ") + subject.name);
}

Result<void> list(storage::Store& store, Console& console) {
  constexpr std::int64_t kPage = 1000;
  for (std::int64_t skip = 0;; skip += kPage) {
    RELIEVO_TRY_ASSIGN(const auto page, store.subjects({"", skip, kPage}));
    for (const storage::Subject& subject : page) say_subject(subject, console);
    if (std::int64_t(page.size()) < kPage) {
      if (skip == 0 && page.empty()) console.say("nobody is in the store");
      return {};
    }
  }
}

Result<void> show(storage::Store& store, const storage::Subject& subject, Console& console) {
  say_subject(subject, console);
  RELIEVO_TRY_ASSIGN(const auto enrolments, store.enrolments(subject.id));
  for (const storage::Enrolment& one : enrolments) {
    console.say("  enrolment " + std::to_string(std::int64_t(one.id)) + "  " + text_of(one.created_at) +
                "  model " + std::to_string(one.model_bytes / 1024) + " KiB  calibration " +
                (one.calibration_revision == 0 ? std::string("from a file")
                                               : std::to_string(one.calibration_revision)) +
                "  consent " + one.consent.wording + " (" + one.consent.language + ", " +
                text_of(one.consent.given_at) + ")");
  }
  return {};
}

// None where no file is named.
Result<std::optional<WipedText>> passphrase_in(const Path& file) {
  constexpr std::size_t kMostBytes = 4096;
  if (file.empty()) return std::optional<WipedText>();
  RELIEVO_TRY_ASSIGN(const auto bytes, read_whole_file(file, kMostBytes));
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  while (text.ends_with('\n') || text.ends_with('\r')) text.remove_suffix(1);
  if (text.empty()) return invalid("holds no passphrase").at(file.string());
  return std::optional(WipedText(text));
}

Result<void> go_on(const SubjectsArgs& args) {
  if (!interrupted().load()) return {};
  return Error{Errc::Cancelled, "cancelled: nothing was written"}.at(args.output.string());
}

// One file, sealed: nothing of it is written to a disk in the clear.
Result<void> write_sealed(const SubjectsArgs& args, std::vector<storage::BundleFile>& files) {
  RELIEVO_TRY_ASSIGN(const auto passphrase, passphrase_in(args.passphrase));
  storage::AgeTo to = storage::Passphrase{passphrase ? passphrase->view() : std::string_view()};
  if (!passphrase) {
    RELIEVO_TRY_ASSIGN(to, storage::age_recipient(args.recipient).at(args.recipient));
  }
  RELIEVO_TRY_ASSIGN(const auto bundle, storage::bundle_bytes(files));
  RELIEVO_TRY_ASSIGN(const auto sealed, storage::age_seal(to, bundle));
  RELIEVO_TRY(go_on(args));
  return write_whole_file(args.output, sealed);
}

Result<void> export_newest(storage::Store& store, const storage::Subject& subject, const SubjectsArgs& args,
                           Services& services) {
  (void)interrupted();  // from here on Ctrl-C is ours: nothing half-written stays behind
  Console& console = services.console;
  const bool sealed = !args.recipient.empty() || !args.passphrase.empty();
  if (sealed) RELIEVO_TRY(storage::must_lie_outside_stores(args.output));
  RELIEVO_TRY_ASSIGN(const auto enrolments, store.enrolments(subject.id));
  if (enrolments.empty()) return Error{Errc::NotFound, "has no enrolment: enrol first"}.at(args.subject);
  const storage::Enrolment& newest = enrolments.back();
  const CopyOf copy{subject, newest,
                    std::chrono::time_point_cast<std::chrono::milliseconds>(services.clock.wall_now())};
  const std::string done = "enrolment " + std::to_string(std::int64_t(newest.id)) + " of " + subject.name +
                           ": " + args.output.string();
  std::pmr::monotonic_buffer_resource memory;
  RELIEVO_TRY_ASSIGN(const pipeline::FaceModel model, store.load_model(newest.id, &memory));
  const auto images = pipeline::make_recognition_images(model, memory, memory);
  // Whoever opens the copy would not know that its portrait and range image are missing.
  if (!images && images.error().code == Errc::OutOfMemory) return images.error();
  storage::ExportOptions options(storage::ExportFrame::Head);
  options.version = kVersion;
  if (images) options.images = &*images;
  if (sealed) {
    RELIEVO_TRY_ASSIGN(auto files, storage::make_model_files(model, options));
    const auto report = std::as_bytes(std::span(newest.report_json));
    if (!report.empty()) files.push_back({"report.json", {report.begin(), report.end()}});
    Sums sums;
    for (const storage::BundleFile& file : files) sums[file.name] = storage::sha256(file.bytes);
    RELIEVO_TRY_ASSIGN(auto manifest, manifest_files(store, copy, std::move(sums)));
    std::ranges::move(manifest, std::back_inserter(files));
    RELIEVO_TRY(log_export(store, copy));
    RELIEVO_TRY(write_sealed(args, files));
    console.say(done + ", sealed: age -d opens it, tar unpacks it");
    return {};
  }
  RELIEVO_TRY(go_on(args));
  RELIEVO_TRY_ASSIGN(OutputFolder folder, OutputFolder::begin(args.output));
  RELIEVO_TRY(storage::write_model_files(model, folder.path(), options).at(args.output.string()));
  RELIEVO_TRY_ASSIGN(
      const std::vector<std::string> further,
      write_further_models(model, args.further, folder.path(), options.frame, args.output, interrupted()));
  for (const std::string& line : further) console.say(line);
  if (!newest.report_json.empty())
    RELIEVO_TRY(write_text(folder.path() / "report.json", newest.report_json, args.output));
  RELIEVO_TRY(write_manifest(store, copy, folder.path(), args.output));
  RELIEVO_TRY(go_on(args));
  RELIEVO_TRY(log_export(store, copy));
  RELIEVO_TRY(folder.commit());
  console.say(done);
  return {};
}

// What the copy holds, opened where it was sealed.
Result<std::vector<storage::BundleFile>> read_copy(const SubjectsArgs& args) {
  constexpr std::size_t kMostBytes = std::size_t{1} << 31, kMostKeyBytes = 65'536;
  constexpr std::string_view kAge = "age-encryption.org/";
  std::error_code error;
  if (std::filesystem::is_directory(args.copy, error)) return read_bundle_folder(args.copy);
  RELIEVO_TRY_ASSIGN(auto bytes, read_whole_file(args.copy, kMostBytes));
  if (std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()).starts_with(kAge)) {
    RELIEVO_TRY_ASSIGN(const auto passphrase, passphrase_in(args.passphrase));
    if (!passphrase && args.identity.empty())
      return invalid("is sealed: name the key (--identity) or --passphrase-file");
    if (passphrase) {
      RELIEVO_TRY_ASSIGN(bytes, storage::age_open(storage::Passphrase{passphrase->view()}, bytes));
    } else {
      RELIEVO_TRY_ASSIGN(const auto text, read_whole_file(args.identity, kMostKeyBytes));
      RELIEVO_TRY_ASSIGN(const auto key,
                         storage::age_identity({reinterpret_cast<const char*>(text.data()), text.size()}));
      RELIEVO_TRY_ASSIGN(bytes, storage::age_open(&key, bytes));
    }
  }
  return storage::bundle_files(bytes);
}

// A signature says only who made the copy: whether that is a device to be believed, a person must say.
Result<void> believe(storage::Store& store, const SigningKey& key, const SubjectsArgs& args) {
  RELIEVO_TRY_ASSIGN(const storage::Signed own, store.sign({}));
  if (key == own.by || text_of(key) == args.signer) return {};
  return invalid(
             "signed this copy, not this store: compare it with what 'relievo store check' says on the other "
             "device, then name it (--signed-by)")
      .at(text_of(key));
}

Result<void> import(const SubjectsArgs& args, const Path& folder, Services& services) {
  const auto named = [&](const Error& error) {
    return error.where().empty() ? error.at(args.copy.string()) : error;
  };
  const auto files = read_copy(args);
  if (!files) return named(files.error());
  RELIEVO_TRY_ASSIGN(const SigningKey key, check_bundle(*files));
  const auto record = std::ranges::find(*files, storage::kPersonFile, &storage::BundleFile::name);
  if (record == files->end())
    return invalid("is not in this copy: it is of an older version, and only for reading")
        .at(storage::kPersonFile);
  const auto person = storage::decode_person(record->bytes);
  if (!person) return named(person.error());
  RELIEVO_TRY_ASSIGN(const auto store, open_kept_store(folder, services));
  RELIEVO_TRY(believe(*store, key, args));
  if (!args.same_name) {
    RELIEVO_TRY_ASSIGN(const auto there, store->subjects({person->name, 0, 1}));
    if (!there.empty())
      return invalid(
                 "has this name already: if that is somebody else, say so (--same-name); nothing was changed")
          .at(number_of(there.front().id));
  }
  const auto taken = store->add_person(*person);
  if (!taken) return named(taken.error());
  services.console.say("taken in: " + number_of(*taken) + " " + person->name);
  return {};
}

}  // namespace

Result<void> check_subject(std::string_view name_or_number) {
  // With a space around it a name looks like another's in every list, and is not found by that.
  if (storage::is_name(name_or_number) && !name_or_number.starts_with(' ') && !name_or_number.ends_with(' '))
    return {};
  return invalid(
             "no name to enrol by: give 1 to 200 bytes of UTF-8 without control characters, and no space around it; "
             "somebody stored under such a name has a number, as in '#3' ('relievo subjects list' shows it)")
      .at("--subject");
}

Result<std::optional<storage::SubjectId>> choose_subject(storage::Store& store,
                                                         std::string_view name_or_number) {
  if (name_or_number.empty())  // to the store it would mean everybody
    return invalid("an empty word is nobody: give a name, a number as in '#3', or a code");
  const auto number = number_in(name_or_number);
  // Whoever types a code means its owner: as a name it would stand readable in every list.
  if (number || is_receipt(name_or_number)) {
    RELIEVO_TRY_ASSIGN(const auto known,
                       number ? store.subject(*number) : find_by_receipt(store, name_or_number));
    return std::optional(known.id);
  }
  RELIEVO_TRY_ASSIGN(const auto found, store.subjects({std::string(name_or_number), 0, 2}));
  if (found.size() > 1)
    return invalid("several have this name: use the number, as in '#3' ('relievo subjects list' shows it)")
        .at(name_or_number);
  return found.empty() ? std::nullopt : std::optional(found.front().id);
}

Result<void> run(const SubjectsArgs& args, Services& services) {
  using Verb = SubjectsArgs::Verb;
  RELIEVO_TRY_ASSIGN(const Path folder, store_folder(args.store));
  if (args.verb == Verb::Import) return import(args, folder, services);
  // An export leaves a line of the store's log.
  const bool writes = args.verb == Verb::Erase || args.verb == Verb::Export;
  RELIEVO_TRY_ASSIGN(const auto store,
                     writes ? open_kept_store(folder, services) : services.open_store(folder, false));
  if (args.verb == Verb::List) return list(*store, services.console);
  RELIEVO_TRY_ASSIGN(const storage::Subject subject, find_subject(*store, args.subject));
  switch (args.verb) {
    case Verb::Show: return show(*store, subject, services.console);
    case Verb::Export: return export_newest(*store, subject, args, services);
    case Verb::Erase:
      RELIEVO_TRY(store->erase_subject(subject.id));
      services.console.say("erased: " + number_of(subject.id));
      return {};
    case Verb::List:
    case Verb::Import: break;
  }
  return {};
}

}  // namespace relievo::firmware
