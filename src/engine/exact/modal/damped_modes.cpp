#include "engine/exact/modal/damped_modes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "engine/exact/modal/damped_flow.hpp"
#include "engine/exact/modal/damped_pencil.hpp"

namespace signorini::modal {
namespace {

using Long = DampedPencil::Long;
using Wide = DampedPencil::Wide;
using Local = DampedPencil::Local;

constexpr Long equal_roots = 1e-13L;  // relative distance below which roots are regarded as equal

struct Root {
  Wide l;
  std::size_t members = 1;  // multiplicity of the root
};

class Search {
 public:
  explicit Search(const DampedPencil& pencil) : pencil_(pencil), n_(pencil.size()) {}
  DampedModes run();

 private:
  using Index = Eigen::Index;
  struct Vectors {
    std::vector<Wide> x, y, force;
  };
  [[nodiscard]] bool find_roots();
  void merge_roots();
  [[nodiscard]] bool add_coupled_root(const Root& root, DampedModes& out);
  [[nodiscard]] bool add_uncoupled_roots(Index j, DampedModes& out);
  void spread(const Local& local, Wide l, const SmallVector<Wide>* right, const SmallVector<Wide>& left,
              Vectors& out) const;
  [[nodiscard]] Wide product(Wide l, const Vectors& left, const Vectors& right) const;
  void keep(Wide l, const Vectors& v, Wide product, DampedModes& out);
  void to_given_modes(DampedModes& out) const;
  [[nodiscard]] Vectors zero_vectors() const {
    const auto n = static_cast<std::size_t>(n_);
    return {std::vector<Wide>(n), std::vector<Wide>(n), std::vector<Wide>(rank())};
  }
  [[nodiscard]] std::size_t rank() const { return pencil_.rank(); }

