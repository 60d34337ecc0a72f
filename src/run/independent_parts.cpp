#include "run/independent_parts.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <utility>

#include "run/choose_engine.hpp"
#include "run/part_rows.hpp"

namespace signorini::run {
namespace {

constexpr std::size_t max_of_all_parts = 50;  // limit of the number of different warnings of all parts

int number_of(const assembly::PartModel& part, int contact) {
  return contact < 0 ? contact : static_cast<int>(part.contacts[static_cast<std::size_t>(contact)]);
}

constexpr Extreme Audit::*greatest_of_parts[] = {&Audit::gap,        &Audit::tension,   &Audit::product,
                                                 &Audit::friction,   &Audit::direction, &Audit::equilibrium,
                                                 &Audit::penetration};

void merge_results(const assembly::PartModel& part, const Audit& own, Audit& all) {
  for (Extreme Audit::*const extreme : greatest_of_parts)
    if ((own.*extreme).value > (all.*extreme).value) {
      all.*extreme = own.*extreme;
      (all.*extreme).contact = number_of(part, (own.*extreme).contact);
    }
  if (own.contacts_at_limit > 0 && (all.contacts_at_limit == 0 || own.at_limit.value > all.at_limit.value)) {
    all.at_limit = own.at_limit;
    all.at_limit.contact = number_of(part, own.at_limit.contact);
  }
  all.contacts_at_limit += own.contacts_at_limit;
  all.energy.value += own.energy.value;
  all.length_scale = own.length_scale;
  all.force_scale = own.force_scale;
  all.power_scale = own.power_scale;
  all.energy_scale += own.energy_scale;
  all.impulses_on_closed += own.impulses_on_closed;
  all.work_of_loads += own.work_of_loads;
  for (std::size_t k = 0; k < part.contacts.size(); ++k)
    all.friction_work[part.contacts[k]] = own.friction_work[k];
  for (const EnergyColumn& column : energy_columns) {
    all.initial.*column.value += own.initial.*column.value;
    all.final.*column.value += own.final.*column.value;
  }
}

constexpr long Counters::*counts_of_parts[] = {&Counters::steps,
                                               &Counters::residuals,
                                               &Counters::jacobians,
                                               &Counters::factorisations,
                                               &Counters::refactorisations,
                                               &Counters::solves,
                                               &Counters::error_test_failures,
                                               &Counters::convergence_failures,
                                               &Counters::guard_evaluations,
                                               &Counters::restarts,
                                               &Counters::rolled_back,
                                               &Counters::contact_states,
                                               &Counters::proof_steps,
                                               &Counters::fallbacks};

void merge_results(const Counters& own, Counters& all) {
  for (long Counters::*const count : counts_of_parts) all.*count += own.*count;
  for (const auto& [order, steps] : own.steps_by_order) all.steps_by_order[order] += steps;
}

void merge_results(const assembly::PartModel& part, const LawCheckSummary& own, LawCheckSummary& all) {
  all.checked += own.checked;
  all.violated += own.violated;
  for (Violation v : own.violations) {
    v.contact = number_of(part, v.contact);
    all.violations.push_back(std::move(v));
  }
}

}  // namespace

double merge_results(const Model& whole, const std::vector<assembly::PartModel>& parts,
                     const std::vector<RunEnd>& endings, Report& report) {
  report.audit.energy_scale = 0.0;
  report.audit.friction_work.resize(whole.contacts.size());
  report.peaks.resize(whole.contacts.size());
  report.supports.resize(whole.contacts.size());
  report.landings.resize(whole.contacts.size());
  report.warnings.insert(report.warnings.begin(), whole.warnings.begin(), whole.warnings.end());
  std::set<std::string> unique;
  double energy_rounding = 0.0, greatest_off = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const assembly::PartModel& part = parts[i];
    const Report& own = endings[i].report;
    merge_results(part, own.audit, report.audit);
    if (own.audit.energy.value > greatest_off) {
      greatest_off = own.audit.energy.value;
      report.audit.energy.t = own.audit.energy.t;
    }
    merge_results(own.counters, report.counters);
    merge_results(part, own.law_checks, report.law_checks);
    for (std::size_t k = 0; k < part.contacts.size(); ++k) {
      report.peaks[part.contacts[k]] = own.peaks[k];
      report.supports[part.contacts[k]] = own.supports[k];
      report.landings[part.contacts[k]] = own.landings[k];
    }
    report.undecided += own.undecided;
    if (own.first_undecided && !(report.first_undecided && *report.first_undecided <= *own.first_undecided))
      report.first_undecided = own.first_undecided;
    for (const std::string& warning : own.warnings)
      if (unique.insert(warning).second && unique.size() <= max_of_all_parts)
        report.warnings.push_back(warning);
    energy_rounding += endings[i].energy_rounding;
  }
  if (unique.size() > max_of_all_parts)
    report.warnings.push_back(
        fmt::format("{} more warnings of uncoupled parts are omitted", unique.size() - max_of_all_parts));
  std::vector<Violation>& found = report.law_checks.violations;
  std::stable_sort(found.begin(), found.end(),
                   [](const Violation& a, const Violation& b) { return a.t < b.t; });
  if (found.size() > max_stored_violations) found.resize(max_stored_violations);
  return energy_rounding;
}

