// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// SideTasks: work the staff's pages have others do, so that the screen never waits. Each thread does one
// at a time, the others queue; what a side task found out is handed to `done` on the main thread.
//
//   send(thread, work, done) --> work() on that thread --> done(error or nothing) on main
//
// Work looks at its JobControl. What it finds goes to `done` by ask(); what it has written to must live as
// long as it runs: keep that in a shared_ptr that both closures hold. cancel() drops what waits of a page and
// asks what runs to end: its done() is not called any more. What belongs to the device (a PIN, a setting)
// ends, and is heard. Thread: main. Errors: those of the work.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

#include "firmware/appliance/appliance.h"

namespace relievo::firmware {

class SideTasks {
 public:
  using Work = std::function<Result<void>(JobControl&)>;
  using Done = std::function<void(const std::optional<Error>&)>;

  enum class Whose : std::uint8_t { Page, Device };

  explicit SideTasks(Appliance& appliance);
  ~SideTasks();
  SideTasks& operator=(SideTasks&&) = delete;

  // Its number, for stop(); none is 0.
  std::uint32_t send(JobLane lane, Work work, Done done, Whose whose = Whose::Page);
  // Of work that finds something: `heard` is called with that, or with why there is none (a Result).
  template <typename Find, typename Heard>
  std::uint32_t ask(JobLane lane, Find find, Heard heard, Whose whose = Whose::Page) {
    using Found = std::invoke_result_t<Find&, JobControl&>;
    const auto found = std::make_shared<std::optional<Found>>();
    return send(
        lane,
        [found, find = std::move(find)](JobControl& control) -> Result<void> {
          found->emplace(find(control));
          return **found ? Result<void>() : Result<void>((*found)->error());
        },
        [found, heard = std::move(heard)](const std::optional<Error>& error) {
          heard(error ? Found(*error) : *std::move(*found));
        },
        whose);
  }
  // Starts what waits and can start: once every turn.
  void turn();
  // One that waits is dropped: its done() hears Cancelled at once. One that runs is asked to end early: its
  // done() hears Cancelled, or that it was done already.
  void stop(std::uint32_t task);
  void cancel();
  bool busy(JobLane lane) const { return queues_[std::size_t(lane)].running != nullptr; }
  float progress(JobLane lane) const { return appliance_.side_progress(lane); }

 private:
  struct SideTask final : Job {
    Work work;
    Done done;
    Whose whose = Whose::Page;
    std::uint32_t number = 0;
    bool forgotten = false;
    Result<void> run(JobControl& control) override { return work(control); }
  };
  struct Queue {
    std::unique_ptr<SideTask> running;
    std::deque<std::unique_ptr<SideTask>> waiting;
  };
  void heard(JobLane lane, const std::optional<Error>& error);

  Appliance& appliance_;
  std::array<Queue, kJobLanes> queues_;
  std::uint32_t last_ = 0;
};

}  // namespace relievo::firmware
