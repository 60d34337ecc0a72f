#include "decide/levels.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/eigen_dense.hpp"

namespace signorini {
namespace {

using Kind = CoulombItem::Kind;

constexpr std::size_t most_compared = 4;   // contacts up to which all solutions are looked for
constexpr double noise_of_solution = 2.0;  // over that which its right side passes on

int sign_of(double x) { return x > 0.0 ? 1 : -1; }

/// The normal of what is at its limit is a row in force already: what an elimination leaves of it is zero.
void hold_normals(CoulombProblem& p) {
  for (std::size_t i = 0; i < p.items.size(); ++i) {
    if (p.items[i].kind != Kind::limit) continue;
    const auto n = static_cast<Eigen::Index>(2 * i);
    p.W.row(n).setZero();
    p.W.col(n).setZero();
    p.b[n] = 0.0;
  }
}

/// What noise in b makes of forces and responses, with the solution's own contacts in force.
struct Noise {
  Eigen::VectorXd force, response;
};

Noise pass_on(const CoulombProblem& p, const CoulombSolution& s, const Eigen::VectorXd& noise) {
  const Eigen::Index n = noise.size();
  // Columns: forces that answer to a response of zero; a slipping contact's k goes with its l.
  std::vector<Eigen::Index> rows;
  Eigen::MatrixXd columns(n, 0);
  const auto answer = [&](Eigen::Index row, const Eigen::VectorXd& column) {
    rows.push_back(row);
    columns.conservativeResize(Eigen::NoChange, columns.cols() + 1);
    columns.rightCols(1) = column;
  };
  for (std::size_t i = 0; i < p.items.size(); ++i) {
    const CoulombItem& item = p.items[i];
    const auto row = static_cast<Eigen::Index>(2 * i);
    const double l = s.force[row], k = s.force[row + 1];
    const double f = s.kinetic[i] ? item.kinetic_friction : item.static_friction;
    const bool presses = item.kind != Kind::pressed && item.kind != Kind::limit && l > 0.0;
    const bool sticks = item.kind == Kind::limit     ? k != 0.0
                        : item.kind == Kind::pressed ? std::abs(k) < f * item.pressing
                                                     : item.kind == Kind::frictional && std::abs(k) < f * l;
    if (presses) answer(row, p.W.col(row) + (sticks ? 0.0 : k / l) * p.W.col(row + 1));
    if (sticks) answer(row + 1, p.W.col(row + 1));
  }
  // The problem is solved to the rounding of its greatest entry, in units that make the diagonal of W one.
  double greatest = 0.0;
  for (Eigen::Index i = 0; i < n; ++i)
    if (p.W(i, i) > 0.0) greatest = std::max(greatest, std::abs(p.b[i]) / std::sqrt(p.W(i, i)));
  const double rounding = 64.0 * std::numeric_limits<double>::epsilon() * greatest;
  // At least what a contact alone would make of it.
  Noise result{Eigen::VectorXd::Zero(n), noise};
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!(p.W(i, i) > 0.0)) continue;
    const double unit = std::sqrt(p.W(i, i));
    result.response[i] += rounding * unit;
    result.force[i] = noise[i] / p.W(i, i) + rounding / unit;
  }
  if (rows.empty()) return result;
  const Eigen::MatrixXd inverse = pseudo_inverse(columns(rows, Eigen::all));
  const Eigen::VectorXd forces = inverse.cwiseAbs() * noise(rows);
  for (std::size_t i = 0; i < rows.size(); ++i)
    result.force[rows[i]] = std::max(result.force[rows[i]], forces[static_cast<Eigen::Index>(i)]);
  result.response += columns.cwiseAbs() * forces;
  return result;
}

/// What a solution says within its noise.
struct Reading {
  const CoulombProblem& problem;
  const CoulombSolution& solution;
  Noise passed;
  std::size_t order;

  [[nodiscard]] bool is_zero_response(Eigen::Index i) const {
    return std::abs(solution.response[i]) <= noise_of_solution * passed.response[i];
  }
  [[nodiscard]] double zero_force(Eigen::Index i) const { return noise_of_solution * passed.force[i]; }
};

enum class Verdict : unsigned char { open, limit, decided };  // open: an open question

void start_slip(int sign, std::size_t order, ContactState& state, KnownGuards& guards) {
  state.state = slip_along(sign);
  guards.sliding = {order + 1, true};
}

/// A contact whose friction is at its limit: back into the cone, slip, or still undecided.
Verdict leave_limit(const Reading& r, std::size_t i, ContactState& state, KnownGuards& guards) {
  const int sign = r.problem.items[i].sign;
  const auto t = static_cast<Eigen::Index>(2 * i) + 1;
  if (sign * r.solution.force[t] > r.zero_force(t)) {
    state.state = State::stick;
    (sign > 0 ? guards.slip_plus : guards.slip_minus) = {r.order, true};
    return Verdict::decided;
  }
  if (r.is_zero_response(t)) return Verdict::open;
  start_slip(sign, r.order, state, guards);
  return Verdict::decided;
}

