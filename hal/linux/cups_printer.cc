// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/linux/device.h"

#include <cups/cups.h>

namespace relievo::hal {
namespace {

constexpr const char* kTitle = "Relievo";  // what a queue shows tells nothing of the person

struct FreeDestination {
  void operator()(cups_dest_t* destination) const { cupsFreeDests(1, destination); }
};
using Destination = std::unique_ptr<cups_dest_t, FreeDestination>;

class CupsPrinter final : public Printer {
 public:
  bool is_there() override { return usual() != nullptr; }

  Result<void> print(std::span<const std::byte> png) override {
    const Destination to = usual();
    if (to == nullptr)
      return Error{Errc::NotFound, "CUPS has no default printer: choose one with lpadmin -d"};
    const std::unique_ptr<cups_dinfo_t, void (*)(cups_dinfo_t*)> info(
        cupsCopyDestInfo(CUPS_HTTP_DEFAULT, to.get()), cupsFreeDestInfo);
    int job = 0;
    const bool taken = info != nullptr &&
                       cupsCreateDestJob(CUPS_HTTP_DEFAULT, to.get(), info.get(), &job, kTitle, 0, nullptr) ==
                           IPP_STATUS_OK &&
                       cupsStartDestDocument(CUPS_HTTP_DEFAULT, to.get(), info.get(), job, kTitle,
                                             "image/png", 0, nullptr, 1) == HTTP_STATUS_CONTINUE &&
                       cupsWriteRequestData(CUPS_HTTP_DEFAULT, reinterpret_cast<const char*>(png.data()),
                                            png.size()) == HTTP_STATUS_CONTINUE &&
                       cupsFinishDestDocument(CUPS_HTTP_DEFAULT, to.get(), info.get()) == IPP_STATUS_OK;
    // What is left of it would hold a part of somebody's code.
    if (!taken && job > 0) cupsCancelDestJob(CUPS_HTTP_DEFAULT, to.get(), job);
    if (!taken) return Error{Errc::IoFailed, "the printer does not take it: look at its queue (lpstat -p)"};
    return {};
  }

 private:
  static Destination usual() { return Destination(cupsGetNamedDest(CUPS_HTTP_DEFAULT, nullptr, nullptr)); }
};

}  // namespace

std::unique_ptr<Printer> make_cups_printer() { return std::make_unique<CupsPrinter>(); }

}  // namespace relievo::hal
