// A built-in law with another guard: the friction limit of a slider as one guard, F^2 - T^2 > 0, in place of F - T > 0 and
// F + T > 0. The events are those of the built-in slider.
#include <signorini/modified_law.hpp>
#include <signorini/simulate.hpp>

#include <cmath>
#include <cstdio>

using namespace signorini;

namespace {

class DiscLaw : public ModifiedLaw {
 public:
  DiscLaw() : ModifiedLaw(Law::slider, false) {}

  std::string name() const override { return "disc"; }
  Guards guards(const Contact& contact, const ContactState& now) const override {
    const Guards linear = base().guards(contact, now);
    if (now.state != State::stick) return linear;
    const std::vector<FormProduct> product = {{linear[1].form, linear[2].form}};  // (F - T) (F + T)
    return {GuardForm{Guard::friction_limit, {}, std::make_shared<const std::vector<FormProduct>>(product)}};
  }
};

}  // namespace

int main() {
  Scene scene = parse_scene(R"(schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }
run = { t_end = 2.0, engine = "exact", initial = {} }
nodes = { block = [0.0, 0.0] }
masses = [{ node = "block", mass = 1.0 }]
supports = [{ node = "block", fix = ["uy", "rz"] }]
springs = [{ node = "block", direction = [1.0, 0.0], stiffness = 60.0 }]
contacts = [{ name = "p", node = "block", law = "slider", tangent = [1.0, 0.0], normal_force = 10.0, friction = 0.4 }]
loads = [{ node = "block", direction = [1.0, 0.0], amplitude = 9.0, history = { type = "harmonic", omega = 11.0 } }]
)",
                            "in code");
  const Result linear = simulate(scene);
  scene.contacts[0].user_law = std::make_shared<DiscLaw>();
  const Result disc = simulate(scene);
  double off = linear.events.size() == disc.events.size() ? 0.0 : 1.0;
  for (std::size_t i = 0; i < disc.events.size() && off < 1.0; ++i) {
    std::printf("%.12f  %s\n", disc.events[i].t, to_string(disc.events[i].type));
    off = std::max(off, std::abs(disc.events[i].t - linear.events[i].t));
  }
  return !disc.events.empty() && off < 1e-12 ? 0 : 1;
}
