#include "model/rigid_contacts.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"
#include "base/text.hpp"
#include "contact/friction.hpp"
#include "model/assembly/parts.hpp"
#include "model/assembly/springs.hpp"
#include "scene/saved_state.hpp"

namespace signorini::model {
namespace {

constexpr double takes_part = 1e-9;       // relative to a unit normal: smaller parts are elimination errors
constexpr double closes_together = 1e-9;  // relative difference of equal gaps: scenes have about nine digits
constexpr double dependent =
    1e-12;  // after subtraction of other normals, a smaller rest of a unit normal is zero

[[noreturn]] void refuse(const Scene& scene, std::size_t k, const std::string& key, const std::string& why) {
  const ContactSpec& spec = scene.contacts[k];
  throw SceneError(spec.place, spec.key(key), why);
}

/// Errors: SceneError if friction that depends on the slip rate or on N, or a curved surface, acts on degrees of freedom
/// without mass.
void check_known_motion(const Scene& scene, const Model& model, std::size_t k) {
  const Contact& contact = model.contacts[k];
  const bool varies = contact::friction_varies(contact), curved = contact.curved_surface() != nullptr;
  const bool beside_spring = contact.tangential_stiffness.has_value();
  if (contact.is_linear()) return;
  for (const Combination* form : {&contact.tangent, &contact.normal}) {
    if (form == &contact.normal && !curved && !beside_spring) continue;
    for (const auto& [dof, factor] : form->terms)
      if (const Dof& d = model.dofs[static_cast<std::size_t>(dof)]; d.massless && factor != 0.0)
        refuse(scene, k, varies ? "friction" : "radius",
               fmt::format(
                   "{} needs mass where it acts, but {} has none",
                   varies ? contact::friction_description(contact) : "a curved surface under a varying force",
                   d.displacement));
  }
}

/// Rounding error of a gap at the start, relative to the magnitudes of its terms. In a continued run, errors of displacements
/// are relative to the largest displacement of the structure, even where a displacement is small; and the saved run knows
/// its times, that of a hit too, up to
///     dt = time_resolution (t + h),  h <= t: length of a step,    which changes the gap by dt |g'|.
double rounding_of_gap(const Scene& scene, const Model& model, const Contact& contact) {
  const double own = std::abs(contact.gap) + contact.normal.magnitude(model.u0);
  if (!scene.initial.saved) return rounding::many_operations * own;
  double greatest = model.scales.displacement, sum = 0.0;
  for (Eigen::Index i = 0; i < model.u0.size(); ++i)
    if (!model.dofs[static_cast<std::size_t>(i)].rotation)
      greatest = std::max(greatest, std::abs(model.u0[i]));
  for (const auto& term : contact.normal.terms) sum += std::abs(term.second);
  const double dt = 2.0 * rounding::time_resolution * std::abs(scene.initial.saved->t);
  return rounding::many_operations * (std::abs(contact.gap) + sum * greatest) +
         dt * contact.normal.magnitude(model.v0);
}

/// Sets the gap at u0 to zero if it is zero up to rounding. Returns true if the contact touches.
bool close_gap(const Scene& scene, Model& model, std::size_t k) {
  const Contact& contact = model.contacts[k];
  const double gap = contact.gap_at(model.u0);
  const bool carries = model.static_start && model.statics.reactions[k] > 0.0;
  // A penetration far below the scene's typical displacement may be a rounding error of the displacements.
  const bool rounded = gap < 0.0 && -gap <= rounding::few_operations * model.scales.displacement;
  if (carries || rounded || std::abs(gap) <= rounding_of_gap(scene, model, contact)) {
    double square = 0.0;
    for (const auto& term : contact.normal.terms) square += term.second * term.second;
    for (const auto& [dof, factor] : contact.normal.terms) model.u0[dof] -= gap * factor / square;
    if (contact.normal.terms.size() == 1)
      model.u0[contact.normal.terms[0].first] = (0.0 - contact.gap) / contact.normal.terms[0].second;
    return true;
  }
  const bool judged_later = scene.initial.saved && scene.reduction && scene.reduction->cutoff_omega > 0.0 &&
                            !model.reduction;  // the gap is checked again after the reduction
  if (gap < 0.0 && !judged_later) {
    refuse(scene, k, "gap",
           fmt::format("found a gap of {:.6g} {} at the start, expected a gap >= 0: a rigid contact cannot "
                       "be penetrated",
                       gap, model.units.length));
  }
  return false;
}

/// Closes several gaps together, because closing the gap at one foot of a body moves its other feet:
/// u -= H (H^T H)^-1 g. A second round leaves only the rounding error of u.
void close_together(Model& model, const std::vector<std::size_t>& contacts) {
  Eigen::MatrixXd normals(model.size(), static_cast<Eigen::Index>(contacts.size()));
  for (std::size_t i = 0; i < contacts.size(); ++i)
    normals.col(static_cast<Eigen::Index>(i)) =
        assembly::dense_vector(model.contacts[contacts[i]].normal, model.size());
  for (int round = 0; round < 2; ++round) {
    Eigen::VectorXd gaps(normals.cols());
    for (std::size_t i = 0; i < contacts.size(); ++i)
      gaps[static_cast<Eigen::Index>(i)] = model.contacts[contacts[i]].gap_at(model.u0);
    if (gaps.isZero(0.0)) return;
    model.u0 -= normals * base::least_squares(Eigen::MatrixXd(normals.transpose() * normals), gaps);
  }
}

/// Errors: SceneError for a redundant contact: its normal is a combination of other normals, and its gap is zero whenever the
/// other gaps are zero. If only the normal is a combination, these contacts are never all closed at the same time.
void check_redundance(const Scene& scene, const Model& model, const std::vector<std::size_t>& rigid,
                      std::size_t first) {
  const auto n = static_cast<Eigen::Index>(model.size());
  Eigen::MatrixXd normals(n, 0);
  std::vector<std::size_t> members;
  const auto consider = [&](std::size_t k) {
    const Contact& contact = model.contacts[k];
    const Vector normal = assembly::dense_vector(contact.normal, model.size());
    if (!members.empty()) {
      const Eigen::VectorXd x = base::combination_of_columns(normals, normal);
      if ((normal - normals * x).norm() <= dependent * normal.norm()) {
        double gap = contact.gap, size = std::abs(contact.gap);
        std::vector<std::string> names;
        for (std::size_t j = 0; j < members.size(); ++j) {
          const double part = x[static_cast<Eigen::Index>(j)];
          const Contact& other = model.contacts[members[j]];
          gap -= part * other.gap;
          size += std::abs(part * other.gap);
          if (std::abs(part) > takes_part) names.push_back(other.name);
        }
        if (std::abs(gap) <= closes_together * size)
          refuse(scene, k, "law",
                 fmt::format(
                     "this contact closes at the same time as {}, so the share of each rigid contact in the "
                     "force is not determined; remove this contact, or give all of them law = \"compliant\"",
                     base::join_quoted(names)));
        return;
      }
    }
    normals.conservativeResize(Eigen::NoChange, normals.cols() + 1);
    normals.rightCols(1) = normal;
    members.push_back(k);
  };
  consider(first);
  for (const std::size_t k : rigid)
    if (k != first) consider(k);
}

}  // namespace

void check_rigid_contacts(const Scene& scene, Model& model) {
  std::vector<std::size_t> rigid;
  std::vector<Combination> normals;
  std::vector<bool> closed(model.contacts.size(), false);
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& contact = model.contacts[k];
    check_known_motion(scene, model, k);
    if (!contact.takes_impulses()) continue;
    closed[k] = close_gap(scene, model, k);
    rigid.push_back(k);
    normals.push_back(contact.normal);
  }
  // Normals without a common degree of freedom are independent, so groups are checked one by one.
  for (const std::vector<std::size_t>& group : assembly::coupled_forms(normals)) {
    std::vector<std::size_t> members;
    for (const std::size_t i : group) members.push_back(rigid[i]);
    std::vector<std::size_t> touching;
    std::copy_if(members.begin(), members.end(), std::back_inserter(touching),
                 [&](std::size_t k) { return closed[k]; });
    if (touching.size() > 1) close_together(model, touching);
    for (const std::size_t first : members) check_redundance(scene, model, members, first);
  }
}

