// undamped.hpp: separates massless motions without damping from damped massless degrees of freedom.
//
//   C_mm z = 0, z_p = 1:    u_i = u'_i + z_i u'_p,   u_p = u'_p          u = B u'
//
// beta K damps the bars of a massless frame, but not its rotation as a rigid body about the point with mass. Such a
// motion follows forces immediately, others with time constants; for integration each needs its own degree of freedom.
// With u' the row and the column of p vanish from C; K and the forms of contacts and loads follow (B^T K B, B^T n), M
// is zero there.
#pragma once

#include "signorini/model.hpp"

namespace signorini {

/// Sets Model::basis if needed. The model must be complete, neither reduced nor with shear elements yet.
void separate_undamped(Model& model);

}  // namespace signorini
