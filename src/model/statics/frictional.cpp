#include "model/statics/frictional.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/lcp.hpp"
#include "base/text.hpp"
#include "linear/sparse_cholesky.hpp"
#include "model/assembly/dofs.hpp"
#include "model/assembly/motion_names.hpp"
#include "model/statics/mechanisms.hpp"
#include "model/statics/quasi_static_rates.hpp"
#include "model/statics/smallest_motion.hpp"
#include "model/statics/start_refinement.hpp"
#include "model/statics/static_system.hpp"

namespace signorini::statics {
namespace {

// Limit of the residual of an equilibrium, relative to the largest force or moment. Rounding errors of long paths are smaller.
constexpr double balanced = 1e-7;

/// Follows the equilibrium while the loads of the stages grow.
class LoadingPath {
 public:
  LoadingPath(const SparseMatrix& stiffness, const std::vector<Contact>& contacts,
              const assembly::DofMap& map, const SourcePlace& place)
      : stiffness_(stiffness),
        contacts_(contacts),
        map_(map),
        place_(place),
        u_(Vector::Zero(map.size())),
        load_(u_) {
    for (const Contact& c : contacts) standing_.push_back(undeformed(c));
  }

  FrictionalEquilibrium run(const std::vector<Stage>& stages) {
    fit();
    for (const Stage& stage : stages) {
      grow(stage);
      load_ += stage.load;
      check_equilibrium();
    }
    refine();
    return result();
  }

  FrictionalEquilibrium go_on(FrictionalEquilibrium from, const Stage& stage) {
    u_ = std::move(from.u);
    standing_ = std::move(from.margins);
    found_ = std::move(from.start);
    found_.reactions.clear();
    double size = 0.0;
    load_ = stage.load - unbalanced_forces(stiffness_, Vector::Zero(u_.size()), contacts_, forces(), size);
    grow(stage);
    refine();
    return result();
  }

 private:
  FrictionalEquilibrium result() {
    FrictionalEquilibrium result{u_, {}, std::move(found_), standing_};
    result.start.frictional = true;
    for (const LimitMargin& s : standing_) {
      result.start.reactions.push_back(std::max(0.0, -s.N));
      result.shears.push_back(s.T);
    }
    return result;
  }

  [[nodiscard]] StartForces forces() const {
    StartForces all{u_, {}, {}};
    for (const LimitMargin& s : standing_) {
      all.N.push_back(s.N);
      all.T.push_back(s.T);
    }
    return all;
  }

  /// Removes the rounding errors that the steps of the path have left.
  void refine() {
    std::vector<HeldContact> held;
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
      const LimitMargin& s = standing_[k];
      HeldContact& contact = held.emplace_back();
      if (is_open(s.state)) continue;
      contact.normal = HeldContact::Normal::closed;
      contact.slips = rubs(k) ? slip_sign(s.state) : 0;
      contact.friction = friction(k);
      contact.sticks = rubs(k) && contact.slips == 0;
    }
    StartForces now = forces();
    if (!refine_start(stiffness_, load_, contacts_, held, now)) return;
    u_ = std::move(now.u);
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
      LimitMargin& s = standing_[k];
      s.N = std::min(0.0, now.N[k]);
      s.T = now.T[k];
      if (!contacts_[k].normal_force_given()) s.gap = contacts_[k].gap_at(u_);
      if (found_.stages.empty()) continue;
      found_.stages.back().N[k] = s.N;
      found_.stages.back().T[k] = s.T;
    }
  }

