// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// InputSwitch: something of the machine that is on or off. Thread: its owner's. Errors: none.
#pragma once

namespace relievo::hal {

class InputSwitch {
 public:
  virtual ~InputSwitch() = default;
  virtual bool is_on() = 0;
};

}  // namespace relievo::hal
