#include "study/law_check/directory_law_checker.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <deque>
#include <tuple>

#include "base/rounding.hpp"
#include "base/run_files.hpp"
#include "base/text.hpp"
#include "contact/friction.hpp"
#include "law_check/contact_kinematics.hpp"
#include "model/assembly/parts.hpp"
#include "result/instants.hpp"
#include "run/engines.hpp"
#include "run/run_law_checker.hpp"
#include "signorini/error.hpp"
#include "study/law_check/run_reader.hpp"
#include "study/law_check/table_rows.hpp"
#include "study/prepared_run.hpp"

namespace signorini::directory_check {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_stored_violations = 100;  // limit of stored violations; later ones are only counted

study::PreparedRun prepared_of(const fs::path& directory) {
  const fs::path path = directory / "run.toml";
  std::error_code missing;
  if (!fs::exists(path, missing))
    throw FileError(path.string(), "not found; give a directory written by `signorini run`");
  if (!fs::exists(directory / result::instants_file, missing))
    throw FileError((directory / result::instants_file).string(),
                    "not found; `signorini run --instants` writes it");
  base::check_run_files(directory);
  return study::prepare_run(path.string(), {});
}

RunSpec spec_of(const Scene& scene, const RecordedSummary& recorded) {
  RunSpec spec = scene.run;
  spec.engine = recorded.engine;
  return spec;
}

class DirectoryLawChecker {
 public:
  DirectoryLawChecker(const fs::path& directory, const Scene& scene, DirectoryLawCheck& result)
      : directory_(directory),
        scene_(scene),
        model_(result.model),
        result_(result),
        recorded_(read_recorded_summary(directory, model_)),
        engine_(run::checked_engine(
            spec_of(scene, recorded_), engine::tolerance_of(model_, scene.run), recorded_.flow,
            run::engine_row(recorded_.engine).capabilities.resolves_low_flights(model_))),
        law_checker_(model_, engine_.limits),
        motion_(model_, engine_),
        rows_(model_, engine_, law_checker_, recorded_.stopped) {
    result_.complete = recorded_.ended;
    for (Event& event : read_recorded_events(directory, model_, recorded_.ended))
      events_.push_back(std::move(event));
    if (!events_.empty()) last_event_ = events_.back().t;
    result_.events = static_cast<long>(events_.size());
  }

  void run() {
    count_events();
    instants();
    while (!events_.empty()) unmatched();
    const auto found = [this](Violation v) { add(std::move(v)); };
    const RunSpan span{scene_.run.grid(), recorded_.ended, recorded_.stopped,
                       recorded_.ended ? recorded_.t : t_};
    result_.rows = rows_.contacts(directory_ / "contacts.csv", span, found);
    if (has_motion()) result_.rows += rows_.motion(directory_ / "motion.csv", span, found);
    rows_.check_peaks(recorded_.peaks, found);
    rows_.check_loads(recorded_.loads, recorded_.peaks, found);
    result_.law_checks.checked = result_.instants;
  }

 private:
  void add(Violation v) {
    ++result_.law_checks.violated;
    if (result_.law_checks.violations.size() < max_stored_violations)
      result_.law_checks.violations.push_back(std::move(v));
  }
  void missing(double t, const char* law) { add({t, result::instants_file, -1, law, 1.0, 0.0, {}, true}); }
  void instants() {
    result::InstantReader reader(directory_, model_);
    while (const auto row = reader.next()) {
      if (result_.instants == 0 && !row->start) missing(row->t, "start");
      if (row->t < t_) missing(row->t, "order");
      t_ = row->t;
      instant(*row);
      ++result_.instants;
    }
    refuse_if_cut(reader.rows());
  }

  /// Refuses files whose end is missing. A completed run must have an instant at its end, every event must be at an
  /// instant, and every change of state must have an event.
  void refuse_if_cut(const result::CsvReader& reader) const {
    const auto refuse = [](const std::string& file, const std::string& why) { throw FileError(file, why); };
    const double end = recorded_.ended && !recorded_.stopped ? recorded_.t : last_event_;
    const std::string path = (directory_ / result::instants_file).string();
    if (recorded_.ended && t_ < end - rounding::few_operations * end)
      refuse(path, truncation_message(reader, fmt::format("the instant at t = {:.9g}", end)));
    if (recorded_.ended && reader.is_cut()) refuse(path, truncation_message(reader, "a line break"));
    if (last_change_ > last_event_ && missing_events_ > 0)
      refuse((directory_ / "events.csv").string(),
             fmt::format("line {}: found the end of the file, expected {} up to t = {:.9g}; the file is cut",
                         result_.events + 2,
                         base::count_text(static_cast<std::size_t>(missing_events_), "event"), last_change_));
  }

