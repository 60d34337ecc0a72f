#include "engine/exact/modal/modal_system.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/rounding.hpp"
#include "base/simd.hpp"
#include "contact/friction.hpp"
#include "contact/law.hpp"
#include "engine/exact/modal/modal_proof.hpp"

namespace signorini::modal {

ForceLaw force_law(const Contact& contact, const ContactState& state, double applied) {
  const Rows r = contact::rows(contact, state);
  ForceLaw law;
  law.N_gap = -r.normal.gap;
  law.N_constant = -(r.normal.applied_normal_force * applied + r.normal.constant);
  law.T_gap = -r.tangent.N * law.N_gap;
  law.T_ut = -r.tangent.ut;
  law.T_constant = -(r.tangent.N * law.N_constant + r.tangent.constant);
  return law;
}

/// Limit of the relative error eps (omega/alpha)^2 of works. Cause of this error: the division by
/// (l_k - l_i)^2 + 2 alpha^2 (l_k + l_i) in modal_works.hpp.
constexpr double max_work_error = 1e-12;

std::string coupling_refusal(const Model& model) {
  if (model.size() == 0) return "no degrees of freedom";
  for (const Contact& contact : model.contacts) {
    if (!contact.has_linear_coulomb_law()) return "user-defined laws";
    if (contact.takes_impulses()) return "rigid contacts";
    if (contact.sticks_rigidly()) return "contacts that stick without a tangential stiffness";
    if (contact.sliding_point()) return "shear elements";
    if (contact.normal_damping != 0.0) return "dashpots of contacts";
    if (contact::friction_varies(contact)) return contact::friction_description(contact);
  }
  if (std::any_of(model.dofs.begin(), model.dofs.end(), [](const Dof& dof) { return dof.massless; }))
    return "massless degrees of freedom";
  if (!is_symmetric(model.mass) || !is_symmetric(model.stiffness)) return "matrices that are not symmetric";
  if (!has_narrow_band(model.mass, model.stiffness)) return "matrices with a wide band";
  const double alpha = model.damping.coeff(0, 0) / model.mass.coeff(0, 0);
  const SparseMatrix rest = model.damping - alpha * model.mass;
  if (!(rest.norm() <= rounding::many_operations * model.damping.norm()))
    return "damping that is not proportional to the mass";
  return {};
}

std::string proportional_refusal(const Model& model) {
  if (!has_constant_excitation(model)) return "loads or surface motions that are not piecewise constant";
  if (std::string why = coupling_refusal(model); !why.empty()) return why;
  const double alpha = model.damping.coeff(0, 0) / model.mass.coeff(0, 0);
  if (!(alpha > 0.0)) return "no damping proportional to the mass";
  if (!(alpha * alpha * max_work_error >= rounding::eps * model.omega1 * model.omega1))
    return "damping so small that work integrals of two modes lose accuracy";
  return {};
}

std::size_t max_state_springs(const Model& model) {
  std::size_t count = 0;
  for (const Contact& contact : model.contacts)
    count += (contact.normal_spring() ? 1u : 0u) + (contact.tangential_stiffness ? 1u : 0u);
  return count;
}

Amplitudes constant_forces(const Model& model, const StateModes& state,
                           const contact::ContactStates& contact_states, const motion::Forcing& forcing,
                           double t) {
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
    const ForceLaw law = force_law(contact, contact_states[c], forcing.applied_normal_force(c, t, 0));
    const double gap = contact.gap, surface = forcing.surface(c, t, 0);
    if (!contact.normal_force_given()) add(state.from_normal[c], -(law.N_constant + law.N_gap * gap));
    add(state.from_tangent[c], -(law.T_constant + law.T_gap * gap - law.T_ut * surface));
  }
  return forces;
}

ModalSystem::ModalSystem(const Model& model, const UnconstrainedBasis& basis)
    : model_(model),
      basis_(basis),
      poles_(basis.omega_squared()),
      alpha_(model.damping.coeff(0, 0) / model.mass.coeff(0, 0)) {}

