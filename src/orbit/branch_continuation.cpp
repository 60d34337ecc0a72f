#include "orbit/branch_continuation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/internal_units.hpp"
#include "orbit/branch_newton.hpp"
#include "orbit/load_period.hpp"
#include "orbit/shooting.hpp"
#include "signorini/simulate.hpp"

namespace signorini::orbit {
namespace {

constexpr double shortest_step = 1e-7;  // lower limit for ds, in the norm of branch_newton.hpp
// The next step is longer if Newton's method needed at most this number of iterations.
constexpr int quick = 4;
// Limit for (distance between two points) / ds. Beyond it Newton's method has ended at another branch. Chosen value.
constexpr double max_step_ratio = 10.0;
// Residual / amplitude up to which an orbit shifted in time is regarded as periodic; above the noise. Chosen value.
constexpr double shift_residual = 1e-3;
constexpr double restart_step = 2e-3;  // step of the search beyond a gap, relative to the range of the key
// Relative difference of amplitudes and multipliers up to which has_passed() regards two orbits as the same.
// Amplitudes come from sampled rows; multipliers are interpolated between two points. Chosen value.
constexpr double same_amplitude = 0.05;

}  // namespace

/// Finds an orbit at a slightly further value of the key. Damped steps of Newton's method also find unstable orbits
/// and other sequences of events; if these steps fail, a transient run is computed. Returns false if both fail.
bool BranchContinuation::restart(CorrectedPoint& here, double sign) {
  BranchState next{orbit_state(here.pass.begin), here.state.duration, here.state.s + sign * restart_step};
  if (next.s < 0.0 || next.s > 1.0) return false;
  if (!map_.autonomous()) next.duration = map_.period(next.s);
  next.state = map_.projected(std::move(next.state), here.pass.begin.states, next.s);
  const std::shared_ptr<const PeriodMap> at = map_.at(next.s);
  const auto close = [&](const OrbitState& state) {
    ShootingStart start{state, next.duration, map_.autonomous(), newton_.accepted_residual(), {}};
    start.energy = map_.energy(next.s);
    ShootingResult shot = shoot(*at, start, correction_tolerance);
    if (!shot.closed || shot.pass.end_derivatives.size() == 0) return false;
    here.state = {shot.state, shot.duration, next.s};
    here.pass = std::move(shot.pass);
    here.residual = shot.residual;
    here.derivative_by_s = {};
    here.multipliers.clear();
    return true;
  };
  if (close(next.state)) return true;
  if (map_.autonomous()) return false;
  const OrbitPass transient = at->pass({next.state, restart_periods * next.duration, false});
  return transient.done() && close(orbit_state(transient.end));
}

/// Moves `here` to the middle of its family of orbits. Returns false if `here` remains unchanged.
bool BranchContinuation::move_to_representative(CorrectedPoint& here, const Vector& t) {
  std::optional<CorrectedPoint> middle = representative_member(map_, newton_, here, t);
  if (!middle || sequence_of(middle->pass) != sequence_of(here.pass)) return false;
  here = std::move(*middle);
  return true;
}

/// Moves the section away from events if an event is too near. `here` and the previous point `place` move to
/// the new section.
void BranchContinuation::choose_new_section(CorrectedPoint& here, std::optional<SecantPoint>& place) {
  if (map_.autonomous()) return;
  const double T = here.state.duration;
  const double later = section_away_from(here.pass.instants, T);
  if (later == 0.0) return;
  const OrbitPass to = map_.at(here.state.s)->pass({here.state.state, later, false});
  if (!to.done()) return;
  std::optional<SecantPoint> place_there;
  if (place) {
    const OrbitPass same =
        map_.at(place->s)->pass({orbit_state(place->begin), later / T * place->duration, false});
    if (same.done()) place_there = SecantPoint{same.end, place->duration, place->s};
  }
  const double before = map_.section();
  map_.set_section(std::fmod(before + later / T, 1.0));
  CorrectedPoint moved = here;
  moved.state.state = orbit_state(to.end);
  moved.pass = map_.pass(moved.state);
  moved.derivative_by_s = {};
  moved.multipliers.clear();
  if (!(moved.pass.done() && moved.pass.end_derivatives.size() > 0)) {
    map_.set_section(before);
    return;
  }
  here = std::move(moved);
  place = std::move(place_there);
}

/// Stores in parameter_component_ the component of the tangent at `next` along the parameter. Its sign is the same in every section,
/// although the branch may bend more in another section.
void BranchContinuation::store_parameter_direction(const std::optional<SecantPoint>& place,
                                                   CorrectedPoint& next) {
  parameter_component_ = 0.0;
  if (!place || map_.autonomous() || tangent_deviates_) return;
  const std::optional<Vector> secant = newton_.secant(*place, next);
  if (!secant) return;
  const double along = newton_.examine(next, *secant)[secant->size() - 1];
  if (std::abs(along) > location_tolerance) parameter_component_ = along;
}

/// Direction of the next step: the tangent if it agrees with the secant of the last step, otherwise the
/// secant. Both differ if fast mode shapes rotate their phases within a step; then following steps use the
/// secant and do not compute the tangent, which needs a finite difference of the map.
Vector BranchContinuation::direction(const std::optional<SecantPoint>& place, CorrectedPoint& here,
                                     const Vector& before) {
  const std::optional<Vector> secant =
      place && !map_.autonomous() ? newton_.secant(*place, here) : std::nullopt;
  if (!secant) return newton_.examine(here, before);
  newton_.examine(here, *secant, {}, true);
  const auto [way, drift] = newton_.split(here, *secant);
  if (tangent_deviates_ && newton_.fixes_parameter(way)) return way + drift;
  Vector tangent = newton_.examine(here, *secant);
  if (parameter_component_ * tangent[tangent.size() - 1] < 0.0) tangent = newton_.examine(here, -tangent);
  tangent_deviates_ = tangent.dot(way) < same_direction_cosine;
  return (tangent_deviates_ ? way : tangent) + drift;
}

/// Text of the sequence of events. The events are rotated to the alphabetically first order, since the section may move.
std::string BranchContinuation::sequence_of(const OrbitPass& pass) const {
  std::vector<std::string> list;
  for (const Event& e : pass.events)
    list.push_back(map_.model().contacts[static_cast<std::size_t>(e.contact)].name + " " + to_string(e.type));
  std::vector<std::string> least = list;
  for (std::size_t k = 1; k < list.size(); ++k) {
    std::rotate(list.begin(), list.begin() + 1, list.end());
    least = std::min(least, list);
  }
  return least.empty() ? "none" : fmt::format("{}", fmt::join(least, ", "));
}

int BranchContinuation::number_of_sequence(const OrbitPass& pass) {
  const std::string text = sequence_of(pass);
  const auto found = std::find(branch_.sequences.begin(), branch_.sequences.end(), text);
  const auto number = static_cast<int>(found - branch_.sequences.begin()) + 1;
  if (found == branch_.sequences.end()) branch_.sequences.push_back(text);
  return number;
}

/// Adds a point to the branch. Returns false if the observer has interrupted the run.
bool BranchContinuation::add(const CorrectedPoint& here, const std::string& special) {
  const Model& model = map_.model();
  Orbit orbit;
  const OrbitPass next =
      map_.pass({orbit_state(here.pass.end), here.state.duration, here.state.s}, true, true);
  const bool known = next.done() && next.end_derivatives.size() == here.pass.end_derivatives.size();
  newton_.update_noise(here.pass, next);
  set_multipliers(here.multipliers, known ? monodromy(model, next) : Eigen::MatrixXd(), here.ones, here.error,
                  map_.keeps_energy(), orbit);
  BranchPoint point;
  point.parameter = map_.parameter(here.state.s);
  point.period = here.state.duration * model.unit.time;
  point.amplitude = next.done() ? next.amplitude : here.pass.amplitude;
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
  const bool point_is_located = !special.empty() && special != "restart" && special != "switched";
  std::vector<std::string> what;
  if (!special.empty()) what.push_back(special);
  point.branch = number_;
  if (points_ > 0 && !point_is_located && folds_) what.emplace_back("fold");
  if (points_ > 0 && (!point_is_located || special == "sequence")) {
    // A change of the sequence alone does not explain a change of stability.
    const BranchPoint& last = branch_.points.back();
    const bool explained = located_ && !last.special.ends_with("sequence");
    if (last.stable != point.stable && !explained) what.emplace_back("stability");
    if (last.sequence != point.sequence && !located_ && !point_is_located) what.emplace_back("sequence");
  }
  std::stable_partition(what.begin(), what.end(), [](const std::string& a) { return a == "stability"; });
  point.special = fmt::format("{}", fmt::join(what, "+"));
  located_ = point_is_located;
  branch_.points.push_back(point);
  ++points_;
  if (seen_) seen_(branch_.points.back());
  branch_.interrupted = here.pass.interrupted || next.interrupted;
  return !branch_.interrupted;
}

/// Corrects the first orbit to the first point `here`. Returns false if Newton's method does not converge.
bool BranchContinuation::begin(CorrectedPoint& here) {
  here.state = map_.start();
  here.pass = map_.pass(here.state);
  std::optional<SecantPoint> none;
  choose_new_section(here, none);
  newton_.measure(here.pass);
  here = newton_.correct(here.state, newton_.parameter_direction(here.pass, 1.0), {});
  if (!here.done) end_ = "the first orbit cannot be followed: " + here.reason;
  return here.done;
}

/// Computes the next point: from `here` along t by ds, or, if `last` is true, at the end of the range.
CorrectedPoint BranchContinuation::step(const CorrectedPoint& here, const Vector& t, double ds,
                                        bool last) const {
  BranchState to = newton_.moved(here.state, here.pass, ds * t);
  if (last) {
    to.s = t[t.size() - 1] > 0.0 ? 1.0 : 0.0;
    to.state = map_.projected(std::move(to.state), here.pass.begin.states, to.s);
    if (!map_.autonomous()) to.duration = map_.period(to.s);
  }
  CorrectedPoint next = newton_.correct(std::move(to), last ? newton_.parameter_direction(here.pass, 1.0) : t,
                                        here.derivative_by_s);
  const auto way = next.done ? newton_.difference({here.pass.begin, here.state.duration, here.state.s}, next)
                             : std::nullopt;
  if (way && way->norm() > max_step_ratio * ds) {
    next.done = false;
    next.reason = "Newton's method ends at another part of the branch";
  }
  return next;
}

/// True if the orbit is the same for all values of the key, apart from a time shift, up to the end of the range.
bool BranchContinuation::is_time_shift(const CorrectedPoint& here, const Vector& t) const {
  const std::optional<double> shift = newton_.shift(here, t);
  if (!shift) return false;
  const double T = here.state.duration;
  double time = std::fmod(*shift * (1.0 - here.state.s), T);
  if (time < 0.0) time += T;
  BranchState end{here.state.state, map_.period(1.0), 1.0};
  if (time > 0.0) {
    const OrbitPass to = map_.at(here.state.s)->pass({here.state.state, time, false});
    if (!to.done()) return false;
    end.state = orbit_state(to.end);
  }
  const OrbitPass pass = map_.pass(end, false);
  return pass.done() && orbit_residual(map_.model(), pass) <= shift_residual;
}

/// True if the branch already has a point with the parameter, sequence, amplitude and multiplier of `at`.
bool BranchContinuation::has_passed(const CorrectedPoint& at) {
  const Model& model = map_.model();
  const Multipliers all = multipliers_of(monodromy(model, at.pass)),
                    rest = without_ones(all, count_ones(all));
  const double p = value(at), multiplier = rest.empty() ? 0.0 : std::abs(rest.front());
  const double amplitude = at.pass.amplitude;
  const int sequence = number_of_sequence(at.pass);
  for (std::size_t i = 1; i < branch_.points.size(); ++i) {
    const BranchPoint &a = branch_.points[i - 1], &b = branch_.points[i];
    const double way = b.parameter - a.parameter, x = way != 0.0 ? (p - a.parameter) / way : 2.0;
    if (a.branch != number_ || b.branch != number_ || b.special.starts_with("restart")) continue;
    if (x < 0.0 || x > 1.0 || (a.sequence != sequence && b.sequence != sequence)) continue;
    const double between = a.amplitude + x * (b.amplitude - a.amplitude);
    const double there = a.max_multiplier + x * (b.max_multiplier - a.max_multiplier);
    const double varies = std::abs(b.max_multiplier - a.max_multiplier);
    if (std::abs(amplitude - between) <= same_amplitude * between &&
        std::abs(multiplier - there) <= varies + same_amplitude * std::max(there, multiplier))
      return true;
  }
  return false;
}

/// Where two orbits merge, a step to another sequence of events may end at the second orbit; found_beyond_
/// stores that orbit. Returns false if the continuation has reversed its direction and repeats earlier points.
bool BranchContinuation::may_continue(const CorrectedPoint& here, const CorrectedPoint& next, double along) {
  if (sequence_of(here.pass) == sequence_of(next.pass)) return true;
  if (!turned_back_) found_beyond_ = FoundBeyond{next, map_.section(), along < 0.0 ? -1.0 : 1.0};
  if (!turned_back_ || !has_passed(next)) return true;
  end_ = fmt::format("beyond {} = {:.9g} the branch repeats its earlier orbits", options_.path, value(here));
  return false;
}

/// Searches for an orbit beyond `here` if even the shortest step from `here` fails, and stores it in `next`.
/// If the branch has already passed this orbit, or if no orbit is found, `next` becomes the orbit in
/// found_beyond_, and t reverses: where two orbits meet and vanish, the second orbit exists on this side
/// only. Returns false if found_beyond_ is empty, too.
bool BranchContinuation::search_beyond_gap(const CorrectedPoint& here, CorrectedPoint& next, Vector& t) {
  const double sign = t[t.size() - 1] < 0.0 ? -1.0 : 1.0;
  const std::string why = next.reason;
  jumps_ = 0;
  next = here;
  const bool found = restart(next, sign);
  const bool known = found && has_passed(next);
  if (found && !known) {
    crossed_gap_ = true;
    found_beyond_ = FoundBeyond{next, map_.section(), sign};
    if (t.size() != newton_.size(next.pass)) t = newton_.parameter_direction(next.pass, sign);
    return true;
  }
  if (found_beyond_) {
    map_.set_section(found_beyond_->section);
    next = std::move(found_beyond_->at);
    t = newton_.parameter_direction(next.pass, -found_beyond_->sign);
    found_beyond_.reset();
    turned_back_ = true;
    return true;
  }
  end_ =
      fmt::format("at {0} = {1:.9g} even the shortest step fails ({3}), and {2}", options_.path, value(here),
                  known ? "the orbit found beyond this value already belongs to the branch"
                        : "no orbit is found beyond this value",
                  why);
  return false;
}

/// Follows the branch point by point. end_ stays empty if the observer interrupts the run, or at the
/// requested number of points.
void BranchContinuation::continue_branch(CorrectedPoint here, Vector t) {
  double ds = 0.25 * options_.step;
  while (points_ < options_.most_points) {
    double along = t[t.size() - 1];
    const double left = along > 0.0   ? (1.0 - here.state.s) / along
                        : along < 0.0 ? here.state.s / -along
                                      : 2.0 * ds;
    const bool last = left <= ds;
    double length = std::min(ds, left);
    const double whole = length;
    CorrectedPoint next = step(here, t, length, last);
    branch_.interrupted = next.pass.interrupted;
    if (branch_.interrupted) return;
    std::string special;
    std::optional<SecantPoint> place;
    std::vector<LocatedPoint> points;
    if (next.done) points = between(here, next, t, length);
    if (next.done) {
      if (next.iterations <= quick) ds = std::min(1.5 * ds, options_.step);
      place = cross(std::move(points), here, next, t, length);
      if (!place || !may_continue(here, next, along)) return;
    } else {
      ds = 0.5 * length;
      const bool jumps = jumps_ >= max_jumps;
      if (ds >= shortest_step && !jumps) continue;
      if (!jumps && !add(here, "end")) return;
      special = "restart";
      if (!search_beyond_gap(here, next, t)) return;
      along = t[t.size() - 1];
      ds = 0.25 * options_.step;
    }
    const bool changes = sequence_of(here.pass) != sequence_of(next.pass);
    store_parameter_direction(place, next);
    choose_new_section(next, place);
    const Vector before = t.size() == newton_.size(next.pass)
                              ? t
                              : newton_.parameter_direction(next.pass, along < 0.0 ? -1.0 : 1.0);
    here = std::move(next);
    t = before;
    newton_.measure(here.pass, &t);
    here.family = {};  // the stored directions refer to the norm of the previous point
    t = direction(place, here, t);
    if (move_to_representative(here, t)) t = direction(place, here, t);
    store_checkpoint(here, t);
    folds_ = folds_ && special.empty() && along * t[t.size() - 1] < 0.0 && changes;
    if (!add(here, special)) return;
    report_checkpoint();
    complete_ = last && special.empty() && length == whole;
    if (complete_) {
      report_end(here, along);
      return;
    }
    if (doubled_ && returns(here)) {
      end_ =
          fmt::format("returned to an orbit of half the period near {} = {:.9g}", options_.path, value(here));
      complete_ = true;
      return;
    }
  }
}

/// Sets end_ at an end of the range. A branch that returns to its beginning after a gap is incomplete: the
/// gap separates two pieces of the branch.
void BranchContinuation::report_end(const CorrectedPoint& here, double along) {
  end_ = fmt::format("{} {} = {:.9g}", along > 0.0 ? "reached" : "returned to", options_.path, value(here));
  if (along > 0.0 || number_ != 1) return;
  double farthest = options_.from;
  for (const BranchPoint& p : branch_.points)
    if (std::abs(p.parameter - options_.from) > std::abs(farthest - options_.from)) farthest = p.parameter;
  end_ += fmt::format("; between {:.9g} and {:.9g} the branch has no orbit", farthest, options_.to);
  if (!crossed_gap_) return;
  end_ += ", and the branch was found again beyond a gap: another branch may lead across the gap";
  complete_ = false;
}

void BranchContinuation::follow_from_start() {
  CorrectedPoint here;
  if (!begin(here)) return;
  const bool back = options_.resume_from && !options_.resume_from->towards_to;
  const Vector t = newton_.examine(here, newton_.parameter_direction(here.pass, back ? -1.0 : 1.0));
  move_to_representative(here, t);
  if (options_.resume_from) {
    store_checkpoint(here, t);
    continue_branch(std::move(here), t);
    return;
  }
  if (!add(here, "")) return;
  store_checkpoint(here, t);
  report_checkpoint();
  if (is_time_shift(here, t)) {
    end_ = fmt::format("{} only shifts the motion in time: the orbit is the same for all values of this key",
                       options_.path);
    return;
  }
  continue_branch(std::move(here), t);
}

void BranchContinuation::store_checkpoint(const CorrectedPoint& here, const Vector& t) {
  last_ = here.state;
  last_section_ = map_.section();
  towards_to_ = t[t.size() - 1] >= 0.0;
}

std::optional<BranchCheckpoint> BranchContinuation::mark() {
  if (!last_) return std::nullopt;
  map_.set_section(last_section_);
  return BranchCheckpoint{map_.parameter(last_->s), towards_to_, map_.orbit_at(*last_), branch_.sequences,
                          last_points_};
}

void BranchContinuation::report_checkpoint() {
  last_points_ = branch_.points.size();
  if (number_ == 1 && options_.on_checkpoint) options_.on_checkpoint([this] { return mark().value(); });
}

/// Runs `walk`. If the scene is refused for a value of the key, the branch ends there and keeps its points.
void BranchContinuation::guarded(const std::function<void()>& walk) {
  try {
    walk();
  } catch (const Error& error) {
    if (error.code() == ExitCode::file || (points_ < 2 && !options_.resume_from)) throw;
    end_ = fmt::format("beyond {} = {:.9g} the scene is refused: {}", options_.path,
                       last_ ? map_.parameter(last_->s) : options_.from, error.what());
  }
  if (end_.empty())
    end_ = branch_.interrupted ? "interrupted"
                               : fmt::format("stopped at the requested maximum of {} points", points_);
}

void BranchContinuation::follow() {
  guarded([&] { follow_from_start(); });
}

/// Finds the first point `here` on the other branch and the branch's direction t there. Returns false if no
/// step finds a point.
bool BranchContinuation::begin_from(const Junction& junction, CorrectedPoint& here, Vector& t) {
  here = junction.at;
  if (doubled_) here.state.duration *= 2.0;
  here.pass = map_.pass(here.state);
  if (!here.pass.done() || here.pass.end_derivatives.size() == 0) return false;
  here.derivative_by_s = {};
  newton_.measure(here.pass);
  t = newton_.in_norm(junction.away);
  for (double ds = 0.25 * options_.step; ds >= shortest_step; ds *= 0.5) {
    CorrectedPoint next = newton_.correct(newton_.moved(here.state, here.pass, ds * t), t, {});
    // The other branch must begin along t. Otherwise the orbit belongs to a different branch, for instance to
    // the branch of the simple period, passed twice.
    const SecantPoint begin{here.pass.begin, here.state.duration, here.state.s};
    if (!next.done || chord_deviates(begin, next, &t, false)) continue;
    const std::optional<SecantPoint> place{begin};
    here = std::move(next);
    t = direction(place, here, t);
    return true;
  }
  return false;
}

void BranchContinuation::follow_from(const Junction& junction) {
  doubled_ = junction.kind == "flip";
  guarded([&] {
    CorrectedPoint here;
    Vector t;
    if (!begin_from(junction, here, t)) {
      end_ = fmt::format("no orbit is found near the {} at {} = {:.9g}", junction.kind, options_.path,
                         value(junction.at));
      return;
    }
    if (add(here, "switched") && !(doubled_ && returns(here))) continue_branch(std::move(here), t);
  });
}

/// True if the branch of doubled period has passed an orbit of the simple period: then z(T/2) - z reverses
/// its sign between two points with the same section.
bool BranchContinuation::returns(const CorrectedPoint& here) {
  BranchState half = here.state;
  half.duration *= 0.5;
  const OrbitPass pass = map_.pass(half, false);
  if (!pass.done()) return false;
  const OrbitSection section(map_.model(), pass.begin);
  Vector gap = section.coordinates(pass.end) - section.coordinates(pass.begin);
  const bool comparable = half_.size() == gap.size() && half_section_ == map_.section();
  const double along = comparable ? gap.dot(half_) : 0.0;
  const bool turned = along < -same_direction_cosine * gap.norm() * half_.norm();
  half_ = std::move(gap);
  half_section_ = map_.section();
  return turned;
}

}  // namespace signorini::orbit
