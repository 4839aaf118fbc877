// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <string.h>
#include <tss2/tss2_esys.h>
#include <tss2/tss2_mu.h>
#include <tss2/tss2_tctildr.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

#include "storage/byte_order.h"
#include "storage/cipher/key_source.h"
#include "storage/sodium_sha256.h"

namespace relievo::storage {
namespace {

// A file of this: the mark, the name of the primary key, the object's two halves, SHA-256 of all that.
constexpr std::string_view kMark = "relievo: sealed by a TPM 2.0\n";
constexpr const char* kDevice = "/dev/tpmrm0";

Error refused(Literal what, TSS2_RC number) {
  char text[24];
  std::snprintf(text, sizeof(text), "TPM, 0x%x", number);
  return Error{Errc::IoFailed, what}.at(text);
}
Error another() {
  return invalid(
      "the store's key was sealed by another board's TPM, or by this one before it was cleared: relievo "
      "store recover, with the recovery words");
}
Error changed() {
  return invalid(
      "the store's key, sealed by the TPM, was changed: put its file back, or relievo store recover");
}

struct Freed {
  void operator()(void* block) const { Esys_Free(block); }
};
template <typename T>
using Owned = std::unique_ptr<T, Freed>;

// What the standard gives for the storage primary key: the same on every board, another key on each.
TPM2B_PUBLIC primary_template() {
  TPM2B_PUBLIC made{};
  TPMT_PUBLIC& area = made.publicArea;
  area.type = TPM2_ALG_ECC;
  area.nameAlg = TPM2_ALG_SHA256;
  area.objectAttributes = TPMA_OBJECT_FIXEDTPM | TPMA_OBJECT_FIXEDPARENT | TPMA_OBJECT_SENSITIVEDATAORIGIN |
                          TPMA_OBJECT_USERWITHAUTH | TPMA_OBJECT_NODA | TPMA_OBJECT_RESTRICTED |
                          TPMA_OBJECT_DECRYPT;
  area.parameters.eccDetail = {
      .symmetric = {.algorithm = TPM2_ALG_AES, .keyBits = {.aes = 128}, .mode = {.aes = TPM2_ALG_CFB}},
      .scheme = {.scheme = TPM2_ALG_NULL, .details = {}},
      .curveID = TPM2_ECC_NIST_P256,
      .kdf = {.scheme = TPM2_ALG_NULL, .details = {}}};
  area.unique.ecc.x.size = area.unique.ecc.y.size = 32;
  return made;
}

// One conversation: what it made in the chip goes with it.
class Tpm {
 public:
  Tpm() = default;
  Tpm& operator=(Tpm&&) = delete;
  ~Tpm() {
    for (const ESYS_TR one : {object_, session_, primary_})
      if (one != ESYS_TR_NONE) Esys_FlushContext(esys_, one);
    Esys_Finalize(&esys_);
    Tss2_TctiLdr_Finalize(&tcti_);
  }

  Result<void> begin() {
    // It writes its own lines to standard error otherwise.
    static const int quiet = ::setenv("TSS2_LOG", "all+none", 0);
    if (quiet != 0) return Error{Errc::OutOfMemory, "there is no memory to talk to the TPM"};
    const char* const named = std::getenv("TPM2TOOLS_TCTI");
    if (!tpm_is_there())
      return Error{Errc::IoFailed,
                   "this board has no TPM that this user may use: look into its firmware, put the user into "
                   "the group tss, or relievo store recover with another --key"}
          .at(kDevice);
    const std::string device = named != nullptr ? named : std::string("device:") + kDevice;
    TSS2_RC done = Tss2_TctiLdr_Initialize(device.c_str(), &tcti_);
    if (done == TSS2_RC_SUCCESS) done = Esys_Initialize(&esys_, tcti_, nullptr);
    if (done != TSS2_RC_SUCCESS)
      return Error{Errc::IoFailed,
                   "the TPM does not answer: check it, or relievo store recover with another --key"}
          .at(device);
    return make_primary();
  }
  const TPM2B_NAME& primary_name() const { return *name_; }

