#include "witness/massless_rates.hpp"

#include <Eigen/SparseLU>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "base/eigen_dense.hpp"

namespace signorini {
namespace {

/// Sum of massless rows that determines velocities: C v from forces, or K v from their rates.
struct RateRow {
  std::vector<std::pair<int, double>> parts;  ///< place of the row, its weight
  bool by_forces = false;
};

/// Massless rows that determine velocities, restricted to massless degrees of freedom.
class RateRows {
 public:
  RateRows(const Bench& bench, const WitnessedSide& side)
      : bench_(bench), place_(static_cast<std::size_t>(bench.model.size()), -1) {
    for (const int i : bench.massless()) place_[static_cast<std::size_t>(i)] = size_++;
    for (const int i : bench.massless()) {
      add_row(i, bench.damping_by_rows(), dampers_);
      add_row(i, bench.stiffness_by_rows(), springs_);
    }
    for (const std::size_t k : bench.on_massless()) {
      check_known(k, side);
      add_contact(k, side);
    }
    C_ = matrix_of(dampers_);
    K_ = matrix_of(springs_);
    if (told_) combine();
  }

  /// Solution of S^T x = f; empty: S does not determine it.
  [[nodiscard]] Vector weights(const Combination& form, double factor, const Combination& more,
                               double factor_of_more) const {
    if (!told_) return {};
    Vector f = Vector::Zero(size_);
    for (const auto& [dof, value] : form.terms)
      if (exists(dof)) f[place_[static_cast<std::size_t>(dof)]] += factor * value;
    for (const auto& [dof, value] : more.terms)
      if (exists(dof)) f[place_[static_cast<std::size_t>(dof)]] += factor_of_more * value;
    const SparseMatrix transposed = this->transposed();
    Eigen::SparseLU<SparseMatrix> lu(transposed);
    if (lu.info() != Eigen::Success) return {};
    const Vector x = lu.solve(f);
    const bool solved = x.allFinite() && (transposed * x - f).norm() <= of_solve * f.norm();
    return solved ? x : Vector();
  }
  /// Rounding of row j, from the rounding of forces and of their rates, one entry per degree of freedom.
  [[nodiscard]] double noise(std::size_t j, const Vector& forces, const Vector& rates) const {
    const Vector& terms = rows_[j].by_forces ? forces : rates;
    double sum = 0.0;
    for (const auto& [i, weight] : rows_[j].parts)
      sum += std::abs(weight) * terms[bench_.massless()[static_cast<std::size_t>(i)]];
    return sum;
  }

 private:
  using Terms = std::vector<Eigen::Triplet<double>>;
  // Half of the digits: a system with a larger residual determines no velocity.
  static constexpr double of_solve = 1e-8;
  // Limit for the number of rows that dampers couple, which are decomposed together. Chosen: more would take seconds.
  static constexpr std::size_t most_together = 300;

