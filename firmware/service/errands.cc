// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/service/errands.h"

#include <utility>

namespace relievo::firmware {

Errands::Errands(Appliance& appliance) : appliance_(appliance) {
  appliance_.on_side_report(
      [this](JobPlace place, const std::optional<Error>& error) { heard(place, error); });
}

Errands::~Errands() {
  for (std::size_t i = 0; i < kJobPlaces; ++i) appliance_.end_side_job(static_cast<JobPlace>(i));
  appliance_.on_side_report({});
}

void Errands::send(JobPlace place, Work work, Done done, Whose whose) {
  auto errand = std::make_unique<Errand>();
  errand->work = std::move(work);
  errand->done = std::move(done);
  errand->whose = whose;
  lanes_[static_cast<std::size_t>(place)].waiting.push_back(std::move(errand));
  turn();
}

void Errands::turn() {
  for (std::size_t i = 0; i < kJobPlaces; ++i) {
    Lane& lane = lanes_[i];
    if (lane.running != nullptr || lane.waiting.empty()) continue;
    if (!appliance_.start_side_job(static_cast<JobPlace>(i), *lane.waiting.front()))
      continue;  // a visitor has the thread
    lane.running = std::move(lane.waiting.front());
    lane.waiting.pop_front();
  }
}

void Errands::cancel() {
  for (std::size_t i = 0; i < kJobPlaces; ++i) {
    std::erase_if(lanes_[i].waiting, [](const auto& errand) { return errand->whose == Whose::Page; });
    if (lanes_[i].running == nullptr || lanes_[i].running->whose == Whose::Device) continue;
    lanes_[i].running->forgotten = true;
    appliance_.cancel_side_job(static_cast<JobPlace>(i));
  }
}

void Errands::heard(JobPlace place, const std::optional<Error>& error) {
  const std::unique_ptr<Errand> ended = std::move(lanes_[static_cast<std::size_t>(place)].running);
  if (ended != nullptr && !ended->forgotten) ended->done(error);
  turn();
}

}  // namespace relievo::firmware
