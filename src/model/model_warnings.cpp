#include "model/model_warnings.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/eigen_dense.hpp"
#include "base/history/pieces.hpp"
#include "base/run_files.hpp"
#include "base/text.hpp"
#include "contact/friction.hpp"
#include "model/assembly/contacts.hpp"
#include "model/assembly/dofs.hpp"
#include "model/assembly/loads.hpp"
#include "model/assembly/motion_names.hpp"
#include "model/assembly/parts.hpp"
#include "model/assembly/springs.hpp"
#include "model/initial_state.hpp"
#include "model/massless.hpp"
#include "model/modes/constrained_structure.hpp"
#include "model/modes/stability.hpp"
#include "model/outputs/reactions.hpp"
#include "model/slip_growth.hpp"
#include "model/statics/mechanisms.hpp"
#include "model/statics/static_system.hpp"
#include "motion/point.hpp"

namespace signorini::model {
namespace {

constexpr double greatest_friction = 2.0;
constexpr double min_reported_change =
    0.01;  // a smaller relative change of a velocity during the run is not reported
constexpr double along =
    1e-9;  // smaller components of a motion along a normal, relative to the motion, are zero
constexpr std::size_t most_named = 3;

/// "contact 'a'", "contacts 'a' and 'b'", "contacts 'a', 'b', 'c' and 7 more"
std::string names(const Model& model, const std::vector<std::size_t>& contacts) {
  std::vector<std::string> list;
  for (const std::size_t k : contacts) list.push_back(model.contacts[k].name);
  return (list.size() == 1 ? "contact " : "contacts ") + base::join_quoted(list, most_named);
}

/// True if a value of f between the starts of pieces `first` and `last` lies outside the range of the values just before and
/// just after. Times are measured from the start of a piece, because two starts may be rounded to the same time of the run.
bool has_value_outside_limits(const History& f, std::size_t first, std::size_t last) {
  const std::vector<double>& starts = f.starts();
  struct Known {
    double value, rounding;
  };
  const auto known = [&](std::size_t i, double t, double s) {
    Piece piece = f.pieces()[i];
    piece.origin -= t;
    return Known{piece.value(s), history::roundoff(piece, s)};
  };
  const Known before = known(first, starts[first], 0.0), after = known(last + 1, starts[last], 0.0);
  for (std::size_t i = first + 1; i <= last; ++i) {
    const double a = starts[i - 1], length = starts[i] - a;
    for (const double s : {0.0, 0.5 * length, length}) {
      const Known inside = known(i, a, s);
      const double unsure = before.rounding + after.rounding + inside.rounding;
      if (inside.value > std::max(before.value, after.value) + unsure ||
          inside.value < std::min(before.value, after.value) - unsure)
        return true;
    }
  }
  return false;
}

class ModelWarnings {
 public:
  ModelWarnings(const Scene& scene, const assembly::DofMap& map, const Model& model)
      : scene_(scene), map_(map), model_(model), weight_(assembly::static_load(model.loads, model.size())) {}

  std::vector<std::string> all() {
    warn_of_loads_without_effect();
    for (std::string& idle : unconnected_rotations(scene_, map_)) found_.push_back(std::move(idle));
    falls();
    warn_of_sudden_weight();
    drag();
    friction();
    shear();
    warn_of_other_structure();
    pulses();
    warn_of_sudden_supports();
    warn_of_sudden_heat();
    growth();
    for (std::string& doubt : outputs::hanger_warnings(scene_, model_)) found_.push_back(std::move(doubt));
    warn_of_instability();
    for (std::string& unused : unused_values(scene_, map_, model_)) found_.push_back(std::move(unused));
    return std::move(found_);
  }

 private:
  void warn_of_loads_without_effect() {
    if (scene_.run.geometric)
      return;  // loads on fixed degrees of freedom may still compress members and bodies
    for (const Load& load : model_.loads) {
      if (load.kind == LoadKind::weight || load.kind == LoadKind::base || load.kind == LoadKind::support ||
          load.kind == LoadKind::support_rate)
        continue;
      const auto& terms = load.direction.terms;
      const bool idle =
          std::all_of(terms.begin(), terms.end(), [](const auto& t) { return t.second == 0.0; });
      if (idle && history::magnitude(load.history, scene_.run.t_end) > 0.0)
        found_.push_back(load.name +
                         " acts only along directions that supports or rigid bodies fix: it moves nothing");
    }
  }