  /// Applies the interference of contacts with a negative gap (compressed in the undeformed state) before all stages:
  /// their gaps grow from zero to the given values.
  void fit() {
    bool any = false;
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
      const Contact& c = contacts_[k];
      if (c.normal_force_given() || c.gap >= 0.0) continue;
      standing_[k].given_gap_rate = c.gap;
      any = true;
    }
    if (any) grow({"fit", Vector::Zero(u_.size()), 1});
    for (LimitMargin& s : standing_) s.given_gap_rate = 0.0;
  }

  void grow(const Stage& stage) {
    stage_ = &stage;
    part_ = 0.0;
    for (int step = 1; step <= stage.steps; ++step) {
      const double end = static_cast<double>(step) / stage.steps;
      const std::size_t most = found_.events.size() + 1000 + 100 * contacts_.size();
      int idle = 0;
      while (part_ < end) {
        find_rates();
        const double before = part_;
        advance(end);
        idle = part_ > before ? 0 : idle + 1;
        if (found_.events.size() > most || idle > 20 + 4 * static_cast<int>(contacts_.size()))
          refuse_stage("the states of the contacts change without end");
      }
      StageEnd result{stage.name, end, {}, {}, {}};
      for (const LimitMargin& s : standing_) {
        result.states.push_back(s.state);
        result.N.push_back(s.N);
        result.T.push_back(s.T);
      }
      found_.stages.push_back(std::move(result));
    }
  }

  [[noreturn]] void refuse_stage(const std::string& why) const {
    throw SceneError(place_, "run.initial",
                     fmt::format("no frictional start: at load factor {:.4g} of stage '{}', {}", part_,
                                 stage_->name, why));
  }

  [[noreturn]] void refuse_motion(const ConstraintRows& held) const {
    const linear::SymmetricSolver solver(held.matrix());
    const Eigen::MatrixXd null = null_motions(held.matrix());
    if (solver.ok() && solver.negative_pivots() > 0 && null.cols() == 0)
      refuse_stage("the stiffness is indefinite, so the structure is unstable");
    const std::string name =
        null.cols() > 0 ? assembly::describe_motion(null.col(0), map_) : std::string("structure");
    refuse_stage(
        fmt::format("nothing restrains the {}, so the loading cannot continue in equilibrium", name));
  }

  /// Errors: SceneError if other contacts prevent the slip of a contact at its limit: its force would be undetermined.
  void refuse_shares(const std::vector<ConstraintRow>& rows, const std::vector<Unknown>& unknowns,
                     const std::vector<bool>& moves) const {
    std::vector<bool> slips(rows.size(), false);
    for (std::size_t j = 0; j < unknowns.size(); ++j)
      if (moves[j]) slips[static_cast<std::size_t>(unknowns[j].row)] = true;
    for (std::size_t j = 0; j < unknowns.size(); ++j) {
      const Unknown& unknown = unknowns[j];
      if (!moves[j] || unknown.kind != Unknown::Kind::slip) continue;
      if (is_also_constrained(rows, slips, static_cast<std::size_t>(unknown.row)))
        refuse_stage(fmt::format(
            "contact '{}' reaches its friction limit while other contacts restrain the same motion; a "
            "frictional start does not share friction between contacts. Give them a tangential_stiffness or "
            "law = \"compliant\", or start without the load and apply it during the run",
            contacts_[unknown.contact].name));
    }
  }

  /// Errors: SceneError for loads without equilibrium even with infinite friction. With z = 0 for all slips, the
  /// conditions of openings form a convex problem, for which Lemke's method fails only if there is no solution.
  void refuse_pulls(const std::vector<Unknown>& unknowns, const Eigen::MatrixXd& m,
                    const Eigen::VectorXd& q) const {
    std::vector<Eigen::Index> openings;
    std::vector<std::string> pulled;
    for (std::size_t j = 0; j < unknowns.size(); ++j) {
      if (unknowns[j].kind != Unknown::Kind::opening) continue;
      const auto row = static_cast<Eigen::Index>(j);
      openings.push_back(row);
      if (q[row] < -balanced) pulled.push_back(contacts_[unknowns[j].contact].name);
    }
    if (pulled.empty()) return;
    // The margin `balanced` keeps solver errors of zero forces from being taken as tensile.
    const Eigen::VectorXd pressed = q(openings).array() + balanced;
    if (base::solve_lcp(m(openings, openings), pressed)) return;
    refuse_stage(
        fmt::format("{} {} would have to pull even with infinite friction: the loads overturn or lift the "
                    "structure there; check the directions of gravity and of loads, and where the loads act",
                    pulled.size() == 1 ? "contact" : "contacts", base::join_quoted(pulled)));
  }

  /// Errors: SceneError unless K u + sum(N n + T t) = P up to rounding.
  void check_equilibrium() const {
    Vector rest = stiffness_ * u_ - load_, size = stiffness_.cwiseAbs() * u_.cwiseAbs() + load_.cwiseAbs();
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
      const LimitMargin& s = standing_[k];
      const auto bear = [&](const Combination& form, double force) {
        for (const auto& [dof, factor] : form.terms) {
          rest[dof] += factor * force;
          size[dof] += std::abs(factor * force);
        }
      };
      bear(contacts_[k].normal, s.N);
      bear(contacts_[k].body_tangent(), s.T);
    }
    double greatest[2] = {0.0, 0.0};  // forces and moments
    for (Eigen::Index i = 0; i < size.size(); ++i) {
      double& of = greatest[map_.dofs[static_cast<std::size_t>(i)].rotation ? 1 : 0];
      of = std::max(of, size[i]);
    }
    for (Eigen::Index i = 0; i < rest.size(); ++i) {
      const Dof& dof = map_.dofs[static_cast<std::size_t>(i)];
      if (!(std::abs(rest[i]) <= balanced * greatest[dof.rotation ? 1 : 0]))
        refuse_stage(
            fmt::format("no equilibrium was found: along {} the forces do not balance", dof.displacement));
    }
  }

  [[nodiscard]] bool rubs(std::size_t k) const { return contacts_[k].has_friction(); }
  [[nodiscard]] double friction(std::size_t k) const { return friction_of(contacts_[k], standing_[k]); }
  [[nodiscard]] double margin(std::size_t k, int s) const { return margin_of(contacts_[k], standing_[k], s); }
  [[nodiscard]] bool touches(std::size_t k, double zero) const {
    return touching(contacts_[k], standing_[k], zero, contacts_[k].normal.magnitude(u_));
  }

  /// Constraint rows of all contacts that are not open.
  std::vector<ConstraintRow> make_rows(double zero) {
    std::vector<ConstraintRow> rows;
    const auto add = [&](const Combination& form, std::optional<double> k) {
      rows.push_back({form, k ? *k : structural_stiffness(stiffness_, form), !k});
      return static_cast<int>(rows.size()) - 1;
    };
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
      const Contact& c = contacts_[k];
      LimitMargin& s = standing_[k];
      s.normal = s.tangent = -1;
      if (is_open(s.state) && !touches(k, zero)) continue;
      const bool given = c.normal_force_given();
      if (!given) s.normal = add(c.normal, c.normal_spring());
      if (rubs(k) && !(given && s.N == 0.0)) s.tangent = add(c.body_tangent(), c.tangent_spring());
    }
    return rows;
  }

  std::vector<Unknown> make_unknowns(double zero) const {
    std::vector<Unknown> unknowns;
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
      const LimitMargin& s = standing_[k];
      const bool touching = s.normal >= 0 && touches(k, zero);
      if (touching) unknowns.push_back({k, s.normal, 1, Unknown::Kind::opening});
      if (s.tangent < 0) continue;
      for (const int sign : {1, -1})
        if (touching || margin(k, sign) <= zero)
          unknowns.push_back({k, s.tangent, sign, Unknown::Kind::slip});
    }
    return unknowns;
  }

  /// Condition that is complementary to the unknown: -N' for an opening, -f N' - s T' for a slip.
  [[nodiscard]] double condition(const Unknown& unknown, const Vector& forces) const {
    const LimitMargin& s = standing_[unknown.contact];
    const double N = s.normal >= 0 ? forces[s.normal] : 0.0;
    if (unknown.kind == Unknown::Kind::opening) return -N;
    return -friction(unknown.contact) * N - unknown.sign * forces[s.tangent];
  }

  /// Threshold below which a force is zero. It is relative to the largest force so far, because after contacts open, all forces
  /// may be rounding errors of earlier forces.
  double zero() {
    for (const LimitMargin& s : standing_)
      largest_force_ = std::max({largest_force_, std::abs(s.N), std::abs(s.T)});
    return force_tolerance(largest_force_);
  }

  /// Computes the derivatives of all quantities by the load factor, and the contact states for which they are valid.
  void find_rates() {
    const double zero = this->zero();
    const std::vector<ConstraintRow> rows = make_rows(zero);
    const ConstraintRows held(stiffness_, rows);
    if (!held.regular()) refuse_motion(held);
    const std::vector<Unknown> unknowns = make_unknowns(zero);
    Vector r = Vector::Zero(static_cast<Eigen::Index>(rows.size()));
    for (const LimitMargin& s : standing_)
      if (s.normal >= 0) r[s.normal] = -s.given_gap_rate;
    auto [rates, forces] = held.solve(stage_->load, r);
    const auto n = static_cast<Eigen::Index>(unknowns.size());
    if (n > 0) {
      Eigen::MatrixXd m(n, n);
      Eigen::VectorXd q(n);
      std::vector<std::pair<Vector, Vector>> answers;
      std::vector<bool> loose(rows.size(), false);
      for (const Unknown& unknown : unknowns) loose[static_cast<std::size_t>(unknown.row)] = true;
      const Mechanisms motions(stiffness_, rows, loose);
      for (Eigen::Index j = 0; j < n; ++j) {
        const Unknown& unknown = unknowns[static_cast<std::size_t>(j)];
        const auto row = static_cast<std::size_t>(unknown.row);
        // Scaled to forces, so that all unknowns and conditions have the same unit.
        answers.push_back(motions.response(held, row, unknown.sign / rows[row].stiffness));
        q[j] = condition(unknown, forces);
        for (Eigen::Index i = 0; i < n; ++i)
          m(i, j) = condition(unknowns[static_cast<std::size_t>(i)], answers.back().second);
      }
      const double size = std::max(q.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
      const auto found = quasi_static_rates(m, q / size, unknowns);
      if (!found) {
        refuse_pulls(unknowns, m, q / size);
        refuse_shares(rows, unknowns, std::vector<bool>(unknowns.size(), true));
        refuse_stage(
            names_of_unknowns(unknowns) +
            " can neither stick nor slip in equilibrium: the friction there is too small for the load");
      }
      for (Eigen::Index j = 0; j < n; ++j) {
        rates += found->z[j] * size * answers[static_cast<std::size_t>(j)].first;
        forces += found->z[j] * size * answers[static_cast<std::size_t>(j)].second;
      }
      std::vector<double> conditions;
      for (const Unknown& unknown : unknowns) conditions.push_back(condition(unknown, forces));
      const SmallestSlips shared = smallest_slips(
          {stiffness_, map_, rows, unknowns, conditions, found->z * size, forces.cwiseAbs().maxCoeff()},
          rates);
      if (!shared.undetermined.empty()) doubt(shared);
      if (found->ambiguous)
        doubt(
            fmt::format("at load factor {:.4g} of stage '{}', {} may continue in several ways that all "
                        "satisfy the contact laws; the start takes the smallest slips and openings",
                        part_, stage_->name, names_of_unknowns(unknowns)));
      refuse_shares(rows, unknowns, shared.moves);
      take_states(unknowns, shared.moves);
    }
    u_rate_ = std::move(rates);
    take_rates(forces);
  }

  void doubt(const SmallestSlips& shared) {
    std::vector<std::string> names;
    for (const std::size_t k : shared.undetermined) names.push_back(contacts_[k].name);
    const std::string sentence = fmt::format(
        "stage '{}': nothing resists the {} while {} at the friction limit, so the data do not determine how "
        "far {}; the start takes the smallest slips",
        stage_->name, assembly::describe_motion(shared.motion, map_),
        base::join_quoted(names) + (names.size() == 1 ? " is" : " are"),
        names.size() == 1 ? "this contact slips" : "each of these contacts slips");
    doubt(sentence);
  }
  void doubt(const std::string& sentence) {
    if (std::find(found_.undetermined.begin(), found_.undetermined.end(), sentence) ==
        found_.undetermined.end())
      found_.undetermined.push_back(sentence);
  }

  [[nodiscard]] std::string names_of_unknowns(const std::vector<Unknown>& unknowns) const {
    std::string names;
    std::size_t last = contacts_.size(), count = 0;
    for (const Unknown& unknown : unknowns) {
      if (unknown.contact == last) continue;
      last = unknown.contact;
      if (++count <= 4) names += fmt::format("{}'{}'", count == 1 ? "" : ", ", contacts_[last].name);
    }
    return fmt::format("{} {}{}", count == 1 ? "contact" : "contacts", names, count > 4 ? " and more" : "");
  }

  void take_states(const std::vector<Unknown>& unknowns, const std::vector<bool>& moves) {
    std::vector<State> next;
    for (const LimitMargin& s : standing_)
      next.push_back(slip_sign(s.state) != 0 && s.tangent >= 0 ? State::stick : s.state);
    for (const Unknown& unknown : unknowns)  // a contact that touches is closed, unless it opens
      if (unknown.kind == Unknown::Kind::opening)
        next[unknown.contact] = rubs(unknown.contact) ? State::stick : State::closed;
    for (std::size_t j = 0; j < unknowns.size(); ++j) {
      if (!moves[j]) continue;
      State& state = next[unknowns[j].contact];
      if (unknowns[j].kind == Unknown::Kind::opening)
        state = State::open;
      else if (state != State::open)
        state = unknowns[j].sign > 0 ? State::slip_plus : State::slip_minus;
    }
    for (std::size_t k = 0; k < next.size(); ++k) change(k, next[k]);
  }

  void change(std::size_t k, State to) {
    LimitMargin& s = standing_[k];
    if (s.state == to) return;
    const Friction& f = contacts_[k].friction;
    if (slip_sign(to) != 0 && slip_sign(s.state) == 0 && f.kinetic < f.static_)
      refuse_stage(
          fmt::format("contact '{}' begins to slip, and its friction drops from static to kinetic, so the "
                      "loading cannot continue in equilibrium",
                      contacts_[k].name));
    // A contact that touches without force at the very beginning has no previous state, so there is no event.
    const bool begins = part_ == 0.0 && s.N == 0.0 && s.T == 0.0;
    if (!begins) found_.events.push_back({stage_->name, part_, static_cast<int>(k), s.state, to});
    s.state = to;
    if (to == State::open) s.N = s.T = 0.0;
  }

  void take_rates(const Vector& forces) {
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
      const Contact& c = contacts_[k];
      LimitMargin& s = standing_[k];
      const bool open = is_open(s.state);
      s.gap_rate = c.normal_force_given() ? 0.0 : c.normal.dot(u_rate_) + s.given_gap_rate;
      s.N_rate = s.normal >= 0 && !open ? forces[s.normal] : 0.0;
      s.T_rate = s.tangent >= 0 && !open ? forces[s.tangent] : 0.0;
      // In slip the shear stays exactly at its limit.
      if (const int sign = slip_sign(s.state); sign != 0) s.T_rate = -sign * friction(k) * s.N_rate;
    }
  }

  /// Advances to the end of the step or to the next change of a state.
  void advance(double end) {
    double step = end - part_;
    const double zero = this->zero();
    const auto fall = [&](double value, double rate, bool there) {
      if (rate < 0.0 && !there) step = std::min(step, std::max(0.0, -value / rate));
    };
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
      const LimitMargin& s = standing_[k];
      const bool touching = touches(k, zero);
      if (!contacts_[k].normal_force_given()) {
        if (is_open(s.state)) fall(s.gap, s.gap_rate, touching);
        if (!is_open(s.state)) fall(-s.N, -s.N_rate, touching);
      }
      if (s.state != State::stick || touching) continue;
      for (const int sign : {1, -1})
        fall(margin(k, sign), -friction(k) * s.N_rate - sign * s.T_rate, margin(k, sign) <= zero);
    }
    part_ = step >= end - part_ ? end : part_ + step;
    u_ += step * u_rate_;
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
      LimitMargin& s = standing_[k];
      s.gap += step * s.gap_rate;
      s.N += step * s.N_rate;
      s.T += step * s.T_rate;
      if (const int sign = slip_sign(s.state); sign != 0) s.T = sign * friction(k) * std::abs(s.N);
    }
  }

  const SparseMatrix& stiffness_;
  const std::vector<Contact>& contacts_;
  const assembly::DofMap& map_;
  const SourcePlace& place_;
  Vector u_, u_rate_, load_;  // load_: loads of all previous stages
  std::vector<LimitMargin> standing_;
  StaticStart found_;
  const Stage* stage_ = nullptr;
  double part_ = 0.0;           // load factor of the stage, 0 to 1
  double largest_force_ = 0.0;  // largest force of a contact so far
};

}  // namespace

FrictionalEquilibrium frictional_equilibrium(const SparseMatrix& stiffness,
                                             const std::vector<Contact>& contacts,
                                             const std::vector<Stage>& stages, const assembly::DofMap& map,
                                             const SourcePlace& place) {
  return LoadingPath(stiffness, contacts, map, place).run(stages);
}

FrictionalEquilibrium continue_loading(FrictionalEquilibrium from, const SparseMatrix& stiffness,
                                       const std::vector<Contact>& contacts, const Stage& stage,
                                       const assembly::DofMap& map, const SourcePlace& place) {
  return LoadingPath(stiffness, contacts, map, place).go_on(std::move(from), stage);
}

}  // namespace signorini::statics
