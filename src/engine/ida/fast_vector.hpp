// fast_vector.hpp: SUNDIALS' serial vector, with the most frequent operations in loops that the compiler can vectorise.
//
//   z = sum_i c_i x_i,   z = a x + b y,   z = c x,   z = c,   ||x||_wrms = sqrt( sum (x w)^2 / n )
//   x_k += x_(k+1) for k = q .. 0, the update of IDA's divided differences, in one pass over all vectors
//
// Reason: with the packaged library, these operations take three quarters of the time of an IDA step on a frame, because the
// library computes one number at a time, and its fused operations read one vector at a time.
#pragma once

#include <sundials/sundials_nvector.h>

namespace signorini::ida {

/// Creates a serial vector with these operations; its clones have them, too. The caller frees the vector with N_VDestroy.
[[nodiscard]] N_Vector make_vector(sunindextype size, SUNContext context);

}  // namespace signorini::ida