std::shared_ptr<const StateModes> ModalSystem::state(const contact::ContactStates& contact_states) {
  const std::vector<State> states = contact::states_of(contact_states);
  if (const auto* known = known_.find(states)) return *known;
  ++made_;
  auto made = std::make_shared<const StateModes>(make(contact_states));
  const auto rows = static_cast<std::size_t>(poles_.size());
  const std::size_t lists = 2 * (basis_.normals().size() + basis_.tangents().size() + basis_.loads().size());
  const std::size_t bytes = made->spectrum.stored_bytes() + made->pairs.bytes();
  return known_.insert(states, std::move(made),
                       bytes + rows * sizeof(double) * (lists + 8 * (1 + 2 * contact_states.size())));
}

/// Computes the modes of the contact states, the eigenvectors of D + U V^T. Each contact adds at most two columns to U and V.
StateModes ModalSystem::make(const contact::ContactStates& contact_states) const {
  std::vector<Vector> u, v;
  bool symmetric = true;
  const auto add = [&](const Vector& force, const Vector& form, double stiffness) {
    u.push_back(force * std::sqrt(stiffness));
    v.push_back(form * std::sqrt(stiffness));
  };
  for (std::size_t c = 0; c < contact_states.size(); ++c) {
    const ForceLaw law = force_law(model_.contacts[c], contact_states[c], 0.0);
    if (law.N_gap != 0.0)
      add(basis_.normal(c) + (law.T_gap / law.N_gap) * basis_.tangent(c), basis_.normal(c), law.N_gap);
    if (law.T_ut != 0.0) add(basis_.tangent(c), basis_.tangent(c), law.T_ut);
    symmetric = symmetric && law.T_gap == 0.0;
  }
  Eigen::MatrixXd forces(basis_.omega_squared().size(), static_cast<Eigen::Index>(u.size())), forms = forces;
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
  const bool slips = std::any_of(contact_states.begin(), contact_states.end(),
                                 [](const ContactState& c) { return slip_sign(c.state) != 0; });
  if (slips && spectrum.stored_bytes() > 0) made.pairs = ModePairs(spectrum, alpha_);
  return made;
}

// Contact quantities on a step: polynomials for the slow modes, and bounds on the contribution of the fast modes.

namespace {

constexpr std::size_t most_degree = 30;

/// Errors of N, T, g and ut (order of TurningPointDetector::watched_fields) due to the error `normal` of g and `tangent` of ut.
std::array<double, 4> errors_by_law(const ForceLaw& law, double normal, double tangent) {
  return {std::abs(law.N_gap) * normal, std::abs(law.T_gap) * normal + std::abs(law.T_ut) * tangent, normal,
          tangent};
}

}  // namespace

/// Selects the slow modes: those that polynomials represent on a step of length h_.
void ModalProof::split_modes(bool all_slow) {
  const std::vector<double>& l = oscillators_->real();
  const std::vector<Complex>& pairs = oscillators_->pairs();
  const double square = max_slow_angle * max_slow_angle * (1.0 + 1e-12);
  fast_ = static_cast<std::size_t>(
      std::partition_point(l.begin(), l.end(), [&](double value) { return value * h_ * h_ < square; }) -
      l.begin());
  if (all_slow) fast_ = l.size();
  pair_slow_.assign(pairs.size(), true);
  for (std::size_t k = 0; k < pairs.size(); ++k) pair_slow_[k] = size_of(pairs[k]) * h_ * h_ <= square;
}

/// Bounds on the sum of the fast modes and the remainders of the slow modes in N, T, g and ut, or in their rates (of_rate).
/// The amplitude of mode k is at most A_k, its rate at most sqrt(l_k) A_k.
ModalProof::WatchedValues ModalProof::fast_bounds(std::size_t c, bool of_rate) const {
  const ForceLaw& law = laws_[c];
  double normal = of_rate ? normal_rest_[c].rate : normal_rest_[c].place;
  double tangent = of_rate ? tangent_rest_[c].rate : tangent_rest_[c].place;
  for (std::size_t k = fast_; k < amplitude_.size(); ++k) {
    const double most = of_rate ? amplitude_[k] * std::sqrt(oscillators_->real()[k]) : amplitude_[k];
    normal += std::abs(state_->normal[c].real[k]) * most;
    tangent += std::abs(state_->tangent[c].real[k]) * most;
  }
  return errors_by_law(law, normal, tangent);
}

