#include "orbit/special_points.hpp"

#include <algorithm>
#include <cmath>

#include "orbit/branch_continuation.hpp"
#include "orbit/sequence_search.hpp"

namespace signorini::orbit {
namespace {

constexpr int max_places = 20;                // limit of the function evaluations in one root_between()
constexpr double root_tolerance = 1e-10;      // |f| at which a search for a zero ends; chosen value
constexpr double max_imaginary_part = 1e-12;  // a multiplier with a smaller imaginary part is real: rounding

}  // namespace

TestValues test_values(const Multipliers& all, std::size_t ones, double along, double error) {
  TestValues values;
  values.fold = along;
  double least = 0.0, greatest = 0.0, pair = 0.0;
  for (const auto& mu : without_ones(all, ones)) {
    if (std::abs(mu.imag()) > max_imaginary_part) {
      pair = std::max(pair, std::abs(mu));
      continue;
    }
    least = std::min(least, mu.real());
    greatest = std::max(greatest, mu.real());
  }
  // A value within the error is regarded as just inside the unit circle.
  const auto inside = [error](double beyond) {
    return std::abs(beyond) <= error ? -std::min(error, root_tolerance) : beyond;
  };
  values.flip = -inside(-1.0 - least);
  values.neimark_sacker = inside(pair - 1.0);
  values.branch = inside(greatest - 1.0);
  return values;
}

std::optional<double> root_between(double a, double b,
                                   const std::function<std::optional<double>(double)>& f) {
  double lo = 0.0, hi = 1.0;
  int side = 0;
  for (int i = 0; i < max_places; ++i) {
    const double x = lo + (hi - lo) * a / (a - b);
    const std::optional<double> y = f(x);
    if (!y) return std::nullopt;
    if (std::abs(*y) <= root_tolerance || !(x > lo && x < hi)) return x;
    if ((*y < 0.0) == (a < 0.0)) {
      lo = x;
      a = *y;
      if (side < 0) b *= 0.5;
      side = -1;
    } else {
      hi = x;
      b = *y;
      if (side > 0) a *= 0.5;
      side = 1;
    }
  }
  return lo + (hi - lo) * a / (a - b);
}

// Special points between two points of a branch: zeros of test functions, changes of the sequence of events.

namespace {

// An event is at the section if its distance from the section is below this fraction of the period. Chosen value.
constexpr double min_section_distance = 1e-4;
// Width of the interval in which a change of the sequence is located, in the norm of branch_newton.hpp, and smallest
// ratio of this width to the noise of the map.
constexpr double shortest_part = 1e-10, noises_of_part = 10.0;
// Near a graze an orbit changes as the square root of the key. If the orbits at both ends of the interval
// differ by more than this factor times the square root of the interval's relative width, they belong to
// different branches. Chosen value.
constexpr double graze_jump_factor = 10.0;
constexpr double max_unchecked_step = 1e-4;  // in the norm: too_long() accepts shorter steps. Chosen value.
// Two points determine a direction only if their distance is at least this multiple of shortest_part. Chosen value.
constexpr double min_direction_distance = 1e3;

// Tolerance of a step in s, relative to the largest step: above rounding. Chosen value.
constexpr double rounded = 1e-9;

constexpr const char* other_branch = "other branch";

SecantPoint place_of(const CorrectedPoint& at) { return {at.pass.begin, at.state.duration, at.state.s}; }

/// True if an event is at the section. Such an event may be recorded twice, or not at all.
bool event_at_section(const CorrectedPoint& at) {
  const double T = at.state.duration;
  return std::any_of(at.pass.instants.begin(), at.pass.instants.end(), [&](const OrbitPoint& p) {
    return p.t < min_section_distance * T || p.t > (1.0 - min_section_distance) * T;
  });
}

}  // namespace

/// Point where a test function is zero on the step from `here` to `next`; nullopt if no zero is located.
std::optional<BranchContinuation::LocatedPoint> BranchContinuation::zero_of(const SpecialKind& kind,
                                                                            const CorrectedPoint& here,
                                                                            const CorrectedPoint& next,
                                                                            const Vector& t,
                                                                            double ds) const {
  const double a = here.tests.*kind.value, b = next.tests.*kind.value;
  if (!((a < 0.0) != (b < 0.0))) return std::nullopt;
  const bool turns = here.tests.fold * next.tests.fold < 0.0;
  // At a fold a multiplier passes 1, too, so this change of sign is no branch point.
  if (kind.value == &TestValues::branch && turns) return std::nullopt;
  LocatedPoint point{0.0, kind.name, {}, {}};
  const auto part = root_between(a, b, [&](double x) -> std::optional<double> {
    CorrectedPoint c =
        newton_.correct(newton_.moved(here.state, here.pass, x * ds * t), t, here.derivative_by_s);
    if (!c.done) return std::nullopt;
    point.t = newton_.examine(c, t, here.ones);
    point.at = std::move(c);
    return point.at.tests.*kind.value;
  });
  if (!part || !(std::abs(point.at.tests.*kind.value) <= location_tolerance)) return std::nullopt;
  point.part = *part;
  // Where two branches cross, every direction in their plane satisfies the equations of the tangent. The
  // chord from `here` to `next` gives the direction of this branch.
  if (kind.value == &TestValues::branch)
    if (const auto way = newton_.secant(place_of(here), next)) point.t = newton_.split(point.at, *way).across;
  return point;
}

/// The last point of the step with the sequence of `here`. Its kind is other_branch if the orbit beyond the
/// change is not connected with this point.
std::optional<BranchContinuation::LocatedPoint> BranchContinuation::end_of_sequence(
    const CorrectedPoint& here, const CorrectedPoint& next, const Vector& t, double ds) const {
  const std::string sequence = sequence_of(here.pass);
  if (sequence == sequence_of(next.pass) || event_at_section(next)) return std::nullopt;
  LocatedPoint point{0.0, "sequence", {}, {}};
  bool seen = true;  // false: Newton's method failed at the interval's upper end
  const auto stretches = [&](const CorrectedPoint& c) {
    return stretches_of(c.pass.events, c.state.duration * map_.model().unit.time);
  };
  const double enough = std::max(shortest_part, noises_of_part * newton_.noise());
  SequenceSearch search(stretches(here), stretches(next), enough / ds);
  Vector way = ds * t;  // change of y per unit of x, along the last direction found
  std::string beyond = sequence_of(next.pass);
  SecantPoint other = place_of(next);  // the nearest orbit with a different sequence
  while (!search.done()) {
    const double x = search.next();
    const CorrectedPoint& from = point.at.done ? point.at : here;
    CorrectedPoint c = newton_.correct(newton_.moved(from.state, from.pass, (x - point.part) * way), t,
                                       from.derivative_by_s);
    const bool same = c.done && sequence_of(c.pass) == sequence;
    search.update(x, same, c.done ? stretches(c) : std::vector<double>());
    if (!same) {
      seen = c.done;
      if (seen) other = place_of(c);
      if (!seen || sequence_of(c.pass) == beyond) continue;
      beyond = sequence_of(c.pass);
      point.behind_part = x;
      point.behind = std::move(c);
      continue;
    }
    const auto secant = newton_.secant({from.pass.begin, from.state.duration, from.state.s}, c);
    if (const double part = secant ? newton_.along(*secant, t) : 0.0; part > same_direction_cosine)
      way = ds / part * *secant;
    point.part = x;
    point.at = std::move(c);
  }
  const auto way_to = newton_.difference(place_of(here), next);
  const auto apart = newton_.difference(other, point.at.done ? point.at : here);
  if (seen && way_to && apart &&
      apart->norm() > graze_jump_factor * std::sqrt(search.high() - search.low()) * way_to->norm()) {
    point.kind = other_branch;
    return point;
  }
  if (!point.at.done || !seen || event_at_section(point.at)) return std::nullopt;
  if ((point.behind_part - point.part) * ds < min_direction_distance * enough) point.behind.reset();
  newton_.examine(point.at, t, here.ones);
  return point;
}

/// True if the parameter reverses on the step without a located fold, or if a multiplier passes 1 without a
/// fold and without a located branch point. Direction and multipliers are continuous as long as the sequence
/// of events does not change. Therefore the next orbit then belongs to another branch.
bool BranchContinuation::has_unlocated_change(const CorrectedPoint& here, const CorrectedPoint& next,
                                              const std::vector<LocatedPoint>& points) const {
  const bool turns = here.tests.fold * next.tests.fold < 0.0;
  if (!turns && (here.tests.branch < 0.0) == (next.tests.branch < 0.0)) return false;
  const auto seen = [&](const LocatedPoint& p) { return p.kind == (turns ? "fold" : "branch point"); };
  return std::none_of(points.begin(), points.end(), seen) && sequence_of(here.pass) == sequence_of(next.pass);
}

/// If fast mode shapes rotate the tangent at `to` (tangent_deviates_), this tangent is not the direction of the
/// branch, and the chord is not compared with it.
bool BranchContinuation::chord_deviates(const SecantPoint& from, CorrectedPoint& to, const Vector* direction,
                                        bool at_to) const {
  const std::optional<Vector> secant = newton_.secant(from, to);
  if (!secant) return false;
  const auto differs = [&](const Vector& other) {
    return newton_.split(to, *secant).across.dot(newton_.split(to, other).across) < same_direction_cosine;
  };
  if (direction != nullptr && direction->size() == secant->size() && differs(*direction)) return true;
  return at_to && !tangent_deviates_ && differs(newton_.examine(to, *secant));
}

/// True if the branch bends so much on the step that another part of the branch, or another branch, could lie
/// between its points. At a change of the sequence the branch may have a corner.
bool BranchContinuation::too_long(const CorrectedPoint& here, CorrectedPoint& next, const Vector& t,
                                  double length, std::vector<LocatedPoint>& points) const {
  if (length <= max_unchecked_step) return false;
  if (std::abs(next.state.s - here.state.s) > options_.step * (1.0 + rounded)) return true;
  if (sequence_of(here.pass) == sequence_of(next.pass)) {
    // Both tangents lead in the same direction of the parameter, but the parameter has changed in the opposite
    // direction: the next point is on another arm of the branch, for instance on the other side of a resonance.
    const double along = t[t.size() - 1];
    if (along * next.tests.fold > 0.0 && along * (next.state.s - here.state.s) < 0.0) return true;
    return chord_deviates(place_of(here), next, &t, true);
  }
  const auto change =
      std::find_if(points.begin(), points.end(), [](const LocatedPoint& p) { return p.kind == "sequence"; });
  if (change == points.end()) return chord_deviates(place_of(here), next, &t, true);
  const auto doubted = [&](double part) { return part * length > max_unchecked_step; };
  if (doubted(change->part) && chord_deviates(place_of(here), change->at, &t, false)) return true;
  if (!doubted(1.0 - change->part)) return false;
  const auto folds = [](const LocatedPoint& p) { return p.kind == "fold"; };
  // Change of the parameter after the change of the sequence. If this change is opposite to t_s, the branch has a fold.
  const double there = next.state.s - change->at.state.s;
  if (there * t[t.size() - 1] < 0.0 && std::none_of(points.begin(), points.end(), folds)) return true;
  return chord_deviates(place_of(change->at), next, nullptr, true);
}

/// Special points of the step. If Newton's method has switched to another branch within the step, `next`
/// becomes the last orbit on the present branch, and `length` is reduced.
std::vector<BranchContinuation::LocatedPoint> BranchContinuation::located(const CorrectedPoint& here,
                                                                          CorrectedPoint& next,
                                                                          const Vector& t, double& length) {
  std::vector<LocatedPoint> all;
  std::optional<LocatedPoint> change = end_of_sequence(here, next, t, length);
  if (change && change->kind == other_branch) {
    const double part = change->part;
    next = std::move(change->at);
    change.reset();
    next.done = next.done && ++jumps_ < max_jumps;
    if (!next.done) {
      next.reason = "Newton's method ends at another branch";
      return all;
    }
    length *= part;
    newton_.examine(next, t);
  } else {
    jumps_ = 0;
  }
  const auto take = [&](std::optional<LocatedPoint> point) {
    if (point) all.push_back(std::move(*point));
  };
  for (const SpecialKind& kind : special_kinds) {
    // A test function may pass zero just before a graze and jump at the graze. Therefore the part of the step
    // before the graze is searched separately.
    std::optional<LocatedPoint> zero =
        change ? zero_of(kind, here, change->at, t, change->part * length) : std::nullopt;
    if (zero) zero->part *= change->part;
    take(zero ? std::move(zero) : zero_of(kind, here, next, t, length));
  }
  const bool unseen =
      has_unlocated_change(here, next, all) || (change && has_unlocated_change(here, change->at, all));
  if (length > max_unchecked_step && unseen) {
    next.done = false;
    next.reason = "Newton's method ends at another branch";
    return {};
  }
  take(std::move(change));
  std::sort(all.begin(), all.end(),
            [](const LocatedPoint& a, const LocatedPoint& b) { return a.part < b.part; });
  return all;
}

/// Special points of the step, as located() finds them. `next` is rejected if the step is too long for a
/// reliable search.
std::vector<BranchContinuation::LocatedPoint> BranchContinuation::between(const CorrectedPoint& here,
                                                                          CorrectedPoint& next,
                                                                          const Vector& t, double& length) {
  newton_.examine(next, t);
  std::vector<LocatedPoint> points = located(here, next, t, length);
  if (next.done && too_long(here, next, t, length, points)) {
    next.done = false;
    next.reason = "the branch turns within a step";
  }
  return points;
}

/// Adds the special points between `here` and `next` in their order. A step crosses only one change of the
/// sequence; if another change follows, `next` becomes a point between both. Returns the point for the secant
/// at `next`: `here`, or the last point before the change. Returns nullopt if the observer interrupts the run.
std::optional<SecantPoint> BranchContinuation::cross(std::vector<LocatedPoint> points,
                                                     const CorrectedPoint& here, CorrectedPoint& next,
                                                     const Vector& t, double& length) {
  SecantPoint place = place_of(here);
  const auto change =
      std::find_if(points.begin(), points.end(), [](const LocatedPoint& p) { return p.kind == "sequence"; });
  double end = 1.0;
  if (change != points.end()) {
    if (change->behind) {
      end = change->behind_part;
      next = std::move(*change->behind);
      newton_.examine(next, t);
    }
    if ((end - change->part) * length >= min_direction_distance * shortest_part) place = place_of(change->at);
  }
  folds_ = true;
  for (const LocatedPoint& point : points) {
    if (point.part > end) break;
    if (point.kind == "fold") folds_ = false;
    if (!add(point.at, point.kind)) return std::nullopt;
    keep_junction(point);
  }
  length *= end;
  return place;
}

void BranchContinuation::keep_junction(const LocatedPoint& point) {
  if (generation_ >= options_.switches) return;
  const auto keep = [&](BranchMap map, const Vector& away) {
    junctions_.push_back({std::move(map), point.at, away, point.kind, number_, generation_ + 1});
  };
  if (point.kind == "flip") keep(map_.doubled(), newton_.flip_direction(point.at));
  if (point.kind != "branch point") return;
  const Vector other = newton_.other_direction(point.at, point.t);
  keep(map_, other);
  keep(map_, -other);
}

}  // namespace signorini::orbit
