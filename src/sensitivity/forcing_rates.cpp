#include "sensitivity/forcing_rates.hpp"

#include <cmath>
#include <numbers>

namespace signorini::sensitivity {

void add_rate_series(const Piece& piece, const Piece& rates, double t, double scale, std::size_t count,
                     double factor, double* out) {
  std::vector<double> series(count);
  const auto add = [&](const Piece& part, double times) {
    part.taylor(t, scale, count, series.data());
    for (std::size_t k = 0; k < count; ++k) out[k] += factor * times * series[k];
  };
  Piece shape{piece.origin, rates.coefficients, rates.amplitude, piece.omega, piece.phase};
  for (std::size_t j = 0; j + 1 < piece.coefficients.size(); ++j)
    shape.coefficients[j] -= rates.origin * static_cast<double>(j + 1) * piece.coefficients[j + 1];
  add(shape, 1.0);
  const double turn = rates.phase - piece.omega * rates.origin;
  if (piece.amplitude == 0.0 || (turn == 0.0 && rates.omega == 0.0)) return;
  const Piece cosine{piece.origin, {}, piece.amplitude, piece.omega, piece.phase + 0.5 * std::numbers::pi};
  cosine.taylor(t, scale, count, series.data());
  const double constant = turn + rates.omega * (t - piece.origin), slope = rates.omega * scale;
  for (std::size_t k = 0; k < count; ++k)
    out[k] += factor * (constant * series[k] + (k > 0 ? slope * series[k - 1] : 0.0));
}

namespace {

const Piece& piece_in_force(const History& history, double t, motion::Side side) {
  return side == motion::Side::after ? history.piece(t) : history.piece_before(t);
}

const Piece* rates_of(const HistoryRates& rates, const History& history, const Piece& piece) {
  if (rates.none()) return nullptr;
  return &rates.pieces[static_cast<std::size_t>(&piece - history.pieces().data())];
}

}  // namespace

ForcingRates::ForcingRates(const Model& model, const ModelDerivative& derivative, double t, motion::Side side)
    : model_(&model), derivative_(&derivative) {
  const auto part = [&](const History& history, const HistoryRates& rates) {
    const Piece& piece = piece_in_force(history, t, side);
    return Part{&piece, rates_of(rates, history, piece)};
  };
  for (std::size_t i = 0; i < model.loads.size(); ++i)
    loads_.push_back(part(model.loads[i].history, derivative.loads[i].history));
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    applied_normal_force_.push_back(
        part(model.contacts[c].normal_force, derivative.contacts[c].normal_force));
    surface_.push_back(part(model.contacts[c].surface_motion, derivative.contacts[c].surface_motion));
  }
}

void ForcingRates::expand(double t, double scale, std::size_t count, ForcingDerivatives& out) const {
  out.count = count;
  out.loaded = false;
  out.load.setZero(model_->size(), static_cast<Eigen::Index>(count));
  std::vector<double> series(count);
  const auto put = [&](const Combination& direction) {
    out.loaded = true;
    for (const auto& [dof, factor] : direction.terms)
      for (std::size_t k = 0; k < count; ++k)
        out.load(dof, static_cast<Eigen::Index>(k)) += factor * series[k];
  };
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    const Combination& turning = derivative_->loads[i].direction;
    if (std::any_of(turning.terms.begin(), turning.terms.end(),
                    [](const auto& x) { return x.second != 0.0; })) {
      loads_[i].piece->taylor(t, scale, count, series.data());
      put(turning);
    }
    if (!loads_[i].rates) continue;
    std::fill(series.begin(), series.end(), 0.0);
    add_rate_series(*loads_[i].piece, *loads_[i].rates, t, scale, count, 1.0, series.data());
    put(model_->loads[i].direction);
  }
  const auto fill = [&](const std::vector<Part>& parts, std::vector<double>& rows) {
    rows.assign(parts.size() * count, 0.0);
    for (std::size_t c = 0; c < parts.size(); ++c)
      if (parts[c].rates)
        add_rate_series(*parts[c].piece, *parts[c].rates, t, scale, count, 1.0, rows.data() + c * count);
  };
  fill(applied_normal_force_, out.applied_normal_force);
  fill(surface_, out.surface);
}

std::vector<MovingBreakpoint> breakpoints_at(const Model& model, const ModelDerivative& derivative, double t,
                                             double resolution) {
  std::vector<MovingBreakpoint> found;
  const auto look = [&](const History& history, const HistoryRates& rates, int load) {
    const std::vector<double>& starts = history.starts();
    for (std::size_t i = 0; i < starts.size(); ++i)
      if (std::abs(starts[i] - t) <= resolution)
        found.push_back({starts[i], rates.none() ? 0.0 : rates.starts[i], load});
  };
  for (std::size_t i = 0; i < model.loads.size(); ++i)
    look(model.loads[i].history, derivative.loads[i].history, static_cast<int>(i));
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    look(model.contacts[c].normal_force, derivative.contacts[c].normal_force, -1);
    look(model.contacts[c].surface_motion, derivative.contacts[c].surface_motion, -1);
  }
  return found;
}

}  // namespace signorini::sensitivity
