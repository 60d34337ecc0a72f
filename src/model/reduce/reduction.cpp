#include "model/reduce/reduction.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"
#include "contact/friction.hpp"
#include "model/assembly/parts.hpp"
#include "model/assembly/springs.hpp"
#include "model/modes/stability.hpp"
#include "model/reduce/kept_modes.hpp"
#include "model/reduce/reduced_start.hpp"
#include "model/statics/mechanisms.hpp"

namespace signorini::reduce {
namespace {

constexpr double nothing = 1e-14;  // smaller parts of a form on a shape of size 1 are rounding
constexpr double quick_damper =
    1e-6;                            // smallest product of a static shape's time constant and first_truncated
constexpr double over_damped = 2.0;  // beta times a frequency: above this value a mode is overdamped

[[noreturn]] void refuse(const Scene& scene, const std::string& why) {
  throw SceneError(scene.reduction->place, "reduction", why);
}

/// Refuses structures that cannot be reduced: every massless motion must have a static response, every other
/// motion a mode.
void check_reducible(const Scene& scene, const Model& model) {
  std::vector<int> light;
  for (int i = 0; i < model.size(); ++i)
    if (model.dofs[static_cast<std::size_t>(i)].massless) light.push_back(i);
  if (!light.empty()) {
    const SparseMatrix only = assembly::selection(light, model.size());
    const Eigen::MatrixXd null = statics::null_motions(only.transpose() * model.stiffness * only);
    if (null.cols() > 0) {
      Eigen::Index greatest = 0;
      null.col(0).cwiseAbs().maxCoeff(&greatest);
      const int dof = light[static_cast<std::size_t>(greatest)];
      refuse(scene, fmt::format("{} has no mass and, with all contacts open, no stiffness, so the reduced "
                                "model has no shape for it; give it a mass, or leave [reduction] out",
                                model.dofs[static_cast<std::size_t>(dof)].displacement));
    }
  }
  if (modes::fastest_growth(model.stiffness, model.mass))
    refuse(scene, model.geometric
                      ? "under its static forces (run.geometric) the structure is unstable with all its "
                        "contacts open, and a growing mode has no frequency to compare with the cutoff; "
                        "leave [reduction] out"
                      : "the stiffness matrix has a negative eigenvalue, and a growing mode has no frequency "
                        "to compare with the cutoff; leave [reduction] out");
}

/// Errors: SceneError for moving supports with beta K and prestress. Shapes that follow a support immediately are
/// computed without damping; the omitted damping would have to be that of the elastic stiffness alone.
void check_support_damping(const Scene& scene, const Model& model) {
  const bool follows = std::any_of(model.loads.begin(), model.loads.end(),
                                   [](const Load& load) { return load.kind == LoadKind::support_rate; });
  if (model.geometric && model.beta != 0.0 && follows)
    refuse(scene,
           "a support moves, and the static shapes that follow the support cannot be computed for "
           "run.geometric together with damping.beta; leave [reduction] or beta out");
}

bool normal_needs_mass(const Contact& c) {
  const bool needs_normal_rate = contact::friction_varies(c) && c.tangential_stiffness;
  return !c.normal_force_given() &&
         (c.takes_impulses() || c.normal_damping > 0.0 || needs_normal_rate || c.curved_surface());
}

bool tangent_needs_mass(const Contact& c, double tangential_damping) {
  return c.sticks_rigidly() || !c.is_linear() || tangential_damping > 0.0;
}

std::vector<ActingForce> acting_forces(const Scene& scene, const Model& model) {
  std::vector<ActingForce> forces;
  const auto add = [&](std::string what, int contact, bool normal, const Combination& form, bool needs_mass) {
    ActingForce f;
    f.share.label = std::move(what);
    f.share.contact = contact;
    f.share.normal = normal;
    f.force = assembly::dense_vector(form, model.size());
    f.needs_mass = needs_mass;
    forces.push_back(std::move(f));
  };
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& c = model.contacts[k];
    if (!c.normal_force_given())
      add(fmt::format("normal of contact '{}'", c.name), static_cast<int>(k), true, c.normal,
          normal_needs_mass(c));
    if (c.has_friction())
      add(fmt::format("tangent of contact '{}'", c.name), static_cast<int>(k), false, c.tangent,
          tangent_needs_mass(c, scene.contacts[k].tangential_damping));
  }
  for (const Load& load : model.loads) add(load.name, -1, false, load.direction, false);
  return forces;
}

/// Shapes and matrices of the reduced model; shapes with mass come first.
struct Basis {
  Eigen::MatrixXd shapes;           ///< physical x reduced
  Eigen::VectorXd mass, stiffness;  ///< diagonals
  Eigen::MatrixXd damping;
  Eigen::Index heavy = 0;             ///< number of shapes with mass
  std::vector<Eigen::Index> at_once;  ///< shapes without the damping beta K
};

/// dampers: damping matrix for pairs of shapes with mass; light: damping matrix for all other pairs of shapes.
Basis basis_of(const KeptModes& modes, StaticShapes shapes, const SparseMatrix& dampers,
               const SparseMatrix& light, double alpha, double beta) {
  Basis b;
  const Eigen::Index n = modes.shapes.rows(), m = modes.shapes.cols(), h = shapes.massive.cols(),
                     r = shapes.massless.cols();
  b.heavy = m + h;
  b.shapes.resize(n, m + h + r);
  b.shapes << modes.shapes, shapes.massive, shapes.massless;
  b.mass = Eigen::VectorXd::Zero(m + h + r);
  b.mass.head(m + h).setOnes();
  b.stiffness.resize(m + h + r);
  b.stiffness << modes.squares, shapes.massive_squares, Eigen::VectorXd::Ones(r);
  if (light.nonZeros() > 0 && r > 0) {
    // The massless shapes are rotated so that each of them has a separate time constant, or none.
    const Eigen::MatrixXd c = shapes.massless.transpose() * (light * shapes.massless);
    b.shapes.rightCols(r) = shapes.massless * base::symmetric_eigen(0.5 * (c + c.transpose())).vectors;
  }
  const bool creep = static_shapes_are_damped(beta, modes.first_truncated);
  Eigen::VectorXd elastic = b.stiffness;
  if (!creep) elastic.tail(r).setZero();
  b.damping = (alpha * b.mass + beta * elastic).asDiagonal();
  if (dampers.nonZeros() > 0 || light.nonZeros() > 0) {
    Eigen::MatrixXd c = b.shapes.transpose() * (light * b.shapes);
    c.topLeftCorner(b.heavy, b.heavy) =
        b.shapes.leftCols(b.heavy).transpose() * (dampers * b.shapes.leftCols(b.heavy));
    const double size = c.cwiseAbs().maxCoeff();
    b.damping += (c.array().abs() > nothing * size).select(c, 0.0);
  }
  // A dashpot that only a static shape moves, and that relaxes much faster than any truncated mode, would
  // make the equations stiff without any other effect.
  const double first = modes.first_truncated;
  for (Eigen::Index j = b.heavy; j < b.shapes.cols(); ++j) {
    if (first > 0.0 && b.damping(j, j) * first <= quick_damper) {
      b.damping.row(j).setZero();
      b.damping.col(j).setZero();
    }
    if (!creep) b.at_once.push_back(j);
  }
  return b;
}

/// Scales shapes to a largest translation of 1, rotations by the scene's scales.
void scale(const Model& model, Basis& b) {
  const double arm = model.scales.displacement / model.scales.rotation;
  for (Eigen::Index j = 0; j < b.shapes.cols(); ++j) {
    double size = 0.0;
    for (Eigen::Index i = 0; i < b.shapes.rows(); ++i)
      size = std::max(
          size, std::abs(b.shapes(i, j)) * (model.dofs[static_cast<std::size_t>(i)].rotation ? arm : 1.0));
    const double s = 1.0 / size;
    b.shapes.col(j) *= s;
    b.mass[j] *= s * s;
    b.stiffness[j] *= s * s;
    b.damping.row(j) *= s;
    b.damping.col(j) *= s;
  }
}

/// The form on the reduced degrees of freedom; `massive`: only on the degrees of freedom with mass.
Combination reduced_form(const Combination& form, const Basis& b, bool massive) {
  const Vector full_form = assembly::dense_vector(form, static_cast<int>(b.shapes.rows()));
  const double size = full_form.lpNorm<1>();
  Combination result;
  for (Eigen::Index j = 0; j < (massive ? b.heavy : b.shapes.cols()); ++j)
    if (const double factor = full_form.dot(b.shapes.col(j)); std::abs(factor) > nothing * size)
      result.terms.emplace_back(static_cast<int>(j), factor);
  return result;
}

/// For the load of a support's velocity: the load of the same support's displacement. Null for all other loads.
const Load* driving(const std::vector<Load>& loads, const Load& rate) {
  if (rate.kind != LoadKind::support_rate || rate.history_unit.time != -1) return nullptr;
  for (const Load& load : loads)
    if (load.kind == LoadKind::support && rate.name.starts_with(load.name + " (")) return &load;
  return nullptr;
}

/// A shape without the damping beta K follows its support immediately, q = s x. The term beta s x' of beta K for the
/// support's velocity balances the shape's own term beta q', so both terms are omitted.
void reduce_loads(const Basis& b, double beta, std::vector<Load>& loads) {
  std::vector<Combination> forms;
  for (const Load& load : loads) {
    Combination form = reduced_form(load.direction, b, false);
    if (const Load* support = driving(loads, load)) {
      Vector direction = assembly::dense_vector(form, static_cast<int>(b.shapes.cols()));
      const Vector s = assembly::dense_vector(reduced_form(support->direction, b, false),
                                              static_cast<int>(b.shapes.cols()));
      const double size = direction.cwiseAbs().maxCoeff();
      for (const Eigen::Index j : b.at_once) direction[j] -= beta * s[j];
      form.terms.clear();
      for (Eigen::Index j = 0; j < direction.size(); ++j)
        if (std::abs(direction[j]) > nothing * size)
          form.terms.emplace_back(static_cast<int>(j), direction[j]);
    }
    forms.push_back(std::move(form));
  }
  for (std::size_t i = 0; i < loads.size(); ++i) loads[i].direction = std::move(forms[i]);
}

bool has_mass(const Combination& form, const Basis& b) {
  return std::any_of(form.terms.begin(), form.terms.end(), [&](const auto& t) { return t.first < b.heavy; });
}

void reduce_contacts(const Scene& scene, const Basis& b, Model& model) {
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    Contact& c = model.contacts[k];
    const bool normal_mass = normal_needs_mass(c),
               tangent_mass = tangent_needs_mass(c, scene.contacts[k].tangential_damping);
    const bool slides = !c.tangent.terms.empty();
    c.normal = reduced_form(c.normal, b, normal_mass);
    c.tangent = reduced_form(c.tangent, b, tangent_mass);
    if ((normal_mass && !has_mass(c.normal, b)) || (slides && tangent_mass && !has_mass(c.tangent, b)))
      refuse(scene,
             fmt::format("contact '{}' has no effective mass below the cutoff; raise the cutoff", c.name));
    if ((!c.normal_force_given() && c.normal.terms.empty()) || (c.has_friction() && c.tangent.terms.empty()))
      refuse(scene, fmt::format("no shape below the cutoff moves contact '{}'; raise the cutoff", c.name));
  }
}

