#include "run/joined_report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <set>

namespace signorini {
namespace {

constexpr std::size_t most_of_all_parts = 50;  // limit over all parts

int number_of(const PartModel& part, int contact) {
  return contact < 0 ? contact : static_cast<int>(part.contacts[static_cast<std::size_t>(contact)]);
}

constexpr Extreme Audit::*greatest_of_parts[] = {&Audit::gap,        &Audit::tension,   &Audit::product,
                                                 &Audit::friction,   &Audit::direction, &Audit::equilibrium,
                                                 &Audit::penetration};

void join(const PartModel& part, const Audit& own, Audit& all) {
  for (Extreme Audit::*const extreme : greatest_of_parts)
    if ((own.*extreme).value > (all.*extreme).value) {
      all.*extreme = own.*extreme;
      (all.*extreme).contact = number_of(part, (own.*extreme).contact);
    }
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

void join(const Counters& own, Counters& all) {
  for (long Counters::*const count : counts_of_parts) all.*count += own.*count;
  for (const auto& [order, steps] : own.steps_by_order) all.steps_by_order[order] += steps;
}

void join(const PartModel& part, const Testimony& own, Testimony& all) {
  all.checked += own.checked;
  all.violated += own.violated;
  for (Violation v : own.violations) {
    v.contact = number_of(part, v.contact);
    all.violations.push_back(std::move(v));
  }
}

}  // namespace

double join(const Model& whole, const std::vector<PartModel>& parts, const std::vector<RunEnd>& endings,
            Report& report) {
  report.audit.energy_scale = 0.0;
  report.audit.friction_work.resize(whole.contacts.size());
  report.peaks.resize(whole.contacts.size());
  report.supports.resize(whole.contacts.size());
  report.landings.resize(whole.contacts.size());
  report.warnings.insert(report.warnings.begin(), whole.warnings.begin(), whole.warnings.end());
  std::set<std::string> said;
  double energy_rounding = 0.0, greatest_off = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const PartModel& part = parts[i];
    const Report& own = endings[i].report;
    join(part, own.audit, report.audit);
    if (own.audit.energy.value > greatest_off) {
      greatest_off = own.audit.energy.value;
      report.audit.energy.t = own.audit.energy.t;
    }
    join(own.counters, report.counters);
    join(part, own.witness, report.witness);
    for (std::size_t k = 0; k < part.contacts.size(); ++k) {
      report.peaks[part.contacts[k]] = own.peaks[k];
      report.supports[part.contacts[k]] = own.supports[k];
      report.landings[part.contacts[k]] = own.landings[k];
    }
    report.undecided += own.undecided;
    if (own.forgiven_at && !(report.forgiven_at && *report.forgiven_at <= *own.forgiven_at))
      report.forgiven_at = own.forgiven_at;
    for (const std::string& warning : own.warnings)
      if (said.insert(warning).second && said.size() <= most_of_all_parts) report.warnings.push_back(warning);
    energy_rounding += endings[i].energy_rounding;
  }
  if (said.size() > most_of_all_parts)
    report.warnings.push_back(
        fmt::format("{} more warnings of parts that nothing couples", said.size() - most_of_all_parts));
  std::vector<Violation>& found = report.witness.violations;
  std::stable_sort(found.begin(), found.end(),
                   [](const Violation& a, const Violation& b) { return a.t < b.t; });
  if (found.size() > most_violations) found.resize(most_violations);
  return energy_rounding;
}

}  // namespace signorini
