#include "study/law_check/table_rows.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "contact/motion.hpp"
#include "law_check/laws.hpp"

namespace signorini::directory_check {

/// True if the values are equal up to the rounding of a conversion of units and back.
bool TableRowOrder::same(double a, double b) {
  return std::abs(a - b) <= rounding::few_operations * std::max(std::abs(a), std::abs(b));
}

void TableRowOrder::misplaced(const char* file, double t, std::size_t contact) {
  in_order_ = false;
  found_({t, file, static_cast<int>(contact), "rows", 1.0, 0.0, {}, false});
}

void TableRowOrder::grid_row(const RecordedRow& row) {
  const std::vector<double>& grid = run_.grid;
  if (place_ >= grid.size() || row.contact != due_ || !same(row.t, grid[place_])) {
    misplaced("contacts.csv", row.t, due_);
    const double early = row.t - rounding::few_operations * std::abs(row.t);
    const auto found = std::lower_bound(grid.begin(), grid.end(), early);
    if (found == grid.end() || !same(*found, row.t)) return;  // not an output time
    place_ = static_cast<std::size_t>(found - grid.begin());
    due_ = row.contact;
  }
  if (++due_ < model_.contacts.size()) return;
  due_ = 0;
  ++place_;
}

void TableRowOrder::end_of_grid(const RecordedRowReader& reader) const {
  if (model_.contacts.empty()) return;
  // If the run ended exactly at an output time, rows of this time exist only if the instant there was completed.
  const std::size_t least =
      is_complete_run()
          ? run_.grid.size()
          : static_cast<std::size_t>(
                std::lower_bound(run_.grid.begin(), run_.grid.end(), run_.reached,
                                 [](double t, double end) { return t < end && !same(t, end); }) -
                run_.grid.begin());
  // If rows are out of order, violations have been reported already, and a missing last row is no error.
  const bool at_last = !in_order_ && place_ + 1 >= least;
  if ((place_ < least && !at_last) || (due_ > 0 && run_.ended && in_order_))
    reader.refuse_truncated(fmt::format("the row of contact \"{}\" at t = {:.9g}", model_.contacts[due_].name,
                                        place_ < run_.grid.size() ? run_.grid[place_] : run_.reached));
  if (reader.is_cut() && run_.ended) reader.refuse_truncated("a line break");
}

void TableRowOrder::block_row(const RecordedRow& row) {
  const bool next = last_ ? row.contact == last_->contact + 1 : row.contact == 0;
  const bool goes_on = last_ && row.contact == last_->contact && row.t >= last_->t;
  const bool whole = !last_ || !is_complete_run() || same(last_->t, run_.reached);
  if (!goes_on && !(next && whole && row.t == 0.0)) misplaced("motion.csv", row.t, row.contact);
  last_ = row;
}

void TableRowOrder::end_of_blocks(const RecordedRowReader& reader) const {
  if (!run_.ended || model_.contacts.empty()) return;
  const std::size_t all = model_.contacts.size();
  if (!last_ || last_->contact + 1 != all)
    reader.refuse_truncated(
        fmt::format("rows of contact \"{}\"", model_.contacts[last_ ? last_->contact + 1 : 0].name));
  if (is_complete_run() && !same(last_->t, run_.reached))
    reader.refuse_truncated(fmt::format("rows of contact \"{}\" up to t = {:.9g}",
                                        model_.contacts[last_->contact].name, run_.reached));
  if (reader.is_cut()) reader.refuse_truncated("a line break");
}

namespace {

Violation violation(const char* file, double t, std::size_t contact, const char* law, double value,
                    double limit, const Unit& unit) {
  return {t, file, static_cast<int>(contact), law, value, limit, unit, false};
}

}  // namespace

TableRowChecker::TableRowChecker(const Model& model, const run::CheckedEngine& engine,
                                 const law_check::LawChecker& witness, bool stopped)
    : model_(model),
      engine_(engine),
      law_checker_(witness),
      stopped_(stopped),
      sizes_(model.contacts.size()),
      peaks_(model.contacts.size()),
      loads_(model.contacts.size()),
      reached_(model.contacts.size(), false) {}

void TableRowChecker::instant(const InstantRow& row, const law_check::InstantRecord& record) {
  states_.push_back({row.t, row.resolution, row.before.states, row.after.states});
  const double held = law_checker_.constraint_force_terms(record.after);
  for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
    Size& size = sizes_[k];
    const law_check::ContactKinematics m = law_check::kinematics(model_.contacts[k], k, record.after);
    if (row.start) {
      const bool touches = model_.contacts[k].compliance_split() && !is_open(row.after.states[k].state);
      size.gap_at_start = touches ? 0.0 : m.g;
      size.ut_at_start = touches ? contact::slip_of(model_.contacts[k], m.ut, m.T) : m.ut;
    }
    size.place = std::max(size.place, m.displacement_size);
    size.speed = std::max(size.speed, m.velocity_size);
    size.force = std::max(size.force, held);
  }
}

