#include "engine/ida/bdf_integrator.hpp"

#include <fmt/core.h>
#include <ida/ida.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "contact/friction.hpp"
#include "engine/ida/fast_vector.hpp"
#include "engine/ida/ida_problem.hpp"
#include "engine/ida/step_newton.hpp"
#include "model/internal_units.hpp"

namespace signorini::ida {
namespace {

// Limit of the number of restarts after a failed first step. Each restart divides the length of the first step by ten.
constexpr int max_retries = 4;
constexpr double surface_step = 0.25;  // longest step as a phase angle of a surface's motion, rad: error 1e-7
// First step as a fraction of the longest step whose local error is accepted. After a rebound, the error of the order-one start
// remains in the gap for the whole flight, and every impact adds such an error. So scenes with rigid contacts use a shorter
// first step: each start takes five more steps, but the errors are ten times smaller (measured in case 04a).
constexpr double first_step_part = 0.4, first_step_part_of_flights = 0.03;

// `part` in restart_order.hpp. Of the values from 0.1 to 0.4, this one has the smallest error for a growing and for a damped
// motion at eight tolerances (docs/decisions/ida-restart-order.md). The number of steps differs by a tenth in this range.
constexpr double jet_step_part = 0.2;
// Longest step before a segment, as a fraction of the segment. The segment then has several steps even if the polynomials of
// the jet are exact for any step length.
constexpr double longest_jet_step = 0.0625;
// Shortest step before a segment, relative to the time; IDA requires at least 100 eps.
constexpr double shortest_jet_step = 1e3 * std::numeric_limits<double>::epsilon();
// Factor on the error weights in the steps before a segment. It is so small that no error test fails.
constexpr double no_error_test = 1e-15;

// Limit for the convergence of Newton's method, relative to the tolerance; IDA's default is 1/3.
constexpr double sharp_newton = 1e-3;

void check(int flag, const char* what) {
  if (flag < 0) throw std::runtime_error(fmt::format("{} failed ({})", what, flag));
}

/// Converts the times in a message of IDA, such as "t = 0.5" and "h = 1e-9", to scene units. unit: internal unit of time in
/// scene units.
std::string convert_times(std::string text, double unit) {
  for (const char* name : {"t = ", "h = "}) {
    const std::size_t at = text.find(name);
    if (at == std::string::npos) continue;
    const char* const begin = text.c_str() + at + 4;
    char* end = nullptr;
    const double time = std::strtod(begin, &end);
    text.replace(at + 4, static_cast<std::size_t>(end - begin), fmt::format("{:.9g}", time * unit));
  }
  return text;
}

bool in_closed_form(const Model& model) {
  return std::all_of(model.loads.begin(), model.loads.end(),
                     [](const Load& l) { return l.history.has_closed_form(); }) &&
         std::all_of(model.contacts.begin(), model.contacts.end(), [](const Contact& c) {
           return c.normal_force.has_closed_form() && c.surface_motion.has_closed_form();
         });
}

}  // namespace

struct BdfIntegrator::Memory {
  Memory(const Model& model, const linear::SystemMatrices& structure, const engine::Tolerance& tolerance,
         int max_order)
      : problem(model, structure, tolerance), unit_of_time(model::time_in_scene_units(model, 1.0)) {
    SUNContext_Create(nullptr, &context);
    const auto size = static_cast<sunindextype>(problem.layout().size());
    for (N_Vector* v : {&y, &yp, &work}) *v = make_vector(size, context);
    N_VConst(0.0, y);
    N_VConst(0.0, yp);
    ida = IDACreate(context);
    IDASetErrHandlerFn(ida, &Memory::on_error, this);
    check(IDAInit(ida, &Memory::residual, 0.0, y, yp), "IDAInit");
    IDASetUserData(ida, this);
    IDAWFtolerances(ida, &Memory::weights);
    matrix = problem.linear().make_matrix(context);
    solver = problem.linear().make_solver(context);
    check(IDASetLinearSolver(ida, solver, matrix), "IDASetLinearSolver");
    newton = std::make_unique<StepNewton>(problem, ida, y, context);
    check(IDASetNonlinearSolver(ida, newton->solver()), "IDASetNonlinearSolver");
    IDASetJacFn(ida, &Memory::jacobian);
    IDASetMaxNumSteps(ida, -1);
    IDASetMaxOrd(ida, max_order);
    // Factorise at every change of cj: Newton's method is then exact for linear systems, and the contact rows are satisfied up
    // to rounding. With IDA's default, the error of the energy is 3 to 4 times as large, and more steps are needed (measured).
    IDASetDeltaCjLSetup(ida, 0.0);
    // The error of nonlinear rows (rate-dependent friction, products) is that of Newton's method.
    if (std::any_of(model.contacts.begin(), model.contacts.end(),
                    [](const Contact& c) { return !c.is_linear(); }))
      IDASetNonlinConvCoef(ida, sharp_newton);
    IDASetNoInactiveRootWarn(ida);
    const bool is_hit = std::any_of(model.contacts.begin(), model.contacts.end(),
                                    [](const Contact& c) { return c.takes_impulses(); });
    if (is_hit) start_part = first_step_part_of_flights;
    uses_jet_steps = in_closed_form(model) && !is_hit;
    directions.assign(problem.slots(), -1);
    found.assign(problem.slots(), 0);
  }
  ~Memory() {
    IDAFree(&ida);
    newton.reset();
    SUNLinSolFree(solver);
    SUNMatDestroy(matrix);
    for (N_Vector v : {y, yp, work}) N_VDestroy(v);
    SUNContext_Free(&context);
  }
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;

