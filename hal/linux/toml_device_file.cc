// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <toml++/toml.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

#include "hal/base/whole_file.h"
#include "hal/linux/device.h"
#include "hal/raw/raw_image.h"

namespace relievo::hal {
namespace {

constexpr std::size_t kMostBytes = 64 * 1024;

// Reads tables of known words; the first thing wrong is kept, with its place.
class Words {
 public:
  Words(const toml::table& root, std::string file) : root_(root), file_(std::move(file)) {}

  const toml::table* table(std::string_view name, std::initializer_list<std::string_view> words) {
    const toml::node* node = root_.get(name);
    if (node == nullptr) return nullptr;
    const toml::table* found = node->as_table();
    if (found == nullptr) {
      wrong(node, name);
      return nullptr;
    }
    for (const auto& [key, value] : *found)
      if (std::ranges::find(words, key.str()) == words.end()) wrong(&value, key.str());
    return found;
  }
  void only_tables(std::initializer_list<std::string_view> names) {
    for (const auto& [key, value] : root_)
      if (std::ranges::find(names, key.str()) == names.end()) wrong(&value, key.str());
  }
  template <typename T>
  T get(const toml::table& table, std::string_view word, T otherwise, bool must = false) {
    const toml::node* node = table.get(word);
    if (node == nullptr) {
      if (must) wrong(&table, word);
      return otherwise;
    }
    const auto value = node->value_exact<T>();
    if (!value) wrong(node, word);
    return value.value_or(otherwise);
  }
  std::string path(const toml::table& table, std::string_view word) {
    auto value = get<std::string>(table, word, {}, true);
    const auto is_control = [](unsigned char c) { return c < ' ' || c == 127; };
    if (!value.starts_with('/') || std::ranges::any_of(value, is_control))
      wrong(table.get(word), std::string(word) + ": the whole path, from / on");
    return value;
  }
  std::int64_t number(const toml::table& table, std::string_view word, std::int64_t least, std::int64_t most,
                      std::int64_t otherwise, bool must = false) {
    const auto value = get<std::int64_t>(table, word, otherwise, must);
    if (table.get(word) != nullptr && (value < least || value > most)) wrong(table.get(word), word);
    return value;
  }
  void wrong(const toml::node* node, std::string_view word) {
    if (problem_) return;
    const auto line = node == nullptr ? 0 : node->source().begin.line;
    problem_ =
        invalid(
            "this word is missing, unknown or cannot be used: see hal/linux/README.md (installed: share/doc/relievo/board.md)")
            .at(file_ + (line > 0 ? " line " + std::to_string(line) : std::string()) + ": " +
                std::string(word));
  }
  const std::optional<Error>& problem() const { return problem_; }

