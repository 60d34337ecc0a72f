#include "floor.hpp"

#include <ida/ida.h>
#include <nvector/nvector_serial.h>

#include <cmath>
#include <stdexcept>

#include "engine/ida/fast_vector.hpp"

namespace signorini::benchmarks {

struct Floor::Memory {
  SUNContext context = nullptr;
  N_Vector y = nullptr, yp = nullptr;
  SUNMatrix matrix = nullptr;
  SUNLinearSolver solver = nullptr;
  void* ida = nullptr;
  double cj = 1.0, rtol = 1e-6;
  int roots = 0;
  long taken = 0, orders = 0;

  static int residual(realtype t, N_Vector, N_Vector yp, N_Vector r, void*) {
    const double rate = std::cos(t), *p = NV_DATA_S(yp);
    double* q = NV_DATA_S(r);
    const sunindextype n = NV_LENGTH_S(r);
    for (sunindextype i = 0; i < n; ++i) q[i] = p[i] - rate;
    return 0;
  }
  static int weights(N_Vector y, N_Vector w, void* self) {
    const double rtol = static_cast<Memory*>(self)->rtol, *p = NV_DATA_S(y);
    double* q = NV_DATA_S(w);
    const sunindextype n = NV_LENGTH_S(w);
    for (sunindextype i = 0; i < n; ++i) q[i] = 1.0 / (rtol * std::abs(p[i]) + rtol);
    return 0;
  }
  static int guards(realtype, N_Vector, N_Vector, realtype* g, void* self) {
    for (int i = 0; i < static_cast<Memory*>(self)->roots; ++i) g[i] = 1.0;
    return 0;
  }
  static int jacobian(realtype, realtype cj, N_Vector, N_Vector, N_Vector, SUNMatrix, void* self, N_Vector,
                      N_Vector, N_Vector) {
    static_cast<Memory*>(self)->cj = cj;
    return 0;
  }
};

Floor::Floor(sunindextype unknowns, int roots, double rtol, bool packaged) : m_(std::make_unique<Memory>()) {
  Memory& m = *m_;
  m.rtol = rtol;
  m.roots = roots;
  SUNContext_Create(nullptr, &m.context);
  m.y = packaged ? N_VNew_Serial(unknowns, m.context) : ida::make_vector(unknowns, m.context);
  m.yp = N_VClone(m.y);
  N_VConst(0.0, m.y);
  N_VConst(1.0, m.yp);
  m.ida = IDACreate(m.context);
  IDAInit(m.ida, &Memory::residual, 0.0, m.y, m.yp);
  IDASetUserData(m.ida, &m);
  IDAWFtolerances(m.ida, &Memory::weights);
  m.matrix = SUNMatNewEmpty(m.context);
  m.matrix->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
  m.matrix->ops->zero = [](SUNMatrix) { return SUNMAT_SUCCESS; };
  m.matrix->ops->destroy = [](SUNMatrix a) { SUNMatFreeEmpty(a); };
  m.solver = SUNLinSolNewEmpty(m.context);
  m.solver->content = &m;
  m.solver->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
  m.solver->ops->setup = [](SUNLinearSolver, SUNMatrix) { return static_cast<int>(SUNLS_SUCCESS); };
  m.solver->ops->solve = [](SUNLinearSolver s, SUNMatrix, N_Vector x, N_Vector b, realtype) {
    const double factor = 1.0 / static_cast<Memory*>(s->content)->cj, *p = NV_DATA_S(b);
    double* q = NV_DATA_S(x);
    const sunindextype n = NV_LENGTH_S(x);
    for (sunindextype i = 0; i < n; ++i) q[i] = factor * p[i];
    return static_cast<int>(SUNLS_SUCCESS);
  };
  m.solver->ops->free = [](SUNLinearSolver s) {
    SUNLinSolFreeEmpty(s);
    return static_cast<int>(SUNLS_SUCCESS);
  };
  IDASetLinearSolver(m.ida, m.solver, m.matrix);
  IDASetJacFn(m.ida, &Memory::jacobian);
  IDASetDeltaCjLSetup(m.ida, 0.0);
  IDASetMaxNumSteps(m.ida, -1);
  IDARootInit(m.ida, roots, &Memory::guards);
}

Floor::~Floor() {
  IDAFree(&m_->ida);
  SUNLinSolFree(m_->solver);
  SUNMatDestroy(m_->matrix);
  N_VDestroy(m_->y);
  N_VDestroy(m_->yp);
  SUNContext_Free(&m_->context);
}

void Floor::steps(long count) {
  for (long i = 0; i < count; ++i) {
    double t = 0.0;
    if (IDASolve(m_->ida, 1e300, &t, m_->y, m_->yp, IDA_ONE_STEP) < 0) throw std::runtime_error("IDA failed");
    int order = 0;
    IDAGetLastOrder(m_->ida, &order);
    ++m_->taken;
    m_->orders += order;
  }
}

double Floor::order() const { return static_cast<double>(m_->orders) / static_cast<double>(m_->taken); }

}  // namespace signorini::benchmarks
