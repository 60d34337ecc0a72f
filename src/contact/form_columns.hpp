// form_columns.hpp: linear forms side by side, on the degrees of freedom that they touch.
//
//   H_ij = weight_d factor_d of form j,   d the i-th degree of freedom that any of them touches, in the order of touch
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "signorini/contact.hpp"

namespace signorini {

/// Touched degrees of freedom x forms. weight: of a degree of freedom; absent: 1.
[[nodiscard]] Eigen::MatrixXd form_columns(const std::vector<const Combination*>& forms,
                                           const std::function<double(int)>& weight = {});

}  // namespace signorini