/// Friction of a contact that presses and has not slipped before. Inside its cone it answers to rest,
/// whatever rounding has left of that.
Verdict settle_friction(const Reading& r, std::size_t i, Participant& who, ContactState& state,
                        KnownGuards& guards) {
  const CoulombItem& item = r.problem.items[i];
  const auto n = static_cast<Eigen::Index>(2 * i), t = n + 1;
  const double l = item.kind == Kind::pressed ? item.pressing : r.solution.force[n];
  const double k = r.solution.force[t];
  const double f = r.solution.kinetic[i] ? item.kinetic_friction : item.static_friction;
  state.state = State::stick;
  if (f * l - std::abs(k) > r.zero_force(t) + f * r.zero_force(n)) return Verdict::decided;
  if (!r.is_zero_response(t)) {
    start_slip(sign_of(r.solution.response[t]), r.order, state, guards);
    return Verdict::decided;
  }
  if (item.static_friction != item.kinetic_friction || std::abs(k) <= r.zero_force(t))
    return Verdict::decided;
  // At its limit: with one coefficient the next derivative decides; with two it sticks until the
  // guard of the static limit falls.
  who.sign = -sign_of(k);
  state.state = slip_along(who.sign);
  return Verdict::limit;
}

/// A force that is not zero answers to a response of zero, whatever rounding has left of that.
Verdict settle_contact(const Reading& r, std::size_t i, Participant& who, ContactState& state,
                       KnownGuards& guards) {
  const CoulombItem& item = r.problem.items[i];
  const auto n = static_cast<Eigen::Index>(2 * i), t = n + 1;
  if (item.kind != Kind::pressed && !(r.solution.force[n] > r.zero_force(n))) {
    if (!(r.solution.force[n] > 0.0) && !r.is_zero_response(n)) {
      guards.closing = {r.order + 2, true};
      return Verdict::decided;
    }
    if (item.kind == Kind::frictional && !r.is_zero_response(t)) {
      who.slipping = true;
      who.sign = sign_of(r.solution.response[t]);
    }
    return Verdict::open;
  }
  if (item.kind != Kind::pressed) guards.separation = {r.order, true};
  if (item.kind == Kind::normal) {
    state.state = State::closed;
    return Verdict::decided;
  }
  if (item.kind == Kind::sliding) {
    state.state = slip_along(item.sign);
    return Verdict::decided;
  }
  return settle_friction(r, i, who, state, guards);
}

}  // namespace

Refusal dependent_rows(std::vector<std::size_t> contacts) {
  return {Refusal::Kind::dependent,
          "the rows of the contacts that stick are linearly dependent, so their forces are not unique",
          std::move(contacts)};
}

CoulombItem Levels::item_of(const Entry& entry, const Forcing& forcing, double t) const {
  const std::size_t c = entry.who.contact;
  const Contact& contact = model_.contacts[c];
  CoulombItem item;
  item.sign = entry.who.sign;
  item.kinetic_friction = entry.who.sliding_friction;
  item.static_friction = entry.who.kinetic ? item.kinetic_friction : contact.friction.static_;
  if (entry.standing == Standing::limit) {
    item.kind = Kind::limit;
  } else if (contact.is_pressed()) {
    item.kind = Kind::pressed;
    item.pressing = forcing.pressing(c, t, 0);
  } else if (!contact.has_friction()) {
    item.kind = Kind::normal;
  } else {
    item.kind = entry.who.slipping ? Kind::sliding : Kind::frictional;
  }
  return item;
}

Refusal Levels::refusal(const Level& level, bool several) const {
  const CoulombProblem& problem = level.problem;
  Refusal result{several ? Refusal::Kind::ambiguous : Refusal::Kind::paradox,
                 several
                     ? "several motions continue this one (Painleve's paradox: friction is so strong that "
                       "a contact may as well press as let go)"
                     : "no motion continues this one (Painleve's paradox: friction is so strong that "
                       "pressing a sliding contact pushes it into what it slides on)",
                 level.contacts, condition_of(problem)};
  for (std::size_t i = 0; i < level.contacts.size(); ++i) {
    const CoulombItem& item = problem.items[i];
    const auto n = static_cast<Eigen::Index>(2 * i);
    result.reason +=
        fmt::format("; '{}': without force g'' = {:.6g}, ut'' = {:.6g}; g'' for a unit of -N = {:.6g}",
                    model_.contacts[level.contacts[i]].name, problem.b[n], problem.b[n + 1], problem.W(n, n));
    if (item.kind == Kind::sliding)
      result.reason += fmt::format(", with friction {:.6g} while it slips ({})",
                                   problem.W(n, n) - item.sign * item.kinetic_friction * problem.W(n, n + 1),
                                   to_string(slip_along(item.sign)));
    else if (item.kind == Kind::frictional)
      result.reason += fmt::format(", for a unit of -T = {:.6g}, friction {:.6g}", problem.W(n, n + 1),
                                   item.static_friction);
  }
  return result;
}

