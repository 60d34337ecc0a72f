// damped_pencil.hpp: T(l) of damped_modes.hpp, and where it is singular.
//
//   T(l) (lambda, x_G) = 0,   l <- l - d^T T c / d^T T' c      d, c: what T nearly takes to zero
//
// Terms are scaled, springs by sqrt(k) and constraints to length 1, and equal poles are turned so that as few
// as possible are seen. Near a pole the mode stands in G, elsewhere in the sums.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "engine/exact/modal/damped_modes.hpp"
#include "engine/exact/modal/small_lu.hpp"

namespace signorini {

/// Of the greatest pivot of T, or of 1: a pivot that is zero; chosen.
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
    std::vector<Long> scale;  ///< of terms: forces are in units of 1 / scale
    std::size_t size = 0;
  };

  /// As of damped_modes.
  DampedPencil(const Eigen::VectorXd& square, const Eigen::VectorXd& decay,
               const std::vector<ModalTerm>& terms);

  [[nodiscard]] Index size() const { return square_.size(); }
  [[nodiscard]] std::size_t rank() const { return terms_.size(); }
  [[nodiscard]] const Eigen::VectorXd& square() const { return square_; }
  [[nodiscard]] const Eigen::VectorXd& decay() const { return decay_; }
  /// Turned and scaled; kappa = stiffness + l damping of scaled ones, lambda that of the given one by scale.
  [[nodiscard]] const std::vector<ModalTerm>& terms() const { return terms_; }
  [[nodiscard]] double stiffness(std::size_t term) const { return stiffness_[term]; }
  [[nodiscard]] double damping(std::size_t term) const { return damping_[term]; }
  [[nodiscard]] double scale(std::size_t term) const { return term_scale_[term]; }
  /// Modes that a term sees, and those that none does.
  [[nodiscard]] const std::vector<Index>& seen() const { return seen_; }
  [[nodiscard]] const std::vector<Index>& unseen() const { return unseen_; }
  /// First of equal poles and how they were turned: given = vectors x turned.
  [[nodiscard]] const std::vector<std::pair<Index, Eigen::MatrixXd>>& turns() const { return turns_; }

  [[nodiscard]] Wide pole(Index j, Wide l) const { return l * l + l * decay_[j] + Wide(square_[j]); }
  /// Roots of the seen modes in doubles, from  x' = (0 1; -K -C) x  on what the constraints leave.
  [[nodiscard]] Eigen::VectorXcd begin() const;
  /// False: too many modes are near.
  [[nodiscard]] bool gather(Wide l, Local& local) const;
  /// By Newton's steps; nothing: they do not settle.
  [[nodiscard]] std::optional<Wide> polished(Wide l) const;

 private:
  void turn_equal_poles();
  void add_far(Index j, Wide l, Local& local) const;

  Eigen::VectorXd square_, decay_;
  std::vector<ModalTerm> terms_;
  std::vector<double> term_scale_, stiffness_, damping_;
  std::vector<std::pair<Index, Eigen::MatrixXd>> turns_;
  std::vector<Index> seen_, unseen_;
  Long softest_ = 1;  // frequency that slow roots are measured by
};

}  // namespace signorini
