// bdf_integrator.hpp: SUNDIALS IDA on the first-order form.
//
//   0 = u' - v
//   0 = M v' + C v + K u - P(t) + sum_k ( n_k N_k + t_k T_k )
//   0 = rows of each contact's state
//
// y = [u, v, N, T]; degrees of freedom without mass have no v: their row is the second one, with u' as velocity (index
// 1). The segment's rows stay in force past an event; guards are IDA's root functions, positive before their event,
// watched for downward crossings only, and masked (+1) while idle or not armed.
#pragma once

#include <memory>

#include "engine/events/active_guards.hpp"
#include "engine/ida/restart_order.hpp"
#include "engine/stepper.hpp"
#include "engine/tolerance.hpp"

namespace signorini::ida {

/// A step of IDA; its inside has not yet been examined.
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

  /// jet: whole jet at the segment's beginning; watch: armed guards. Both must outlive the segment. Returns the past
  /// that IDA was given.
  RestartOrder start(const engine::Segment& segment, const motion::Jet& jet,
                     const events::GuardMonitor& watch);
  [[nodiscard]] BdfStep advance();
  void evaluate(double t, motion::Point& point);
  /// Keeps the correction of the last step: solution minus prediction. IDA estimates the local error from it; with
  /// equal steps of order k the error is 1/(k + 1) of it.
  void keep_correction();
  /// N, T, gap, ut, vn, vt of a contact in that correction; velocities without those of massless parts.
  [[nodiscard]] ContactMotion correction(std::size_t contact) const;
  [[nodiscard]] double residual();
  void count();

 private:
  struct Memory;
  Counters& counters_;
  std::unique_ptr<Memory> m_;
};

}  // namespace signorini::ida
