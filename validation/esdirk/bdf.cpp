#include <ida/ida.h>
#include <nvector/nvector_serial.h>

#include <algorithm>

#include "engine/ida/fast_vector.hpp"
#include "engine/ida/ida_linear_solver.hpp"
#include "integrator.hpp"
#include "parts.hpp"

namespace signorini::esdirk {
namespace {

class Bdf final : public Integrator {
 public:
  explicit Bdf(ModeFlow& flow)
      : flow_(flow),
        model_(flow.model()),
        structure_(model_),
        layout_(model_),
        linear_(model_, structure_, layout_) {
    for (N_Vector* x : {&y_, &yp_}) {
      *x = ida::make_vector(layout_.size(), parts_.context);
      N_VConst(0.0, *x);
    }
    ida_ = IDACreate(parts_.context);
    check(IDAInit(ida_, &Bdf::residual, 0.0, y_, yp_), "IDAInit");
    IDASetUserData(ida_, this);
    IDAWFtolerances(ida_, &Bdf::weights);
    parts_.matrix = linear_.make_matrix(parts_.context);
    parts_.solver = linear_.make_solver(parts_.context);
    check(IDASetLinearSolver(ida_, parts_.solver, parts_.matrix), "IDASetLinearSolver");
    IDASetJacFn(ida_, &Bdf::jacobian);
    IDASetMaxNumSteps(ida_, -1);
    IDASetDeltaCjLSetup(ida_, 0.0);  // as engine ida
    IDASetErrHandlerFn(
        ida_, [](int, const char*, const char*, char*, void*) {}, nullptr);
  }
  ~Bdf() override {
    IDAFree(&ida_);
    N_VDestroy(y_);
    N_VDestroy(yp_);
  }

  void run(const Stretch& stretch, bool through, std::vector<double>& y, Tally& tally) override {
    flow_.start(stretch.states, stretch.begin);
    linear_.set_contact_states(stretch.states);
    states_ = stretch.states;
    const auto n = flow_.size();
    double *x = NV_DATA_S(y_), *xp = NV_DATA_S(yp_);
    std::copy(stretch.u0.begin(), stretch.u0.end(), x);
    std::copy(stretch.v0.begin(), stretch.v0.end(), x + n);
    flow_.derivative(stretch.begin, 0, x, xp);
    // Consistent N and T; their rates are only a first guess.
    for (std::size_t k = 0; k < model_.contacts.size(); ++k)
      for (int side = 0; side < 2; ++side) {
        x[layout_.force(k) + side] = flow_.force(k, side);
        xp[layout_.force(k) + side] = 0.0;
      }
    check(IDAReInit(ida_, stretch.begin, y_, yp_), "IDAReInit");
    IDASetInitStep(ida_, first_step(flow_, stretch, 2, 4));
    const double length = stretch.end - stretch.begin, far = stretch.end + length + std::abs(stretch.end);
    IDASetStopTime(ida_, through ? far : stretch.end);
    double t = stretch.begin, before = t;
    steps_.clear();
    orders_.clear();
    for (int flag = IDA_SUCCESS; flag != IDA_TSTOP_RETURN && t < stretch.end;) {
      flag = IDASolve(ida_, far, &t, y_, yp_, IDA_ONE_STEP);
      check(flag, "IDASolve");
      steps_.push_back(t - before);
      before = t;
      IDAGetLastOrder(ida_, &orders_.emplace_back());
    }
    if (t > stretch.end) check(IDAGetDky(ida_, stretch.end, 0, y_), "IDAGetDky");
    long failed_tests = 0, failed_solves = 0, solves = 0, setups = 0;
    IDAGetNumErrTestFails(ida_, &failed_tests);
    IDAGetNumNonlinSolvConvFails(ida_, &failed_solves);
    IDAGetNumNonlinSolvIters(ida_, &solves);
    IDAGetNumLinSolvSetups(ida_, &setups);
    flow_.count.solves += solves;
    flow_.count.factorisations += setups;
    tally.steps += static_cast<long>(steps_.size());
    tally.failures += failed_tests + failed_solves;
    tally.to_order += std::max_element(orders_.begin(), orders_.end()) - orders_.begin();
    tally.to_length += steps_to_length(steps_);
    y.assign(NV_DATA_S(y_), NV_DATA_S(y_) + 2 * n);
  }