  /// Warns of parts that the static loads move away from all contacts. Parts with sliders are skipped, because friction
  /// may hold such a part.
  void falls() {
    if (weight_.isZero(0.0)) return;
    const assembly::Parts parts({&model_.mass, &model_.stiffness});
    std::vector<std::vector<std::size_t>> supports(parts.count());
    std::vector<bool> gripped(parts.count(), false);
    for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
      const Contact& c = model_.contacts[k];
      for (const auto& term : c.normal.terms.empty() ? c.tangent.terms : c.normal.terms) {
        const std::size_t part = parts.part_of(term.first);
        if (c.normal_force_given()) gripped[part] = true;
        if (!c.normal_force_given() && (supports[part].empty() || supports[part].back() != k))
          supports[part].push_back(k);
      }
    }
    std::size_t number = 0;
    for (const assembly::Part& part : parts) {
      const std::vector<std::size_t>& own = supports[number];
      if (!own.empty() && !gripped[number] && moves_away(part, own))
        falling_.insert(falling_.end(), own.begin(), own.end());
      ++number;
    }
    if (falling_.empty()) return;
    found_.push_back(
        fmt::format("the static loads accelerate the structure away from {}, along the normal, and no "
                    "contact stops this motion; check whether the normal is reversed",
                    names(model_, falling_)));
  }

  [[nodiscard]] bool moves_away(const assembly::Part& part, const std::vector<std::size_t>& contacts) const {
    const Eigen::MatrixXd z = statics::null_motions(part.matrix(model_.stiffness));
    if (z.cols() == 0) return false;
    const SparseMatrix mass = part.matrix(model_.mass);
    const Vector force = z.transpose() * Vector(weight_(part.dofs()));
    Vector fall = Vector::Zero(model_.size());
    fall(part.dofs()) = z * base::solve_dense(z.transpose() * (mass * z), force);
    const double size = fall.cwiseAbs().maxCoeff();
    bool away = false;
    for (const std::size_t k : contacts) {
      const double rate = model_.contacts[k].normal.dot(fall);
      if (!(rate >= -along * size)) return false;
      away = away || rate > along * size;
    }
    return away;
  }

  void warn_of_sudden_weight() {
    if (model_.static_start || weight_.isZero(0.0) || !model_.u0.isZero(0.0)) return;
    if (scene_.gravity[0] == 0.0 && scene_.gravity[1] == 0.0) return;
    std::vector<std::size_t> touching;
    for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
      const Contact& c = model_.contacts[k];
      if (c.normal_force_given() || c.gap != 0.0 || c.normal.dot(model_.v0) > 0.0) continue;
      // A rigid contact on a rigid body carries the weight from t = 0 on, without oscillation.
      const bool gives = !c.takes_impulses() ||
                         std::any_of(c.normal.terms.begin(), c.normal.terms.end(), [&](const auto& term) {
                           return model_.stiffness.coeff(term.first, term.first) != 0.0;
                         });
      if (gives && std::find(falling_.begin(), falling_.end(), k) == falling_.end()) touching.push_back(k);
    }
    if (touching.empty()) return;
    found_.push_back(
        fmt::format("the weight acts suddenly at t = 0 on {} with zero gap and zero force: the structure "
                    "will oscillate, with up to twice the static force; initial = \"static\" starts in "
                    "equilibrium",
                    names(model_, touching)));
  }

  void drag() {
    if (!(model_.alpha * scene_.run.t_end > min_reported_change)) return;
    std::vector<bool> closed(model_.contacts.size(), true);
    const statics::StaticProblem problem{model_.stiffness, weight_, model_.contacts, map_};
    const Eigen::MatrixXd free = statics::null_motions(problem.matrix(closed));
    if (free.cols() == 0 || (model_.mass * free).isZero(0.0)) return;
    found_.push_back(
        fmt::format("mass-proportional damping (alpha = {:.4g} 1/{}) also damps rigid-body motions: sliding "
                    "and flying parts lose their velocity with the time constant 1/alpha = {:.4g} {}; "
                    "stiffness-proportional damping (beta) and dampers do not damp these motions",
                    model_.alpha / model_.unit.time, model_.units.time, model_.unit.time / model_.alpha,
                    model_.units.time));
  }

