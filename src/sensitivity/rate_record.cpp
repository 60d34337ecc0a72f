#include "sensitivity/rate_record.hpp"

#include <cmath>

#include "run/scene_units.hpp"

namespace signorini::sensitivity {
namespace {

constexpr double nothing = EventRates::none;
struct PeakKind {
  const char* name;
  Unit of;
};
/// Quantities with peaks, as in summary.json: forces, and displacements of the body since the start.
constexpr std::array<PeakKind, 4> peak_kinds = {
    PeakKind{"peak N", unit::force}, PeakKind{"peak T", unit::force}, PeakKind{"peak normal", unit::length},
    PeakKind{"peak tangential", unit::length}};
constexpr std::array contact_columns = {"N", "T", "ut", "slip", "gap"};

EventRates in_scene(const EventRates& rates, const Factors& of) {
  EventRates r = rates;
  const auto scale = [&](const Unit& unit, std::initializer_list<double*> values) {
    for (double* x : values) *x *= scene::factor_of(unit, of);
  };
  scale(unit::time, {&r.t});
  scale(unit::length, {&r.gap});
  scale(unit::force, {&r.N, &r.T, &r.N_after, &r.T_after});
  scale(unit::velocity, {&r.vn, &r.vn_after, &r.vt, &r.vt_after});
  scale(unit::impulse, {&r.impulse_n, &r.impulse_t});
  return r;
}

}  // namespace

RateRecord::RateRecord(const Model& computed, const std::vector<ModelDerivative>& derivatives,
                       Recorder* recorder, Sensitivities& result, bool losses)
    : run::ForwardingRecorder(recorder), model_(computed), derivatives_(derivatives), result_(result) {
  for (const Column& column : model_.columns) result_.columns.push_back(column.name);
  for (const Contact& contact : model_.contacts) {
    result_.contacts.push_back(contact.name);
    for (const char* name : contact_columns) result_.columns.push_back(contact.name + "." + name);
  }
  if (losses) {
    landings_.emplace(computed, derivatives.size());
    for (const EnergyColumn& column : energy_columns)
      result_.columns.push_back(std::string("energy.") + column.name);
  }
  result_.value_rates.resize(derivatives_.size());
  peaks_.resize(model_.contacts.size());
}

void RateRecord::event(const Event& event) {
  run::ForwardingRecorder::event(event);
  result_.events.push_back(event);
  std::vector<EventRates>& row = result_.event_rates.emplace_back();
  for (const TangentState& state : *states_) {
    EventRates rates;
    if (event.contact >= 0)
      rates = state.rates[static_cast<std::size_t>(event.contact)];
    else
      rates.t = state.dt;
    row.push_back(in_scene(rates, model_.unit));
  }
}

void RateRecord::sample(const Sample& s) {
  run::ForwardingRecorder::sample(s);
  result_.times.push_back(s.t);
  std::vector<double>& row = result_.values.emplace_back();
  for (const Column& column : model_.columns) row.push_back(column.value(*s.u, *s.v));
  for (const ContactSample& c : s.contacts)
    for (const double x : {c.N, c.T, c.ut, c.slip, c.gap}) row.push_back(x);
  if (!landings_) return;
  for (const EnergyColumn& column : energy_columns) row.push_back(s.energy.*column.value);
}

void RateRecord::sample(const TangentSample& s, bool row, bool turn) {
  if (row) add_row(s);
  for (std::size_t c = 0; turn && c < model_.contacts.size(); ++c) update_at_turning_point(s, c);
  if (turn && landings_) landings_->turn(s);
}

void RateRecord::add_row(const TangentSample& s) {
  for (std::size_t p = 0; p < derivatives_.size(); ++p) {
    std::vector<double>& row = result_.value_rates[p].emplace_back(result_.columns.size(), nothing);
    const SeriesPoint& w = s.tangents[p];
    if (w.u.size() == 0) continue;
    const Vector u = run::to_scene_units(model_.physical(w.u), model_.physical_dofs(), 0, model_.unit);
    const Vector v = run::to_scene_units(model_.physical(w.v), model_.physical_dofs(), 1, model_.unit);
    std::size_t at = 0;
    for (const Column& column : model_.columns) row[at++] = column.value(u, v);
    for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
      const Contact& contact = model_.contacts[c];
      const ContactRates& rates = derivatives_[p].contacts[c];
      const ContactMotion m = parameter_rate(contact, rates, model_.layout, c, s.point, w, s.driven[p][c]);
      const double body = slide_rate(contact, rates, s.point, w, s.driven[p][c]).ut;
      const double kt = contact.tangential_stiffness.value_or(0.0);
      const double T = s.point.forces[static_cast<Eigen::Index>(model_.layout.tangent(c))];
      double slip = m.ut;
      if (kt > 0.0) slip = m.ut - m.T / kt + T * rates.tangential_stiffness / (kt * kt);
      if (kt > 0.0 && s.contact_states[c].state == State::stick) slip = s.anchors[p][c];
      row[at++] = m.N * factor(unit::force);
      row[at++] = m.T * factor(unit::force);
      row[at++] = body * factor(unit::length);
      row[at++] = slip * factor(unit::length);
      row[at++] = m.gap * factor(unit::length);
    }
    if (landings_) add_energies(s, p, row);
  }
}

