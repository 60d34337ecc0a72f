// series_works.hpp: works and dissipated energies on a step of ExactEngine, also for the short flights of engine `ida`.
//
//   integral of P . v, v^T C v, T p', -T s'    Gauss-Legendre on the step's polynomials (motion/point.hpp)
#pragma once

#include <array>
#include <cstddef>

#include "engine/exact/patched_series.hpp"
#include "motion/point.hpp"

namespace signorini::exact {

// Gauss-Legendre quadrature on [0, 1].
//
//   int_0^1 f = sum_i w_i f(x_i), exact for polynomials of degree 2 count - 1
//
// The remainder is (count!)^4 / ( (2 count + 1) (2 count)!^3 ) f^(2 count). With six nodes the remainder is 2e-16 if the phase
// angle of the motion on the interval is at most 0.5 rad (at most 1 rad for its power).

struct GaussRule {
  static constexpr std::size_t nodes = 12;
  std::size_t count = nodes;
  std::array<double, nodes> x{}, w{};
};
/// Rule with twelve nodes.
[[nodiscard]] const GaussRule& gauss_rule();
/// Rule with six nodes, for intervals on which the phase angle of the motion is at most `short_angle` (rad).
[[nodiscard]] const GaussRule& short_gauss_rule();
inline constexpr double short_angle = 0.5;

class SeriesWorkIntegrals {
 public:
  SeriesWorkIntegrals(const Model& model, const linear::SystemMatrices& structure);

  static constexpr std::size_t nodes = GaussRule::nodes;

  /// Adds the works between the times `from` and `to` of the series. growth: upper bound of the highest circular frequency of
  /// the motion, rad per time.
  void add(const contact::ContactStates& states, const motion::Forcing& forcing, const PatchedSeries& motion,
           double growth, double from, double to, motion::WorkIntegrals& works);

 private:
  using Nodes = std::array<double, nodes>;
  void velocities_at(const Nodes& x, std::size_t count, const PatchedSeries& motion);
  void velocities_of_pieces(const Nodes& x, std::size_t count, const PatchedSeries& motion);
  void add_contact(std::size_t c, const motion::Forcing& forcing, const motion::Series& series,
                   const motion::ContactSeries& contact, double from, double to,
                   motion::WorkIntegrals& works) const;
  void add_curved_surface(std::size_t c, const motion::Forcing& forcing, const motion::Series& series,
                          const motion::ContactSeries& path, std::size_t degree, double from, double to,
                          motion::WorkIntegrals& works);

  const Model& model_;
  const linear::SystemMatrices& structure_;
  bool damped_;
  Eigen::MatrixXd powers_, velocities_;  // one column for each node
  std::vector<double> slide_rate_;
};

}  // namespace signorini::exact