  Result<void> create(const SecretKey& key, Owned<TPM2B_PUBLIC>& open_half,
                      Owned<TPM2B_PRIVATE>& sealed_half) {
    RELIEVO_TRY_ASSIGN(auto room, LockedBytes::make(sizeof(TPM2B_SENSITIVE_CREATE)));
    auto& secret = *new (room.bytes().data()) TPM2B_SENSITIVE_CREATE{};
    secret.sensitive.data.size = SecretKey::kBytes;
    ::memcpy(secret.sensitive.data.buffer, key.bytes().data(), SecretKey::kBytes);
    // Without a password, so that a chip that is locked after wrong ones (of others) still opens it.
    TPM2B_PUBLIC kind{};
    kind.publicArea.type = TPM2_ALG_KEYEDHASH;
    kind.publicArea.nameAlg = TPM2_ALG_SHA256;
    kind.publicArea.objectAttributes =
        TPMA_OBJECT_FIXEDTPM | TPMA_OBJECT_FIXEDPARENT | TPMA_OBJECT_USERWITHAUTH | TPMA_OBJECT_NODA;
    kind.publicArea.parameters.keyedHashDetail.scheme.scheme = TPM2_ALG_NULL;
    const TPM2B_DATA nothing{};
    const TPML_PCR_SELECTION no_registers{};
    TPM2B_PRIVATE* inner = nullptr;
    TPM2B_PUBLIC* outer = nullptr;
    const TSS2_RC done = Esys_Create(esys_, primary_, session_, ESYS_TR_NONE, ESYS_TR_NONE, &secret, &kind,
                                     &nothing, &no_registers, &inner, &outer, nullptr, nullptr, nullptr);
    sealed_half.reset(inner);
    open_half.reset(outer);
    if (done != TSS2_RC_SUCCESS)
      return refused("the TPM does not seal the store's key: try again, or keep it in a file (--new-key)",
                     done);
    return {};
  }

  Result<void> unseal(const TPM2B_PUBLIC& open_half, const TPM2B_PRIVATE& sealed_half, SecretKey& key) {
    if (Esys_Load(esys_, primary_, session_, ESYS_TR_NONE, ESYS_TR_NONE, &sealed_half, &open_half,
                  &object_) != TSS2_RC_SUCCESS)
      return changed();
    TPM2B_SENSITIVE_DATA* secret = nullptr;
    const TSS2_RC done = Esys_Unseal(esys_, object_, session_, ESYS_TR_NONE, ESYS_TR_NONE, &secret);
    const Owned<TPM2B_SENSITIVE_DATA> owned(secret);
    if (done != TSS2_RC_SUCCESS)
      return refused("the TPM does not open the store's key: try again, or relievo store recover", done);
    const bool whole = secret->size == SecretKey::kBytes;
    if (whole) ::memcpy(key.bytes().data(), secret->buffer, SecretKey::kBytes);
    ::explicit_bzero(secret, sizeof(*secret));
    return whole ? Result<void>() : changed();
  }

 private:
  // The conversation is encrypted for the primary key: who listens on the wire hears nothing.
  Result<void> make_primary() {
    constexpr Literal kOwner =
        "the TPM lets nobody make keys in it: take the owner's password away (tpm2_changeauth -c o)";
    const TPM2B_SENSITIVE_CREATE no_password{};
    const TPM2B_PUBLIC primary = primary_template();
    const TPM2B_DATA nothing{};
    const TPML_PCR_SELECTION no_registers{};
    TSS2_RC done = Esys_CreatePrimary(esys_, ESYS_TR_RH_OWNER, ESYS_TR_PASSWORD, ESYS_TR_NONE, ESYS_TR_NONE,
                                      &no_password, &primary, &nothing, &no_registers, &primary_, nullptr,
                                      nullptr, nullptr, nullptr);
    if (done != TSS2_RC_SUCCESS) return refused(kOwner, done);
    TPM2B_NAME* name = nullptr;
    done = Esys_TR_GetName(esys_, primary_, &name);
    name_.reset(name);
    const TPMT_SYM_DEF aes = {
        .algorithm = TPM2_ALG_AES, .keyBits = {.aes = 128}, .mode = {.aes = TPM2_ALG_CFB}};
    if (done == TSS2_RC_SUCCESS)
      done = Esys_StartAuthSession(esys_, primary_, ESYS_TR_NONE, ESYS_TR_NONE, ESYS_TR_NONE, ESYS_TR_NONE,
                                   nullptr, TPM2_SE_HMAC, &aes, TPM2_ALG_SHA256, &session_);
    constexpr TPMA_SESSION kEncrypted =
        TPMA_SESSION_DECRYPT | TPMA_SESSION_ENCRYPT | TPMA_SESSION_CONTINUESESSION;
    if (done == TSS2_RC_SUCCESS) done = Esys_TRSess_SetAttributes(esys_, session_, kEncrypted, 0xff);
    if (done != TSS2_RC_SUCCESS) return refused("the TPM begins no encrypted conversation: try again", done);
    return {};
  }

