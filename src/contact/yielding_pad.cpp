#include "contact/yielding_pad.hpp"

namespace signorini {

OwnLaw yielding_pad(double normal_stiffness, double yield_force) {
  constexpr std::size_t off = 0, elastic = 1, crushed = 2;
  const double kn = normal_stiffness, Y = yield_force;
  const OwnForm no_friction{{.T = 1.0}}, spring{{.N = 1.0, .gap = -kn}, kn},
      yields{{.N = 1.0, .constant = Y}};
  const OwnForm above_dent{{.gap = 1.0}, -1.0}, presses{{.N = -1.0}}, sinks{{.vn = -1.0}};
  const Form dent{.gap = 1.0, .constant = Y / kn};
  OwnLaw law{"yielding", {}};
  law.states = {{"off", State::open, {{.N = 1.0}}, no_friction, {{above_dent, elastic}}},
                {"elastic", State::closed, spring, no_friction, {{presses, off}, {yields, crushed}}},
                // A slip: so files and pictures tell it from elastic.
                {"crushed", State::slip_minus, yields, no_friction, {{sinks, elastic, dent}}}};
  return law;
}

}  // namespace signorini
