// ties.hpp: rigid bodies, whose nodes move with their centre; small rotations.
//
//   ux_P = ux_C - rz (y_P - y_C),   uy_P = uy_C + rz (x_P - x_C),   rz_P = rz_C          u = T q
//
// q has the centre's degrees of freedom, M = T^T M_full T, and so K, C, loads and the forms of contacts. A support
// on any node of a body takes from q: with A held in x and B in y,
//
//   ux_P = -rz (y_P - y_A),   uy_P = rz (x_P - x_B),
//
// and two nodes held in x at different heights, or in y beside each other, hold rz. One that moves stands
// for its motion, s - rz (y_P - y_A). What is then no degree of freedom is tied, the centre's motions too.
#pragma once

#include <optional>
#include <vector>

#include "model/assembly/dofs.hpp"

namespace signorini {

/// A component of a body's motion that supports hold, at a coordinate across it.
struct BodyHold {
  double at = 0.0;                    ///< of the held node: y for ux, x for uy
  int moving = DofMap::absent;        ///< index into DofMap::supports
  std::size_t support = 0, node = 0;  ///< index into Scene::supports, mesh node
};

/// What of a body's motion is free.
struct BodyMotion {
  int centre = 0;                                ///< mesh node
  std::vector<int> nodes;                        ///< all, the centre first
  std::array<std::optional<BodyHold>, 3> holds;  ///< ux, uy, rz
};

/// Sets DofMap::body, and marks what is free of the centres' motions as needed, all else of bodies as absent.
/// Errors: SceneError for a node of two bodies, for supports that contradict.
[[nodiscard]] std::vector<BodyMotion> find_bodies(const Scene& scene, DofMap& map);

/// Numbers what is tied, once all degrees of freedom are.
void tie(const std::vector<BodyMotion>& bodies, DofMap& map);

/// Supports of a body's nodes: node and component, one each.
[[nodiscard]] std::vector<std::pair<int, std::size_t>> held_in_body(const Scene& scene, const DofMap& map,
                                                                    int body);

/// A form on degrees of freedom and codes of moving supports.
struct Elongation {
  std::vector<int> numbers;
  Vector factors;
};

/// A form that is gathered number by number; what cancels is zero.
class TiedForm {
 public:
  explicit TiedForm(const DofMap& map) : map_(map) {}
  void add(int number, double factor);
  /// A support that moves has a part in it.
  [[nodiscard]] bool follows_support() const { return follows_; }
  /// Of the degrees of freedom alone.
  [[nodiscard]] Combination combination() const;
  [[nodiscard]] Elongation with_supports() const;

 private:
  struct Sum {
    int number;
    double sum, size;
  };
  const DofMap& map_;
  std::vector<Sum> sums_;
  bool follows_ = false;
};

/// The unknowns of an element of which some are tied: its own are T times others.
struct TiedElement {
  TiedElement(const DofMap& map, const int* numbers, std::size_t count);
  std::vector<int> numbers;  ///< degrees of freedom, codes of moving supports
  Eigen::MatrixXd t;         ///< count x numbers

  /// T^T A T for symmetric A, to the last bit, too; what cancels is zero.
  [[nodiscard]] Eigen::MatrixXd of(const Eigen::MatrixXd& a) const;
};

/// Whether one of these is tied.
[[nodiscard]] bool any_tied(const DofMap& map, const int* numbers, std::size_t count);

/// Sets Model::ties. The model's degrees of freedom are those of the map.
void add_ties(const Scene& scene, const DofMap& map, Model& model);
/// Ties::dofs, anew once the model is reduced or points that slide are there.
void name_tied(const DofMap& map, Model& model);

}  // namespace signorini