/// Restores the gaps and gap rates of rigid contacts by the smallest change of q and w in the norm of M.
void keep_gaps(const Model& model, const Basis& b, const std::vector<double>& gap,
               const std::vector<double>& rate, Vector& q, Vector& w) {
  std::vector<std::size_t> rigid;
  for (std::size_t k = 0; k < model.contacts.size(); ++k)
    if (model.contacts[k].takes_impulses()) rigid.push_back(k);
  if (rigid.empty()) return;
  const auto count = static_cast<Eigen::Index>(rigid.size());
  Eigen::MatrixXd forms(count, b.heavy);
  Eigen::MatrixXd miss(count, 2);
  for (Eigen::Index i = 0; i < count; ++i) {
    const std::size_t k = rigid[static_cast<std::size_t>(i)];
    const Combination& normal = model.contacts[k].normal;
    forms.row(i) =
        assembly::dense_vector(normal, static_cast<int>(b.shapes.cols())).head(b.heavy).transpose();
    miss(i, 0) = gap[k] - normal.dot(q);
    miss(i, 1) = rate[k] - normal.dot(w);
  }
  const Eigen::VectorXd s = b.mass.head(b.heavy).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd change = s.asDiagonal() * base::least_squares(forms * s.asDiagonal(), miss);
  q.head(b.heavy) += change.col(0);
  w.head(b.heavy) += change.col(1);
}

