#include "engine/exact/modal/damped_system.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"
#include "contact/friction.hpp"
#include "engine/exact/modal/unconstrained_modes.hpp"
#include "linear/redundant_rows.hpp"

namespace signorini::modal {
namespace {

using Index = Eigen::Index;

constexpr Index max_damper_dofs = 24;  // largest number of degrees of freedom with discrete dampers
constexpr double hardly = 1e-3;        // limit of |l_k + l_i| t_end for RootSums::slow

/// Decomposition of the damping matrix: C = alpha M + beta K + sum of r d d^T. dampers: a few pairs r, d.
struct Damping {
  double alpha = 0.0, beta = 0.0;
  std::vector<std::pair<double, Vector>> dampers;
};

/// Excess R = C - alpha M - beta K (more), and |C| + |alpha M| + |beta K| (terms), both only for the degrees of freedom with an
/// entry of R above the rounding error of `terms`.
struct Rest {
  std::vector<int> dofs;
  Eigen::MatrixXd more, terms;
};

Rest rest_of(const Model& model, double alpha, double beta) {
  const SparseMatrix more = model.damping - alpha * model.mass - beta * model.stiffness;
  const auto terms = [&](Index i, Index j) {
    return std::abs(model.damping.coeff(i, j)) + std::abs(alpha * model.mass.coeff(i, j)) +
           std::abs(beta * model.stiffness.coeff(i, j));
  };
  Rest rest;
  for (int j = 0; j < more.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(more, j); it; ++it) {
      if (std::abs(it.value()) <= rounding::many_operations * terms(it.row(), it.col())) continue;
      for (const auto dof : {static_cast<int>(it.row()), static_cast<int>(it.col())})
        if (std::find(rest.dofs.begin(), rest.dofs.end(), dof) == rest.dofs.end()) rest.dofs.push_back(dof);
    }
  const auto m = static_cast<Index>(rest.dofs.size());
  if (m > max_damper_dofs) return rest;
  rest.more.resize(m, m);
  rest.terms.resize(m, m);
  for (Index i = 0; i < m; ++i)
    for (Index j = 0; j < m; ++j) {
      const int row = rest.dofs[static_cast<std::size_t>(i)], column = rest.dofs[static_cast<std::size_t>(j)];
      rest.more(i, j) = more.coeff(row, column);
      rest.terms(i, j) = terms(row, column);
    }
  return rest;
}

/// Decomposes the excess R = sum of r d d^T by the eigenvalues r and eigenvectors x of D^-1/2 R D^-1/2, with d = D^1/2 x. D is
/// the diagonal of Rest::terms, which gives forces and moments the same unit. Rounding changes an eigenvalue by at most the
/// norm of the rounding errors of the matrix (Weyl). Eigenvalues below this limit, of either sign, are dropped; an inclined
/// damper at stiff members causes such spurious eigenvalues.
std::optional<Damping> dampers_of(const Model& model, double alpha, double beta) {
  const Rest rest = rest_of(model, alpha, beta);
  if (static_cast<Index>(rest.dofs.size()) > max_damper_dofs) return std::nullopt;
  Damping result{alpha, beta, {}};
  if (rest.dofs.empty()) return result;
  const Eigen::VectorXd root = rest.terms.diagonal().cwiseSqrt();
  if (!(root.minCoeff() > 0.0)) return std::nullopt;  // R has a zero on its diagonal: not a sum of dampers
  const Eigen::VectorXd inverse = root.cwiseInverse();
  const double rounded =
      rounding::many_operations * (inverse.asDiagonal() * rest.terms * inverse.asDiagonal()).norm();
  const base::EigenPairs pairs =
      base::symmetric_eigen(inverse.asDiagonal() * rest.more * inverse.asDiagonal());
  for (Index k = 0; k < pairs.values.size(); ++k) {
    if (std::abs(pairs.values[k]) <= rounded) continue;
    if (pairs.values[k] < 0.0) return std::nullopt;
    Vector direction = Vector::Zero(model.size());
    for (Index i = 0; i < root.size(); ++i)
      direction[rest.dofs[static_cast<std::size_t>(i)]] = root[i] * pairs.vectors(i, k);
    result.dampers.emplace_back(pairs.values[k], std::move(direction));
  }
  return result;
}

/// Decomposition with the alpha and beta of the scene or, if this needs too many dampers, with the alpha and beta that fit C
/// best. nullopt: both decompositions need too many dampers.
std::optional<Damping> damping_of(const Model& model) {
  if (auto given = dampers_of(model, model.alpha, model.beta)) return given;
  const auto product = [](const SparseMatrix& a, const SparseMatrix& b) { return a.cwiseProduct(b).sum(); };
  Eigen::Matrix2d normal;
  const double mk = product(model.mass, model.stiffness);
  normal << product(model.mass, model.mass), mk, mk, product(model.stiffness, model.stiffness);
  const Eigen::Vector2d right(product(model.mass, model.damping), product(model.stiffness, model.damping));
  const auto factors = base::solve_regular(normal, right);
  if (!factors) return std::nullopt;
  return dampers_of(model, (*factors)[0], (*factors)[1]);
}

}  // namespace

namespace {

/// True if rigid terms constrain the same motion, so that their forces are not unique (linear/redundant_rows.hpp).
bool has_redundant_constraints(const std::vector<ModalTerm>& terms) {
  std::vector<Index> rigid;
  for (std::size_t a = 0; a < terms.size(); ++a)
    if (terms[a].rigid) rigid.push_back(static_cast<Index>(a));
  if (rigid.size() < 2) return false;
  Eigen::MatrixXd v(terms.front().v.size(), static_cast<Index>(rigid.size()));
  for (std::size_t i = 0; i < rigid.size(); ++i)
    v.col(static_cast<Index>(i)) = terms[static_cast<std::size_t>(rigid[i])].v;
  return linear::null_of_columns(v).cols() > 0;
}

}  // namespace

std::size_t max_state_terms(const Model& model) {
  const auto damping = damping_of(model);
  std::size_t count = damping ? damping->dampers.size() : 0;
  for (const Contact& contact : model.contacts)
    count += (contact.normal_force_given() ? 0u : 1u) +
             (contact.tangential_stiffness || contact.sticks_rigidly() ? 1u : 0u);
  return count;
}

std::string damped_refusal(const Model& model) {
  if (model.size() == 0) return "no degrees of freedom";
  for (const Contact& contact : model.contacts) {
    if (!contact.has_linear_coulomb_law()) return "user-defined laws";
    if (contact.sliding_point()) return "shear elements";
    if (contact::friction_varies(contact)) return contact::friction_description(contact);
  }
  if (std::any_of(model.dofs.begin(), model.dofs.end(), [](const Dof& dof) { return dof.massless; }))
    return "massless degrees of freedom";
  for (const SparseMatrix* matrix : {&model.mass, &model.damping, &model.stiffness})
    if (!is_symmetric(*matrix)) return "matrices that are not symmetric";
  if (!has_narrow_band(model.mass, model.stiffness)) return "matrices with a wide band";
  const auto damping = damping_of(model);
  if (!damping) return "damping other than Rayleigh damping and a few dampers";
  return {};
}

std::size_t DampedState::bytes() const {
  const auto numbers = modes.shape.size() + modes.force.size() + 2 * modes.from_q.size() + 4 * loss.size() +
                       static_cast<Index>(2 * contacts.size()) * modes.root.size();
  return sizeof(std::complex<double>) * static_cast<std::size_t>(numbers);
}

DampedSystem::DampedSystem(const Model& model, const UnconstrainedBasis& basis, double t_end)
    : model_(model), basis_(basis), t_end_(t_end) {
  const Damping damping = damping_of(model).value_or(Damping{});
  decay_ = (damping.alpha + damping.beta * basis.omega_squared().array()).matrix();
  for (const auto& [strength, direction] : damping.dampers) {
    const Vector d = basis.amplitudes_of_form(direction);
    dampers_.push_back({d, d, 0.0, strength, false});
  }
  damped_ = !dampers_.empty() || decay_.cwiseAbs().maxCoeff() > 0.0;
}

std::shared_ptr<const DampedState> DampedSystem::state(const contact::ContactStates& contact_states) {
  const std::vector<State> states = contact::states_of(contact_states);
  if (const auto* known = known_.find(states)) return *known;
  ++made_;
  auto made = std::make_shared<const DampedState>(make(contact_states));
  const std::size_t bytes = made->bytes();
  return known_.insert(states, std::move(made), bytes);
}

void DampedSystem::add_contact(std::size_t c, const ContactState& state, DampedState& out) const {
  const Contact& contact = model_.contacts[c];
  const Rows r = contact::rows(contact, state);
  ContactRows own;
  own.normal = r.normal;
  own.tangent = r.tangent;
  const auto add = [&](const Vector& u, const Vector& v, double stiffness, double damping, bool rigid) {
    out.terms.push_back({u, v, stiffness, damping, rigid});
    return static_cast<int>(out.terms.size()) - 1;
  };
  const bool rigid = r.normal.an != 0.0;
  if (rigid || r.normal.gap != 0.0 || r.normal.vn != 0.0) {
    const Vector force = r.tangent.T == 0.0 || r.tangent.N == 0.0
                             ? basis_.normal(c)
                             : Vector(basis_.normal(c) - r.tangent.N * basis_.tangent(c));
    own.normal_term = add(force, basis_.normal(c), -r.normal.gap, -r.normal.vn, rigid);
  }
  if (r.tangent.at != 0.0)
    own.tangent_term = add(basis_.tangent(c), basis_.tangent(c), 0.0, 0.0, true);
  else if (r.tangent.ut != 0.0)
    own.tangent_term = add(basis_.tangent(c), basis_.tangent(c), -r.tangent.ut, 0.0, false);
  out.contacts.push_back(std::move(own));
}

void DampedSystem::find_constraints(DampedState& out) const {
  for (std::size_t a = 0; a < out.terms.size(); ++a)
    if (out.terms[a].rigid) out.rigid.push_back(static_cast<Index>(a));
  const Index n = basis_.omega_squared().size(), m = static_cast<Index>(out.rigid.size());
  if (m == 0) return;
  Eigen::MatrixXd u(n, m), v(n, m);
  for (Index i = 0; i < m; ++i) {
    const ModalTerm& term = out.terms[static_cast<std::size_t>(out.rigid[static_cast<std::size_t>(i)])];
    u.col(i) = term.u;
    v.col(i) = term.v;
  }
  out.from_forces = base::solve_dense(v.transpose() * u, v.transpose());
  // Many displacements satisfy the constraints. static_shapes have a low elastic energy, so stiff modes contribute little.
  const Vector soft =
      (basis_.omega_squared().array() + basis_.omega_squared()[std::min(n - 1, m + 3)]).inverse().matrix();
  const Eigen::MatrixXd weighted = soft.asDiagonal() * v;
  out.static_shapes = weighted * base::solve_dense(v.transpose() * weighted, Eigen::MatrixXd::Identity(m, m));
}

void DampedSystem::find_losses(DampedState& out) const {
  const Eigen::VectorXcd& l = out.modes.root;
  const Index k = l.size();
  const Eigen::MatrixXcd rates = out.modes.shape * l.asDiagonal();
  Eigen::MatrixXcd damped = decay_.asDiagonal() * rates;
  for (const ModalTerm& damper : dampers_)
    damped += damper.u * (damper.damping * (damper.v.transpose() * rates));
  const Eigen::MatrixXcd left = rates.transpose();
  out.loss = base::complex_product(left, damped);
  out.loss_conjugate = base::complex_product(left, damped.conjugate());
  RootSums& sums = out.sums;
  sums.direct.setZero(k, k);
  sums.conjugate.setZero(k, k);
  for (Index i = 0; i < k; ++i)
    for (Index j = 0; j < k; ++j)
      for (const bool turned : {false, true}) {
        const std::complex<double> sum = l[i] + (turned ? std::conj(l[j]) : l[j]);
        Eigen::MatrixXcd& loss = turned ? out.loss_conjugate : out.loss;
        if (std::abs(sum) * t_end_ < hardly)
          sums.slow.push_back({i, j, turned, loss(i, j)});
        else
          (turned ? sums.conjugate : sums.direct)(i, j) = 1.0 / sum;
      }
  out.loss = out.loss.cwiseProduct(sums.direct).eval();
  out.loss_conjugate = out.loss_conjugate.cwiseProduct(sums.conjugate).eval();
}

DampedState DampedSystem::make(const contact::ContactStates& contact_states) const {
  DampedState out;
  out.terms = dampers_;
  for (std::size_t c = 0; c < contact_states.size(); ++c) add_contact(c, contact_states[c], out);
  if (out.terms.size() > max_damped_terms) {
    out.modes.failure = "the contact state has too many springs, constraints and dampers for modes";
    return out;
  }
  if (has_redundant_constraints(out.terms)) {
    out.modes.failure = "several rigid contacts constrain the same motion";
    return out;
  }
  out.modes = damped_modes(basis_.omega_squared(), decay_, out.terms);
  if (!out.modes.failure.empty()) return out;
  for (std::size_t c = 0; c < contact_states.size(); ++c) {
    ContactRows& own = out.contacts[c];
    own.gap = out.modes.shape.transpose() * basis_.normal(c);
    own.slide = out.modes.shape.transpose() * basis_.tangent(c);
    if (own.normal.an != 0.0) own.gap.setZero();
    if (own.tangent.at != 0.0) own.slide.setZero();
  }
  find_constraints(out);
  find_losses(out);
  return out;
}

}  // namespace signorini::modal