/// For each quantity N, T, g and ut: the largest s <= 1 for which the quantity is monotone or constant on [0, s x_end]. N is a
/// function of g; T is a function of g in slip and of ut in stick.
ModalProof::WatchedValues ModalProof::monotone_parts(std::size_t c, double x_end,
                                                     std::vector<double>& p) const {
  const ForceLaw& law = laws_[c];
  const WatchedValues fast_bound = fast_bounds(c, true);
  const auto goes = [&](motion::ContactSeries::Field rate, double off) {
    const double* a = slow_[c].coefficients(rate);
    return stays_above(a, degree_, x_end, a[0] < 0.0 ? -1.0 : 1.0, -off, p);
  };
  const double gap = goes(motion::ContactSeries::vn, fast_bound[2]),
               ut = goes(motion::ContactSeries::vt, fast_bound[3]);
  const double N = law.N_gap != 0.0 ? gap : 1.0;
  const double T = std::min(law.T_gap != 0.0 ? gap : 1.0, law.T_ut != 0.0 ? ut : 1.0);
  return {N, T, gap, ut};
}

double ModalProof::length_without_turning(const ModalPoint& /*at*/, const events::TurningPointDetector& known,
                                          double x_end) const {
  if (std::find(pair_slow_.begin(), pair_slow_.end(), false) != pair_slow_.end()) return 0.0;
  std::vector<double> p(degree_ + 1);
  double safe = 1.0;  // relative to x_end
  for (std::size_t c = 0; c < slow_.size() && safe > 0.0; ++c) {
    const WatchedValues fast_bound = fast_bounds(c, false), forth = monotone_parts(c, x_end, p);
    const WatchedValues unsure = errors_by_law(laws_[c], rounding::elimination * normal_size_[c].place,
                                               rounding::elimination * tangent_size_[c].place);
    for (std::size_t f = 0; f < fast_bound.size(); ++f) {
      const events::TurningPointDetector::Range& range =
          known.range(c, events::TurningPointDetector::watched_fields[f]);
      const double* a = slow_[c].coefficients(events::TurningPointDetector::watched_fields[f]);
      // `unsure` covers rounding: find_turning_at_start() sums the slope in another order, so a slope that is only a rounding
      // error may have the opposite sign there.
      if (range.is_exceeded(a[0], a[1], fast_bound[f] + unsure[f])) return 0.0;
      if (forth[f] >= safe) continue;
      for (const double sign : {-1.0, 1.0}) {
        const double room = (sign < 0.0 ? range.greatest : -range.least) - fast_bound[f];
        safe = std::min(safe, std::max(forth[f], stays_above(a, degree_, x_end, sign, room, p)));
      }
    }
  }
  return safe * x_end;
}

/// Finds extremes exactly at the beginning of a passage: a quantity exceeds its earlier range there, and its rate points back.
void ModalProof::find_turning_at_start(const ModalPoint& at, double time,
                                       events::TurningPointDetector& turning, LastTurningTimes& turns) const {
  for (std::size_t c = 0; c < laws_.size(); ++c) {
    const ModalKinematics now = kinematics(c, at);
    const ForceLaw& law = laws_[c];
    const WatchedValues value{law.N(now.gap), law.T(now.gap, now.ut), now.gap, now.ut};
    const WatchedValues rate{law.N_rate(now.vn), law.T_rate(now.vn, now.vt), now.vn, now.vt};
    for (std::size_t f = 0; f < value.size(); ++f)
      if (const auto peak = turning.find_at_start(c, events::TurningPointDetector::watched_fields[f],
                                                  value[f], rate[f], time))
        turns[peak->kind] = peak->time;
  }
}

