#include "sensitivity/tangent_state.hpp"

#include <algorithm>
#include <utility>

#include "engine/exact/series_works.hpp"

namespace signorini::sensitivity {
namespace {

constexpr int max_halvings = 30;
constexpr int min_tangent_levels = 12;
constexpr double step_growth = 1.5;  // length of the next part / length of the last part that converged
constexpr int turn_places = 24;  // intervals in which a step is searched for maxima: a quarter radian each
// A product of two motions oscillates twice as fast as the motions, so a step of six radians needs two sets of ten Gauss
// points. The relative error is then 6^21 (10!)^4 / (21 (20!)^3) = 1e-14.
constexpr std::size_t work_parts = 2;

}  // namespace

Vector force_bends(const motion::Series& series, std::size_t degree, double x) {
  Vector sum = Vector::Zero(series.forces.rows());
  for (std::size_t k = degree; k-- > 0;) {
    if (k + 2 > degree) continue;
    const double factor = static_cast<double>((k + 1) * (k + 2)) / (series.scale * series.scale);
    sum = sum * x + factor * series.forces.col(static_cast<Eigen::Index>(k + 2));
  }
  return sum;
}

std::vector<double> compression_maxima(const Model& model, const run::RunStep& step) {
  const engine::Expansion& e = step.facts.expansion;
  std::vector<double> turns;
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    if (model.contacts[c].normal_force_given() || step.decision.states[c].is_open()) continue;
    const auto row = static_cast<Eigen::Index>(model.layout.normal(c));
    const auto slope = [&](double x) {
      double sum = 0.0;
      for (std::size_t k = e.degree; k > 0; --k)
        sum = sum * x + static_cast<double>(k) * e.series->forces(row, static_cast<Eigen::Index>(k));
      return sum;
    };
    for (int i = 0; i < turn_places; ++i) {
      double lo = e.x * i / turn_places, hi = e.x * (i + 1) / turn_places;
      if (!(slope(lo) < 0.0 && slope(hi) >= 0.0)) continue;
      for (double x = 0.5 * (lo + hi); x > lo && x < hi; x = 0.5 * (lo + hi)) (slope(x) < 0.0 ? lo : hi) = x;
      turns.push_back(e.series->t + e.series->scale * hi);
    }
  }
  return turns;
}

SeriesTangents::SeriesTangents(const Model& model, motion::StateSystems& systems,
                               const std::vector<const ModelDerivative*>& data, bool losses)
    : model_(model), systems_(systems), touched_(contact_dofs(model, data)), losses_(losses) {}

/// System of the contact states with friction at the slip rates at the beginning of a series.
motion::StateSystemPtr SeriesTangents::system_at(const motion::StateSystem& system,
                                                 const motion::Series& series) const {
  std::vector<Form> rows;
  for (const std::size_t c : system.factorised().rate_dependent)
    rows.push_back(motion::FrictionSeries(model_.contacts[c], c, slip_sign(system.states()[c].state),
                                          system.rows()[c].normal, series)
                       .row());
  return systems_.with_friction(system, rows);
}

