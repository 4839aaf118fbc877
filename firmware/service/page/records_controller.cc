// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/service/page_controller.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <memory_resource>
#include <optional>
#include <string>
#include <vector>

#include "firmware/base/list_walk.h"
#include "firmware/base/wall_time.h"
#include "firmware/records/receipt.h"
#include "firmware/service/access.h"
#include "firmware/service/export_records.h"
#include "firmware/service/record_filter.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {
namespace {

// The models on the screen are numbered apart from the visitors'.
constexpr std::uint32_t kFirstModel = 1U << 20;
// What is found sooner needs no sign that it is looked for.
constexpr std::chrono::milliseconds kLongLook{300};

ui::RecordRow row_of(const storage::Subject& subject) {
  return {std::int64_t(subject.id), subject.name, text_of(subject.created_at), receipt_of(subject),
          subject.enrolments};
}

// Whom the choice lets pass; nothing: everybody.
using Passed = std::optional<std::vector<storage::SubjectId>>;

Result<Passed> passed_by(storage::Store& store, const RecordChoice& choice, JobControl& control) {
  if (choice.everybody()) return Passed();
  RELIEVO_TRY_ASSIGN(auto passed, chosen_records(store, choice, control));
  return Passed(std::move(passed));
}

Result<std::vector<storage::Subject>> rows_of(storage::Store& store, const Passed& passed, std::int64_t skip,
                                              std::int64_t limit) {
  if (!passed) return store.subjects({.skip = skip, .limit = limit});
  std::vector<storage::Subject> found;
  for (std::int64_t row = skip; row < std::min(std::int64_t(passed->size()), skip + limit); ++row) {
    RELIEVO_TRY_ASSIGN(auto subject, store.subject((*passed)[std::size_t(row)]));
    found.push_back(std::move(subject));
  }
  return found;
}

// Behind the page of records: search, show, erase, export, on the store. Every name it has read is given back
// to the heap when the page is left, which wipes it (base/wiping_heap.cc). Thread: main; the store's work
// runs on the keeper.
class RecordsController final : public PageController {
 public:
  using PageController::PageController;
  ~RecordsController() override { forget(); }
  void opened() override {
    forget();
    ++visit_;
    list();
  }

  void closed() override {
    ++visit_;
    if (exporting_) {
      services().side_tasks.stop(export_);
      services().appliance.ask(ui::Intent::Cancel);
    }
    exporting_ = false;
    forget();
  }

  void ask(const ui::StaffRequest& request) override {
    if (request.as<ui::StopExport>() != nullptr) return services().side_tasks.stop(export_);
    if (exporting_) return;
    erased_ = exported_ = false;
    outcome_ = ui::Outcome::None;
    trace_ = {};
    if (request.as<ui::FindRecords>() != nullptr) search(request.text());
    if (const auto* asked = request.as<ui::ListRequest>()) {
      if (const auto* chosen = std::get_if<ui::FilterList>(asked)) choose(chosen->filter);
      const ListWalk::Ask wanted = walk_.ask(*asked);
      if (wanted == ListWalk::Ask::Labels) label_stretches();
      else if (wanted == ListWalk::Ask::Filters) find_filters();
      else list();
    }
    if (const auto* show = request.as<ui::ShowRecord>()) load(show->record);
    if (const auto* gone = request.as<ui::EraseRecord>()) erase(gone->record);
    if (const auto* one = request.as<ui::ExportRecord>()) take_out(one->record);
    if (request.as<ui::ExportFound>() != nullptr) take_out(0);
  }

  void show(ui::ServiceView& view) override {
    view.work.outcome = outcome_;
    view.work.running = exporting_;
    view.work.progress = services().side_tasks.progress(JobLane::Keeper);
    if (!ready_) return;
    view_ = {found_,  walk_.view(), choice_.part, nullptr,      {},      {},
             erased_, exported_,    trace_.asked, trace_.whole, filters_};
    view_.looks = looks_ > 0 && services().device.clock().now() - looks_since_ > kLongLook;
    // The list may have been read anew since it was chosen.
    const auto chosen = choice_.filter ? std::ranges::find(filters_, *choice_.filter) : filters_.end();
    view_.place.filter = chosen != filters_.end() ? std::size_t(chosen - filters_.begin()) + 1 : 0;
    if (person_) {
      view_.shown = &person_->found;
      view_.consent = person_->consent;
      view_.consented_at = person_->consented_at;
      view.inner = true;
      if (person_->model) view.model = &*person_->model;
      view.model_number = kFirstModel + model_number_;
    }
    view.records = &view_;
  }

