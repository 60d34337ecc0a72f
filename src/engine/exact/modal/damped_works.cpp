#include "engine/exact/modal/damped_works.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/eigen_dense.hpp"
#include "contact/law.hpp"

namespace signorini::modal {
namespace {

/// Computes (e^(s h) - 1) / s for |s| h < 1e-3 by a power series. The omitted terms are at most 1e-15 of the sum.
std::complex<double> grown(std::complex<double> s, double h) {
  const std::complex<double> x = s * h;
  return h * (1.0 + x * (0.5 + x * (1.0 / 6.0 + x * (1.0 / 24.0 + x / 120.0))));
}

}  // namespace

void DampedWorkIntegrals::start() {
  const Model& model = motion_.model();
  const double t = motion_.decision().jet.t;
  has_forced_products_ = false;
  loads_.clear();
  std::vector<std::pair<TimeCoefficients, ModalQuantity>> alike;  // loads with equal histories are combined
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const TimeCoefficients factor = motion_.time().of(model.loads[i].history.piece(t));
    if (factor.isZero(0.0)) continue;
    const auto same =
        std::find_if(alike.begin(), alike.end(), [&](const auto& a) { return a.first == factor; });
    if (same == alike.end())
      alike.emplace_back(factor, motion_.load_quantity(i));
    else
      same->second += motion_.load_quantity(i);
  }
  for (const auto& [factor, load] : alike)
    loads_.push_back(product_integral(motion_.derivative(load), without_modes(factor)));
  contacts_.assign(model.contacts.size(), {});
  for (std::size_t c = 0; c < model.contacts.size(); ++c) prepare_contact(c);
  prepare_loss();
}

void DampedWorkIntegrals::prepare_contact(std::size_t c) {
  const Contact& contact = motion_.model().contacts[c];
  const ContactState& state = motion_.decision().states[c];
  if (state.is_open()) return;
  const DampedMotion::ContactQuantities& own = motion_.contact(c);
  const TimeBasis& time = motion_.time();
  ContactProducts& pairings = contacts_[c];
  if (!contact.normal_force_given())
    pairings.applied_normal_force = product_integral(own.N, without_modes(time.constant(1.0)));
  if (const int direction = slip_sign(state.state); direction != 0)
    pairings.slip = product_integral(own.T, motion_.quantity_of(contact::slip_rate(contact, direction), c));
  if (const TimeCoefficients moved = time.derivative(own.surface); !moved.isZero(0.0))
    pairings.surface = product_integral(own.T, without_modes(moved));
  if (contact.normal_damping != 0.0) {
    const ModalQuantity rate = motion_.derivative(own.gap);
    pairings.dashpot = product_integral(rate, rate);
  }
}

/// Prepares the parts of int q'^T C q' that are constant in a segment.
void DampedWorkIntegrals::prepare_loss() {
  loss_responses_.resize(0, 0);
  forced_loss_.resize(0, 0);
  const Eigen::MatrixXd& rate = motion_.forced_response_rate();
  if (!motion_.system().damped() || rate.isZero(0.0)) return;
  Eigen::MatrixXd damped = motion_.system().decay().asDiagonal() * rate;
  for (const ModalTerm& damper : motion_.system().dampers())
    damped += damper.u * (damper.damping * (damper.v.transpose() * rate));
  const Eigen::MatrixXcd rates = (motion_.state().modes.shape * motion_.root().asDiagonal()).transpose();
  const Eigen::MatrixXcd courses = base::complex_product(rates, damped.cast<std::complex<double>>());
  loss_responses_.resize(courses.rows(), courses.cols());
  for (Eigen::Index k = 0; k < courses.rows(); ++k)
    loss_responses_.row(k) =
        2.0 * motion_.time().response(-motion_.root()[k], courses.row(k).transpose()).transpose();
  forced_loss_ = rate.transpose() * damped;
  has_forced_products_ = has_forced_products_ || !forced_loss_.isZero(0.0);
}

ModalQuantity DampedWorkIntegrals::without_modes(TimeCoefficients course) const {
  return {Eigen::VectorXcd::Zero(motion_.root().size()), std::move(course)};
}

void DampedWorkIntegrals::add_responses(const Eigen::VectorXcd& row, const TimeCoefficients& course,
                                        Eigen::MatrixXcd& answers) const {
  if (course.isZero(0.0) || row.isZero(0.0)) return;
  if (answers.size() == 0) answers.setZero(row.size(), course.size());
  const ComplexTimeCoefficients complex = course.cast<std::complex<double>>();
  for (Eigen::Index k = 0; k < row.size(); ++k)
    if (row[k] != 0.0)
      answers.row(k) += row[k] * motion_.time().response(-motion_.root()[k], complex).transpose();
}