/// Amplitudes of a motion in the span of the shapes, such as the end of a run. Modes are M-orthogonal to all shapes,
/// static shapes K-orthogonal to each other. (With M, massive shapes would take part of the motion of massless ones.)
Vector amplitudes_of(const Basis& b, Eigen::Index modes, const Model& model, const Vector& x) {
  Vector q(b.shapes.cols());
  q.head(modes) = (b.shapes.leftCols(modes).transpose() * (model.mass * x)).cwiseQuotient(b.mass.head(modes));
  const Eigen::Index rest = b.shapes.cols() - modes;
  const Vector left = model.stiffness * (x - b.shapes.leftCols(modes) * q.head(modes));
  q.tail(rest) = (b.shapes.rightCols(rest).transpose() * left).cwiseQuotient(b.stiffness.tail(rest));
  return q;
}

/// Error bound of a form that was zero, after its motion was written as u = R q and q was recomputed from u:
///   many_operations sum_ij |n_i| |R_ij| |q_j|  +  sum_j |(R^T n)_j - N_j| |q_j|
/// The second sum belongs to shapes that the reduced form N omits, because they move along n only by
/// rounding.
double noise_of(const Basis& b, const Combination& physical, const Combination& reduced, const Vector& q) {
  const Vector n = assembly::dense_vector(physical, static_cast<int>(b.shapes.rows()));
  const Vector left_out =
      b.shapes.transpose() * n - assembly::dense_vector(reduced, static_cast<int>(b.shapes.cols()));
  const Vector size = q.cwiseAbs();
  return rounding::many_operations * n.cwiseAbs().dot(b.shapes.cwiseAbs() * size) +
         left_out.cwiseAbs().dot(size);
}