  const DampedPencil& pencil_;
  const Index n_;
  std::vector<Root> roots_;
  Index next_ = 0;  // next column of the result
  std::string failure_;
};

bool Search::find_roots() {
  const Eigen::VectorXcd begun = pencil_.starting_roots();
  for (Index i = 0; i < begun.size(); ++i) {
    if (begun[i].imag() < 0.0) continue;
    const std::optional<Wide> l = pencil_.refined_root(Wide(begun[i].real(), begun[i].imag()));
    if (!l || l->im < Long(0)) {
      failure_ = "a frequency of the contact state cannot be distinguished from its neighbours";
      return false;
    }
    roots_.push_back({*l, 1});
  }
  merge_roots();
  return true;
}

/// Merges equal roots into one root with a multiplicity, and sorts the roots by |l|, ascending.
void Search::merge_roots() {
  std::sort(roots_.begin(), roots_.end(), [](const Root& a, const Root& b) {
    return std::pair(size_of(a.l), a.l.re) < std::pair(size_of(b.l), b.l.re);
  });
  std::vector<Root> parted;
  for (const Root& root : roots_) {
    const auto same = std::find_if(parted.rbegin(), parted.rend(), [&](const Root& other) {
      return size_of(other.l - root.l) <= equal_roots * size_of(root.l);
    });
    if (same == parted.rend())
      parted.push_back(root);
    else
      ++same->members;
  }
  roots_ = std::move(parted);
}

/// Computes the entries of eigenvectors for all modes from null vectors of T. right: null if only the left vector is needed.
void Search::spread(const Local& local, Wide l, const SmallVector<Wide>* right, const SmallVector<Wide>& left,
                    Vectors& out) const {
  const auto near = [&](Index j) { return std::find(local.near.begin(), local.near.end(), j); };
  if (right != nullptr)
    for (std::size_t a = 0; a < rank(); ++a)
      out.force[a] = (*right)[a] * (local.scale[a] * Long(pencil_.scale(a)));
  for (Index j = 0; j < n_; ++j) {
    const auto place = static_cast<std::size_t>(j);
    if (const auto found = near(j); found != local.near.end()) {
      const std::size_t row = rank() + static_cast<std::size_t>(found - local.near.begin());
      if (right != nullptr) out.x[place] = (*right)[row] * (1 / local.unit);
      out.y[place] = left[row] * (1 / local.unit);
      continue;
    }
    Wide pull, push;
    for (std::size_t a = 0; a < rank(); ++a) {
      if (right != nullptr) pull += (*right)[a] * (pencil_.terms()[a].u[j] * local.scale[a]);
      push += left[a] * local.kappa[a] * (pencil_.terms()[a].v[j] * local.scale[a]);
    }
    const Wide p = pencil_.pole(j, l);
    if (right != nullptr) out.x[place] = size_of(pull) == Long(0) ? Wide() : -(pull * inverse(p));
    if (size_of(push) != Long(0)) out.y[place] += push * inverse(p);
  }
}

/// Returns y^T L'(l) x, where L(l) is the matrix of the equations in all modes.
Wide Search::product(Wide l, const Vectors& left, const Vectors& right) const {
  Wide sum;
  for (Index j = 0; j < n_; ++j) {
    const auto place = static_cast<std::size_t>(j);
    sum += left.y[place] * right.x[place] * (l * Long(2) + Wide(pencil_.decay()[j]));
  }
  for (std::size_t a = 0; a < rank(); ++a) {
    if (pencil_.damping(a) == 0.0) continue;
    Wide u, v;
    for (Index j = 0; j < n_; ++j) {
      u += left.y[static_cast<std::size_t>(j)] * Long(pencil_.terms()[a].u[j]);
      v += right.x[static_cast<std::size_t>(j)] * Long(pencil_.terms()[a].v[j]);
    }
    sum += u * v * Long(pencil_.damping(a));
  }
  return sum;
}

std::complex<double> narrow(Wide a) { return {static_cast<double>(a.re), static_cast<double>(a.im)}; }

/// Stores a root and its vectors, scaled so that |x| = 1 and y^T L' x = 1. product: y^T L' x before scaling.
void Search::keep(Wide l, const Vectors& v, Wide product, DampedModes& out) {
  Long size = 0, left = 0, from = 0;
  for (const Wide x : v.x) size += x.re * x.re + x.im * x.im;
  size = std::sqrt(size);
  const Long share = l.im > Long(0) ? 2 : 1;
  const Wide down = inverse(product) * size;
  std::vector<Wide> along(rank());
  for (std::size_t a = 0; a < rank(); ++a)
    for (Index j = 0; j < n_ && pencil_.damping(a) != 0.0; ++j)
      along[a] += v.y[static_cast<std::size_t>(j)] * Long(pencil_.terms()[a].u[j]);
  const Index k = next_++;
  out.root[k] = narrow(l);
  for (Index j = 0; j < n_; ++j) {
    const auto place = static_cast<std::size_t>(j);
    const Wide y = v.y[place] * down;
    Wide q = y * (l + Wide(pencil_.decay()[j]));
    for (std::size_t a = 0; a < rank(); ++a)
      q += along[a] * down * Long(pencil_.damping(a) * pencil_.terms()[a].v[j]);
    out.shape(j, k) = narrow(v.x[place] * (share / size));
    out.from_rate(k, j) = narrow(y);
    out.from_q(k, j) = narrow(q);
    left += y.re * y.re + y.im * y.im;
    from += q.re * q.re + q.im * q.im;
  }
  for (std::size_t a = 0; a < rank(); ++a)
    out.force(static_cast<Index>(a), k) = narrow(v.force[a] * (share / size));
  out.condition =
      std::max(out.condition, static_cast<double>(std::sqrt(from) + size_of(l) * std::sqrt(left)));
}

bool Search::add_coupled_root(const Root& root, DampedModes& out) {
  Local local;
  if (!pencil_.assemble_at(root.l, local)) return false;
  const SmallLu<Wide> lu(local.t, local.size);
  const std::size_t m = root.members;
  if (m > local.size || lu.pivot(local.size - m) > singular_pencil * std::max(Long(1), lu.pivot(0)))
    return false;
  std::vector<Vectors> all(m);
  for (std::size_t i = 0; i < m; ++i) {
    SmallVector<Wide> right{}, left{};
    lu.null_vectors(right, left, m, i);
    all[i] = zero_vectors();
    spread(local, root.l, &right, left, all[i]);
  }
  // Multiple root: combine the right vectors x so that y_i^T L' x_k = 0 for i != k.
  SmallMatrix<Wide> products{};
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t k = 0; k < m; ++k) products[i][k] = product(root.l, all[i], all[k]);
  if (m == 1) {
    keep(root.l, all[0], products[0][0], out);
    return true;
  }
  const SmallLu<Wide> turn(products, m);
  if (turn.singular()) return false;
  const std::vector<Vectors> old = all;
  for (std::size_t k = 0; k < m; ++k) {
    SmallVector<Wide> unit{};
    unit[k] = Wide(1);
    const SmallVector<Wide> mix = turn.solve(unit);
    Vectors& v = all[k];
    for (std::size_t j = 0; j < v.x.size(); ++j) {
      v.x[j] = Wide();
      for (std::size_t i = 0; i < m; ++i) v.x[j] += old[i].x[j] * mix[i];
    }
    for (std::size_t a = 0; a < rank(); ++a) {
      v.force[a] = Wide();
      for (std::size_t i = 0; i < m; ++i) v.force[a] += old[i].force[a] * mix[i];
    }
    keep(root.l, v, Wide(1), out);
  }
  return true;
}

/// Adds the two roots of mode j, which is coupled to no term but may be excited by the forces of terms.
bool Search::add_uncoupled_roots(Index j, DampedModes& out) {
  const Long c = pencil_.decay()[j], d = pencil_.omega_squared()[j], inside = c * c / 4 - d;
  std::vector<Wide> roots;
  if (inside < Long(0)) {
    roots.push_back({-c / 2, std::sqrt(-inside)});
  } else {
    const Long far = -(c / 2 + std::sqrt(inside));
    if (far == Long(0) || inside == Long(0)) {
      failure_ = d == Long(0) ? "the contact state has a free motion without damping"
                              : "the contact state has a critically damped mode";
      return false;
    }
    roots.push_back({far, 0});
    roots.push_back({d / far, 0});
  }
  for (const Wide l : roots) {
    Vectors v = zero_vectors();
    v.x[static_cast<std::size_t>(j)] = v.y[static_cast<std::size_t>(j)] = Wide(1);
    if (rank() > 0) {
      Local local;
      if (!pencil_.assemble_at(l, local)) return false;
      const SmallLu<Wide> lu(local.t, local.size);
      if (lu.singular() || lu.pivot(local.size - 1) < singular_pencil * std::max(Long(1), lu.pivot(0)))
        return false;
      SmallVector<Wide> driven{};
      for (std::size_t a = 0; a < rank(); ++a) driven[a] = Wide(-pencil_.terms()[a].u[j] * local.scale[a]);
      spread(local, l, nullptr, lu.solve_transposed(driven), v);
    }
    keep(l, v, product(l, v, v), out);
  }
  return true;
}

void Search::to_given_modes(DampedModes& out) const {
  for (const auto& [first, vectors] : pencil_.rotations()) {
    const Index rows = vectors.rows();
    out.shape.middleRows(first, rows) = (vectors * out.shape.middleRows(first, rows)).eval();
    out.from_q.middleCols(first, rows) = (out.from_q.middleCols(first, rows) * vectors.transpose()).eval();
    out.from_rate.middleCols(first, rows) =
        (out.from_rate.middleCols(first, rows) * vectors.transpose()).eval();
  }
}

DampedModes Search::run() {
  DampedModes out;
  if (!find_roots()) {
    out.failure = failure_;
    return out;
  }
  Index count = 0;
  for (const Root& root : roots_) count += static_cast<Index>(root.members);
  count += 2 * static_cast<Index>(pencil_.uncoupled_modes().size());
  out.root.setZero(count);
  out.shape.setZero(n_, count);
  out.force.setZero(static_cast<Index>(rank()), count);
  out.from_q.setZero(count, n_);
  out.from_rate = out.from_q;
  for (const Root& root : roots_)
    if (!add_coupled_root(root, out)) failure_ = "the contact state has nearly equal frequencies";
  for (const Index j : pencil_.uncoupled_modes())
    if (failure_.empty() && !add_uncoupled_roots(j, out) && failure_.empty())
      failure_ = "two modes of the contact state have nearly the same frequency";
  if (!failure_.empty()) {
    out.failure = failure_;
    return out;
  }
  std::vector<Index> order(static_cast<std::size_t>(next_));
  std::iota(order.begin(), order.end(), Index(0));
  std::sort(order.begin(), order.end(),
            [&](Index a, Index b) { return std::abs(out.root[a]) < std::abs(out.root[b]); });
  out.root = out.root(order).eval();
  out.shape = out.shape(Eigen::all, order).eval();
  out.force = out.force(Eigen::all, order).eval();
  out.from_q = out.from_q(order, Eigen::all).eval();
  out.from_rate = out.from_rate(order, Eigen::all).eval();
  test_round_trip(pencil_, out);
  to_given_modes(out);
  return out;
}

}  // namespace

DampedModes damped_modes(const Eigen::VectorXd& square, const Eigen::VectorXd& decay,
                         const std::vector<ModalTerm>& terms) {
  const DampedPencil pencil(square, decay, terms);
  return Search(pencil).run();
}

}  // namespace signorini::modal
