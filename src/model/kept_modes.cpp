#include "model/kept_modes.hpp"

#include <Spectra/MatOp/SparseSymMatProd.h>
#include <Spectra/MatOp/SymShiftInvert.h>
#include <Spectra/SymGEigsShiftSolver.h>

#include <algorithm>
#include <cmath>

#include "model/eigen_dense.hpp"

namespace signorini {
namespace {

constexpr int dense_up_to = 400;
constexpr double roundings = 1e-12;   // of the terms of a sum, that count as zero
constexpr double shift_share = 1e-3;  // of omega^2 of the first mode left out, or of the highest one
constexpr int corrections = 6;        // each leaves shift/omega^2 < shift_share of what was missing

std::vector<int> with_mass(const SparseMatrix& mass) {
  std::vector<int> heavy;
  for (int i = 0; i < mass.rows(); ++i)
    if (mass.coeff(i, i) > 0.0) heavy.push_back(i);
  return heavy;
}

/// All modes: massless degrees of freedom condensed, shapes complete again.
EigenPairs all_modes(const SparseMatrix& mass, const SparseMatrix& stiffness, const std::vector<int>& heavy) {
  std::vector<int> light;
  for (int i = 0; i < mass.rows(); ++i)
    if (!(mass.coeff(i, i) > 0.0)) light.push_back(i);
  const Eigen::MatrixXd k(stiffness), m(mass);
  const Eigen::MatrixXd coupling = k(light, heavy);
  const Eigen::MatrixXd follow =
      light.empty() ? coupling : Eigen::MatrixXd(-solve_dense(k(light, light), coupling));
  Eigen::MatrixXd condensed = k(heavy, heavy);
  if (!light.empty()) condensed += coupling.transpose() * follow;
  const EigenPairs pairs = generalized_eigen(0.5 * (condensed + condensed.transpose()), m(heavy, heavy));
  EigenPairs result{pairs.values, Eigen::MatrixXd::Zero(mass.rows(), pairs.vectors.cols())};
  result.vectors(heavy, Eigen::all) = pairs.vectors;
  if (!light.empty()) result.vectors(light, Eigen::all) = follow * pairs.vectors;
  return result;
}

/// The lowest modes by Lanczos iteration on (K + shift M)^-1 M, so many that the last is above the cutoff;
/// empty where it does not settle, or where they would be most of all modes.
EigenPairs lowest_modes(double cutoff, const SparseMatrix& mass, const SparseMatrix& stiffness, int heavies) {
  using Inverse = Spectra::SymShiftInvert<double, Eigen::Sparse, Eigen::Sparse>;
  using Product = Spectra::SparseSymMatProd<double>;
  Inverse inverse(stiffness, mass);
  for (int count = 20; count < heavies / 3; count *= 2) {
    Product b(mass);
    Spectra::SymGEigsShiftSolver<Inverse, Product, Spectra::GEigsMode::ShiftInvert> solver(
        inverse, b, count, std::min(2 * count + 20, heavies), -shift_share * cutoff * cutoff);
    solver.init();  // Spectra's own fixed start vector: the same scene gives the same answer
    solver.compute(Spectra::SortRule::LargestMagn, 1000, 1e-12, Spectra::SortRule::SmallestAlge);
    if (solver.info() != Spectra::CompInfo::Successful) return {};
    const Eigen::VectorXd values = solver.eigenvalues();
    if (values[values.size() - 1] > cutoff * cutoff) return {values, solver.eigenvectors()};
  }
  return {};
}

void orthonormalise(Eigen::MatrixXd& x, const SparseMatrix& mass) {
  for (int round = 0; round < 2; ++round)
    for (Eigen::Index j = 0; j < x.cols(); ++j) {
      Eigen::VectorXd v = x.col(j);
      if (j > 0) v -= x.leftCols(j) * (x.leftCols(j).transpose() * (mass * v));
      x.col(j) = v / std::sqrt(v.dot(mass * v));
    }
}

void take_out(const Eigen::MatrixXd& free, const SparseMatrix& mass, Eigen::MatrixXd& x) {
  if (free.cols() > 0) x -= free * (free.transpose() * (mass * x)).eval();
}

}  // namespace

KeptModes modes_up_to(double cutoff, const SparseMatrix& mass, const SparseMatrix& stiffness,
                      const Eigen::MatrixXd& free) {
  const std::vector<int> heavy = with_mass(mass);
  const auto heavies = static_cast<int>(heavy.size());
  EigenPairs pairs;
  if (mass.rows() > dense_up_to) pairs = lowest_modes(cutoff, mass, stiffness, heavies);
  if (pairs.values.size() == 0) pairs = all_modes(mass, stiffness, heavy);

  KeptModes result;
  result.free = static_cast<int>(free.cols());
  Eigen::Index kept = result.free;  // the lowest ones are the free motions, whatever roundoff made of them
  while (kept < pairs.values.size() && pairs.values[kept] <= cutoff * cutoff) ++kept;
  result.left_out = heavies - static_cast<int>(kept);
  if (kept < pairs.values.size()) result.first_left_out = std::sqrt(pairs.values[kept]);

  Eigen::MatrixXd rigid = free;
  orthonormalise(rigid, mass);
  const Eigen::Index elastic = kept - result.free;
  const double reference = result.first_left_out > 0.0 ? pairs.values[kept] : pairs.values[kept - 1];
  result.shift = shift_share * std::max(reference, 0.0);
  result.shapes.resize(mass.rows(), kept);
  result.shapes.leftCols(result.free) = rigid;
  result.squares = Eigen::VectorXd::Zero(kept);
  if (elastic == 0) return result;

  // A step of inverse iteration sharpens the low modes, whose energy is small among that of the high ones.
  Eigen::MatrixXd x = pairs.vectors.middleCols(result.free, elastic);
  const SymmetricSolver solver(SparseMatrix(stiffness + result.shift * mass));
  take_out(rigid, mass, x);
  for (Eigen::Index j = 0; j < elastic; ++j)
    x.col(j) = (pairs.values[result.free + j] + result.shift) * solver.solve(mass * x.col(j));
  take_out(rigid, mass, x);
  const EigenPairs ritz = generalized_eigen(x.transpose() * (stiffness * x), x.transpose() * (mass * x));
  result.shapes.rightCols(elastic) = x * ritz.vectors;
  result.squares.tail(elastic) = ritz.values;
  return result;
}

Vector parts(const KeptModes& modes, const Vector& f) {
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
      shift_(modes.free > 0 ? modes.shift : 0.0),
      solver_(shift_ > 0.0 ? SparseMatrix(stiffness + shift_ * mass) : stiffness) {}

Vector ResidualFlexibility::without_kept(const Vector& u) const {
  return u - modes_.shapes * (modes_.shapes.transpose() * (mass_ * u));
}

Vector ResidualFlexibility::answer(const Vector& f) const {
  const Vector part = parts(modes_, f);
  const Eigen::MatrixXd inertia = mass_ * modes_.shapes;
  Vector elastic = f - inertia * part;
  const Vector terms = f.cwiseAbs() + inertia.cwiseAbs() * part.cwiseAbs();
  for (Eigen::Index i = 0; i < elastic.size(); ++i)
    if (std::abs(elastic[i]) <= roundings * terms[i]) elastic[i] = 0.0;
  Vector u = without_kept(solver_.solve(elastic));
  if (shift_ > 0.0)
    for (int i = 0; i < corrections; ++i) u = without_kept(solver_.solve(elastic + shift_ * (mass_ * u)));
  return u;
}

}  // namespace signorini
