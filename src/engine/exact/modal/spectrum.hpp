// spectrum.hpp: eigenvalues and eigenvectors of a diagonal matrix plus a matrix of low rank (a few contact springs).
//
//   A = D + U V^T,   det( 1 + V^T (D - l)^-1 U ) = 0
//   right  x = (D - l)^-1 U c,   left  y = (D - l)^-1 V d,   y^T x = 1
//   (1 + V^T (D - l)^-1 U) c = 0,   (1 + U^T (D - l)^-1 V) d = 0
//
// D contains the squares of the frequencies of the unconstrained modes, called poles. U and V are the springs of closed
// contacts in these modes; U V^T is not symmetric if a contact slips. All roots l are computed simultaneously (Ehrlich,
// Aberth). A root is stored as a pole and an offset from this pole, so that even a small D_i - l is accurate. The matrices X
// and Y of the eigenvectors have entries with the factor 1 / (D_i - l_k); products with X or Y take n^2 operations. X and Y are
// stored if they are small enough. So that every root is simple, equal poles are separated, and zero rows get tiny entries;
// both changes are far below rounding.
// Sources: Aberth, Math. Comp. 27 (1973), 339; Gu and Eisenstat, SIAM J. Matrix Anal. Appl. 15 (1994), 1266.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/exact/modal/small_matrices.hpp"

namespace signorini::modal {

/// Separation of equal poles, relative to the pole; far below rounding.
inline constexpr double pole_separation = 1e-22;

/// The poles D_i in ascending order, each as the sum base + separation. The separation makes equal poles distinct.
struct Poles {
  explicit Poles(const Eigen::VectorXd& values);
  Poles() = default;
  std::vector<double> base, separation;
  [[nodiscard]] std::size_t size() const { return base.size(); }
  /// Difference D_a - D_b, accurate also for equal poles.
  [[nodiscard]] double pole_difference(std::size_t a, std::size_t b) const {
    return (base[a] - base[b]) + (separation[a] - separation[b]);
  }
};

/// Either the real eigenvalues, or one eigenvalue of each conjugate pair (that with positive imaginary part).
template <class S>
struct Roots {
  std::vector<std::size_t> pole_index;  ///< index of the pole to which the offset refers
  std::vector<S> offset;                ///< value minus this pole
  std::vector<S> value;
  std::vector<S> right, left;  ///< c and d, `rank` numbers for each root, scaled to |x| = 1, y^T x = 1
  [[nodiscard]] std::size_t size() const { return pole_index.size(); }
};

/// Amplitudes of all modes of a spectrum. For a conjugate pair, only the amplitude of one mode is stored.
struct Amplitudes {
  std::vector<double> real;
  std::vector<Complex> pair;
};

/// c and h = U^T x of each mode, `rank` numbers each, for the products of two different modes:
///   x_k^T x_l = (h_k . c_l - c_k . h_l) / (l_k - l_l)
struct VectorProducts {
  std::vector<double> c, h;
  std::vector<Complex> c_pair, h_pair;
};

/// Largest number of modes for which X and Y are stored. Memory: 16 n^2 bytes for each contact state, 16 MB at the limit.
inline constexpr std::size_t max_stored_modes = 1024;

class Spectrum {
 public:
  /// u, v: U and V, n x rank; sets failure() if rank > max_rank. symmetric: each column of V is a positive multiple of the same
  /// column of U, so that all roots are real. max_stored: largest number of modes for which X and Y are stored.
  Spectrum(const Poles& poles, Eigen::MatrixXd u, Eigen::MatrixXd v, bool symmetric,
           std::size_t max_stored = max_stored_modes);

  /// Reason why the modes cannot be used. Empty: the modes can be used.
  [[nodiscard]] const std::string& failure() const { return failure_; }
  /// Real eigenvalues, ascending. pairs(): one eigenvalue of each conjugate pair. Both in the order of Amplitudes.
  [[nodiscard]] const std::vector<double>& real() const { return values_; }
  [[nodiscard]] const std::vector<Complex>& pairs() const { return pairs_.value; }
  /// Greatest |x| |y| of all modes with y^T x = 1. round_trip(): |X Y q - q| for a test vector q, entries between -1 and 1.
  [[nodiscard]] double condition() const { return condition_; }
  [[nodiscard]] double round_trip() const { return round_trip_; }

