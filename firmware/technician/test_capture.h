// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TestCapture: what the technician's picture pages work on. A test capture is a session without a subject:
// its pictures and what the stages make of them lie in the appliance's own memory while the state is
// Staff, and are wiped when the technician leaves or is away too long. Its jobs run on the appliance's
// threads; the screen never waits.
//
//   Empty --Capture--> Capturing --> Running --> Ready or Failed --Run--> Running ...     another state -->
//   Empty any but Capturing and Running --Load--> Running --> Ready or Failed: what was saved, with its
//   calibration and algorithms
//
// It borrows the session from the appliance and sends its work as side tasks (firmware/service/side_tasks.h);
// it listens only in the states Staff and Calibrate, and forgets everything in any other. Thread: main.
// Errors: none are returned; the view has them as a sentence.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware/appliance/appliance.h"
#include "firmware/base/boot_memory.h"
#include "firmware/base/list_walk.h"
#include "firmware/records/event_log.h"
#include "firmware/service/export_records.h"
#include "firmware/service/side_tasks.h"
#include "firmware/technician/show/technician_figures.h"
#include "firmware/technician/show/technician_pictures.h"
#include "firmware/technician/stick_files.h"
#include "firmware/technician/technician_jobs.h"
#include "firmware/work/pipeline_stages.h"
#include "hal/base/arena.h"
#include "hal/recording/capture_file.h"
#include "pipeline/algorithms.h"
#include "pipeline/model/stereo_frame.h"
#include "storage/store.h"
#include "ui/technician/technician_view.h"
#include "ui/view/staff_request.h"

namespace relievo::firmware {

// AlgorithmController: every algorithm there is, the set that is chosen, and the option that is being edited.
// What is typed is checked by AlgorithmSet alone: what it refuses stays as it was, and view() says why.
//
//   kind --choose_name()--> name --edit()--> option --type() ... use()--> set()
//
// Indices that do not exist change nothing. Thread: main. Errors: none.
class AlgorithmController {
 public:
  AlgorithmController();
  void begin(const pipeline::AlgorithmSet& set);
  // False: that is nothing of the algorithms'.
  bool act(const ui::TechnicianRequest& request);
  const pipeline::AlgorithmSet& set() const { return set_; }
  // Until the next change.
  ui::TechnicianChoice view() const;

 private:
  bool act_alone(ui::TechnicianAct act);
  void rebuild();
  void choose_name(std::size_t index);
  void edit(std::size_t index);
  void type(char letter);
  void use(const std::string& value);

  std::vector<pipeline::OptionDescription> all_;
  pipeline::AlgorithmSet set_;
  std::size_t kind_ = 0;
  std::size_t edited_ = 0;  // index into options_, if any
  bool editing_ = false;
  std::string typed_, refused_;
  std::vector<const pipeline::OptionDescription*> kinds_, shown_;  // of all_
  std::vector<std::string> kind_values_, option_values_;
  std::vector<ui::TechnicianKind> kind_views_;
  std::vector<ui::TechnicianName> names_;
  std::vector<ui::TechnicianOption> options_;
};

// Where the store keeps the set that visitors are measured with, as AlgorithmSet::to_text().
inline constexpr const char* kAlgorithmsSetting = "algorithms";

// What the technician's pages work with.
struct TechnicianParts {
  Appliance& appliance;
  SideTasks& side_tasks;
  hal::Device& device;
  PipelineStages& stages;  // replaced when another calibration comes into use
  ThreadPool& pool;
  storage::Store& store;
  EventLog& log;
  ShowBoards show_boards;                                          // see CalibrateJob
  std::function<void(const pipeline::StereoCalibration&)> in_use;  // another calibration is
};

// CalibrationController: the technician's page on calibrations: which board is shown, the live calibration
// with its verdict, what is stored and which of it is in use; calibrations to a stick and from it. A refused
// calibration cannot be stored.
//
//   idle --begin()--> running (the machine's state Calibrate) --ended--> verdict --store()--> history
//
// Thread: main; store and pipelines are the keeper's. Errors: none are returned, view() has them as a
// sentence.
class CalibrationController {
 public:
  CalibrationController(const TechnicianParts& parts, CalibrateJob& job) : parts_(parts), job_(job) {}

  // The board, the stored ones; beginning and stopping are the test capture's, since the machine takes part.
  void act(const ui::TechnicianRequest& request);
  CalibrateJob::Order order() const;
  void begun();
  // The job has.
  void ended();
  void load_history();
  void walk(const ui::ListRequest& request);
  ui::TechnicianCalibration view();
  void forget();
  bool running() const { return running_; }
  // Visitors are measured with it from now on, or, if one is here, as soon as that visit has ended.
  // `calibrated`: its calibration is another one.
  void use(pipeline::Pipeline pipeline, bool calibrated);
  // What is in use, or soon will be. Main; on the keeper within a side task, since use() waits for those.
  const pipeline::AlgorithmSet& algorithms() const;
  const pipeline::StereoCalibration* calibration() const;
  // Every turn of the main loop, also when the technician has gone.
  void turn();

