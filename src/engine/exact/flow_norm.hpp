// flow_norm.hpp: a norm for Taylor coefficients that bounds the remainder of a series.
//
//   |x|^2 = x^T G x,   G = M + C / W + K_c / W^2,   W the highest circular frequency
//   |n . x| <= sqrt(n^T G^-1 n) |x|
//
// K_c contains all contact springs, so that G is regular whenever the motion is determined.
#pragma once

#include "contact/mode.hpp"
#include "signorini/model.hpp"

namespace signorini {

class FlowNorm {
 public:
  explicit FlowNorm(const Model& model);

  [[nodiscard]] double of(const Eigen::Ref<const Vector>& x);
  /// Greatest |n . x| and |t . x| of contact k among |x| = 1.
  [[nodiscard]] double normal(std::size_t k) const { return normal_[k]; }
  [[nodiscard]] double tangent(std::size_t k) const { return tangent_[k]; }

 private:
  SparseMatrix g_;
  std::vector<double> normal_, tangent_;
  Vector product_;
};

}  // namespace signorini
