// ida_problem.hpp: residual, error weights and root functions called by IDA; no solver state.
//
//   r1 = u' - v,   r2 = M v' + C v + K (u - r1/cj) - P + n N + t T,   rows of contacts at u - r1/cj
//
// Rows are combined in the form that the condensed solver needs (engine/ida/ida_linear_solver.hpp). They are
// zero for the same y and y' as without r1/cj, and a solve needs no additional product with K.
#pragma once

#include "decide/guard_signs.hpp"
#include "engine/events/active_guards.hpp"
#include "engine/ida/ida_linear_solver.hpp"
#include "engine/stepper.hpp"
#include "engine/tolerance.hpp"
#include "linear/system_matrices.hpp"

namespace signorini::ida {

class IdaProblem {
 public:
  IdaProblem(const Model& model, const linear::SystemMatrices& structure, const engine::Tolerance& tolerance);

  void start(const engine::Segment& segment, const events::GuardMonitor& watch);

  /// r = F(t, y, y') with rows combined for cj = 1/step; step = 0: the rows themselves.
  void residual(double t, double step, const double* y, const double* yp, double* r);
  /// Writes the tangents of nonlinear rows (friction that depends on the slip rate) into the linear solver.
  void linearise(double t, const double* y, const double* yp);
  /// Largest magnitude of an entry of the residual of the equation of motion. Unit: force.
  [[nodiscard]] double imbalance(double t, const double* y, const double* yp) const;
  /// Writes the error weights of all unknowns: 1 / tolerance, scaled by groups (factor_). rate: 1/h, for the
  /// resolution of time; 0 before the first step is known.
  void weights(const double* y, double rate, double* w) const;
  /// Scaled guards, one for each slot; masked guards are +1.
  void guards(double t, const double* y, const double* yp, double* g) const;
  /// y (derivative = 0) or y' (1) on the jet's polynomials, x after the jet's instant.
  void evaluate_jet(const motion::Jet& jet, double x, int derivative, double* y) const;
  /// Writes y^(order) from a jet.
  void fill(const motion::Jet& jet, std::size_t order, double* y) const;
  /// Reads u, v and forces from IDA's vectors.
  void read(const double* y, const double* yp, motion::Point& point) const;

  [[nodiscard]] const Layout& layout() const { return layout_; }
  [[nodiscard]] std::size_t slots() const { return layout_.contacts.guard_count(); }

  /// True if a contact slips whose friction rises with its slip rate.
  [[nodiscard]] bool has_rate_dependent_friction() const { return rate_dependent_; }

  /// N, T, gap, ut, vn, vt of a contact for a change of the unknowns; velocities without those of massless parts.
  [[nodiscard]] ContactMotion change(std::size_t contact, const double* of) const;

  [[nodiscard]] IdaLinearSolver& linear() { return linear_; }

 private:
  void add_shared(const double* y, double* r) const;
  /// step: the motion is taken at u - step (u' - v).
  [[nodiscard]] ContactMotion motion(std::size_t k, double t, const double* y, const double* yp,
                                     double step = 0.0) const;

  /// Calls f(i, v) for each degree of freedom i, v the index of its velocity.
  template <class F>
  struct ByDof {
    const Layout& layout;
    F f;
    double operator[](int i) const {
      const auto dof = static_cast<std::size_t>(i);
      return f(dof, layout.velocity[dof]);
    }
  };
  template <class F>
  [[nodiscard]] ByDof<F> by_dof(F f) const {
    return {layout_, f};
  }

  /// Raises tolerances to the rounding of the forces that determine massless degrees of freedom, and of the
  /// contact forces on them.
  void widen_massless(const double* y, double* w) const;

  /// Lists the guards of the segment in watched_guards_.
  void list_watched_guards();
  /// Adds an entry to stopped_masses_ if the form moves mass.
  void add_stopped_mass(const Combination& form, int force);

  const Model& model_;
  const linear::SystemMatrices& structure_;
  Layout layout_;
  IdaLinearSolver linear_;
  const engine::Tolerance tolerance_;
  engine::Segment segment_;
  const events::GuardMonitor* guard_monitor_ = nullptr;
  // IDA's norm is a mean over all unknowns, in which the errors of few contacts on a large structure would
  // vanish. So each contact has a group of N and T and a group of u and v of its degrees of freedom; all
  // other unknowns form one more group. The mean of every group counts in full.
  std::vector<double> factor_, atol_;
  std::vector<int> unused_;  // places without a force
  // Degrees of freedom without mass are determined by forces K u, which may be differences of large numbers:
  // after a long slide their rounding is large. stiffness: of K and of closed contacts.
  struct Massless {
    int dof = 0;
    double stiffness = 0.0;
    std::vector<std::pair<int, double>> forces;  ///< contact forces on it: unknown, factor
  };
  std::vector<Massless> massless_;
  // Constraint forces that stop a mass m: they correct the rounding of its velocity v within one step, by a
  // force m v eps / h. A tolerance below that cannot be met, and a smaller step would raise the force.
  struct StoppedMass {
    const Combination* form;
    int force;
    double mass;  ///< moved by the form, from the diagonal of M
  };
  std::vector<StoppedMass> stopped_masses_;
  // Guards that IDA watches: those of the segment that are linear without accelerations, or have products.
  struct WatchedGuard {
    std::size_t contact = 0, slot = 0;
    const GuardForm* guard = nullptr;
    decide::QuickForm form;  ///< of guard
    double unit = 1.0;       ///< divisor that makes a linear guard O(1)
  };
  std::vector<WatchedGuard> watched_guards_;
  std::vector<linear::SharedForces> shared_;  // of the contact states of this segment
  std::vector<std::size_t> nonlinear_;  // contacts in this segment that slip with rate-dependent friction
  bool rate_dependent_ = false;
  linear::StructuralForces structural_forces_;
  std::vector<double> forces_;  // forces on all degrees of freedom, if some have no mass
  std::vector<double> u_;       // displacements in a residual
};

}  // namespace signorini::ida
