#include "engine/ida/step_newton.hpp"

#include <ida/ida.h>
#include <nvector/nvector_serial.h>

#include <utility>

namespace signorini::ida {
namespace {

// Limit of the number of additional iterations if friction rises with the slip rate. Each iteration approaches the solution by
// up to one slip-rate scale of the friction law; at this number of scales, friction is constant to all digits.
constexpr int max_extra_iterations = 40;

StepNewton& newton_of(SUNNonlinearSolver solver) { return *static_cast<StepNewton*>(solver->content); }

}  // namespace

StepNewton::StepNewton(IdaProblem& problem, void* ida, N_Vector like, SUNContext context)
    : problem_(problem), ida_(ida), solver_(SUNNonlinSolNewEmpty(context)), change_(N_VClone(like)) {
  solver_->content = this;
  SUNNonlinearSolver_Ops ops = solver_->ops;
  ops->gettype = [](SUNNonlinearSolver) { return SUNNONLINEARSOLVER_ROOTFIND; };
  ops->solve = [](SUNNonlinearSolver s, N_Vector, N_Vector e, N_Vector w, realtype tolerance,
                  booleantype setup,
                  void* memory) { return newton_of(s).solve(e, w, tolerance, setup != 0, memory); };
  // IDA's function for F is not used, because iterate() calls the problem directly.
  ops->setsysfn = [](SUNNonlinearSolver, SUNNonlinSolSysFn) { return SUN_NLS_SUCCESS; };
  ops->setlsetupfn = [](SUNNonlinearSolver s, SUNNonlinSolLSetupFn f) {
    newton_of(s).setup_ = f;
    return SUN_NLS_SUCCESS;
  };
  ops->setctestfn = [](SUNNonlinearSolver s, SUNNonlinSolConvTestFn f, void* data) {
    newton_of(s).test_ = f;
    newton_of(s).test_data_ = data;
    return SUN_NLS_SUCCESS;
  };
  ops->setmaxiters = [](SUNNonlinearSolver s, int most) {
    newton_of(s).max_iterations_ = most;
    return SUN_NLS_SUCCESS;
  };
  ops->getnumiters = [](SUNNonlinearSolver s, long* count) {
    *count = newton_of(s).iterations_;
    return SUN_NLS_SUCCESS;
  };
  ops->getcuriter = [](SUNNonlinearSolver s, int* iteration) {
    *iteration = newton_of(s).iteration_;
    return SUN_NLS_SUCCESS;
  };
  ops->getnumconvfails = [](SUNNonlinearSolver s, long* count) {
    *count = newton_of(s).failures_;
    return SUN_NLS_SUCCESS;
  };
  ops->free = [](SUNNonlinearSolver) { return SUN_NLS_SUCCESS; };
}

StepNewton::~StepNewton() {
  SUNNonlinSolFreeEmpty(solver_);
  N_VDestroy(change_);
}

int StepNewton::solve(N_Vector e, N_Vector weights, double tolerance, bool setup, void* memory) {
  iterations_ = failures_ = 0;
  if (jet_ != nullptr) return solve_from_jet(e);
  setup = setup || std::exchange(stale_, false);
  int result = iterate(e, weights, tolerance, setup, false, memory);
  if (result == SUN_NLS_SUCCESS) return result;
  ++failures_;
  if (result < 0 || setup) return result;
  // The iteration used the Jacobian of an earlier step: repeat with the current Jacobian.
  N_VConst(0.0, e);
  result = iterate(e, weights, tolerance, true, true, memory);
  if (result != SUN_NLS_SUCCESS) ++failures_;
  return result;
}

int StepNewton::solve_from_jet(N_Vector e) {
  double t = 0.0, cj = 0.0;
  N_Vector y_predicted = nullptr, yp_predicted = nullptr, y = nullptr, yp = nullptr, r = nullptr;
  void* data = nullptr;
  IDAGetNonlinearSystemData(ida_, &t, &y_predicted, &yp_predicted, &y, &yp, &r, &cj, &data);
  problem_.evaluate_jet(*jet_, t - jet_->t, 0, NV_DATA_S(change_));
  N_VLinearSum(1.0, change_, -1.0, y_predicted, e);
  return SUN_NLS_SUCCESS;
}

int StepNewton::iterate(N_Vector e, N_Vector weights, double tolerance, bool setup, bool doubtful,
                        void* memory) {
  double t = 0.0, cj = 0.0;
  N_Vector y_predicted = nullptr, yp_predicted = nullptr, y = nullptr, yp = nullptr, r = nullptr;
  void* data = nullptr;
  IDAGetNonlinearSystemData(ida_, &t, &y_predicted, &yp_predicted, &y, &yp, &r, &cj, &data);
  double* const change = NV_DATA_S(change_);
  bool near = !problem_.has_rate_dependent_friction();
  iteration_ = 0;
  for (int i = 0; iteration_ < max_iterations_ && i < max_iterations_ + max_extra_iterations; ++i) {
    const bool first = i == 0;
    if (!first) {
      N_VLinearSum(1.0, y_predicted, 1.0, e, y);
      N_VLinearSum(1.0, yp_predicted, cj, e, yp);
    } else if (setup) {
      N_VScale(1.0, y_predicted, y);
      N_VScale(1.0, yp_predicted, yp);
    }
    N_Vector at = first ? y_predicted : y, slope = first ? yp_predicted : yp;
    problem_.residual(t, 1.0 / cj, NV_DATA_S(at), NV_DATA_S(slope), change);
    ++residuals_;
    if (first && setup) {
      booleantype current = SUNFALSE;
      if (const int result = setup_(doubtful ? SUNTRUE : SUNFALSE, &current, memory);
          result != SUN_NLS_SUCCESS)
        return result;
    } else if (problem_.has_rate_dependent_friction()) {
      problem_.linearise(t, NV_DATA_S(at), NV_DATA_S(slope));
      problem_.linear().set_cj(cj);
      if (!problem_.linear().factor()) return SUN_NLS_CONV_RECVR;
    }
    problem_.linear().solve(change, change);
    ++iterations_;
    N_VLinearSum(1.0, e, -1.0, change_, e);
    if (!near) {
      near = N_VWrmsNorm(change_, weights) < 1.0;
      continue;
    }
    const int result = test_(solver_, e, change_, tolerance, weights, test_data_);
    if (result == SUN_NLS_CONV_RECVR && is_rounding(weights, tolerance)) return SUN_NLS_SUCCESS;
    if (result != SUN_NLS_CONTINUE) return result;
    ++iteration_;
  }
  return SUN_NLS_CONV_RECVR;
}

/// True if the correction is only rounding, although IDA's test reports a failure. IDA's test does not use the rate of
/// convergence: it accepts 1/20 of the requested tolerance, and reports a failure if the corrections no longer decrease. With
/// rate-dependent friction each iteration has a new tangent, so the error after a correction within the tolerance is smaller
/// than the correction. If such a correction no longer decreases, it is a rounding error of the large displacements behind T.
bool StepNewton::is_rounding(N_Vector weights, double tolerance) const {
  return problem_.has_rate_dependent_friction() && N_VWrmsNorm(change_, weights) <= tolerance;
}

}  // namespace signorini::ida