 private:
  static constexpr std::int64_t kPage = 50;
  struct Person {
    ui::RecordRow found;
    std::string consent, consented_at;
    std::pmr::monotonic_buffer_resource memory;
    std::optional<pipeline::FaceModel> model;
  };

  void forget() {
    found_ = std::vector<ui::RecordRow>();
    choice_.forget();
    person_.reset();
    filters_.clear();
    looks_ = 0;
    view_ = {};
    walk_.begin_anew();
    ready_ = erased_ = exported_ = false;
    outcome_ = ui::Outcome::None;
    trace_ = {};
  }

  void told(const std::optional<Error>& error) {
    outcome_ = error ? outcome_of(*error) : ui::Outcome::Done;
    if (error && error->code != Errc::Cancelled) services().log.fault(*error);
  }

  // On the keeper; `show` only if it went well and the page is still the same.
  template <typename Find, typename Show>
  void look(Find find, Show show) {
    if (looks_++ == 0) looks_since_ = services().device.clock().now();
    services().side_tasks.ask(JobLane::Keeper, std::move(find),
                              [this, show = std::move(show), visit = visit_](auto found) {
                                if (visit != visit_) return;
                                --looks_;
                                if (!found) return told(found.error());
                                show(*std::move(found));
                              });
  }

  // For work on the keeper: not moved, since a short name would stay where it was.
  std::shared_ptr<const RecordChoice> kept_choice() const {
    return std::make_shared<const RecordChoice>(choice_);
  }

  void search(std::string_view text) {
    choice_.forget();
    choice_.part = text;
    while (choice_.part.ends_with(' ')) choice_.part.pop_back();
    walk_.begin_anew();
    list();
  }

  void choose(std::size_t filter) {
    choice_.forget();
    if (filter > 0 && filter <= filters_.size()) choice_.filter = filters_[filter - 1];
  }

  void find_filters() {
    look([this](JobControl& control) { return record_filters(services().store, control); },
         [this](std::vector<ui::RecordFilter> found) {
           found.resize(std::min(found.size(), ui::kRecordFilters));
           filters_ = std::move(found);
         });
  }

  void list() {
    struct Listed {
      std::vector<ui::RecordRow> found;
      std::int64_t rows = 0;  // of all pages
    };
    look(
        [this, choice = kept_choice(), skip = walk_.first_row()](JobControl& control) -> Result<Listed> {
          Listed listed;
          RELIEVO_TRY_ASSIGN(const Passed passed, passed_by(services().store, *choice, control));
          RELIEVO_TRY_ASSIGN(
              listed.rows, passed ? Result(std::int64_t(passed->size())) : services().store.count_subjects());
          RELIEVO_TRY_ASSIGN(const auto subjects, rows_of(services().store, passed, skip, kPage));
          for (const storage::Subject& subject : subjects) listed.found.push_back(row_of(subject));
          return listed;
        },
        [this](Listed listed) {
          found_ = std::move(listed.found);
          walk_.set_rows(listed.rows);
          ready_ = true;
          if (found_.empty() && listed.rows > 0) list();  // the last one of the last page was erased
        });
  }

  // When the first one of each stretch came. They are read one by one: of those between nothing has to be.
  void label_stretches() {
    std::vector<std::int64_t> rows;
    for (std::size_t i = 0; i < walk_.stretches(); ++i) rows.push_back(walk_.top_row(i));
    using Labels = std::vector<std::string>;
    look(
        [this, choice = kept_choice(), rows](JobControl& control) -> Result<Labels> {
          Labels labels;
          RELIEVO_TRY_ASSIGN(const Passed passed, passed_by(services().store, *choice, control));
          for (const std::int64_t row : rows) {
            RELIEVO_TRY_ASSIGN(const auto one, rows_of(services().store, passed, row, 1));
            labels.push_back(one.empty() ? std::string() : text_of(one.front().created_at));
          }
          return labels;
        },
        [this, division = ++division_](Labels labels) {
          if (division != division_) return;
          for (std::size_t i = 0; i < labels.size(); ++i) walk_.set_label(i, std::move(labels[i]));
        });
  }

