// follow(): pseudo-arclength continuation of orbits over a key.
//
//   y = y0 + ds t,   t: the direction of the branch, |t| = 1 in a norm in which the amplitude and the range count as 1
//   [ dG/dy ]        [ -G ]
//   [  t^T  ] dy  =  [  0 ]         Newton's method across t, so that folds are passed
//
// Where no step is short enough, as where a guard grazes, the orbit a little further on is looked for by a transient.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/eigen_dense.hpp"
#include "model/rescale.hpp"
#include "orbit/branch_map.hpp"
#include "orbit/multipliers.hpp"
#include "orbit/recurrence.hpp"
#include "orbit/shooting.hpp"
#include "signorini/simulate.hpp"

namespace signorini {
namespace {

constexpr double shortest_step = 1e-5;  // of the range
constexpr int most_corrections = 10, quick = 4;
constexpr double longest_correction = 0.1;  // in the norm; steps are shorter. Chosen.
constexpr double slow = 0.02;  // of the residual: more is left where dG/ds is that of another point
constexpr double corrected_to = 1e-11,
                 corrected_at_last = 1e-9;  // residual over amplitude, as in shooting.cpp
constexpr double singular = 1e-9;           // as in shooting.cpp
constexpr double amplitudes_a_range =
    5.0;                               // in which the state may change as far as the parameter in its range
constexpr double restart_step = 2e-3;  // of the range

/// What a correction ended with.
struct Corrected {
  bool done = false;
  std::string reason;
  BranchState state;
  OrbitPass pass;
  double residual = 0.0;
  int iterations = 0;
  Vector by_s;  // B^T dG/ds at this point; empty: not asked for yet
};

class BranchWalk {
 public:
  BranchWalk(const SceneReader& read, const BranchOptions& options, const Orbit& first, Recorder* recorder,
             const std::function<void(const BranchPoint&)>& seen)
      : options_(options), map_(read, options, first, recorder), seen_(seen) {}
  [[nodiscard]] Branch follow();

 private:
  [[nodiscard]] std::string refusal(const OrbitPass& pass, Eigen::Index unknowns) const;
  [[nodiscard]] Corrected correct(BranchState guess, const Vector& t, const Vector& by_s) const;
  [[nodiscard]] Eigen::MatrixXd jacobian(const BranchState& state, const OrbitPass& pass,
                                         const Vector& by_s) const;
  [[nodiscard]] Vector by_parameter(const BranchState& state, const OrbitPass& pass) const {
    return OrbitSection(map_.model(), pass.begin).basis().transpose() * map_.by_parameter(state, pass);
  }
  [[nodiscard]] Vector direction(Corrected& at, const Vector& before) const;
  void measure(const OrbitPass& pass);
  [[nodiscard]] BranchState moved(const BranchState& from, const OrbitPass& pass, const Vector& dy) const;
  [[nodiscard]] Eigen::Index size(const OrbitPass& pass) const {
    return OrbitSection(map_.model(), pass.begin).size() + (map_.autonomous() ? 2 : 1);
  }
  /// Along the parameter alone.
  [[nodiscard]] Vector upwards(const OrbitPass& pass, double sign) const {
    Vector t = Vector::Zero(size(pass));
    t[t.size() - 1] = sign;
    return t;
  }
  [[nodiscard]] bool begin(Corrected& here);
  [[nodiscard]] Corrected step(const Corrected& here, const Vector& t, double ds, bool last) const;
  [[nodiscard]] bool restart(Corrected& here, double sign);
  void cut_anew(Corrected& here);
  bool add(const Corrected& here, const std::string& special);
  [[nodiscard]] int number_of_sequence(const OrbitPass& pass);

