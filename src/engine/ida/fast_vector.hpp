// fast_vector.hpp: SUNDIALS' serial vector with its most frequent operations in loops that the compiler
// vectorises.
//
//   z = sum_i c_i x_i,   z = a x + b y,   z = c x,   z = c,   ||x||_wrms = sqrt( sum (x w)^2 / n )
//   x_k += x_(k+1) for k = q .. 0, the update of IDA's differences, in one pass over all of them
//
// Such operations take three quarters of the time of an IDA step on a frame. The packaged library computes
// them one number at a time, and its fused operations one vector at a time.
#pragma once

#include <sundials/sundials_nvector.h>

namespace signorini::ida {

/// A new serial vector whose clones inherit the operations; free with N_VDestroy.
[[nodiscard]] N_Vector make_vector(sunindextype size, SUNContext context);

}  // namespace signorini::ida
