#include "engine/exact/modal/unconstrained_modes.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <random>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"
#include "engine/exact/modal/damped_pencil.hpp"

namespace signorini::modal {

std::vector<int> narrow_order(const SparseMatrix& mass, const SparseMatrix& stiffness) {
  const auto n = static_cast<std::size_t>(mass.rows());
  std::vector<std::vector<int>> neighbours(n);
  for (const SparseMatrix* matrix : {&mass, &stiffness})
    for (int j = 0; j < matrix->outerSize(); ++j)
      for (SparseMatrix::InnerIterator it(*matrix, j); it; ++it)
        if (it.row() != j && it.value() != 0.0)
          neighbours[static_cast<std::size_t>(j)].push_back(static_cast<int>(it.row()));
  const auto fewer = [&](int a, int b) {
    return neighbours[static_cast<std::size_t>(a)].size() < neighbours[static_cast<std::size_t>(b)].size();
  };
  const auto walk = [&](int first, std::vector<bool>& seen, std::vector<int>& order) {
    std::queue<int> next;
    next.push(first);
    seen[static_cast<std::size_t>(first)] = true;
    while (!next.empty()) {
      const int now = next.front();
      next.pop();
      order.push_back(now);
      std::vector<int> around;
      for (const int other : neighbours[static_cast<std::size_t>(now)])
        if (!seen[static_cast<std::size_t>(other)]) {
          seen[static_cast<std::size_t>(other)] = true;
          around.push_back(other);
        }
      std::stable_sort(around.begin(), around.end(), fewer);
      for (const int other : around) next.push(other);
    }
  };
  std::vector<bool> seen(n, false);
  std::vector<int> order;
  for (std::size_t i = 0; i < n; ++i) {
    if (seen[i]) continue;
    // Start at the last node of a first breadth-first search: the levels of the second search are then narrow.
    std::vector<bool> tried = seen;
    std::vector<int> trial;
    walk(static_cast<int>(i), tried, trial);
    walk(trial.back(), seen, order);
  }
  std::vector<int> place(n);
  for (std::size_t i = 0; i < n; ++i) place[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
  return place;
}

namespace {

using Long = long double;
using LongVector = std::vector<Long>;

constexpr std::size_t widest_band = 48;  // largest half-width of the band, without the diagonal
constexpr double free_share = 1e-14;     // omega^2 of a free motion is below this part of the highest omega^2
// Below doubtful * free_share of the highest omega^2, a mode cannot be distinguished from a free motion.
constexpr double doubtful = 100.0;
constexpr double same_frequency = 1e-9;  // relative width of a bracket whose modes are computed together
// Halvings of a bracket that contains one mode. Each inverse iteration then reduces the error by a factor of 2000.
constexpr int more_halvings = 11;
constexpr int quick_solves = 3;
constexpr int max_quotients = 6;
constexpr double worst_product = 1e-4;  // limit of the product of two shapes before orthogonalisation

struct Bracket {
  double low = 0.0, high = 0.0;
  std::size_t below = 0, up_to = 0;  // number of modes below `low` and below `high`
};

/// Divides `all` into brackets, each with one mode or with several modes of nearly equal frequency. Returns them in ascending
/// order.
std::vector<Bracket> brackets(BandPencil<double>& pencil, Bracket all) {
  std::vector<Bracket> unsettled{all}, done;
  while (!unsettled.empty()) {
    Bracket now = unsettled.back();
    unsettled.pop_back();
    if (now.up_to == now.below) continue;
    const bool one = now.up_to - now.below == 1;
    if (!one && now.high - now.low > same_frequency * now.high) {
      // Geometric mean, because frequencies extend over decades.
      const double middle =
          now.high > 4.0 * now.low ? std::sqrt(now.low * now.high) : 0.5 * (now.low + now.high);
      const std::size_t count = std::clamp(pencil.factor(middle), now.below, now.up_to);
      unsettled.push_back({middle, now.high, count, now.up_to});
      unsettled.push_back({now.low, middle, now.below, count});
      continue;
    }
    for (int i = 0; one && i < more_halvings; ++i) {
      const double middle = 0.5 * (now.low + now.high);
      (pencil.factor(middle) > now.below ? now.high : now.low) = middle;
    }
    done.push_back(now);
  }
  return done;
}

class Shapes {
 public:
  explicit Shapes(BandPencil<Long>& pencil) : pencil_(pencil), mx_(pencil.size()) {}

  /// Computes the `count` modes closest to the shift: M-orthonormal columns x and their Rayleigh quotients `square` = omega^2.
  void find(Long shift, std::size_t count, int solves, std::vector<LongVector>& x, LongVector& square) {
    x.assign(count, LongVector(pencil_.size()));
    for (LongVector& column : x)
      for (Long& entry : column) entry = uniform_(random_);
    pencil_.factor(shift);
    for (int i = 0; i < solves; ++i) sweep(x);
    rotate(x, square);
  }

  /// Computes the only mode in a bracket: first by inverse iteration in doubles, then by Rayleigh quotient iteration in
  /// extended precision. Each step of the latter triples the number of correct digits.
  void find_one(BandPencil<double>& quick, const Bracket& bracket, LongVector& x, Long& square) {
    std::vector<double> begun(pencil_.size()), mx(pencil_.size());
    for (double& entry : begun) entry = uniform_(random_);
    quick.factor(0.5 * (bracket.low + bracket.high));
    for (int i = 0; i < quick_solves; ++i) {
      quick.times_mass(begun.data(), mx.data());
      quick.solve(mx.data());
      double greatest = 0.0;
      for (const double entry : mx) greatest = std::max(greatest, std::abs(entry));
      for (std::size_t j = 0; j < mx.size(); ++j) begun[j] = mx[j] / greatest;
    }
    std::vector<LongVector> one{LongVector(begun.begin(), begun.end())};
    LongVector value;
    orthonormal(one);
    rotate(one, value);
    for (int i = 0; i < max_quotients; ++i) {
      const Long before = value[0];
      pencil_.factor(before);
      sweep(one);
      rotate(one, value);
      if (std::abs(value[0] - before) <= rounding::few_operations * std::abs(before)) break;
    }
    x = one[0];
    square = value[0];
  }

 private:
  [[nodiscard]] static Long dot(const LongVector& a, const LongVector& b) {
    Long sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
  }

  /// One inverse iteration: x := (K - s M)^-1 M x. Then the columns of x are made M-orthonormal.
  void sweep(std::vector<LongVector>& x) {
    for (LongVector& column : x) {
      pencil_.times_mass(column.data(), mx_.data());
      column = mx_;
      pencil_.solve(column.data());
    }
    orthonormal(x);
  }

  void orthonormal(std::vector<LongVector>& x) {
    for (std::size_t k = 0; k < x.size(); ++k)
      for (int twice = 0; twice < (k > 0 ? 2 : 1); ++twice) {
        // Scale first: a solve with a shift near an eigenvalue yields numbers so large that their squares overflow.
        Long greatest = 0;
        for (const Long entry : x[k]) greatest = std::max(greatest, std::abs(entry));
        scale(x[k], 1 / greatest);
        pencil_.times_mass(x[k].data(), mx_.data());
        for (std::size_t j = 0; j < k; ++j) {
          const Long along = dot(x[j], mx_);
          for (std::size_t i = 0; i < mx_.size(); ++i) x[k][i] -= along * x[j][i];
        }
        if (k > 0) pencil_.times_mass(x[k].data(), mx_.data());
        scale(x[k], 1 / std::sqrt(dot(x[k], mx_)));
      }
  }

  static void scale(LongVector& x, Long factor) {
    for (Long& entry : x) entry *= factor;
  }

  /// Rotates the M-orthonormal columns so that x^T K x is diagonal. square: receives the diagonal, omega^2.
  void rotate(std::vector<LongVector>& x, LongVector& square) {
    const std::size_t count = x.size();
    std::vector<Long> energy(count * count);
    for (std::size_t k = 0; k < count; ++k) {
      pencil_.times_stiffness(x[k].data(), mx_.data());
      for (std::size_t j = 0; j < count; ++j) energy[k * count + j] = dot(x[j], mx_);
    }
    square.assign(1, energy[0]);
    if (count == 1) return;
    const Long middle = energy[0];
    Eigen::MatrixXd differences(count, count);
    for (std::size_t k = 0; k < count; ++k)
      for (std::size_t j = 0; j < count; ++j)
        differences(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(k)) =
            static_cast<double>(energy[k * count + j] - (j == k ? middle : 0));
    const base::EigenPairs pairs = base::symmetric_eigen(0.5 * (differences + differences.transpose()));
    std::vector<LongVector> turned(count, LongVector(pencil_.size(), 0));
    square.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      square[k] = middle + pairs.values[column];
      for (std::size_t j = 0; j < count; ++j) {
        const Long part = pairs.vectors(static_cast<Eigen::Index>(j), column);
        for (std::size_t i = 0; i < pencil_.size(); ++i) turned[k][i] += part * x[j][i];
      }
    }
    x = std::move(turned);
    orthonormal(x);
  }

  BandPencil<Long>& pencil_;
  LongVector mx_;
  std::mt19937_64 random_{1};
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

/// Makes the shapes M-orthonormal: Phi := Phi R^-1 with R^T R = Phi^T M Phi, to first order. Only shapes of lower modes are
/// added to a shape. False: the shapes are not nearly orthogonal.
bool orthonormal_from_low_to_high(const SparseMatrix& mass, Eigen::MatrixXd& shapes) {
  for (int twice = 0; twice < 2; ++twice) {
    Eigen::MatrixXd products = shapes.transpose() * (mass * shapes);
    products.diagonal().array() -= 1.0;
    if (!(products.cwiseAbs().maxCoeff() < worst_product)) return false;
    const bool good = products.cwiseAbs().maxCoeff() < 1e-9;  // terms of second order are below rounding
    products.diagonal() *= 0.5;
    shapes -= (shapes * products.triangularView<Eigen::Upper>()).eval();
    if (good) break;
  }
  return true;
}

UnconstrainedModes failed(const char* why) {
  UnconstrainedModes none;
  none.failure = why;
  return none;
}

}  // namespace

bool has_narrow_band(const SparseMatrix& mass, const SparseMatrix& stiffness) {
  const std::vector<int> place = narrow_order(mass, stiffness);
  const auto at = [&](Eigen::Index i) { return place[static_cast<std::size_t>(i)]; };
  int width = 0;
  for (const SparseMatrix* matrix : {&mass, &stiffness})
    for (int j = 0; j < matrix->outerSize(); ++j)
      for (SparseMatrix::InnerIterator it(*matrix, j); it; ++it)
        width = std::max(width, std::abs(at(it.row()) - at(j)));
  return static_cast<std::size_t>(width) <= widest_band;
}

UnconstrainedModes unconstrained_modes(const SparseMatrix& mass, const SparseMatrix& stiffness) {
  const std::vector<int> place = narrow_order(mass, stiffness);
  BandPencil<double> quick(mass, stiffness, place);
  const std::size_t n = quick.size();
  if (n == 0) return failed("the structure has no degrees of freedom");
  BandPencil<Long> sharp(mass, stiffness, place);

  double highest = 0.0;
  for (int i = 0; i < mass.rows(); ++i) highest = std::max(highest, stiffness.coeff(i, i) / mass.coeff(i, i));
  if (!(highest > 0.0)) return failed("the structure has no stiffness");
  while (quick.factor(highest) < n) {
    highest *= 2.0;
    if (!std::isfinite(highest)) return failed("the mass matrix is not positive definite");
  }
  const double free_below = free_share * highest;
  const std::size_t free = sharp.factor(free_below);
  if (sharp.factor(-free_below) != 0) return failed("the stiffness matrix is not positive semidefinite");
  if (sharp.factor(doubtful * free_below) != free)
    return failed("the lowest frequencies cannot be distinguished from free motions");

  UnconstrainedModes modes;
  modes.free = static_cast<int>(free);
  modes.omega_squared.setZero(static_cast<Eigen::Index>(n));
  modes.shapes.resize(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
  const auto keep = [&](std::size_t k, const LongVector& x) {
    for (std::size_t i = 0; i < n; ++i)
      modes.shapes(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          static_cast<double>(x[static_cast<std::size_t>(place[i])]);
  };
  Shapes shapes(sharp);
  std::vector<LongVector> x;
  LongVector square;
  std::vector<Bracket> all = brackets(quick, {doubtful * free_below, highest, free, n});
  if (free > 0) {
    const double lowest = all.empty() ? highest : all.front().high;
    shapes.find(-1e-4L * static_cast<Long>(lowest), free, 8, x, square);
    for (std::size_t k = 0; k < free; ++k) keep(k, x[k]);
  }
  std::size_t k = free;
  for (const Bracket& bracket : all) {
    const std::size_t count = bracket.up_to - bracket.below;
    if (count == 1) {
      x.resize(1);
      square.resize(1);
      shapes.find_one(quick, bracket, x[0], square[0]);
    } else {
      shapes.find(0.5L * (static_cast<Long>(bracket.low) + bracket.high), count, 3, x, square);
    }
    for (std::size_t j = 0; j < count; ++j, ++k) {
      keep(k, x[j]);
      modes.omega_squared[static_cast<Eigen::Index>(k)] = static_cast<double>(square[j]);
    }
  }
  if (k != n || !modes.shapes.allFinite()) return failed("not all modes were found");
  if (!std::is_sorted(modes.omega_squared.data(), modes.omega_squared.data() + n) ||
      !orthonormal_from_low_to_high(mass, modes.shapes))
    return failed("the modes that were found are not orthogonal");
  return modes;
}

namespace {

bool has_constant_excitation(const History& history) {
  return std::all_of(history.pieces().begin(), history.pieces().end(), [](const Piece& piece) {
    return !piece.function && piece.amplitude == 0.0 &&
           std::all_of(piece.coefficients.begin(), piece.coefficients.end(),
                       [&](const double& c) { return &c == piece.coefficients.data() || c == 0.0; });
  });
}

}  // namespace

bool is_symmetric(const SparseMatrix& a) {
  const SparseMatrix difference = a - SparseMatrix(a.transpose());
  return difference.norm() <= rounding::many_operations * a.norm();
}

bool has_constant_excitation(const Model& model) {
  return std::all_of(model.loads.begin(), model.loads.end(),
                     [](const Load& load) { return has_constant_excitation(load.history); }) &&
         std::all_of(model.contacts.begin(), model.contacts.end(), [](const Contact& contact) {
           return has_constant_excitation(contact.normal_force) &&
                  has_constant_excitation(contact.surface_motion);
         });
}

UnconstrainedBasis::UnconstrainedBasis(const Model& model) {
  UnconstrainedModes modes = unconstrained_modes(model.mass, model.stiffness);
  failure_ = std::move(modes.failure);
  if (!failure_.empty()) return;
  omega_squared_ = std::move(modes.omega_squared);
  shapes_ = modes.shapes;
  projection_ = (model.mass * modes.shapes).transpose();
  const auto amplitudes_of = [&](const Combination& form) {
    Vector x = Vector::Zero(model.size());
    form.add_to(x, 1.0);
    return Vector(modes.shapes.transpose() * x);
  };
  for (const Contact& contact : model.contacts) {
    normal_.push_back(amplitudes_of(contact.normal));
    tangent_.push_back(amplitudes_of(contact.tangent));
  }
  for (const Load& load : model.loads) load_.push_back(amplitudes_of(load.direction));
}

}  // namespace signorini::modal