double ModalProof::expand_for_turning(const ModalPoint& at, const events::TurningPointDetector& known,
                                      double share, double remaining) {
  oscillators_->amplitudes(at, *forces_, amplitude_, pair_amplitude_);
  const std::size_t n = amplitude_.size();
  std::size_t first = 0;
  for (std::size_t c = 0; c < slow_.size(); ++c) {
    const ForceLaw& law = laws_[c];
    const ModalKinematics now = kinematics(c, at);
    const double N = law.N(now.gap), T = law.T(now.gap, now.ut);
    const auto allowed = [&](motion::ContactSeries::Field field, double value, double factor) {
      return factor == 0.0 ? Oscillators::never
                           : share * known.range(c, field).width(value) / std::abs(factor);
    };
    const double normal = std::min({allowed(motion::ContactSeries::gap, now.gap, 1.0),
                                    allowed(motion::ContactSeries::N, N, law.N_gap),
                                    allowed(motion::ContactSeries::T, T, law.T_gap)});
    const double tangent = std::min(allowed(motion::ContactSeries::slide, now.ut, 1.0),
                                    allowed(motion::ContactSeries::T, T, law.T_ut));
    double normal_sum = 0.0, tangent_sum = 0.0;
    std::size_t k = n;
    for (; k > first; --k) {
      normal_sum += std::abs(state_->normal[c].real[k - 1]) * amplitude_[k - 1];
      tangent_sum += std::abs(state_->tangent[c].real[k - 1]) * amplitude_[k - 1];
      if (normal_sum > normal || tangent_sum > tangent) break;
    }
    first = std::max(first, k);
  }
  h_ = std::min(remaining, max_decay / alpha_);
  if (n > 0 && oscillators_->real()[std::min(first, n - 1)] > 0.0)
    h_ = std::min(h_, max_slow_angle / std::sqrt(oscillators_->real()[std::min(first, n - 1)]));
  for (const Complex l : oscillators_->pairs()) h_ = std::min(h_, max_slow_angle / std::sqrt(size_of(l)));
  split_modes(first == n);
  expand(at);
  return h_;
}

/// Same result as taylor_of_mode() for all slow real modes, in loops over the modes that the compiler can vectorise.
SIGNORINI_WIDE_LANES void ModalProof::expand_real(const ModalPoint& at) {
  const double* l = oscillators_->real().data();
  const double square = h_ * h_, *z = at.z.real.data(), *rate = at.rate.real.data();
  double* first = coefficients_.data();
  for (std::size_t k = 0; k < fast_; ++k) first[k] = z[k];
  double* second = first + fast_;
  for (std::size_t k = 0; k < fast_; ++k) second[k] = h_ * rate[k];
  const double* p = forces_->real.data();
  for (std::size_t j = 0; j + 2 < count_; ++j) {
    double* next = second + fast_;
    const double down = 1.0 / static_cast<double>(j + 2);
    const double pull = square * down / static_cast<double>(j + 1), drag = alpha_ * h_ * down;
    if (j == 0)
      for (std::size_t k = 0; k < fast_; ++k) next[k] = (p[k] - l[k] * first[k]) * pull - second[k] * drag;
    else
      for (std::size_t k = 0; k < fast_; ++k) next[k] = -(l[k] * first[k]) * pull - second[k] * drag;
    first = second;
    second = next;
  }
}

/// Computes count_ Taylor coefficients of each slow mode, in powers of t / h.
void ModalProof::expand_modes(const ModalPoint& at) {
  const std::vector<double>& l = oscillators_->real();
  const std::vector<Complex>& pairs = oscillators_->pairs();
  const double fastest = fast_ > 0 ? std::sqrt(std::abs(l[fast_ - 1])) * h_ : 0.0;
  const bool any_pair = std::any_of(pair_slow_.begin(), pair_slow_.end(), [](bool slow) { return slow; });
  const double reach = any_pair ? max_slow_angle : std::max(fastest, 0.5 * alpha_ * h_);
  degree_ = std::min<std::size_t>(most_degree, 10 + static_cast<std::size_t>(5.5 * reach));
  count_ = degree_ + 3;
  coefficients_.resize(count_ * fast_);
  expand_real(at);
  pair_coefficients_.resize(count_ * pairs.size());
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (pair_slow_[k])
      taylor_of_mode(at.z.pair[k], at.rate.pair[k], forces_->pair[k], pairs[k], alpha_, h_, count_,
                     pairs.size(), pair_coefficients_.data() + k);
}

