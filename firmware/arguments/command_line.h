// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// CommandLine: what was asked for, as plain data. parse_command_line() checks words and numbers, of files
// only whether a picture that stands alone is a folder: a file that is missing is the command's error
// (exit 1), a wrong word the caller's (exit 2). Thread: main.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace relievo::firmware {

using Path = std::filesystem::path;

// The printed board.
struct BoardArgs {
  int corners_across = 0;  // inner corners
  int corners_down = 0;
  double square_mm = 0;
  bool charuco = false;  // else a chessboard
  double marker_mm = 0;  // ChArUco; 0: the usual share of a square
  int marker_bits = 4;
};

struct CalibrateArgs {
  Path pictures;
  BoardArgs board;
  Path output;
  Path report;                          // empty: none
  Path store;                           // empty: not stored
  std::optional<double> baseline_mm{};  // known distance of the cameras; 0: let it come out as it will
};

// calibrate --live
struct CalibrateLiveArgs {
  BoardArgs board;
  std::string cameras;  // "sim", before which a hand holds the board, or what Services::open_device takes
  unsigned seed = 1;    // of rig and hand
  double goal_mm = 0.1;
  std::optional<double> baseline_mm{};  // as in CalibrateArgs
  Path output;
  Path store;  // empty: not stored
};

// calibrate --print-pattern
struct PrintPatternArgs {
  BoardArgs board;
  Path output;
};

struct CalibrationArgs {
  enum class Verb { List, Show, Import, Export, Activate } verb = Verb::List;
  Path file;                        // import: what is read; export: what is written
  Path other;                       // import: the other half of a pair; empty: beside the first
  int width_px = 0, height_px = 0;  // import: of the pictures, where the files do not say
  double unit_mm = 0;               // import: of the translation; 0: the form's own
  std::string note;                 // import; empty: from which file
  Path source;                      // export: a file instead of the store
  bool ros = false;                 // export: a folder with left.yaml and right.yaml
  int revision = 0;                 // 0: the one in use
  Path store;
};

// How to reconstruct; shared by every command that does.
struct AlgorithmArgs {
  Path file;                          // TOML; empty: the default set
  std::vector<std::string> settings;  // "matcher=zmncc", "zmncc.window_px=15"
  bool whole_view = false;            // --region all
};

inline constexpr std::size_t kMostPairs = 7;  // of a head that turned

// What stands beside a model's files.
struct FurtherModels {
  int lod = 0;              // triangles of a lighter model, light.*; 0 for none
  bool watertight = false;  // a solid for printing, solid.*
};

struct ReconstructArgs {
  std::vector<Path> pictures;      // left, right; of a head that turned further pairs, the frontal one first
  std::vector<Path> calibrations;  // one for all pairs, or one each
  Path load;                       // a saved reconstruction, instead of those
  std::string
      from;      // of a saved one: match, reconstruct, mesh, texture, assemble; empty: as the settings ask
  Path save;     // empty: not saved
  Path by_hand;  // matches beside the matcher's; empty: those of a saved one, else none
  Path output;
  bool camera_frame = false;   // --frame camera
  bool despite_drift = false;  // go on though the cameras have moved
  FurtherModels further;
  AlgorithmArgs algorithms;
};

struct CompareArgs {
  std::vector<Path> pictures;                           // left, right, left, right, ...
  std::vector<Path> calibrations;                       // one for all pairs, or one each
  bool rectified = false;                               // the pictures are, and no rig is known
  int least_disparity_px = 0, most_disparity_px = 256;  // of rectified pairs
  std::vector<Path> truths;                             // none, one for all pairs, or one each
  double truth_scale = 1;                               // grey values per pixel of disparity
  double limit_px = 1;                                  // a disparity off by more is bad
  std::vector<Path> set_files;                          // TOML, a table a set
  std::vector<std::string> set_words;                   // "name: matcher=zmncc zmncc.window_px=21"
  std::vector<std::string> suites;
  bool keep_maps = false;  // every set's disparities as a file too
  Path output;
  AlgorithmArgs algorithms;  // what all sets start from
};

struct EnrolArgs {
  std::string device;
  std::string subject;
  Path calibration;  // empty: the one in the store
  Path store;
  AlgorithmArgs algorithms;
};

struct SubjectsArgs {
  enum class Verb { List, Show, Export, Import, Erase } verb = Verb::List;
  std::string subject;
  Path output;             // export
  FurtherModels further;   // export
  std::string recipient;   // export: the output is one file, sealed to them
  Path passphrase;         // export: or by what stands in this file; import: what it was sealed by
  Path copy;               // import: a file or folder that an export made
  Path identity;           // import: the key of age it was sealed to
  std::string signer;      // import: another device's key that is believed
  bool same_name = false;  // import: beside somebody of the same name
  Path store;
};

