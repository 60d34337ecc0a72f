// damped_pencil.hpp: T(l) of damped_modes.hpp, and its roots.
//
//   T(l) (lambda, x_G) = 0,   l <- l - d^T T c / d^T T' c      d, c: approximate null vectors of T
//
// Terms are scaled: springs by sqrt(k), constraints to length 1. Modes of equal poles are rotated so that the terms see
// as few as possible. A mode is in G if its pole is near, otherwise in the sums.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "engine/exact/modal/damped_modes.hpp"
#include "engine/exact/modal/small_lu.hpp"

namespace signorini {

/// Pivot that counts as zero, relative to the greatest pivot of T, or to 1; chosen.
inline constexpr long double singular_pencil = 1e-10L;

class DampedPencil {
 public:
  using Index = Eigen::Index;
  using Long = long double;
  using Wide = WideComplex;

  /// T at a place, its slope, and the modes in G.
  struct Local {
    SmallMatrix<Wide> t{}, slope{};
    std::vector<Index> near;
    Long unit = 1;  ///< sigma: lengths are in units of 1 / sigma
    std::vector<Wide> kappa;
    std::vector<Long> scale;  ///< scale of each term: forces are in units of 1 / scale
    std::size_t size = 0;
  };

  /// Arguments as for damped_modes().
  DampedPencil(const Eigen::VectorXd& square, const Eigen::VectorXd& decay,
               const std::vector<ModalTerm>& terms);

  [[nodiscard]] Index size() const { return square_.size(); }
  [[nodiscard]] std::size_t rank() const { return terms_.size(); }
  [[nodiscard]] const Eigen::VectorXd& square() const { return square_; }
  [[nodiscard]] const Eigen::VectorXd& decay() const { return decay_; }
  /// Rotated and scaled terms; kappa = stiffness + l damping with scaled values, lambda is that of the given term
  /// divided by scale.
  [[nodiscard]] const std::vector<ModalTerm>& terms() const { return terms_; }
  [[nodiscard]] double stiffness(std::size_t term) const { return stiffness_[term]; }
  [[nodiscard]] double damping(std::size_t term) const { return damping_[term]; }
  [[nodiscard]] double scale(std::size_t term) const { return term_scale_[term]; }
  /// Modes that at least one term sees; unseen(): all others.
  [[nodiscard]] const std::vector<Index>& seen() const { return seen_; }
  [[nodiscard]] const std::vector<Index>& unseen() const { return unseen_; }
  /// First index of each group of equal poles and its rotation: given = vectors x rotated.
  [[nodiscard]] const std::vector<std::pair<Index, Eigen::MatrixXd>>& turns() const { return turns_; }

  [[nodiscard]] Wide pole(Index j, Wide l) const { return l * l + l * decay_[j] + Wide(square_[j]); }
  /// Roots of the seen modes in doubles, from  x' = (0 1; -K -C) x  in the null space of the constraints.
  [[nodiscard]] Eigen::VectorXcd begin() const;
  /// False: too many modes are near.
  [[nodiscard]] bool gather(Wide l, Local& local) const;
  /// Refines a root by Newton steps; nullopt: they do not converge.
  [[nodiscard]] std::optional<Wide> polished(Wide l) const;

 private:
  void turn_equal_poles();
  void add_far(Index j, Wide l, Local& local) const;

  Eigen::VectorXd square_, decay_;
  std::vector<ModalTerm> terms_;
  std::vector<double> term_scale_, stiffness_, damping_;
  std::vector<std::pair<Index, Eigen::MatrixXd>> turns_;
  std::vector<Index> seen_, unseen_;
  Long softest_ = 1;  // reference frequency for slow roots
};

}  // namespace signorini
