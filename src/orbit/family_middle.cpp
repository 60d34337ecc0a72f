#include "orbit/family_middle.hpp"

#include <algorithm>
#include <utility>

#include "base/eigen_dense.hpp"

namespace signorini {
namespace {

// Difference of equal margins: relative to the smaller one, within these fractions of the amplitude of T. Chosen value.
constexpr double balanced = 1e-3, finest = 1e-8, coarsest = 1e-5;
constexpr double along_family = 1e-5;  // step of finite differences, in the norm; chosen value
constexpr double singular_family =
    1e-6;  // limit for a direction that changes no margin, in amplitudes of T per unit. Chosen value.
constexpr int most_centrings = 3;

std::vector<std::size_t> never_slip(const Model& model, const OrbitPass& pass) {
  std::vector<std::size_t> list;
  for (std::size_t c = 0; c < pass.held.size(); ++c)
    if (pass.held[c] && model.contacts[c].has_friction() && pass.begin.mode[c].state == State::stick)
      list.push_back(c);
  return list;
}

/// (m+ - m-)/2
Vector imbalances(const std::vector<std::size_t>& contacts, const OrbitPass& pass) {
  Vector d(static_cast<Eigen::Index>(contacts.size()));
  for (std::size_t i = 0; i < contacts.size(); ++i)
    d[static_cast<Eigen::Index>(i)] = 0.5 * (pass.margins[contacts[i]][0] - pass.margins[contacts[i]][1]);
  return d;
}

/// True if the differences count as zero.
bool is_balanced(const std::vector<std::size_t>& contacts, const OrbitPass& pass, const Vector& d) {
  double least = pass.T_amplitude;
  for (const std::size_t c : contacts) least = std::min({least, pass.margins[c][0], pass.margins[c][1]});
  const double T = pass.T_amplitude;
  return d.cwiseAbs().maxCoeff() <= std::clamp(balanced * least, finest * T, coarsest * T);
}

/// Their derivatives along directions of the family; empty: unknown. here: differences at the point.
Eigen::MatrixXd slopes(const BranchMap& map, const BranchNewton& newton, const Corrected& at,
                       const std::vector<std::size_t>& contacts, const Eigen::MatrixXd& directions,
                       const Vector& here) {
  Eigen::MatrixXd D(here.size(), directions.cols());
  for (Eigen::Index k = 0; k < directions.cols(); ++k) {
    const OrbitPass beside = map.margins(newton.moved(at.state, at.pass, along_family * directions.col(k)));
    if (!beside.done()) return {};
    D.col(k) = (imbalances(contacts, beside) - here) / along_family;
  }
  return D;
}

}  // namespace

std::optional<Corrected> family_middle(const BranchMap& map, const BranchNewton& newton,
                                       const Corrected& here, const Vector& t) {
  const std::vector<std::size_t> contacts = never_slip(map.model(), here.pass);
  Corrected at = here;
  const Eigen::MatrixXd directions = newton.families(at);
  if (contacts.empty() || directions.cols() == 0) return std::nullopt;
  bool moved = false;
  OrbitPass fine = map.margins(at.state);
  for (int i = 0; i < most_centrings && fine.done(); ++i) {
    const Vector d = imbalances(contacts, fine);
    if (is_balanced(contacts, fine, d)) break;
    const Eigen::MatrixXd D = slopes(map, newton, at, contacts, directions, d);
    if (D.size() == 0) break;
    // If everything else slips, the structure moves with the anchor, and no force changes.
    const Vector part = shortest_solution(D, -d, singular_family, at.pass.T_amplitude);
    if (!(part.norm() > 0.0)) break;
    Corrected next = newton.correct(newton.moved(at.state, at.pass, directions * part),
                                    newton.upwards(at.pass, 1.0), at.by_s);
    if (!next.done) break;
    fine = map.margins(next.state);
    if (!fine.done() || !(imbalances(contacts, fine).norm() < 0.5 * d.norm())) break;
    newton.examine(next, t, here.ones, true);
    at = std::move(next);
    moved = true;
  }
  return moved ? std::optional(std::move(at)) : std::nullopt;
}

}  // namespace signorini
