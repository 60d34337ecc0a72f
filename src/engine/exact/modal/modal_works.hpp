// modal_works.hpp: works and dissipated energies in an interval, in uncoupled modes and in closed form.
//
//   y'' + alpha y' + l y = 0:   int y_k' y_l' and int y_k y_l' are quadratic functions of y and y' at both ends,
//                               divided by (l_k - l_l)^2 + 2 alpha^2 (l_k + l_l); see mode_pairs.hpp
//
// Damping dissipates alpha int q'^T q' = alpha sum x_k^T x_l int z_k' z_l'. If no contact slips, this is alpha sum int z_k'^2.
// Friction dissipates int T p', a sum over pairs of modes, because T depends on g. The energy balance checks the result
// independently. Forces are constant in the interval. The amplitude of a mode with zero frequency is z = a + d t + y, with the
// drift velocity d = p/alpha.
#pragma once

#include "engine/exact/modal/modal_proof.hpp"
#include "motion/point.hpp"

namespace signorini::modal {

class ModalWorkIntegrals {
 public:
  ModalWorkIntegrals(const Model& model, double alpha) : model_(model), alpha_(alpha) {}

  /// False if a frequency is too low for accurate works in closed form, but too high to be regarded as zero.
  [[nodiscard]] static bool is_accurate_for(const Spectrum& spectrum, double t_end);

  /// Starts a segment. All references must stay valid until the next start.
  void start(const engine::Segment& segment, const StateModes& state, const Oscillators& oscillators,
             const Amplitudes& forces, double t_end);
  /// Adds the works between two points of the segment. time: length of this interval.
  void add(const ModalProof& proof, const ModalPoint& from, const ModalPoint& to, double time,
           motion::WorkIntegrals& works) const;

  /// l of a mode, and the mode's oscillating part y and rate r = y' at the beginning (0) and the end (1) of an interval.
  template <class S>
  struct Ends {
    S l{}, y0{}, r0{}, y1{}, r1{};
  };
  /// Ends of all modes as arrays, for sums over pairs of modes.
  struct EndArrays {
    Eigen::ArrayXd l, y0, r0, y1, r1;
  };

 private:
  /// An interval between two points, with the data of all modes.
  struct Stretch {
    const ModalPoint &from, &to;
    double time;
    std::vector<Ends<double>> real;
    std::vector<Ends<Complex>> pair;
    std::vector<double> drift;  // drift velocity d of each real mode; 0 if the mode has a nonzero frequency
    Amplitudes area;            // time integrals of the amplitudes z
  };
  /// rates: int q'^T q'. crossed: int (sum a_k y_k)(sum b_k y_k') of each contact; 0 if the contact does not slip.
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
  std::vector<std::pair<std::size_t, double>> loads_;  // indices and values of the active loads
  std::vector<std::size_t> slipping_;                  // indices of slipping contacts
};

}  // namespace signorini::modal