/// Writes the derivatives of the energies into the last columns of a row.
void RateRecord::add_energies(const TangentSample& s, std::size_t p, std::vector<double>& row) const {
  const SeriesPoint& w = s.tangents[p];
  std::vector<ContactMotion> motions, rates;
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    const Contact& contact = model_.contacts[c];
    motions.push_back(motion_of(contact, c, s.forcing, s.t, s.point));
    rates.push_back(
        parameter_rate(contact, derivatives_[p].contacts[c], model_.layout, c, s.point, w, s.driven[p][c]));
  }
  Energy e = WorkTangent(model_, derivatives_[p])
                 .stored({s.contact_states, s.point.u, s.point.v, w.u, w.v, motions, rates});
  const WorkRates& lost = s.works[p];
  e.damping = lost.works.damping;
  e.friction = lost.friction();
  e.impact = lost.impact;
  e.loads = lost.works.loads;
  e.surface = lost.surface();
  std::size_t at = row.size() - energy_columns.size();
  for (const EnergyColumn& column : energy_columns) row[at++] = e.*column.value * factor(unit::energy);
}

void RateRecord::update_peak(std::size_t c, std::size_t which, double t, PeakCandidate seen) {
  Peak& peak = peaks_[c][which];
  if (!(std::abs(seen.value) > peak.size)) return;
  peak = {std::abs(seen.value), seen.value, t, seen.turn, std::move(seen.rates), std::move(seen.t_rates)};
}

/// At an extreme the rate is zero, so the derivative of the peak's value is its derivative at fixed time. An extreme that
/// coincides with an instant is a kink, and is recorded by update_at_instant().
void RateRecord::update_at_turning_point(const TangentSample& s, std::size_t c) {
  if (std::abs(s.t - instant_) <= resolution_) return;
  const Contact& contact = model_.contacts[c];
  const Vector first = s.point.u - model_.u0;
  const auto n = static_cast<Eigen::Index>(model_.layout.normal(c)),
             t = static_cast<Eigen::Index>(model_.layout.tangent(c));
  const auto [values, unused, bends] = watched(contact, model_.layout, c, model_.u0, s.point, s.force_bends);
  for (std::size_t which = 0; which < values.size(); ++which) {
    if (!(std::abs(values[which]) > peaks_[c][which].size)) continue;
    PeakCandidate seen{values[which], true, {}, {}};
    for (std::size_t p = 0; p < derivatives_.size(); ++p) {
      const SeriesPoint& w = s.tangents[p];
      double rate = nothing, bent = nothing;
      if (w.u.size() > 0) {
        const ContactRates& rates = derivatives_[p].contacts[c];
        const Vector moved = w.u - derivatives_[p].u0;
        const std::array<double, 4> by_p = {
            w.forces[n], w.forces[t], contact.normal.dot(moved) + rates.normal.dot(first),
            contact.body_tangent().dot(moved) + rates.body_tangent.dot(first)};
        const std::array<double, 4> slopes = {
            w.force_rates[n], w.force_rates[t], contact.normal.dot(w.v) + rates.normal.dot(s.point.v),
            contact.body_tangent().dot(w.v) + rates.body_tangent.dot(s.point.v)};
        rate = by_p[which];
        bent = bends[which] != 0.0 ? -slopes[which] / bends[which] : nothing;
      }
      seen.rates.push_back(rate);
      seen.t_rates.push_back(bent);
    }
    update_peak(c, which, s.t, std::move(seen));
  }
}

/// Records peaks on both sides of an instant, because forces may jump there.
void RateRecord::update_at_instant(const InstantMotion& motion, const std::vector<TangentState>& states,
                                   std::size_t c) {
  const Contact& contact = model_.contacts[c];
  const double t = motion.instant.t;
  for (Peak& peak : peaks_[c])
    if (peak.turn && std::abs(peak.t - t) <= motion.instant.resolution)
      peak = {};  // the code below records the same peak as a value at the instant
  const auto offer = [&](std::size_t which, double value, auto&& rate_of) {
    if (!(std::abs(value) > peaks_[c][which].size)) return;
    PeakCandidate seen{value, false, {}, {}};
    for (std::size_t p = 0; p < states.size(); ++p) {
      seen.rates.push_back(rate_of(p));
      seen.t_rates.push_back(states[p].rates[c].t);
    }
    update_peak(c, which, t, std::move(seen));
  };
  if (t > 0.0) {
    offer(0, motion.motion_before[c].N, [&](std::size_t p) { return states[p].rates[c].N; });
    offer(1, motion.motion_before[c].T, [&](std::size_t p) { return states[p].rates[c].T; });
  }
  offer(0, motion.motion_after[c].N, [&](std::size_t p) { return states[p].rates[c].N_after; });
  offer(1, motion.motion_after[c].T, [&](std::size_t p) { return states[p].rates[c].T_after; });
  const Vector first = motion.after.u - model_.u0;
  const auto along = [&](const Combination& form, const Combination ContactRates::*rates) {
    return [&, rates](std::size_t p) {
      if (!states[p].valid) return nothing;
      const TangentState& state = states[p];
      return form.dot(Vector(state.now.point.u - derivatives_[p].u0)) +
             (derivatives_[p].contacts[c].*rates).dot(first) + state.rates[c].t * form.dot(motion.after.v);
    };
  };
  offer(2, contact.normal.dot(first), along(contact.normal, &ContactRates::normal));
  offer(3, contact.body_tangent().dot(first), along(contact.body_tangent(), &ContactRates::body_tangent));
}