  static int residual(realtype t, N_Vector y, N_Vector yp, N_Vector r, void* self) {
    auto* m = static_cast<Memory*>(self);
    double cj = 0.0;
    IDAGetCurrentCj(m->ida, &cj);
    m->problem.residual(t, 1.0 / cj, NV_DATA_S(y), NV_DATA_S(yp), NV_DATA_S(r));
    return 0;
  }
  static int weights(N_Vector y, N_Vector w, void* self) {
    auto* m = static_cast<Memory*>(self);
    long steps = 0;
    double h = m->first;
    if (IDAGetNumSteps(m->ida, &steps) == IDA_SUCCESS && steps > 0) IDAGetLastStep(m->ida, &h);
    m->problem.weights(NV_DATA_S(y), h > 0.0 ? 1.0 / h : 0.0, NV_DATA_S(w));
    if (m->in_jet_steps) N_VScale(no_error_test, w, w);
    return 0;
  }
  static int roots(realtype t, N_Vector y, N_Vector yp, realtype* g, void* self) {
    auto* m = static_cast<Memory*>(self);
    if (m->in_jet_steps) {
      std::fill(g, g + m->problem.slots(), 1.0);
      return 0;
    }
    ++m->guard_evaluations;
    m->problem.guards(t, NV_DATA_S(y), NV_DATA_S(yp), g);
    return 0;
  }
  static int jacobian(realtype t, realtype cj, N_Vector y, N_Vector yp, N_Vector, SUNMatrix, void* self,
                      N_Vector, N_Vector, N_Vector) {
    auto* m = static_cast<Memory*>(self);
    m->problem.linearise(t, NV_DATA_S(y), NV_DATA_S(yp));
    m->problem.linear().set_cj(cj);
    return 0;
  }
  static void on_error(int, const char*, const char*, char* text, void* self) {
    static_cast<Memory*>(self)->message = text;
  }

  /// Starts IDA with the first step h0, a time steps * h0 before the segment's beginning, and takes the `steps` steps up to
  /// this beginning with solutions from the jet.
  void begin(double h0, int steps = 0) {
    const double before = steps * h0;
    problem.evaluate_jet(*start, -before, 0, NV_DATA_S(y));
    problem.evaluate_jet(*start, -before, 1, NV_DATA_S(yp));
    check(IDAReInit(ida, start->t - before, y, yp), "IDAReInit");
    IDASetInitStep(ida, h0);
    first = h0;
    IDASetStopTime(ida, segment.end);
    // The polynomials of the guards must resolve the surface motions. These are not part of y, so IDA's error test does not
    // limit the step accordingly.
    const double shaking = segment.forcing->surface_omega();
    const double longest = shaking > 0.0 ? surface_step / shaking : 0.0;
    IDASetMaxStep(ida, steps > 0 ? h0 : longest);
    // Restart the root search. Otherwise IDA ignores guards that were zero at the end of the last segment.
    IDARootInit(ida, 0, nullptr);
    IDARootInit(ida, static_cast<int>(problem.slots()), &Memory::roots);
    if (!directions.empty()) IDASetRootDirection(ida, directions.data());
    t_previous = start->t;
    reported_end = start->t;
    if (steps > 0) take_jet_steps(steps);
    IDASetMaxStep(ida, longest);
  }