/// States that a row at time t may have: the state after the last instant; at an instant, the states on both
/// of its sides, and the states of other instants within the time resolution.
std::vector<ContactState> TableRowChecker::states_at(std::size_t contact, double t) const {
  std::vector<ContactState> states;
  auto next = std::upper_bound(states_.begin(), states_.end(), t,
                               [](double time, const States& s) { return time < s.t - s.resolution; });
  while (next != states_.begin()) {
    --next;
    states.push_back(next->after[contact]);
    if (next->t + next->resolution < t) break;
    states.push_back(next->before[contact]);
  }
  return states;
}

long TableRowChecker::contacts(const std::filesystem::path& file, const RunSpan& run, const Found& found) {
  return read(file, "contacts.csv", {&TableRowOrder::grid_row, &TableRowOrder::end_of_grid}, run, found);
}

long TableRowChecker::motion(const std::filesystem::path& file, const RunSpan& run, const Found& found) {
  return read(file, "motion.csv", {&TableRowOrder::block_row, &TableRowOrder::end_of_blocks}, run, found);
}

long TableRowChecker::read(const std::filesystem::path& file, const char* name, const Order& order,
                           const RunSpan& run, const Found& found) {
  RecordedRowReader reader(file, model_);
  TableRowOrder span(model_, run, found);
  long rows = 0;
  for (; const auto row = reader.next(); ++rows) {
    (span.*order.row)(*row);
    check(*row, reader, name, found);
  }
  (span.*order.end)(reader);
  return rows;
}

void TableRowChecker::check(const RecordedRow& row, const RecordedRowReader& reader, const char* file,
                            const Found& found) {
  if (reader.has_ratios()) check_ratio(row, file, found);
  const Contact& c = model_.contacts[row.contact];
  // Shortest list of violations. Candidates: the states at the row's time with the same name as the row's state.
  std::optional<std::vector<Violation>> least;
  for (const ContactState& state : states_at(row.contact, row.t)) {
    if (row.state != to_string(state.state)) continue;
    std::vector<Violation> broken;
    if (c.obeys_coulomb() && engine_.laws_at_step_ends) broken = violations_of(row, state, file);
    if (!least || broken.size() < least->size()) least = std::move(broken);
  }
  if (!least) {
    found(violation(file, row.t, row.contact, "state", 1.0, 0.0, {}));
    return;
  }
  reach(row);
  for (Violation& v : *least) found(std::move(v));
}

/// Violations of a row whose contact is in this state.
std::vector<Violation> TableRowChecker::violations_of(const RecordedRow& row, const ContactState& state,
                                                      const char* file) const {
  const Contact& c = model_.contacts[row.contact];
  law_check::ContactKinematics m;
  const Size& size = sizes_[row.contact];
  m.N = row.N;
  m.T = row.T;
  m.g = row.gap.value_or(0.0);
  m.ut = row.ut;
  m.dut = row.vt;
  m.displacement_size = size.place + model_.scales.displacement;
  m.velocity_size = size.speed;
  // For a compliance split the table has gap and ut of the surfaces; the laws need those of the springs.
  if (c.compliance_split() && !is_open(state.state)) {
    m.g = row.N / c.normal_stiffness;
    if (c.tangential_stiffness) m.ut = row.ut + row.T / *c.tangential_stiffness;
  }
  if (state.state == State::inside) m.g = 0.0;  // a dashpot force, which does not depend on the gap
  std::vector<Violation> broken;
  law_checker_.check_contact(row.t, row.contact, state, m, false, size.force, broken);
  std::erase_if(broken, [&](const Violation& v) {
    return c.tangential_stiffness && v.law == "slip direction";  // this law needs g', which tables lack
  });
  for (Violation& v : broken) v.event = file;
  check_forces(row, state, file, [&](Violation v) { broken.push_back(std::move(v)); });
  return broken;
}

