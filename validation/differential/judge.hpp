// judge.hpp: one scene through the engines, and what to think of it.
//
//   exact               the reference; ida at rtol 1e-11 where the friction is not linear (Stribeck)
//   ida 1e-10, 1e-7     delta = steps rtol: five times what steps spend that are to use a fifth of the
//                       tolerance, and all add up; the five is measured, not derived (README.md, limits
//                       chosen after looking)
//   newmark dt, dt/2    against its own difference, which at order 2 is three times the error that is left
//
// Verdicts, worst last:
//   agree               all events of all engines, with states and times as promised
//   stopped             the same, and all stopped at the same place for the same reason
//   unresolved          the same up to events that are closer together than 20 of their own uncertainties
//   ill-conditioned     the same up to where exact runs of neighbouring scenes part, whether this one
//                       parts or not
//   refused             the scene is refused
//   too long            a run was given up, and nothing was wrong until then
//   undecided           a promise is broken as far as it is known, but the scene's steps were spent before
//                       there were enough neighbours, or halvings, to say so
//   DISAGREE            a promise is broken, or an audit
#pragma once

#include <string>
#include <vector>

#include "differential/promise.hpp"
#include "signorini/scene.hpp"

namespace signorini::differential {

enum class Verdict { agree, stopped, unresolved, ill_conditioned, refused, too_long, undecided, disagree };
[[nodiscard]] const char* to_string(Verdict verdict);

struct JudgeSettings {
  long steps = 200000;           ///< a run may take (Bounds); newmark's are cheap, four times as many
  long engine_steps = 400000;    ///< an engine's runs and their neighbours, likewise
  double seconds = 30.0;         ///< a run may take, whatever its steps: a last resort
  double scene_seconds = 120.0;  ///< all runs of a scene
  double margin = 5.0;           ///< of delta: a step may be off by rtol, five times what it should spend
  int directions = 3;            ///< neighbours at first
  int more = 15;                 ///< and as many in all before a disagreement is stated
  int halvings = 5;              ///< of newmark's step before the same
  double tight = 1e-10, loose = 1e-7;
};

/// One engine beside the reference.
struct Comparison {
  std::string engine;
  Verdict verdict = Verdict::agree;
  double worst = 0.0;  ///< Finding::worst
  std::size_t aligned = 0;
  std::size_t sharp_times = 0, times = 0;  ///< Finding
  double until = 0.0;                      ///< to where run, reference and neighbours were compared
  bool to_end = false;                     ///< which is the end of the run
  std::string what;
};

struct Judgement {
  Verdict verdict = Verdict::agree;
  std::size_t events = 0;  ///< of the reference
  std::string what;        ///< the disagreement, the reason, the message
  std::vector<Comparison> comparisons;
};

[[nodiscard]] Judgement judge(const Scene& scene, const JudgeSettings& settings = {});

}  // namespace signorini::differential
