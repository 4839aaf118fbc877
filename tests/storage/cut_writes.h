// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A process that dies at its n-th write to a store, half of which is done. A kill, not a power cut: what was
// written before stays, synced or not.
#pragma once

#include <functional>

namespace relievo::storage::test {

enum class Ended { Finished, Cut, Failed };

// Runs `work` in a child; it says whether it went well. Writes are counted from 1.
Ended cut_at_write(long write, const std::function<bool()>& work);

}  // namespace relievo::storage::test
