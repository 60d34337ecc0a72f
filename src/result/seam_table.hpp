// seam_table.hpp: seams.csv, the resultants of seams at the output times.
//
//   N = sum N_k,   T = sum T_k,   moment = sum (x_k - x_m) x (-N_k n_k - T_k t_k),   x_m = sum D_k x_k / sum D_k
//   stick, slip, open: sums of D_k
//
// Forces act on the slave; units: force, force * length, length. Positions are undeformed.
#pragma once

#include <string>

#include "result/table.hpp"
#include "signorini/result.hpp"
#include "signorini/scene.hpp"

namespace signorini {

struct SeamRow {
  double t = 0.0;
  std::string seam;
  double N = 0.0, T = 0.0, moment = 0.0;
  double stick = 0.0, slip = 0.0, open = 0.0;
};

[[nodiscard]] const CsvTable<SeamRow>& seam_table();
/// contacts: one per contact of the scene.
[[nodiscard]] SeamRow seam_row(const SeamSpec& seam, double t, const std::vector<ContactSample>& contacts);

}  // namespace signorini
