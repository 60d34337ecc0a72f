#include "engine/exact/modal/damped_modes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "base/eigen_dense.hpp"
#include "engine/exact/modal/small_lu.hpp"

namespace signorini {
namespace {

using Long = long double;
using Wide = WideComplex;

constexpr Long near_pole = 0.03L;      // |P_j| beside |l|^2 + d_j: such a mode stands in G; chosen
constexpr std::size_t most_near = 3;   // modes in G
constexpr double equal_poles = 1e-13;  // relative distance of poles that are equal but for rounding
constexpr double unseen = 1e-13;       // of equal poles: what rounding shows of one that no term sees
constexpr Long equal_roots = 1e-13L;   // relative distance of roots that were found to be one
constexpr Long singular = 1e-10L;      // of the greatest pivot of T, or of 1: one that is zero; chosen
constexpr int most_steps = 30;         // Newton's; 3 to 5 are usual
constexpr double worst_loss_of_trip = 1e-12, worst_dependence = 1e4;  // as of real modes, spectrum.cpp

struct Root {
  Wide l;
  std::size_t members = 1;  // equal roots, of which this is the first
};

class Search {
 public:
  Search(const Eigen::VectorXd& square, const Eigen::VectorXd& decay, const std::vector<ModalTerm>& terms);
  DampedModes run();

 private:
  using Index = Eigen::Index;
  /// T at a place, its slope, and the modes in G.
  struct Local {
    SmallMatrix<Wide> t{}, slope{};
    std::vector<Index> near;
    Long unit = 1;  // sigma: lengths are in units of 1 / sigma
    std::vector<Wide> kappa;
    std::vector<Long> scale;  // of terms: forces are in units of 1 / scale
    std::size_t size = 0;
  };
  struct Vectors {
    std::vector<Wide> x, y, force;
  };
  void turn_equal_poles();
  [[nodiscard]] Eigen::VectorXcd begin() const;
  [[nodiscard]] Wide pole(Index j, Wide l) const { return l * l + l * decay_[j] + Wide(square_[j]); }
  [[nodiscard]] bool gather(Wide l, Local& local) const;
  void add_far(Index j, Wide l, Local& local) const;
  [[nodiscard]] std::optional<Wide> polished(Wide l) const;
  [[nodiscard]] bool find_roots();
  [[nodiscard]] bool merge_roots();
  [[nodiscard]] bool add_seen(const Root& root, DampedModes& out);
  [[nodiscard]] bool add_unseen(Index j, DampedModes& out);
  void spread(const Local& local, Wide l, const SmallVector<Wide>* right, const SmallVector<Wide>& left,
              Vectors& out) const;
  [[nodiscard]] Wide product(Wide l, const Vectors& left, const Vectors& right) const;
  void keep(Wide l, const Vectors& v, Wide product, DampedModes& out);
  void turn_back(DampedModes& out) const;
  void test(DampedModes& out) const;
  [[nodiscard]] std::size_t rank() const { return terms_.size(); }

