// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/service/side_tasks.h"

#include <algorithm>

namespace relievo::firmware {

SideTasks::SideTasks(Appliance& appliance) : appliance_(appliance) {
  appliance_.on_side_report([this](JobLane lane, const std::optional<Error>& error) { heard(lane, error); });
}

SideTasks::~SideTasks() {
  for (std::size_t i = 0; i < kJobLanes; ++i) appliance_.end_side_job(static_cast<JobLane>(i));
  appliance_.on_side_report({});
}

std::uint32_t SideTasks::send(JobLane lane, Work work, Done done, Whose whose) {
  auto task = std::make_unique<SideTask>();
  task->work = std::move(work);
  task->done = std::move(done);
  task->whose = whose;
  const std::uint32_t number = task->number = ++last_;
  queues_[std::size_t(lane)].waiting.push_back(std::move(task));
  turn();
  return number;
}

void SideTasks::turn() {
  for (std::size_t i = 0; i < kJobLanes; ++i) {
    Queue& queue = queues_[i];
    if (queue.running != nullptr || queue.waiting.empty()) continue;
    if (!appliance_.start_side_job(static_cast<JobLane>(i), *queue.waiting.front()))
      continue;  // a visitor has the thread
    queue.running = std::move(queue.waiting.front());
    queue.waiting.pop_front();
  }
}

void SideTasks::stop(std::uint32_t task) {
  for (std::size_t i = 0; i < kJobLanes; ++i) {
    Queue& queue = queues_[i];
    if (queue.running != nullptr && queue.running->number == task)
      return appliance_.cancel_side_job(static_cast<JobLane>(i));
    const auto at =
        std::ranges::find_if(queue.waiting, [task](const auto& one) { return one->number == task; });
    if (at == queue.waiting.end()) continue;
    const std::unique_ptr<SideTask> dropped = std::move(*at);
    queue.waiting.erase(at);
    return dropped->done(Error{Errc::Cancelled, "it was stopped"});
  }
}

void SideTasks::cancel() {
  for (std::size_t i = 0; i < kJobLanes; ++i) {
    std::erase_if(queues_[i].waiting, [](const auto& task) { return task->whose == Whose::Page; });
    if (queues_[i].running == nullptr || queues_[i].running->whose == Whose::Device) continue;
    queues_[i].running->forgotten = true;
    appliance_.cancel_side_job(static_cast<JobLane>(i));
  }
}

void SideTasks::heard(JobLane lane, const std::optional<Error>& error) {
  const std::unique_ptr<SideTask> ended = std::move(queues_[std::size_t(lane)].running);
  if (ended != nullptr && !ended->forgotten) ended->done(error);
  turn();
}

}  // namespace relievo::firmware
