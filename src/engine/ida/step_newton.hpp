// step_newton.hpp: Newton's method of a step of IDA, without what a linear problem makes twice.
//
//   F(t, y_p + e, y_p' + c_j e) = 0,   e := 0;   e := e - J^-1 F  until IDA's own test has converged
//
// With e = 0 F is taken at the predictor itself: SUNDIALS' own method adds the zero to both vectors first, keeps
// a copy of F, turns its sign, and clears and copies what is solved for. One iteration is the rule, as J is made
// anew with every c_j. J and its factors: engine/ida/ida_linear_solver.hpp; retries, counts and the test as in
// SUNDIALS (sunnonlinsol_newton.c). Where friction rises with a slip rate J is made anew with every iteration, too, and
// IDA's test, which takes corrections that do not shrink for divergence, is asked from where one is within the tolerance: on
// the way there they are one scale of slip rates each.
//
// While it rehearses, e is that of the polynomials of a jet: IDA then takes steps before the beginning of a segment, without
// a solve, and has a history of a higher order where it begins (bdf_integrator.hpp).
#pragma once

#include <sundials/sundials_nonlinearsolver.h>

#include "engine/ida/ida_problem.hpp"

namespace signorini {

class StepNewton {
 public:
  /// ida: the integrator, whose vectors are like `like`. problem has to outlive it.
  StepNewton(IdaProblem& problem, void* ida, N_Vector like, SUNContext context);
  ~StepNewton();
  StepNewton(const StepNewton&) = delete;
  StepNewton& operator=(const StepNewton&) = delete;

  /// For IDASetNonlinearSolver; owned here, freed after the integrator.
  [[nodiscard]] SUNNonlinearSolver solver() const { return solver_; }
  /// From now on the solutions are those of the jet's polynomials, whatever the equations say; null: of the equations
  /// again, with J made anew. The jet has to outlive that.
  void rehearse(const Jet* jet) {
    if (jet == nullptr) stale_ = true;
    jet_ = jet;
  }
  /// Evaluations of F so far.
  [[nodiscard]] long residuals() const { return residuals_; }

 private:
  int solve(N_Vector e, N_Vector weights, double tolerance, bool setup, void* memory);
  /// e of the jet's polynomials.
  int answer(N_Vector e);
  /// From e = 0. setup: J first.
  int iterate(N_Vector e, N_Vector weights, double tolerance, bool setup, bool doubtful, void* memory);
  [[nodiscard]] bool is_rounding(N_Vector weights, double tolerance) const;

  IdaProblem& problem_;
  void* ida_;
  SUNNonlinearSolver solver_;
  N_Vector change_;  // F, then the correction
  SUNNonlinSolLSetupFn setup_ = nullptr;
  SUNNonlinSolConvTestFn test_ = nullptr;
  void* test_data_ = nullptr;
  int most_iterations_ = 4, iteration_ = 0;
  long iterations_ = 0, failures_ = 0;  // of the last solve
  long residuals_ = 0;
  const Jet* jet_ = nullptr;
  bool stale_ = false;  // J is of another segment, or of none
};

}  // namespace signorini
