// step_newton.hpp: Newton's method for a step of IDA, without redundant operations for a linear problem.
//
//   F(t, y_p + e, y_p' + c_j e) = 0,   e := 0;   e := e - J^-1 F  until IDA's own test has converged
//
// F is first evaluated at the prediction y_p, y_p'. The Newton solver of SUNDIALS is slower: it adds e = 0 to both vectors,
// copies F, changes the sign of F, and clears and copies e. Usually one iteration is enough, because J is computed anew for
// every c_j. See engine/ida/ida_linear_solver.hpp for J and its factors. Retries, counts and the convergence test are those of
// SUNDIALS (sunnonlinsol_newton.c).
//
// If friction rises with a slip rate, J is computed anew in every iteration. A correction may then be as large as the previous
// correction (up to one slip-rate scale of the friction law), which IDA's test would regard as divergence. So the test is
// applied only after the first correction within the tolerance.
//
// With a prescribed jet, e is computed from the jet's polynomials and no equations are solved. Steps of this kind before a
// segment give IDA a history of a higher order (restart_order.hpp).
#pragma once

#include <sundials/sundials_nonlinearsolver.h>

#include "engine/ida/ida_problem.hpp"

namespace signorini::ida {

class StepNewton {
 public:
  /// ida: memory of the integrator. like: a vector of the size of y, which is cloned. problem must outlive the object.
  StepNewton(IdaProblem& problem, void* ida, N_Vector like, SUNContext context);
  ~StepNewton();
  StepNewton(const StepNewton&) = delete;
  StepNewton& operator=(const StepNewton&) = delete;

  /// Argument for IDASetNonlinearSolver. This object owns the solver and must be destroyed after IDAFree.
  [[nodiscard]] SUNNonlinearSolver solver() const { return solver_; }
  /// Prescribes the jet's polynomials as the solutions of all following steps. Null: following steps solve the equations, with
  /// a new J. The jet must stay valid until the next call.
  void prescribe_jet(const motion::Jet* jet) {
    if (jet == nullptr) stale_ = true;
    jet_ = jet;
  }
  /// Number of evaluations of F so far.
  [[nodiscard]] long residuals() const { return residuals_; }

 private:
  int solve(N_Vector e, N_Vector weights, double tolerance, bool setup, void* memory);
  /// Sets e from the jet's polynomials.
  int solve_from_jet(N_Vector e);
  /// Iterates from e = 0. setup: compute J first. doubtful: an iteration with an earlier J has failed (for IDA's setup
  /// function).
  int iterate(N_Vector e, N_Vector weights, double tolerance, bool setup, bool doubtful, void* memory);
  [[nodiscard]] bool is_rounding(N_Vector weights, double tolerance) const;

  IdaProblem& problem_;
  void* ida_;
  SUNNonlinearSolver solver_;
  N_Vector change_;  // F, then the correction
  SUNNonlinSolLSetupFn setup_ = nullptr;
  SUNNonlinSolConvTestFn test_ = nullptr;
  void* test_data_ = nullptr;
  int max_iterations_ = 4, iteration_ = 0;
  long iterations_ = 0, failures_ = 0;  // counts of the last solve
  long residuals_ = 0;
  const motion::Jet* jet_ = nullptr;
  bool stale_ = false;  // J belongs to another segment, or does not exist
};

}  // namespace signorini::ida
