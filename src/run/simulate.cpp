// The loop: advance -> decide -> apply -> record.
#include "signorini/simulate.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "engine/tolerance.hpp"
#include "motion/clock.hpp"
#include "run/audit.hpp"
#include "run/breakpoints.hpp"
#include "run/choose_engine.hpp"
#include "run/make_stepper.hpp"
#include "run/refusals.hpp"

namespace signorini {
namespace {

std::optional<EventType> classify(State from, State to, bool dropped) {
  if (from == to) return dropped ? std::optional(EventType::slip) : std::nullopt;
  if (to == State::open) return EventType::separation;
  if (from == State::open) return EventType::contact;
  if (slip_sign(from) != 0 && slip_sign(to) != 0) return EventType::reversal;
  return slip_sign(to) != 0 ? EventType::slip : EventType::stick;
}

// A bouncing ball with e = 0.99 passes its accumulation point with 2000 events; an e = 0.999 takes 20000, in
// a time that is no longer short.
constexpr int watched_events = 10000;
constexpr double least_progress = 1e-5;  // of the run, in so many events
constexpr double much_energy = 1e-3;     // of what is exchanged, that the balance may miss without a word
constexpr double least_energy = 1e-9;    // of the scene's scales
constexpr int most_unordered = 5;        // warnings about one and the same thing

class Run {
 public:
  Run(const Model& model, const RunSpec& spec, Settings settings, Recorder& recorder)
      : model_(model),
        spec_(spec),
        recorder_(recorder),
        structure_(model),
        systems_(model, structure_),
        decider_(systems_, spec.max_events_at_once, settings.capture_velocity),
        auditor_(model, structure_),
        grid_(spec.grid()),
        forcing_(model, 0.0, Side::after),
        breakpoints_(breakpoints(model, spec.t_end)) {
    stepper_ = make_stepper(model, structure_, systems_, spec, settings);
    report_.settings = std::move(settings);
  }

  Report go() {
    const auto clock = std::chrono::steady_clock::now();
    if (begin())
      while (t_ < spec_.t_end && segment()) {
      }
    report_.outcome.t = t_;
    stepper_->count();
    report_.counters = stepper_->counters;
    report_.counters.time_events = time_events_;
    if (unordered_ > most_unordered)
      report_.warnings.push_back(
          fmt::format("{} more pairs of events whose order is not determined", unordered_ - most_unordered));
    report_.warnings.insert(report_.warnings.end(), stepper_->warnings.begin(), stepper_->warnings.end());
    auditor_.finish(report_, last_energy_, t_, decision_.mode);
    const Audit& audit = report_.audit;
    // At rest nothing is exchanged but rounding.
    const double moving = least_energy * audit.force_scale * audit.length_scale;
    if (audit.energy.value > much_energy * audit.energy_scale && audit.energy.value > moving)
      report_.warnings.push_back(fmt::format(
          "the energy balance is off by {:.2g} of what was exchanged (at t = {:.6g}); use {}, or "
          "engine \"exact\"",
          audit.energy.value / audit.energy_scale, audit.energy.t,
          report_.settings.dt > 0.0 ? "a smaller run.dt" : "a tighter rtol, an atol that fits the motion"));
    report_.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
    return report_;
  }

 private:
  bool stop(const std::string& reason, Outcome::Kind kind = Outcome::Kind::stopped) {
    report_.outcome.kind = kind;
    report_.outcome.reason = reason;
    return false;
  }

  bool begin() {
    Instant instant;
    instant.u = model_.u0;
    instant.v = model_.v0;
    instant.resolution = resolution_at(0.0, 0.0);
    instant.start = true;
    instant.mode = first_mode(model_, forcing_, 0.0, model_.u0, model_.v0);
    const Mode first = instant.mode;
    decision_ = decider_.decide(std::move(instant), forcing_, forcing_);
    if (!decision_.consistent) return stop(decision_.reason);
    warn_of_cut_shear();
    warn_of_gain();
    auditor_.begin(decision_, first, forcing_);
    for (std::size_t k = 0; k < first.size(); ++k)
      if (hit(k)) log_contact(k, EventType::impact, first[k].state);
    point_ = {decision_.u, decision_.v, decision_.jet.forces.col(0), decision_.jet.a()};
    last_energy_ = auditor_.energy(0.0, decision_.mode, point_);
    auditor_.observe(forcing_, 0.0, decision_.mode, point_);
    record_at(0.0);
    return true;
  }

