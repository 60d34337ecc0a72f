// discrete_run.hpp: derivatives of the discrete solution of engine `newmark`, not of the exact motion.
//
//   u1 = u0 + h v0 + h^2/4 (a0 + a1),   v1 = v0 + h/2 (a0 + a1)           engine/newmark/newmark_step.hpp
//   Du1 = Du0 + h Dv0 + h^2/4 (Da0 + Da1) + Dh (v0 + h/2 (a0 + a1))
//   Dv1 = Dv0 + h/2 (Da0 + Da1) + Dh/2 (a0 + a1),   Dh = Dt1 - Dt0
//   M Da1 + C Dv1 + K Du1 + sum ( n DN1 + t DT1 )
//     = DP(t1) - M_p a1 - C_p v1 - K_p u1 - sum ( n_p N1 + t_p T1 ),   rows of the contacts likewise
//
// D: derivative along the nodes of the time grid, whose times depend on the parameter. A regular step keeps its length:
// Dt1 = Dt0. At a jump of a load Dt1 is the derivative of the time of the jump; at the end of the run Dt1 = 0. For a step up
// to an event, DG = 0 (G: guard) is a linear equation for Dt1. After an event a0 follows from equilibrium, by the same
// equations with h = 0. The class repeats all steps of the engine, and takes the engine's state after each instant.
//
// Requirements: steps of constant length, events at roots of guards, no massless parts, no rate-dependent friction. If a
// requirement is violated, TangentState::reason names it. The results are used to check the derivatives of the exact motion;
// both agree to O(h^2).
#pragma once

#include "engine/newmark/newmark_step.hpp"
#include "sensitivity/tangent_run.hpp"

namespace signorini::sensitivity {

class DiscreteRun final : public run::RunListener {
 public:
  /// Arguments as in TangentRun; all except `run` must outlive the object.
  DiscreteRun(const Model& model, const RunSpec& run, const std::vector<ModelDerivative>& derivatives,
              const std::vector<double>& sizes, TangentListener& listener);

  /// Empty: the listener needs no additional data from the engine.
  [[nodiscard]] static run::ListenerNeeds needs() { return {}; }
  void begin(const run::RunInstant& start) override;
  void step(const run::RunStep& step) override;
  void instant(const run::RunInstant& instant) override;

  [[nodiscard]] const std::vector<TangentState>& states() const { return states_; }

 private:
  /// A node of the time grid.
  struct Node {
    double t = 0.0;
    motion::Point point;
  };
  /// Derivatives of a node, including its time, with respect to one parameter.
  struct NodeDerivative {
    double t = 0.0;
    Vector u, v, a, forces;
    std::vector<double> anchors;
  };
  /// The two ends of a step, with the derivatives at its beginning for one parameter.
  struct Ends {
    const Node &from, &to;
    const NodeDerivative& moved;
    const ForcingDerivatives&
        forcing;  ///< derivatives of the forcing at the end of the step, as a series with scale 1
  };

  void stop(const std::string& reason, double t);
  void factorise(double h);
  [[nodiscard]] Node repeat_step(const motion::Forcing& forcing, double t);
  [[nodiscard]] ForcingDerivatives forcing_at(std::size_t parameter, double t) const;
  [[nodiscard]] NodeDerivative advance(std::size_t parameter, const motion::Forcing& forcing,
                                       const Ends& ends, double Dt);
  void add_rows(std::size_t parameter, const motion::Forcing& forcing, const Ends& ends,
                const NodeDerivative& known);
  [[nodiscard]] ContactMotion along(std::size_t parameter, std::size_t contact,
                                    const motion::Forcing& forcing, const Node& at,
                                    const NodeDerivative& moved, const ForcingDerivatives& series) const;
  [[nodiscard]] double end_of(std::size_t parameter, const run::RunStep& step, const Ends& ends);
  void row(const run::RunStep& step, double t);
  void hit(std::size_t parameter, const run::RunInstant& instant);
  void hold(std::size_t parameter, const run::RunInstant& instant);
  void pass(const run::RunInstant& instant);
  void rows_at(const run::RunInstant& instant);
  void fill(std::size_t parameter, const run::RunInstant& instant, const Node& before,
            const NodeDerivative& was);

  const Model& model_;
  linear::SystemMatrices structure_;
  motion::StateSystems systems_;
  TangentListener& listener_;
  std::vector<TangentState> states_;
  std::vector<double> grid_;
  std::size_t next_ = 0;
  double t_end_;
  newmark::NewmarkStep step_;
  linear::SystemMatrix matrix_;
  double factored_ = -1.0;  // step length h for which matrix_ is factored; -1: not factored
  contact::ContactStates contact_states_;
  Node node_;
  std::vector<NodeDerivative> node_derivatives_;  // derivatives of node_, one entry per parameter
  std::vector<std::vector<double>> impulse_n_, impulse_t_;
  Vector x_, work_;
};

}  // namespace signorini::sensitivity
