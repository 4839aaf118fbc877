// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <span>
#include <string_view>
#include <utility>

#include "hal/base/whole_file.h"
#include "storage/cipher/key_source.h"

namespace relievo::storage {
namespace {

namespace fs = std::filesystem;

Result<LockedBytes> read_file(const fs::path& file, bool must_be_private, std::size_t& size) {
  const auto failed = [&](Errc code, Literal what, int cause) {
    return Error{code, what, cause}.at(file.native());
  };
  RELIEVO_TRY_ASSIGN(auto room, LockedBytes::make(kMostSealedByTpm));
  // O_NONBLOCK: a FIFO under this name must not hold us up.
  const int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (fd < 0 && errno == ENOENT)
    return failed(Errc::NotFound, "the store's key is not there: put it back, or name its place (--key)", 0);
  if (fd < 0) return failed(Errc::IoFailed, "the store's key cannot be read: check its owner", errno);
  struct stat status {};
  const bool known = ::fstat(fd, &status) == 0;
  const bool is_file = S_ISREG(status.st_mode);
  const ssize_t got = is_file ? ::read(fd, room.bytes().data(), room.bytes().size()) : 0;
  const int cause = errno;
  ::close(fd);
  if (known && !is_file) return failed(Errc::InvalidInput, "this is not a file, and no store's key", 0);
  if (!known || got < 0)
    return failed(Errc::IoFailed, "the store's key cannot be read: check the disk", cause);
  if (must_be_private && (status.st_mode & 077) != 0)
    return failed(Errc::InvalidInput, "others may read the store's key: give it the mode 0600", 0);
  size = std::size_t(got);
  return room;
}

Result<void> read_key_of(const fs::path& file, SecretKey& key, bool must_be_private) {
  std::size_t size = 0;
  RELIEVO_TRY_ASSIGN(auto room, read_file(file, must_be_private, size));
  const auto bytes = std::as_const(room).bytes().first(size);
  const auto read = is_sealed_by_tpm(bytes)
                        ? open_by_tpm(bytes, key)
                        : read_key({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, key);
  if (read || !read.error().where().empty()) return read;
  return read.error().at(file.native());
}

class KeyFile final : public KeySource {
 public:
  KeyFile(fs::path file, bool beside_the_store, NextKey next, fs::path owner_of)
      : file_(std::move(file)), beside_(beside_the_store), next_is_(next), owner_of_(std::move(owner_of)) {
    if (owner_of_.empty()) owner_of_ = beside_ ? file_.parent_path() : file_;
  }
  Result<void> read(SecretKey& key) override { return read_key_of(file_, key, true); }
  Result<void> read_next(SecretKey& key) override { return read_key_of(next(), key, true); }
  Result<void> make_next(SecretKey& key) override {
    RELIEVO_TRY(must_give_way());
    key.draw();
    if (!is_to_be_sealed()) {
      RELIEVO_TRY_ASSIGN(const auto text, key_text(key));
      return put_next(text.bytes());
    }
    RELIEVO_TRY_ASSIGN(const auto sealed, seal_by_tpm(key));
    return put_next(sealed);
  }
  Result<void> take_next() override {
    if (::rename(next().c_str(), file_.c_str()) != 0)
      return Error{Errc::IoFailed, "the store's new key could not take its place: rename it by hand", errno}
          .at(next().native());
    return sync_renamed(file_);
  }
  bool is_apart() const override { return !beside_; }
  std::string_view protects() const override {
    if (is_key_sealed_by_tpm(file_))
      return "is sealed by this board's TPM: whoever takes the disk, or copies all of it, can read nobody; whoever rules "
             "the running device, or starts another system on this board, can read everyone";
    if (beside_)
      return "lies beside the store: copies of the store without it tell nothing, but whoever takes the whole directory, "
             "the disk or the device can read everyone (--key FILE keeps it elsewhere)";
    return "lies apart from the store: whoever takes only one of the two can read nobody, whoever takes both, or rules "
           "the running device, can read everyone";
  }

 private:
  // A new key replaces what is there for ever. Beside the store that is the store's own, however damaged;
  // elsewhere what is no key is somebody's. What a dead TPM sealed opens nothing any more.
  Result<void> must_give_way() const {
    std::error_code ignored;
    if (fs::is_directory(file_, ignored))
      return invalid("is a folder, and no key: name another").at(file_.native());
    if (beside_) return {};
    std::size_t size = 0;
    RELIEVO_TRY_ASSIGN(auto old, SecretKey::make());
    const auto room = read_file(file_, false, size);
    if (!room) return room.error().code == Errc::NotFound ? Result<void>() : room.error();
    if (size == 0 || is_sealed_by_tpm(room->bytes().first(size))) return {};
    if (!read_key_of(file_, old, false))
      return invalid("is there, and is no key: name another").at(file_.native());
    return read_key_of(file_, old, true);  // whose it is could not be told otherwise
  }
  bool is_to_be_sealed() const {
    if (next_is_ != NextKey::AsBefore) return next_is_ == NextKey::SealedByTpm;
    std::error_code ignored;
    return tpm_is_there() && (is_key_sealed_by_tpm(file_) || (beside_ && !fs::exists(file_, ignored)));
  }
  Result<void> put_next(std::span<const std::byte> bytes) const {
    RELIEVO_TRY_ASSIGN(auto file, PendingFile::create(next(), 0600));
    // Changed by root, it stays the kiosk's to read.
    file.give_to_owner_of(owner_of_);
    RELIEVO_TRY(file.write(bytes));
    RELIEVO_TRY(file.finish());
    RELIEVO_TRY(file.publish());
    return sync_renamed(next());
  }
  fs::path next() const { return file_.native() + ".next"; }
  fs::path file_;
  bool beside_;
  NextKey next_is_;
  fs::path owner_of_;
};

class KeyCredential final : public KeySource {
 public:
  explicit KeyCredential(fs::path file) : file_(std::move(file)) {}
  // systemd guards the directory; the file's mode is systemd's business.
  Result<void> read(SecretKey& key) override { return read_key_of(file_, key, false); }
  Result<void> make_next(SecretKey&) override { return operators_business(); }
  Result<void> read_next(SecretKey&) override { return operators_business(); }
  Result<void> take_next() override { return operators_business(); }
  std::string_view protects() const override {
    return "is a systemd credential. Whoever takes the disk can read nobody as long as the credential is sealed to this "
           "board (systemd-creds, with a TPM); whoever rules the running device can read everyone";
  }

 private:
  Error operators_business() const {
    return Error{Errc::Unsupported, "a credential is made by the operator: systemd-creds encrypt"}.at(
        file_.native());
  }
  fs::path file_;
};

}  // namespace

std::unique_ptr<KeySource> key_file(fs::path file, bool beside_the_store, NextKey next, fs::path owner_of) {
  return std::make_unique<KeyFile>(std::move(file), beside_the_store, next, std::move(owner_of));
}
std::unique_ptr<KeySource> key_credential(fs::path file) {
  return std::make_unique<KeyCredential>(std::move(file));
}
bool is_key_sealed_by_tpm(const fs::path& file) {
  std::size_t size = 0;
  const auto room = read_file(file, false, size);
  return room && is_sealed_by_tpm(room->bytes().first(size));
}

}  // namespace relievo::storage