  void friction() {
    std::vector<std::size_t> high;
    double greatest = 0.0;
    for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
      const Friction& law = model_.contacts[k].friction;
      const double f = std::max(law.static_, law.kinetic);
      if (f > greatest_friction) high.push_back(k);
      greatest = std::max(greatest, f);
    }
    if (high.empty()) return;
    found_.push_back(
        fmt::format("friction {:.6g} at {}: coefficients above 2 are unusual; check whether the value is an "
                    "angle or a percentage",
                    greatest, names(model_, high)));
  }

  /// Warns of pulses of loads that are shorter than the time resolution of doubles, and therefore have no effect.
  void pulses() {
    for (const Load& load : model_.loads) {
      const std::vector<double>& starts = load.history.starts();
      for (std::size_t first = 0, next = 0; first < starts.size(); first = next) {
        next = history::end_of_instant(load.history, first, scene_.run.t_end);
        const double a = starts[first], b = starts[next - 1],
                     least = motion::resolution_at(a, scene_.run.t_end);
        if (!(a >= 0.0 && b < scene_.run.t_end && has_value_outside_limits(load.history, first, next - 1)))
          continue;
        found_.push_back(fmt::format(
            "'{}' has a pulse at {:.9g} that lasts {:.3g}, less than the {:.3g} that double precision "
            "resolves at this time: its impulse is lost; make the pulse longer",
            load.name, a * model_.unit.time, (b - a) * model_.unit.time, least * model_.unit.time));
      }
    }
  }

  /// Warns of supports that jump at t = 0: the initial state is the one after the jump, and no impulse acts.
  void warn_of_sudden_supports() {
    for (const Load& load : model_.loads) {
      if (load.kind != LoadKind::support || scene_.initial.saved) continue;
      const History f = history::resolved(load.history, scene_.run.t_end);
      const Piece &before = f.piece_before(0.0), &after = f.piece(0.0);
      for (const int order : {0, 1}) {
        const double a = before.value(0.0, order), b = after.value(0.0, order);
        const double rounded =
            order == 0 ? history::roundoff(before, 0.0) + history::roundoff(after, 0.0)
                       : history::roundoff_of_rate(before, 0.0) + history::roundoff_of_rate(after, 0.0);
        if (std::abs(b - a) <= rounded) continue;
        found_.push_back(
            fmt::format("the {} of '{}' jumps at t = 0: the run starts just after the jump, without an "
                        "impulse; a jump at a later time is an error",
                        order == 0 ? "motion" : "velocity", load.name));
        break;
      }
    }
  }

  /// Warns of temperatures that act suddenly at t = 0. A static start omits loads whose history is not constant, but a nonzero
  /// temperature at t = 0 was probably meant to be part of the start.
  void warn_of_sudden_heat() {
    if (scene_.initial.saved || !scene_.initial.stages.empty()) return;
    if (!scene_.initial.is_static && !scene_.initial.is_frictional) return;
    for (const Load& load : model_.loads) {
      if (load.kind != LoadKind::temperature || load.history.is_constant() || load.history.value(0.0) == 0.0)
        continue;
      found_.push_back(
          fmt::format("{} acts suddenly at t = 0, because its history is not constant: the static start "
                      "omits it, and the structure will oscillate. With initial = \"frictional\" a stage in "
                      "[[run.stages]] with loads = [\"temperature\"] starts in equilibrium with it",
                      load.name));
    }
  }

  void warn_of_other_structure() {
    if (!scene_.initial.saved) return;
    const std::string& run = scene_.initial.saved->run;
    if (const std::string why = run.empty() ? "" : base::unchecked_reason(run); !why.empty())
      found_.push_back("this run continues from a saved run: " + why);
    if (scene_.initial.saved->structure_differences.empty()) return;
    found_.push_back(fmt::format(
        "this run continues from a run in {} whose scene has other {}: its displacements, velocities and "
        "shears are used unchanged",
        scene_.initial.saved->run, base::join_texts(scene_.initial.saved->structure_differences)));
  }

  void shear() {
    if (!model_.static_start || model_.statics.frictional) return;
    std::vector<std::size_t> loose;
    for (std::size_t k = 0; k < model_.contacts.size(); ++k)
      if (model_.contacts[k].initial_shear != 0.0) loose.push_back(k);
    if (loose.empty()) return;
    found_.push_back(fmt::format(
        "initial_shear at {} is not in equilibrium with the displacements: a static start has no friction, "
        "so the shear vanishes with the first oscillation; give displacements that balance the shear",
        names(model_, loose)));
  }

  void growth() {
    if (!model_.statics.frictional || model_.statics.stages.empty()) return;
    const auto found = slip_growth(model_, model_.statics.stages.back().states);
    if (!found || !(found->rate * scene_.run.t_end > min_reported_change)) return;
    const double rate = found->rate / model_.unit.time;
    if (found->omega == 0.0)
      throw SceneError(scene_.initial.place, "run.initial",
                       fmt::format("no frictional start: with {} slipping at the limit a motion grows like "
                                   "exp({:.4g} t), so this equilibrium cannot be reached",
                                   names(model_, found->contacts), rate));
    found_.push_back(fmt::format(
        "if the slip of {} continues after the slow start, an oscillation of {:.4g} rad/{} grows like "
        "exp({:.4g} t) (flutter); damping may stop it",
        names(model_, found->contacts), found->omega / model_.unit.time, model_.units.time, rate));
  }

  /// Warns if run.geometric gives a motion negative energy while all contacts are open.
  void warn_of_instability() {
    if (!model_.geometric) return;
    const auto fastest = modes::fastest_growth(model_.stiffness, model_.mass);
    if (!fastest) return;
    const std::vector<double>& factors = model_.geometric->load_factors;
    const bool at_once = !factors.empty() && factors.front() >= 0.0 && factors.front() <= 1.0;
    found_.push_back(
        fmt::format("under its static forces (run.geometric) the structure is unstable {}: the {} grows like "
                    "exp({:.4g} t)",
                    model_.contacts.empty() ? "from the start"
                    : at_once               ? "from the start, and with all its contacts open"
                                            : "with all its contacts open",
                    assembly::describe_motion(fastest->motion, map_), fastest->rate / model_.unit.time));
  }

  const Scene& scene_;
  const assembly::DofMap& map_;
  const Model& model_;
  Vector weight_;
  std::vector<std::size_t> falling_;  // indices of contacts
  std::vector<std::string> found_;
};

}  // namespace

