// Balance of the forces on massless degrees of freedom, and of the rates of these forces.
//
//   r   = P - C v - K u - sum ( n N + t T )          = 0    in rows without mass
//   r'  = P' - C a - K v - sum ( n N' + t T' )       = 0    if N', T' follow from u, v, a
//   r'' = P'' - K a - sum ( n N'' + t T'' )          = 0    if the row has no damping either
//
// N' and T' follow from the motion for springs and for open contacts: kn g' + cn g'', kt ut', -s fk N'. Rates of
// constraint forces are not known, so rows with such forces are not checked.

#include "law_check/massless_laws.hpp"

#include <Eigen/SparseLU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"
#include "law_check/laws.hpp"

namespace signorini::law_check {
namespace {

/// Weighted sum of massless rows that determines velocities: C v from forces, or K v from rates of forces.
struct RateRow {
  std::vector<std::pair<int, double>> parts;  ///< index of a row among the massless rows, and its weight
  bool by_forces = false;                     ///< true: C v from forces; false: K v from rates of forces
};

/// Matrix S of the rows that determine the velocities of massless degrees of freedom (massless_laws.hpp).
class RateRows {
 public:
  RateRows(const CheckContext& context, const CheckedSide& side)
      : check_context_(context), place_(static_cast<std::size_t>(context.model.size()), -1) {
    for (const int i : context.massless()) place_[static_cast<std::size_t>(i)] = size_++;
    for (const int i : context.massless()) {
      add_row(i, context.damping_by_rows(), dampers_);
      add_row(i, context.stiffness_by_rows(), springs_);
    }
    for (const std::size_t k : context.contacts_on_massless()) {
      check_known(k, side);
      add_contact(k, side);
    }
    C_ = matrix_of(dampers_);
    K_ = matrix_of(springs_);
    if (reported_) combine();
  }

  /// Solution of S^T x = f, f = factor * form + factor_of_more * more. Empty: S does not determine velocities.
  [[nodiscard]] Vector weights(const Combination& form, double factor, const Combination& more,
                               double factor_of_more) const {
    if (!reported_) return {};
    Vector f = Vector::Zero(size_);
    for (const auto& [dof, value] : form.terms)
      if (exists(dof)) f[place_[static_cast<std::size_t>(dof)]] += factor * value;
    for (const auto& [dof, value] : more.terms)
      if (exists(dof)) f[place_[static_cast<std::size_t>(dof)]] += factor_of_more * value;
    const SparseMatrix transposed = this->transposed();
    Eigen::SparseLU<SparseMatrix> lu(transposed);
    if (lu.info() != Eigen::Success) return {};
    const Vector x = lu.solve(f);
    const bool solved = x.allFinite() && (transposed * x - f).norm() <= solve_accuracy * f.norm();
    return solved ? x : Vector();
  }
  /// Rounding error of row j. forces, rates: rounding errors of forces and of their rates, by degree of freedom.
  [[nodiscard]] double noise(std::size_t j, const Vector& forces, const Vector& rates) const {
    const Vector& terms = rows_[j].by_forces ? forces : rates;
    double sum = 0.0;
    for (const auto& [i, weight] : rows_[j].parts)
      sum += std::abs(weight) * terms[check_context_.massless()[static_cast<std::size_t>(i)]];
    return sum;
  }

