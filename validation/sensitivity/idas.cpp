// SUNDIALS' forward sensitivities (IDAS) on a stretch without events, against the closed form (README.md).
//
//   u'' + k K u = 0,  u(0) = u0, u'(0) = 0      a chain of masses of one; by k
//   u_j = phi_j cos(w_j t),   du_j/dk = -phi_j t w_j / (2 k) sin(w_j t),   w_j^2 = k l_j
//
//   signorini_idas [rtol ...]       one line a tolerance and error control: errors, steps, residuals, time
#include <fmt/core.h>
#include <idas/idas.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <Eigen/Eigenvalues>
#include <chrono>
#include <cmath>
#include <cstdlib>

namespace {

constexpr int masses = 20;
constexpr double stiffness = 400.0, t_end = 10.0;
using Vec = Eigen::VectorXd;
using Mat = Eigen::MatrixXd;

Mat chain() {
  Mat k = Mat::Zero(masses, masses);
  for (int i = 0; i < masses; ++i) {
    k(i, i) = 2.0;
    if (i + 1 < masses) k(i, i + 1) = k(i + 1, i) = -1.0;
  }
  return k;
}
const Mat& shape() {
  static const Mat k = chain();
  return k;
}
Vec bump() {
  Vec u(masses);
  for (int i = 0; i < masses; ++i) u[i] = std::exp(-0.1 * (i - 8.0) * (i - 8.0));
  return u;
}
Eigen::Map<Vec> part(N_Vector x, int which) { return {N_VGetArrayPointer(x) + which * masses, masses}; }

int residual(realtype, N_Vector y, N_Vector yp, N_Vector r, void*) {
  part(r, 0) = part(yp, 0) - part(y, 1);
  part(r, 1) = part(yp, 1) + stiffness * (shape() * part(y, 0));
  return 0;
}
int tangent(int, realtype, N_Vector y, N_Vector, N_Vector, N_Vector* s, N_Vector* sp, N_Vector* r, void*,
            N_Vector, N_Vector, N_Vector) {
  part(r[0], 0) = part(sp[0], 0) - part(s[0], 1);
  part(r[0], 1) = part(sp[0], 1) + stiffness * (shape() * part(s[0], 0)) + shape() * part(y, 0);
  return 0;
}

struct Exact {
  Vec u, w;
};
Exact exact() {
  const Eigen::SelfAdjointEigenSolver<Mat> modes(shape());
  const Vec phi = modes.eigenvectors().transpose() * bump();
  Vec u(masses), w(masses);
  for (int j = 0; j < masses; ++j) {
    const double omega = std::sqrt(stiffness * modes.eigenvalues()[j]);
    u[j] = phi[j] * std::cos(omega * t_end);
    w[j] = -phi[j] * t_end * omega / (2.0 * stiffness) * std::sin(omega * t_end);
  }
  return {modes.eigenvectors() * u, modes.eigenvectors() * w};
}

enum class Way { motion, tangent_free, tangent_controlled };

void measure(double rtol, Way way) {
  SUNContext context = nullptr;
  SUNContext_Create(nullptr, &context);
  N_Vector y = N_VNew_Serial(2 * masses, context), yp = N_VClone(y);
  N_VConst(0.0, y);
  part(y, 0) = bump();
  part(yp, 0).setZero();
  part(yp, 1) = -stiffness * (shape() * bump());
  void* ida = IDACreate(context);
  IDAInit(ida, residual, 0.0, y, yp);
  IDASStolerances(ida, rtol, rtol * 1e-2);
  SUNMatrix matrix = SUNDenseMatrix(2 * masses, 2 * masses, context);
  SUNLinearSolver solver = SUNLinSol_Dense(y, matrix, context);
  IDASetLinearSolver(ida, solver, matrix);
  IDASetMaxNumSteps(ida, -1);
  N_Vector *s = N_VCloneVectorArray(1, y), *sp = N_VCloneVectorArray(1, y);
  if (way != Way::motion) {
    N_VConst(0.0, s[0]);
    N_VConst(0.0, sp[0]);
    part(sp[0], 1) = -(shape() * bump());
    IDASensInit(ida, 1, IDA_SIMULTANEOUS, tangent, s, sp);
    double scale = stiffness;
    IDASetSensParams(ida, nullptr, &scale, nullptr);
    IDASensEEtolerances(ida);
    IDASetSensErrCon(ida, way == Way::tangent_controlled);
  }
  const auto begin = std::chrono::steady_clock::now();
  realtype t = 0.0;
  IDASetStopTime(ida, t_end);
  const int flag = IDASolve(ida, t_end, &t, y, yp, IDA_NORMAL);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const Exact e = exact();
  double tangent_error = 0.0;
  if (way != Way::motion) {
    IDAGetSens(ida, &t, s);
    tangent_error = (part(s[0], 0) - e.w).cwiseAbs().maxCoeff() / e.w.cwiseAbs().maxCoeff();
  }
  const double error = (part(y, 0) - e.u).cwiseAbs().maxCoeff() / e.u.cwiseAbs().maxCoeff();
  long steps = 0, residuals = 0;
  IDAGetNumSteps(ida, &steps);
  IDAGetNumResEvals(ida, &residuals);
  constexpr const char* names[] = {"motion alone", "tangent, not controlled", "tangent, controlled"};
  fmt::print("{:<8.0e}{:<26}{:>10.1e}{:>12.1e}{:>9}{:>11}{:>9.1f} ms{}\n", rtol, names[static_cast<int>(way)],
             error, tangent_error, steps, residuals, 1e3 * seconds, flag < 0 ? "  failed" : "");
  IDAFree(&ida);
  SUNLinSolFree(solver);
  SUNMatDestroy(matrix);
  N_VDestroyVectorArray(s, 1);
  N_VDestroyVectorArray(sp, 1);
  N_VDestroy(y);
  N_VDestroy(yp);
  SUNContext_Free(&context);
}

}  // namespace

int main(int argc, char** argv) {
  fmt::print("{:<8}{:<26}{:>10}{:>12}{:>9}{:>11}{:>12}\n", "rtol", "", "error u", "error du/dk", "steps",
             "residuals", "time");
  for (int i = 1; i < std::max(argc, 2); ++i)
    for (const Way way : {Way::motion, Way::tangent_free, Way::tangent_controlled})
      measure(argc > 1 ? std::atof(argv[i]) : 1e-8, way);
}