void RateRecord::at_instant(const InstantMotion& motion, const std::vector<TangentState>& states) {
  states_ = &states;
  instant_ = motion.instant.t;
  resolution_ = motion.instant.resolution;
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) update_at_instant(motion, states, c);
  if (landings_) landings_->instant(motion, states);
}

/// Adds the losses of the whole run, for each contact and in total.
void RateRecord::add_losses() {
  const Audit& audit = result_.report.audit;
  const auto add = [&](const char* name, int contact, double value, auto&& rate_of) {
    Response r{name, contact, value, result_.report.outcome.t, {}, {}};
    for (const TangentState& state : *states_) {
      r.rates.push_back(state.valid ? rate_of(state.works->now()) * factor(unit::energy) : nothing);
      r.t_rates.push_back(nothing);
    }
    result_.responses.push_back(std::move(r));
  };
  for (std::size_t c = 0; c < model_.contacts.size(); ++c)
    if (model_.contacts[c].has_friction())
      add("lost by friction", static_cast<int>(c), audit.friction_work[c],
          [&](const WorkRates& w) { return w.works.friction[c]; });
  const Energy& e = audit.final;
  add("lost by friction", -1, e.friction, [](const WorkRates& w) { return w.friction(); });
  add("lost by damping", -1, e.damping, [](const WorkRates& w) { return w.works.damping; });
  add("lost by impacts", -1, e.impact, [](const WorkRates& w) { return w.impact; });
  add("work of loads", -1, e.loads, [](const WorkRates& w) { return w.works.loads; });
  add("work of surfaces", -1, e.surface, [](const WorkRates& w) { return w.surface(); });
}

void RateRecord::add_landings() {
  const auto all = landings_->finish(*states_);
  for (std::size_t c = 0; c < all.size(); ++c) {
    const std::vector<Landing>& values = result_.report.landings[c];
    for (std::size_t i = 0; i < std::min(all[c].size(), values.size()); ++i) {
      MovingLanding landing = all[c][i];
      landing.value.start = values[i].start;
      landing.value.end = values[i].end;
      landing.value.impulse = values[i].impulse;
      landing.value.peak_force *= factor(unit::force);
      for (LandingRates& rates : landing.rates) {
        rates.start *= factor(unit::time);
        rates.end *= factor(unit::time);
        rates.impulse *= factor(unit::impulse);
        rates.peak_force *= factor(unit::force);
      }
      result_.landings.push_back(std::move(landing));
    }
  }
}

void RateRecord::finish() {
  const std::size_t parameters = derivatives_.size();
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    for (std::size_t which = 0; which < peak_kinds.size(); ++which) {
      Peak& peak = peaks_[c][which];
      if (peak.size == 0.0 || (which == 2 && model_.contacts[c].normal_force_given())) continue;
      const double f = factor(peak_kinds[which].of);
      Response r{peak_kinds[which].name,    static_cast<int>(c),   peak.value * f,
                 peak.t * model_.unit.time, std::move(peak.rates), std::move(peak.t_rates)};
      for (double& x : r.rates) x *= f;
      for (double& x : r.t_rates) x *= model_.unit.time;
      result_.responses.push_back(std::move(r));
    }
    if (result_.times.empty()) continue;
    constexpr std::array rests = {std::pair{"rest tangential", 2}, std::pair{"rest slip", 3}};
    for (const auto& [name, place] : rests) {
      const std::size_t column =
          model_.columns.size() + c * contact_columns.size() + static_cast<std::size_t>(place);
      Response r{name, static_cast<int>(c), result_.values.back()[column], result_.times.back(), {}, {}};
      for (std::size_t p = 0; p < parameters; ++p) {
        r.rates.push_back(result_.value_rates[p].back()[column]);
        r.t_rates.push_back(nothing);
      }
      result_.responses.push_back(std::move(r));
    }
  }
  if (!landings_ || states_ == nullptr) return;
  add_losses();
  add_landings();
}

}  // namespace signorini::sensitivity
