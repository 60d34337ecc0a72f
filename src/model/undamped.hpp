// undamped.hpp: massless motions that no damper resists, where the degrees of freedom that they consist of
// are damped.
//
//   C_mm z = 0, z_p = 1:    u_i = u'_i + z_i u'_p,   u_p = u'_p          u = B u'
//
// beta K damps the bars of a massless frame, but not its rotation as one body about the point that has mass.
// Such a motion follows forces at once, the others with time constants of their own; to be integrated each
// needs its own degree of freedom. With u' the row and the column of p vanish from C; K and the forms of
// contacts and loads follow (B^T K B, B^T n), M is zero there.
#pragma once

#include "signorini/model.hpp"

namespace signorini {

/// Puts Model::basis where it is needed. A complete model, neither reduced nor with shear elements yet.
void separate_undamped(Model& model);

}  // namespace signorini