/// The problem of one order for all that are undecided. False: their rows are dependent.
bool Levels::pose(const Instant& instant, const Forcing& forcing, std::size_t order,
                  const std::vector<Entry>& entries, const Mode& mode, Level& level) {
  level = {};
  for (std::size_t i = 0; i < entries.size(); ++i)
    if (entries[i].standing != Standing::decided) {
      level.entries.push_back(i);
      level.contacts.push_back(entries[i].who.contact);
    }
  level.order = order;
  if (level.entries.empty()) return true;
  const ModeSystemPtr system = systems_.of(mode);
  if (!system) return false;
  std::vector<MotionJet> jets;
  level.system = jets_.make(system, forcing, instant.t, instant.u, instant.v, jets).system;
  const auto size = static_cast<Eigen::Index>(2 * level.entries.size());
  level.problem.b = Eigen::VectorXd::Zero(size);
  level.noise.resize(size);
  for (std::size_t i = 0; i < level.entries.size(); ++i) {
    const MotionJet& jet = jets[level.contacts[i]];
    const ContactMotion &now = jet.motion[order], &zero = jet.noise[order];
    const bool last = order + 1 == MotionJet::orders;
    const double an = last ? 0.0 : jet.motion[order + 1].an, at = last ? 0.0 : jet.motion[order + 1].at;
    const auto n = static_cast<Eigen::Index>(2 * i);
    level.noise[n] = instant.blur * zero.an + instant.resolution * std::abs(an);
    level.noise[n + 1] = instant.blur * zero.at + instant.resolution * std::abs(at);
    if (std::abs(now.an) > level.noise[n]) level.problem.b[n] = now.an;
    if (std::abs(now.at) > level.noise[n + 1]) level.problem.b[n + 1] = now.at;
    level.problem.items.push_back(item_of(entries[level.entries[i]], forcing, instant.t));
  }
  return true;
}

/// Takes over what the solution decides. True: it decides somebody.
bool Levels::settle(const Level& level, const CoulombSolution& solution, std::vector<Entry>& entries,
                    Mode& mode, std::vector<KnownGuards>& known) const {
  const Reading reading{level.problem, solution, pass_on(level.problem, solution, level.noise), level.order};
  bool decides = false;
  for (std::size_t i = 0; i < level.entries.size(); ++i) {
    Entry& entry = entries[level.entries[i]];
    ContactState& state = mode[entry.who.contact];
    KnownGuards& guards = known[entry.who.contact];
    const Verdict verdict = level.problem.items[i].kind == Kind::limit
                                ? leave_limit(reading, i, state, guards)
                                : settle_contact(reading, i, entry.who, state, guards);
    if (verdict == Verdict::open) continue;
    entry.standing = verdict == Verdict::limit ? Standing::limit : Standing::decided;
    decides = true;
  }
  return decides;
}

Refusal Levels::decide(const Instant& instant, const Forcing& forcing,
                       const std::vector<Participant>& participants, const Mode& old, Mode& mode,
                       std::vector<KnownGuards>& known) {
  std::vector<Entry> entries;
  for (const Participant& who : participants) {
    entries.push_back({who});
    mode[who.contact] = {State::open, 0.0};
  }
  // An order is solved again as long as it decides somebody: with the great forces in force the small ones
  // stand out from the rounding.
  for (std::size_t order = 0; order < MotionJet::orders;) {
    Level level;
    if (!pose(instant, forcing, order, entries, mode, level)) return dependent_rows(level.contacts);
    if (level.entries.empty()) break;
    CoulombProblem& problem = level.problem;
    const bool pressed = std::any_of(problem.items.begin(), problem.items.end(),
                                     [](const CoulombItem& item) { return item.kind == Kind::pressed; });
    if (problem.b.isZero(0.0) && !pressed) {
      ++order;
      continue;
    }
    problem.W = delassus(model_, *level.system, level.contacts).W;
    hold_normals(problem);
    const auto solution = solve(problem);
    if (!solution) return refusal(level, false);
    if (level.entries.size() <= most_compared && may_have_many(problem)) {
      // Between static and kinetic friction what sticks may also slip; that is the law, not a paradox.
      CoulombProblem settled = problem;
      for (std::size_t i = 0; i < settled.items.size(); ++i) {
        CoulombItem& item = settled.items[i];
        (solution->kinetic[i] ? item.static_friction : item.kinetic_friction) =
            solution->kinetic[i] ? item.kinetic_friction : item.static_friction;
      }
      if (all_solutions(settled).size() > 1) return refusal(level, true);
    }
    if (!settle(level, *solution, entries, mode, known)) ++order;
  }
  // No known derivative says more: what touches stays as it was, what is at its limit sticks.
  for (const Entry& entry : entries) {
    if (entry.standing == Standing::limit) mode[entry.who.contact].state = State::stick;
    if (entry.standing == Standing::apex) mode[entry.who.contact] = old[entry.who.contact];
  }
  return {};
}

}  // namespace signorini
