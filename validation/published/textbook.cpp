// Closed forms of the textbooks: the bouncing ball, the block on a belt.
//
//   ball: hit n (from 0) at sqrt(2 h/g) (1 + 2 e + ... + 2 e^n), rest at sqrt(2 h/g) (1 + e)/(1 - e)
//   belt, m = k = N = 1: carried for 2 d/v, back for 2 (pi - atan(d/v)), d = fs - fk; here d/v = 5/2
#include "published/formulas.hpp"
#include "published/runs.hpp"

namespace signorini::published {
namespace {

std::vector<Figure> ball_figures() {
  const Real first = std::sqrt(2 / 9.81L), e = 0.8L;
  Real tenth = first, bounce = first;
  for (int n = 1; n < 10; ++n) tenth += 2 * (bounce *= e);
  return {{"hit 10, s", "", tenth}, {"rests, s", "", first * (1 + e) / (1 - e)}};
}

std::vector<double> ball(const Settings& settings) {
  const Result r = run("ball.toml", settings);
  const bool rests = !r.events.empty() && r.events.back().to == State::closed;
  return {time_of(r, EventType::impact, 9), rests ? r.events.back().t : missing};
}

std::vector<Figure> belt_figures() {
  return {{"period, pi + 2 atan 0.4 + 5, s", "", pi + 2 * std::atan(0.4L) + 5},
          {"of it carried along, s", "", 5}};
}

std::vector<double> belt(const Settings& settings) {
  const Result r = run(SIGNORINI_MODELS "/belt.toml", settings);
  const Event *a = nth(r, EventType::slip, 2), *b = nth(r, EventType::slip, 3);
  if (!a || !b) return {missing, missing};
  double caught = missing;
  for (const Event& e : r.events)
    if (e.type == EventType::stick && e.t < b->t) caught = e.t;
  return {b->t - a->t, b->t - caught};
}

}  // namespace

std::vector<Case> textbook() {
  return {{"bouncing ball", "textbooks", 1e-3, 1e-6, 1e-9, ball_figures, ball},
          {"belt", "textbooks (models/belt.toml)", 1e-3, 1e-6, 1e-6, belt_figures, belt}};
}

}  // namespace signorini::published
