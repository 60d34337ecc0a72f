// parts.hpp: the SUNDIALS objects that every integrator holds, freed after its own memory.
#pragma once

#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

namespace signorini::esdirk {

struct Parts {
  Parts() { SUNContext_Create(nullptr, &context); }
  ~Parts() {
    SUNLinSolFree(solver);
    SUNMatDestroy(matrix);
    SUNContext_Free(&context);
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  SUNContext context = nullptr;
  SUNMatrix matrix = nullptr;
  SUNLinearSolver solver = nullptr;
};

}  // namespace signorini::esdirk