namespace {

constexpr double fastest = 1e-6;  // smallest product of the time constant ct/kt and the highest frequency

SparseMatrix enlarged(const SparseMatrix& matrix, int size) {
  SparseMatrix result = matrix;
  result.conservativeResize(size, size);
  return result;
}

}  // namespace

void add_shear_elements(const Scene& scene, Model& model) {
  std::vector<assembly::LineSpring> stiffness, damping;
  std::vector<double> u, v;
  const int before = model.size();
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    Contact& contact = model.contacts[k];
    const double ct = scene.contacts[k].tangential_damping;
    const bool by_rate = contact.friction.is_rate_strengthening() && contact.tangential_stiffness;
    if ((ct == 0.0 && !by_rate) || !contact.has_friction()) continue;
    const double kt = *contact.tangential_stiffness;
    // With a smaller time constant the element would respond immediately, up to rounding.
    if (ct > 0.0 && ct / kt * model.omega_max < fastest)
      throw SceneError(
          scene.contacts[k].place, scene.contacts[k].key("tangential_damping"),
          fmt::format("tangential_damping / tangential_stiffness = {:.3g} is a time constant far "
                      "below the shortest period of the structure, {:.3g}; give 0.0 or a greater value",
                      ct / kt, 2.0 * std::numbers::pi / model.omega_max));
    // On a body without mass the dashpot alone cannot determine the body's motion, only the rate of p relative to the
    // body. Then p - ut is the degree of freedom.
    const bool relative = std::any_of(
        contact.tangent.terms.begin(), contact.tangent.terms.end(),
        [&](const auto& term) { return model.dofs[static_cast<std::size_t>(term.first)].massless; });
    const int p = model.size();
    model.dofs.push_back({contact.name + ".slip", contact.name + ".slip_rate", false, true});
    const double body = contact.tangent.dot(model.u0);
    std::optional<double> saved;
    if (scene.initial.saved) saved = scene::saved_motion(*scene.initial.saved, contact.name + ".slip");
    const double element = saved ? body - *saved : contact.initial_shear / kt;  // deformation of the element
    u.push_back((relative ? 0.0 : body) - element);
    v.push_back(contact.surface_motion.piece(0.0).value(0.0, 1));
    Combination between = relative ? Combination{} : contact.tangent;
    between.terms.emplace_back(p, -1.0);
    stiffness.push_back({between, kt});
    damping.push_back({between, ct});
    contact.shear = ShearElement{contact.tangent, kt, ct};
    contact.tangential_stiffness.reset();
    if (!relative) contact.tangent.terms.clear();
    contact.tangent.terms.emplace_back(p, 1.0);
  }
  const int size = model.size();
  if (size == before) return;
  model.mass = enlarged(model.mass, size);
  model.stiffness = assembly::with_springs(enlarged(model.stiffness, size), stiffness);
  model.damping = assembly::with_springs(enlarged(model.damping, size), damping);
  for (Vector* x : {&model.u0, &model.v0}) x->conservativeResize(size);
  for (int i = before; i < size; ++i) {
    model.u0[i] = u[static_cast<std::size_t>(i - before)];
    model.v0[i] = v[static_cast<std::size_t>(i - before)];
  }
}

}  // namespace signorini::model
