// series_tangents.hpp: advances one tangent along the series of a step, part by part, with its works.
//
//   [0, x_end]  =  parts, each as long as the tangent's own series converges, halved if it does not
//   W_p        +=  sum over Gauss points of factor (power)_p               (work_rates.hpp)
//
// Works over a part of a step use ten Gauss points for each half of a step.
#pragma once

#include "run/run_listener.hpp"
#include "sensitivity/tangent_state.hpp"

namespace signorini {

/// A requested position in a step, in its series.
struct WantedPlace {
  double t = 0.0, x = 0.0;
  bool row = false, turn = false;
};

/// Second derivatives of the contact forces at x.
[[nodiscard]] Vector force_bends(const Series& series, std::size_t degree, double x);
/// Times at which a contact's compression has a maximum: N' reaches zero and then rises.
[[nodiscard]] std::vector<double> pressing_turns(const Model& model, const RunStep& step);

class SeriesTangents {
 public:
  /// model, systems: must outlive the object.
  SeriesTangents(const Model& model, ModeSystems& systems, const std::vector<const ModelDerivative*>& data,
                 bool losses);

  /// Advances to the end of the step; adds the parameter's tangent to samples, one for each requested place.
  void advance(TangentState& state, const RunStep& step, const std::vector<WantedPlace>& wanted,
               std::vector<TangentSample>& samples, std::size_t parameter) const;

 private:
  [[nodiscard]] ModeSystemPtr system_at(const ModeSystem& system, const Series& series) const;
  void integrate(TangentState& state, const RunStep& step, double begin, double from, double to) const;

  const Model& model_;
  ModeSystems& systems_;
  std::vector<Eigen::Index> touched_;  // degrees of freedom on which contacts, or their derivatives, depend
  bool losses_;
};

}  // namespace signorini