  TSS2_TCTI_CONTEXT* tcti_ = nullptr;
  ESYS_CONTEXT* esys_ = nullptr;
  ESYS_TR primary_ = ESYS_TR_NONE, session_ = ESYS_TR_NONE, object_ = ESYS_TR_NONE;
  Owned<TPM2B_NAME> name_;
};

}  // namespace

bool tpm_is_there() {
  const char* const named = std::getenv("TPM2TOOLS_TCTI");
  return named != nullptr ? std::string_view(named) != "none" : ::access(kDevice, R_OK | W_OK) == 0;
}

bool is_sealed_by_tpm(std::span<const std::byte> bytes) { return text_of(bytes).starts_with(kMark); }

Result<std::vector<std::byte>> seal_by_tpm(const SecretKey& key) {
  Tpm tpm;
  RELIEVO_TRY(tpm.begin());
  Owned<TPM2B_PUBLIC> open_half;
  Owned<TPM2B_PRIVATE> sealed_half;
  RELIEVO_TRY(tpm.create(key, open_half, sealed_half));
  std::byte room[kMostSealedByTpm];
  auto* const raw = reinterpret_cast<std::uint8_t*>(room);
  std::size_t size = 0;
  if (Tss2_MU_TPM2B_NAME_Marshal(&tpm.primary_name(), raw, sizeof(room), &size) != TSS2_RC_SUCCESS ||
      Tss2_MU_TPM2B_PUBLIC_Marshal(open_half.get(), raw, sizeof(room), &size) != TSS2_RC_SUCCESS ||
      Tss2_MU_TPM2B_PRIVATE_Marshal(sealed_half.get(), raw, sizeof(room), &size) != TSS2_RC_SUCCESS)
    return Error{Errc::LibraryFailed, "what the TPM sealed is larger than expected: keep the key in a file"};
  std::vector<std::byte> sealed;
  ByteWriter to(sealed);
  to.put(bytes_of(kMark));
  to.put(std::span(room, size));
  to.put(sha256(sealed));
  return sealed;
}

Result<void> open_by_tpm(std::span<const std::byte> sealed, SecretKey& key) {
  constexpr std::size_t kSum = sizeof(Sha256);
  if (!is_sealed_by_tpm(sealed) || sealed.size() < kMark.size() + kSum || !ends_in_sha256(sealed))
    return changed();
  const auto parts = sealed.first(sealed.size() - kSum).subspan(kMark.size());
  const auto* const raw = reinterpret_cast<const std::uint8_t*>(parts.data());
  TPM2B_NAME name{};
  TPM2B_PUBLIC open_half{};
  TPM2B_PRIVATE sealed_half{};
  std::size_t at = 0;
  if (Tss2_MU_TPM2B_NAME_Unmarshal(raw, parts.size(), &at, &name) != TSS2_RC_SUCCESS ||
      Tss2_MU_TPM2B_PUBLIC_Unmarshal(raw, parts.size(), &at, &open_half) != TSS2_RC_SUCCESS ||
      Tss2_MU_TPM2B_PRIVATE_Unmarshal(raw, parts.size(), &at, &sealed_half) != TSS2_RC_SUCCESS ||
      at != parts.size())
    return changed();
  Tpm tpm;
  RELIEVO_TRY(tpm.begin());
  const TPM2B_NAME& here = tpm.primary_name();
  if (!std::ranges::equal(std::span(name.name, name.size), std::span(here.name, here.size))) return another();
  return tpm.unseal(open_half, sealed_half, key);
}

}  // namespace relievo::storage
