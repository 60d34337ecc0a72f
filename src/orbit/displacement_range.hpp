// displacement_range.hpp: the largest range of a displacement in one pass, from the motion within its steps.
//
//   amplitude = half of the largest max u_i - min u_i,   u_i: translations of physical_dofs(), scene's unit
//
// The motion is evaluated at nodes, at equal distances and on both sides of every instant. Between two nodes the cubic with the
// same u and v shows where u_i turns; an extreme that makes the largest range larger is then evaluated from the motion itself.
// A swing of the frequency w and the amplitude a that rides on the motion may be missed by a (w h)^4 / 384, h: the distance of
// nodes, and by a if w h is above 3.
#pragma once

#include "run/run_listener.hpp"
#include "signorini/model.hpp"

namespace signorini::orbit {

class DisplacementRange {
 public:
  /// duration: length of the pass, machine units of the model; nodes: number of nodes in it. The model must outlive the object.
  DisplacementRange(const Model& model, double duration, int nodes);

  /// Starts a smooth stretch at t, after the decision at t = 0 or at an instant.
  void begin_stretch(double t, const Vector& u, const Vector& v);
  /// Follows a completed step.
  void follow(const run::RunStep& step);
  [[nodiscard]] double amplitude() const;

 private:
  /// Displacements and velocities of translations at one time.
  struct Node {
    double t = 0.0;
    Vector u, v;
  };
  [[nodiscard]] Node node_at(double t, const Vector& u, const Vector& v) const;
  /// Extends the ranges by the displacements of a node.
  void extend(const Node& node);
  /// Time at which a translation turns between two nodes and makes the largest range larger; nullopt: none does.
  [[nodiscard]] std::optional<double> turning_time(const Node& a, const Node& b) const;

  const Model& model_;
  double spacing_;
  std::vector<Eigen::Index> translations_;
  Node last_;
  Vector low_, high_;  // empty before the first node
};

}  // namespace signorini::orbit
