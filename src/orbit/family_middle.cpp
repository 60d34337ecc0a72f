#include "orbit/family_middle.hpp"

#include <utility>

#include "base/eigen_dense.hpp"

namespace signorini {
namespace {

constexpr double balanced = 1e-5;      // two margins, in amplitudes of T. Chosen.
constexpr double along_family = 1e-5;  // step of differences, in the norm; chosen
constexpr double singular_family =
    1e-6;  // a direction that moves no margin, in amplitudes of T a unit. Chosen.
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

/// Their derivatives along directions of the family; empty: not known.
Eigen::MatrixXd slopes(const BranchMap& map, const BranchNewton& newton, const Corrected& at,
                       const std::vector<std::size_t>& contacts, const Eigen::MatrixXd& directions) {
  const Vector here = imbalances(contacts, at.pass);
  Eigen::MatrixXd D(here.size(), directions.cols());
  for (Eigen::Index k = 0; k < directions.cols(); ++k) {
    const OrbitPass beside =
        map.pass(newton.moved(at.state, at.pass, along_family * directions.col(k)), false);
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
  for (int i = 0; i < most_centrings; ++i) {
    const Vector d = imbalances(contacts, at.pass);
    if (d.cwiseAbs().maxCoeff() <= balanced * at.pass.T_amplitude) break;
    const Eigen::MatrixXd D = slopes(map, newton, at, contacts, directions);
    if (D.size() == 0) break;
    // Where all else slips the structure moves with the anchor, and no force changes.
    const Vector part = shortest_solution(D, -d, singular_family, at.pass.T_amplitude);
    if (!(part.norm() > 0.0)) break;
    Corrected next = newton.correct(newton.moved(at.state, at.pass, directions * part),
                                    newton.upwards(at.pass, 1.0), at.by_s);
    if (!next.done || !(imbalances(contacts, next.pass).norm() < 0.5 * d.norm())) break;
    newton.examine(next, t, here.ones, true);
    at = std::move(next);
    moved = true;
  }
  return moved ? std::optional(std::move(at)) : std::nullopt;
}

}  // namespace signorini