  const Index n_;
  Eigen::VectorXd square_, decay_;
  std::vector<ModalTerm> terms_;    // turned, and scaled: springs by sqrt(k), constraints to length 1
  std::vector<double> term_scale_;  // by which
  std::vector<double> stiffness_, damping_;  // kappa = stiffness + l damping of scaled springs
  std::vector<std::pair<Index, Eigen::MatrixXd>> turns_;
  std::vector<Index> seen_, unseen_;
  Long softest_ = 1;  // frequency that slow roots are measured by
  std::vector<Root> roots_;
  Index next_ = 0;  // column of the result
  std::string failure_;
};

Search::Search(const Eigen::VectorXd& square, const Eigen::VectorXd& decay,
               const std::vector<ModalTerm>& terms)
    : n_(square.size()), square_(square), decay_(decay), terms_(terms) {
  for (ModalTerm& term : terms_) {
    const double most = term.stiffness > 0.0 ? term.stiffness : term.damping;
    const double scale = term.rigid ? 1.0 / std::sqrt(term.u.norm() * term.v.norm()) : std::sqrt(most);
    term.u *= scale;
    term.v *= scale;
    term_scale_.push_back(scale);
    stiffness_.push_back(term.rigid ? 1.0 : term.stiffness / most);
    damping_.push_back(term.rigid ? 0.0 : term.damping / most);
  }
  turn_equal_poles();
  for (Index j = 0; j < n_; ++j) {
    const bool any =
        std::any_of(terms_.begin(), terms_.end(), [&](const ModalTerm& term) { return term.v[j] != 0.0; });
    (any ? seen_ : unseen_).push_back(j);
  }
  double pull = 0.0;  // what terms make of free modes
  for (const ModalTerm& term : terms_)
    pull = std::max(pull, term.u.cwiseAbs().maxCoeff() * term.v.cwiseAbs().maxCoeff());
  const auto stiff = std::find_if(seen_.begin(), seen_.end(), [&](Index j) { return square_[j] > 0.0; });
  if (stiff != seen_.end())
    softest_ = std::sqrt(static_cast<Long>(square_[*stiff]));
  else if (pull > 0.0)
    softest_ = std::sqrt(static_cast<Long>(pull));
}

/// So that v has as few rows that are not zero among equal poles as there are terms.
void Search::turn_equal_poles() {
  const auto terms = static_cast<Index>(terms_.size());
  for (Index first = 0, last = 0; first < n_; first = last) {
    last = first + 1;
    while (last < n_ && square_[last] - square_[last - 1] <= equal_poles * square_[last] &&
           std::abs(decay_[last] - decay_[first]) <= equal_poles * std::abs(decay_[first]))
      ++last;
    const Index rows = last - first;
    if (rows == 1 || terms == 0) continue;
    square_.segment(first, rows).setConstant(square_[first]);
    decay_.segment(first, rows).setConstant(decay_[first]);
    Eigen::MatrixXd seen(rows, terms);
    for (Index a = 0; a < terms; ++a)
      seen.col(a) = terms_[static_cast<std::size_t>(a)].v.segment(first, rows);
    const EigenPairs pairs = symmetric_eigen(seen * seen.transpose());
    turns_.emplace_back(first, pairs.vectors);
    const double most = unseen * seen.cwiseAbs().maxCoeff();
    const Eigen::MatrixXd turned = pairs.vectors.transpose() * seen;
    for (Index a = 0; a < terms; ++a) {
      ModalTerm& term = terms_[static_cast<std::size_t>(a)];
      term.u.segment(first, rows) = (pairs.vectors.transpose() * term.u.segment(first, rows)).eval();
      for (Index j = 0; j < rows; ++j)
        term.v[first + j] = turned.row(j).cwiseAbs().maxCoeff() <= most ? 0.0 : turned(j, a);
    }
  }
}

/// Roots of the seen modes in doubles, from  x' = (0 1; -K -C) x  on what the constraints leave; scaled so that
/// stiff and soft modes stand beside each other.
Eigen::VectorXcd Search::begin() const {
  const auto m = static_cast<Index>(seen_.size());
  Eigen::MatrixXd k = square_(seen_).asDiagonal(), c = decay_(seen_).asDiagonal();
  Eigen::Index constraints = 0;
  Eigen::MatrixXd forces(m, static_cast<Index>(rank())), forms = forces;
  for (std::size_t a = 0; a < rank(); ++a) {
    const Eigen::VectorXd u = terms_[a].u(seen_), v = terms_[a].v(seen_);
    if (terms_[a].rigid) {
      forces.col(constraints) = u;
      forms.col(constraints++) = v;
      continue;
    }
    if (stiffness_[a] != 0.0) k += stiffness_[a] * u * v.transpose();
    if (damping_[a] != 0.0) c += damping_[a] * u * v.transpose();
  }
  if (constraints > 0) {
    const Eigen::MatrixXd z = orthogonal_complement(forms.leftCols(constraints)),
                          left = orthogonal_complement(forces.leftCols(constraints)).transpose();
    const Eigen::MatrixXd p = solve_dense(left * z, left);
    k = (p * k * z).eval();
    c = (p * c * z).eval();
  }
  const Index size = k.rows();
  Eigen::VectorXd s = k.diagonal().cwiseAbs().cwiseSqrt();
  const double least = size > 0 ? 1e-6 * s.maxCoeff() + 1e-300 : 0.0;
  s = s.cwiseMax(least);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(2 * size, 2 * size);
  for (Index i = 0; i < size; ++i) {  // from high to low, a mode's place and rate beside each other
    const Index row = size - 1 - i;
    all(2 * i, 2 * i + 1) = s[row];
    for (Index j = 0; j < size; ++j) {
      const Index column = size - 1 - j;
      all(2 * i + 1, 2 * j) = -k(row, column) / s[column];
      all(2 * i + 1, 2 * j + 1) -= c(row, column);
    }
  }
  return size > 0 ? general_eigenvalues(all) : Eigen::VectorXcd();
}

/// What a mode outside G adds to T.
void Search::add_far(Index j, Wide l, Local& local) const {
  const Wide p = inverse(pole(j, l)), down = -((l * Long(2) + Wide(decay_[j])) * p * p);
  for (std::size_t a = 0; a < rank(); ++a) {
    const Long v = terms_[a].v[j] * local.scale[a];
    if (v == Long(0)) continue;
    const Wide value = local.kappa[a] * p, slope = local.kappa[a] * down + p * Long(damping_[a]);
    for (std::size_t b = 0; b < rank(); ++b) {
      const Long both = v * (terms_[b].u[j] * local.scale[b]);
      local.t[a][b] += value * both;
      local.slope[a][b] += slope * both;
    }
  }
}

/// False: too many modes are near.
bool Search::gather(Wide l, Local& local) const {
  local = Local{};
  const Long own = l.re * l.re + l.im * l.im;
  local.unit = std::max(std::sqrt(own), softest_);
  for (std::size_t a = 0; a < rank(); ++a) {
    local.scale.push_back(terms_[a].rigid ? local.unit : Long(1));
    local.kappa.push_back(Wide(stiffness_[a]) + l * Long(damping_[a]));
    if (!terms_[a].rigid) local.t[a][a] = Wide(1);
  }
  for (const Index j : seen_) {
    if (size_of(pole(j, l)) < near_pole * (own + static_cast<Long>(square_[j])) ||
        size_of(pole(j, l)) == Long(0)) {
      local.near.push_back(j);
      continue;
    }
    add_far(j, l, local);
  }
  if (local.near.size() > most_near) {  // the farthest ones can be divided by
    std::sort(local.near.begin(), local.near.end(), [&](Index i, Index j) {
      return size_of(pole(i, l)) * (own + Long(square_[j])) < size_of(pole(j, l)) * (own + Long(square_[i]));
    });
    for (std::size_t i = most_near; i < local.near.size(); ++i) {
      if (size_of(pole(local.near[i], l)) < singular * own) return false;
      add_far(local.near[i], l, local);
    }
    local.near.resize(most_near);
  }
  local.size = rank() + local.near.size();
  const Long unit = local.unit;
  for (std::size_t i = 0; i < local.near.size(); ++i) {
    const Index j = local.near[i];
    const std::size_t row = rank() + i;
    local.t[row][row] = pole(j, l) * (1 / (unit * unit));
    local.slope[row][row] = (l * Long(2) + Wide(decay_[j])) * (1 / (unit * unit));
    for (std::size_t a = 0; a < rank(); ++a) {
      local.t[row][a] = Wide(terms_[a].u[j] * local.scale[a] / unit);
      local.t[a][row] = -(local.kappa[a] * (terms_[a].v[j] * local.scale[a] / unit));
      local.slope[a][row] = Wide(-damping_[a] * (terms_[a].v[j] * local.scale[a] / unit));
    }
  }
  return true;
}

/// Newton's steps  -d^T T c / d^T T' c  with the vectors that T nearly takes to zero.
std::optional<Wide> Search::polished(Wide l) const {
  Local local;
  Long last = std::numeric_limits<Long>::infinity();
  for (int i = 0; i < most_steps; ++i) {
    if (!gather(l, local)) return std::nullopt;
    const SmallLu<Wide> lu(local.t, local.size);
    SmallVector<Wide> c{}, d{};
    lu.null_vectors(c, d);
    Wide value, slope;
    for (std::size_t a = 0; a < local.size; ++a)
      for (std::size_t b = 0; b < local.size; ++b) {
        value += d[a] * local.t[a][b] * c[b];
        slope += d[a] * local.slope[a][b] * c[b];
      }
    const Wide step = -(value * inverse(slope));
    const Long size = size_of(step), own = size_of(l);
    if (!std::isfinite(size)) return size_of(value) == Long(0) ? std::optional(l) : std::nullopt;
    l += step;
    if (size <= 8 * std::numeric_limits<Long>::epsilon() * own) return l;
    if (size <= Long(1e-15) * own && size >= last) return l;  // it goes to and fro in its rounding
    last = size;
  }
  return std::nullopt;
}

bool Search::find_roots() {
  const Eigen::VectorXcd begun = begin();
  for (Index i = 0; i < begun.size(); ++i) {
    if (begun[i].imag() < 0.0) continue;
    const std::optional<Wide> l = polished(Wide(begun[i].real(), begun[i].imag()));
    if (!l || l->im < Long(0)) {
      failure_ = "a frequency of the state cannot be told from its neighbours";
      return false;
    }
    roots_.push_back({*l, 1});
  }
  return merge_roots();
}

/// Equal ones follow each other, and the first one knows how many they are.
bool Search::merge_roots() {
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
  return true;
}

/// Of all modes, from the null vectors of T; right: null where the shape is known otherwise.
void Search::spread(const Local& local, Wide l, const SmallVector<Wide>* right, const SmallVector<Wide>& left,
                    Vectors& out) const {
  const auto near = [&](Index j) { return std::find(local.near.begin(), local.near.end(), j); };
  if (right != nullptr)
    for (std::size_t a = 0; a < rank(); ++a)
      out.force[a] = (*right)[a] * (local.scale[a] * Long(term_scale_[a]));
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
      if (right != nullptr) pull += (*right)[a] * (terms_[a].u[j] * local.scale[a]);
      push += left[a] * local.kappa[a] * (terms_[a].v[j] * local.scale[a]);
    }
    const Wide p = pole(j, l);
    if (right != nullptr) out.x[place] = size_of(pull) == Long(0) ? Wide() : -(pull * inverse(p));
    if (size_of(push) != Long(0)) out.y[place] += push * inverse(p);
  }
}

