#include "decide/unique_forces.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"
#include "contact/friction.hpp"
#include "decide/delassus.hpp"
#include "decide/places.hpp"

namespace signorini {
namespace {

/// Fraction of the largest force. The noise is the size that counts as zero: 64 times 4 to 8 eps of the terms times the
/// condition. A check is worthwhile above a condition of about 1e10. Chosen value; the singular value decides.
constexpr double suspicious = 1e-3;

bool holds(const Contact& contact, const ContactState& state) {
  if (contact.takes_impulses()) return !state.is_open();
  return contact.sticks_rigidly() && state.state == State::stick;
}

/// Matrix A: constraint rows of accelerations, and their response to the constraint forces.
Eigen::MatrixXd held_part(const Model& model, const Mode& mode, const std::vector<std::size_t>& contacts,
                          const Eigen::MatrixXd& W) {
  std::vector<Eigen::Index> rows;
  Eigen::MatrixXd effect = W;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact& contact = model.contacts[contacts[i]];
    const ContactState& state = mode[contacts[i]];
    const Eigen::Index n = normal_place(i), t = tangent_place(i);
    if (contact.takes_impulses()) rows.push_back(n);
    if (contact.has_friction() && state.state == State::stick) rows.push_back(t);
    if (const int s = slip_sign(state.state); s != 0)
      effect.col(n) -= s * slipping_friction(contact, state.state) * W.col(t);
  }
  return effect(rows, rows);
}

/// Adds the terms that make shares unique for feet of one body that share a motion: s z z' for directions z without
/// effect (linear/shared_rows.hpp).
void add_shares(const ForceLayout& layout, const std::vector<SharedForces>& shared,
                const std::vector<std::size_t>& contacts, Eigen::MatrixXd& W) {
  const auto place = [&](std::size_t row) -> std::optional<Eigen::Index> {
    const auto at = std::find(contacts.begin(), contacts.end(), layout.contact_of(row));
    if (at == contacts.end()) return std::nullopt;
    return layout.is_normal(row) ? normal_place(at - contacts.begin()) : tangent_place(at - contacts.begin());
  };
  for (const SharedForces& of : shared)
    for (std::size_t i = 0; i < of.rows.size(); ++i)
      for (std::size_t j = 0; j < of.rows.size(); ++j) {
        const auto a = place(of.rows[i]), b = place(of.rows[j]);
        if (a && b) W(*a, *b) += of.entries(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      }
}

}  // namespace

bool forces_are_noise(const Model& model, const std::vector<MotionJet>& jets) {
  double noise = 0.0, force = 0.0;
  for (std::size_t c = 0; c < jets.size(); ++c) {
    const ContactMotion& now = jets[c].motion[0];
    force = std::max({force, std::abs(now.N), std::abs(now.T)});
    const Contact& contact = model.contacts[c];
    if (contact.takes_impulses() || contact.sticks_rigidly())
      noise = std::max({noise, jets[c].noise[0].N, jets[c].noise[0].T});
  }
  return noise > suspicious * force;
}

bool forces_are_unique(ModeSystems& systems, const Mode& mode) {
  const Model& model = systems.model();
  std::vector<std::size_t> contacts;
  Mode free = mode;
  for (std::size_t c = 0; c < mode.size(); ++c)
    if (holds(model.contacts[c], mode[c])) {
      contacts.push_back(c);
      free[c] = {State::open, 0.0};
    }
  if (contacts.size() < 2) return true;  // normal and tangent of one contact are independent
  const ModeSystemPtr system = systems.of(free);
  if (!system) return true;
  Eigen::MatrixXd W = delassus(model, *system, contacts).W;
  if (const ModeSystemPtr held = systems.of(mode))
    add_shares(model.layout, held->factorised().shared, contacts, W);
  Eigen::MatrixXd a = held_part(model, mode, contacts, W);
  const Eigen::VectorXd size = a.diagonal().cwiseAbs().cwiseSqrt();
  if (!(size.minCoeff() > 0.0)) return true;  // Painleve's paradox is checked elsewhere
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    for (Eigen::Index j = 0; j < a.cols(); ++j) a(i, j) /= size[i] * size[j];
  const Eigen::VectorXd singular = singular_values(a);
  return singular.minCoeff() > rounding::of_many * static_cast<double>(a.rows()) * singular.maxCoeff();
}

}  // namespace signorini