  /// Takes IDA's steps before the segment, up to the beginning of the segment. These steps cannot fail: error tests are
  /// disabled, and each step is far longer than the resolution of time.
  void take_jet_steps(int steps) {
    in_jet_steps = true;
    newton->prescribe_jet(start);
    double t = 0.0;
    for (int i = 0; i < steps; ++i)
      check(IDASolve(ida, segment.end + std::abs(segment.end), &t, y, yp, IDA_ONE_STEP), "IDASolve");
    newton->prescribe_jet(nullptr);
    in_jet_steps = false;
  }

  /// Number (RestartOrder::order) and length of the steps before the segment, or 0 and the length of the first step. 0 in three
  /// cases: user functions, which are not defined before the segment; step lengths near the resolution of time; and rigid
  /// contacts, whose ever shorter flights need shorter steps than the error test requires at any order.
  [[nodiscard]] RestartOrder past() {
    if (uses_jet_steps)
      if (const RestartOrder r = jet_steps(); r.length > shortest_jet_step * std::abs(start->t)) return r;
    return {0, first_step()};
  }
  [[nodiscard]] RestartOrder jet_steps() {
    problem.fill(*start, 0, NV_DATA_S(y));
    problem.weights(NV_DATA_S(y), 0.0, NV_DATA_S(work));
    const double shaking = segment.forcing->surface_omega();
    double h = longest_jet_step * (segment.end - start->t);
    if (shaking > 0.0) h = std::min(h, surface_step / shaking);
    constexpr std::size_t order = RestartOrder::order + 1;
    problem.fill(*start, order, NV_DATA_S(yp));
    if (const double norm = N_VWrmsNorm(yp, work); norm > 0.0)
      h = std::min(h, jet_step_part * std::pow(order / norm, 1.0 / order));
    return {RestartOrder::order, h};
  }

  /// Length h of the first step for a start at order one: every error term h^k y^(k)/k!, k > 1, is at most start_part^k
  /// tolerances. If the solution is constant, h is the length of the segment.
  double first_step() {
    const double remaining = segment.end - start->t;
    double h = remaining;
    problem.fill(*start, 0, NV_DATA_S(y));
    problem.weights(NV_DATA_S(y), 0.0, NV_DATA_S(work));
    double factorial = 1.0;
    for (std::size_t order = 2; order <= static_cast<std::size_t>(motion::Jet::orders); ++order) {
      factorial *= static_cast<double>(order);
      problem.fill(*start, order, NV_DATA_S(yp));
      const double norm = N_VWrmsNorm(yp, work);
      if (norm > 0.0)
        h = std::min(h, start_part * std::pow(factorial / norm, 1.0 / static_cast<double>(order)));
    }
    return h;
  }

  [[nodiscard]] bool massless() const { return problem.layout().massive < problem.layout().dofs; }

  /// Corrects the velocities of massless degrees of freedom in y' at t, by one Newton step with the matrix of the last step.
  /// Reason: the derivative of a step's polynomial is one order less accurate than the polynomial; after a restart its error is
  /// h u''/2. Solving C v = P - K u - ... for v alone would amplify the error of u by K/C. The Newton step does not amplify
  /// this error: for C < h K it hardly changes the derivative.
  void correct_massless_rates(double t) {
    double *derivative = NV_DATA_S(yp), *change = NV_DATA_S(work);
    const double cj = problem.linear().cj();
    problem.residual(t, 1.0 / cj, NV_DATA_S(y), derivative, change);
    problem.linear().solve(change, change);
    for (std::size_t i = 0; i < problem.layout().velocity.size(); ++i)
      if (problem.layout().velocity[i] < 0) derivative[i] -= cj * change[i];
  }