  /// An initial_shear beyond the friction limit cannot stand; what is left of it is said.
  void warn_of_cut_shear() {
    for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
      const double asked = model_.contacts[k].initial_shear, found = decision_.after[k].T;
      if (!decision_.visited[k] || !decision_.jumped[k] || std::abs(found) >= std::abs(asked)) continue;
      report_.warnings.push_back(fmt::format(
          "contact '{}': initial_shear = {:.6g} is above the friction limit at t = 0; T starts at {:.6g}",
          model_.contacts[k].name, asked, found));
    }
  }

  void warn_of_gain() {
    if (!decision_.impact_gains || ++gains_ > most_unordered) return;
    report_.warnings.push_back(
        fmt::format("the impact at {:.9g} gains the energy {:.4g}: Newton's law of restitution with friction "
                    "does that at times",
                    t_, -decision_.impact_loss));
  }

  /// From a restart to the next event or discontinuity. False: the run ends.
  bool segment() {
    const bool at_breakpoint = next_breakpoint_ < breakpoints_.size();
    const double end = at_breakpoint ? breakpoints_[next_breakpoint_].time : spec_.t_end;
    stepper_->start({end, &decision_, &forcing_});
    for (;;) {
      Step step = stepper_->advance();
      if (step.kind == Step::Kind::failed) return stop(step.reason);
      resolution_ = step.resolution;
      record_between(step.begin, step.end);
      for (const double t : stepper_->turning_points()) {
        stepper_->evaluate(t, point_);
        auditor_.observe(forcing_, t, decision_.mode, point_);
      }
      t_ = step.end;
      stepper_->evaluate(t_, point_);
      if (step.kind == Step::Kind::event) return instant(std::move(step.fired), std::move(step.adopted));
      auditor_.observe(forcing_, t_, decision_.mode, point_);
      if (audit_due_) {
        auditor_.equilibrium(t_, stepper_->residual());
        audit_due_ = false;
      }
      if (!recorder_.progress(t_)) return stop("interrupted", Outcome::Kind::interrupted);
      if (step.end >= end) return instant({});
    }
  }

  /// Decides the states at t_, applies and records them.
  bool instant(std::vector<Fired> fired, std::optional<Mode> adopted = std::nullopt) {
    Instant now;
    now.t = t_;
    now.resolution = resolution_;
    now.u = point_.u;
    now.v = point_.v;
    now.mode = decision_.mode;
    now.fired = std::move(fired);
    bool jump = false;
    // States that an engine found itself come first; a breakpoint at the same time is the next instant.
    while (!adopted && next_breakpoint_ < breakpoints_.size() &&
           breakpoints_[next_breakpoint_].time - t_ <= resolution_) {
      now.jump = true;
      jump = jump || breakpoints_[next_breakpoint_].jump;
      now.t = t_ = breakpoints_[next_breakpoint_].time;
      ++next_breakpoint_;
    }
    if (!recorder_.progress(t_)) return stop("interrupted", Outcome::Kind::interrupted);
    if (!count_instant(now)) return false;
    std::optional<Forcing> before;
    if (now.jump) before = std::exchange(forcing_, Forcing(model_, t_, Side::after));
    const Mode old_mode = decision_.mode;
    Decision next = adopted ? decider_.adopt(now, *adopted, forcing_)
                            : decider_.decide(std::move(now), before ? *before : forcing_, forcing_);
    if (!next.consistent) {
      last_energy_ = auditor_.energy(t_, decision_.mode, point_);
      return stop(next.reason);
    }
    auditor_.instant(t_, next, old_mode, point_, jump);
    decision_ = std::move(next);
    warn_of_gain();
    log(old_mode, jump);
    point_ = {decision_.u, decision_.v, decision_.jet.forces.col(0), decision_.jet.a()};
    auditor_.observe(forcing_, t_, decision_.mode, point_);
    last_energy_ = auditor_.energy(t_, decision_.mode, point_);
    record_at(t_);
    return true;
  }

