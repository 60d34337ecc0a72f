#include "engine/exact/series_works.hpp"

#include <algorithm>

#include "contact/bowl.hpp"
#include "contact/law.hpp"
#include "engine/exact/gauss_rule.hpp"

namespace signorini {

SeriesWorks::SeriesWorks(const Model& model, const Structure& structure)
    : model_(model),
      structure_(structure),
      damped_(std::any_of(structure.c.begin(), structure.c.end(), [](double c) { return c != 0.0; })) {}

void SeriesWorks::velocities_at(const Nodes& x, const Series& series, std::size_t degree) {
  const auto count = static_cast<Eigen::Index>(degree + 1);
  const Eigen::Index n = series.u.rows();
  if (n < 4) {
    velocities_.setZero(n, nodes);
    for (Eigen::Index k = count; k >= 1; --k)
      for (Eigen::Index j = 0; j < n; ++j) {
        const double v = static_cast<double>(k) / series.scale * series.u(j, k);
        for (std::size_t i = 0; i < nodes; ++i) {
          double& sum = velocities_(j, static_cast<Eigen::Index>(i));
          sum = sum * x[i] + v;
        }
      }
  } else {
    powers_.resize(count, nodes);
    for (std::size_t i = 0; i < nodes; ++i) {
      double power = 1.0 / series.scale;
      for (Eigen::Index k = 0; k < count; ++k, power *= x[i])
        powers_(k, static_cast<Eigen::Index>(i)) = static_cast<double>(k + 1) * power;
    }
    velocities_.noalias() = series.u.middleCols(1, count) * powers_;
  }
}

void SeriesWorks::add(const Mode& mode, const Forcing& forcing, const Series& series,
                      const std::vector<ContactSeries>& contacts, std::size_t degree, double from, double to,
                      Works& works) {
  const GaussRule& rule = gauss_rule();
  const double h = to - from;
  if (!(h > 0.0)) return;
  Nodes x{};
  for (std::size_t i = 0; i < nodes; ++i) x[i] = (from + h * rule.x[i] - series.t) / series.scale;
  const bool loaded = forcing.loaded();
  if (damped_ || loaded) velocities_at(x, series, degree);
  for (std::size_t i = 0; i < nodes && (damped_ || loaded); ++i) {
    const double* v = velocities_.col(static_cast<Eigen::Index>(i)).data();
    const double weight = h * rule.w[i];
    if (loaded) works.loads += weight * forcing.power(from + h * rule.x[i], v);
    if (damped_) works.damping += weight * structure_.damping_power(v);
  }
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Contact& contact = model_.contacts[c];
    const ContactState& state = mode[c];
    if (contact.bowl) add_bowl(c, forcing, series, contacts[c], degree, from, to, works);
    if (contact.own) {
      add_own(c, forcing, series, contacts[c], from, to, works);
      continue;
    }
    if (state.state == State::inside) {
      const auto gap = [&](double t) {
        return contacts[c].value(ContactSeries::gap, (t - series.t) / series.scale);
      };
      works.damping += inside_loss(contact, state.state, gap(from), gap(to));
    }
    if (state.is_open()) continue;
    if (contact.has_gap()) {
      const auto pressed = [&](double time) {
        return contacts[c].integral(ContactSeries::N, (time - series.t) / series.scale);
      };
      works.pressing[c] -= series.scale * (pressed(to) - pressed(from));
    }
    const int s = slip_sign(state.state);
    const bool moved = forcing.moves(c);
    if (s == 0 && !moved && contact.normal_damping == 0.0) continue;
    slide_rate_.resize(degree + 1);
    if (s != 0) contacts[c].combine(slip_rate(contact, s), slide_rate_.data());
    for (std::size_t i = 0; i < nodes; ++i) {
      const double weight = h * rule.w[i];
      ContactPath path;
      double T = 0.0;
      if (s != 0 || moved) T = contacts[c].value(ContactSeries::T, x[i]);
      if (s != 0) path.slip = value_at(slide_rate_.data(), degree, x[i]);
      if (moved) path.surface = forcing.surface(c, from + h * rule.x[i], 1);
      if (contact.normal_damping != 0.0)
        path.gap = path.gap_rate = contacts[c].value(ContactSeries::vn, x[i]);
      works.add(c, work_on(contact, state.state, 0.0, T, path), weight);
    }
  }
}

/// A law of one's own takes power in every state.
void SeriesWorks::add_own(std::size_t c, const Forcing& forcing, const Series& series,
                          const ContactSeries& contact, double from, double to, Works& works) const {
  const GaussRule& rule = gauss_rule();
  const double h = to - from;
  for (std::size_t i = 0; i < nodes; ++i) {
    const double t = from + h * rule.x[i], x = (t - series.t) / series.scale;
    const auto value = [&](ContactSeries::Field field) { return contact.value(field, x); };
    const double rate = value(ContactSeries::vn);
    const ContactPath path{value(ContactSeries::vt), forcing.surface(c, t, 1), rate, rate, 1.0};
    works.add(
        c, work_on(model_.contacts[c], State::open, value(ContactSeries::N), value(ContactSeries::T), path),
        h * rule.w[i]);
  }
}

/// What a curved surface returns beside its spring is work of the loads, off the surface too.
void SeriesWorks::add_bowl(std::size_t c, const Forcing& forcing, const Series& series,
                           const ContactSeries& path, std::size_t degree, double from, double to,
                           Works& works) {
  const Contact& contact = model_.contacts[c];
  const GaussRule& rule = gauss_rule();
  const double h = to - from;
  slide_rate_.resize(degree + 1);
  for (std::size_t k = 0; k <= degree; ++k)
    slide_rate_[k] = static_cast<double>(k + 1) / series.scale *
                     contact.body_tangent().dot(series.u.col(static_cast<Eigen::Index>(k + 1)).data());
  for (std::size_t i = 0; i < nodes; ++i) {
    const double t = from + h * rule.x[i], x = (t - series.t) / series.scale;
    const double rate = value_at(slide_rate_.data(), degree, x) - forcing.surface(c, t, 1);
    const double force =
        bowl_force(contact, path.value(ContactSeries::N, x), path.value(ContactSeries::slide, x));
    works.loads -= h * rule.w[i] * force * rate;
  }
}

}  // namespace signorini