// What whoever administers the device does for its staff, the kiosk stopped.
struct StaffArgs {
  enum class Verb { ForgetPin, PlainTouch } verb = Verb::ForgetPin;
  bool technician = false;  // forget-pin: else the operator
  Path store;
};

// What whoever administers the device does with the store as a whole. What changes it waits until the kiosk
// is stopped.
struct StoreArgs {
  enum class Verb { Check, Log, Backup, Rekey, RecoveryWords, Recover } verb = Verb::Check;
  Path file;  // check: a copy to compare, may be empty; backup: where to; rekey: the key's new place, may be
              // empty
  bool tpm = false;  // rekey: sealed by the board's
  Path store;
};

// A picture that is held before the cameras.
struct HeldPictureArgs {
  Path picture;  // empty: none is
  double width_mm = 270;
  double radius_mm = 0, axis_deg = 0, apex_mm = 0, wave_mm = 0;  // how it is bent; hal/sim/sheet
  bool screen = false;
  double gloss = 0;
};

// Another rig than the kiosk's, without tolerances of assembly. No word of the command line.
struct IdealRigArgs {
  int width_px = 0, height_px = 0;
  double focal_px = 0, baseline_mm = 0, convergence_mm = 0;
};

struct SimulateArgs {
  bool board = false;  // the chessboard; else a face, or what is held
  bool visit = false;  // the face in all the poses of a visit
  double drift = 1;    // of a visit: how much the person's face moves between the pairs
  std::string cast;    // of a visit: a rigid cast, its eyes `open` or `closed`; empty: a person
  std::optional<IdealRigArgs> rig;
  HeldPictureArgs held;
  Path output;
  unsigned seed = 1;
  BoardArgs printed;
  double lamp = 0, shadow = 0, cover = 0, highlight = 0;
  double blur_px = 0.55;
  double noise = 1;       // times the usual
  int pairs = 14;         // of the board
  double scale = 1;       // of the picture's width and height
  bool portrait = false;  // cameras turned upright
  bool truth = false;     // write down what is true, beside the pictures
  bool one_pose = false;  // of the board: the pose below instead of many chosen by the seed
  double yaw_deg = 0, pitch_deg = 0, roll_deg = 0;
  double distance_mm = 560;
  double right_mm = 0, down_mm = 0;
};

struct SelfTestArgs {
  Path store;
  bool optical = false;  // measure targets instead
  Path output;           // of the optical one: report and pictures; empty: none
  unsigned seed = 1;     // the simulated rig and its noise
  double scale = 1;      // of its pictures
};
// Without a command: the kiosk.
struct KioskArgs {
  std::string device = "sim";
  Path calibration;  // empty: the one in the store; of the simulated rig, its own
  Path store;
  int width_px = 0, height_px = 0;  // of the window; 0: the whole screen
  Path screenshots;                 // take pictures of all screens into this folder, and end
  Path script;       // synthetic fingers play it, and the program ends; its pictures go to `screenshots`
  std::string only;  // of those, only the sheets whose name has this in it
  bool tells_known = true;             // is a visitor told that their name is in the records already?
  bool write_invitation_head = false;  // make the head of the page that invites, instead
};
struct AlgorithmsArgs {
  std::string name;  // of a kind or an algorithm; empty: all of them
};
struct MemoryArgs {
  Path store;  // of a kiosk whose last visits are shown beside the plan; empty: the plan alone
};
struct VersionArgs {};
struct NothingArgs {};  // help was asked for and printed, or the words were wrong

using CommandArgs =
    std::variant<NothingArgs, CalibrateArgs, CalibrateLiveArgs, PrintPatternArgs, CalibrationArgs,
                 ReconstructArgs, CompareArgs, EnrolArgs, SubjectsArgs, StaffArgs, StoreArgs, SimulateArgs,
                 SelfTestArgs, AlgorithmsArgs, MemoryArgs, VersionArgs, KioskArgs>;

struct CommandLine {
  CommandArgs command;
  int exit_code = 0;  // with NothingArgs: 0 help was printed, 2 the words were wrong
  Path key{};  // of the commands with a store: the file with the appliance's key; empty: its usual place
};

CommandLine parse_command_line(int argc, const char* const* argv);

}  // namespace relievo::firmware
