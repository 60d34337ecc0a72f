#include "differential/coupled.hpp"

#include <fmt/core.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "differential/continuations.hpp"
#include "engine/tolerance.hpp"
#include "motion/forcing.hpp"
#include "signorini/simulate.hpp"

namespace signorini::differential {
namespace {

// Of the greatest displacement, or velocity, of the run: what is nearer touches, or rests; what is between
// leaves the question open.
constexpr double touches = 64.0 * std::numeric_limits<double>::epsilon(), nearly = 1e-7;
// Where the run stops the motion is known a little before.
constexpr double touches_before_stop = 1e-11, nearly_before_stop = 1e-8;
constexpr double before_stop = 1e-14;  // of t_end
// What stays at rest moves by the rounding of what acts on it: 128 operations of eps/2, as everywhere.
constexpr double rest = 64.0 * std::numeric_limits<double>::epsilon();
constexpr double same = 1e-6;       // accelerations, of their size
constexpr long most_events = 3000;  // of a run

/// One instant of a motion.
struct State {
  double t = 0.0;
  Vector u, v;
};

/// What can follow from displacements and velocities. Nothing: something nearly touches or nearly rests.
class Mechanics {
 public:
  /// capture: rebounds that are slower rest.
  Mechanics(const Model& model, double capture)
      : model_(model), capture_(capture), mass_(Eigen::MatrixXd(model.mass).cast<long double>()) {}

  /// A state that the run passes: the greatest of them are the scales.
  void pass(const State& s) {
    const auto [by_loads, by_structure] = free_acceleration(s);
    length_ = std::max(length_, s.u.cwiseAbs().maxCoeff());
    speed_ = std::max(speed_, s.v.cwiseAbs().maxCoeff());
    acceleration_ = std::max(acceleration_, by_loads.norm() + by_structure.norm());
    still_ = std::max(still_, rest * static_cast<double>(by_loads.norm()) * s.t);
  }

  /// Speeds of contacts at events: at rows all may be at rest.
  void pass(const Event& e) {
    speed_ = std::max({speed_, std::abs(e.vn), std::abs(e.vt), std::abs(e.vn_after), std::abs(e.vt_after)});
  }

  struct Touch {
    std::vector<std::size_t> contacts;
    bool hit = false;
    Question question;  // of accelerations
  };
  /// Drift: what rests may have a speed that rounding has summed up since the start; without it speeds are what
  /// the state says, since an impact may have left less than that sum where all was at rest before.
  enum class Drift { possible, none };
  [[nodiscard]] std::optional<Touch> touch(const State& s, double zero, double nearly_zero,
                                           Drift drift = Drift::possible) const;
  /// Velocities after the only impact. Nothing: there is none, or several.
  [[nodiscard]] std::optional<State> after_hit(const State& s, const Touch& touch) const;

 private:
  [[nodiscard]] Extended solved(const Extended& f) const { return mass_.solve(f); }
  [[nodiscard]] Extended form(const Combination& c) const {
    Extended f = Extended::Zero(model_.size());
    c.add_to(f, 1.0);
    return f;
  }
  [[nodiscard]] std::array<Extended, 2> free_acceleration(const State& s) const;

