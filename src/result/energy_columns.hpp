// energy_columns.hpp: the energies by name, for energy.csv and summary.json.
#pragma once

#include <array>

#include "signorini/result.hpp"

namespace signorini {

struct EnergyColumn {
  const char* name;
  double Energy::*value;
};

/// All but `balance`, which follows from them.
inline constexpr std::array energy_columns = {
    EnergyColumn{"kinetic", &Energy::kinetic},   EnergyColumn{"elastic", &Energy::elastic},
    EnergyColumn{"contact", &Energy::contact},   EnergyColumn{"damping", &Energy::damping},
    EnergyColumn{"friction", &Energy::friction}, EnergyColumn{"impact", &Energy::impact},
    EnergyColumn{"loads", &Energy::loads},       EnergyColumn{"surface", &Energy::surface},
};
inline constexpr const char* balance_column = "balance";

}  // namespace signorini
