// start_refinement.hpp: equilibrium of a start in given states of its contacts, to the rounding of its displacements.
//
//   R = P - K u - sum N n - sum T t                               residual.hpp
//   (K + sum kn n n^T + sum_stick kt t t^T) du = R,    n . du = -g at rigid contacts,   t . du = 0 where they stick
//   N = kn g,   T <- T + kt t . du in stick,   T = s f |N| in slip
//
// The steps repeat until they no longer shrink. If the contacts leave a motion without resistance, as slipping ones may,
// du does not contain it: a pin at a contact keeps its place.
#pragma once

#include <vector>

#include "signorini/model.hpp"

namespace signorini::statics {

/// State of one contact in the equations above. A contact that touches keeps its gap by a reaction, whatever its law.
struct HeldContact {
  enum class Normal : unsigned char { open, touching, closed } normal = Normal::open;
  bool sticks = false;
  int slips = 0;          ///< s
  double friction = 0.0;  ///< f, in slip
};

struct StartForces {
  Vector u;
  std::vector<double> N, T;  ///< one per contact; N of sliders is given
};

/// Refines the start. False, and `start` unchanged: some motion has no resistance and no contact, or the steps grow.
[[nodiscard]] bool refine_start(const SparseMatrix& k, const Vector& load,
                                const std::vector<Contact>& contacts, const std::vector<HeldContact>& held,
                                StartForces& start);

/// Unbalanced forces R of the start. size: receives the largest term.
[[nodiscard]] Vector unbalanced_forces(const SparseMatrix& k, const Vector& load,
                                       const std::vector<Contact>& contacts, const StartForces& start,
                                       double& size);

}  // namespace signorini::statics