 private:
  using Terms = std::vector<Eigen::Triplet<double>>;
  // Largest relative residual (half of the digits) of a system that determines velocities.
  static constexpr double solve_accuracy = 1e-8;
  // Largest number of rows coupled by dampers, which are decomposed together. Chosen: more rows would take seconds.
  static constexpr std::size_t max_together = 300;

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
  void check_known(std::size_t k, const CheckedSide& side) {
    const Contact& c = check_context_.model.contacts[k];
    const ContactState& state = (*side.mode)[k];
    if (!c.forces_follow_motion() || c.takes_impulses() || c.constrains_tangent(state.state))
      reported_ = false;
  }
  void add(int row, int column, double value, Terms& terms) const {
    if (exists(column) && value != 0.0) terms.emplace_back(at(row), at(column), value);
  }
  void add_row(int row, const SparseMatrix& by_rows, Terms& terms) const {
    for (SparseMatrix::InnerIterator it(by_rows, row); it; ++it)
      add(row, static_cast<int>(it.row()), it.value(), terms);
  }
  /// Adds the derivatives of N = kn g + cn g' and T = kt ut or -s fk N: by g' to dampers_, by g and ut to springs_.
  void add_contact(std::size_t k, const CheckedSide& side) {
    const Contact& c = check_context_.model.contacts[k];
    const ContactState& state = (*side.mode)[k];
    const double sliding = -slip_direction(state.state) * c.friction.kinetic;
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

  /// Groups of massless rows that are coupled by C.
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
  /// Sets the rows of S: for left null vectors Z of C the rows Z^T K, for their complement Y the rows Y^T C.
  void combine() {
    for (const std::vector<int>& rows : coupled()) {
      if (rows.size() > max_together) {
        reported_ = false;
        return;
      }
      const auto n = static_cast<Eigen::Index>(rows.size());
      Eigen::MatrixXd c(n, n);
      for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j)
          c(i, j) = C_.coeff(rows[static_cast<std::size_t>(i)], rows[static_cast<std::size_t>(j)]);
      const Eigen::MatrixXd undamped = base::orthogonal_complement(c);
      const bool all = undamped.cols() == 0;
      take(rows, undamped, false);
      take(rows,
           all ? Eigen::MatrixXd(Eigen::MatrixXd::Identity(n, n)) : base::orthogonal_complement(undamped),
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
    const SparseMatrix c = C_.transpose(), k = K_.transpose();  // columns of c and k are the rows of C and K
    Terms terms;
    for (std::size_t j = 0; j < rows_.size(); ++j)
      for (const auto& [i, weight] : rows_[j].parts)
        for (SparseMatrix::InnerIterator it(rows_[j].by_forces ? c : k, i); it; ++it)
          terms.emplace_back(static_cast<int>(it.row()), static_cast<int>(j), weight * it.value());
    return matrix_of(terms);
  }

  const CheckContext& check_context_;
  std::vector<int> place_;
  Terms dampers_, springs_;
  SparseMatrix C_, K_;  // of massless rows, with the terms of contacts
  std::vector<RateRow> rows_;
  int size_ = 0;
  bool reported_ = true;
};

}  // namespace

double slip_rate_noise(const CheckContext& context, const CheckedSide& side, std::size_t k) {
  if (context.massless().empty() || context.contact_response(k) != nullptr || side.loads.empty()) return 0.0;
  const Contact& c = context.model.contacts[k];
  const RateRows rows(context, side);
  // The slip rate is s (ut' + s fk/kt N'): with a spring between body and sliding point, it contains N'.
  const double kt = c.tangential_stiffness.value_or(0.0);
  const double of_gap = kt > 0.0 ? c.friction.kinetic / kt * c.normal_stiffness : 0.0;
  const Vector x = rows.weights(c.tangent, slip_direction((*side.mode)[k].state), c.normal, of_gap);
  if (x.size() == 0) return 0.0;
  const Vector forces = massless_noise(context, side, 0), rates = massless_noise(context, side, 1);
  double noise = 0.0;
  for (Eigen::Index j = 0; j < x.size(); ++j)
    noise += std::abs(x[j]) * rows.noise(static_cast<std::size_t>(j), forces, rates);
  return noise;
}

namespace {

// Relative accuracy of the terms of rates, which follow from solves and their derivatives. Chosen value; a wrong or
// missing term would violate it by far (tests/unit/law_check/massless.cpp).
constexpr double rate_accuracy = 1e-9;
constexpr const char* names[] = {"massless equilibrium", "massless velocity", "massless acceleration"};

/// N and T of a contact, or their rates, and the size of their terms. known: N and T follow from the motion.
struct Push {
  double N = 0.0, T = 0.0, size = 0.0;
  bool known = true;
};

/// First or second rates of N and T (order 1 or 2).
Push push_of(const Contact& c, const ContactState& state, const ContactKinematics& m, int order) {
  Push push;
  if (is_open(state.state) && !c.normal_force_given()) return push;
  const bool first = order == 1;
  const double g = first ? m.dg : m.ddg, ut = first ? m.dut : m.ddut,
               size = first ? m.velocity_size : m.acceleration_size;
  push.known = c.forces_follow_motion() && !c.takes_impulses() && (first || c.normal_damping == 0.0);
  if (!push.known) return push;
  if (c.normal_force_given()) {
    push.N = first ? -m.dq : -m.ddq;
    push.size = std::abs(push.N);
  } else {
    push.N = c.normal_stiffness * g + (first ? c.normal_damping * m.ddg : 0.0);
    push.size = c.normal_stiffness * size + (first ? c.normal_damping * m.acceleration_size : 0.0);
  }
  if (const int s = slip_direction(state.state); s != 0) {
    push.T = -s * c.friction.kinetic * push.N;
  } else if (kind_of(state.state) == State::stick) {
    push.known = c.tangential_stiffness.has_value();
    push.T = c.tangential_stiffness.value_or(0.0) * ut;
    push.size += c.tangential_stiffness.value_or(0.0) * size;
  }
  return push;
}

/// Scale of the rounding error of x for each degree of freedom: |x_i|, or `reached` if larger.
Vector reach_of(const Model& model, const Vector& x, const std::array<double, 2>& reached) {
  Vector reach = x.cwiseAbs();
  for (int i = 0; i < model.size(); ++i)
    reach[i] = std::max(reach[i], reached[model.dofs[static_cast<std::size_t>(i)].rotation]);
  return reach;
}

/// Balance of forces (order 0), of their rates (order 1) or of their second rates (order 2), for each massless row.
class Balance {
 public:
  Balance(const CheckContext& context, const CheckedSide& side, int order)
      : context_(context),
        side_(side),
        order_(order),
        sum_(Vector::Zero(context.model.size())),
        size_(sum_),
        off_(sum_),
        known_(static_cast<std::size_t>(context.model.size()), true) {}

