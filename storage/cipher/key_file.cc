// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string_view>
#include <utility>

#include "storage/cipher/key_source.h"
#include "storage/export/atomic_file.h"

namespace relievo::storage {
namespace {

namespace fs = std::filesystem;

Result<void> read_file(const fs::path& file, SecretKey& key, bool must_be_private) {
  const auto failed = [&](Errc code, Literal what, int cause) {
    return Error{code, what, cause}.at(file.native());
  };
  RELIEVO_TRY_ASSIGN(auto room, LockedBytes::make(128));
  const int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0 && errno == ENOENT)
    return failed(Errc::NotFound, "the store's key is not there: put it back, or name its place (--key)", 0);
  if (fd < 0) return failed(Errc::IoFailed, "the store's key cannot be read: check its owner", errno);
  struct stat status {};
  const bool known = ::fstat(fd, &status) == 0;
  const ssize_t got = ::read(fd, room.bytes().data(), room.bytes().size());
  const int cause = errno;
  ::close(fd);
  if (!known || got < 0)
    return failed(Errc::IoFailed, "the store's key cannot be read: check the disk", cause);
  if (must_be_private && (status.st_mode & 077) != 0)
    return failed(Errc::InvalidInput, "others may read the store's key: give it the mode 0600", 0);
  const auto read =
      read_key({reinterpret_cast<const char*>(room.bytes().data()), static_cast<std::size_t>(got)}, key);
  return read ? Result<void>() : read.error().at(file.native());
}

class KeyFile final : public KeySource {
 public:
  KeyFile(fs::path file, bool beside_the_store) : file_(std::move(file)), beside_(beside_the_store) {}
  Result<void> read(SecretKey& key) override { return read_file(file_, key, true); }
  Result<void> read_next(SecretKey& key) override { return read_file(next(), key, true); }
  Result<void> make_next(SecretKey& key) override {
    key.draw();
    RELIEVO_TRY_ASSIGN(const auto text, key_text(key));
    RELIEVO_TRY_ASSIGN(auto file, PendingFile::create(next(), 0600));
    RELIEVO_TRY(file.write(text.bytes()));
    RELIEVO_TRY(file.finish());
    RELIEVO_TRY(file.publish());
    return sync_directory(file_.parent_path());
  }
  Result<void> take_next() override {
    if (::rename(next().c_str(), file_.c_str()) != 0)
      return Error{Errc::IoFailed, "the store's new key could not take its place: rename it by hand", errno}
          .at(next().native());
    return sync_directory(file_.parent_path());
  }
  std::string_view protects() const override {
    if (beside_)
      return "lies beside the store: copies of the store without it tell nothing, but whoever takes the whole directory, "
             "the disk or the device can read everyone (--key FILE keeps it elsewhere)";
    return "lies apart from the store: whoever takes only one of the two can read nobody, whoever takes both, or rules "
           "the running device, can read everyone";
  }

 private:
  fs::path next() const { return file_.native() + ".next"; }
  fs::path file_;
  bool beside_;
};

class KeyCredential final : public KeySource {
 public:
  explicit KeyCredential(fs::path file) : file_(std::move(file)) {}
  // systemd guards the directory; the file's mode is systemd's business.
  Result<void> read(SecretKey& key) override { return read_file(file_, key, false); }
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

std::unique_ptr<KeySource> key_file(fs::path file, bool beside_the_store) {
  return std::make_unique<KeyFile>(std::move(file), beside_the_store);
}
std::unique_ptr<KeySource> key_credential(fs::path file) {
  return std::make_unique<KeyCredential>(std::move(file));
}

}  // namespace relievo::storage