  void add_counters(Counters& c) {
    long setups = 0, error_fails = 0, convergence_fails = 0, iterations = 0;
    IDAGetNumLinSolvSetups(ida, &setups);
    IDAGetNumErrTestFails(ida, &error_fails);
    IDAGetNumNonlinSolvConvFails(ida, &convergence_fails);
    IDAGetNumNonlinSolvIters(ida, &iterations);
    c.residuals = newton->residuals();
    c.jacobians += setups - counted.jacobians;
    c.error_test_failures += error_fails - counted.error_test_failures;
    c.convergence_failures += convergence_fails - counted.convergence_failures;
    c.solves += iterations - counted.solves;
    counted.jacobians = setups;
    counted.error_test_failures = error_fails;
    counted.convergence_failures = convergence_fails;
    counted.solves = iterations;
    c.factorisations = problem.linear().factorisations();
    c.refactorisations = problem.linear().refactorisations();
    c.guard_evaluations = guard_evaluations;
    for (std::size_t order = 0; order < steps_by_order.size(); ++order) {
      if (steps_by_order[order] == 0) continue;
      c.steps += steps_by_order[order];
      c.steps_by_order[static_cast<int>(order)] += steps_by_order[order];
      steps_by_order[order] = 0;
    }
  }

  /// Continues to the next step after a root that was no event. IDA's further stops in the same step are skipped, because the
  /// polynomials of this step have already been examined.
  int leave_step(int flag, double far, double& t) {
    for (double end = 0.0; flag == IDA_SUCCESS || flag == IDA_ROOT_RETURN;
         flag = IDASolve(ida, far, &t, y, yp, IDA_ONE_STEP)) {
      IDAGetCurrentTime(ida, &end);
      if (end > reported_end) break;
    }
    return flag;
  }