namespace {

/// Least number of stages in t_end. All parts reach the end of a stage before the next stage starts, so rows wait, and an
/// interrupted run loses, at most one stage. Chosen value.
constexpr double stages = 32.0;
constexpr double max_waiting = 8e6;  // limit of the number of values in waiting rows
// Limit of the number of events in a stage (less than a megabyte); after more events, the next stage is shorter.
constexpr std::size_t max_events = 2000;

/// Run data with the flow that was chosen for the whole model, so that all parts use the same flow.
RunSpec as_chosen(RunSpec spec, const Method& method) {
  if (engine_row(spec.engine).capabilities.closed_form_flow)
    spec.flow = method.flow == "modal" ? Flow::modal : Flow::taylor;
  return spec;
}

/// Removes the columns of parts that pictures of the whole model do not show.
void keep_drawn(const Model& whole, std::vector<assembly::PartModel>& parts) {
  std::set<std::string> drawn;
  for (const Column& column : drawn_columns(whole)) drawn.insert(column.name);
  for (assembly::PartModel& part : parts) {
    std::vector<Column>& columns = part.model.columns;
    columns.erase(std::remove_if(columns.begin(), columns.end(),
                                 [&](const Column& c) { return drawn.count(c.name) == 0; }),
                  columns.end());
  }
}

class IndependentParts {
 public:
  IndependentParts(const Model& whole, std::vector<assembly::PartModel> parts, const RunSpec& spec,
                   const EngineRow& engine, Method method, Recorder& recorder)
      : whole_(whole),
        parts_(std::move(parts)),
        spec_(as_chosen(spec, method)),
        engine_(engine),
        recorder_(recorder),
        grid_(std::make_shared<const std::vector<double>>(spec_.grid())),
        rows_(whole, parts_, spec_.t_end, recorder, report_),
        progress_([this] { return recorder_.progress(reported_); }) {
    report_.method = std::move(method);
    keep_drawn(whole, parts_);
    columns_ = drawn_columns(whole).size();
    for (assembly::PartModel& part : parts_) {
      recorders_.push_back(std::make_unique<PartRecorder>(part, recorder.wants_motion(), progress_));
      rows_.add(*recorders_.back());
      loops_.push_back(loop_of(part, spec_, *recorders_.back(), grid_));
    }
  }

  RunEnd run() {
    for (const auto& loop : loops_) loop->begin();
    update_stops();
    const double longest = longest_stage();
    double length = longest / stages;  // short at first: the density of events is not known yet
    while (reported_ < spec_.t_end && !over()) {
      const std::size_t found = stage(reported_ + length < spec_.t_end ? reported_ + length : spec_.t_end);
      length = found > max_events ? 0.5 * length : std::min(longest, 2.0 * length);
    }
    return ending();
  }

 private:
  [[nodiscard]] std::unique_ptr<Loop> loop_of(assembly::PartModel& part, const RunSpec& spec,
                                              PartRecorder& recorder,
                                              std::shared_ptr<const std::vector<double>> grid) const {
    return std::make_unique<Loop>(
        part.model, spec, engine_, report_.method, recorder, RunHooks{},
        PartShare{parts_.size(), whole_.contacts.size(), columns_, part.contacts, std::move(grid),
                  [&recorder](double t, const Energy& energy) { recorder.energies(t, energy); }});
  }

  [[nodiscard]] double longest_stage() const {
    const double numbers =
        static_cast<double>(grid_->size()) *
        static_cast<double>(2 * whole_.size() + 8 * static_cast<int>(whole_.contacts.size()));
    return spec_.t_end / std::max(stages, std::ceil(numbers / max_waiting));
  }

  [[nodiscard]] bool over() const { return interrupted_ || stopped_ != nullptr; }

  /// Runs all parts to `until` and forwards their rows. Returns the number of forwarded events.
  std::size_t stage(double until) {
    const double from = reported_;
    for (std::size_t i = 0; i < loops_.size() && !interrupted_; ++i) {
      reported_ = from + (until - from) * static_cast<double>(i) / static_cast<double>(loops_.size());
      loops_[i]->advance_to(std::min(until, end_));
      update_stops(i);
    }
    reported_ = until;
    return over() ? 0 : forward(until == spec_.t_end ? until : reached(), until == spec_.t_end);
  }

  /// Forwards rows and events; the recorder may end the run after a row.
  std::size_t forward(double t, bool last) {
    const std::size_t events = rows_.forward(t, last);
    if (rows_.stopped_at()) interrupted_ = true;
    return events;
  }

  /// Earliest time reached by any part: all rows up to this time are complete.
  [[nodiscard]] double reached() const {
    double t = spec_.t_end;
    for (const auto& loop : loops_) t = std::min(t, loop->t());
    return t;
  }

