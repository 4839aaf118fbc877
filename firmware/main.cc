// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The one file that names implementations: which device, which store, which simulation.
#include <signal.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <time.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "firmware/base/process_memory.h"
#include "firmware/command/commands.h"
#include "firmware/demo/gallery.h"
#include "firmware/demo/hand_pairs.h"
#include "firmware/jobs/job_thread.h"
#include "hal/clock.h"
#include "hal/linux/device.h"
#include "hal/picture_file.h"
#include "hal/sim/device.h"
#include "hal/sim/held_board.h"
#include "hal/sim/replay/replay_device.h"
#include "hal/sim/sheet/sheet_photo.h"
#include "hal/sim/target/target_photo.h"
#include "hal/sound/speaker.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "storage/sqlite/sqlite_store.h"
#include "ui/platform/sdl_display.h"

namespace relievo::firmware {
namespace {

constexpr std::string_view kFolder = "folder:";
constexpr std::string_view kLinux = "linux";
constexpr std::string_view kDeviceFile = "/etc/relievo/board.toml";

// "linux", or "linux:FILE" with another file that says what is wired where.
Result<std::unique_ptr<hal::Device>> open_linux_device(std::string_view device) {
  const bool named = device.size() > kLinux.size();
  const auto options = hal::read_linux_device_file(named ? device.substr(kLinux.size() + 1) : kDeviceFile);
  if (!options && !named && options.error().code == Errc::NotFound)
    return Error{
        Errc::NotFound,
        "says what is wired where, and is not there: write it, see hal/linux/README.md (installed: share/doc/relievo/board.md)"}
        .at(kDeviceFile);
  if (!options) return options.error();
  return hal::make_linux_device(*options);
}

Result<std::unique_ptr<hal::Device>> open_device(std::string_view device) {
  if (device == "sim") {
    hal::SimDeviceOptions options;
    options.threads = pool_size();
    return hal::make_sim_device(options);
  }
  if (device.size() > kFolder.size() && device.starts_with(kFolder))
    return hal::make_folder_device(device.substr(kFolder.size()));
  if (device == kLinux ||
      (device.size() > kLinux.size() + 1 && device.starts_with(kLinux) && device[kLinux.size()] == ':'))
    return open_linux_device(device);
  return invalid("is no board: use sim, linux, linux:FILE, or folder:DIR with recorded pairs").at(device);
}

// The file of --key; or the one beside the store that the TPM sealed; or the credential that systemd hands
// this service; or the file beside the store.
std::shared_ptr<storage::KeySource> key_source(const Path& folder, const Path& named) {
  constexpr auto kAsBefore = storage::NextKey::AsBefore;
  if (!named.empty()) return storage::key_file(named, false, kAsBefore);
  auto beside = storage::key_file(folder / storage::kKeyFile, true, kAsBefore);
  if (storage::is_key_sealed_by_tpm(folder / storage::kKeyFile)) return beside;
  const char* credentials = getenv("CREDENTIALS_DIRECTORY");
  std::error_code ignored;
  if (const Path file = Path(credentials == nullptr ? "" : credentials) / storage::kKeyFile;
      credentials != nullptr && std::filesystem::exists(file, ignored))
    return storage::key_credential(file);
  return beside;
}

Result<std::unique_ptr<storage::Store>> open_store(const Path& folder, bool to_write, const Path& key,
                                                   const hal::Clock& clock, Console& console) {
  if (const auto kept = keep_out_of_swap(); !kept) console.say(std::string(kept.error().what.view()));
  storage::SqliteStoreOptions options;
  options.mode = to_write ? storage::OpenMode::ReadWrite : storage::OpenMode::ReadOnly;
  options.keys = key_source(folder, key);
  // An empty file is left where the disk was full.
  std::error_code missing;
  const auto bytes = std::filesystem::file_size(folder / storage::kStoreFile, missing);
  const bool first = to_write && (missing || bytes == 0);
  auto store = storage::open_sqlite_store(folder, clock, options);
  if (store && first)
    console.say(
        "a new store; its key " + std::string(options.keys->protects()) +
        ". Should the key be lost, recovery words open it: make them with relievo store recovery-words");
  return store;
}

std::unique_ptr<storage::StoreKeeping> keep_store(const Path& folder, const Path& key,
                                                  const hal::Clock& clock) {
  storage::SqliteStoreOptions options;
  options.keys = key_source(folder, key);
  return storage::keep_sqlite_store(folder, clock, options);
}

hal::sim::BoardPattern simulated(const BoardArgs& b) {
  return {b.corners_across,
          b.corners_down,
          b.square_mm,
          0.75 * b.square_mm,
          b.charuco ? hal::sim::BoardKind::Charuco : hal::sim::BoardKind::Chessboard,
          b.marker_mm,
          b.marker_bits};
}

Result<void> hold_picture(const HeldPictureArgs& held, const hal::sim::SimulationOptions& simulation,
                          const Path& folder) {
  RELIEVO_TRY_ASSIGN(const hal::Picture picture, hal::read_picture(held.picture));
  hal::sim::SheetPhotoOptions options;
  options.rig = simulation.rig;
  options.seed = simulation.seed;
  options.threads = pool_size();
  options.sheet.width_mm = held.width_mm;
  options.sheet.bend = {held.radius_mm, held.axis_deg, held.apex_mm, held.wave_mm};
  options.sheet.look.screen = held.screen;
  options.sheet.look.gloss = held.gloss;
  options.sheet.pose = simulation.pose;
  return photograph_sheet(picture, options, folder);
}

Result<void> simulate(const SimulateArgs& args, const Path& folder) {
  hal::sim::SimulationOptions options;
  options.scene = args.board ? hal::sim::SceneKind::Board : hal::sim::SceneKind::Head;
  if (args.visit) options.scene = hal::sim::SceneKind::Visit;
  options.drift = args.drift;
  if (!args.cast.empty())
    options.alive = args.cast == "open" ? hal::sim::Alive::CastEyesOpen : hal::sim::Alive::CastEyesClosed;
  options.seed = args.seed;
  options.truth = args.truth;
  options.pose = {args.yaw_deg, args.pitch_deg, args.roll_deg, args.distance_mm, args.right_mm, args.down_mm};
  options.board_in_this_pose = args.board && args.one_pose;
  options.board_poses = args.pairs;
  if (args.board) {
    options.board = simulated(args.printed);
    options.board_look = {args.lamp, args.shadow, args.highlight, args.cover};
    options.sensor.defocus_px = args.blur_px;
    options.sensor.noise = args.noise;
  }
  options.rig.width_px = int(options.rig.width_px * args.scale);
  options.rig.height_px = int(options.rig.height_px * args.scale);
  if (args.rig) {
    const IdealRigArgs& r = *args.rig;
    options.rig = {.width_px = r.width_px,
                   .height_px = r.height_px,
                   .focal_px = r.focal_px * 1920 / std::max(r.width_px, r.height_px),
                   .baseline_mm = r.baseline_mm,
                   .convergence_mm = r.convergence_mm,
                   .perturbation = 0};
  }
  if (args.portrait) std::swap(options.rig.width_px, options.rig.height_px);
  if (!args.held.picture.empty()) return hold_picture(args.held, options, folder);
  return hal::sim::render_to_folder(options, folder, pool_size());
}

Result<TargetPictures> photograph(const TargetShot& shot) {
  namespace sim = hal::sim;
  sim::TargetPhotoOptions options;
  options.rig.width_px = int(options.rig.width_px * shot.scale);
  options.rig.height_px = int(options.rig.height_px * shot.scale);
  options.rig.seed = options.seed = shot.seed;
  options.threads = pool_size();
  const OpticalTargets& t = shot.targets;
  const TargetPlace& p = shot.place;
  const sim::ArtefactPlace place{p.right_mm, p.down_mm, p.distance_mm, p.pitch_deg, p.yaw_deg, p.roll_deg};
  const auto take = [&]() -> Result<sim::PicturePair> {
    switch (shot.kind) {
      case TargetKind::Board:
        return photograph_board(options, {t.board_columns, t.board_rows, t.square_mm}, shot.number,
                                shot.count);
      case TargetKind::Dumbbell:
        return photograph_dumbbell(
            options, {t.sphere_diameter_mm, t.sphere_spacing_mm, t.rod_diameter_mm / 2, shot.seed}, place);
      case TargetKind::Plate: break;
    }
    return photograph_plate(options, {t.plate_width_mm, t.plate_height_mm, shot.seed}, place);
  };
  RELIEVO_TRY_ASSIGN(auto pair, take());
  return TargetPictures{std::move(pair.left), std::move(pair.right)};
}

// A hand's pose in the world of the simulated rig.
hal::sim::BodyPose pose_of(const HeldPose& held, const hal::sim::BoardPattern& board) {
  return hal::sim::HeldPlace{held.right_mm, held.down_mm,   held.distance_mm,
                             held.yaw_deg,  held.pitch_deg, held.roll_deg}
      .pose(board);
}

Result<std::unique_ptr<LivePairs>> hold_board(const CalibrateLiveArgs& args) {
  const hal::sim::BoardPattern pattern = simulated(args.board);
  RELIEVO_TRY(pattern.check());
  hal::sim::RigOptions rig;
  rig.seed = args.seed;
  hal::sim::SensorOptions sensor;
  sensor.grey = true;
  const auto board = std::make_shared<hal::sim::HeldBoard>(rig, pattern, sensor, pool_size());
  return make_hand_pairs(
      [board, pattern](const HeldPose& opened, const HeldPose& closed, std::uint64_t number) {
        auto pair = board->photograph(pose_of(opened, pattern), pose_of(closed, pattern), number);
        return HeldPair{std::move(pair.left), std::move(pair.right)};
      },
      args.seed);
}

// The rig writes what other tools read; the product reads it as it would anybody's.
Result<pipeline::StereoCalibration> simulated_calibration() {
  std::string folder = (std::filesystem::temp_directory_path() / "relievo-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr)
    return Error{Errc::IoFailed, "no temporary folder can be made: check TMPDIR"};
  const Path file = Path(folder) / "rig.yml";
  const Result<void> written = hal::sim::write_rig(file, hal::sim::make_rig({}));
  Result<pipeline::StereoCalibration> read =
      written ? pipeline::read_calibration(file) : Result<pipeline::StereoCalibration>(written.error());
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
  return read;
}

Result<void> set_system_clock(std::chrono::system_clock::time_point time) {
  const auto since = time.time_since_epoch();
  const auto whole = std::chrono::floor<std::chrono::seconds>(since);
  timespec at{};
  at.tv_sec = static_cast<time_t>(whole.count());
  at.tv_nsec = std::chrono::nanoseconds(since - whole).count();
  if (clock_settime(CLOCK_REALTIME, &at) != 0)
    return Error{Errc::Unsupported,
                 "the system's clock may not be set by this program: set it with timedatectl", errno};
  return {};
}

// A machine without a sound card is silent.
std::unique_ptr<hal::Speaker> open_speaker() {
  auto speaker = hal::open_sdl_speaker(hal::find_headphone_jack());
  return speaker ? std::move(*speaker) : nullptr;
}

Result<void> plug_stick(hal::Device& device, const std::string& folder) {
  auto* const stick = dynamic_cast<hal::FolderMedia*>(&device.media());
  if (stick == nullptr)
    return Error{Errc::Unsupported, "has real sticks: a script cannot plug them"}.at(device.name());
  if (folder.empty()) stick->unplug();
  else stick->plug(folder);
  return {};
}

}  // namespace
}  // namespace relievo::firmware

int main(int argc, char** argv) {
  namespace fw = relievo::firmware;
  const auto streams = fw::open_closed_streams();
  fw::Console console;
  if (!streams) {
    console.fail(streams.error());
    return 1;
  }
  ::signal(SIGXFSZ, SIG_IGN);   // a file that grows past a limit is an error like a full disk
  ::umask(::umask(077) & 077);  // whatever it was: what this program makes it may read and write itself
  const fw::CommandLine line = fw::parse_command_line(argc, argv);
  // compare opens no store, and measures memory.
  if (const auto forbidden = fw::forbid_core_dumps(std::holds_alternative<fw::CompareArgs>(line.command));
      !forbidden) {
    console.fail(forbidden.error());
    return 1;
  }
  const relievo::hal::MonotonicClock clock;
  fw::Services services{
      .open_device = fw::open_device,
      .open_store = [&](const fw::Path& folder,
                        bool to_write) { return fw::open_store(folder, to_write, line.key, clock, console); },
      .keep_store = [&](const fw::Path& folder) { return fw::keep_store(folder, line.key, clock); },
      .simulate = fw::simulate,
      .photograph = fw::photograph,
      .hold_board = fw::hold_board,
      .simulated_calibration = fw::simulated_calibration,
      .open_display = relievo::ui::open_sdl_display,
      .open_speaker = fw::open_speaker,
      .make_printer = [] { return relievo::hal::make_cups_printer(); },
      .find_presence_sensor = [] { return relievo::hal::find_presence_sensor(); },
      .console = console,
      .clock = clock,
      .set_clock = fw::set_system_clock,
      .plug_stick = fw::plug_stick,
      .turn_head = relievo::hal::turn_simulated_head,
      .take_screenshots = fw::take_screenshots,
      .allocations = fw::allocation_count()};
  return fw::run_command(line, services);
}