/// y^T L'(l) x
Wide Search::product(Wide l, const Vectors& left, const Vectors& right) const {
  Wide sum;
  for (Index j = 0; j < n_; ++j) {
    const auto place = static_cast<std::size_t>(j);
    sum += left.y[place] * right.x[place] * (l * Long(2) + Wide(decay_[j]));
  }
  for (std::size_t a = 0; a < rank(); ++a) {
    if (damping_[a] == 0.0) continue;
    Wide u, v;
    for (Index j = 0; j < n_; ++j) {
      u += left.y[static_cast<std::size_t>(j)] * Long(terms_[a].u[j]);
      v += right.x[static_cast<std::size_t>(j)] * Long(terms_[a].v[j]);
    }
    sum += u * v * Long(damping_[a]);
  }
  return sum;
}

std::complex<double> narrow(Wide a) { return {static_cast<double>(a.re), static_cast<double>(a.im)}; }

/// x of length 1, y^T L' x = 1.
void Search::keep(Wide l, const Vectors& v, Wide product, DampedModes& out) {
  Long size = 0, left = 0, from = 0;
  for (const Wide x : v.x) size += x.re * x.re + x.im * x.im;
  size = std::sqrt(size);
  const Long share = l.im > Long(0) ? 2 : 1;
  const Wide down = inverse(product) * size;
  std::vector<Wide> along(rank());
  for (std::size_t a = 0; a < rank(); ++a)
    for (Index j = 0; j < n_ && damping_[a] != 0.0; ++j)
      along[a] += v.y[static_cast<std::size_t>(j)] * Long(terms_[a].u[j]);
  const Index k = next_++;
  out.root[k] = narrow(l);
  for (Index j = 0; j < n_; ++j) {
    const auto place = static_cast<std::size_t>(j);
    const Wide y = v.y[place] * down;
    Wide q = y * (l + Wide(decay_[j]));
    for (std::size_t a = 0; a < rank(); ++a) q += along[a] * down * Long(damping_[a] * terms_[a].v[j]);
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

bool Search::add_seen(const Root& root, DampedModes& out) {
  Local local;
  if (!gather(root.l, local)) return false;
  const SmallLu<Wide> lu(local.t, local.size);
  const std::size_t m = root.members;
  if (m > local.size || lu.pivot(local.size - m) > singular * std::max(Long(1), lu.pivot(0))) return false;
  std::vector<Vectors> all(m);
  for (std::size_t i = 0; i < m; ++i) {
    SmallVector<Wide> right{}, left{};
    lu.null_vectors(right, left, m, i);
    all[i] = {std::vector<Wide>(square_.size()), std::vector<Wide>(square_.size()),
              std::vector<Wide>(rank())};
    spread(local, root.l, &right, left, all[i]);
  }
  // Equal roots: x are combined so that y_i^T L' x_k = 0 for i != k.
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

/// The two roots of a mode that drives nothing, and what drives it.
bool Search::add_unseen(Index j, DampedModes& out) {
  const Long c = decay_[j], d = square_[j], inside = c * c / 4 - d;
  std::vector<Wide> roots;
  if (inside < Long(0)) {
    roots.push_back({-c / 2, std::sqrt(-inside)});
  } else {
    const Long far = -(c / 2 + std::sqrt(inside));
    if (far == Long(0) || inside == Long(0)) {
      failure_ = d == Long(0) ? "free motions without damping" : "critically damped modes";
      return false;
    }
    roots.push_back({far, 0});
    roots.push_back({d / far, 0});
  }
  for (const Wide l : roots) {
    Vectors v{std::vector<Wide>(square_.size()), std::vector<Wide>(square_.size()),
              std::vector<Wide>(rank())};
    v.x[static_cast<std::size_t>(j)] = v.y[static_cast<std::size_t>(j)] = Wide(1);
    if (rank() > 0) {
      Local local;
      if (!gather(l, local)) return false;
      const SmallLu<Wide> lu(local.t, local.size);
      if (lu.singular() || lu.pivot(local.size - 1) < singular * std::max(Long(1), lu.pivot(0))) return false;
      SmallVector<Wide> driven{};
      for (std::size_t a = 0; a < rank(); ++a) driven[a] = Wide(-terms_[a].u[j] * local.scale[a]);
      spread(local, l, nullptr, lu.solve_transposed(driven), v);
    }
    keep(l, v, product(l, v, v), out);
  }
  return true;
}

void Search::turn_back(DampedModes& out) const {
  for (const auto& [first, vectors] : turns_) {
    const Index rows = vectors.rows();
    out.shape.middleRows(first, rows) = (vectors * out.shape.middleRows(first, rows)).eval();
    out.from_q.middleCols(first, rows) = (out.from_q.middleCols(first, rows) * vectors.transpose()).eval();
    out.from_rate.middleCols(first, rows) =
        (out.from_rate.middleCols(first, rows) * vectors.transpose()).eval();
  }
}

/// Gives back a motion, each mode of which has an energy of about 1, within the constraints.
void Search::test(DampedModes& out) const {
  Eigen::VectorXd size = square_.cwiseMax(square_.cwiseAbs().maxCoeff() * 1e-12);
  for (std::size_t a = 0; a < rank(); ++a)
    if (!terms_[a].rigid) size += stiffness_[a] * terms_[a].u.cwiseProduct(terms_[a].v).cwiseAbs();
  size = size.cwiseSqrt().eval();
  if (!(size.maxCoeff() > 0.0)) size.setOnes();
  Eigen::VectorXd q(n_), rate(n_);
  double entry = 0.5;
  for (Eigen::VectorXd* x : {&q, &rate})
    for (Index i = 0; i < n_; ++i) {  // a logistic map: all modes, the same in every run
      entry = 3.99 * entry * (1.0 - entry) + 1e-3;
      (*x)[i] = 2.0 * entry - 1.0;
    }
  Eigen::MatrixXd forces(n_, static_cast<Index>(rank())), forms = forces;
  Index rigid = 0;
  for (const ModalTerm& term : terms_)
    if (term.rigid) {
      forces.col(rigid) = term.u;
      forms.col(rigid++) = term.v;
    }
  const auto within = [&](Eigen::VectorXd x) {
    if (rigid == 0) return x;
    const auto u = forces.leftCols(rigid), v = forms.leftCols(rigid);
    for (int twice = 0; twice < 2; ++twice) x -= u * solve_dense(v.transpose() * u, v.transpose() * x);
    return x;
  };
  const Eigen::VectorXd place = within(q.cwiseQuotient(size));
  rate = within(rate);
  const Eigen::VectorXcd y = out.from_q * place + out.from_rate * rate;
  const Eigen::VectorXd back = within((out.shape * y).real() - place),
                        rate_back = within((out.shape * out.root.cwiseProduct(y)).real() - rate);
  const double scale =
      std::max({1.0, place.cwiseProduct(size).cwiseAbs().maxCoeff(), rate.cwiseAbs().maxCoeff()});
  out.round_trip = std::sqrt(back.cwiseProduct(size).squaredNorm() + rate_back.squaredNorm()) / scale;
  if (!(out.round_trip < worst_loss_of_trip))
    out.failure = "the modes of the state do not give back what they are made of";
  else if (!(out.condition < worst_dependence))
    out.failure = "the modes of the state are nearly dependent";
}

DampedModes Search::run() {
  DampedModes out;
  if (!find_roots()) {
    out.failure = failure_;
    return out;
  }
  Index count = 0;
  for (const Root& root : roots_) count += static_cast<Index>(root.members);
  count += 2 * static_cast<Index>(unseen_.size());
  out.root.setZero(count);
  out.shape.setZero(n_, count);
  out.force.setZero(static_cast<Index>(rank()), count);
  out.from_q.setZero(count, n_);
  out.from_rate = out.from_q;
  for (const Root& root : roots_)
    if (!add_seen(root, out)) failure_ = "frequencies of the state that are nearly equal";
  for (const Index j : unseen_)
    if (failure_.empty() && !add_unseen(j, out) && failure_.empty())
      failure_ = "a mode resonates with one that it does not drive";
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
  test(out);
  turn_back(out);
  return out;
}

}  // namespace

DampedModes damped_modes(const Eigen::VectorXd& square, const Eigen::VectorXd& decay,
                         const std::vector<ModalTerm>& terms) {
  return Search(square, decay, terms).run();
}

}  // namespace signorini