 private:
  static int residual(realtype t, N_Vector y, N_Vector yp, N_Vector r, void* self) {
    static_cast<Bdf*>(self)->residual(t, NV_DATA_S(y), NV_DATA_S(yp), NV_DATA_S(r));
    return 0;
  }
  void residual(double t, const double* y, const double* yp, double* r) {
    const int n = flow_.size();
    const double *u = y, *v = y + n, *a = yp + n;
    double* momentum = r + n;
    std::fill(momentum, momentum + n, 0.0);
    flow_.forcing().add_load(t, 0, momentum);
    for (int i = 0; i < n; ++i) {
      r[i] = yp[i] - v[i];
      momentum[i] = -momentum[i];
    }
    structure_.add_product(a, v, u, momentum);
    for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
      const Contact& contact = model_.contacts[k];
      const int f = layout_.force(k);
      contact.normal.add_to(momentum, y[f]);
      contact.tangent.add_to(momentum, y[f + 1]);
      ContactMotion m = flow_.motion(k, t, 0, u, v);
      m.N = y[f];
      m.T = y[f + 1];
      m.an = contact.normal.dot(a);
      m.at += contact.tangent.dot(a);
      r[f] = flow_.rows()[k].normal.value(m);
      r[f + 1] = contact::slips_nonlinearly(contact, states_[k].state)
                     ? stribeck_row(contact, states_[k].state, m.vt).value(m)
                     : flow_.rows()[k].tangent.value(m);
    }
  }
  static int jacobian(realtype t, realtype cj, N_Vector y, N_Vector, N_Vector, SUNMatrix, void* self,
                      N_Vector, N_Vector, N_Vector) {
    auto* b = static_cast<Bdf*>(self);
    const double* x = NV_DATA_S(y);
    for (std::size_t k = 0; k < b->model_.contacts.size(); ++k)
      if (const State state = b->states_[k].state; contact::slips_nonlinearly(b->model_.contacts[k], state)) {
        const ContactMotion m = b->flow_.motion(k, t, 0, x, x + b->flow_.size());
        b->linear_.linearise(k, stribeck_tangent(b->model_.contacts[k], state, m.vt, x[b->layout_.force(k)]));
      }
    b->linear_.set_cj(cj);
    return 0;
  }
  static int weights(N_Vector y, N_Vector w, void* self) {
    auto* b = static_cast<Bdf*>(self);
    const int n = 2 * b->flow_.size();
    double* x = NV_DATA_S(w);
    b->flow_.weights(NV_DATA_S(y), x);
    // The mean is over u and v, as in the norm of the other integrators.
    const double factor = std::sqrt(static_cast<double>(b->layout_.size()) / n);
    for (int i = 0; i < n; ++i) x[i] *= factor;
    std::fill(x + n, x + b->layout_.size(), 0.0);
    return 0;
  }

  ModeFlow& flow_;
  const Model& model_;
  linear::SystemMatrices structure_;
  ida::Layout layout_;
  ida::IdaLinearSolver linear_;
  contact::ContactStates states_;
  Parts parts_;
  N_Vector y_ = nullptr, yp_ = nullptr;
  void* ida_ = nullptr;
  std::vector<double> steps_;
  std::vector<int> orders_;
};

}  // namespace

std::unique_ptr<Integrator> make_bdf(ModeFlow& flow) { return std::make_unique<Bdf>(flow); }

}  // namespace signorini::esdirk
