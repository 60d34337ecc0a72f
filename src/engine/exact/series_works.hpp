// series_works.hpp: works and dissipations on a step of the exact flow, and of flights that `ida` follows by series.
//
//   integral of P . v, v^T C v, T p', -T s'    Gauss-Legendre on the step's polynomials (motion/powers.hpp)
#pragma once

#include <array>

#include "engine/exact/gauss_rule.hpp"
#include "engine/exact/pieced_series.hpp"
#include "motion/powers.hpp"

namespace signorini {

class SeriesWorks {
 public:
  SeriesWorks(const Model& model, const Structure& structure);

  static constexpr std::size_t nodes = GaussRule::nodes;

  /// Adds the integrals over [from, to] of the series. growth: upper limit for the motion's rate, rad per time.
  void add(const Mode& mode, const Forcing& forcing, const PiecedSeries& motion, double growth, double from,
           double to, Works& works);

 private:
  using Nodes = std::array<double, nodes>;
  void velocities_at(const Nodes& x, std::size_t count, const PiecedSeries& motion);
  void velocities_of_pieces(const Nodes& x, std::size_t count, const PiecedSeries& motion);
  void add_own(std::size_t c, const Forcing& forcing, const Series& series, const ContactSeries& contact,
               double from, double to, Works& works) const;
  void add_bowl(std::size_t c, const Forcing& forcing, const Series& series, const ContactSeries& path,
                std::size_t degree, double from, double to, Works& works);

  const Model& model_;
  const Structure& structure_;
  bool damped_;
  Eigen::MatrixXd powers_, velocities_;  // one column for each node
  std::vector<double> slide_rate_;
};

}  // namespace signorini