/// Sets gaps and gap rates that were zero in the saved reduced run to zero again: in the saved state they have rounding
/// errors.
void restore_saved_zeros(const Model& model, const Basis& b, const std::vector<Contact>& contacts,
                         const Vector& q, const Vector& w, std::vector<double>& gap,
                         std::vector<double>& rate) {
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const Combination& reduced = model.contacts[k].normal;
    if (!contacts[k].takes_impulses()) continue;
    if (std::abs(contacts[k].gap + gap[k]) > noise_of(b, contacts[k].normal, reduced, q)) continue;
    gap[k] = -contacts[k].gap;
    if (std::abs(rate[k]) <= noise_of(b, contacts[k].normal, reduced, w)) rate[k] = 0.0;
  }
}

/// Sets the amplitudes of the initial state: amplitudes of modes by products with M, amplitudes of static shapes by products
/// with K, so that a static state is reproduced. The part that the shapes cannot represent is stored in Reduction
/// (initial_displacement_lost, initial_velocity_lost).
void reduce_state(const Scene& scene, const Basis& b, Eigen::Index modes, Model& model,
                  const std::vector<Contact>& contacts, Reduction& facts) {
  const Eigen::Index size = b.shapes.cols();
  Vector q(size), w = Vector::Zero(size);
  const Vector mu = model.mass * model.u0, ku = model.stiffness * model.u0, mv = model.mass * model.v0;
  for (Eigen::Index j = 0; j < size; ++j) {
    q[j] = j < modes ? b.shapes.col(j).dot(mu) / b.mass[j] : b.shapes.col(j).dot(ku) / b.stiffness[j];
    if (j < b.heavy) w[j] = b.shapes.col(j).dot(mv) / b.mass[j];
  }
  if (scene.initial.saved) {
    q = amplitudes_of(b, modes, model, model.u0);
    w = amplitudes_of(b, modes, model, model.v0);
  }
  std::vector<double> gap, rate;
  for (const Contact& c : contacts) {
    gap.push_back(c.normal.dot(model.u0));
    rate.push_back(c.normal.dot(model.v0));
  }
  if (scene.initial.saved) restore_saved_zeros(model, b, contacts, q, w, gap, rate);
  keep_gaps(model, b, gap, rate, q, w);
  const Vector du = model.u0 - b.shapes * q, dv = model.v0 - b.shapes * w;
  for (int i = 0; i < model.size(); ++i) {
    const Dof& dof = model.dofs[static_cast<std::size_t>(i)];
    const Scales& size_of = model.scales;
    const double arm = dof.rotation ? size_of.displacement / size_of.rotation : 1.0;
    const double rate_arm = dof.rotation ? size_of.velocity / size_of.angular_velocity : 1.0;
    facts.initial_displacement_lost = std::max(facts.initial_displacement_lost, arm * std::abs(du[i]));
    if (!dof.massless)
      facts.initial_velocity_lost = std::max(facts.initial_velocity_lost, rate_arm * std::abs(dv[i]));
  }
  model.u0 = q;
  model.v0 = w;
}

/// The largest jump of a load during the run. The value at t = 0 is also a jump, unless the static start includes the load.
double greatest_jump(const Load& load, const Model& model, double t_end) {
  double jump = load.is_static && model.static_start ? 0.0 : std::abs(load.history.value(0.0));
  for (const Breakpoint& at : load.history.breakpoints())
    if (at.jump && at.time > 0.0 && at.time <= t_end)
      jump = std::max(jump, std::abs(load.history.piece(at.time).value(at.time) -
                                     load.history.piece_before(at.time).value(at.time)));
  return jump;
}

double ringing(const Model& model, const std::vector<Vector>& answers, double t_end) {
  double greatest = 0.0;
  const std::size_t first = answers.size() - model.loads.size();
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const double jump = greatest_jump(model.loads[i], model, t_end);
    const Vector& structure = answers[first + i];
    const Vector answer = model.ties ? model.ties->with_tied(structure) : structure;
    for (const Column& column : model.columns)
      if (!column.velocity && column.dof >= 0 && !model.is_rotation(column))
        greatest = std::max(greatest, jump * std::abs(answer[column.dof]));
  }
  return greatest;
}