 private:
  void change_board(const ui::ChangeBoard& change);
  struct Row {
    storage::CalibrationInfo info;
    std::string made_at;
  };
  void store();
  void activate(std::size_t row);
  // By stick (stick_files.h). None of another size than the cameras' pictures comes into use.
  void export_in_use();
  void import_one();
  // Makes it the one in use, once the keeper has done `first`, which names it. `calibrated`: by which of the
  // job's runs it was made; 0: by none.
  void adopt(std::function<Result<std::uint32_t>()> first, std::uint32_t calibrated = 0);

  const TechnicianParts& parts_;
  CalibrateJob& job_;
  BoardArgs board_{10, 7, 20};
  bool mounted_anew_ = false;  // the next calibration need not have the cameras' distance of the one in use
  bool running_ = false, ended_ = false, stored_ = false;
  std::uint32_t runs_ = 0;  // of the job
  ui::Fault problem_;
  std::string exported_;  // the folder on the stick
  std::vector<std::string> reasons_;
  std::vector<float> views_px_;
  std::vector<Row> history_;
  ListWalk walk_{ui::kCalibrationRows};
  bool busy_ = false;        // the keeper is at it
  std::uint32_t visit_ = 0;  // what a visit to the pages before this one asked for is not told here
  std::optional<pipeline::Pipeline> next_;  // comes into use when nobody is measured
  bool next_calibrated_ = false;
};

// RecordingController: the buttons that put the test capture or all of the reconstruction
// (stick_files.h) on the stick, and bring a saved one back; how far it is, how it ended, and where
// it lies. One at a time; who leaves ends it, and nothing half written stays; an end that comes later is not
// heard (SideTasks::cancel()). Thread: main; the stick is the keeper's. Errors: none are returned, view() has
// them, but what is wrong with a document goes to `refused`.
class RecordingController {
 public:
  RecordingController(SideTasks& side_tasks, hal::Device& device)
      : side_tasks_(side_tasks), device_(device) {}
  // The front, then the sides; `as_taken`: exposure and serial numbers.
  void record(std::span<const pipeline::StereoFrame> shots, const hal::RecordedPair& as_taken);
  // `make` runs on the worker: the document of what is in the session.
  void save(std::function<Result<SavedBytes>()> make);
  // Those on the stick; shown from then on, until hide().
  void list();
  void hide() { files_.reset(); }
  // `read` hears the bytes of a whole document.
  void load(std::size_t row, std::function<void(SavedBytes)> read, std::function<void(const Error&)> refused);
  void stop();
  // Of what list() has found: without its ending, as shown_name().
  std::string saved_name(std::size_t row) const;
  // There is another capture now.
  void capture_gone();
  void forget();
  ui::TechnicianRecording view() const;
  ui::TechnicianSaved saved() const {
    return files_ ? ui::TechnicianSaved{true, shown_} : ui::TechnicianSaved{};
  }

 private:
  // False: something else runs.
  bool begin();
  void write(SavedBytes document);
  void ended(const std::optional<Error>& error, const ExportTrace& trace, const std::string& where);

  SideTasks& side_tasks_;
  hal::Device& device_;
  std::string where_;
  ui::Outcome outcome_ = ui::Outcome::None;
  bool running_ = false;
  bool stopped_ = false;    // a document whose making does not look at it: then it is not written
  std::uint32_t task_ = 0;  // what runs
  std::optional<std::vector<std::string>> files_;  // on the stick, while they are shown ...
  std::vector<std::string> shown_;                 // ... under these names
};

// KeptResults: results that were put aside, to be looked at beside the present one: figures, the left picture
// of every stage, and the model, to be turned. Each has its own memory of fixed size (budget::kKeptModelBytes
// and its pictures'); pages nobody touched cost nothing. A model that is larger is left out: its pictures are
// not. A comparison with the present surface runs on the worker; until it has ended they stay as they are.
// Thread: main, while no other job runs. Errors: none.
class KeptResults {
 public:
  static_assert(ui::kCompared == budget::kKeptResults + 1);

