// bdf_integrator.hpp: SUNDIALS IDA on the first-order form.
//
//   0 = u' - v
//   0 = M v' + C v + K u - P(t) + sum_k ( n_k N_k + t_k T_k )
//   0 = rows of each contact's state
//
// y = [u, v, N, T]. Degrees of freedom without mass have no v: their row is the second one, with u' as
// velocity, and the system has index 1. The rows of a segment are valid until the next one starts, also after
// an event. Guards are IDA's root functions: positive before their event, with downward crossings only, and
// set to +1 while idle or not armed.
#pragma once

#include <memory>

#include "engine/events/active_guards.hpp"
#include "engine/ida/restart_order.hpp"
#include "engine/stepper.hpp"
#include "engine/tolerance.hpp"

namespace signorini::ida {

/// A step of IDA, not yet examined for zero crossings inside it.
struct BdfStep {
  enum class Kind { accepted, root, failed } kind = Kind::accepted;
  double begin = 0.0, end = 0.0;  ///< ends of the accepted step
  double root = 0.0;              ///< Kind::root: time at which a guard reached zero, begin < root <= end
  std::vector<decide::TriggeredGuard> triggered;  ///< Kind::root
  double length = 0.0;                            ///< length of the step, free of the rounding of its ends
  int order = 1;                                  ///< degree of the solution's polynomial on the step
  std::string reason;                             ///< Kind::failed
};

class BdfIntegrator {
 public:
  /// counters: receives the counts; complete after count().
  BdfIntegrator(const Model& model, const linear::SystemMatrices& structure,
                const engine::Tolerance& tolerance, int max_order, Counters& counters);
  ~BdfIntegrator();
  BdfIntegrator(const BdfIntegrator&) = delete;
  BdfIntegrator& operator=(const BdfIntegrator&) = delete;

  /// jet: whole jet at the segment's beginning; watch: armed guards. Both must outlive the segment. Returns
  /// the steps that IDA has taken on the jet before the segment (restart_order.hpp).
  RestartOrder start(const engine::Segment& segment, const motion::Jet& jet,
                     const events::GuardMonitor& watch);
  [[nodiscard]] BdfStep advance();
  /// u, v and forces at a time of the last step.
  void evaluate(double t, motion::Point& point);
  /// Stores the correction of the last step: solution minus prediction. The local error is proportional to
  /// it, with equal steps of order k by the factor 1/(k + 1).
  void keep_correction();
  /// N, T, gap, ut, vn, vt of a contact in the stored correction; velocities without those of massless parts.
  [[nodiscard]] ContactMotion correction(std::size_t contact) const;
  /// DenseOutput::residual.
  [[nodiscard]] double residual();
  /// Adds IDA's counts to the counters.
  void count();

 private:
  struct Memory;
  Counters& counters_;
  std::unique_ptr<Memory> m_;
};

}  // namespace signorini::ida