  [[nodiscard]] std::optional<MasslessImbalance> worst() {
    const Vector rounded = noise();
    for (const int i : context_.massless()) {
      const double limit = rounded[i] + tolerance_factor * off_[i];
      // If a motion has decayed below the smallest normal double, its numbers have few digits and are not checked.
      if (limit < std::numeric_limits<double>::min()) continue;
      if (known_[static_cast<std::size_t>(i)] && std::abs(sum_[i]) > limit)
        return MasslessImbalance{i, names[order_], std::abs(sum_[i]), limit, order_};
    }
    return std::nullopt;
  }

  /// Sums the terms of all massless rows; returns the rounding error of each row.
  [[nodiscard]] Vector noise() {
    structure();
    for (const std::size_t k : context_.contacts_on_massless()) contact(k);
    return (order_ == 0 ? rounding::elimination : rate_accuracy) * size_;
  }

 private:
  void structure() {
    const Model& model = context_.model;
    const Vector none = Vector::Zero(model.size()), &a = side_.a != nullptr ? *side_.a : none;
    const Vector &x = order_ == 0 ? *side_.u : order_ == 1 ? *side_.v : a, &dx = order_ == 0 ? *side_.v : a;
    const Vector of_x = reach_of(model, x, reached(order_)), of_dx = reach_of(model, dx, reached(order_ + 1));
    for (const int i : context_.massless()) {
      sum_[i] = side_.loads[static_cast<std::size_t>(order_)][i];
      size_[i] = std::abs(sum_[i]);
      for (SparseMatrix::InnerIterator it(context_.stiffness_by_rows(), i); it; ++it) {
        take(i, it.value(), x[it.row()], of_x[it.row()]);
        off_[i] += std::abs(it.value()) * tolerance(static_cast<int>(it.row()), of_x[it.row()]);
      }
      SparseMatrix::InnerIterator damper(context_.damping_by_rows(), i);
      if (!damper) continue;
      known_[static_cast<std::size_t>(i)] = order_ == 0 || (order_ == 1 && side_.a != nullptr);
      for (; damper; ++damper) take(i, damper.value(), dx[damper.row()], of_dx[damper.row()]);
    }
  }
  /// Scales of displacements (order 0), velocities (1) and accelerations (2), for translations and rotations. With the
  /// highest frequency w, a rounding error d of displacements causes velocities w d and accelerations w^2 d, even at rest.
  [[nodiscard]] std::array<double, 2> reached(int order) const {
    if (order == 0) return side_.max_u;
    std::array<double, 2> reach = side_.max_u;
    for (std::size_t i = 0; i < reach.size(); ++i) {
      reach[i] *= rounding::eps * std::pow(context_.model.omega_max, order);
      if (order == 1) reach[i] = std::max(reach[i], side_.max_v[i]);
    }
    return reach;
  }
  void take(int i, double factor, double x, double reach) {
    sum_[i] -= factor * x;
    size_[i] += std::abs(factor) * reach;
  }
  /// Engine's tolerance of a displacement (order 0) or of a velocity.
  [[nodiscard]] double tolerance(int dof, double reach) const {
    const LawLimits& tol = context_.limits;
    const bool turns = context_.model.dofs[static_cast<std::size_t>(dof)].rotation;
    return tol.rtol * reach + (order_ == 0 ? turns ? tol.rotation : tol.displacement
                               : turns     ? tol.angular_velocity
                                           : tol.velocity);
  }
  void contact(std::size_t k) {
    const Contact& c = context_.model.contacts[k];
    const ContactKinematics m = kinematics(c, k, side_);
    Push push{m.N, m.T, std::abs(m.N) + std::abs(m.T)};
    if (order_ > 0) push = push_of(c, (*side_.mode)[k], m, order_);
    if (order_ == 1 && c.normal_damping > 0.0 && side_.a == nullptr) push.known = false;
    if (order_ == 0)
      push.size += normal_force_size(c, m) + c.tangential_stiffness.value_or(0.0) * m.displacement_size;
    add(c.normal, push.N, push);
    add(c.tangent, push.T, push);
  }
  void add(const Combination& form, double force, const Push& push) {
    for (const auto& [dof, factor] : form.terms) {
      sum_[dof] -= factor * force;
      size_[dof] += std::abs(factor) * push.size;
      if (!push.known) known_[static_cast<std::size_t>(dof)] = false;
    }
  }

  const CheckContext& context_;
  const CheckedSide& side_;
  int order_;
  Vector sum_, size_, off_;  // for each row: sum of the terms, sum of their sizes, errors due to tolerances
  std::vector<bool> known_;
};

}  // namespace

Vector massless_noise(const CheckContext& context, const CheckedSide& side, int order) {
  return Balance(context, side, order).noise();
}

std::vector<MasslessImbalance> massless_balance(const CheckContext& context, const CheckedSide& side,
                                                int orders) {
  std::vector<MasslessImbalance> found;
  if (side.loads.empty()) return found;
  for (int order = 0; order < orders; ++order)
    if (const auto worst = Balance(context, side, order).worst()) found.push_back(*worst);
  return found;
}

}  // namespace signorini::law_check