void TableRowChecker::check_forces(const RecordedRow& row, const ContactState& state, const char* file,
                                   const Found& found) const {
  const Contact& c = model_.contacts[row.contact];
  const double kn = c.normal_stiffness, kt = c.tangential_stiffness.value_or(0.0),
               place = sizes_[row.contact].place;
  const double held = c.takes_impulses() ? sizes_[row.contact].force : 0.0;
  const double limit =
      rounding::elimination * ((kn + kt) * place + std::abs(row.N) + std::abs(row.T) + held) +
      law_check::tolerance_factor * (kn + kt) * (engine_.limits.rtol * place + engine_.limits.displacement);
  const auto check = [&](const char* law, double force, double asked) {
    if (const double off = std::abs(force - asked); off > limit)
      found(violation(file, row.t, row.contact, law, off, limit, seen::force));
  };
  if (c.obeys_coulomb() && !c.sliding_point()) check_slip(row, file, limit, found);
  if (is_open(state.state) && !c.normal_force_given()) {
    check("normal force", row.N, 0.0);
    check("friction force", row.T, 0.0);
    return;
  }
  if (c.normal_spring() && !c.compliance_split() && c.normal_damping == 0.0 && row.gap)
    check("normal force", row.N, kn * *row.gap);
  if (const int s = law_check::slip_direction(state.state); s != 0 && !c.friction.is_rate_dependent())
    check("friction force", row.T, -s * law_check::friction_in(c, state.state, 0.0, row.N) * row.N);
  else if (kind_of(state.state) == State::stick && c.tangential_stiffness)
    check("friction force", c.compliance_split() ? 0.0 : row.T, kt * (row.ut - state.anchor));
}

/// Checks slip = ut - T/kt. For a compliance split ut is the displacement of the surfaces, so slip = ut.
/// of_force: error bound of T.
void TableRowChecker::check_slip(const RecordedRow& row, const char* file, double of_force,
                                 const Found& found) const {
  const Contact& c = model_.contacts[row.contact];
  const double kt = c.compliance_split() ? 0.0 : c.tangential_stiffness.value_or(0.0);
  const double by_force = kt > 0.0 ? row.T / kt : 0.0;
  // sizes_ contains the displacement of a moving surface only at instants.
  const double surface =
      c.surface_motion.is_constant()
          ? 0.0
          : std::abs(motion::Forcing(model_, row.t, motion::Side::after).surface(row.contact, row.t, 0));
  const double size = sizes_[row.contact].place + surface + std::abs(row.ut) + std::abs(by_force);
  const double limit =
      rounding::elimination * size +
      law_check::tolerance_factor * (engine_.limits.rtol * size + engine_.limits.displacement) +
      (kt > 0.0 ? of_force / kt : 0.0);
  if (const double off = std::abs(row.slip - (row.ut - by_force)); off > limit)
    found(violation(file, row.t, row.contact, "slip", off, limit, seen::length));
}

void TableRowChecker::check_ratio(const RecordedRow& row, const char* file, const Found& found) const {
  const bool due =
      model_.contacts[row.contact].has_friction() && row.state != to_string(State::open) && row.N != 0.0;
  const double asked = due ? std::abs(row.T / row.N) : 0.0, limit = rounding::few_operations * asked;
  const double off = std::abs(row.ratio.value_or(0.0) - asked);
  if (due != row.ratio.has_value() || off > limit)
    found(violation(file, row.t, row.contact, "ratio", off, limit, {}));
}

