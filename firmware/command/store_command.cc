// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `relievo store`: the store as a whole. What changes it is refused while a kiosk has it.
#include <iostream>
#include <sstream>
#include <string>
#include <string_view>

#include "firmware/base/settings.h"
#include "firmware/base/wall_time.h"
#include "firmware/command/commands.h"
#include "firmware/records/bundle_manifest.h"
#include "firmware/service/consent_text_store.h"
#include "hal/base/wiped_text.h"
#include "hal/base/words.h"
#include "storage/cipher/recovery.h"
#include "storage/store_folder.h"

namespace relievo::firmware {
namespace {

Result<void> check(const StoreArgs& args, const Path& folder, Services& services) {
  RELIEVO_TRY_ASSIGN(const auto store, services.open_store(folder, false));
  RELIEVO_TRY(store->check());
  RELIEVO_TRY_ASSIGN(const storage::Signed signs, store->sign({}));
  RELIEVO_TRY_ASSIGN(const auto broken, broken_consents(*store, folder / "consent"));
  for (const Error& error : broken) services.console.fail(error);
  if (!broken.empty())
    return Error{Errc::NotFound, "the store is in order, what people agreed to is not: see above"}.at(
        folder.string());
  services.console.say("in order: " + folder.string());
  services.console.say("what it exports is signed by " + text_of(signs.by));
  if (args.file.empty()) return {};
  RELIEVO_TRY_ASSIGN(const auto erased, services.keep_store(folder)->erased_since(args.file));
  for (const storage::SubjectId id : erased)
    services.console.say("subject " + std::to_string(std::int64_t(id)) +
                         " has been erased since this copy was made: make a new copy and destroy it");
  if (erased.empty()) services.console.say("nobody in this copy has been erased since");
  return {};
}

// What the store has written down of itself, the oldest first.
Result<void> say_log(const Path& folder, Services& services) {
  RELIEVO_TRY_ASSIGN(const auto store, services.open_store(folder, false));
  constexpr std::int64_t kPage = 1000;
  for (std::int64_t last = 0;;) {
    RELIEVO_TRY_ASSIGN(const auto page, store->audit(last, kPage));
    for (const auto& [number, at, event] : page) {
      const auto subject = std::int64_t(event.subject);
      services.console.say(std::to_string(number) + "  " + text_of(at) + "  " + shown_name(event.what) +
                           (subject == 0 ? "" : "  #" + std::to_string(subject)) +
                           (event.detail.empty() ? "" : "  " + shown_name(event.detail)));
    }
    if (std::int64_t(page.size()) < kPage) return {};
    last = page.back().number;
  }
}

// Printed once; they hold when whoever wrote them down has typed two of them.
Result<void> make_words(storage::Store& store, Services& services) {
  const std::string words = storage::draw_recovery_words();
  std::vector<std::string> sheet;
  std::istringstream list(words);
  for (std::string word; list >> word;) {
    sheet.push_back(word);
    services.console.say(std::to_string(sheet.size()) + ". " + word);
  }
  services.console.say(
      "Write them down, in this order. Whoever has them and the store can read everyone in it.");
  for (const std::size_t asked : storage::words_to_ask()) {
    services.console.say("Type word " + std::to_string(asked + 1) + ":");
    std::string typed;
    if (!(std::cin >> typed) || typed != sheet[asked])
      return invalid("that was another word: nothing was changed, start again");
  }
  RELIEVO_TRY(store.keep_recovery_words(words));
  services.console.say("These words open the store from now on; an older sheet does not.");
  return {};
}

// "7.", as the sheet has it before its word.
bool is_number_on_the_sheet(std::string_view word) {
  return word.size() > 1 && word.find_first_not_of("0123456789") == word.size() - 1 && word.back() == '.';
}

// To the end of the line in which the twelfth word stands: one too many is refused, not left out.
Result<void> recover(storage::StoreKeeping& keeping, Services& services) {
  std::string words;
  std::size_t count = 0;
  for (std::string line; count < storage::kRecoveryWords && std::getline(std::cin, line);) {
    std::istringstream list(line);
    for (std::string word; list >> word;) {
      if (is_number_on_the_sheet(word)) continue;
      words += word + " ";
      ++count;
    }
  }
  (void)interrupted();  // as for the other verbs that write, once nothing is read from a person any more
  RELIEVO_TRY_ASSIGN(const auto erased, keeping.recover(words));
  services.console.say("the store has a new key and opens again");
  for (const storage::SubjectId id : erased)
    services.console.say("subject " + std::to_string(std::int64_t(id)) +
                         " was erased after this copy was made, and is erased again");
  return {};
}

// The key that lay beside the store stays there: copies made before need it.
void say_old_key(const StoreArgs& args, const Path& folder, Services& services) {
  const Path old = folder / storage::kKeyFile;
  std::error_code ignored;
  if (args.file.empty() || !std::filesystem::exists(old, ignored) ||
      std::filesystem::equivalent(old, args.file, ignored))
    return;
  services.console.say(old.string() + " is the old key: destroy it once no copy needs it");
  services.console.say("from now on name the new one: --key " + args.file.string());
}

// A call of its own: what it leaves on the stack can be wiped when it has returned.
[[gnu::noinline]] Result<void> keep(const StoreArgs& args, Services& services) {
  RELIEVO_TRY_ASSIGN(const Path folder, store_folder(args.store));
  const auto keeping = services.keep_store(folder);
  switch (args.verb) {
    case StoreArgs::Verb::Check: return check(args, folder, services);
    case StoreArgs::Verb::Log: return say_log(folder, services);
    case StoreArgs::Verb::Backup:
      (void)interrupted();  // from here on a first Ctrl-C waits: neither half a copy nor a key stays behind
      RELIEVO_TRY(keeping->backup(args.file));
      services.console.say("copied to " + args.file.string() +
                           "; keep its key, or the recovery words, elsewhere");
      return {};
    case StoreArgs::Verb::Rekey:
      (void)interrupted();
      RELIEVO_TRY(keeping->rekey({args.file, args.tpm}));
      services.console.say("the keys are new; the old key opens only copies made before");
      say_old_key(args, folder, services);
      return {};
    case StoreArgs::Verb::RecoveryWords: {
      RELIEVO_TRY_ASSIGN(const auto store, open_kept_store(folder, services));
      return make_words(*store, services);
    }
    case StoreArgs::Verb::Recover: break;
  }
  return recover(*keeping, services);
}

}  // namespace

Result<void> run(const StoreArgs& args, Services& services) {
  Result<void> done = keep(args, services);
  wipe_stack();  // recovery words passed over it, one by one
  return done;
}

}  // namespace relievo::firmware