  IdaProblem problem;
  SUNContext context = nullptr;
  N_Vector y = nullptr, yp = nullptr, work = nullptr;
  void* ida = nullptr;
  SUNMatrix matrix = nullptr;
  SUNLinearSolver solver = nullptr;
  std::unique_ptr<StepNewton> newton;
  bool uses_jet_steps = true;
  double start_part = first_step_part;
  double first = 0.0;  // length of the first step of the segment
  std::vector<int> directions;
  engine::Segment segment;
  const motion::Jet* start = nullptr;  // jet at the segment's beginning
  std::string message;
  double unit_of_time;
  double t_previous = 0.0;      // beginning of the last accepted step
  double reported_end = 0.0;    // end of the last returned step
  double evaluated_time = 0.0;  // time to which the values in y and yp belong
  bool in_jet_steps = false;    // IDA takes the steps before the segment, with solutions from the jet
  bool ended_at_root = false;   // the last returned step ended at a root
  std::vector<int> found;
  long guard_evaluations = 0;
  std::array<long, events::max_degree + 1> steps_by_order{};  // steps since the last count()
  Counters counted;  // IDA's counts since its restart that were already added
};

BdfIntegrator::BdfIntegrator(const Model& model, const linear::SystemMatrices& structure,
                             const engine::Tolerance& tolerance, int max_order, Counters& counters)
    : counters_(counters), m_(std::make_unique<Memory>(model, structure, tolerance, max_order)) {}

BdfIntegrator::~BdfIntegrator() = default;

void BdfIntegrator::count() { m_->add_counters(counters_); }

RestartOrder BdfIntegrator::start(const engine::Segment& segment, const motion::Jet& jet,
                                  const events::GuardMonitor& watch) {
  count();  // IDA resets its counts at a restart
  m_->segment = segment;
  m_->start = &jet;
  m_->problem.start(segment, watch);
  const RestartOrder past = m_->past();
  m_->begin(past.length, past.steps);
  m_->counted = Counters{};
  m_->ended_at_root = false;
  ++counters_.restarts;
  return past;
}

BdfStep BdfIntegrator::advance() {
  BdfStep step;
  double t = 0.0;
  // In one-step mode, IDA uses the argument tout only to choose a first step, so tout may be any later time.
  const double far = m_->segment.end + (m_->segment.end - m_->t_previous) + std::abs(m_->segment.end);
  int flag = IDASolve(m_->ida, far, &t, m_->y, m_->yp, IDA_ONE_STEP);
  if (flag >= 0 && m_->ended_at_root) flag = m_->leave_step(flag, far, t);
  const bool first = m_->reported_end == m_->start->t;
  double h0 = 0.0;
  for (int retry = 0; flag < 0 && first && retry < max_retries; ++retry) {
    count();
    if (h0 == 0.0) h0 = m_->first_step();
    h0 /= 10.0;
    m_->begin(h0);
    m_->counted = Counters{};
    flag = IDASolve(m_->ida, far, &t, m_->y, m_->yp, IDA_ONE_STEP);
  }
  if (flag < 0) {
    char* name = IDAGetReturnFlagName(flag);
    step.kind = BdfStep::Kind::failed;
    step.begin = step.end = m_->reported_end;
    step.reason =
        fmt::format("IDA cannot continue: {}: {}", name, convert_times(m_->message, m_->unit_of_time));
    std::free(name);
    return step;
  }
  IDAGetLastOrder(m_->ida, &step.order);
  IDAGetLastStep(m_->ida, &step.length);
  double end = 0.0;
  IDAGetCurrentTime(m_->ida, &end);
  if (flag == IDA_TSTOP_RETURN) end = t;  // the stop time itself; IDA's current time may differ by rounding
  step.begin = m_->reported_end;
  step.end = end;
  m_->reported_end = end;
  ++m_->steps_by_order[static_cast<std::size_t>(step.order)];
  // In IDA's y' the velocities of massless degrees of freedom are inaccurate. NaN makes evaluate() compute them again.
  m_->evaluated_time = m_->massless() ? std::numeric_limits<double>::quiet_NaN() : t;
  m_->ended_at_root = flag == IDA_ROOT_RETURN;
  if (m_->ended_at_root) {
    step.kind = BdfStep::Kind::root;
    step.root = t;
    std::vector<int>& found = m_->found;
    IDAGetRootInfo(m_->ida, found.data());
    for (std::size_t slot = 0; slot < found.size(); ++slot)
      if (found[slot] != 0)
        step.triggered.push_back(
            {m_->segment.decision->layout.contact_of_guard(slot), m_->segment.decision->guards[slot].kind});
  }
  return step;
}

void BdfIntegrator::evaluate(double t, motion::Point& point) {
  if (t != m_->evaluated_time) {
    check(IDAGetDky(m_->ida, t, 0, m_->y), "IDAGetDky");
    if (m_->massless()) {
      check(IDAGetDky(m_->ida, t, 1, m_->yp), "IDAGetDky");
      m_->correct_massless_rates(t);
    }
    m_->evaluated_time = t;
  }
  m_->problem.read(NV_DATA_S(m_->y), NV_DATA_S(m_->yp), point);
}

void BdfIntegrator::keep_correction() {
  check(IDAGetEstLocalErrors(m_->ida, m_->work), "IDAGetEstLocalErrors");
}

ContactMotion BdfIntegrator::correction(std::size_t contact) const {
  return m_->problem.change(contact, NV_DATA_S(m_->work));
}

double BdfIntegrator::residual() {
  // y' of the BDF formula, y' = y'_predicted + cj (y - y_predicted), satisfies the equations. The derivative of the
  // interpolating polynomial, which IDAGetDky returns, does not.
  double end = 0.0, cj = 0.0;
  N_Vector y_predicted = nullptr, yp_predicted = nullptr, y = nullptr, yp = nullptr, r = nullptr;
  void* data = nullptr;
  IDAGetNonlinearSystemData(m_->ida, &end, &y_predicted, &yp_predicted, &y, &yp, &r, &cj, &data);
  IDAGetCurrentTime(m_->ida, &end);
  IDAGetDky(m_->ida, end, 0, m_->y);
  N_VLinearSum(cj, m_->y, -cj, y_predicted, m_->yp);
  N_VLinearSum(1.0, m_->yp, 1.0, yp_predicted, m_->yp);
  m_->evaluated_time = std::numeric_limits<double>::quiet_NaN();
  return m_->problem.imbalance(end, NV_DATA_S(m_->y), NV_DATA_S(m_->yp));
}

}  // namespace signorini::ida