  KeptResults();
  // Behind the others; nothing happens where there is no room. `model` may be missing; no two have the same
  // number.
  void keep(const TechnicianFigures& figures, const TechnicianPictures& pictures,
            const pipeline::FaceModel* model, std::uint32_t number);
  // Those behind it move up.
  void drop(std::size_t which);
  void wipe();
  std::size_t count() const { return count_; }
  bool full() const { return count_ == all_.size(); }
  bool has(std::uint32_t number) const;
  // Each surface against the present one of that number, as the present capture's left view sees both; once
  // a number. `present` stays as it is until then.
  void compare_on_worker(SideTasks& tasks, const Products& present, std::uint32_t number);
  bool is_compared_with(std::uint32_t number) const;
  ui::TechnicianDifference difference(std::size_t which) const { return all_[which]->difference.view(); }
  float full_colour_mm() const { return full_colour_mm_; }  // of all differences
  // Until the next change.
  ui::TechnicianCompared view(std::size_t which, ui::TechnicianStage stage) const;

 private:
  void compare(const pipeline::RectifiedPair& pair, const pipeline::FaceMesh& present, std::uint32_t number,
               const std::atomic<bool>& cancelled);

  struct One {
    One();
    void wipe();
    TechnicianFigures figures;
    TechnicianPictures pictures{false};
    PageBlock block;
    Arena memory;
    std::optional<pipeline::FaceModel> model;
    std::uint32_t number = 0;
    SurfaceDifference difference;
    std::uint32_t compared_with = 0;
  };
  std::array<std::unique_ptr<One>, budget::kKeptResults> all_;
  std::span<const std::unique_ptr<One>> kept() const { return std::span(all_).first(count_); }
  std::size_t count_ = 0;
  bool comparing_ = false;
  float full_colour_mm_ = 0;
  std::uint32_t coloured_ = 0;  // so many surfaces have been
};

class TestCapture {
 public:
  explicit TestCapture(TechnicianParts parts);
  ~TestCapture();
  TestCapture& operator=(TestCapture&&) = delete;

  // What a page asked for.
  void act(const ui::TechnicianRequest& request);
  // What a page has under way only while it is open begins and ends with it.
  void opened(ui::StaffPage page);
  void closed(ui::StaffPage page);
  // Every turn of the main loop, whatever page is open.
  void turn();
  // Valid until the next turn() or act().
  const ui::TechnicianView& view();

 private:
  enum class Next : std::uint8_t { None, Shot, Side, Calibration, Loaded };  // waits for the capture thread
  bool at_rest() const {
    return told_.phase == ui::TechnicianPhase::Ready || told_.phase == ui::TechnicianPhase::Failed;
  }
  Products* products() { return at_rest() && session_.is_open() ? &session_.products() : nullptr; }
  TechnicianTables::Source source() { return {products(), run_.figures(), calibration()}; }
  void leave();
  void wait_for_cameras(Next what);
  void begin_next();
  void forget_capture();
  void shoot(bool side);
  void calibrate();
  void run(std::int64_t latest);
  void send_run();
  void save();
  void load(std::size_t row, bool beside);
  void take_over();
  const pipeline::StereoCalibration* calibration() const;
  void stop();
  void shot_done(const std::optional<Error>& error);
  void run_done(const std::optional<Error>& error);
  void touch(const ui::TouchPicture& touch);
  void apply_set();
  void want_watch(bool on);
  void begin_watch();
  void act_alone(ui::TechnicianAct act);
  void keep_result();
  void record();
  bool is_calibrated();
  bool may_add_side() const;
  void say(const Error& error) { told_.problem = ui::fault_of(error); }
  void look_at_poses(const pipeline::Registration& registration);

  TechnicianParts parts_;
  EnrolmentSession& session_;
  TestShotJob shot_;
  RunJob run_;
  CameraWatchJob watch_;
  CalibrateJob calibrate_;
  CalibrationController calibrations_;
  RecordingController recording_;
  AlgorithmController algorithms_;
  TechnicianTables tables_;
  ui::StaffPage page_ = ui::StaffPage::Stages;  // opened last
  KeptResults kept_;
  ui::TechnicianView told_;  // phase, stage, problem, and what is switched on: shown as they are
  ui::TechnicianPoint point_;
  HandPairs pairs_;
  Next next_ = Next::None;
  std::uint32_t taking_ = 0, working_ = 0;  // the last side tasks of the capture thread and the worker
  struct Saved {
    SavedBytes bytes;
    std::string name;
    Making making;
    bool beside = false;  // what is there is put aside before
  };
  std::optional<Saved> saved_;  // read from the stick, to be loaded
  bool loaded_ = false;         // what is in the session was, with a calibration of its own
  bool watch_wanted_ = false;   // of the cameras, by whoever is on their page ...
  bool watching_ = false;       // ... and under way
  bool applying_ = false;       // the algorithms: visitors soon will be measured with them
  std::uint32_t visit_ = 0;     // what a technician asked for who has left is not told the next one
  bool left_ = true;            // for another state
  std::uint32_t model_number_ = 0;
  ui::TechnicianView view_;
};

}  // namespace relievo::firmware