  /// Many events are no fault, many events in no time are.
  bool progresses(const Instant& now) {
    if (++since_mark_ < watched_events) return true;
    const double advanced = t_ - mark_;
    since_mark_ = 0;
    mark_ = t_;
    if (advanced >= least_progress * spec_.t_end) return true;
    return stop(fmt::format("{} events within {:.3g} of time; the motion does not get on; last: {}",
                            watched_events, advanced, names_of(model_, now.fired)));
  }

  /// A bound on decisions at (almost) one instant.
  bool count_instant(const Instant& now) {
    if (!progresses(now)) return false;
    if (instants_ == 0 || t_ - cluster_ > 10.0 * resolution_) {
      cluster_ = t_;
      instants_ = 0;
    }
    if (++instants_ <= spec_.max_events_at_once) return true;
    return stop(fmt::format("{} events at one instant; time does not advance; last: {}",
                            spec_.max_events_at_once, names_of(model_, now.fired)));
  }

  void log(const Mode& old_mode, bool jump) {
    if (jump) {
      ++time_events_;
      ++report_.events_by_type[to_string(EventType::time)];
      Event event;
      event.t = t_;
      recorder_.event(event);
      if (last_.contact >= 0 && t_ - last_.t < *last_.t_uncertainty)
        warn_of_order(fmt::format("the event of '{}' at {:.12g} and the jump of a load at {:.12g}",
                                  model_.contacts[static_cast<std::size_t>(last_.contact)].name, last_.t,
                                  t_));
    }
    for (std::size_t k = 0; k < old_mode.size(); ++k) {
      const State from = state_of_rows(old_mode[k].state), to = state_of_rows(decision_.mode[k].state);
      const bool dropped = from == State::stick && decision_.visited[k] && decision_.jumped[k] &&
                           !model_.contacts[k].takes_impulses();
      auto type = hit(k) ? std::optional(EventType::impact) : classify(from, to, dropped);
      if (!type && jump && decision_.jumped[k]) type = EventType::time;
      if (type) log_contact(k, *type, from);
    }
  }

  [[nodiscard]] bool hit(std::size_t k) const {
    return !decision_.impulses.empty() && decision_.impulses[k].hit;
  }

  /// A row of one contact, from what the decision knows.
  void log_contact(std::size_t k, EventType type, State from) {
    if (type != EventType::time) ++report_.events_by_type[to_string(type)];
    const ContactMotion &before = decision_.before[k], &after = decision_.after[k];
    Event event;
    event.t = t_;
    event.contact = static_cast<int>(k);
    event.type = type;
    event.from = from;
    event.to = state_of_rows(decision_.mode[k].state);
    if (hit(k)) {
      event.impulse_n = decision_.impulses[k].normal;
      event.impulse_t = decision_.impulses[k].tangent;
    }
    event.gap = after.gap;
    event.N = before.N;
    event.T = before.T;
    event.N_after = after.N;
    event.T_after = after.T;
    event.vn = before.vn;
    event.vn_after = after.vn;
    event.vt = decision_.slides_before[k].vt;
    event.vt_after = decision_.slides_after[k].vt;
    add_conditioning(k, event);
    recorder_.event(event);
  }

  void warn_of_order(const std::string& which) {
    if (++unordered_ <= most_unordered)
      report_.warnings.push_back("the order of " + which +
                                 " is not determined at this precision (t_uncertainty in events.csv)");
  }

  /// How sharp the time of an event is, and whether its order among the others is.
  void add_conditioning(std::size_t k, Event& event) {
    const Crossing& crossing = decision_.crossings[k];
    if (!crossing.failed) return;
    event.guard_rate = crossing.derivatives[0];
    const double error =
        std::max(crossing.noise, stepper_->guard_error(crossing.form, decision_.before[k], k));
    double off = std::numeric_limits<double>::infinity(), factorial = 1.0;
    for (std::size_t m = 0; m < crossing.derivatives.size(); ++m) {
      const auto order = static_cast<double>(m + 1);
      factorial *= order;
      if (const double d = std::abs(crossing.derivatives[m]); d > 0.0)
        off = std::min(off, std::pow(factorial * error / d, 1.0 / order));
    }
    if (!std::isfinite(off)) return;
    event.t_uncertainty = std::max(off, resolution_);
    if (last_.contact >= 0 && last_.contact != event.contact && event.t - last_.t > resolution_ &&
        event.t - last_.t < *last_.t_uncertainty + *event.t_uncertainty)
      warn_of_order(fmt::format("the events of '{}' at {:.12g} and of '{}' at {:.12g}",
                                model_.contacts[static_cast<std::size_t>(last_.contact)].name, last_.t,
                                model_.contacts[k].name, event.t));
    last_ = event;
  }

