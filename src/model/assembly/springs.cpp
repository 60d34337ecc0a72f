#include "model/assembly/springs.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <limits>

namespace signorini::assembly {

SparseMatrix with_springs(const SparseMatrix& k, const std::vector<LineSpring>& springs) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const LineSpring& s : springs)
    for (const auto& [row, a] : s.form.terms)
      for (const auto& [column, b] : s.form.terms) entries.emplace_back(row, column, s.stiffness * a * b);
  SparseMatrix added(k.rows(), k.cols());
  added.setFromTriplets(entries.begin(), entries.end());
  return k + added;
}

std::vector<LineSpring> contact_springs(const std::vector<Contact>& contacts) {
  std::vector<LineSpring> springs;
  for (const Contact& c : contacts) {
    if (const auto kn = c.normal_spring()) springs.push_back({c.normal, *kn});
    if (c.tangential_stiffness) springs.push_back({c.tangent, *c.tangential_stiffness});
  }
  return springs;
}

Vector dense_vector(const Combination& form, int n) {
  Vector v = Vector::Zero(n);
  form.add_to(v, 1.0);
  return v;
}

double term_magnitude(const SparseMatrix& k, const Vector& x) {
  double sum = 0.0;
  for (int column = 0; column < k.outerSize(); ++column)
    for (SparseMatrix::InnerIterator it(k, column); it; ++it)
      sum += std::abs(x[it.row()] * it.value() * x[column]);
  return sum;
}

namespace {

struct Stiffness {
  double value = 0.0;
  SourcePlace place;
  std::string key, what;
};

void add_members(const Scene& scene, const DofMap& map, std::vector<Stiffness>& all) {
  for (const element::MeshPiece& piece : map.mesh.pieces)
    for (std::size_t i = 0; i < piece.count; ++i) {
      const element::LineData& line = map.mesh.line(piece.first + i).data();
      const double length = line.axis.length;
      const Member& member = scene.members[static_cast<std::size_t>(line.member)];
      const std::string key = fmt::format("members.{}.section", line.member + 1);
      all.push_back({line.EA / length, member.place, key,
                     fmt::format("EA/L of an element of section '{}'", member.section)});
      if (member.type == MemberType::beam)
        all.push_back({line.EI / length / length / length, member.place, key,
                       fmt::format("EI/L^3 of an element of section '{}'", member.section)});
    }
}

}  // namespace

void check_stiffness_range(const Scene& scene, const DofMap& map) {
  static const double widest = std::sqrt(std::numeric_limits<double>::max());
  std::vector<Stiffness> all;
  add_members(scene, map, all);
  for (std::size_t i = 0; i < scene.springs.size(); ++i)
    all.push_back({scene.springs[i].stiffness, scene.springs[i].place,
                   fmt::format("springs.{}.stiffness", i + 1),
                   fmt::format("the stiffness of spring {}", i + 1)});
  for (const ContactSpec& contact : scene.contacts)
    all.push_back({contact.normal_stiffness, contact.place, contact.key("normal_stiffness"),
                   fmt::format("normal_stiffness of contact '{}'", contact.name)});
  std::erase_if(all, [](const Stiffness& k) { return !(k.value > 0.0); });
  if (all.size() < 2) return;
  const auto less = [](const Stiffness& a, const Stiffness& b) { return a.value < b.value; };
  std::sort(all.begin(), all.end(), less);
  const Stiffness &low = all.front(), &high = all.back();
  if (low.value >= high.value / widest) return;
  const bool too_stiff = std::abs(std::log(high.value)) > std::abs(std::log(low.value));
  const Stiffness &odd = too_stiff ? high : low, &other = too_stiff ? low : high;
  throw SceneError(
      odd.place, odd.key,
      fmt::format("{1} is {0:.4g}, and {3} is {2:.4g}: with a ratio above {4:.3g}, squares of frequencies "
                  "leave the range of doubles; expected {5}",
                  odd.value, odd.what, other.value, other.what, widest,
                  too_stiff ? "a smaller first value, or a rigid body" : "a larger first value"));
}

}  // namespace signorini::assembly