void TableRowChecker::reach(const RecordedRow& row) {
  // The last step of a stopped run has rows but no instant at its end; the peaks do not include these rows.
  if (stopped_ && !states_.empty() && row.t > states_.back().t) return;
  Peak& peak = peaks_[row.contact];
  const Size& size = sizes_[row.contact];
  const Contact& c = model_.contacts[row.contact];
  if (c.surface_motion.is_constant() && !c.sliding_point())
    peak.tangential = std::max(peak.tangential, std::abs(row.ut - size.ut_at_start));
  if (row.gap) peak.normal = std::max(peak.normal, std::abs(*row.gap - size.gap_at_start));
  peak.N = std::max(peak.N, std::abs(row.N));
  peak.T = std::max(peak.T, std::abs(row.T));
  RecordedSummary::Load& load = loads_[row.contact];
  if (!reached_[row.contact]) load = {row.N, row.N, row.T, row.T};
  reached_[row.contact] = true;
  load.least_N = std::min(load.least_N, row.N);
  load.greatest_N = std::max(load.greatest_N, row.N);
  load.least_T = std::min(load.least_T, row.T);
  load.greatest_T = std::max(load.greatest_T, row.T);
}

double TableRowChecker::length_limit_of(std::size_t k) const {
  return rounding::elimination * (sizes_[k].place + model_.scales.displacement) +
         law_check::tolerance_factor * (engine_.limits.rtol * sizes_[k].place + engine_.limits.displacement);
}

double TableRowChecker::force_limit_of(std::size_t k) const {
  const Contact& c = model_.contacts[k];
  return (rounding::elimination + law_check::tolerance_factor * engine_.limits.rtol) *
             (peaks_[k].N + peaks_[k].T) +
         law_check::tolerance_factor * engine_.limits.force +
         (c.normal_stiffness + c.tangential_stiffness.value_or(0.0)) * length_limit_of(k);
}

/// Checks that no row exceeds the recorded extremes, and that the extreme with the larger magnitude equals the peak.
void TableRowChecker::check_loads(const std::vector<std::optional<RecordedSummary::Load>>& recorded,
                                  const std::vector<std::optional<Peak>>& peaks, const Found& found) const {
  for (std::size_t k = 0; k < recorded.size(); ++k) {
    if (!recorded[k]) continue;
    const bool held = !model_.contacts[k].normal_spring();
    const double noise = force_limit_of(k) + (held ? rounding::elimination * sizes_[k].force : 0.0);
    const auto check = [&](double off, double limit) {
      if (off > limit) found(violation("summary.json", 0.0, k, "load", off, limit, seen::force));
    };
    const auto check_peak = [&](double least, double greatest, double peak) {
      const double farthest = std::max(std::abs(least), std::abs(greatest));
      check(std::abs(farthest - peak), noise);
    };
    if (peaks[k]) {
      check_peak(recorded[k]->least_N, recorded[k]->greatest_N, peaks[k]->N);
      check_peak(recorded[k]->least_T, recorded[k]->greatest_T, peaks[k]->T);
    }
    if (engine_.limits.step > 0.0 || !reached_[k]) continue;
    check(recorded[k]->least_N - loads_[k].least_N, noise);
    check(loads_[k].greatest_N - recorded[k]->greatest_N, noise);
    check(recorded[k]->least_T - loads_[k].least_T, noise);
    check(loads_[k].greatest_T - recorded[k]->greatest_T, noise);
  }
}

void TableRowChecker::check_peaks(const std::vector<std::optional<Peak>>& recorded,
                                  const Found& found) const {
  if (engine_.limits.step > 0.0) return;  // the engine records extremes only at ends of steps
  for (std::size_t k = 0; k < recorded.size(); ++k) {
    if (!recorded[k]) continue;
    const double length = length_limit_of(k);
    const auto check = [&](double seen_one, double recorded_one, double limit, const Unit& unit) {
      if (const double off = seen_one - recorded_one; off > limit)
        found(violation("summary.json", 0.0, k, "peak", off, limit, unit));
    };
    const double force = force_limit_of(k);
    check(peaks_[k].tangential, recorded[k]->tangential, length, seen::length);
    check(peaks_[k].normal, recorded[k]->normal, length, seen::length);
    check(peaks_[k].N, recorded[k]->N, force, seen::force);
    check(peaks_[k].T, recorded[k]->T, force, seen::force);
  }
}

}  // namespace signorini::directory_check