  [[nodiscard]] Sample sample(double t, const Point& point) {
    Sample result;
    result.t = t;
    result.u = &point.u;
    result.v = &point.v;
    if (model_.reduction) {
      physical_u_ = model_.reduction->physical(point.u);
      physical_v_ = model_.reduction->physical(point.v);
      result.u = &physical_u_;
      result.v = &physical_v_;
    }
    for (std::size_t k = 0; k < model_.contacts.size(); ++k)
      result.contacts.push_back(auditor_.sample(k, forcing_, t, decision_.mode[k], point));
    result.energy = auditor_.energy(t, decision_.mode, point);
    return result;
  }

  /// The next time of the grid or of a frame.
  [[nodiscard]] double next_record() const {
    constexpr double never = std::numeric_limits<double>::infinity();
    return std::min(next_output_ < grid_.size() ? grid_[next_output_] : never,
                    next_frame_ < spec_.frames.size() ? spec_.frames[next_frame_] : never);
  }

  void emit(double t, const Point& point) {
    const Sample now = sample(t, point);
    if (next_output_ < grid_.size() && grid_[next_output_] == t) {
      recorder_.sample(now);
      ++next_output_;
    }
    if (next_frame_ < spec_.frames.size() && spec_.frames[next_frame_] == t) {
      recorder_.frame(now);
      ++next_frame_;
    }
    audit_due_ = true;
  }

  /// Records inside the last step, and the works up to its end.
  void record_between(double begin, double end) {
    double from = begin;
    const auto integrate_to = [&](double t) {
      works_.clear();
      stepper_->integrate(from, t, works_);
      auditor_.add(works_);
      from = t;
    };
    for (double t = next_record(); t < end; t = next_record()) {
      Point point;
      stepper_->evaluate(t, point);
      integrate_to(t);
      emit(t, point);
    }
    integrate_to(end);
  }

  /// The time t itself, with the values after everything at that instant.
  void record_at(double t) {
    if (const double next = next_record(); next <= t) emit(next, point_);
  }

  const Model& model_;
  const RunSpec& spec_;
  Recorder& recorder_;
  Structure structure_;
  ModeSystems systems_;
  Decider decider_;
  Auditor auditor_;
  std::vector<double> grid_;
  Forcing forcing_;
  std::vector<Breakpoint> breakpoints_;
  std::unique_ptr<Stepper> stepper_;
  Decision decision_;
  Point point_;
  Vector physical_u_, physical_v_;  // of a reduced model, for the recorder
  Works works_{model_.contacts.size()};
  Report report_;
  Energy last_energy_;
  double t_ = 0.0, resolution_ = 0.0, cluster_ = 0.0;
  Event last_;  // with a contact whose guard fell
  int unordered_ = 0, gains_ = 0;
  int instants_ = 0, since_mark_ = 0;
  double mark_ = 0.0;  // time of the last look at progress
  std::size_t next_breakpoint_ = 0, next_output_ = 0, next_frame_ = 0;
  bool audit_due_ = false;
  long time_events_ = 0;
};

}  // namespace

Report simulate(const Model& model, const RunSpec& settings, Recorder& recorder) {
  const EngineChoice choice = choose_engine(model, settings);
  RunSpec spec = settings;
  spec.engine = choice.engine;
  refuse_what_engine_cannot(model, spec);
  Settings run = settings_for(model, spec);
  run.engine_reason = choice.reason;
  return Run(model, spec, std::move(run), recorder).go();
}

Result simulate(const Model& model, const RunSpec& settings) {
  Result result;
  result.report = simulate(model, settings, result);
  return result;
}

}  // namespace signorini
