// A contact law as a class: a magnet, which holds like a spring until it is pulled with its strength.
//
//   holds   N = k g   while   A - N > 0          k: stiffness, A: strength
//   off     N = 0     while   g > 0
#include <signorini/simulate.hpp>

#include <cmath>
#include <cstdio>

using namespace signorini;

namespace {

class Magnet : public ContactLaw {
 public:
  Magnet(double stiffness, double strength)
      : ContactLaw({.normal_spring = true, .signorini_coulomb = false, .tangents = 0}),
        stiffness_(stiffness),
        strength_(strength) {}

  std::string name() const override { return "magnet"; }
  std::vector<State> user_law_states() const override { return {holds, off}; }

  Rows rows(const Contact& /*contact*/, const ContactState& now) const override {
    return {{.N = 1.0, .gap = now.state == holds ? -stiffness_ : 0.0}, {.T = 1.0}};
  }
  Guards guards(const Contact& /*contact*/, const ContactState& now) const override {
    const Form margin{.N = -1.0, .constant = strength_}, gap{.gap = 1.0};
    return {GuardForm{Guard::user_1, now.state == holds ? margin : gap}};
  }
  ContactState next_state(const Contact& /*contact*/, const ContactState& now, Guard /*failed*/,
                          const MotionJet& /*jet*/) const override {
    return {now.state == holds ? off : holds};
  }
  // A run has its own units, in which it needs these numbers.
  std::shared_ptr<const ContactLaw> with_constants(const VisitConstant& visit) const override {
    auto copy = std::make_shared<Magnet>(stiffness_, strength_);
    visit(copy->stiffness_, Unit{1, -1, 0});  // force / length
    visit(copy->strength_, Unit{1, 0, 0});
    return copy;
  }

 private:
  static constexpr State holds = user_law_state(0, State::closed), off = user_law_state(1, State::open);
  double stiffness_, strength_;
};

}  // namespace

int main() {
  const double k = 400.0, A = 3.0, m = 2.0, rate = 5.0;  // the force on the mass is rate times t
  Scene scene = parse_scene(R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
run = { t_end = 1.0, rtol = 1e-10, initial = {} }
nodes = { block = [0.0, 0.0] }
masses = [{ node = "block", mass = 2.0 }]
contacts = [{ name = "magnet", node = "block", law = "compliant", normal = [0.0, 1.0], normal_stiffness = 400.0 }]
loads = [{ node = "block", direction = [0.0, 1.0], amplitude = 1.0, history = { type = "polynomial", coefficients = [0.0, 5.0], start = 0.0 } }]
)",
                            "in code");
  scene.contacts[0].user_law = std::make_shared<Magnet>(k, A);
  const Result result = simulate(scene);
  for (const Event& e : result.events)
    std::printf("%.9f  %s -> %s\n", e.t, to_string(e.from), to_string(e.to));
  // While it holds, g = (rate / k) (t - sin(w t) / w); it lets go when k g = A.
  const double w = std::sqrt(k / m);
  const auto force = [&](double t) { return rate * (t - std::sin(w * t) / w); };
  std::printf("force at the release %.9f N, strength %g N\n", force(result.events.back().t), A);
  return result.events.size() == 1 && std::abs(force(result.events[0].t) - A) < 1e-7 ? 0 : 1;
}