 private:
  const toml::table& root_;
  std::string file_;
  std::optional<Error> problem_;
};

V4l2CameraOptions camera_of(Words& words, const toml::table& table, bool triggered) {
  V4l2CameraOptions camera;
  camera.device = words.path(table, "device");
  camera.serial = words.get<std::string>(table, "serial", {});
  camera.triggered = triggered;
  const auto format = words.get<std::string>(table, "format", {});
  if (!format.empty() && format.size() != 4) words.wrong(table.get("format"), "format");
  for (std::size_t i = 0; i < format.size() && i < 4; ++i)
    camera.fourcc |= std::uint32_t(static_cast<unsigned char>(format[i])) << (8 * i);
  return camera;
}

void read_wires(Words& words, LinuxDeviceOptions& options) {
  const std::int64_t longest = TriggerLine::kLongestPulse.count();
  const toml::table* trigger = words.table("trigger", {"chip", "line", "active_low", "delay_us"});
  const toml::table* lamp = words.table("lamp", {"line", "lead_us", "time_us", "on_trigger_wire"});
  if (lamp != nullptr && trigger == nullptr) words.wrong(lamp, "[lamp] without [trigger]");
  if (trigger == nullptr) return;
  GpioOptions gpio;
  gpio.chip = words.path(*trigger, "chip");
  gpio.trigger = unsigned(words.number(*trigger, "line", 0, 4095, 0, true));
  gpio.active_low = words.get<bool>(*trigger, "active_low", false);
  options.timing.delay = std::chrono::microseconds(words.number(*trigger, "delay_us", 0, longest, 0));
  if (lamp != nullptr) {
    options.timing.lamp_on_trigger_wire = words.get<bool>(*lamp, "on_trigger_wire", false);
    options.timing.lamp_lead = std::chrono::microseconds(words.number(*lamp, "lead_us", 0, longest, 0));
    options.timing.lamp_time = std::chrono::microseconds(words.number(*lamp, "time_us", 0, longest, 0));
    if (!options.timing.lamp_on_trigger_wire && options.timing.lamp_time.count() > 0 &&
        options.timing.lamp_time <= options.timing.lamp_lead)
      words.wrong(lamp->get("time_us"), "time_us: longer than lead_us, or the cameras expose in the dark");
    if (options.timing.lamp_on_trigger_wire && lamp->contains("line"))
      words.wrong(lamp->get("line"), "line: none with on_trigger_wire = true");
    if (!options.timing.lamp_on_trigger_wire)
      gpio.lamp = unsigned(words.number(*lamp, "line", 0, 4095, 0, true));
  }
  options.trigger = gpio;
}

Result<LinuxDeviceOptions> options_of(const toml::table& root, const std::string& file) {
  Words words(root, file);
  words.only_tables({"mode", "left", "right", "both", "trigger", "lamp", "stick", "watchdog"});
  LinuxDeviceOptions options;
  if (const toml::table* mode = words.table("mode", {"width_px", "height_px", "exposure_us"})) {
    options.mode.width_px = int(words.number(*mode, "width_px", 16, kMaxRawSidePx, 0, true));
    options.mode.height_px = int(words.number(*mode, "height_px", 16, kMaxRawSidePx, 0, true));
    options.mode.exposure = std::chrono::microseconds(words.number(*mode, "exposure_us", 1, 100'000, 0));
  } else {
    words.wrong(nullptr, "[mode]");
  }
  read_wires(words, options);
  if (const toml::table* stick = words.table("stick", {"folder"})) {
    options.stick_folder = words.path(*stick, "folder");
  }
  if (const toml::table* table = words.table("watchdog", {"device", "timeout_s"})) {
    WatchdogOptions watchdog;
    if (table->contains("device")) watchdog.device = words.path(*table, "device");
    watchdog.timeout =
        std::chrono::seconds(words.number(*table, "timeout_s", 2, 300, watchdog.timeout.count()));
    options.watchdog = watchdog;
  }
  const toml::table* left = words.table("left", {"device", "serial", "format"});
  const toml::table* right = words.table("right", {"device", "serial", "format"});
  const toml::table* both = words.table("both", {"device", "serial", "format"});
  if (both != nullptr && left == nullptr && right == nullptr) {
    options.left = camera_of(words, *both, options.trigger.has_value());
  } else if (both == nullptr && left != nullptr && right != nullptr) {
    options.left = camera_of(words, *left, options.trigger.has_value());
    options.right = camera_of(words, *right, options.trigger.has_value());
    if (options.left.device == options.right->device)
      words.wrong(right->get("device"), "device: the same as left's");
  } else {
    words.wrong(nullptr, "either [left] and [right], or [both]");
  }
  if (words.problem()) return *words.problem();
  return options;
}

}  // namespace

Result<LinuxDeviceOptions> read_linux_device_file(const std::filesystem::path& file) {
  RELIEVO_TRY_ASSIGN(const std::vector<std::byte> bytes, read_whole_file(file, kMostBytes));
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  try {
    return options_of(toml::parse(text, file.native()), file.native());
  } catch (const toml::parse_error& error) {
    return invalid("this is not valid TOML: see hal/linux/README.md (installed: share/doc/relievo/board.md)")
        .at(file.native() + " line " + std::to_string(error.source().begin.line));
  }
}

}  // namespace relievo::hal
