#include <arkode/arkode_arkstep.h>
#include <nvector/nvector_serial.h>

#include <algorithm>

#include "engine/ida/fast_vector.hpp"
#include "integrator.hpp"
#include "parts.hpp"

namespace signorini::esdirk {
namespace {

class Esdirk final : public Integrator {
 public:
  Esdirk(ModeFlow& flow, int order, bool linear) : flow_(flow), order_(order) {
    y_ = ida::make_vector(2 * flow.size(), parts_.context);
    N_VConst(0.0, y_);
    memory_ = ARKStepCreate(nullptr, &Esdirk::derivative, 0.0, y_, parts_.context);
    ARKStepSetUserData(memory_, this);
    ARKStepWFtolerances(memory_, &Esdirk::weights);
    make_solver();
    check(ARKStepSetLinearSolver(memory_, parts_.solver, parts_.matrix), "ARKStepSetLinearSolver");
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
    N_VDestroy(y_);
  }

  void run(const Stretch& stretch, bool through, std::vector<double>& y, Tally& tally) override {
    flow_.start(stretch.states, stretch.begin);
    const int n = flow_.size();
    std::copy(stretch.u0.begin(), stretch.u0.end(), NV_DATA_S(y_));
    std::copy(stretch.v0.begin(), stretch.v0.end(), NV_DATA_S(y_) + n);
    check(ARKStepReInit(memory_, nullptr, &Esdirk::derivative, stretch.begin, y_), "ARKStepReInit");
    ARKStepSetInitStep(memory_, first_step(flow_, stretch, order_, order_));
    const double length = stretch.end - stretch.begin, far = stretch.end + length + std::abs(stretch.end);
    ARKStepSetStopTime(memory_, through ? far : stretch.end);
    double t = stretch.begin, before = t;
    steps_.clear();
    for (int flag = ARK_SUCCESS; flag != ARK_TSTOP_RETURN && t < stretch.end;) {
      flag = ARKStepEvolve(memory_, far, y_, &t, ARK_ONE_STEP);
      check(flag, "ARKStepEvolve");
      steps_.push_back(t - before);
      before = t;
    }
    if (t > stretch.end) check(ARKStepGetDky(memory_, stretch.end, 0, y_), "ARKStepGetDky");
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
    parts_.matrix = SUNMatNewEmpty(parts_.context);
    parts_.matrix->content = this;
    parts_.matrix->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
    parts_.matrix->ops->zero = [](SUNMatrix) { return SUNMAT_SUCCESS; };
    parts_.matrix->ops->destroy = [](SUNMatrix m) { SUNMatFreeEmpty(m); };
    parts_.solver = SUNLinSolNewEmpty(parts_.context);
    parts_.solver->content = this;
    parts_.solver->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
    parts_.solver->ops->setup = [](SUNLinearSolver s, SUNMatrix) {
      auto* e = static_cast<Esdirk*>(s->content);
      return e->flow_.factor(e->gamma_) ? SUNLS_SUCCESS : SUNLS_LUFACT_FAIL;
    };
    parts_.solver->ops->solve = [](SUNLinearSolver s, SUNMatrix, N_Vector x, N_Vector b, realtype) {
      static_cast<Esdirk*>(s->content)->flow_.solve(NV_DATA_S(b), NV_DATA_S(x));
      return static_cast<int>(SUNLS_SUCCESS);
    };
    parts_.solver->ops->free = [](SUNLinearSolver s) {
      SUNLinSolFreeEmpty(s);
      return static_cast<int>(SUNLS_SUCCESS);
    };
  }

  ModeFlow& flow_;
  int order_;
  Parts parts_;
  N_Vector y_ = nullptr;
  void* memory_ = nullptr;
  double gamma_ = 0.0;
  std::vector<double> steps_;
};

}  // namespace

std::unique_ptr<Integrator> make_esdirk(ModeFlow& flow, int order, bool linear) {
  return std::make_unique<Esdirk>(flow, order, linear);
}

}  // namespace signorini::esdirk