  /// True if motion.csv exists. `run --no-plots` omits the tables for pictures; otherwise motion.csv and
  /// curves.csv are written together.
  [[nodiscard]] bool has_motion() const {
    std::error_code none;
    if (fs::exists(directory_ / "motion.csv", none)) return true;
    if (fs::exists(directory_ / "curves.csv", none))
      throw FileError((directory_ / "motion.csv").string(),
                      "not found, although curves.csv exists; a run writes both files");
    return false;
  }

  /// Reports a violation: no instant has the time of the next row of events.csv.
  void unmatched() {
    add({events_.front().t, "events.csv", events_.front().contact, "record", 1.0, 0.0, {}, true});
    events_.pop_front();
  }

  void count_events() {
    if (!recorded_.ended) return;
    std::map<std::string, long> counts;
    const auto of_summary = [this](const char* law, double off) {
      if (off > 0.0) add({recorded_.t, "summary.json", -1, law, off, 0.0, {}, true});
    };
    for (const auto& [type, count] : recorded_.events_by_type) missing_events_ += count;
    of_summary("count of events", std::abs(static_cast<double>(missing_events_ - recorded_.total)));
    of_summary("engine",
               scene_.run.engine != Engine::automatic && scene_.run.engine != recorded_.engine ? 1.0 : 0.0);
    for (const Event& event : events_)
      if (event.type != EventType::time || event.contact < 0) {
        ++counts[to_string(event.type)];
        --missing_events_;
      }
    for (const auto& [type, count] : recorded_.events_by_type)
      if (const long off = std::abs(count - counts[type]); off > 0)
        add({recorded_.t, "summary.json", -1, "count of " + type, static_cast<double>(off), 0.0, {}, true});
  }

  /// Rows of events.csv that belong to the instant: their contacts ascend, and the old state of each row is the contact's
  /// state before the instant.
  std::vector<Event> events_of(const InstantRow& row) {
    while (!events_.empty() && events_.front().t < row.t) unmatched();
    std::vector<Event> events;
    int last = -2;
    while (!events_.empty() && events_.front().t == row.t && events_.front().contact > last) {
      const Event& event = events_.front();
      if (event.contact >= 0 && !row.start && !begins_with(event, row)) break;
      last = event.contact;
      events.push_back(event);
      events_.pop_front();
    }
    return events;
  }
  /// True if the event's old state is the contact's state before the instant. events.csv contains the kind of a
  /// user law's state instead of the state.
  [[nodiscard]] static bool begins_with(const Event& event, const InstantRow& row) {
    const State state = row.before.states[static_cast<std::size_t>(event.contact)].state;
    return std::string(to_string(state)) == to_string(event.from);
  }

  [[nodiscard]] law_check::RecordedEvent recorded(const Event& event, const InstantRow& row) const {
    law_check::RecordedEvent result = run::recorded_event(event);
    const auto plain = [](State recorded, State kept) {
      return is_user_law_state(kept) && kind_of(kept) == recorded ? kept : recorded;
    };
    result.from = plain(event.from, row.before.states[result.contact].state);
    result.to = plain(event.to, row.after.states[result.contact].state);
    result.guard_rate = event.guard_rate.value_or(0.0);
    return result;
  }

  void instant(const InstantRow& row) {
    motion_.update_maxima(law_checker_, row.before.u, row.before.v);
    law_check::InstantRecord record;
    const motion::Side side = row.breakpoint && !row.start ? motion::Side::before : motion::Side::after;
    record.before = motion_.side(motion::Forcing(model_, row.t, side), row.t, row.eigenvector_condition);
    record.after =
        motion_.side(motion::Forcing(model_, row.t, motion::Side::after), row.t, row.eigenvector_condition);
    point_to(row, record);
    for (const Event& event : events_of(row)) {
      if (event.contact < 0) continue;
      record.events.push_back(recorded(event, row));
      if (model_.contacts[record.events.back().contact].normal_force_given() == event.gap.has_value())
        add({row.t, to_string(event.type), event.contact, "row", 1.0, 0.0, {}, true});
    }
    for (Violation& v : law_checker_.check_instant(record)) add(std::move(v));
    check_transition(row, record);
    rows_.instant(row, record);
    motion_.finish_instant(motion::Forcing(model_, row.t, motion::Side::after), row.t);
    for (std::size_t k = 0; k < model_.contacts.size() && !row.start; ++k)
      if (to_string(row.before.states[k].state) != std::string(to_string(row.after.states[k].state)))
        last_change_ = row.t;
  }

