#include "engine/exact/modal/damped_pencil.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/eigen_dense.hpp"

namespace signorini::modal {
namespace {

using Long = DampedPencil::Long;

constexpr Long near_pole = 0.03L;      // modes with |P_j| below this part of |l|^2 + d_j are in G; chosen
constexpr std::size_t max_near = 3;    // largest number of modes in G
constexpr double equal_poles = 1e-13;  // relative distance below which poles are regarded as equal
// Largest coupling of an uncoupled mode, relative to the greatest coupling of all modes with an equal pole.
constexpr double uncoupled_part = 1e-13;
constexpr int max_steps = 30;  // limit of Newton steps; 3 to 5 are usual

}  // namespace

DampedPencil::DampedPencil(const Eigen::VectorXd& square, const Eigen::VectorXd& decay,
                           const std::vector<ModalTerm>& terms)
    : omega_squared_(square), decay_(decay), terms_(terms) {
  for (ModalTerm& term : terms_) {
    const double most = term.stiffness > 0.0 ? term.stiffness : term.damping;
    const double scale = term.rigid ? 1.0 / std::sqrt(term.u.norm() * term.v.norm()) : std::sqrt(most);
    term.u *= scale;
    term.v *= scale;
    term_scale_.push_back(scale);
    stiffness_.push_back(term.rigid ? 1.0 : term.stiffness / most);
    damping_.push_back(term.rigid ? 0.0 : term.damping / most);
  }
  rotate_equal_poles();
  for (Index j = 0; j < size(); ++j) {
    const bool any =
        std::any_of(terms_.begin(), terms_.end(), [&](const ModalTerm& term) { return term.v[j] != 0.0; });
    (any ? coupled_ : uncoupled_).push_back(j);
  }
  double pull = 0.0;  // largest stiffness that a term adds to a mode
  for (const ModalTerm& term : terms_)
    pull = std::max(pull, term.u.cwiseAbs().maxCoeff() * term.v.cwiseAbs().maxCoeff());
  const auto stiff =
      std::find_if(coupled_.begin(), coupled_.end(), [&](Index j) { return omega_squared_[j] > 0.0; });
  if (stiff != coupled_.end())
    reference_omega_ = std::sqrt(static_cast<Long>(omega_squared_[*stiff]));
  else if (pull > 0.0)
    reference_omega_ = std::sqrt(static_cast<Long>(pull));
}

/// Rotates the modes of each group of equal poles so that at most as many modes of the group are coupled as there are terms.
void DampedPencil::rotate_equal_poles() {
  const auto terms = static_cast<Index>(terms_.size());
  for (Index first = 0, last = 0; first < size(); first = last) {
    last = first + 1;
    while (last < size() &&
           omega_squared_[last] - omega_squared_[last - 1] <= equal_poles * omega_squared_[last] &&
           std::abs(decay_[last] - decay_[first]) <= equal_poles * std::abs(decay_[first]))
      ++last;
    const Index rows = last - first;
    if (rows == 1 || terms == 0) continue;
    omega_squared_.segment(first, rows).setConstant(omega_squared_[first]);
    decay_.segment(first, rows).setConstant(decay_[first]);
    Eigen::MatrixXd seen(rows, terms);
    for (Index a = 0; a < terms; ++a)
      seen.col(a) = terms_[static_cast<std::size_t>(a)].v.segment(first, rows);
    const base::EigenPairs pairs = base::symmetric_eigen(seen * seen.transpose());
    rotations_.emplace_back(first, pairs.vectors);
    const double most = uncoupled_part * seen.cwiseAbs().maxCoeff();
    const Eigen::MatrixXd turned = pairs.vectors.transpose() * seen;
    for (Index a = 0; a < terms; ++a) {
      ModalTerm& term = terms_[static_cast<std::size_t>(a)];
      term.u.segment(first, rows) = (pairs.vectors.transpose() * term.u.segment(first, rows)).eval();
      for (Index j = 0; j < rows; ++j)
        term.v[first + j] = turned.row(j).cwiseAbs().maxCoeff() <= most ? 0.0 : turned(j, a);
    }
  }
}

/// Eigenvalues of a dense matrix, which is scaled so that stiff and soft modes have comparable entries.
Eigen::VectorXcd DampedPencil::starting_roots() const {
  const auto m = static_cast<Index>(coupled_.size());
  Eigen::MatrixXd k = omega_squared_(coupled_).asDiagonal(), c = decay_(coupled_).asDiagonal();
  Eigen::Index constraints = 0;
  Eigen::MatrixXd forces(m, static_cast<Index>(rank())), forms = forces;
  for (std::size_t a = 0; a < rank(); ++a) {
    const Eigen::VectorXd u = terms_[a].u(coupled_), v = terms_[a].v(coupled_);
    if (terms_[a].rigid) {
      forces.col(constraints) = u;
      forms.col(constraints++) = v;
      continue;
    }
    if (stiffness_[a] != 0.0) k += stiffness_[a] * u * v.transpose();
    if (damping_[a] != 0.0) c += damping_[a] * u * v.transpose();
  }
  if (constraints > 0) {
    const Eigen::MatrixXd z = base::orthogonal_complement(forms.leftCols(constraints)),
                          left = base::orthogonal_complement(forces.leftCols(constraints)).transpose();
    const Eigen::MatrixXd p = base::solve_dense(left * z, left);
    k = (p * k * z).eval();
    c = (p * c * z).eval();
  }
  const Index count = k.rows();
  Eigen::VectorXd s = k.diagonal().cwiseAbs().cwiseSqrt();
  const double least = count > 0 ? 1e-6 * s.maxCoeff() + 1e-300 : 0.0;
  s = s.cwiseMax(least);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(2 * count, 2 * count);
  for (Index i = 0; i < count; ++i) {  // high to low modes; displacement and rate of a mode are adjacent
    const Index row = count - 1 - i;
    all(2 * i, 2 * i + 1) = s[row];
    for (Index j = 0; j < count; ++j) {
      const Index column = count - 1 - j;
      all(2 * i + 1, 2 * j) = -k(row, column) / s[column];
      all(2 * i + 1, 2 * j + 1) -= c(row, column);
    }
  }
  return count > 0 ? base::general_eigenvalues(all) : Eigen::VectorXcd();
}

/// Adds the contribution of a mode outside G to T.
void DampedPencil::add_far(Index j, Wide l, Local& local) const {
  const Wide p = inverse(pole(j, l)), down = -((l * Long(2) + Wide(decay_[j])) * p * p);
  for (std::size_t a = 0; a < rank(); ++a) {
    const Long v = terms_[a].v[j] * local.scale[a];
    if (v == Long(0)) continue;
    const Wide value = local.kappa[a] * p, slope = local.kappa[a] * down + p * Long(damping_[a]);
    for (std::size_t b = 0; b < rank(); ++b) {
      const Long both = v * (terms_[b].u[j] * local.scale[b]);
      local.t[a][b] += value * both;
      local.slope[a][b] += slope * both;
    }
  }
}

bool DampedPencil::assemble_at(Wide l, Local& local) const {
  local = Local{};
  const Long own = l.re * l.re + l.im * l.im;
  local.unit = std::max(std::sqrt(own), reference_omega_);
  for (std::size_t a = 0; a < rank(); ++a) {
    local.scale.push_back(terms_[a].rigid ? local.unit : Long(1));
    local.kappa.push_back(Wide(stiffness_[a]) + l * Long(damping_[a]));
    if (!terms_[a].rigid) local.t[a][a] = Wide(1);
  }
  for (const Index j : coupled_) {
    if (size_of(pole(j, l)) < near_pole * (own + static_cast<Long>(omega_squared_[j])) ||
        size_of(pole(j, l)) == Long(0)) {
      local.near.push_back(j);
      continue;
    }
    add_far(j, l, local);
  }
  // The modes with the smallest |P_j| stay in G. The contributions of the other modes are added to the sums.
  if (local.near.size() > max_near) {
    std::sort(local.near.begin(), local.near.end(), [&](Index i, Index j) {
      return size_of(pole(i, l)) * (own + Long(omega_squared_[j])) <
             size_of(pole(j, l)) * (own + Long(omega_squared_[i]));
    });
    for (std::size_t i = max_near; i < local.near.size(); ++i) {
      if (size_of(pole(local.near[i], l)) < singular_pencil * own) return false;
      add_far(local.near[i], l, local);
    }
    local.near.resize(max_near);
  }
  local.size = rank() + local.near.size();
  const Long unit = local.unit;
  for (std::size_t i = 0; i < local.near.size(); ++i) {
    const Index j = local.near[i];
    const std::size_t row = rank() + i;
    local.t[row][row] = pole(j, l) * (1 / (unit * unit));
    local.slope[row][row] = (l * Long(2) + Wide(decay_[j])) * (1 / (unit * unit));
    for (std::size_t a = 0; a < rank(); ++a) {
      local.t[row][a] = Wide(terms_[a].u[j] * local.scale[a] / unit);
      local.t[a][row] = -(local.kappa[a] * (terms_[a].v[j] * local.scale[a] / unit));
      local.slope[a][row] = Wide(-damping_[a] * (terms_[a].v[j] * local.scale[a] / unit));
    }
  }
  return true;
}

std::optional<DampedPencil::Wide> DampedPencil::refined_root(Wide l) const {
  Local local;
  Long last = std::numeric_limits<Long>::infinity();
  for (int i = 0; i < max_steps; ++i) {
    if (!assemble_at(l, local)) return std::nullopt;
    const SmallLu<Wide> lu(local.t, local.size);
    SmallVector<Wide> c{}, d{};
    lu.null_vectors(c, d);
    Wide value, slope;
    for (std::size_t a = 0; a < local.size; ++a)
      for (std::size_t b = 0; b < local.size; ++b) {
        value += d[a] * local.t[a][b] * c[b];
        slope += d[a] * local.slope[a][b] * c[b];
      }
    const Wide step = -(value * inverse(slope));
    const Long size = size_of(step), own = size_of(l);
    if (!std::isfinite(size)) return size_of(value) == Long(0) ? std::optional(l) : std::nullopt;
    l += step;
    if (size <= 8 * std::numeric_limits<Long>::epsilon() * own) return l;
    if (size <= Long(1e-15) * own && size >= last) return l;  // the steps are only rounding errors
    last = size;
  }
  return std::nullopt;
}

}  // namespace signorini::modal