  [[nodiscard]] int at(int dof) const { return place_[static_cast<std::size_t>(dof)]; }
  [[nodiscard]] bool exists(int dof) const { return at(dof) >= 0; }
  [[nodiscard]] static bool closed(const Contact& c, const ContactState& state) {
    return !is_open(state.state) && !c.normal_force_given();
  }
  [[nodiscard]] SparseMatrix matrix_of(const Terms& terms) const {
    SparseMatrix matrix(size_, size_);
    matrix.setFromTriplets(terms.begin(), terms.end());
    return matrix;
  }
  void check_known(std::size_t k, const WitnessedSide& side) {
    const Contact& c = bench_.model.contacts[k];
    const ContactState& state = (*side.mode)[k];
    if (!c.forces_follow_motion() || c.takes_impulses() || c.holds_tangent(state.state)) told_ = false;
  }
  void add(int row, int column, double value, Terms& terms) const {
    if (exists(column) && value != 0.0) terms.emplace_back(at(row), at(column), value);
  }
  void add_row(int row, const SparseMatrix& by_rows, Terms& terms) const {
    for (SparseMatrix::InnerIterator it(by_rows, row); it; ++it)
      add(row, static_cast<int>(it.row()), it.value(), terms);
  }
  /// Adds N = kn g + cn g', T = kt ut or -s fk N: derivatives with respect to g' and ut', or to g and ut for the rates.
  void add_contact(std::size_t k, const WitnessedSide& side) {
    const Contact& c = bench_.model.contacts[k];
    const ContactState& state = (*side.mode)[k];
    const double sliding = -sign_of_slip(state.state) * c.friction.kinetic;
    const auto add_force = [&](const Combination& along, const Combination& by, double spring,
                               double dashpot) {
      for (const auto& [row, factor] : along.terms) {
        if (!exists(row)) continue;
        for (const auto& [column, other] : by.terms) {
          add(row, column, factor * spring * other, springs_);
          add(row, column, factor * dashpot * other, dampers_);
        }
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

  /// Groups of rows that share an entry of C.
  [[nodiscard]] std::vector<std::vector<int>> coupled() const {
    std::vector<int> leader(static_cast<std::size_t>(size_));
    std::iota(leader.begin(), leader.end(), 0);
    const auto find = [&](int i) {
      while (leader[static_cast<std::size_t>(i)] != i) i = leader[static_cast<std::size_t>(i)];
      return i;
    };
    for (int j = 0; j < C_.outerSize(); ++j)
      for (SparseMatrix::InnerIterator it(C_, j); it; ++it)
        leader[static_cast<std::size_t>(find(static_cast<int>(it.row())))] = find(j);
    std::map<int, std::vector<int>> lists;
    for (int i = 0; i < size_; ++i) lists[find(i)].push_back(i);
    std::vector<std::vector<int>> result;
    for (auto& [first, list] : lists) result.push_back(std::move(list));
    return result;
  }
  /// Left null vectors of C take their row from K; the rows of their complement come from C.
  void combine() {
    for (const std::vector<int>& rows : coupled()) {
      if (rows.size() > most_together) {
        told_ = false;
        return;
      }
      const auto n = static_cast<Eigen::Index>(rows.size());
      Eigen::MatrixXd c(n, n);
      for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j)
          c(i, j) = C_.coeff(rows[static_cast<std::size_t>(i)], rows[static_cast<std::size_t>(j)]);
      const Eigen::MatrixXd undamped = orthogonal_complement(c);
      const bool all = undamped.cols() == 0;
      take(rows, undamped, false);
      take(rows, all ? Eigen::MatrixXd(Eigen::MatrixXd::Identity(n, n)) : orthogonal_complement(undamped),
           true);
    }
  }
  void take(const std::vector<int>& rows, const Eigen::MatrixXd& weights, bool by_forces) {
    for (Eigen::Index j = 0; j < weights.cols(); ++j) {
      RateRow row;
      row.by_forces = by_forces;
      for (Eigen::Index i = 0; i < weights.rows(); ++i)
        if (weights(i, j) != 0.0) row.parts.emplace_back(rows[static_cast<std::size_t>(i)], weights(i, j));
      rows_.push_back(std::move(row));
    }
  }
  [[nodiscard]] SparseMatrix transposed() const {
    const SparseMatrix c = C_.transpose(), k = K_.transpose();  // their columns are rows
    Terms terms;
    for (std::size_t j = 0; j < rows_.size(); ++j)
      for (const auto& [i, weight] : rows_[j].parts)
        for (SparseMatrix::InnerIterator it(rows_[j].by_forces ? c : k, i); it; ++it)
          terms.emplace_back(static_cast<int>(it.row()), static_cast<int>(j), weight * it.value());
    return matrix_of(terms);
  }

  const Bench& bench_;
  std::vector<int> place_;
  Terms dampers_, springs_;
  SparseMatrix C_, K_;  // with the terms of contacts
  std::vector<RateRow> rows_;
  int size_ = 0;
  bool told_ = true;
};

}  // namespace

double noise_of_slip_rate(const Bench& bench, const WitnessedSide& side, std::size_t k) {
  if (bench.massless().empty() || bench.own_response(k) != nullptr || side.loads.empty()) return 0.0;
  const Contact& c = bench.model.contacts[k];
  const RateRows rows(bench, side);
  // p' = s (ut' + s fk/kt N') > 0: with a spring between body and sliding point, N' contributes.
  const double kt = c.tangential_stiffness.value_or(0.0);
  const double of_gap = kt > 0.0 ? c.friction.kinetic / kt * c.normal_stiffness : 0.0;
  const Vector x = rows.weights(c.tangent, sign_of_slip((*side.mode)[k].state), c.normal, of_gap);
  if (x.size() == 0) return 0.0;
  const Vector forces = massless_noise(bench, side, 0), rates = massless_noise(bench, side, 1);
  double noise = 0.0;
  for (Eigen::Index j = 0; j < x.size(); ++j)
    noise += std::abs(x[j]) * rows.noise(static_cast<std::size_t>(j), forces, rates);
  return noise;
}

}  // namespace signorini
