#include "engine/exact/modal/modal_system.hpp"

#include <algorithm>

#include "base/rounding.hpp"
#include "contact/friction.hpp"
#include "contact/law.hpp"

namespace signorini {
ForceLaw force_law(const Contact& contact, const ContactState& state, double pressing) {
  const Rows r = rows(contact, state);
  ForceLaw law;
  law.N_gap = -r.normal.gap;
  law.N_constant = -(r.normal.pressing * pressing + r.normal.constant);
  law.T_gap = -r.tangent.N * law.N_gap;
  law.T_ut = -r.tangent.ut;
  law.T_constant = -(r.tangent.N * law.N_constant + r.tangent.constant);
  return law;
}

/// Relative loss of works: they divide by (l_k - l_i)^2 + 2 alpha^2 (l_k + l_i) (modal_works.hpp) and lose eps
/// (omega/alpha)^2.
constexpr double most_lost = 1e-12;

std::string coupling_refusal(const Model& model) {
  if (model.size() == 0) return "nothing moves";
  for (const Contact& contact : model.contacts) {
    if (!contact.obeys_coulomb()) return "laws of one's own";
    if (contact.takes_impulses()) return "rigid contacts";
    if (contact.sticks_rigidly()) return "contacts that stick without a tangential stiffness";
    if (contact.sliding_point()) return "shear elements";
    if (contact.normal_damping != 0.0) return "dashpots of contacts";
    if (friction_varies(contact)) return named_friction(contact);
  }
  if (std::any_of(model.dofs.begin(), model.dofs.end(), [](const Dof& dof) { return dof.massless; }))
    return "massless degrees of freedom";
  if (!is_symmetric(model.mass) || !is_symmetric(model.stiffness)) return "matrices that are not symmetric";
  if (!has_narrow_band(model.mass, model.stiffness)) return "matrices with a wide band";
  const double alpha = model.damping.coeff(0, 0) / model.mass.coeff(0, 0);
  const SparseMatrix rest = model.damping - alpha * model.mass;
  if (!(rest.norm() <= rounding::of_many * model.damping.norm()))
    return "damping that is not proportional to the mass";
  return {};
}

std::string proportional_refusal(const Model& model) {
  if (!stands_still(model)) return "loads or surfaces that change other than in jumps";
  if (std::string why = coupling_refusal(model); !why.empty()) return why;
  const double alpha = model.damping.coeff(0, 0) / model.mass.coeff(0, 0);
  if (!(alpha > 0.0)) return "no damping proportional to the mass";
  if (!(alpha * alpha * most_lost >= rounding::eps * model.omega1 * model.omega1))
    return "so little damping that works of two modes lose their digits";
  return {};
}

std::size_t most_state_springs(const Model& model) {
  std::size_t count = 0;
  for (const Contact& contact : model.contacts)
    count += (contact.normal_spring() ? 1u : 0u) + (contact.tangential_stiffness ? 1u : 0u);
  return count;
}

Amplitudes constant_forces(const Model& model, const StateModes& state, const Mode& mode,
                           const Forcing& forcing, double t) {
  Amplitudes forces = state.spectrum.zero();
  const auto add = [&](const Amplitudes& from, double factor) {
    if (factor == 0.0) return;
    for (std::size_t k = 0; k < forces.real.size(); ++k) forces.real[k] += factor * from.real[k];
    for (std::size_t k = 0; k < forces.pair.size(); ++k) forces.pair[k] += from.pair[k] * factor;
  };
  for (std::size_t i = 0; i < model.loads.size(); ++i)
    add(state.from_load[i], model.loads[i].history.piece(t).value(t));
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const Contact& contact = model.contacts[c];
    const ForceLaw law = force_law(contact, mode[c], forcing.pressing(c, t, 0));
    const double gap = contact.gap, surface = forcing.surface(c, t, 0);
    if (!contact.normal_force_given()) add(state.from_normal[c], -(law.N_constant + law.N_gap * gap));
    add(state.from_tangent[c], -(law.T_constant + law.T_gap * gap - law.T_ut * surface));
  }
  return forces;
}

ModalSystem::ModalSystem(const Model& model, const OpenBasis& basis)
    : model_(model),
      basis_(basis),
      poles_(basis.square()),
      alpha_(model.damping.coeff(0, 0) / model.mass.coeff(0, 0)) {}

std::shared_ptr<const StateModes> ModalSystem::state(const Mode& mode) {
  const std::vector<State> states = states_of(mode);
  if (const auto* known = known_.find(states)) return *known;
  ++made_;
  auto made = std::make_shared<const StateModes>(make(mode));
  const auto rows = static_cast<std::size_t>(poles_.size());
  const std::size_t lists = 2 * (basis_.normals().size() + basis_.tangents().size() + basis_.loads().size());
  const std::size_t bytes = made->spectrum.written_bytes() + made->pairs.bytes();
  return known_.insert(states, std::move(made),
                       bytes + rows * sizeof(double) * (lists + 8 * (1 + 2 * mode.size())));
}

/// The matrix is a diagonal plus at most two columns for each contact.
StateModes ModalSystem::make(const Mode& mode) const {
  std::vector<Vector> u, v;
  bool symmetric = true;
  const auto add = [&](const Vector& force, const Vector& form, double stiffness) {
    u.push_back(force * std::sqrt(stiffness));
    v.push_back(form * std::sqrt(stiffness));
  };
  for (std::size_t c = 0; c < mode.size(); ++c) {
    const ForceLaw law = force_law(model_.contacts[c], mode[c], 0.0);
    if (law.N_gap != 0.0)
      add(basis_.normal(c) + (law.T_gap / law.N_gap) * basis_.tangent(c), basis_.normal(c), law.N_gap);
    if (law.T_ut != 0.0) add(basis_.tangent(c), basis_.tangent(c), law.T_ut);
    symmetric = symmetric && law.T_gap == 0.0;
  }
  Eigen::MatrixXd forces(basis_.square().size(), static_cast<Eigen::Index>(u.size())), forms = forces;
  for (std::size_t a = 0; a < u.size(); ++a) {
    forces.col(static_cast<Eigen::Index>(a)) = u[a];
    forms.col(static_cast<Eigen::Index>(a)) = v[a];
  }
  StateModes made{Spectrum(poles_, forces, forms, symmetric), {}, {}, {}, {}, {}, {}, {}};
  const Spectrum& spectrum = made.spectrum;
  if (!spectrum.failure().empty()) return made;
  const auto both = [&](const std::vector<Vector>& list, std::vector<Amplitudes>& rows,
                        std::vector<Amplitudes>& from) {
    rows.resize(list.size());
    from.resize(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
      spectrum.of_form(list[i], rows[i]);
      spectrum.to_modes(list[i], from[i]);
    }
  };
  both(basis_.normals(), made.normal, made.from_normal);
  both(basis_.tangents(), made.tangent, made.from_tangent);
  both(basis_.loads(), made.load, made.from_load);
  const bool slips =
      std::any_of(mode.begin(), mode.end(), [](const ContactState& c) { return slip_sign(c.state) != 0; });
  if (slips && spectrum.written_bytes() > 0) made.pairs = ModePairs(spectrum, alpha_);
  return made;
}

}  // namespace signorini