DampedWorkIntegrals::ProductIntegral DampedWorkIntegrals::product_integral(ModalQuantity f, ModalQuantity g) {
  ProductIntegral pairing;
  add_responses(f.row, g.time_coefficients, pairing.responses);
  add_responses(g.row, f.time_coefficients, pairing.responses);
  pairing.pairs = !f.row.isZero(0.0) && !g.row.isZero(0.0);
  pairing.courses = !f.time_coefficients.isZero(0.0) && !g.time_coefficients.isZero(0.0);
  has_forced_products_ = has_forced_products_ || pairing.courses;
  pairing.f = std::move(f);
  pairing.g = std::move(g);
  return pairing;
}

/// Returns the integral of (Re a . y)(Re b . y) over the interval s.
double DampedWorkIntegrals::integral_of_pairs(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b,
                                              const Stretch& s) const {
  const RootSums& sums = motion_.state().sums;
  const auto form = [&](const ModalPoint& at) {
    const Eigen::VectorXcd left = a.cwiseProduct(at.y), right = b.cwiseProduct(at.y);
    return 0.5 *
           (left.transpose() * (sums.direct * right + sums.conjugate * right.conjugate())).value().real();
  };
  double sum = form(s.to) - form(s.from);
  const Eigen::VectorXcd& l = motion_.root();
  for (const auto& [k, i, turned, taken] : sums.slow) {
    const std::complex<double> right = b[i] * s.from.y[i];
    const std::complex<double> rate = l[k] + (turned ? std::conj(l[i]) : l[i]);
    sum += 0.5 *
           (a[k] * s.from.y[k] * (turned ? std::conj(right) : right) * grown(rate, s.to.time - s.from.time))
               .real();
  }
  return sum;
}

/// Contribution of the products of modes and forced parts to an integral. answers: ProductIntegral::responses.
double DampedWorkIntegrals::integral_with_forced_part(const Eigen::MatrixXcd& answers, const Stretch& s) {
  if (answers.size() == 0) return 0.0;
  return (s.to.y.transpose() * (answers * s.b_to) - s.from.y.transpose() * (answers * s.b_from))
      .value()
      .real();
}

double DampedWorkIntegrals::integral(const ProductIntegral& pairing, const Stretch& s) const {
  double sum = integral_with_forced_part(pairing.responses, s);
  if (pairing.pairs) sum += integral_of_pairs(pairing.f.row, pairing.g.row, s);
  if (pairing.courses) sum += pairing.f.time_coefficients.dot(s.products * pairing.g.time_coefficients);
  return sum;
}

/// Returns the integral of q'^T C q' over the interval s.
double DampedWorkIntegrals::loss(const Stretch& s) const {
  if (!motion_.system().damped()) return 0.0;
  const DampedState& state = motion_.state();
  const auto form = [&](const ModalPoint& at) {
    return 0.5 *
           (at.y.transpose() * (state.loss * at.y + state.loss_conjugate * at.y.conjugate())).value().real();
  };
  double sum = form(s.to) - form(s.from);
  const Eigen::VectorXcd& l = motion_.root();
  for (const auto& [k, i, turned, taken] : state.sums.slow) {
    const std::complex<double> right = turned ? std::conj(s.from.y[i]) : s.from.y[i];
    const std::complex<double> rate = l[k] + (turned ? std::conj(l[i]) : l[i]);
    sum += 0.5 * (taken * s.from.y[k] * right * grown(rate, s.to.time - s.from.time)).real();
  }
  sum += integral_with_forced_part(loss_responses_, s);
  if (forced_loss_.size() > 0 && s.products.size() > 0) sum += forced_loss_.cwiseProduct(s.products).sum();
  return sum;
}

void DampedWorkIntegrals::add_contact(std::size_t c, const Stretch& s, motion::WorkIntegrals& works) const {
  const Contact& contact = motion_.model().contacts[c];
  const ContactState& state = motion_.decision().states[c];
  const DampedMotion::ContactQuantities& own = motion_.contact(c);
  if (state.state == State::inside)
    works.damping += contact::dashpot_loss_inside(contact, state.state, motion_.value(own.gap, s.from),
                                                  motion_.value(own.gap, s.to));
  const ContactProducts& pairings = contacts_[c];
  if (pairings.applied_normal_force)
    works.applied_normal_force[c] -= integral(*pairings.applied_normal_force, s);
  if (pairings.slip) works.friction[c] += integral(*pairings.slip, s);
  if (pairings.surface) works.surface[c] -= integral(*pairings.surface, s);
  if (pairings.dashpot) works.damping += contact.normal_damping * integral(*pairings.dashpot, s);
}

void DampedWorkIntegrals::add(const ModalPoint& from, const ModalPoint& to,
                              motion::WorkIntegrals& works) const {
  if (!(to.time > from.time)) return;
  const TimeBasis& time = motion_.time();
  const Stretch s{from, to, time.at(from.time), time.at(to.time),
                  has_forced_products_ ? time.products(from.time, to.time) : Eigen::MatrixXd()};
  for (const ProductIntegral& load : loads_) works.loads += integral(load, s);
  works.damping += loss(s);
  for (std::size_t c = 0; c < contacts_.size(); ++c) add_contact(c, s, works);
}

}  // namespace signorini::modal