std::vector<std::string> model_warnings(const Scene& scene, const assembly::DofMap& map, const Model& model) {
  return ModelWarnings(scene, map, model).all();
}

namespace {

/// Loads that last longer than this fraction of 1/w have their full amplitude. Chosen value: scales are only orders of
/// magnitude.
constexpr double full_amplitude_duration = 1.0 / 16.0;

/// Value of w t_end for a free motion, that is a motion whose phase angle in the run is below 1 rad. Chosen value: a load that
/// acts for a thousandth of the run then has its full amplitude.
constexpr double free_phase = 64.0;

/// Effective amplitude divided by the full amplitude, for an oscillator of frequency omega.
double share_at(const History& f, double amplitude, double t_end, double omega) {
  return std::min(
      1.0, omega * history::max_impulse(f, t_end, 1.0 / omega) / (full_amplitude_duration * amplitude));
}

/// Computes the frequency of an oscillation along the static response to a load; 0 if the load has no static response.
class StaticResponseFrequencies {
 public:
  StaticResponseFrequencies(const Model& model, const modes::ContactConstraints& holding) : model_(model) {
    const SparseMatrix k = assembly::with_springs(model.stiffness, holding.springs);
    if (statics::null_motions(modes::with_constraint_springs(k, holding.fixed)).cols() == 0)
      structure_.emplace(k, holding.fixed);
  }
  [[nodiscard]] double along(const Vector& p) const {
    if (!structure_) return 0.0;
    const Vector u = structure_->solve(p);
    const double squared = u.dot(p) / u.dot(model_.mass * u);
    return std::isfinite(squared) && squared > 0.0 ? std::sqrt(squared) : 0.0;
  }

 private:
  const Model& model_;
  std::optional<modes::ConstrainedStructure> structure_;
};

}  // namespace

EffectiveAmplitudes effective_amplitudes(const Model& model, const modes::ContactConstraints& holding,
                                         double omega, double t_end) {
  std::optional<StaticResponseFrequencies> swings;
  const auto own = [&](double along) { return along * t_end > 1.0 ? along : free_phase / t_end; };
  // The effective share of a load increases with the frequency: if it is 1 at the lowest frequency, it is always 1.
  const double lowest = std::max(omega, 1.0 / t_end);
  const auto lasts = [&](const History& f, double amplitude) {
    return f.is_constant() || !(amplitude > 0.0) || share_at(f, amplitude, t_end, lowest) == 1.0;
  };
  EffectiveAmplitudes effective;
  for (const Load& load : model.loads) {
    EffectiveLoad& part = effective.loads.emplace_back();
    const double amplitude = history::magnitude(load.history, t_end);
    if (lasts(load.history, amplitude)) continue;
    if (!swings) swings.emplace(model, holding);
    const double along = swings->along(assembly::dense_vector(load.direction, model.size()));
    part.share = share_at(load.history, amplitude, t_end, own(along > 0.0 ? along : omega));
    if (part.share < 1.0) part.free_share = share_at(load.history, amplitude, t_end, 1.0 / t_end);
  }
  for (const Contact& contact : model.contacts) {
    double& share = effective.compressions.emplace_back(1.0);
    const double amplitude =
        contact.normal_force_given() ? history::magnitude(contact.normal_force, t_end) : 0.0;
    if (!lasts(contact.normal_force, amplitude))
      share = share_at(contact.normal_force, amplitude, t_end, own(omega));
  }
  return effective;
}

}  // namespace signorini::model
