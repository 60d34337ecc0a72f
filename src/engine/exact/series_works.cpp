#include "engine/exact/series_works.hpp"

#include <gsl/gsl_integration.h>
#include <algorithm>
#include <memory>

#include "base/simd.hpp"
#include "contact/curved_surface.hpp"
#include "contact/law.hpp"

namespace signorini::exact {
namespace {

GaussRule make_rule(std::size_t count) {
  GaussRule rule;
  rule.count = count;
  const std::unique_ptr<gsl_integration_glfixed_table, void (*)(gsl_integration_glfixed_table*)> table(
      gsl_integration_glfixed_table_alloc(count), gsl_integration_glfixed_table_free);
  for (std::size_t i = 0; i < count; ++i)
    gsl_integration_glfixed_point(0.0, 1.0, i, &rule.x[i], &rule.w[i], table.get());
  return rule;
}

}  // namespace

const GaussRule& gauss_rule() {
  static const GaussRule rule = make_rule(GaussRule::nodes);
  return rule;
}

const GaussRule& short_gauss_rule() {
  static const GaussRule rule = make_rule(GaussRule::nodes / 2);
  return rule;
}

namespace {

constexpr std::size_t block = 16;  // degrees of freedom per block: their coefficients fit into the cache

/// Computes velocities v of a block of degrees of freedom at several times. a[k * stride + j]: coefficient k of degree of
/// freedom j. at: place in the series for each time and degree of freedom.
SIGNORINI_WIDE_LANES void velocities_of_block(const double* a, std::size_t stride, std::size_t degree,
                                              double scale, const double* at, std::size_t times, double* v) {
  constexpr std::size_t lanes = 4;
  for (std::size_t i = 0; i < times * block; ++i) v[i] = 0.0;
  for (std::size_t k = degree + 1; k >= 1; --k) {
    const double factor = static_cast<double>(k) / scale;
    double scaled[block];
    for (std::size_t j = 0; j < block; ++j) scaled[j] = factor * a[k * stride + j];
    for (std::size_t i = 0; i < times * block; i += block)
      for (std::size_t j = 0; j < block; j += lanes)
        base::lanes_at<base::Double4>(v + i + j).v =
            base::lanes_at<base::Double4>(v + i + j).v * base::lanes_at<base::Double4>(at + i + j).v +
            base::lanes_at<base::Double4>(scaled + j).v;
  }
}

}  // namespace

SeriesWorkIntegrals::SeriesWorkIntegrals(const Model& model, const linear::SystemMatrices& structure)
    : model_(model),
      structure_(structure),
      damped_(std::any_of(structure.c.begin(), structure.c.end(), [](double c) { return c != 0.0; })) {}

/// Computes velocities_ if the series of the degrees of freedom have different origins.
void SeriesWorkIntegrals::velocities_of_pieces(const Nodes& x, std::size_t count,
                                               const PatchedSeries& motion) {
  const Eigen::MatrixXd& u = motion.whole.u;
  const auto n = static_cast<std::size_t>(u.rows());
  std::array<double, block * nodes> at{}, v{};
  for (std::size_t done = 0; done < n; done += block) {
    // The last block overlaps the previous block.
    const std::size_t first = n < block ? 0 : std::min(done, n - block);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < block; ++j) at[i * block + j] = x[i] - motion.origins()[first + j];
    velocities_of_block(u.data() + first, n, motion.degree(), motion.whole.scale, at.data(), count, v.data());
    for (std::size_t i = 0; i < count; ++i)
      std::copy_n(v.data() + i * block, block, velocities_.col(static_cast<Eigen::Index>(i)).data() + first);
  }
}

