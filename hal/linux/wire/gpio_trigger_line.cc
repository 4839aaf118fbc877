// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/linux/wire/gpio_trigger_line.h"

#include <algorithm>
#include <array>
#include <thread>

namespace relievo::hal {
namespace {

constexpr std::chrono::microseconds kWakesLate{100};

class BusyWaiter final : public Waiter {
 public:
  void until(Instant when) override {
    std::this_thread::sleep_until(when - kWakesLate);
    while (std::chrono::steady_clock::now() < when) {
    }
  }
};

struct Edge {
  std::chrono::microseconds at;
  Wire wire;
  bool active;
};

}  // namespace

Waiter& busy_waiter() {
  static BusyWaiter waiter;
  return waiter;
}

Result<void> GpioTiming::check() const {
  for (const auto time : {delay, lamp_lead, lamp_time})
    if (time.count() < 0 || time > TriggerLine::kLongestPulse)
      return invalid("the trigger's delay and the lamp's times are from 0 to 0.1 s");
  if (!lamp_on_trigger_wire && lamp_time.count() > 0 && lamp_time <= lamp_lead)
    return invalid("the lamp is lit for longer than its lead, or the cameras expose in the dark");
  return {};
}

void GpioTriggerLine::rest() {
  // A line that cannot be set inactive was not set active either, or its chip is gone.
  (void)lines_->set(Wire::Trigger, false).has_value();
  (void)lines_->set(Wire::Lamp, false).has_value();
}

Result<void> GpioTriggerLine::drive(std::chrono::microseconds width, bool lit) {
  const auto lead = lit ? timing_.lamp_lead : std::chrono::microseconds(0);
  const auto on = std::max(timing_.delay, lead);
  const auto lamp = timing_.lamp_time.count() > 0 ? timing_.lamp_time : lead + width;
  std::array<Edge, 4> edges{{{on - lead, Wire::Lamp, true},
                             {on, Wire::Trigger, true},
                             {on + width, Wire::Trigger, false},
                             {on - lead + lamp, Wire::Lamp, false}}};
  std::ranges::stable_sort(edges, [](const Edge& a, const Edge& b) { return a.at < b.at; });
  const Instant begin = clock_.now();
  for (const Edge& edge : edges) {
    if (edge.wire == Wire::Lamp && !lit) continue;
    waiter_.until(begin + edge.at);
    RELIEVO_TRY(lines_->set(edge.wire, edge.active));
  }
  return {};
}

Result<void> GpioTriggerLine::do_pulse(std::chrono::microseconds width, Light light) {
  Result<void> done = drive(width, light == Light::Flash && !timing_.lamp_on_trigger_wire);
  if (!done) rest();
  return done;
}

}  // namespace relievo::hal