double frequency(double square) { return std::sqrt(std::max(square, 0.0)); }

Reduction facts_of(const Model& model, const KeptModes& modes, const StaticShapes& shapes, double cutoff) {
  Reduction facts;
  facts.dofs = model.dofs;
  facts.cutoff = cutoff;
  facts.modes = static_cast<int>(modes.shapes.cols());
  facts.free_modes = modes.free;
  facts.truncated_modes = modes.truncated_modes;
  facts.massless_shapes = static_cast<int>(shapes.massless.cols());
  facts.massive_shapes = static_cast<int>(shapes.massive.cols());
  if (modes.squares.size() > 0) facts.highest_kept = frequency(modes.squares[modes.squares.size() - 1]);
  facts.first_truncated = modes.first_truncated;
  if (facts.massive_shapes > 0)
    facts.highest_massive = frequency(shapes.massive_squares[shapes.massive_squares.size() - 1]);
  facts.shares = shapes.shares;
  return facts;
}

void set_matrices(const Basis& b, Model& model) {
  model.mass = SparseMatrix(Eigen::MatrixXd(b.mass.asDiagonal()).sparseView());
  model.stiffness = SparseMatrix(Eigen::MatrixXd(b.stiffness.asDiagonal()).sparseView());
  model.damping = SparseMatrix(b.damping.sparseView());
}

void name_dofs(const Reduction& facts, const Basis& b, Model& model) {
  model.dofs.clear();
  for (Eigen::Index j = 0; j < b.shapes.cols(); ++j) {
    const bool mode = j < facts.modes;
    const std::string name =
        mode ? fmt::format("mode {}", j + 1) : fmt::format("static shape {}", j + 1 - facts.modes);
    model.dofs.push_back({name, "rate of " + name, false, j >= b.heavy});
  }
}

/// Computes Reduction::stiffness_terms: |R|^T |K| |R|, the magnitudes to which rounding errors are relative.
Eigen::MatrixXd stiffness_terms(const SparseMatrix& stiffness, const Basis& b) {
  const Eigen::MatrixXd sizes = b.shapes.cwiseAbs();
  return sizes.transpose() * (stiffness.cwiseAbs() * sizes);
}

}  // namespace

bool static_shapes_are_damped(double beta, double first_left_out) {
  return first_left_out == 0.0 || beta * first_left_out > over_damped;
}

void reduce(const Scene& scene, const SparseMatrix& dampers, const SparseMatrix& dashpots, Model& model) {
  check_reducible(scene, model);
  check_support_damping(scene, model);
  const double cutoff = scene.reduction->cutoff_omega;
  KeptModes modes;
  StaticShapes shapes;
  try {
    modes = modes_up_to(cutoff, model.mass, model.stiffness, statics::null_motions(model.stiffness));
    shapes = static_shapes(model.mass, model.stiffness, modes, acting_forces(scene, model));
  } catch (const NotReducible& e) {
    refuse(scene, e.what());
  }
  SparseMatrix single = dampers,
               light = static_shapes_are_damped(model.beta, modes.first_truncated) ? dampers : dashpots;
  if (const auto of_all = rayleigh_factors(dampers, model.mass, model.stiffness); scene.matrices && of_all) {
    model.alpha = of_all->alpha;
    model.beta = of_all->beta;
    single.setZero();
    light.setZero();
  }
  Basis b = basis_of(modes, shapes, single, light, model.alpha, model.beta);
  if (b.heavy == 0)
    refuse(scene, "no mode lies below the cutoff, and no other shape has mass; raise the cutoff");
  scale(model, b);

  Reduction facts = facts_of(model, modes, shapes, cutoff);
  facts.tolerance = scene.reduction->tolerance;
  facts.trials = scene.reduction->trials;
  facts.ringing = ringing(model, shapes.responses, scene.run.t_end);
  const std::vector<Contact> physical = model.contacts;
  reduce_contacts(scene, b, model);
  reduce_loads(b, model.beta, model.loads);
  reduce_state(scene, b, facts.modes, model, physical, facts);
  facts.stiffness_terms = stiffness_terms(model.stiffness, b);
  set_matrices(b, model);
  if (!scene.initial.saved) equilibrate_start(model);
  name_dofs(facts, b, model);
  facts.shapes = std::move(b.shapes);
  model.reduction = std::move(facts);
}

}  // namespace signorini::reduce