  const Model& model_;
  double capture_;
  Eigen::LDLT<ExtendedMatrix> mass_;
  double length_ = std::numeric_limits<double>::min(), speed_ = length_;
  double still_ = 0.0;  // a speed that rounding alone gives
  long double acceleration_ = 0.0L;
};

/// M^-1 P and -M^-1 (C v + K u).
std::array<Extended, 2> Mechanics::free_acceleration(const State& s) const {
  Vector load = Vector::Zero(static_cast<Eigen::Index>(model_.size()));
  motion::Forcing(model_, s.t, motion::Side::after).add_load(s.t, 0, load.data());
  const Extended inner = Eigen::MatrixXd(model_.damping).cast<long double>() * s.v.cast<long double>() +
                         Eigen::MatrixXd(model_.stiffness).cast<long double>() * s.u.cast<long double>();
  return {solved(load.cast<long double>()), solved(-inner)};
}

std::optional<Mechanics::Touch> Mechanics::touch(const State& s, double zero, double nearly_zero,
                                                 Drift drift) const {
  Touch result;
  const double still = drift == Drift::possible ? still_ : 0.0;
  const double no_gap = zero * length_ + still * s.t, small_gap = std::max(nearly_zero * length_, no_gap);
  const double no_speed = zero * speed_ + still, slow = std::max(nearly_zero * speed_, no_speed);
  const bool hits = std::any_of(model_.contacts.begin(), model_.contacts.end(), [&](const Contact& contact) {
    return contact.gap_at(s.u) <= no_gap && contact.normal.dot(s.v) < -no_speed;
  });
  result.hit = hits;
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    const Contact& contact = model_.contacts[c];
    const double gap = contact.gap_at(s.u), vn = contact.normal.dot(s.v), vt = contact.tangent.dot(s.v);
    // What leaves takes part in its neighbour's hit, which may throw it back.
    const bool leaves = std::abs(gap) <= no_gap && vn > slow;
    if (gap > small_gap || (leaves && !hits)) continue;
    if (std::abs(gap) > no_gap || (vn > no_speed && !leaves)) return std::nullopt;
    if (vn < -no_speed && vn > -slow) return std::nullopt;
    const bool slides = std::abs(vt) > no_speed;
    if (contact.has_friction() && slides && std::abs(vt) <= slow) return std::nullopt;
    result.contacts.push_back(c);
    result.question.friction.push_back(contact.friction.kinetic);
    result.question.sliding.push_back(!slides ? 0 : vt > 0.0 ? 1 : -1);
  }
  const auto m = static_cast<Eigen::Index>(result.contacts.size());
  result.question.W.resize(2 * m, 2 * m);
  result.question.b.resize(2 * m);
  result.question.size.resize(2 * m);
  const auto [by_loads, by_structure] = free_acceleration(s);
  for (Eigen::Index j = 0; j < m; ++j) {
    const Contact& contact = model_.contacts[result.contacts[static_cast<std::size_t>(j)]];
    const Extended n = form(contact.normal), t = form(contact.tangent);
    result.question.b[2 * j] = n.dot(by_loads) + n.dot(by_structure);
    result.question.b[2 * j + 1] = t.dot(by_loads) + t.dot(by_structure);
    result.question.size[2 * j] = n.norm() * acceleration_;
    result.question.size[2 * j + 1] = t.norm() * acceleration_;
    const Extended from_n = solved(n), from_t = solved(t);
    for (Eigen::Index i = 0; i < m; ++i) {
      const Contact& other = model_.contacts[result.contacts[static_cast<std::size_t>(i)]];
      const Extended on = form(other.normal), ot = form(other.tangent);
      result.question.W(2 * i, 2 * j) = on.dot(from_n);
      result.question.W(2 * i + 1, 2 * j) = ot.dot(from_n);
      result.question.W(2 * i, 2 * j + 1) = on.dot(from_t);
      result.question.W(2 * i + 1, 2 * j + 1) = ot.dot(from_t);
    }
  }
  return result;
}

std::optional<State> Mechanics::after_hit(const State& s, const Touch& touch) const {
  Question hit = touch.question;
  const auto m = static_cast<Eigen::Index>(touch.contacts.size());
  Extended before(2 * m), restitution(m);
  for (Eigen::Index i = 0; i < m; ++i) {
    const Contact& contact = model_.contacts[touch.contacts[static_cast<std::size_t>(i)]];
    before[2 * i] = contact.normal.dot(s.v);
    before[2 * i + 1] = contact.tangent.dot(s.v);
    restitution[i] = contact.restitution;
    hit.size[2 * i] = form(contact.normal).norm() * s.v.norm();
    hit.size[2 * i + 1] = form(contact.tangent).norm() * s.v.norm();
    hit.sliding[static_cast<std::size_t>(i)] = 0;
  }
  for (;;) {  // ends: each round captures one more
    hit.b = before;
    for (Eigen::Index i = 0; i < m; ++i) hit.b[2 * i] += restitution[i] * std::min(before[2 * i], 0.0L);
    const Continuations all = continuations(hit);
    if (all.responses.size() != 1 || !all.sharp) return std::nullopt;
    bool captured = false;
    for (Eigen::Index i = 0; i < m; ++i) {
      const long double after = before[2 * i] + all.responses[0][2 * i] - hit.b[2 * i];
      if (restitution[i] == 0.0L || !(before[2 * i] < 0.0L) || after >= capture_) continue;
      restitution[i] = 0.0L;
      captured = true;
    }
    if (captured) continue;
    Extended impulse = Extended::Zero(model_.size());
    for (Eigen::Index i = 0; i < m; ++i) {
      const Contact& contact = model_.contacts[touch.contacts[static_cast<std::size_t>(i)]];
      impulse +=
          form(contact.normal) * all.forces[0][2 * i] + form(contact.tangent) * all.forces[0][2 * i + 1];
    }
    return State{s.t, s.u, s.v + solved(impulse).cast<double>()};
  }
}

/// Rows at these times, and no further than the last of them where `short_run`.
Result run_with_rows(const Model& model, RunSpec spec, std::vector<double> times, bool short_run) {
  class Bounded : public Result {
   public:
    double last = 0.0;
    bool progress(double t) override { return t <= last && static_cast<long>(events.size()) <= most_events; }
  } rows;
  rows.last = short_run ? times.back() : spec.t_end;
  spec.output_times = std::move(times);
  rows.report = simulate(model, spec, rows);
  return rows;
}

/// The start, the first events, and a little before the stop.
std::vector<double> times_of(const Result& run, std::size_t most) {
  std::vector<double> times{0.0};
  for (const Event& e : run.events)
    if (e.t > times.back() && times.size() < most) times.push_back(e.t);
  return times;
}

/// Accelerations of the contacts that touch under the run's own forces, less those of the only continuation,
/// of the size of what adds up to them, in units that make the diagonal of W one.
double difference(const Question& q, const Extended& only, const Result::Row& row,
                  const std::vector<std::size_t>& contacts) {
  Extended f(q.b.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    f[static_cast<Eigen::Index>(2 * i)] = -row.contacts[contacts[i]].N;
    f[static_cast<Eigen::Index>(2 * i) + 1] = -row.contacts[contacts[i]].T;
  }
  const Extended response = q.b + q.W * f;
  long double most = 0.0L, size = 0.0L;
  for (Eigen::Index i = 0; i < f.size(); ++i) {
    const long double unit = std::sqrt(q.W(i, i));
    if (!(unit > 0.0L)) continue;
    most = std::max(most, std::abs(response[i] - only[i]) / unit);
    size = std::max(size, q.size[i] / unit + std::abs(f[i]) * unit);
  }
  return size > 0.0L ? static_cast<double>(most / size) : 0.0;
}

/// By how much the run leaves the only motion that goes on from what touches. Nothing: it is not the only one, or
/// it cannot be told what touches.
std::optional<double> leaves_only(const Result::Row& row, const std::optional<Mechanics::Touch>& touch) {
  if (!touch || touch->hit) return std::nullopt;
  if (touch->contacts.empty()) return 0.0;
  const Continuations all = continuations(touch->question);
  if (all.responses.size() != 1 || !all.sharp || all.condition > greatest_condition) return std::nullopt;
  return difference(touch->question, all.responses.front(), row, touch->contacts);
}

void confirm(const Mechanics& mechanics, const Result& run, CoupledFinding& found) {
  for (const Result::Row& row : run.rows) {
    if (row.t >= run.report.outcome.t && row.t > 0.0) break;  // no decision
    ++found.instants;
    const State state{row.t, row.u, row.v};
    auto off = leaves_only(row, mechanics.touch(state, touches, nearly));
    if (off && *off > same) {
      const auto told = leaves_only(row, mechanics.touch(state, touches, touches, Mechanics::Drift::none));
      if (told && *told <= same) {
        off = told;
        ++found.as_told;
      }
    }
    if (!off) {
      ++found.unclear;
      continue;
    }
    found.worst = std::max(found.worst, *off);
    if (*off <= same) {
      ++found.confirmed;
      continue;
    }
    if (found.verdict == CoupledFinding::Verdict::unlike) continue;
    found.verdict = CoupledFinding::Verdict::unlike;
    found.t = row.t;
    found.what = fmt::format("accelerations at t = {:.17g} are off by {:.2g}", row.t, *off);
  }
}

/// What would follow if all that nearly touches, or nearly rests, did so: the end of a chatter.
std::string at_rest(const Mechanics& mechanics, const State& state) {
  const auto touch = mechanics.touch(state, nearly, nearly);
  if (!touch || touch->hit) return "";
  const Continuations all = continuations(touch->question);
  if (all.condition > greatest_condition) return "; as if it did: condition above 1e8";
  if (all.responses.empty()) return "; as if it did: no motion goes on";
  if (all.responses.size() > 1) return "; as if it did: several motions go on";
  return all.sharp ? "; as if it did: one motion goes on" : "; as if it did: another all but goes on";
}

/// Does what could follow explain the stop?
void explain(const Mechanics& mechanics, const Result& run, CoupledFinding& found) {
  using Verdict = CoupledFinding::Verdict;
  const Outcome& outcome = run.report.outcome;
  const std::string kind = to_string(outcome.refusal.kind);
  found.t = outcome.t;
  found.what = outcome.reason;
  const auto say = [&](Verdict verdict, const std::string& why) {
    found.verdict = verdict;
    found.cause = kind + ": " + why;
  };
  const Result::Row& last = run.rows.back();
  State state{outcome.t, last.u + (outcome.t - last.t) * last.v, last.v};
  auto touch = mechanics.touch(state, touches_before_stop, nearly_before_stop);
  if (!touch) return say(Verdict::unclear, "something nearly touches" + at_rest(mechanics, state));
  if (touch->hit) {
    const auto after = mechanics.after_hit(state, *touch);
    if (!after) return say(Verdict::rightly, "no impact, or several");
    state = *after;
    touch = mechanics.touch(state, touches_before_stop, nearly_before_stop);
    if (!touch || touch->hit)
      return say(Verdict::unclear, "something nearly touches after the impact" + at_rest(mechanics, state));
  }
  const Continuations all = continuations(touch->question);
  if (all.condition > greatest_condition) return say(Verdict::rightly, "condition above 1e8");
  if (all.responses.empty()) return say(Verdict::rightly, "no motion goes on");
  if (all.responses.size() > 1) return say(Verdict::rightly, "several motions go on");
  if (!all.sharp) return say(Verdict::unclear, "another motion all but goes on");
  say(Verdict::refused, fmt::format("one motion goes on, condition {:.2g}", all.condition));
}

}  // namespace

