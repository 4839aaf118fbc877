// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/service/page_controller.h"

#include <fstream>
#include <functional>
#include <memory>

#include "firmware/report/report.h"

namespace relievo::firmware {
namespace {

constexpr std::chrono::seconds kEvery{2};
constexpr double kMiB = 1048576.0;

double mib(std::size_t bytes) { return double(bytes) / kMiB; }

ui::Mood mood_of(double used, double of) {
  return used > of ? ui::Mood::Bad : used > 0.9 * of ? ui::Mood::Warn : ui::Mood::Good;
}

class HealthController final : public PageController {
 public:
  using PageController::PageController;
  void opened() override {
    open_ = true;
    ready_ = false;
    look();
  }

  // What is under way is forgotten with the page.
  void closed() override { open_ = looking_ = false; }

  void turn() override {
    if (!looking_ && services().device.clock().now() >= next_kept_ &&
        !services().side_tasks.busy(JobLane::Keeper))
      look();
  }

  void show(ui::ServiceView& view) override {
    if (!looking_ && services().device.clock().now() >= next_look_) look();
    if (!ready_) return;
    rows_.clear();
    add_memory();
    add_seen();
    faults_ = services().log.faults();
    view_.gauges = rows_;
    view_.faults = faults_;
    view.health = &view_;
  }

 private:
  struct Seen {
    std::vector<Sensor> sensors;
    double disk_used_mib = 0, disk_mib = 0, process_mib = 0;
  };

  void look() {
    looking_ = true;
    services().side_tasks.ask(
        JobLane::Keeper,
        [folder = services().folder](JobControl&) -> Result<Seen> {
          std::error_code none;
          const auto room = std::filesystem::space(folder, none);
          if (none) return Error{Errc::IoFailed, "the disk's room cannot be told"};
          return Seen{read_temperatures("/sys/class/thermal"), mib(room.capacity - room.available),
                      mib(room.capacity), mib(peak_rss_bytes())};
        },
        [this](const Result<Seen>& seen) {
          looking_ = false;
          next_look_ = services().device.clock().now() + kEvery;
          if (seen) {
            seen_ = *seen;
            ready_ = true;
          }
          keep(seen);
        },
        open_ ? SideTasks::Whose::Page : SideTasks::Whose::Device);
  }

  // Not every look: nor does a disk that fails fill the log.
  void keep(const Result<Seen>& seen) {
    const hal::Instant now = services().device.clock().now();
    if (now < next_kept_) return;
    next_kept_ = now + DayRing::kEvery;
    if (!seen) return services().log.fault(seen.error());
    const auto hottest = std::ranges::max_element(seen_.sensors, {}, &Sensor::celsius);
    hottest_.add(hottest != seen_.sensors.end() ? hottest->celsius
                                                : std::numeric_limits<double>::quiet_NaN());
    disk_.add(seen_.disk_used_mib);
  }

  // Of the last visits, over restarts, and of this run.
  void add_memory() {
    view_.costs = services().costs.view();
    view_.costs.planned_stage_mib = float(mib(services().appliance.session().stage_bytes()));
    double stages = 0;
    for (const ui::StageCost& cost : view_.costs.stages) stages = std::max(stages, double(cost.mib));
    const auto plan = double(view_.costs.planned_stage_mib);
    const double all = mib(budget::appliance_bytes(services().device.preferred_mode().pixels())),
                 resident = std::max(seen_.process_mib, double(view_.costs.resident_mib));
    rows_.push_back({ui::Gauge::Stages, {}, stages, plan, mood_of(stages, plan)});
    rows_.push_back({ui::Gauge::Process, {}, resident, all, mood_of(resident, all)});
  }

  void add_seen() {
    rows_.push_back({ui::Gauge::Disk,
                     {},
                     seen_.disk_used_mib,
                     seen_.disk_mib,
                     mood_of(seen_.disk_used_mib, seen_.disk_mib),
                     disk_.values()});
    // The hottest with its day, then the others.
    std::ranges::stable_sort(seen_.sensors, std::greater{}, &Sensor::celsius);
    for (const Sensor& sensor : seen_.sensors) {
      const ui::Mood mood = sensor.celsius >= ui::kHotCelsius    ? ui::Mood::Bad
                            : sensor.celsius >= ui::kWarmCelsius ? ui::Mood::Warn
                                                                 : ui::Mood::Good;
      rows_.push_back({ui::Gauge::Temperature, sensor.name, sensor.celsius, ui::kHotCelsius, mood,
                       &sensor == seen_.sensors.data() ? hottest_.values() : std::span<const float>()});
    }
  }

  bool open_ = false, looking_ = false;
  hal::Instant next_look_{}, next_kept_{};
  Seen seen_;
  DayRing hottest_, disk_;
  bool ready_ = false;
  std::vector<ui::GaugeRow> rows_;
  std::vector<ui::LogLine> faults_;
  ui::HealthView view_;
};

}  // namespace

std::unique_ptr<PageController> health_controller(PageServices& services) {
  return std::make_unique<HealthController>(services);
}

std::vector<Sensor> read_temperatures(const std::filesystem::path& thermal) {
  std::vector<Sensor> sensors;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(thermal, none)) {
    if (!entry.path().filename().string().starts_with("thermal_zone")) continue;
    std::ifstream temperature(entry.path() / "temp"), type(entry.path() / "type");
    double thousandths = 0;
    std::string name;
    if (!(temperature >> thousandths) || !std::getline(type, name)) continue;
    sensors.push_back({name, thousandths / 1000});
  }
  std::sort(sensors.begin(), sensors.end(), [](const Sensor& a, const Sensor& b) { return a.name < b.name; });
  return sensors;
}

}  // namespace relievo::firmware
