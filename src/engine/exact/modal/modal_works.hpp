// modal_works.hpp: works and dissipations of an interval in modes, in closed form.
//
//   y'' + alpha y' + l y = 0:   int y_k' y_l' and int y_k y_l' are forms on the values of y and y' at both
//   ends, divided by (l_k - l_l)^2 + 2 alpha^2 (l_k + l_l)
//
// Damping dissipates alpha int q'^T q' = alpha sum x_k^T x_l int z_k' z_l', which is alpha sum int z_k'^2 if
// no contact slips. Friction dissipates int T p', in which g and ut' are sums over modes as well. The energy
// balance is an independent check. Forces are constant in the interval; modes without frequency move like
// z = a + d t + y, d = p/alpha.
#pragma once

#include "engine/exact/modal/modal_proof.hpp"
#include "motion/point.hpp"

namespace signorini::modal {

class ModalWorkIntegrals {
 public:
  ModalWorkIntegrals(const Model& model, double alpha) : model_(model), alpha_(alpha) {}

  /// False if a frequency is too low for the closed form of works, but too high to count as zero.
  [[nodiscard]] static bool is_accurate_for(const Spectrum& spectrum, double t_end);

  /// All arguments except t_end must live until the next start.
  void start(const engine::Segment& segment, const StateModes& state, const Oscillators& oscillators,
             const Amplitudes& forces, double t_end);
  /// Adds the integrals over the time between two points of the segment.
  void add(const ModalProof& proof, const ModalPoint& from, const ModalPoint& to, double time,
           motion::WorkIntegrals& works) const;

  /// Square of a mode's frequency, and the oscillating part y of the mode with its rate r at both ends of an
  /// interval.
  template <class S>
  struct Ends {
    S l{}, y0{}, r0{}, y1{}, r1{};
  };
  /// Same for all modes, for sums over pairs of them.
  struct EndArrays {
    Eigen::ArrayXd l, y0, r0, y1, r1;
  };

 private:
  struct Stretch {
    const ModalPoint &from, &to;
    double time;
    std::vector<Ends<double>> real;
    std::vector<Ends<Complex>> pair;
    std::vector<double> drift;  // d of real modes
    Amplitudes area;            // int z
  };
  /// int q'^T q', and for each contact int (sum a_k y_k)(sum b_k y_k')
  struct Sums {
    double rates = 0.0;
    std::vector<double> crossed;
  };
  [[nodiscard]] Stretch stretch(const ModalPoint& from, const ModalPoint& to, double time) const;
  [[nodiscard]] double with_drifts(const Stretch& s, std::size_t k, std::size_t l, double product) const;
  [[nodiscard]] EndArrays end_arrays(const Stretch& s, const std::vector<std::size_t>& oscillating) const;
  void add_two(const Stretch& s, std::size_t k, std::size_t l, Sums& sums) const;
  void add_oscillating(const EndArrays& arrays, Sums& sums) const;
  void add_real(const Stretch& s, const std::vector<std::size_t>& moving, Sums& sums) const;
  void add_pairs(const Stretch& s, const std::vector<std::size_t>& moving, Sums& sums) const;
  [[nodiscard]] std::vector<std::size_t> moving(const Stretch& s) const;
  [[nodiscard]] double gap_integral(const Stretch& s, std::size_t contact) const;
  [[nodiscard]] double gap_times_slide(const Stretch& s, std::size_t contact, double gap,
                                       double crossed) const;

  const Model& model_;
  double alpha_, zero_frequency_limit_ = 0.0;
  const decide::Decision* decision_ = nullptr;
  const StateModes* state_ = nullptr;
  const Oscillators* oscillators_ = nullptr;
  const Amplitudes* forces_ = nullptr;
  std::vector<std::pair<std::size_t, double>> loads_;  // active loads, and their values
  std::vector<std::size_t> slipping_;                  // indices of slipping contacts
};

}  // namespace signorini::modal
