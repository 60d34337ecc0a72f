#include <arkode/arkode_arkstep.h>
#include <nvector/nvector_serial.h>

#include <algorithm>

#include "engine/fast_vector.hpp"
#include "integrator.hpp"

namespace signorini::esdirk {
namespace {

class Esdirk final : public Integrator {
 public:
  Esdirk(Flow& flow, int order, bool linear) : flow_(flow), order_(order) {
    SUNContext_Create(nullptr, &context_);
    y_ = make_vector(2 * flow.size(), context_);
    N_VConst(0.0, y_);
    memory_ = ARKStepCreate(nullptr, &Esdirk::derivative, 0.0, y_, context_);
    ARKStepSetUserData(memory_, this);
    ARKStepWFtolerances(memory_, &Esdirk::weights);
    make_solver();
    check(ARKStepSetLinearSolver(memory_, solver_, matrix_), "ARKStepSetLinearSolver");
    check(ARKStepSetLinSysFn(memory_, &Esdirk::system), "ARKStepSetLinSysFn");
    const ARKODE_DIRKTableID table = order == 3   ? ARKODE_ESDIRK325L2SA_5_2_3
                                     : order == 4 ? ARKODE_ESDIRK436L2SA_6_3_4
                                                  : ARKODE_ESDIRK547L2SA2_7_4_5;
    check(ARKStepSetTableNum(memory_, table, ARKODE_ERK_NONE), "ARKStepSetTableNum");
    if (linear) {
      check(ARKStepSetLinear(memory_, 0), "ARKStepSetLinear");
    } else {
      // The best of eight combinations tried: fresh tangents in every step, stages predicted from the last
      // step, and Newton's method sharp enough for derivatives that are deduced from its result.
      ARKStepSetLSetupFrequency(memory_, 1);
      ARKStepSetPredictorMethod(memory_, 1);
      ARKStepSetNonlinConvCoef(memory_, 1e-3);
    }
    check(ARKStepSetDeduceImplicitRhs(memory_, SUNTRUE), "ARKStepSetDeduceImplicitRhs");
    ARKStepSetMaxNumSteps(memory_, -1);
    ARKStepSetErrHandlerFn(
        memory_, [](int, const char*, const char*, char*, void*) {}, nullptr);
  }
  ~Esdirk() override {
    ARKStepFree(&memory_);
    SUNLinSolFree(solver_);
    SUNMatDestroy(matrix_);
    N_VDestroy(y_);
    SUNContext_Free(&context_);
  }
  Esdirk(const Esdirk&) = delete;
  Esdirk& operator=(const Esdirk&) = delete;

  void run(const Stretch& stretch, std::vector<double>& y, Tally& tally) override {
    flow_.start(stretch.mode, stretch.begin);
    const int n = flow_.size();
    std::copy(stretch.u0.begin(), stretch.u0.end(), NV_DATA_S(y_));
    std::copy(stretch.v0.begin(), stretch.v0.end(), NV_DATA_S(y_) + n);
    check(ARKStepReInit(memory_, nullptr, &Esdirk::derivative, stretch.begin, y_), "ARKStepReInit");
    ARKStepSetInitStep(memory_, first_step(flow_, stretch, order_, order_));
    ARKStepSetStopTime(memory_, stretch.end);
    double t = stretch.begin, before = t;
    steps_.clear();
    const double far = stretch.end + (stretch.end - stretch.begin) + std::abs(stretch.end);
    for (int flag = ARK_SUCCESS; flag != ARK_TSTOP_RETURN && t < stretch.end;) {
      flag = ARKStepEvolve(memory_, far, y_, &t, ARK_ONE_STEP);
      check(flag, "ARKStepEvolve");
      steps_.push_back(t - before);
      before = t;
    }
    long failed_tests = 0, failed_solves = 0;
    ARKStepGetNumErrTestFails(memory_, &failed_tests);
    ARKStepGetNumNonlinSolvConvFails(memory_, &failed_solves);
    tally.steps += static_cast<long>(steps_.size());
    tally.failures += failed_tests + failed_solves;
    tally.to_length += steps_to_length(steps_);
    y.assign(NV_DATA_S(y_), NV_DATA_S(y_) + 2 * n);
  }

 private:
  static int derivative(realtype t, N_Vector y, N_Vector dy, void* self) {
    static_cast<Esdirk*>(self)->flow_.derivative(t, 0, NV_DATA_S(y), NV_DATA_S(dy));
    return 0;
  }
  static int weights(N_Vector y, N_Vector w, void* self) {
    static_cast<Esdirk*>(self)->flow_.weights(NV_DATA_S(y), NV_DATA_S(w));
    return 0;
  }
  static int system(realtype t, N_Vector y, N_Vector, SUNMatrix, SUNMatrix, booleantype, booleantype* current,
                    realtype gamma, void* self, N_Vector, N_Vector, N_Vector) {
    auto* e = static_cast<Esdirk*>(self);
    e->flow_.linearise(t, NV_DATA_S(y));
    e->gamma_ = gamma;
    *current = SUNTRUE;
    return 0;
  }
  void make_solver() {
    matrix_ = SUNMatNewEmpty(context_);
    matrix_->content = this;
    matrix_->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
    matrix_->ops->zero = [](SUNMatrix) { return SUNMAT_SUCCESS; };
    matrix_->ops->destroy = [](SUNMatrix m) { SUNMatFreeEmpty(m); };
    solver_ = SUNLinSolNewEmpty(context_);
    solver_->content = this;
    solver_->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
    solver_->ops->setup = [](SUNLinearSolver s, SUNMatrix) {
      auto* e = static_cast<Esdirk*>(s->content);
      return e->flow_.factor(e->gamma_) ? SUNLS_SUCCESS : SUNLS_LUFACT_FAIL;
    };
    solver_->ops->solve = [](SUNLinearSolver s, SUNMatrix, N_Vector x, N_Vector b, realtype) {
      static_cast<Esdirk*>(s->content)->flow_.solve(NV_DATA_S(b), NV_DATA_S(x));
      return static_cast<int>(SUNLS_SUCCESS);
    };
    solver_->ops->free = [](SUNLinearSolver s) {
      SUNLinSolFreeEmpty(s);
      return static_cast<int>(SUNLS_SUCCESS);
    };
  }

  Flow& flow_;
  int order_;
  SUNContext context_ = nullptr;
  N_Vector y_ = nullptr;
  void* memory_ = nullptr;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver solver_ = nullptr;
  double gamma_ = 0.0;
  std::vector<double> steps_;
};

}  // namespace

std::unique_ptr<Integrator> make_esdirk(Flow& flow, int order, bool linear) {
  return std::make_unique<Esdirk>(flow, order, linear);
}

}  // namespace signorini::esdirk
