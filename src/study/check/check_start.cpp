// The start of the run, or the reason why it cannot start.

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "base/eigen_dense.hpp"
#include "base/text.hpp"
#include "decide/derivative_levels.hpp"
#include "model/assembly/parts.hpp"
#include "model/assembly/springs.hpp"
#include "run/cost_estimate.hpp"
#include "signorini/simulate.hpp"
#include "study/check/check.hpp"
#include "study/prepared_run.hpp"

namespace signorini::checks {
namespace {

/// Stores the contacts at t = 0 and stops the run after its first step.
class FirstStep : public Recorder {
 public:
  void event(const Event& /*event*/) override {}
  void sample(const Sample& sample) override {
    if (contacts.empty() && sample.t == 0.0) contacts = sample.contacts;
  }
  bool progress(double /*t*/) override { return false; }

  std::vector<ContactSample> contacts;
};

/// The tangent's entries at degrees of freedom with mass, and zeros elsewhere: a rigid constraint acts
/// immediately only on masses.
Vector heavy_part(const Model& model, const Combination& tangent) {
  Vector t = assembly::dense_vector(tangent, model.size());
  for (int i = 0; i < model.size(); ++i)
    if (model.dofs[static_cast<std::size_t>(i)].massless) t[i] = 0.0;
  return t;
}

/// True if the surface does not move and all degrees of freedom of the tangent have mass. If several such
/// contacts constrain the same motion, they share the force (linear/redundant_rows.hpp).
bool may_share(const Model& model, const Contact& contact) {
  return contact.surface_motion.is_constant() &&
         std::none_of(contact.tangent.terms.begin(), contact.tangent.terms.end(), [&](const auto& term) {
           return model.dofs[static_cast<std::size_t>(term.first)].massless;
         });
}

/// Ambiguity among contacts whose tangents act on common degrees of freedom; nullopt if there is none.
std::optional<Ambiguity> ambiguity_among(const Model& model, const std::vector<std::size_t>& contacts) {
  std::vector<std::string> names;  // names of the columns of `held`
  std::vector<bool> shares;        // true: the contact may share its force
  Eigen::MatrixXd held(model.size(), 0);
  for (const std::size_t k : contacts) {
    const Contact& c = model.contacts[k];
    const Vector t = heavy_part(model, c.tangent);
    if (std::string why = decide::massless_stick_error(model, c); !why.empty())
      return Ambiguity{k, std::move(why)};
    bool share = may_share(model, c);
    if (held.cols() > 0) {
      const Eigen::MatrixXd x = base::solve_dense(held.transpose() * held, held.transpose() * t);
      if ((t - held * x).norm() <= 1e-12 * t.norm()) {
        std::vector<std::string> group;
        for (Eigen::Index j = 0; j < held.cols(); ++j) {
          if (!(std::abs(x(j, 0)) * held.col(j).norm() > 1e-9 * t.norm())) continue;
          group.push_back(names[static_cast<std::size_t>(j)]);
          share = share && shares[static_cast<std::size_t>(j)];
        }
        if (share) continue;
        group.push_back(c.name);
        return Ambiguity{k,
                         fmt::format("contacts {} restrain the same motion when they stick rigidly, so their "
                                     "friction forces are not unique; give them a tangential_stiffness",
                                     base::join_quoted(group))};
      }
    }
    held.conservativeResize(Eigen::NoChange, held.cols() + 1);
    held.rightCols(1) = t;
    names.push_back(c.name);
    shares.push_back(may_share(model, c));
  }
  return std::nullopt;
}

}  // namespace

std::optional<Ambiguity> ambiguous_contacts(const Model& model) {
  std::vector<std::size_t> contacts;
  std::vector<Combination> tangents;
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& c = model.contacts[k];
    if (!c.constrains_tangent_only()) continue;
    contacts.push_back(k);
    tangents.push_back(c.tangent);
  }
  for (const std::vector<std::size_t>& group : assembly::coupled_forms(tangents)) {
    std::vector<std::size_t> members;
    for (const std::size_t i : group) members.push_back(contacts[i]);
    if (auto found = ambiguity_among(model, members)) return found;
  }
  return std::nullopt;
}

