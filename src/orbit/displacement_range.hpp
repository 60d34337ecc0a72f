// displacement_range.hpp: the largest range of a displacement in one pass, from the motion within its steps.
//
//   amplitude = half of the largest max u_i - min u_i,   u_i: translations of physical_dofs(), scene's unit
//
// The motion is evaluated at most 1/96 of the pass apart, and on both sides of every instant. Between two of these nodes the
// cubic with the same u and v shows where u_i turns; an extreme that makes the largest range larger is then evaluated from the
// motion itself. The remaining error is quadratic in the error of that time: below 1e-9 of the amplitude for a sine.
#pragma once

#include "run/run_listener.hpp"
#include "signorini/model.hpp"

namespace signorini::orbit {

class DisplacementRange {
 public:
  /// duration: length of the pass, machine units of the model. The model must outlive the object.
  DisplacementRange(const Model& model, double duration);

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
