#include "witness/massless_rates.hpp"

#include <Eigen/SparseLU>
#include <cmath>

#include "base/rounding.hpp"

namespace signorini {
namespace {

/// The rows without mass that tell velocities, on degrees of freedom without mass alone.
class RateRows {
 public:
  RateRows(const Bench& bench, const WitnessedSide& side)
      : bench_(bench), place_(static_cast<std::size_t>(bench.model.size()), -1) {
    for (const int i : bench.massless()) place_[static_cast<std::size_t>(i)] = size_++;
    damped_.assign(static_cast<std::size_t>(size_), false);
    for (const int i : bench.massless())
      for (SparseMatrix::InnerIterator it(bench.damping_by_rows(), i); it; ++it)
        if (it.value() != 0.0) damped_[at(i)] = true;
    for (const std::size_t k : bench.on_massless()) note_dashpot(k, side);
    for (const int i : bench.massless())
      add_row(i, damped_[at(i)] ? bench.damping_by_rows() : bench.stiffness_by_rows());
    for (const std::size_t k : bench.on_massless()) add_contact(k, side);
  }

  [[nodiscard]] bool damped(int dof) const { return damped_[at(dof)]; }
  /// S^T x = f; empty: S does not tell it.
  [[nodiscard]] Vector weights(const Combination& form, double factor, const Combination& more,
                               double factor_of_more) const {
    if (!told_) return {};
    Vector f = Vector::Zero(size_);
    for (const auto& [dof, value] : form.terms)
      if (exists(dof)) f[place_[static_cast<std::size_t>(dof)]] += factor * value;
    for (const auto& [dof, value] : more.terms)
      if (exists(dof)) f[place_[static_cast<std::size_t>(dof)]] += factor_of_more * value;
    SparseMatrix transposed(size_, size_);
    transposed.setFromTriplets(terms_.begin(), terms_.end());
    Eigen::SparseLU<SparseMatrix> lu(transposed);
    if (lu.info() != Eigen::Success) return {};
    const Vector x = lu.solve(f);
    const bool solved = x.allFinite() && (transposed * x - f).norm() <= of_solve * f.norm();
    return solved ? x : Vector();
  }

 private:
  // Half of the digits: a system that keeps fewer tells no velocity.
  static constexpr double of_solve = 1e-8;

  [[nodiscard]] std::size_t at(int dof) const {
    return static_cast<std::size_t>(place_[static_cast<std::size_t>(dof)]);
  }
  [[nodiscard]] bool exists(int dof) const { return place_[static_cast<std::size_t>(dof)] >= 0; }
  [[nodiscard]] static bool closed(const Contact& c, const ContactState& state) {
    return !is_open(state.state) && !c.is_pressed();
  }
  void note_dashpot(std::size_t k, const WitnessedSide& side) {
    const Contact& c = bench_.model.contacts[k];
    const ContactState& state = (*side.mode)[k];
    if (c.own || c.shear || c.friction.varies() || c.takes_impulses() ||
        (kind_of(state.state) == State::stick && !c.tangential_stiffness))
      told_ = false;
    if (!closed(c, state) || c.normal_damping == 0.0) return;
    for (const Combination* form : {&c.normal, &c.tangent})
      for (const auto& [dof, factor] : form->terms)
        if (exists(dof) && (form == &c.normal || sign_of_slip(state.state) != 0)) damped_[at(dof)] = true;
  }
  void add(int row, int column, double value) {
    if (exists(column)) terms_.emplace_back(static_cast<int>(at(column)), static_cast<int>(at(row)), value);
  }
  void add_row(int row, const SparseMatrix& by_rows) {
    for (SparseMatrix::InnerIterator it(by_rows, row); it; ++it)
      add(row, static_cast<int>(it.row()), it.value());
  }
  /// N = kn g + cn g', T = kt ut or -s fk N: their derivatives by g' and ut', or by those of g and ut.
  void add_contact(std::size_t k, const WitnessedSide& side) {
    const Contact& c = bench_.model.contacts[k];
    const ContactState& state = (*side.mode)[k];
    const double sliding = -sign_of_slip(state.state) * c.friction.kinetic;
    const auto add_force = [&](const Combination& along, const Combination& by, double spring,
                               double dashpot) {
      for (const auto& [row, factor] : along.terms) {
        if (!exists(row)) continue;
        const double stiffness = damped(row) ? dashpot : spring;
        for (const auto& [column, other] : by.terms) add(row, column, factor * stiffness * other);
      }
    };
    if (closed(c, state)) {
      add_force(c.normal, c.normal, c.normal_stiffness, c.normal_damping);
      if (sliding != 0.0)
        add_force(c.tangent, c.normal, sliding * c.normal_stiffness, sliding * c.normal_damping);
    }
    if (kind_of(state.state) == State::stick)
      add_force(c.tangent, c.tangent, c.tangential_stiffness.value_or(0.0), 0.0);
  }

  const Bench& bench_;
  std::vector<int> place_;
  std::vector<bool> damped_;
  std::vector<Eigen::Triplet<double>> terms_;  // of S^T
  int size_ = 0;
  bool told_ = true;
};

}  // namespace

double noise_of_slip_rate(const Bench& bench, const WitnessedSide& side, std::size_t k) {
  if (bench.massless().empty() || bench.own_response(k) != nullptr || side.loads.empty()) return 0.0;
  const Contact& c = bench.model.contacts[k];
  const RateRows rows(bench, side);
  // p' = s (ut' + s fk/kt N') > 0: with a spring between body and sliding point N' counts, too.
  const double kt = c.tangential_stiffness.value_or(0.0);
  const double of_gap = kt > 0.0 ? c.friction.kinetic / kt * c.normal_stiffness : 0.0;
  const Vector x = rows.weights(c.tangent, sign_of_slip((*side.mode)[k].state), c.normal, of_gap);
  if (x.size() == 0) return 0.0;
  const Vector forces = massless_noise(bench, side, 0), rates = massless_noise(bench, side, 1);
  double noise = 0.0;
  Eigen::Index at = 0;
  for (const int i : bench.massless()) noise += std::abs(x[at++]) * (rows.damped(i) ? forces[i] : rates[i]);
  return noise;
}

}  // namespace signorini
