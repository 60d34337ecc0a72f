// harmonic_balance.hpp: periodic motions by another method, in harmonics and samples of a period.
//
//   x = q_0 + sum_h a_h cos h w t + b_h sin h w t
//   M x'' + C x' + K x + sum_e d_e f_e = p cos w t     in harmonics up to H; forces f_e at samples
//
//   one-sided spring   f = k max(0, x_e - gap)
//   Jenkins element    f follows kt x_e between -limit and limit, over two periods
//   tanh               f = limit tanh(x_e'/eps): a regularised slider
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/eigen_dense.hpp"

namespace signorini::tests {

class HarmonicBalance {
 public:
  struct Element {
    enum class Kind { one_sided, jenkins, regularised } kind;
    Eigen::VectorXd direction;
    double stiffness, limit;  // limit: gap, friction, friction; stiffness of a regularised slider: eps
  };

  Eigen::MatrixXd M, C, K;
  Eigen::VectorXd load;
  std::vector<Element> elements;
  double w = 1.0;
  int harmonics = 7, samples = 1024;

  /// Columns q_0, a_1, b_1, ...; begins from those of a motion at equal distances of a period.
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& motion) const {
    Eigen::MatrixXd q = harmonics_of(motion);
    for (int i = 0; i < 30; ++i) {
      const Eigen::VectorXd r = residual(q);
      if (r.norm() <= 1e-12 * (1.0 + load.norm())) break;
      Eigen::MatrixXd J(r.size(), r.size());
      const double h = 1e-7 * q.cwiseAbs().maxCoeff();
      for (Eigen::Index k = 0; k < q.size(); ++k) {
        Eigen::MatrixXd beside = q;
        beside.reshaped()[k] += h;
        J.col(k) = (residual(beside) - r) / h;
      }
      q.reshaped() -= signorini::base::solve_dense(J, r);
    }
    return q;
  }
  [[nodiscard]] double left(const Eigen::MatrixXd& q) const { return residual(q).norm(); }
  /// x at the part s of the period.
  [[nodiscard]] Eigen::VectorXd at(const Eigen::MatrixXd& q, double s) const { return q * basis(s); }

 private:
  [[nodiscard]] Eigen::Index columns() const { return 2 * harmonics + 1; }
  [[nodiscard]] Eigen::VectorXd basis(double s) const {
    Eigen::VectorXd b(columns());
    b[0] = 1.0;
    for (int h = 1; h <= harmonics; ++h) {
      b[2 * h - 1] = std::cos(2.0 * std::numbers::pi * h * s);
      b[2 * h] = std::sin(2.0 * std::numbers::pi * h * s);
    }
    return b;
  }
  [[nodiscard]] Eigen::MatrixXd harmonics_of(const Eigen::MatrixXd& motion) const {
    const auto count = static_cast<double>(motion.cols());
    Eigen::MatrixXd q = Eigen::MatrixXd::Zero(motion.rows(), columns());
    for (Eigen::Index j = 0; j < motion.cols(); ++j)
      q += motion.col(j) * basis(static_cast<double>(j) / count).transpose() * (2.0 / count);
    q.col(0) *= 0.5;
    return q;
  }
  [[nodiscard]] Eigen::VectorXd forces(const Element& e, const Eigen::VectorXd& x,
                                       const Eigen::VectorXd& rate) const {
    Eigen::VectorXd f = Eigen::VectorXd::Zero(x.size());
    if (e.kind == Element::Kind::one_sided) {
      f = e.stiffness * (x.array() - e.limit).max(0.0).matrix();
    } else if (e.kind == Element::Kind::regularised) {
      f = e.limit * (rate.array() / e.stiffness).tanh().matrix();
    } else {
      double now = 0.0, before = x[x.size() - 1];
      for (int round = 0; round < 2; ++round)
        for (Eigen::Index j = 0; j < x.size(); ++j) {
          now = std::clamp(now + e.stiffness * (x[j] - before), -e.limit, e.limit);
          before = x[j];
          f[j] = now;
        }
    }
    return f;
  }
  [[nodiscard]] Eigen::VectorXd residual(const Eigen::MatrixXd& q) const {
    Eigen::MatrixXd B(columns(), samples), D = Eigen::MatrixXd::Zero(columns(), samples);
    for (int j = 0; j < samples; ++j) B.col(j) = basis(static_cast<double>(j) / samples);
    for (int h = 1; h <= harmonics; ++h) {
      D.row(2 * h - 1) = -h * w * B.row(2 * h);
      D.row(2 * h) = h * w * B.row(2 * h - 1);
    }
    Eigen::MatrixXd f = Eigen::MatrixXd::Zero(q.rows(), samples);
    for (const Element& e : elements) {
      const Eigen::VectorXd row = q.transpose() * e.direction;
      f += e.direction * forces(e, B.transpose() * row, D.transpose() * row).transpose();
    }
    Eigen::MatrixXd r = harmonics_of(f) + K * q;
    for (int h = 1; h <= harmonics; ++h) {
      const double o = h * w;
      r.col(2 * h - 1) += o * C * q.col(2 * h) - o * o * M * q.col(2 * h - 1);
      r.col(2 * h) += -o * C * q.col(2 * h - 1) - o * o * M * q.col(2 * h);
    }
    r.col(1) -= load;
    return r.reshaped();
  }
};

}  // namespace signorini::tests
