// fast_vector.hpp: SUNDIALS' serial vector with its hot operations in loops that the compiler vectorises.
//
//   z = sum_i c_i x_i,   z = a x + b y,   z = c x,   ||x||_wrms = sqrt( sum (x w)^2 / n )
//
// Three quarters of an IDA step on a frame are such operations; the packaged library runs them one
// number at a time.
#pragma once

#include <sundials/sundials_nvector.h>

namespace signorini {

/// A new serial vector whose clones inherit the operations; free with N_VDestroy.
[[nodiscard]] N_Vector make_vector(sunindextype size, SUNContext context);

}  // namespace signorini