void SeriesWorkIntegrals::velocities_at(const Nodes& x, std::size_t times, const PatchedSeries& motion) {
  velocities_.resize(motion.whole.u.rows(), nodes);
  if (!motion.origins().empty()) return velocities_of_pieces(x, times, motion);
  const motion::Series& series = motion.whole;
  const std::size_t degree = motion.degree();
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

void SeriesWorkIntegrals::add(const contact::ContactStates& states, const motion::Forcing& forcing,
                              const PatchedSeries& motion, double growth, double from, double to,
                              motion::WorkIntegrals& works) {
  const motion::Series& series = motion.whole;
  const std::vector<motion::ContactSeries>& contacts = motion.contacts();
  const std::size_t degree = motion.degree();
  const double h = to - from;
  if (!(h > 0.0)) return;
  const bool is_short = !motion.origins().empty() && growth * h <= short_angle;
  const GaussRule& rule = is_short ? short_gauss_rule() : gauss_rule();
  Nodes x{};
  for (std::size_t i = 0; i < rule.count; ++i) x[i] = (from + h * rule.x[i] - series.t) / series.scale;
  const bool loaded = forcing.has_loads();
  if (damped_ || loaded) velocities_at(x, rule.count, motion);
  for (std::size_t i = 0; i < rule.count && (damped_ || loaded); ++i) {
    const double* v = velocities_.col(static_cast<Eigen::Index>(i)).data();
    const double weight = h * rule.w[i];
    if (loaded) works.loads += weight * forcing.power(from + h * rule.x[i], v);
    if (damped_) works.damping += weight * structure_.damping_power(v);
  }
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Contact& contact = model_.contacts[c];
    const ContactState& state = states[c];
    if (contact.curved_surface())
      add_curved_surface(c, forcing, series, contacts[c], degree, from, to, works);
    if (!contact.obeys_coulomb()) {
      add_contact(c, forcing, series, contacts[c], from, to, works);
      continue;
    }
    if (state.state == State::inside) {
      const auto gap = [&](double t) {
        return contacts[c].value(motion::ContactSeries::gap, (t - series.t) / series.scale);
      };
      works.damping += contact::dashpot_loss_inside(contact, state.state, gap(from), gap(to));
    }
    if (state.is_open()) continue;
    if (!contact.normal_force_given()) {
      const auto pressed = [&](double time) {
        return contacts[c].integral(motion::ContactSeries::N, (time - series.t) / series.scale);
      };
      works.applied_normal_force[c] -= series.scale * (pressed(to) - pressed(from));
    }
    const int s = slip_sign(state.state);
    const bool moved = forcing.surface_moves(c);
    if (s == 0 && !moved && contact.normal_damping == 0.0) continue;
    slide_rate_.resize(degree + 1);
    if (s != 0) contacts[c].combine(contact::slip_rate(contact, s), slide_rate_.data());
    for (std::size_t i = 0; i < rule.count; ++i) {
      const double weight = h * rule.w[i];
      ContactIncrement path;
      double T = 0.0;
      if (s != 0 || moved) T = contacts[c].value(motion::ContactSeries::T, x[i]);
      if (s != 0) path.slip = motion::value_at(slide_rate_.data(), degree, x[i] - contacts[c].origin());
      if (moved) path.surface = forcing.surface(c, from + h * rule.x[i], 1);
      if (contact.normal_damping != 0.0)
        path.gap = path.gap_rate = contacts[c].value(motion::ContactSeries::vn, x[i]);
      works.add(c, contact::work_on(contact, state.state, 0.0, T, path), weight);
    }
  }
}

/// Adds the works of a contact with a user-defined law, which may dissipate power in every state.
void SeriesWorkIntegrals::add_contact(std::size_t c, const motion::Forcing& forcing,
                                      const motion::Series& series, const motion::ContactSeries& contact,
                                      double from, double to, motion::WorkIntegrals& works) const {
  const GaussRule& rule = gauss_rule();
  const double h = to - from;
  for (std::size_t i = 0; i < nodes; ++i) {
    const double t = from + h * rule.x[i], x = (t - series.t) / series.scale;
    const auto value = [&](motion::ContactSeries::Field field) { return contact.value(field, x); };
    const double rate = value(motion::ContactSeries::vn);
    const ContactIncrement path{value(motion::ContactSeries::vt), forcing.surface(c, t, 1), rate, rate, 1.0};
    works.add(c,
              contact::work_on(model_.contacts[c], State::open, value(motion::ContactSeries::N),
                               value(motion::ContactSeries::T), path),
              h * rule.w[i]);
  }
}

/// Adds the work of restoring_force(), the part of a curved surface's force that is not a linear spring, to the work of the
/// loads, also while the contact is open.
void SeriesWorkIntegrals::add_curved_surface(std::size_t c, const motion::Forcing& forcing,
                                             const motion::Series& series, const motion::ContactSeries& path,
                                             std::size_t degree, double from, double to,
                                             motion::WorkIntegrals& works) {
  const Contact& contact = model_.contacts[c];
  const GaussRule& rule = gauss_rule();
  const double h = to - from;
  slide_rate_.resize(degree + 1);
  for (std::size_t k = 0; k <= degree; ++k)
    slide_rate_[k] = static_cast<double>(k + 1) / series.scale *
                     contact.body_tangent().dot(series.u.col(static_cast<Eigen::Index>(k + 1)).data());
  for (std::size_t i = 0; i < nodes; ++i) {
    const double t = from + h * rule.x[i], x = (t - series.t) / series.scale;
    const double rate = motion::value_at(slide_rate_.data(), degree, x) - forcing.surface(c, t, 1);
    const double force = contact::restoring_force(contact, path.value(motion::ContactSeries::N, x),
                                                  path.value(motion::ContactSeries::slide, x));
    works.loads -= h * rule.w[i] * force * rate;
  }
}

}  // namespace signorini::exact