  void update_stops() {
    for (std::size_t i = 0; i < loops_.size(); ++i) update_stops(i);
  }

  void update_stops(std::size_t i) {
    const Outcome& outcome = loops_[i]->outcome();
    if (outcome.kind == Outcome::Kind::interrupted) interrupted_ = true;
    if (outcome.kind != Outcome::Kind::stopped || !(loops_[i]->t() < end_)) return;
    end_ = loops_[i]->t();
    stopped_ = &parts_[i];
  }

  /// Advances all parts to the time at which a part stopped, which may be far later than the end of the stage.
  void catch_up() {
    for (std::size_t i = 0; i < loops_.size() && !interrupted_; ++i) {
      loops_[i]->advance_to(end_);
      update_stops(i);
    }
  }

  RunEnd ending() {
    if (stopped_ != nullptr && begun()) catch_up();
    RunEnd result;
    std::vector<RunEnd> endings;
    std::vector<PartRecorder*> drawn;
    std::vector<std::unique_ptr<PartRecorder>> again;
    double end = interrupted_ ? reached() : std::min(end_, spec_.t_end);
    if (rows_.stopped_at()) end = *rows_.stopped_at();
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const bool beyond = !interrupted_ && stopped_ != nullptr && loops_[i]->t() > end;
      drawn.push_back(recorders_[i].get());
      if (beyond) {
        again.push_back(std::make_unique<PartRecorder>(parts_[i], recorder_.wants_motion(), progress_));
        drawn.back() = again.back().get();
      }
      endings.push_back(beyond ? until(end, parts_[i], *again.back()) : loops_[i]->end());
      if (&parts_[i] == stopped_) result.law_violated = endings.back().law_violated;
    }
    if (over() && begun()) forward(end, true);
    if (rows_.stopped_at()) end = *rows_.stopped_at();
    rows_.finish();
    rows_.forward_motion(end, drawn);
    result.energy_rounding = merge_results(whole_, parts_, endings, report_);
    report_outcome(end, endings);
    result.report = std::move(report_);
    return result;
  }

  /// True if the contact states of every part could be decided at the start; otherwise there are no rows.
  [[nodiscard]] bool begun() const {
    return std::all_of(loops_.begin(), loops_.end(), [](const auto& loop) { return loop->begun(); });
  }

  /// Runs a part again up to the earlier time `end`, and returns its results without rows.
  [[nodiscard]] RunEnd until(double end, assembly::PartModel& part, PartRecorder& recorder) const {
    RunSpec spec = spec_;
    spec.t_end = end;
    spec.output_times = std::vector<double>{0.0};
    spec.frames.clear();
    const std::unique_ptr<Loop> loop = loop_of(part, spec, recorder, nullptr);
    loop->begin();
    loop->advance_to(end);
    return loop->end();
  }

  void report_outcome(double end, const std::vector<RunEnd>& endings) {
    report_.outcome.t = end;
    if (interrupted_) {
      report_.outcome.kind = Outcome::Kind::interrupted;
      report_.outcome.reason = "interrupted";
      return;
    }
    if (stopped_ == nullptr) return;
    const auto i = static_cast<std::size_t>(stopped_ - parts_.data());
    report_.outcome = endings[i].report.outcome;
    for (std::size_t& contact : report_.outcome.refusal.contacts) contact = stopped_->contacts[contact];
  }

  const Model& whole_;
  std::vector<assembly::PartModel> parts_;
  const RunSpec spec_;
  const EngineRow& engine_;
  Recorder& recorder_;
  const std::shared_ptr<const std::vector<double>> grid_;
  Report report_;
  PartRows rows_;
  const std::function<bool()> progress_;
  std::size_t columns_ = 0;
  std::vector<std::unique_ptr<PartRecorder>> recorders_;
  std::vector<std::unique_ptr<Loop>> loops_;
  double reported_ = 0.0;                                 // time up to which progress was reported
  double end_ = std::numeric_limits<double>::infinity();  // time at which the first part stops
  const assembly::PartModel* stopped_ = nullptr;
  bool interrupted_ = false;
};

}  // namespace

RunEnd run_independent_parts(const Model& whole, std::vector<assembly::PartModel> parts, const RunSpec& spec,
                             const EngineRow& engine, Method method, Recorder& recorder) {
  return IndependentParts(whole, std::move(parts), spec, engine, std::move(method), recorder).run();
}

std::vector<assembly::PartModel> parts_to_run(const Model& model, const Method& method,
                                              const Recorder& recorder, const RunHooks& hooks) {
  if (!hooks.none() || recorder.steers() || recorder.wants_instants()) return {};
  std::vector<assembly::PartModel> parts = assembly::part_models(model);
  if (method.flow == "modal")
    for (const assembly::PartModel& part : parts)
      if (!modal_kind(part.model).objection.empty()) return {};
  return parts;
}

}  // namespace signorini::run