  /// Checks that a run itself does not make: continuity from the previous instant, the start of the scene, and
  /// the forces on the structure.
  void check_transition(const InstantRow& row, const law_check::InstantRecord& record) {
    if (row.start) given_start(row);
    if (last_ && engine_.located) {
      law_check::CheckedSide from = record.before;
      from.u = &last_->after.u;
      from.v = &last_->after.v;
      from.mode = &last_->after.states;
      from.forces = &last_->after.forces;
      from.driven = left_driven_;
      for (Violation& v : law_checker_.check_stretch(row.t, from, record.before)) add(std::move(v));
    }
    Vector load = Vector::Zero(model_.size());
    motion::Forcing(model_, row.t, motion::Side::after).add_load(row.t, 0, load.data());
    for (Violation& v : law_checker_.check_equilibrium(row.t, record.after, load)) add(std::move(v));
    last_ = row;
    left_driven_ = record.after.driven;
  }

  /// Checks the initial values against the scene. A static start is checked by check_equilibrium() instead.
  void given_start(const InstantRow& row) {
    if (model_.static_start || model_.reduction) return;
    for (const auto& [recorded, asked, unit] : {std::tuple(&row.before.u, &model_.u0, seen::length),
                                                std::tuple(&row.before.v, &model_.v0, seen::velocity)}) {
      const double limit = rounding::few_operations * asked->lpNorm<Eigen::Infinity>();
      const double off = (*recorded - *asked).lpNorm<Eigen::Infinity>();
      if (off > limit) add({row.t, "start", -1, "initial values", off, limit, unit, false});
    }
  }

  void point_to(const InstantRow& row, law_check::InstantRecord& record) const {
    record.t = row.t;
    record.resolution = row.resolution;
    record.forgiven = row.tolerated_violation;
    record.eigenvector_condition = row.eigenvector_condition;
    record.start = row.start;
    record.continues = row.start && !model_.saved_contacts.empty();
    record.breakpoint = row.breakpoint;
    record.load_jumps = row.load_jumps;
    record.located = row.located;
    const auto point = [](const InstantSide& side, law_check::CheckedSide& to) {
      to.u = &side.u;
      to.v = &side.v;
      to.a = side.a.size() > 0 ? &side.a : nullptr;
      to.mode = &side.states;
      to.forces = &side.forces;
    };
    point(row.before, record.before);
    point(row.after, record.after);
    record.after.acceleration_terms =
        motion_.acceleration_terms(law_checker_, row.after.a, row.eigenvector_condition);
    for (const InstantImpact& impact : row.impacts)
      record.impulses.push_back(
          {static_cast<std::size_t>(impact.contact), impact.impact_number, impact.normal, impact.tangent});
    std::stable_sort(record.impulses.begin(), record.impulses.end(),
                     [](const law_check::RecordedImpulse& a, const law_check::RecordedImpulse& b) {
                       return a.impact_number < b.impact_number;
                     });
    record.captures = row.capture_impulses;
    for (const int k : row.released) record.released.push_back(static_cast<std::size_t>(k));
  }

  fs::path directory_;
  const Scene& scene_;
  const Model& model_;
  DirectoryLawCheck& result_;
  RecordedSummary recorded_;
  run::CheckedEngine engine_;
  law_check::LawChecker law_checker_;
  run::CheckedMotion motion_;
  TableRowChecker rows_;
  std::deque<Event> events_;
  std::optional<InstantRow> last_;               // the previous instant
  std::vector<law_check::Driven> left_driven_;   // prescribed motions of contacts just after that instant
  double t_ = 0.0;                               // time of the previous instant
  double last_event_ = 0.0, last_change_ = 0.0;  // times of the last event and of the last change of a state
  long missing_events_ = 0;                      // number of events of summary.json that events.csv lacks
};

}  // namespace

DirectoryLawCheck check_directory_laws(const fs::path& directory) {
  study::PreparedRun prepared = prepared_of(directory);
  DirectoryLawCheck result;
  result.model = std::move(prepared.model);
  DirectoryLawChecker(directory, prepared.scene, result).run();
  return result;
}

}  // namespace signorini::directory_check
