#include "contact/law/yielding_pad.hpp"

#include <fmt/core.h>

#include <cmath>

#include "base/text.hpp"

namespace signorini {

UserContactLaw yielding_pad(double normal_stiffness, double yield_force) {
  constexpr std::size_t off = 0, elastic = 1, crushed = 2;
  const double kn = normal_stiffness, Y = yield_force;
  const UserLawForm no_friction{{.T = 1.0}}, spring{{.N = 1.0, .gap = -kn}, kn},
      yields{{.N = 1.0, .constant = Y}};
  const UserLawForm above_dent{{.gap = 1.0}, -1.0}, presses{{.N = -1.0}}, sinks{{.vn = -1.0}};
  const Form dent{.gap = 1.0, .constant = Y / kn};
  UserContactLaw law{"yielding", {}};
  law.states = {{"off", State::open, {{.N = 1.0}}, no_friction, {{above_dent, elastic}}},
                {"elastic", State::closed, spring, no_friction, {{presses, off}, {yields, crushed}}},
                // The kind is slip, so that files and pictures can distinguish `crushed` from `elastic`.
                {"crushed", State::slip_minus, yields, no_friction, {{sinks, elastic, dent}}}};
  return law;
}

const DataLaw& yielding_law() {
  static const DataLaw law{
      "yielding",
      "a spring that yields and keeps a dent, without friction, engine \"ida\"",
      {{"yield_force", "force",
        "Compressive force at which a contact with law = \"yielding\" yields; required for this law."}},
      [](double kn, const std::vector<double>& constants) { return yielding_pad(kn, constants[0]); },
      [](double kn,
         const std::vector<double>& constants) -> std::optional<std::pair<std::string_view, std::string>> {
        const double deflection = constants[0] / kn;
        if (std::isnormal(deflection)) return std::nullopt;
        return std::pair{
            std::string_view("yield_force"),
            fmt::format("found {}, so the deflection at yield, yield_force / normal_stiffness, is {}; "
                        "expected a force > 0 whose deflection is within the range of doubles",
                        base::format_number(constants[0]), base::format_number(deflection))};
      }};
  return law;
}

}  // namespace signorini