/// Writes the polynomial of a form to `out`: the sum over all modes of the mode's coefficient in the form (row) times the
/// polynomial of a slow mode or the static value of a fast mode. still: sum of the static values of fast real modes. Returns
/// bounds on the remainder of the value and of the rate.
ModalProof::Size ModalProof::sum(const Amplitudes& row, double still, std::vector<double>& out) const {
  const std::vector<Complex>& pairs = oscillators_->pairs();
  out.assign(count_, 0.0);
  const auto slow = static_cast<Eigen::Index>(fast_), terms = static_cast<Eigen::Index>(count_);
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> of_modes(
      coefficients_.data(), terms, slow);
  const Eigen::Map<const Eigen::VectorXd> shown(row.real.data(), slow);
  Eigen::Map<Eigen::VectorXd>(out.data(), terms).noalias() = of_modes * shown;
  // Each further term of the series of a mode is at most half of the previous term.
  const auto rest = static_cast<Eigen::Index>(count_ - degree_ - 1);
  double left = 2.0 * (of_modes.bottomRows(rest).cwiseAbs() * shown.cwiseAbs()).sum();
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (!pair_slow_[k]) {
      still += real_contribution(row.pair[k] * forces_->pair[k] * inverse(pairs[k]));
      continue;
    }
    for (std::size_t j = 0; j < count_; ++j) {
      const Complex term = row.pair[k] * pair_coefficients_[j * pairs.size() + k];
      out[j] += real_contribution(term);
      if (j > degree_) left += 4.0 * size_of(term);
    }
  }
  out[0] += still;
  return {left, left * static_cast<double>(degree_ + 3) / h_};
}

/// Expands gap, ut, their rates, N and T of all contacts as polynomials in t / h. Fast modes contribute their static values.
void ModalProof::expand(const ModalPoint& at) {
  expand_modes(at);
  const std::size_t contacts = model_.contacts.size();
  normal_rest_.resize(contacts);
  tangent_rest_.resize(contacts);
  std::vector<double> n, t;
  for (std::size_t c = 0; c < contacts; ++c) {
    normal_rest_[c] = sum(state_->normal[c], static_normal_[c][fast_], n);
    tangent_rest_[c] = sum(state_->tangent[c], static_tangent_[c][fast_], t);
    n[0] += model_.contacts[c].gap;
    t[0] -= surface_[c];
    motion::ContactSeries& slow = slow_[c];
    slow.reset(degree_);
    const ForceLaw& law = laws_[c];
    for (std::size_t j = 0; j <= degree_; ++j) {
      const double rate = static_cast<double>(j + 1) / h_;
      slow.mutable_coefficients(motion::ContactSeries::gap)[j] = n[j];
      slow.mutable_coefficients(motion::ContactSeries::ut)[j] =
          slow.mutable_coefficients(motion::ContactSeries::slide)[j] = t[j];
      slow.mutable_coefficients(motion::ContactSeries::vn)[j] = rate * n[j + 1];
      slow.mutable_coefficients(motion::ContactSeries::vt)[j] = rate * t[j + 1];
      slow.mutable_coefficients(motion::ContactSeries::an)[j] =
          rate * n[j + 2] * static_cast<double>(j + 2) / h_;
      slow.mutable_coefficients(motion::ContactSeries::N)[j] =
          law.N_gap * n[j] + (j == 0 ? law.N_constant : 0.0);
      slow.mutable_coefficients(motion::ContactSeries::T)[j] =
          law.T_gap * n[j] + law.T_ut * t[j] + (j == 0 ? law.T_constant : 0.0);
    }
  }
}

}  // namespace signorini::modal
