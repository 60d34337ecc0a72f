// triangle.hpp: a third element, in plane stress with constant strains: nothing but tests has it.
//
//   k = A t B^T D B,  strains B u = (e_x, e_y, g_xy),  D = E/(1 - nu^2) [1 nu 0; nu 1 0; 0 0 (1 - nu)/2]
//   m = rho A/12 [2 1 1; 1 2 1; 1 1 2] for ux and for uy;  a strain e (heat) holds A t B^T D (e, e, 0)
#pragma once

#include "model/element/element.hpp"

namespace signorini::test {

struct Plate {
  double E_t = 0.0, poisson = 0.0, mass_per_area = 0.0;
};

class Triangle final : public element::FiniteElement {
 public:
  using Corners = std::array<element::PlaneVector, 3>;
  Triangle(std::vector<int> nodes, int member, const Corners& at, const Plate& plate)
      : element::FiniteElement(std::move(nodes), member), at_(at), plate_(plate) {}

  [[nodiscard]] std::vector<element::ElementUnknown> unknowns() const override {
    return {{0, 0}, {0, 1}, {1, 0}, {1, 1}, {2, 0}, {2, 1}};
  }
  [[nodiscard]] double extent() const override {
    const auto& [a, b, c] = at_;
    return 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]));
  }
  [[nodiscard]] double density() const override { return plate_.mass_per_area; }
  [[nodiscard]] element::ElementMatrix mass() const override {
    element::ElementMatrix m = element::ElementMatrix::Zero(6, 6);
    for (int i = 0; i < 6; ++i)
      for (int j = i % 2; j < 6; j += 2) m(i, j) = density() * extent() / 12.0 * (i == j ? 2.0 : 1.0);
    return m;
  }
  [[nodiscard]] element::ElementMatrix stiffness() const override {
    return extent() * strains().transpose() * stresses() * strains();
  }
  [[nodiscard]] element::ElementVector load_vector(const element::PlaneVector& load) const override {
    return extent() / 3.0 * translation(load);
  }
  [[nodiscard]] double strain_work(const element::ElementVector& motion) const override {
    return extent() * Eigen::Vector3d(1.0, 1.0, 0.0).dot(stresses() * (strains() * motion));
  }
  [[nodiscard]] element::SectionForce section_force(OutputQuantity /*quantity*/,
                                                    const element::PlaneVector& /*at*/,
                                                    const element::AxialForces& /*forces*/) const override {
    return element::SectionForce(6);
  }
  [[nodiscard]] std::vector<element::ElementLine> lines() const override { return {{0, 1}, {1, 2}, {2, 0}}; }

 private:
  [[nodiscard]] Eigen::Matrix<double, 3, 6> strains() const {
    Eigen::Matrix<double, 3, 6> b;
    for (std::size_t i = 0; i < 3; ++i) {
      const element::PlaneVector &next = at_[(i + 1) % 3], &last = at_[(i + 2) % 3];
      const double by_x = next[1] - last[1], by_y = last[0] - next[0];
      const auto column = static_cast<Eigen::Index>(2 * i);
      b.col(column) << by_x, 0.0, by_y;
      b.col(column + 1) << 0.0, by_y, by_x;
    }
    return b / (2.0 * extent());
  }
  [[nodiscard]] Eigen::Matrix3d stresses() const {
    const double nu = plate_.poisson;
    return plate_.E_t / (1.0 - nu * nu) *
           Eigen::Matrix3d{{1.0, nu, 0.0}, {nu, 1.0, 0.0}, {0.0, 0.0, 0.5 * (1.0 - nu)}};
  }

  Corners at_;
  Plate plate_;
};

}  // namespace signorini::test