  /// Amplitudes of the zero motion.
  [[nodiscard]] Amplitudes zero() const {
    return {std::vector<double>(real().size(), 0.0), std::vector<Complex>(pairs().size())};
  }
  /// Computes the amplitudes z := Y q of a motion. of_form(): computes row := X^T form, the coefficient of each mode in a form.
  void to_modes(const Eigen::VectorXd& q, Amplitudes& z) const { to_modes({&q}, {&z}); }
  void to_modes(const std::vector<const Eigen::VectorXd*>& q, const std::vector<Amplitudes*>& z) const;
  void of_form(const Eigen::VectorXd& form, Amplitudes& row) const { project(form, true, row); }
  [[nodiscard]] const VectorProducts& products() const { return products_; }
  /// x_k^T x_l of two different real modes. norm_squared(): x_k^T x_k of a real mode. pair_norm_squared(): x_k^T x_k of a
  /// complex mode (without conjugation).
  [[nodiscard]] double product(std::size_t k, std::size_t l) const;
  [[nodiscard]] double norm_squared(std::size_t k) const { return squares_[k]; }
  [[nodiscard]] Complex pair_norm_squared(std::size_t k) const { return pair_squares_[k]; }
  [[nodiscard]] std::size_t rank() const { return rank_; }
  /// Computes q := X z for several z at once.
  void from_modes(const std::vector<const Amplitudes*>& z, const std::vector<Eigen::VectorXd*>& q) const;
  /// Memory of X and Y in bytes; 0 if they are not stored.
  [[nodiscard]] std::size_t stored_bytes() const;

 private:
  using Wide = long double;  // for real roots and their vectors
  template <class S>
  bool search(std::vector<S>& offset);
  template <class S>
  void start(std::vector<S>& offset) const;
  /// Newton step on the characteristic polynomial p, and (deflated) on p divided by the factors l - l_i of all other roots.
  template <class S>
  struct Correction {
    S newton, deflated;
  };
  template <class S>
  Correction<S> correction(std::size_t k, const std::vector<S>& offset, const std::vector<S>& shift) const;
  /// Equations of a root near a group of poles (by default, all poles equal to the pole with index home). g: the matrix
  /// G0 = 1 + V^T (D - l)^-1 U, with a sum over the poles outside the group; slope: derivative of G0 by l; s: the matrix S of
  /// the group, which stays finite near the poles of the group:
  ///   S = D_group - l + U_group G0^-1 V_group^T
  ///   det(A - l) = product of (D_i - l) outside * det G0 * det S
  template <class S>
  using Rough = std::conditional_t<std::is_same_v<S, Wide>, double, S>;  // for slopes of the last Newton step
  template <class S>
  struct Local {
    SmallMatrix<S> g{}, s{};
    SmallMatrix<Rough<S>> slope{};
    std::size_t first = 0, count = 0;
  };
  template <class S>
  void begin_local(std::size_t home, Local<S>& local) const;
  template <class S>
  S gather(std::size_t home, S own, Local<S>& local) const;
  template <class S>
  std::optional<S> trace(std::size_t home, S own, Local<S>& local) const;
  [[nodiscard]] Wide refined_offset(std::size_t home, Wide own, Local<Wide>& local) const;
  template <class S>
  void group_matrix(const SmallLu<S>& lu, S own, std::size_t home, Local<S>& local) const;
  template <class S>
  SmallMatrix<S> group_slope(const SmallLu<S>& lu, const Local<S>& local) const;
  template <class S>
  void reassign_pole(std::size_t k, std::vector<S>& offset);
  template <class S>
  void find_vectors(Roots<S>& roots);
  /// Clusters of roots that double precision cannot separate. Each cluster is a list of indices of roots.
  [[nodiscard]] std::vector<std::vector<std::size_t>> find_clusters(const Roots<double>& roots) const;
  [[nodiscard]] std::pair<std::size_t, std::size_t> cluster_poles(const std::vector<std::size_t>& members,
                                                                  const Roots<double>& roots) const;
  bool split_cluster(const std::vector<std::size_t>& members, Roots<double>& roots);
  template <class S>
  void outside_group(const SmallLu<S>& lu, const Local<S>& local, const SmallVector<S>& right,
                     const SmallVector<S>& left, SmallVector<S>& c, SmallVector<S>& d) const;
  template <class S, class W>
  void keep_vectors(Roots<S>& roots, std::size_t k, W own, const SmallVector<W>& c_wide,
                    const SmallVector<W>& d_wide);
  template <class S>
  void project(const Roots<S>& roots, const Eigen::VectorXd& q, bool form, std::vector<S>& z) const;
  void project(const Eigen::VectorXd& q, bool form, Amplitudes& z) const;
  void rotate_equal_modes(Eigen::MatrixXd& u, Eigen::MatrixXd& v);
  void select_coupled(const Poles& poles, const Eigen::MatrixXd& u, const Eigen::MatrixXd& v);
  void order_values();
  void find_squares();
  void find_products();
  template <class S>
  void entries(const Roots<S>& roots, std::size_t k, const std::vector<S>& small, const Eigen::MatrixXd& side,
               std::vector<S>& out) const;
  void store_matrices();
  void to_modes_stored(const std::vector<const Eigen::VectorXd*>& q, const std::vector<Amplitudes*>& z) const;
  void stored_form_coefficients(const Eigen::VectorXd& form, Amplitudes& row) const;
  void from_modes_stored(const std::vector<const Amplitudes*>& z,
                         const std::vector<Eigen::VectorXd*>& q) const;
  template <class S>
  void cauchy(const Roots<S>& roots, std::size_t k, const S* small, const Eigen::MatrixXd& side,
              std::vector<S>& out) const;
  [[nodiscard]] Eigen::VectorXd coupled_vector(const std::vector<double>& small, const Eigen::MatrixXd& side,
                                               std::size_t k) const;
  void split_close_roots();
  void compute_close_products();
  [[nodiscard]] double difference(std::size_t k, std::size_t l) const {
    return (value_base_[k] - value_base_[l]) + (value_offset_[k] - value_offset_[l]);
  }
  template <class S>
  [[nodiscard]] S uncoupled_coordinate(const Roots<S>& roots, std::size_t k, std::size_t j,
                                       double pole) const;
  [[nodiscard]] double uncoupled_sum(std::size_t j, const std::vector<double>& real,
                                     const std::vector<Complex>& pair) const;
  bool split_real_and_pairs(const std::vector<Complex>& offset);
  void test();