  const BranchOptions& options_;
  BranchMap map_;
  const std::function<void(const BranchPoint&)>& seen_;
  Branch branch_;
  double amplitude_ = 1.0;  // of x, in scales: what counts as 1 in the norm
};

BranchState BranchWalk::moved(const BranchState& from, const OrbitPass& pass, const Vector& dy) const {
  const OrbitSection section(map_.model(), pass.begin);
  BranchState to = from;
  to.state = section.moved(orbit_state(pass.begin), amplitude_ * dy.head(section.size()));
  to.s = std::clamp(from.s + dy[dy.size() - 1], 0.0, 1.0);  // outside, the key may mean nothing
  to.duration = map_.autonomous() ? from.duration * (1.0 + dy[section.size()]) : map_.period(to.s);
  return to;
}

/// dG/dy, columns in the norm: x by the amplitude, T by itself. With the phase condition where T is unknown.
Eigen::MatrixXd BranchWalk::jacobian(const BranchState& state, const OrbitPass& pass,
                                     const Vector& by_s) const {
  const OrbitSection section(map_.model(), pass.begin);
  const Eigen::MatrixXd& B = section.basis();
  const Eigen::Index n = section.size(), extra = map_.autonomous() ? 1 : 0;
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(n + extra, n + extra + 1);
  J.topLeftCorner(n, n) = B.transpose() * pass.end_rates - Eigen::MatrixXd::Identity(n, n);
  J.block(0, n + extra, n, 1) = by_s / amplitude_;
  if (extra == 1) {
    J.block(0, n, n, 1) = B.transpose() * section.rates(pass.end) * state.duration / amplitude_;
    Vector along = B.transpose() * section.rates(pass.begin);
    J.block(n, 0, 1, n) = (along / along.norm()).transpose();
  }
  return J;
}

/// Why a pass is no step of the branch; empty: it is one.
std::string BranchWalk::refusal(const OrbitPass& pass, Eigen::Index unknowns) const {
  if (!pass.done()) return "the run over one period stopped: " + pass.outcome.reason;
  if (pass.end_rates.size() == 0) return "the state after one period has no derivative: " + pass.reason;
  return size(pass) != unknowns ? "the contact state at the section changes" : "";
}

/// by_s: of the point before, which serves as long as Newton's method converges; empty: none.
Corrected BranchWalk::correct(BranchState guess, const Vector& t, const Vector& by_s) const {
  Corrected c;
  c.state = std::move(guess);
  Vector slope = by_s;
  double before = 0.0;
  for (c.iterations = 0; c.iterations <= most_corrections; ++c.iterations) {
    c.pass = map_.pass(c.state);
    c.reason = refusal(c.pass, t.size());
    if (!c.reason.empty()) return c;
    c.residual = orbit_residual(map_.model(), c.pass);
    const bool stands = c.iterations > 0 && c.residual > 0.5 * before && c.residual <= corrected_at_last;
    if (c.residual <= corrected_to || stands) {
      c.done = true;
      return c;
    }
    const bool stale = c.iterations > 0 && c.residual > slow * before;
    before = c.residual;
    const OrbitSection section(map_.model(), c.pass.begin);
    if (slope.size() != section.size() || stale) slope = by_parameter(c.state, c.pass);
    Eigen::MatrixXd A(t.size(), t.size());
    A << jacobian(c.state, c.pass, slope), t.transpose();
    Vector b = Vector::Zero(t.size());
    b.head(section.size()) = -section.basis().transpose() *
                             (section.coordinates(c.pass.end) - section.coordinates(c.pass.begin)) /
                             amplitude_;
    const Vector dy = shortest_solution(A, b, singular);
    if (!(dy.norm() < longest_correction)) {
      c.reason = "Newton's method leaves the branch";
      return c;
    }
    c.state = moved(c.state, c.pass, dy);
  }
  c.reason = fmt::format("Newton's method does not converge: a residual of {:.2g} of the amplitude is left",
                         c.residual);
  return c;
}

/// Along the branch, towards where `before` pointed.
Vector BranchWalk::direction(Corrected& at, const Vector& before) const {
  if (at.by_s.size() == 0) at.by_s = by_parameter(at.state, at.pass);
  Eigen::MatrixXd A(before.size(), before.size());
  A << jacobian(at.state, at.pass, at.by_s), before.transpose();
  Vector b = Vector::Zero(before.size());
  b[b.size() - 1] = 1.0;
  const Vector t = shortest_solution(A, b, singular);
  return t.norm() > 0.0 ? Vector(t / t.norm()) : before;
}

/// Without a branch: a little further on, after a transient.
bool BranchWalk::restart(Corrected& here, double sign) {
  BranchState next{orbit_state(here.pass.begin), here.state.duration, here.state.s + sign * restart_step};
  if (next.s < 0.0 || next.s > 1.0 || map_.autonomous()) return false;
  next.duration = map_.period(next.s);
  const std::shared_ptr<const PeriodMap> at = map_.at(next.s);
  const OrbitPass transient = at->pass({next.state, restart_periods * next.duration, false});
  if (!transient.done()) return false;
  next.state = orbit_state(transient.end);
  const Shot shot = shoot(*at, {next.state, next.duration, false, 0.0}, corrected_to);
  if (!shot.closed || shot.pass.end_rates.size() == 0) return false;
  here.state = {shot.state, next.duration, next.s};
  here.pass = shot.pass;
  here.residual = shot.residual;
  here.by_s = {};
  return true;
}

/// A section away from events, if this one is near to one.
void BranchWalk::cut_anew(Corrected& here) {
  if (map_.autonomous()) return;
  const double T = here.state.duration;
  const double later = section_away_from(here.pass.instants, T);
  if (later == 0.0) return;
  const OrbitPass to = map_.at(here.state.s)->pass({here.state.state, later, false});
  if (!to.done()) return;
  const double before = map_.section();
  map_.move_section(std::fmod(before + later / T, 1.0));
  Corrected moved = here;
  moved.state.state = orbit_state(to.end);
  moved.pass = map_.pass(moved.state);
  moved.by_s = {};
  if (moved.pass.done() && moved.pass.end_rates.size() > 0)
    here = std::move(moved);
  else
    map_.move_section(before);
}

int BranchWalk::number_of_sequence(const OrbitPass& pass) {
  std::vector<std::string> list;
  for (const Event& e : pass.events)
    list.push_back(map_.model().contacts[static_cast<std::size_t>(e.contact)].name + " " + to_string(e.type));
  // It begins where it is least in alphabetical order: the section may move.
  std::vector<std::string> least = list;
  for (std::size_t k = 1; k < list.size(); ++k) {
    std::rotate(list.begin(), list.begin() + 1, list.end());
    least = std::min(least, list);
  }
  const std::string text = least.empty() ? "none" : fmt::format("{}", fmt::join(least, ", "));
  const auto found = std::find(branch_.sequences.begin(), branch_.sequences.end(), text);
  const auto number = static_cast<int>(found - branch_.sequences.begin()) + 1;
  if (found == branch_.sequences.end()) branch_.sequences.push_back(text);
  return number;
}

/// False: nobody wants more.
bool BranchWalk::add(const Corrected& here, const std::string& special) {
  const Model& model = map_.model();
  Orbit orbit;
  const Eigen::MatrixXd phi = monodromy(model, here.pass);
  const OrbitPass next =
      map_.pass({orbit_state(here.pass.end), here.state.duration, here.state.s}, true, true);
  const bool known = next.done() && next.end_rates.size() == here.pass.end_rates.size();
  const Multipliers all = multipliers_of(phi);
  set_multipliers(all, phi, known ? monodromy(model, next) : Eigen::MatrixXd(),
                  std::max<std::size_t>(count_ones(all), map_.autonomous() ? 1 : 0), orbit);
  BranchPoint point;
  point.parameter = map_.parameter(here.state.s);
  point.period = here.state.duration * model.unit.time;
  point.amplitude = here.pass.u_amplitude * model.scales.displacement * model.unit.length;
  point.max_multiplier = orbit.max_multiplier;
  point.multiplier_error = orbit.multiplier_error;
  point.stable = orbit.stable;
  point.loss = orbit.loss;
  point.residual = here.residual;
  point.events = static_cast<long>(here.pass.events.size());
  point.sequence = number_of_sequence(here.pass);
  for (const OutputExtremes& x : next.response) {
    point.minima.push_back(x.minimum);
    point.maxima.push_back(x.maximum);
  }
  std::vector<std::string> what;
  if (!special.empty()) what.push_back(special);
  if (!branch_.points.empty()) {
    const BranchPoint& last = branch_.points.back();
    if (last.stable != point.stable) what.emplace_back("stability");
    if (last.sequence != point.sequence) what.emplace_back("sequence");
  }
  point.special = fmt::format("{}", fmt::join(what, "+"));
  branch_.points.push_back(point);
  if (seen_) seen_(branch_.points.back());
  branch_.interrupted = here.pass.interrupted || next.interrupted;
  return !branch_.interrupted;
}

/// What counts as 1 in the norm: so many amplitudes of everything, each of its kind.
void BranchWalk::measure(const OrbitPass& pass) {
  const OrbitSection section(map_.model(), pass.begin);
  const auto u = static_cast<double>(section.displacements()), v = static_cast<double>(section.velocities());
  const double T = static_cast<double>(section.basis().rows()) - u - v;
  const double square = u * pass.u_amplitude * pass.u_amplitude + v * pass.v_amplitude * pass.v_amplitude +
                        T * pass.T_amplitude * pass.T_amplitude;
  amplitude_ = amplitudes_a_range * (square > 0.0 ? std::sqrt(square) : 1.0);
}

/// The first point. False: the branch ends there.
bool BranchWalk::begin(Corrected& here) {
  here.state = map_.start();
  here.pass = map_.pass(here.state);
  cut_anew(here);
  measure(here.pass);
  here = correct(here.state, upwards(here.pass, 1.0), {});
  if (!here.done) branch_.end = "the first orbit could not be followed: " + here.reason;
  return here.done && add(here, "");
}

/// To the next point, or to the end of the range where it is nearer.
Corrected BranchWalk::step(const Corrected& here, const Vector& t, double ds, bool last) const {
  if (!last) return correct(moved(here.state, here.pass, ds * t), t, here.by_s);
  BranchState end = moved(here.state, here.pass, ds * t);
  end.s = t[t.size() - 1] > 0.0 ? 1.0 : 0.0;
  if (!map_.autonomous()) end.duration = map_.period(end.s);
  return correct(std::move(end), upwards(here.pass, 1.0), here.by_s);
}

Branch BranchWalk::follow() {
  Corrected here;
  if (!begin(here)) return std::move(branch_);
  Vector t = upwards(here.pass, 1.0);
  double ds = 0.25 * options_.step;
  while (static_cast<int>(branch_.points.size()) < options_.most_points) {
    if (t.size() != size(here.pass)) t = upwards(here.pass, t[t.size() - 1] < 0.0 ? -1.0 : 1.0);
    const Vector d = direction(here, t);
    const bool fold = branch_.points.size() > 1 && d[d.size() - 1] * t[t.size() - 1] < 0.0;
    t = d;
    const double along = t[t.size() - 1];
    const double left = along > 0.0   ? (1.0 - here.state.s) / along
                        : along < 0.0 ? here.state.s / -along
                                      : 2.0 * ds;
    const bool last = left <= ds;
    Corrected next = step(here, t, std::min(ds, left), last);
    if (next.pass.interrupted) {
      branch_.interrupted = true;
      break;
    }
    std::string special = fold ? "fold" : "";
    if (!next.done) {
      ds = 0.5 * std::min(ds, left);
      if (ds >= shortest_step) continue;
      next = here;
      special = "restart";
      if (!restart(next, along < 0.0 ? -1.0 : 1.0)) {
        branch_.end = fmt::format("at {} = {:.9g} no step is short enough, and no orbit is found beyond",
                                  options_.path, map_.parameter(here.state.s));
        break;
      }
      ds = 0.25 * options_.step;
    } else if (next.iterations <= quick) {
      ds = std::min(1.5 * ds, options_.step);
    }
    here = std::move(next);
    cut_anew(here);
    if (!add(here, special)) break;
    const Eigen::Index states = t.size() - (map_.autonomous() ? 2 : 1);
    t.head(states) *= amplitude_;  // the norm is that of the new point
    measure(here.pass);
    t.head(states) /= amplitude_;
    branch_.complete = last && special != "restart";
    if (!branch_.complete) continue;
    branch_.end = fmt::format("reached {} = {:.9g}", options_.path, map_.parameter(here.state.s));
    break;
  }
  if (branch_.end.empty())
    branch_.end = branch_.interrupted
                      ? "interrupted"
                      : fmt::format("{} points, no more were asked for", branch_.points.size());
  return std::move(branch_);
}

}  // namespace

Branch follow(const SceneReader& read, const BranchOptions& options, Recorder* recorder,
              const std::function<void(const BranchPoint&)>& seen) {
  if (!(std::isfinite(options.from) && std::isfinite(options.to)) || options.from == options.to)
    throw UsageError("--over: expected PATH=FROM:TO with two different numbers");
  const SceneReader first = [&](const std::vector<Override>& changes) {
    std::vector<Override> all{{options.path, fmt::format("{}", options.from)}};
    all.insert(all.end(), changes.begin(), changes.end());
    return read(all);
  };
  const Orbit orbit = find_orbit(first, options.orbit, recorder);
  if (!orbit.found) {
    Branch none;
    none.end = fmt::format("no orbit found at {} = {:.9g}: {}", options.path, options.from, orbit.reason);
    return none;
  }
  return BranchWalk(read, options, orbit, recorder, seen).follow();
}

}  // namespace signorini
