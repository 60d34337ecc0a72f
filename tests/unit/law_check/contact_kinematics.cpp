// law_check/contact_kinematics.hpp against law_check/contact_kinematics.hpp, on contacts, states and motions at random, along odd directions.
#include <doctest/doctest.h>

#include <algorithm>
#include <random>

#include "law_check/contact_kinematics.hpp"

using namespace signorini;

TEST_SUITE_BEGIN("unit/law_check/contact_kinematics");

namespace {

class Drawn {
 public:
  explicit Drawn(unsigned seed) : draw_(seed) {
    c.law = std::array{Law::compliant, Law::rigid, Law::slider}[seed % 3];
    if (!c.normal_force_given()) c.normal.terms = {{0, real()}, {2, real()}, {4, real()}};
    c.tangent.terms = {{1, real()}, {3, real()}};
    c.gap = real();
    if (c.normal_spring()) c.normal_stiffness = 40.0;
    if (c.normal_spring() && seed % 2 == 0) c.normal_damping = 3.0;
    if (c.normal_spring() || seed % 4 == 0) c.tangential_stiffness = 25.0;
    c.friction.kinetic = 0.35;
    c.friction.static_ = seed % 5 == 0 ? 0.5 : 0.35;
    if (seed % 7 == 0) c.friction.static_ = c.friction.kinetic = 0.0;
    for (Vector* x : {&u, &v, &a})
      for (double& value : *x) value = real();
    forces = Eigen::Vector2d(real(), 0.5 * real());
    driven = {{real(), real(), real(), std::abs(real()), real(), real()}};
    mode = {{states()[draw_() % states().size()], real()}};
  }

  /// N and T of the rows of its state, by hand.
  void put_in_rows() {
    const State state = mode[0].state;
    const law_check::Driven& d = driven[0];
    double& N = forces[0];
    if (c.normal_force_given())
      N = -d.q;
    else if (is_open(state))
      N = 0.0;
    else if (c.normal_spring())
      N = 40.0 * (c.gap + c.normal.dot(u)) + c.normal_damping * c.normal.dot(v);
    const int s = state == State::slip_plus ? 1 : state == State::slip_minus ? -1 : 0;
    forces[1] = s * c.friction.kinetic * -N;
    if (state == State::stick && c.tangential_stiffness)
      forces[1] = 25.0 * (c.tangent.dot(u) - d.s - mode[0].anchor);
    if (state == State::stick && !c.tangential_stiffness) {
      forces[1] = real();
      driven[0].ds = c.tangent.dot(v);
    }
  }
  [[nodiscard]] law_check::CheckedSide side() const {
    return {&u, &v, &a, &mode, &forces, ForceLayout(1), driven};
  }

  Contact c;
  Vector u = Vector::Zero(5), v = u, a = u, forces;
  std::vector<ContactState> mode;
  std::vector<law_check::Driven> driven;

 private:
  [[nodiscard]] std::vector<State> states() const {
    if (!c.has_friction()) return {State::open, State::closed};
    if (c.normal_force_given()) return {State::stick, State::slip_plus, State::slip_minus};
    return {State::open, State::inside, State::stick, State::slip_plus, State::slip_minus};
  }
  double real() { return std::uniform_real_distribution<double>(-1.0, 1.0)(draw_); }
  std::mt19937 draw_;
};

}  // namespace

TEST_CASE("guards stand where each of them, with all its terms, is positive") {
  int standing = 0, falling = 0;
  for (unsigned seed = 1; seed <= 3000; ++seed) {
    const Drawn drawn(seed);
    const law_check::GuardValues guards =
        law_check::guards_of(drawn.c, drawn.mode[0], law_check::kinematics(drawn.c, 0, drawn.side()), {});
    const bool all = std::all_of(guards.begin(), guards.end(),
                                 [](const law_check::GuardValue& guard) { return guard.value >= 0.0; });
    // Of a contact that may be inside it is not told.
    const bool stands = law_check::guards_are_satisfied(drawn.c, 0, drawn.mode[0], drawn.side());
    CAPTURE(seed);
    CHECK(stands == (all && drawn.mode[0].state != State::inside));
    ++(stands ? standing : falling);
  }
  CHECK(standing > 800);
  CHECK(falling > 800);
}

TEST_CASE("rows stand, and a force that is off by 1e-9 of itself does not") {
  for (unsigned seed = 1; seed <= 1000; ++seed) {
    Drawn drawn(seed);
    drawn.put_in_rows();
    CAPTURE(seed);
    CHECK(law_check::rows_are_satisfied(drawn.c, 0, drawn.mode[0], drawn.side(), 1e-12));
    const State state = drawn.mode[0].state;
    const bool of_rows_N = drawn.c.normal_force_given() || drawn.c.normal_spring() || is_open(state);
    const bool of_rows_T = state != State::stick || drawn.c.tangential_stiffness.has_value();
    for (const int force : {0, 1}) {
      if (!(force == 0 ? of_rows_N : of_rows_T)) continue;
      const double is = drawn.forces[force];
      drawn.forces[force] += 1e-9 * std::abs(is) + (is == 0.0 ? 1e-300 : 0.0);
      CHECK_FALSE(law_check::rows_are_satisfied(drawn.c, 0, drawn.mode[0], drawn.side(), 1e-12));
      drawn.forces[force] = is;
    }
    if (of_rows_T) continue;
    drawn.driven[0].ds += 1e-11;  // what sticks rigidly has the speed of its surface
    CHECK_FALSE(law_check::rows_are_satisfied(drawn.c, 0, drawn.mode[0], drawn.side(), 1e-12));
  }
}

TEST_SUITE_END();
