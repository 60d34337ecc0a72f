#include "engine/exact/modal/damped_flow.hpp"

#include <algorithm>

#include "base/eigen_dense.hpp"
#include "engine/exact/modal/modal_flow.hpp"

namespace signorini::modal {

std::string DampedFlow::start(const engine::Segment& segment, const Vector& q, const Vector& rate,
                              ModalPoint& now) {
  if (std::string why = motion_.start(segment, q, rate, now); !why.empty()) return why;
  proof_.start();
  works_.start();
  return {};
}

void DampedFlow::find_turning_points(const ModalPoint& from, double begin, double length, bool observed,
                                     events::TurningPointDetector& turning, LastTurningTimes& turns) {
  const auto advance = [&](const ModalPoint& at, double step, ModalPoint& to) {
    motion_.advance(at, step, to);
  };
  find_turning_points_in_passage(proof_, advance, from, begin, length, observed, turning, turns);
}

void DampedFlow::forces(const ModalPoint& at, motion::Point& point) const {
  const ForceLayout& layout = motion_.model().layout;
  double* const forces = point.forces.data();
  for (std::size_t c = 0; c < motion_.model().contacts.size(); ++c) {
    forces[layout.normal(c)] = motion_.value(motion_.contact(c).N, at);
    forces[layout.tangent(c)] = motion_.value(motion_.contact(c).T, at);
  }
}

namespace {

constexpr double max_round_trip_error = 1e-12, max_condition = 1e4;  // same as in spectrum.cpp

}  // namespace

void test_round_trip(const DampedPencil& pencil, DampedModes& out) {
  const Eigen::Index n = pencil.size();
  const std::vector<ModalTerm>& terms = pencil.terms();
  Eigen::VectorXd size =
      pencil.omega_squared().cwiseMax(pencil.omega_squared().cwiseAbs().maxCoeff() * 1e-12);
  for (std::size_t a = 0; a < terms.size(); ++a)
    if (!terms[a].rigid) size += pencil.stiffness(a) * terms[a].u.cwiseProduct(terms[a].v).cwiseAbs();
  size = size.cwiseSqrt().eval();
  if (!(size.maxCoeff() > 0.0)) size.setOnes();
  Eigen::VectorXd q(n), rate(n);
  double entry = 0.5;
  for (Eigen::VectorXd* x : {&q, &rate})
    for (Eigen::Index i = 0; i < n; ++i) {  // logistic map: all modes are excited, equally in every run
      entry = 3.99 * entry * (1.0 - entry) + 1e-3;
      (*x)[i] = 2.0 * entry - 1.0;
    }
  Eigen::MatrixXd forces(n, static_cast<Eigen::Index>(terms.size())), forms = forces;
  Eigen::Index rigid = 0;
  for (const ModalTerm& term : terms)
    if (term.rigid) {
      forces.col(rigid) = term.u;
      forms.col(rigid++) = term.v;
    }
  const auto within = [&](Eigen::VectorXd x) {
    if (rigid == 0) return x;
    const auto u = forces.leftCols(rigid), v = forms.leftCols(rigid);
    for (int twice = 0; twice < 2; ++twice) x -= u * base::solve_dense(v.transpose() * u, v.transpose() * x);
    return x;
  };
  const Eigen::VectorXd place = within(q.cwiseQuotient(size));
  rate = within(rate);
  const Eigen::VectorXcd y = out.from_q * place + out.from_rate * rate;
  const Eigen::VectorXd back = within((out.shape * y).real() - place),
                        rate_back = within((out.shape * out.root.cwiseProduct(y)).real() - rate);
  const double scale =
      std::max({1.0, place.cwiseProduct(size).cwiseAbs().maxCoeff(), rate.cwiseAbs().maxCoeff()});
  out.round_trip = std::sqrt(back.cwiseProduct(size).squaredNorm() + rate_back.squaredNorm()) / scale;
  if (!(out.round_trip < max_round_trip_error))
    out.failure =
        "the modes of the contact state are inaccurate: a motion changes by conversion to modes and back";
  else if (!(out.condition < max_condition))
    out.failure = "the modes of the contact state are nearly linearly dependent";
}

}  // namespace signorini::modal