Start start(const Scene& scene, const Model& model) {
  FirstStep recorder;
  Report report = simulate(model, study::without_rows(scene.run), recorder);
  if (report.outcome.kind == Outcome::Kind::stopped) {
    const std::string reason =
        fmt::format("the run cannot start at t = {:g}: {}", report.outcome.t, report.outcome.reason);
    if (const auto found = ambiguous_contacts(model)) {
      const ContactSpec& contact = scene.contacts[found->contact];
      const bool included = reason.find(found->reason) != std::string::npos;
      throw SceneError(contact.place, "contacts." + contact.name,
                       included ? reason : reason + ": " + found->reason);
    }
    const std::vector<std::size_t>& named = report.outcome.refusal.contacts;
    if (!named.empty()) {
      const ContactSpec& contact = scene.contacts[named.front()];
      throw SceneError(contact.place, "contacts." + contact.name, reason);
    }
    throw SceneError(scene.initial.place.line > 0 ? scene.initial.place : scene.run.place, "run", reason);
  }
  return {std::move(recorder.contacts), std::move(report.method), std::move(report.warnings)};
}

// Discontinuities of the forcing, and estimated cost of the time loop.

namespace {

/// True if the slope jumps at a breakpoint, beyond rounding.
bool slope_jumps(const History& history, double t) {
  const double before = history.piece_before(t).value(t, 1), after = history.piece(t).value(t, 1);
  return std::abs(after - before) > 1e-12 * (std::abs(before) + std::abs(after));
}

}  // namespace

std::vector<check::Discontinuity> discontinuities(const Model& model, double t_end) {
  std::vector<check::Discontinuity> result;
  const auto add = [&](const History& history, bool integral, const std::string& what) {
    for (const Breakpoint& b : history.breakpoints())
      if (b.time >= 0.0 && b.time <= t_end)
        result.push_back({b.time, integral ? slope_jumps(history, b.time) : b.jump, what});
  };
  for (const Load& load : model.loads) add(load.history, false, load.name);
  for (const Contact& c : model.contacts) {
    add(c.normal_force, false, "normal_force of contact '" + c.name + "'");
    add(c.surface_motion, true, "surface_velocity of contact '" + c.name + "'");
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const check::Discontinuity& a, const check::Discontinuity& b) { return a.t < b.t; });
  return result;
}

check::Cost cost_of(const Model& model, const RunSpec& run, const Method& method) {
  RunSpec chosen = run;
  chosen.engine = method.engine;
  const run::ExpectedCost found = run::expected_cost(model, run, method);
  return {found.unknowns, found.omega_max, found.estimate, run::seconds_with_exact(model, chosen), {}};
}

}  // namespace signorini::checks

namespace signorini::check {

void measure_cost(const Scene& scene, const Model& model, std::vector<double> cutoffs, CheckReport& report) {
  constexpr double patience = 0.5, long_run = 2.0;  // s: time per trial; duration of a long run
  const Engine own = report.method.engine;
  report.cost.trials = run::trials(scene, model, own, cutoffs, patience);
  if (!cutoffs.empty() || scene.reduction || report.stuck.modes.empty()) return;
  const auto found = std::find_if(report.cost.trials.begin(), report.cost.trials.end(),
                                  [&](const run::Trial& trial) { return trial.engine == own; });
  const double cutoff = run::cutoff_to_try(report.stuck.modes.front().omega, report.cost.omega_max);
  if (cutoff > 0.0 && found != report.cost.trials.end() && found->seconds > long_run)
    report.cost.trials = run::trials(scene, model, own, {cutoff}, patience);
}

}  // namespace signorini::check
