#include "hand_coded.hpp"

#include <ida/ida.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_sparse.h>

#include <cmath>

namespace signorini::overhead {
namespace {

enum class State { stick, plus, minus };

struct Data {
  Slider s;
  State state;
  double rtol, atol_u, atol_v, atol_f;
};

double sign(State s) { return s == State::plus ? 1.0 : s == State::minus ? -1.0 : 0.0; }

int residual(double t, N_Vector yv, N_Vector ypv, N_Vector rv, void* user) {
  const auto& d = *static_cast<Data*>(user);
  const double *y = NV_DATA_S(yv), *yp = NV_DATA_S(ypv);
  double* r = NV_DATA_S(rv);
  r[0] = yp[0] - y[1];
  r[1] = d.s.m * yp[1] + d.s.c * y[1] + d.s.k * y[0] - d.s.amplitude * std::sin(d.s.omega * t) + y[3];
  r[2] = y[2] + 1.0;
  r[3] = d.state == State::stick ? yp[1] : y[3] + sign(d.state) * d.s.friction * y[2];
  return 0;
}

int jacobian(double, double cj, N_Vector, N_Vector, N_Vector, SUNMatrix J, void* user, N_Vector, N_Vector,
             N_Vector) {
  const auto& d = *static_cast<Data*>(user);
  sunindextype* p = SUNSparseMatrix_IndexPointers(J);
  sunindextype* r = SUNSparseMatrix_IndexValues(J);
  double* x = SUNSparseMatrix_Data(J);
  // columns: u (rows 0, 1), v (0, 1, 3), N (2, 3), T (1, 3)
  const sunindextype starts[] = {0, 2, 5, 7, 9}, rows[] = {0, 1, 0, 1, 3, 2, 3, 1, 3};
  const bool stick = d.state == State::stick;
  const double values[] = {cj,
                           d.s.k,
                           -1.0,
                           cj * d.s.m + d.s.c,
                           stick ? cj : 0.0,
                           1.0,
                           stick ? 0.0 : sign(d.state) * d.s.friction,
                           1.0,
                           stick ? 0.0 : 1.0};
  for (int i = 0; i < 5; ++i) p[i] = starts[i];
  for (int i = 0; i < 9; ++i) {
    r[i] = rows[i];
    x[i] = values[i];
  }
  return 0;
}

int guards(double, N_Vector yv, N_Vector, double* g, void* user) {
  const auto& d = *static_cast<Data*>(user);
  const double* y = NV_DATA_S(yv);
  if (d.state == State::stick) {
    g[0] = -d.s.friction * y[2] - y[3];
    g[1] = -d.s.friction * y[2] + y[3];
  } else {
    g[0] = sign(d.state) * y[1];
    g[1] = 1.0;
  }
  return 0;
}

int weights(N_Vector yv, N_Vector wv, void* user) {
  const auto& d = *static_cast<Data*>(user);
  const double* y = NV_DATA_S(yv);
  double* w = NV_DATA_S(wv);
  // the same norm as Signorini's: kinematics and forces each count as one mean, a step spends a fifth
  const double factor = 5.0 * std::sqrt(2.0);
  w[0] = factor / (d.rtol * std::abs(y[0]) + d.atol_u);
  w[1] = factor / (d.rtol * std::abs(y[1]) + d.atol_v);
  w[2] = factor / (d.rtol * std::abs(y[2]) + d.atol_f);
  w[3] = factor / (d.rtol * std::abs(y[3]) + d.atol_f);
  return 0;
}

}  // namespace

Outcome run_by_hand(const Slider& s, double rtol, double atol_u, double atol_v, double atol_f) {
  Data d{s, State::stick, rtol, atol_u, atol_v, atol_f};
  SUNContext context = nullptr;
  SUNContext_Create(nullptr, &context);
  N_Vector y = N_VNew_Serial(4, context), yp = N_VNew_Serial(4, context);
  SUNMatrix J = SUNSparseMatrix(4, 4, 9, CSC_MAT, context);
  double *u = NV_DATA_S(y), *up = NV_DATA_S(yp);
  u[0] = s.u0;
  u[1] = s.v0;
  u[2] = -1.0;
  const auto force = [&](double t) { return s.amplitude * std::sin(s.omega * t) - s.c * u[1] - s.k * u[0]; };
  const auto decide = [&](double t) {
    const double required = force(t), rate = s.amplitude * s.omega * std::cos(s.omega * t);
    const bool beyond = std::abs(required) > s.friction * (1.0 - 1e-9) && required * rate >= 0.0;
    d.state = !beyond && std::abs(required) <= s.friction * (1.0 + 1e-9) ? State::stick
              : required > 0.0                                           ? State::plus
                                                                         : State::minus;
    u[1] = 0.0;
  };
  const auto consistent = [&](double t) {
    const double required = force(t);
    u[3] = d.state == State::stick ? required : sign(d.state) * s.friction;
    up[0] = u[1];
    up[1] = (required - u[3]) / s.m;
    up[2] = 0.0;
    up[3] = d.state == State::stick ? s.amplitude * s.omega * std::cos(s.omega * t) - s.k * u[1] : 0.0;
  };
  decide(0.0);
  consistent(0.0);
  void* ida = IDACreate(context);
  IDAInit(ida, residual, 0.0, y, yp);
  IDASetUserData(ida, &d);
  IDAWFtolerances(ida, weights);
  SUNLinearSolver solver = SUNLinSol_KLU(y, J, context);
  IDASetLinearSolver(ida, solver, J);
  IDASetJacFn(ida, jacobian);
  IDASetMaxNumSteps(ida, -1);
  IDASetNoInactiveRootWarn(ida);
  IDASetStopTime(ida, s.t_end);
  int directions[] = {-1, -1};
  Outcome result{0, 0, 0.0};
  double t = 0.0;
  while (t < s.t_end) {
    IDARootInit(ida, 0, nullptr);
    IDARootInit(ida, 2, guards);
    IDASetRootDirection(ida, directions);
    int flag = 0;
    while ((flag = IDASolve(ida, 2.0 * s.t_end, &t, y, yp, IDA_ONE_STEP)) == IDA_SUCCESS) {
    }
    long steps = 0;
    IDAGetNumSteps(ida, &steps);
    result.steps += steps;
    if (flag != IDA_ROOT_RETURN) break;
    ++result.events;
    if (d.state == State::stick)
      d.state = u[3] > 0.0 ? State::plus : State::minus;
    else
      decide(t);
    consistent(t);
    IDAReInit(ida, t, y, yp);
    // the first step whose local error is just accepted: y'' of u, v
    const double a = (force(t) - u[3]) / s.m;
    const double j = (s.amplitude * s.omega * std::cos(s.omega * t) - s.k * u[1] - s.c * a) / s.m;
    const double n =
        std::hypot(a / (rtol * std::abs(u[0]) + atol_u), j / (rtol * std::abs(u[1]) + atol_v)) * 5.0;
    if (n > 0.0) IDASetInitStep(ida, 0.4 * std::sqrt(2.0 / n));
  }
  result.u_end = u[0];
  IDAFree(&ida);
  SUNLinSolFree(solver);
  SUNMatDestroy(J);
  N_VDestroy(y);
  N_VDestroy(yp);
  SUNContext_Free(&context);
  return result;
}

}  // namespace signorini::overhead