const char* to_string(CoupledFinding::Verdict verdict) {
  switch (verdict) {
    case CoupledFinding::Verdict::agrees:
      return "agrees";
    case CoupledFinding::Verdict::rightly:
      return "stops rightly";
    case CoupledFinding::Verdict::unclear:
      return "stops, unclear";
    case CoupledFinding::Verdict::refused:
      return "REFUSED";
    case CoupledFinding::Verdict::unlike:
      return "UNLIKE";
    case CoupledFinding::Verdict::broken:
      return "BROKEN";
    case CoupledFinding::Verdict::forbidden:
      return "forbidden";
  }
  return "?";
}

CoupledFinding examine_coupled(const Scene& scene, std::size_t most_instants) {
  CoupledFinding found;
  try {
    const Model model = build_model(scene);
    RunSpec spec = scene.run;
    spec.engine = Engine::exact;
    const Result first = run_with_rows(model, spec, {0.0}, false);
    std::vector<double> times = times_of(first, most_instants);
    const Outcome& outcome = first.report.outcome;
    const bool stops = outcome.kind == Outcome::Kind::stopped && outcome.refusal;
    if (stops && outcome.t > 0.0) {
      const double late = outcome.t - before_stop * spec.t_end;
      std::erase_if(times, [&](double t) { return t >= late; });
      times.push_back(late);
    }
    Result run = run_with_rows(model, spec, times, !stops);
    found.undecided = first.report.undecided;
    Mechanics mechanics(model, engine::tolerance_of(model, spec).capture_velocity());
    mechanics.pass({0.0, model.u0, model.v0});
    for (const Result* rows : {&first, static_cast<const Result*>(&run)})
      for (const Result::Row& row : rows->rows) mechanics.pass({row.t, row.u, row.v});
    for (const Event& event : first.events) mechanics.pass(event);
    if (stops && run.rows.empty()) run.rows.push_back({0.0, model.u0, model.v0, {}, {}});
    if (!(stops && outcome.t == 0.0)) confirm(mechanics, run, found);
    if (stops && found.verdict == CoupledFinding::Verdict::agrees) explain(mechanics, run, found);
    if (outcome.kind == Outcome::Kind::stopped && !outcome.refusal) {
      found.verdict = CoupledFinding::Verdict::broken;
      found.t = outcome.t;
      found.cause = "no refusal";
      found.what = outcome.reason;
    }
  } catch (const SceneError& error) {
    found.verdict = CoupledFinding::Verdict::forbidden;
    found.what = error.what();
    found.cause = "scene";
  }
  return found;
}

}  // namespace signorini::differential