  std::size_t rank_;
  // Index of the first mode and rotation of each group of modes with equal poles.
  std::vector<std::pair<Eigen::Index, Eigen::MatrixXd>> rotations_;
  std::vector<Eigen::Index> coupled_, uncoupled_;  // indices among all modes
  Eigen::MatrixXd u_uncoupled_;
  std::vector<double> uncoupled_poles_;
  // Data of the coupled modes:
  std::size_t n_ = 0;
  Poles poles_;
  Eigen::MatrixXd u_, v_;
  std::vector<double> terms_;    // v_i u_i^T, rank^2 numbers for each pole
  std::vector<double> weights_;  // the numbers of terms_, ordered by matrix entry: n numbers for each entry
  // Index of the pole of each root; for each pole, begin and end of its group of equal poles.
  std::vector<std::size_t> home_, group_begin_, group_end_;
  Roots<double> real_;
  Roots<Complex> pairs_;
  std::vector<std::size_t> order_;  // for each amplitude: index in the list real_, uncoupled_
  std::vector<double> values_;
  struct Close {
    std::size_t k, l;
    double product;  // in close_: y_k^T x_l, which is only rounding; in close_products_: x_k^T x_l
  };
  std::vector<Close> close_;
  // x_k^T x_l of modes k > l whose difference l_k - l_l is so small that products_ are inaccurate.
  std::vector<Close> close_products_;
  std::vector<double> squares_;
  std::vector<Complex> pair_squares_;
  std::vector<double> value_base_, value_offset_;  // real eigenvalues as sums, for accurate differences
  VectorProducts products_;
  // X and Y. A conjugate pair has the columns 2 Re x, -2 Im x in X and the rows Re y, Im y in Y.
  RowMatrix x_, y_;
  std::string failure_;
  double condition_ = 1.0, round_trip_ = 0.0;
};

}  // namespace signorini::modal