  void load(std::int64_t number) {
    using Loaded = std::shared_ptr<Person>;
    services().side_tasks.ask(
        JobLane::Keeper,
        [this, id = storage::SubjectId{number}](JobControl&) -> Result<Loaded> {
          auto person = std::make_shared<Person>();
          RELIEVO_TRY_ASSIGN(storage::Subject subject, services().store.subject(id));
          person->found = row_of(subject);
          wipe_text(subject.name);
          RELIEVO_TRY_ASSIGN(const auto enrolments, services().store.enrolments(id));
          if (enrolments.empty()) return person;
          const storage::Consent& consent = enrolments.back().consent;
          person->consent = consent.wording + " (" + consent.language + ")";
          person->consented_at = text_of(consent.given_at);
          RELIEVO_TRY_ASSIGN(auto model, services().store.load_model(enrolments.back().id, &person->memory));
          person->model.emplace(std::move(model));
          return person;
        },
        [this, visit = visit_](const Result<Loaded>& person) {
          if (visit != visit_) return;
          if (!person) return told(person.error());
          person_ = *person;
          ++model_number_;
        });
  }

  // It was held for three seconds: who signs out meanwhile still has it erased.
  void erase(std::int64_t number) {
    person_.reset();
    services().side_tasks.send(
        JobLane::Keeper,
        [this, id = storage::SubjectId{number}](JobControl&) {
          return erase_person(services().store, id, services().log);
        },
        [this, number, visit = visit_](const std::optional<Error>& error) {
          if (!error) services().log.say(ui::LogEvent::RecordErased, {std::to_string(number)});
          if (visit != visit_) return error ? services().log.fault(*error) : void();
          told(error);
          erased_ = !error;
          list();
        },
        SideTasks::Whose::Device);
  }

  void take_out(std::int64_t number) {
    services().appliance.ask(ui::Intent::Export);
    if (services().appliance.state() != State::Export) return;
    exporting_ = true;
    const auto trace = std::make_shared<ExportTrace>();
    const FurtherModels further{.watertight = services().settings.now().is_on(ui::Setting::Solids)};
    export_ = services().side_tasks.send(
        JobLane::Keeper,
        [this, number, choice = kept_choice(), further, trace](JobControl& control) -> Result<void> {
          std::vector<storage::SubjectId> subjects{storage::SubjectId{number}};
          if (number == 0) {              // of every page of the list
            pipeline::Progress choosing;  // the bar is the writing's
            JobControl chooses{control.cancelled, choosing};
            RELIEVO_TRY_ASSIGN(subjects, chosen_records(services().store, *choice, chooses));
          }
          // Here, since nobody hears the end of what was cancelled: these records lie on a stick.
          const auto told = [&] {
            if (trace->whole > 0)
              services().log.say(ui::LogEvent::RecordsExported, {std::to_string(trace->whole)});
          };
          try {
            const Result<void> done =
                export_records(services().store, services().device.clock(), services().device.media(),
                               subjects, further, control, *trace);
            told();
            return done;
          } catch (const std::exception&) {
            told();
            throw;
          }
        },
        [this, trace, visit = visit_](const std::optional<Error>& error) {
          if (visit == visit_) exported(error, *trace);
        });
  }

  void exported(const std::optional<Error>& error, const ExportTrace& trace) {
    exporting_ = false;
    services().appliance.end_service_state(!error);
    told(error);
    if (trace.left_out && error && error->code != trace.left_out->code) services().log.fault(*trace.left_out);
    trace_ = trace;
    if (error) outcome_ = outcome_of_export(*error, trace);
    exported_ = !error;
  }

  std::uint32_t visit_ = 0;  // of the page: what was asked before it was left is not shown after
  RecordChoice choice_;
  ListWalk walk_{kPage};
  std::uint32_t division_ = 0;  // of the stretches: what was found for those before is not shown
  std::vector<ui::RecordFilter> filters_;
  int looks_ = 0;  // under way
  hal::Instant looks_since_{};
  bool ready_ = false, erased_ = false, exporting_ = false, exported_ = false;
  std::vector<ui::RecordRow> found_;
  std::shared_ptr<Person> person_;
  std::uint32_t model_number_ = 0;
  ui::Outcome outcome_ = ui::Outcome::None;
  std::uint32_t export_ = 0;  // the last one's side task
  ExportTrace trace_;         // and how far it came
  ui::RecordsView view_;
};

}  // namespace

std::unique_ptr<PageController> records_controller(PageServices& services) {
  return std::make_unique<RecordsController>(services);
}

}  // namespace relievo::firmware
