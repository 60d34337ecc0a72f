#include "engine/exact/modal/damped_works.hpp"

#include <cmath>

#include "base/eigen_dense.hpp"
#include "contact/law.hpp"

namespace signorini {
namespace {

/// (e^(s h) - 1) / s where |s| h < 1e-3: the next term is 1e-15 of the sum.
std::complex<double> grown(std::complex<double> s, double h) {
  const std::complex<double> x = s * h;
  return h * (1.0 + x * (0.5 + x * (1.0 / 6.0 + x * (1.0 / 24.0 + x / 120.0))));
}

}  // namespace

void DampedWorks::start() {
  const Model& model = motion_.model();
  const double t = motion_.decision().jet.t;
  loads_.clear();
  factors_.clear();
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const Course factor = motion_.time().of(model.loads[i].history.piece(t));
    if (factor.isZero(0.0)) continue;
    loads_.push_back(motion_.derivative(motion_.of_load(i)));
    factors_.push_back(factor);
  }
  slips_.assign(model.contacts.size(), {});
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const int direction = slip_sign(motion_.decision().mode[c].state);
    if (direction != 0) slips_[c] = motion_.of(slip_rate(model.contacts[c], direction), c);
  }
  const Eigen::MatrixXd& rate = motion_.rate();
  if (!motion_.system().damped() || rate.isZero(0.0)) {
    course_loss_.resize(0, 0);
    return;
  }
  Eigen::MatrixXd damped = motion_.system().decay().asDiagonal() * rate;
  for (const ModalTerm& damper : motion_.system().dampers())
    damped += damper.u * (damper.damping * (damper.v.transpose() * rate));
  const Eigen::MatrixXcd rates = (motion_.state().modes.shape * motion_.root().asDiagonal()).transpose();
  course_loss_ = complex_product(rates, damped.cast<std::complex<double>>());
  still_loss_ = rate.transpose() * damped;
}

/// int (Re a . y)(Re b . y)
double DampedWorks::of_pairs(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b, const Stretch& s) const {
  const RootSums& sums = motion_.state().sums;
  const auto form = [&](const ModalPoint& at) {
    const Eigen::VectorXcd left = a.cwiseProduct(at.y), right = b.cwiseProduct(at.y);
    return 0.5 * (left.transpose() * (sums.plain * right + sums.turned * right.conjugate())).value().real();
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

/// int (Re row . y)(course . b)
double DampedWorks::with_course(const Eigen::VectorXcd& row, const Course& course, const Stretch& s) const {
  if (course.isZero(0.0) || row.isZero(0.0)) return 0.0;
  const Eigen::VectorXd from = motion_.time().at(s.from.time), to = motion_.time().at(s.to.time);
  const Eigen::VectorXcd& l = motion_.root();
  double sum = 0.0;
  for (Eigen::Index k = 0; k < l.size(); ++k) {
    if (row[k] == 0.0) continue;
    const ComplexCourse r = motion_.time().answer(-l[k], course.cast<std::complex<double>>());
    sum +=
        (row[k] * (s.to.y[k] * r.cwiseProduct(to).sum() - s.from.y[k] * r.cwiseProduct(from).sum())).real();
  }
  return sum;
}

double DampedWorks::integral(const ModalQuantity& f, const ModalQuantity& g, const Stretch& s) const {
  double sum = with_course(f.row, g.course, s) + with_course(g.row, f.course, s);
  if (!f.row.isZero(0.0) && !g.row.isZero(0.0)) sum += of_pairs(f.row, g.row, s);
  if (!f.course.isZero(0.0) && !g.course.isZero(0.0))
    sum += motion_.time().integral(f.course, g.course, s.from.time, s.to.time);
  return sum;
}

/// int q'^T C q'
double DampedWorks::loss(const Stretch& s) const {
  if (!motion_.system().damped()) return 0.0;
  const DampedState& state = motion_.state();
  const auto form = [&](const ModalPoint& at) {
    return 0.5 *
           (at.y.transpose() * (state.loss * at.y + state.loss_turned * at.y.conjugate())).value().real();
  };
  double sum = form(s.to) - form(s.from);
  const Eigen::VectorXcd& l = motion_.root();
  for (const auto& [k, i, turned, taken] : state.sums.slow) {
    const std::complex<double> right = turned ? std::conj(s.from.y[i]) : s.from.y[i];
    const std::complex<double> rate = l[k] + (turned ? std::conj(l[i]) : l[i]);
    sum += 0.5 * (taken * s.from.y[k] * right * grown(rate, s.to.time - s.from.time)).real();
  }
  if (course_loss_.size() == 0) return sum;
  const Eigen::VectorXd from = motion_.time().at(s.from.time), to = motion_.time().at(s.to.time);
  for (Eigen::Index k = 0; k < l.size(); ++k) {
    const ComplexCourse r = motion_.time().answer(-l[k], course_loss_.row(k).transpose());
    sum += 2.0 * (s.to.y[k] * r.cwiseProduct(to).sum() - s.from.y[k] * r.cwiseProduct(from).sum()).real();
  }
  for (Eigen::Index i = 0; i < still_loss_.rows(); ++i) {
    Course unit = Course::Zero(still_loss_.rows());
    unit[i] = 1.0;
    const Course row = still_loss_.row(i).transpose();
    if (!row.isZero(0.0)) sum += motion_.time().integral(unit, row, s.from.time, s.to.time);
  }
  return sum;
}

void DampedWorks::add_contact(std::size_t c, const Stretch& s, Works& works) const {
  const Contact& contact = motion_.model().contacts[c];
  const ContactState& state = motion_.decision().mode[c];
  const DampedMotion::ContactQuantities& own = motion_.contact(c);
  if (state.state == State::inside)
    works.damping +=
        inside_loss(contact, state.state, motion_.value(own.gap, s.from), motion_.value(own.gap, s.to));
  if (state.is_open()) return;
  const TimeBasis& time = motion_.time();
  const ModalQuantity one{Eigen::VectorXcd::Zero(motion_.root().size()), time.constant(1.0)};
  if (contact.has_gap()) works.pressing[c] -= integral(own.N, one, s);
  if (slip_sign(state.state) != 0) works.friction[c] += integral(own.T, slips_[c], s);
  const ModalQuantity moved{Eigen::VectorXcd::Zero(motion_.root().size()), time.derivative(own.surface)};
  if (!moved.course.isZero(0.0)) works.surface[c] -= integral(own.T, moved, s);
  if (contact.normal_damping != 0.0) {
    const ModalQuantity rate = motion_.derivative(own.gap);
    works.damping += contact.normal_damping * integral(rate, rate, s);
  }
}

void DampedWorks::add(const ModalPoint& from, const ModalPoint& to, Works& works) const {
  if (!(to.time > from.time)) return;
  const Stretch s{from, to};
  for (std::size_t i = 0; i < loads_.size(); ++i)
    works.loads += integral(loads_[i], {Eigen::VectorXcd::Zero(motion_.root().size()), factors_[i]}, s);
  works.damping += loss(s);
  for (std::size_t c = 0; c < motion_.model().contacts.size(); ++c) add_contact(c, s, works);
}

}  // namespace signorini