/// Adds the derivatives of the work over [from, to] of the step. begin: position in the step at which the tangent's series
/// begins.
void SeriesTangents::integrate(TangentState& state, const run::RunStep& step, double begin, double from,
                               double to) const {
  const engine::Expansion& e = step.facts.expansion;
  const exact::GaussRule& rule = exact::gauss_rule();
  const ForcingDerivatives& forcing = state.series.forcing();
  const double h = (to - from) / work_parts;
  if (!(h > 0.0)) return;
  std::vector<double> x, own;
  for (std::size_t i = 0; i < work_parts * exact::GaussRule::nodes; ++i) {
    x.push_back(from +
                h * (static_cast<double>(i / exact::GaussRule::nodes) + rule.x[i % exact::GaussRule::nodes]));
    own.push_back(x.back() - begin);
  }
  std::vector<SeriesPoint> motion =
      points_at(e.series->u, e.series->forces, e.series->scale, e.degree, x, touched_);
  std::vector<SeriesPoint> tangent = state.series.at(own, touched_);
  TangentPlace place{0.0, step.forcing, step.decision.states, {}, {}, {}, Vector::Zero(model_.size())};
  for (std::size_t i = 0; i < x.size(); ++i) {
    place.t = e.series->t + e.series->scale * x[i];
    place.motion = std::move(motion[i]);
    place.tangent = std::move(tangent[i]);
    place.driven.clear();
    for (std::size_t c = 0; c < model_.contacts.size(); ++c)
      place.driven.push_back(driven_rates(forcing, e.series->scale, c, own[i]));
    if (forcing.loaded) {
      place.load.setZero();
      for (Eigen::Index k = forcing.load.cols(); k-- > 0;)
        place.load = place.load * own[i] + forcing.load.col(k);
    }
    state.works->add(place, h * e.series->scale * rule.w[i % exact::GaussRule::nodes]);
  }
}

/// Advances one tangent to the end of the step, part by part.
void SeriesTangents::advance(TangentState& state, const run::RunStep& step,
                             const std::vector<RequestedPlace>& wanted, std::vector<TangentSample>& samples,
                             std::size_t p) const {
  const engine::Expansion& e = step.facts.expansion;
  const motion::StateSystem* system = e.system != nullptr ? e.system : step.decision.system.get();
  motion::StateSystemPtr own;
  const int levels = std::max(min_tangent_levels, static_cast<int>(step.forcing.max_degree()) + 2);
  motion::Series moved;
  std::size_t next = 0;
  double from = 0.0;
  int halvings = 0;
  while (from < e.x || from == 0.0) {
    const double rest = e.x - from;
    double length = rest;
    if (state.reach > 0.0) length = std::min(rest, step_growth * state.reach / e.series->scale);
    if (length < rest && length > 0.6 * rest) length = 0.5 * rest;
    if (from > 0.0) recentre(*e.series, step.forcing, from, 1.0, moved);
    const motion::Series& motion = from > 0.0 ? moved : *e.series;
    if (from > 0.0 && !system->factorised().rate_dependent.empty() && (own = system_at(*system, moved)))
      system = own.get();
    while (length > 0.0 &&
           !state.series.expand(*system, motion, *state.forcing, state.now.start, length, levels)) {
      if (++halvings > max_halvings) {
        state.valid = false;
        state.valid_until = motion.t;
        state.reason = "the Taylor series of the tangent does not converge";
        return;
      }
      length *= 0.5;
      state.reach = length * e.series->scale;
    }
    if (length == 0.0)
      state.series.expand_to(*system, motion, *state.forcing, state.now.start, motion.levels);
    else
      state.reach = std::max(state.reach, length * e.series->scale);
    if (length > 0.0) state.error += state.series.error();
    const double to = length == rest ? e.x : from + length;
    double done = from;  // the work up to this position is already added
    for (; next < wanted.size() && wanted[next].x <= to; ++next) {
      const double x = wanted[next].x - from;
      samples[next].tangents[p] = state.series.at(x);
      for (std::size_t c = 0; c < model_.contacts.size(); ++c)
        samples[next].driven[p].push_back(driven_rates(state.series.forcing(), e.series->scale, c, x));
      samples[next].anchors[p] = state.now.start.anchors;
      if (!losses_) continue;
      integrate(state, step, from, std::exchange(done, wanted[next].x), wanted[next].x);
      samples[next].works[p] = state.works->now();
    }
    if (losses_) integrate(state, step, from, done, to);
    state.now.point = state.series.at(length);
    state.now.driven.clear();
    for (std::size_t c = 0; c < model_.contacts.size(); ++c)
      state.now.driven.push_back(driven_rates(state.series.forcing(), e.series->scale, c, length));
    state.now.start.u = state.now.point.u;
    state.now.start.v = state.now.point.v;
    if (to >= e.x) break;
    from = to;
  }
}

}  // namespace signorini::sensitivity
