#include "model/reduce/kept_modes.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "base/eigen_dense.hpp"
#include "linear/sparse_cholesky.hpp"
#include "model/assembly/parts.hpp"
#include "model/modes/frequencies.hpp"
#include "model/modes/lanczos.hpp"

namespace signorini::reduce {
namespace {

constexpr int dense_at_most = 5000;    // limit of the dense solver if a third of all modes or more is kept
constexpr int most_modes = 5000;       // largest number of modes that can be kept
constexpr double roundings = 1e-12;    // sums below this fraction of their terms are zero
constexpr double shift_share = 1e-3;   // shift, relative to omega^2 of the first truncated or highest mode
constexpr double least_shift = 1e-11;  // smallest shift with free motions, relative to the largest K_ii/M_ii
constexpr int corrections = 6;         // corrections of the shift; each reduces the error by shift/omega^2
constexpr double margin = 1e-6;        // modes are counted at this relative distance in omega^2 below a mode

double greatest_local_square(const SparseMatrix& mass, const SparseMatrix& stiffness) {
  double greatest = 0.0;
  for (int i = 0; i < mass.rows(); ++i)
    if (const double m = mass.coeff(i, i); m > 0.0) greatest = std::max(greatest, stiffness.coeff(i, i) / m);
  return greatest;
}

/// All modes. Massless degrees of freedom are condensed; the shapes are then extended to these degrees of freedom.
base::EigenPairs all_modes(const SparseMatrix& mass, const SparseMatrix& stiffness) {
  const SparseMatrix h = assembly::select_by_mass(mass, true), l = assembly::select_by_mass(mass, false);
  const SparseMatrix m = h.transpose() * mass * h, k = h.transpose() * stiffness * h;
  Eigen::MatrixXd condensed(k), follow(l.cols(), h.cols());
  if (l.cols() > 0) {
    const SparseMatrix coupling = l.transpose() * stiffness * h;
    const linear::SymmetricSolver massless(SparseMatrix(l.transpose() * stiffness * l));
    if (!massless.ok()) throw NotReducible("the stiffness of the massless degrees of freedom is singular");
    for (Eigen::Index j = 0; j < follow.cols(); ++j) follow.col(j) = -massless.solve(coupling.col(j));
    condensed += coupling.transpose() * follow;
  }
  const base::EigenPairs pairs =
      base::generalized_eigen(0.5 * (condensed + condensed.transpose()), Eigen::MatrixXd(m));
  if (pairs.vectors.rows() != h.cols())
    return {};  // the decomposition failed; the caller checks the number of values
  Eigen::MatrixXd shapes = h * pairs.vectors;
  if (l.cols() > 0) shapes += l * (follow * pairs.vectors).eval();
  return {pairs.values, shapes};
}

void orthonormalise(Eigen::MatrixXd& x, const SparseMatrix& mass) {
  for (int round = 0; round < 2; ++round)
    for (Eigen::Index j = 0; j < x.cols(); ++j) {
      Eigen::VectorXd v = x.col(j);
      if (j > 0) v -= x.leftCols(j) * (x.leftCols(j).transpose() * (mass * v));
      x.col(j) = v / std::sqrt(v.dot(mass * v));
    }
}

/// Modes with omega > 0 up to the cutoff (`kept`), and the first mode above the cutoff if there is one.
struct ElasticModes {
  base::EigenPairs pairs;
  Eigen::Index kept = 0;
};

ElasticModes all_elastic(double cutoff, const SparseMatrix& mass, const SparseMatrix& stiffness,
                         Eigen::Index free, Eigen::Index heavies) {
  const base::EigenPairs all = all_modes(mass, stiffness);
  // A failed decomposition has no values, or values that are NaN.
  if (all.values.size() != heavies || !all.values.allFinite())
    throw NotReducible("the modes of the structure cannot be computed");
  const Eigen::Index rest = all.values.size() - free;  // the first `free` modes are the free motions
  ElasticModes found;
  while (found.kept < rest && all.values[free + found.kept] <= cutoff * cutoff) ++found.kept;
  const Eigen::Index taken = std::min(found.kept + 1, rest);
  found.pairs = {all.values.segment(free, taken), all.vectors.middleCols(free, taken)};
  return found;
}

/// Same result as all_elastic(), computed by iteration. count: number of modes below the cutoff, free motions included.
ElasticModes lowest_elastic(double cutoff, int count, const SparseMatrix& mass, const SparseMatrix& stiffness,
                            const Eigen::MatrixXd& rigid) {
  const double limit = cutoff * cutoff;
  double shift = shift_share * limit;
  if (rigid.cols() > 0) shift = std::max(shift, least_shift * greatest_local_square(mass, stiffness));
  ElasticModes found;
  found.kept = count - rigid.cols();
  found.pairs = modes::lowest_modes(static_cast<int>(found.kept), limit, mass, stiffness, rigid, shift);
  const Eigen::Index below = (found.pairs.values.array() < limit).count();
  if (below != found.kept || found.pairs.values.size() != found.kept + 1)
    throw NotReducible(fmt::format("modes below the cutoff: {} counted, but {} found; move the cutoff", count,
                                   rigid.cols() + below));
  const double first = found.pairs.values[found.kept];
  if (const int sure = modes::count_modes_below(mass, stiffness, std::max(limit, (1.0 - margin) * first));
      sure > count)
    throw NotReducible(fmt::format("the first mode above the cutoff was not found; move the cutoff"));
  return found;
}

ElasticModes elastic_modes(double cutoff, const SparseMatrix& mass, const SparseMatrix& stiffness,
                           const Eigen::MatrixXd& rigid, int heavies) {
  const auto free = static_cast<int>(rigid.cols());
  if (heavies <= all_modes_up_to) return all_elastic(cutoff, mass, stiffness, free, heavies);
  const int counted = modes::count_modes_below(mass, stiffness, cutoff * cutoff);
  if (counted < 0) throw NotReducible("the modes below the cutoff cannot be counted; move the cutoff");
  const int count = std::max(counted, free);
  const bool most = count >= heavies / 3;
  if (count > most_modes || (most && heavies > dense_at_most))
    throw NotReducible(fmt::format(
        "{} of {} modes lie below the cutoff; at most {} modes can be kept, and fewer than a third of all "
        "modes if the structure has more than {}; lower the cutoff, or leave [reduction] out",
        count, heavies, most_modes, dense_at_most));
  return most ? all_elastic(cutoff, mass, stiffness, free, heavies)
              : lowest_elastic(cutoff, count, mass, stiffness, rigid);
}

linear::SymmetricSolver regular(const SparseMatrix& a) {
  linear::SymmetricSolver solver(a);
  if (a.rows() > 0 && (!solver.ok() || !(solver.smallest_pivot() > 0.0)))
    throw NotReducible("the stiffness is singular up to rounding; move the cutoff");
  return solver;
}

}  // namespace

KeptModes modes_up_to(double cutoff, const SparseMatrix& mass, const SparseMatrix& stiffness,
                      const Eigen::MatrixXd& free) {
  const int heavies = assembly::degrees_with_mass(mass);
  Eigen::MatrixXd rigid = free;
  orthonormalise(rigid, mass);
  const ElasticModes found = elastic_modes(cutoff, mass, stiffness, rigid, heavies);
  const base::EigenPairs& pairs = found.pairs;
  const Eigen::Index elastic = found.kept, taken = pairs.values.size();

  KeptModes result;
  result.free = static_cast<int>(rigid.cols());
  const Eigen::Index kept = result.free + elastic;
  result.truncated_modes = heavies - static_cast<int>(kept);
  result.shapes.resize(mass.rows(), kept);
  result.shapes.leftCols(result.free) = rigid;
  result.squares = Eigen::VectorXd::Zero(kept);
  // Without elastic modes any shift that makes K regular is suitable.
  const double local = greatest_local_square(mass, stiffness);
  result.shift = taken > 0 ? shift_share * pairs.values[taken - 1] : local > 0.0 ? local : 1.0;
  if (taken == 0) return result;

  // A step of inverse iteration improves the low modes, whose energy is small compared with the high ones.
  Eigen::MatrixXd x = pairs.vectors;
  const linear::SymmetricSolver solver = regular(SparseMatrix(stiffness + result.shift * mass));
  modes::deflate(rigid, mass, x);
  for (Eigen::Index j = 0; j < taken; ++j)
    x.col(j) = (pairs.values[j] + result.shift) * solver.solve(mass * x.col(j));
  modes::deflate(rigid, mass, x);
  const base::EigenPairs ritz =
      base::generalized_eigen(x.transpose() * (stiffness * x), x.transpose() * (mass * x));
  if (ritz.values.size() != taken || !ritz.values.allFinite())
    throw NotReducible("the modes below the cutoff are not independent; move the cutoff");
  result.shapes.rightCols(elastic) = x * ritz.vectors.leftCols(elastic);
  result.squares.tail(elastic) = ritz.values.head(elastic);
  if (taken > elastic) result.first_truncated = std::sqrt(ritz.values[elastic]);
  return result;
}

Vector modal_loads(const KeptModes& modes, const Vector& f) {
  Vector part = modes.shapes.transpose() * f;
  const Vector terms = modes.shapes.cwiseAbs().transpose() * f.cwiseAbs();
  for (Eigen::Index j = 0; j < part.size(); ++j)
    if (std::abs(part[j]) <= roundings * terms[j]) part[j] = 0.0;
  return part;
}

ResidualFlexibility::ResidualFlexibility(const SparseMatrix& mass, const SparseMatrix& stiffness,
                                         const KeptModes& modes)
    : mass_(mass),
      modes_(modes),
      inertia_(mass * modes.shapes),
      inertia_size_(inertia_.cwiseAbs()),
      shift_(modes.free > 0 ? modes.shift : 0.0),
      complete_(modes.shapes.cols() == mass.rows()),
      solver_(complete_      ? linear::SymmetricSolver(SparseMatrix(0, 0))
              : shift_ > 0.0 ? regular(SparseMatrix(stiffness + shift_ * mass))
                             : regular(stiffness)) {}

Vector ResidualFlexibility::without_kept(const Vector& u) const {
  return u - modes_.shapes * (inertia_.transpose() * u);
}

Vector ResidualFlexibility::response(const Vector& f) const {
  if (complete_) return Vector::Zero(f.size());
  const Vector part = modal_loads(modes_, f);
  Vector elastic = f - inertia_ * part;
  const Vector terms = f.cwiseAbs() + inertia_size_ * part.cwiseAbs();
  for (Eigen::Index i = 0; i < elastic.size(); ++i)
    if (std::abs(elastic[i]) <= roundings * terms[i]) elastic[i] = 0.0;
  Vector u = without_kept(solver_.solve(elastic));
  if (shift_ > 0.0)
    for (int i = 0; i < corrections; ++i) u = without_kept(solver_.solve(elastic + shift_ * (mass_ * u)));
  if (!u.allFinite()) throw NotReducible("the static response of the neglected modes is not finite");
  return u;
}

namespace {

constexpr double needless =
    1e-12;  // a smaller residual compliance, relative to the compliance, needs no shape
constexpr double no_mass = 1e-12;  // smallest 1/omega^2 of a Ritz vector with mass, relative to the largest

/// Sum of (phi^T f)^2/omega^2 over the kept modes with omega > 0.
double compliance_of_kept(const KeptModes& modes, const Vector& f) {
  const Vector part = modal_loads(modes, f);
  double sum = 0.0;
  for (Eigen::Index j = modes.free; j < part.size(); ++j) sum += part[j] * part[j] / modes.squares[j];
  return sum;
}

/// Subtracts from x its part along the K-orthonormal columns of the basis; does so twice because of rounding.
Vector rest_of(const Vector& x, const Eigen::MatrixXd& basis, const SparseMatrix& k) {
  Vector rest = x;
  for (int round = 0; round < 2 && basis.cols() > 0; ++round)
    rest -= basis * (basis.transpose() * (k * rest));
  return rest;
}

}  // namespace

StaticShapes static_shapes(const SparseMatrix& mass, const SparseMatrix& stiffness, const KeptModes& modes,
                           const std::vector<ActingForce>& forces) {
  const auto n = mass.rows();
  StaticShapes result;
  const ResidualFlexibility flexibility(mass, stiffness, modes);
  Eigen::MatrixXd basis(n, 0);  // K-orthonormal
  const auto extend = [&](bool needs_mass) {
    for (std::size_t i = 0; i < forces.size(); ++i) {
      if (forces[i].needs_mass != needs_mass) continue;
      const Vector rest = rest_of(result.responses[i], basis, stiffness);
      const double energy = rest.dot(stiffness * rest);
      const double all =
          compliance_of_kept(modes, forces[i].force) + forces[i].force.dot(result.responses[i]);
      if (!(energy > needless * all)) continue;
      basis.conservativeResize(Eigen::NoChange, basis.cols() + 1);
      basis.rightCols(1) = rest / std::sqrt(energy);
    }
  };
  for (const ActingForce& f : forces) {
    result.responses.push_back(flexibility.response(f.force));
    const double residual = std::max(0.0, f.force.dot(result.responses.back()));
    result.shares.push_back(f.share);
    result.shares.back().compliance = compliance_of_kept(modes, f.force) + residual;
    result.shares.back().residual = residual;
  }
  extend(true);
  const Eigen::Index massive = basis.cols();
  extend(false);
  result.massless = basis.rightCols(basis.cols() - massive);
  if (massive == 0) {
    result.massive.resize(n, 0);
    return result;
  }
  // K is the identity in this basis, so the eigenvalues of the mass matrix are 1/omega^2, the lowest frequency last.
  const Eigen::MatrixXd h = basis.leftCols(massive);
  const base::EigenPairs ritz = base::symmetric_eigen(h.transpose() * (mass * h));
  result.massive.resize(n, massive);
  result.massive_squares.resize(massive);
  Eigen::Index count = 0;
  for (Eigen::Index j = massive - 1; j >= 0; --j) {
    if (!(ritz.values[j] > no_mass * ritz.values[massive - 1])) break;
    result.massive.col(count) = h * ritz.vectors.col(j) / std::sqrt(ritz.values[j]);
    result.massive_squares[count++] = 1.0 / ritz.values[j];
  }
  result.massive.conservativeResize(Eigen::NoChange, count);
  result.massive_squares.conservativeResize(count);
  return result;
}

namespace {

constexpr double ten_digits = 1e-9;

double inner(const SparseMatrix& a, const SparseMatrix& b) { return a.cwiseProduct(b).sum(); }

/// Least-squares fit C = alpha M + beta K over all entries, with M and K scaled to norm 1.
RayleighFactors fitted(const SparseMatrix& damping, const SparseMatrix& mass, const SparseMatrix& stiffness) {
  const double m = mass.norm(), k = stiffness.norm();
  const double cm = m > 0.0 ? inner(damping, mass) / m : 0.0,
               ck = k > 0.0 ? inner(damping, stiffness) / k : 0.0;
  const double mk = m > 0.0 && k > 0.0 ? inner(mass, stiffness) / (m * k) : 0.0;
  const double det = 1.0 - mk * mk;
  if (!(det > ten_digits)) return {m > 0.0 ? cm / m : 0.0, 0.0};  // M and K are proportional
  return {m > 0.0 ? (cm - mk * ck) / (det * m) : 0.0, k > 0.0 ? (ck - mk * cm) / (det * k) : 0.0};
}

bool is_sum(const SparseMatrix& damping, const SparseMatrix& mass, const SparseMatrix& stiffness,
            const RayleighFactors& f) {
  const SparseMatrix rest = damping - SparseMatrix(f.alpha * mass + f.beta * stiffness);
  const SparseMatrix size =
      SparseMatrix(damping.cwiseAbs()) +
      SparseMatrix(f.alpha * SparseMatrix(mass.cwiseAbs()) + f.beta * SparseMatrix(stiffness.cwiseAbs()));
  for (int j = 0; j < rest.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(rest, j); it; ++it)
      if (!(std::abs(it.value()) <= ten_digits * size.coeff(it.row(), it.col()))) return false;
  return true;
}

}  // namespace

std::optional<RayleighFactors> rayleigh_factors(const SparseMatrix& damping, const SparseMatrix& mass,
                                                const SparseMatrix& stiffness) {
  const double size = damping.norm();
  if (!(size > 0.0)) return std::nullopt;
  RayleighFactors f = fitted(damping, mass, stiffness);
  if (std::abs(f.alpha) * mass.norm() <= ten_digits * size) f.alpha = 0.0;
  if (std::abs(f.beta) * stiffness.norm() <= ten_digits * size) f.beta = 0.0;
  if (f.alpha < 0.0 || f.beta < 0.0 || !is_sum(damping, mass, stiffness, f)) return std::nullopt;
  return f;
}

}  // namespace signorini::reduce
