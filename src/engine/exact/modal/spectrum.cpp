#include "engine/exact/modal/spectrum.hpp"

#include <algorithm>
#include <complex>
#include <limits>
#include <numeric>

#include "base/eigen_dense.hpp"

namespace signorini {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double parting = 1e-22;       // of a pole, between equal ones: below all rounding
constexpr double filling = 1e-30;       // of the greatest entry, in rows that are zero
constexpr double equal = 1e-13;         // relative distance of poles that are equal but for rounding
constexpr double unseen_share = 1e-13;  // of equal modes: what rounding shows of one that no contact sees
constexpr int most_sweeps = 200;
constexpr double nearly = 1e-9;       // relative step from which on rounding may end the convergence
constexpr double lift = 1e-3;         // of a start, off the real axis: complex roots are not found from it
constexpr double real_share = 1e-7;   // imaginary part of an offset that rounding makes of a real root
constexpr double paired = 1e-8;       // relative distance of conjugates
constexpr double close_roots = 1e-3;  // relative distance of eigenvalues whose vectors rounding mixes
constexpr std::size_t most_neighbours = 6;
constexpr double worst_round_trip = 1e-9, worst_condition = 1e4;

Complex complex_of(std::complex<double> a) { return {a.real(), a.imag()}; }
template <class S>
S start_of(std::complex<double> value, std::size_t index);
template <>
double start_of(std::complex<double> value, std::size_t) {
  return value.real();
}
template <>
Complex start_of(std::complex<double> value, std::size_t index) {
  Complex result = complex_of(value);
  if (std::abs(result.im) < lift * std::abs(result.re))
    result.im = (index % 2 == 0 ? lift : -lift) * std::abs(result.re);
  return result;
}

}  // namespace

Poles::Poles(const Eigen::VectorXd& values)
    : base(values.data(), values.data() + values.size()), tiny(base.size(), 0.0) {
  double scale = 1.0;
  for (const double value : base)
    if (value > 0.0) {
      scale = value;
      break;
    }
  for (std::size_t i = 1; i < base.size(); ++i)
    if (base[i] - base[i - 1] <= equal * base[i]) base[i] = base[i - 1];
  for (std::size_t i = 1; i < base.size(); ++i)
    if (base[i] == base[i - 1]) tiny[i] = tiny[i - 1] + parting * std::max(scale, base[i]);
}

Spectrum::Spectrum(const Poles& poles, Eigen::MatrixXd u, Eigen::MatrixXd v, bool symmetric)
    : rank_(static_cast<std::size_t>(u.cols())), order_(poles.size()) {
  std::iota(order_.begin(), order_.end(), std::size_t(0));
  values_ = poles.base;
  if (rank_ == 0) return;
  // Equal poles follow each other, and groups survive in what is seen of them.
  group_begin_.resize(poles.size());
  group_end_ = group_begin_;
  for (std::size_t first = 0, last = 0; first < poles.size(); first = last) {
    last = first + 1;
    while (last < poles.size() && poles.base[last] == poles.base[first]) ++last;
    std::fill_n(group_begin_.begin() + static_cast<std::ptrdiff_t>(first), last - first, first);
    std::fill_n(group_end_.begin() + static_cast<std::ptrdiff_t>(first), last - first, last);
  }
  turn_equal_modes(u, v);
  take_seen(poles, u, v);
  if (symmetric) {
    std::vector<double> offset(n_);
    if (search(offset)) {
      real_.home = home_;
      real_.offset = std::move(offset);
    }
  } else {
    std::vector<Complex> offset(n_);
    if (search(offset) && !part_kinds(offset))
      failure_ = "complex eigenvalues do not come in conjugate pairs";
  }
  if (!failure_.empty()) return;
  find_vectors(real_);
  find_vectors(pairs_);
  order_values();
  find_squares();
  part_close_roots();
  test();
}

/// So that V has as few rows that are not zero as its rank allows.
void Spectrum::turn_equal_modes(Eigen::MatrixXd& u, Eigen::MatrixXd& v) {
  for (std::size_t first = 0; first < group_end_.size(); first = group_end_[first]) {
    const auto row = static_cast<Eigen::Index>(first),
               rows = static_cast<Eigen::Index>(group_end_[first] - first);
    if (rows == 1) continue;
    const Eigen::MatrixXd seen = v.middleRows(row, rows);
    const EigenPairs pairs = symmetric_eigen(seen * seen.transpose());
    turns_.emplace_back(row, pairs.vectors);
    for (Eigen::MatrixXd* matrix : {&u, &v})
      matrix->middleRows(row, rows) = (pairs.vectors.transpose() * matrix->middleRows(row, rows)).eval();
    const double most = v.middleRows(row, rows).cwiseAbs().maxCoeff();
    for (Eigen::Index j = 0; j < rows; ++j)
      if (v.row(row + j).cwiseAbs().maxCoeff() <= unseen_share * most) v.row(row + j).setZero();
  }
}

void Spectrum::take_seen(const Poles& poles, const Eigen::MatrixXd& u, const Eigen::MatrixXd& v) {
  const double least = filling * v.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < v.rows(); ++i)
    (v.row(i).cwiseAbs().maxCoeff() > least ? seen_ : unseen_).push_back(i);
  n_ = seen_.size();
  std::vector<std::size_t> begin, end;
  for (std::size_t i = 0; i < n_; ++i) {
    const auto old = static_cast<std::size_t>(seen_[i]);
    poles_.base.push_back(poles.base[old]);
    poles_.tiny.push_back(poles.tiny[old]);
    const bool same = i > 0 && poles_.base[i] == poles_.base[i - 1];
    begin.push_back(same ? begin.back() : i);
  }
  end.assign(n_, n_);
  for (std::size_t i = n_; i-- > 1;) end[i - 1] = begin[i] == begin[i - 1] ? end[i] : i;
  group_begin_ = std::move(begin);
  group_end_ = std::move(end);
  u_ = u(seen_, Eigen::all);
  v_ = v(seen_, Eigen::all);
  u_unseen_ = u(unseen_, Eigen::all);
  for (const Eigen::Index i : unseen_) unseen_poles_.push_back(poles.base[static_cast<std::size_t>(i)]);
  const double fill = filling * u.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < u_.rows(); ++i)
    if (u_.row(i).cwiseAbs().maxCoeff() <= fill) u_.row(i).setConstant(fill);
  home_.resize(n_);
  std::iota(home_.begin(), home_.end(), std::size_t(0));
  terms_.resize(n_ * rank_ * rank_);
  for (std::size_t i = 0; i < n_; ++i)
    for (std::size_t a = 0; a < rank_; ++a)
      for (std::size_t b = 0; b < rank_; ++b)
        terms_[(i * rank_ + a) * rank_ + b] = v_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(a)) *
                                              u_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(b));
}

void Spectrum::order_values() {
  std::vector<double> values = real_.value;
  values.insert(values.end(), unseen_poles_.begin(), unseen_poles_.end());
  order_.resize(values.size());
  std::iota(order_.begin(), order_.end(), std::size_t(0));
  std::sort(order_.begin(), order_.end(),
            [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  values_.resize(values.size());
  for (std::size_t p = 0; p < order_.size(); ++p) values_[p] = values[order_[p]];
}

/// Offsets to first order: those of the small matrix that a group of close poles makes of what the others do.
template <class S>
void Spectrum::start(std::vector<S>& offset) const {
  const auto at = [](std::size_t i) { return static_cast<Eigen::Index>(i); };
  for (std::size_t first = 0, last = 0; first < n_; first = last) {
    last = group_end_[first];
    SmallMatrix<double> g{};
    for (std::size_t a = 0; a < rank_; ++a) g[a][a] = 1.0;
    for (std::size_t i = 0; i < n_; ++i) {
      if (i >= first && i < last) continue;
      const double weight = 1.0 / poles_.between(i, first);
      const double* term = terms_.data() + i * rank_ * rank_;
      for (std::size_t a = 0; a < rank_; ++a)
        for (std::size_t b = 0; b < rank_; ++b) g[a][b] += weight * term[a * rank_ + b];
    }
    const SmallLu<double> lu(g, rank_);
    const std::size_t count = last - first;
    Eigen::MatrixXd small(at(count), at(count));
    for (std::size_t j = 0; j < count; ++j) {
      SmallVector<double> column{};
      for (std::size_t a = 0; a < rank_; ++a) column[a] = v_(at(first + j), at(a));
      if (!lu.singular()) column = lu.solve(column);
      for (std::size_t i = 0; i < count; ++i) {
        double sum = i == j ? poles_.between(first + i, first) : 0.0;
        for (std::size_t a = 0; a < rank_; ++a) sum += u_(at(first + i), at(a)) * column[a];
        small(at(i), at(j)) = sum;
      }
    }
    std::vector<std::complex<double>> value(count, small(0, 0));
    if (count > 1) {
      const Eigen::VectorXcd found = general_eigenvalues(small);
      std::copy_n(found.data(), count, value.begin());
      std::sort(value.begin(), value.end(), [](auto a, auto b) { return a.real() < b.real(); });
    }
    const double down =
        first > 0 ? 0.5 * poles_.between(first, first - 1) : std::abs(poles_.base[last - 1]) + 1e300;
    const double up = last < n_ ? 0.5 * poles_.between(last, last - 1) : 1e300;
    for (std::size_t j = 0; j < count; ++j) {
      const double limit = value[j].real() > 0.0 ? up : down, size = std::abs(value[j]);
      const double part = (1.0 + static_cast<double>(j)) / (1.0 + static_cast<double>(count));
      if (size > limit) value[j] *= 2.0 * part * limit / size;
      const std::size_t k = first + j;
      offset[k] =
          start_of<S>(value[j] - poles_.between(k, first), k);  // from the first pole of the group to its own
      if (!(size_of(offset[k]) > 0.0)) offset[k] = S(parting * std::max(poles_.base[k], 1e-250));
    }
  }
}

/// What the poles outside a group make of a root near it: G0 = 1 + V^T (D - l)^-1 U without the group, its
/// slope, and the group's own matrix, which is not singular near its poles:
///   S = D_group - l + U_group G0^-1 V_group^T,   det(A - l) = product of (D_i - l) outside * det G0 * det S
template <class S>
struct Spectrum::Local {
  SmallMatrix<S> g{}, slope{}, s{};
  std::size_t first = 0, count = 0;
};

template <class S>
void Spectrum::group_matrix(const SmallLu<S>& lu, S own, std::size_t home, Local<S>& local) const {
  const auto at = [](std::size_t i) { return static_cast<Eigen::Index>(i); };
  for (std::size_t j = 0; j < local.count; ++j) {
    SmallVector<S> column{};
    for (std::size_t a = 0; a < rank_; ++a) column[a] = S(v_(at(local.first + j), at(a)));
    column = lu.solve(column);
    for (std::size_t i = 0; i < local.count; ++i) {
      S sum{};
      for (std::size_t a = 0; a < rank_; ++a) sum += column[a] * u_(at(local.first + i), at(a));
      if (i == j) sum += S(poles_.between(local.first + i, home)) - own;
      local.s[i][j] = sum;
    }
  }
}

template <class S>
typename Spectrum::Correction<S> Spectrum::correction(std::size_t k, const std::vector<S>& offset,
                                                      const std::vector<S>& shift) const {
  const auto at = [](std::size_t i) { return static_cast<Eigen::Index>(i); };
  Local<S> local;
  for (std::size_t a = 0; a < rank_; ++a) local.g[a][a] = S(1.0);
  const std::size_t home = home_[k], squares = rank_ * rank_;
  local.first = group_begin_[home];
  local.count = group_end_[home] - local.first;
  const double base = poles_.base[home], tiny = poles_.tiny[home];
  const S own = offset[k];
  S poles{}, sum{};
  for (std::size_t i = 0; i < n_; ++i) {
    const S f = (own - offset[i]) + ((base - poles_.base[home_[i]]) + (tiny - poles_.tiny[home_[i]]));
    if (i >= local.first && i < local.first + local.count) {
      if (i != k && size_of(f) > 0.0) sum -= inverse(f);
      continue;
    }
    const S one = inverse(own + ((base - poles_.base[i]) + (tiny - poles_.tiny[i])));  // 1 / (l - D_i)
    const S two = one * one;
    const double* term = terms_.data() + i * squares;
    for (std::size_t a = 0; a < rank_; ++a)
      for (std::size_t b = 0; b < rank_; ++b) {
        const double w = *term++;
        local.g[a][b] -= one * w;
        local.slope[a][b] += two * w;
      }
    poles += one;
    if (i == k)
      sum += one;
    else if (size_of(f) > 0.0)  // 1/(l - D_i) - 1/(l - l_i), whose terms nearly cancel
      sum += shift[i] * one * inverse(f);
  }
  const SmallLu<S> lu(local.g, rank_);
  if (lu.singular()) return {S(0.0), S(0.0)};
  group_matrix(lu, own, home, local);
  // S' = -1 - U G0^-1 G0' G0^-1 V^T
  SmallMatrix<S> change{};
  for (std::size_t j = 0; j < local.count; ++j) {
    SmallVector<S> column{}, product{};
    for (std::size_t a = 0; a < rank_; ++a) column[a] = S(v_(at(local.first + j), at(a)));
    column = lu.solve(column);
    for (std::size_t a = 0; a < rank_; ++a)
      for (std::size_t b = 0; b < rank_; ++b) product[a] += local.slope[a][b] * column[b];
    product = lu.solve(product);
    for (std::size_t i = 0; i < local.count; ++i) {
      S value = i == j ? S(-1.0) : S(0.0);
      for (std::size_t a = 0; a < rank_; ++a) value -= product[a] * u_(at(local.first + i), at(a));
      change[i][j] = value;
    }
  }
  const SmallLu<S> group(local.s, local.count);
  if (group.singular()) return {S(0.0), S(0.0)};
  const S trace = lu.trace_of_solution(local.slope) + group.trace_of_solution(change);
  return {inverse(poles + trace), inverse(sum + trace)};
}

/// To the nearest pole.
template <class S>
void Spectrum::settle_home(std::size_t k, std::vector<S>& offset) {
  std::size_t best = home_[k];
  const auto distance = [&](std::size_t to) { return size_of(offset[k] - poles_.between(to, home_[k])); };
  const double step = real_part(offset[k]);
  const std::size_t now = home_[k];
  for (std::size_t i = now; step > 0.0 && i + 1 < n_ && distance(i + 1) < distance(i); ++i) best = i + 1;
  for (std::size_t i = now; step < 0.0 && i > 0 && distance(i - 1) < distance(i); --i) best = i - 1;
  if (best == now) return;
  const S moved = offset[k] - poles_.between(best, now);
  if (!(size_of(moved) > 0.0)) return;
  offset[k] = moved;
  home_[k] = best;
}

template <class S>
bool Spectrum::search(std::vector<S>& offset) {
  start(offset);
  std::vector<S> shift(n_);  // D_i - l_i
  for (std::size_t i = 0; i < n_; ++i) shift[i] = -offset[i];
  std::vector<double> last(n_, std::numeric_limits<double>::infinity());
  std::vector<std::size_t> todo(n_);
  std::iota(todo.begin(), todo.end(), std::size_t(0));
  for (sweeps_ = 0; !todo.empty() && sweeps_ < most_sweeps; ++sweeps_) {
    std::vector<std::size_t> left;
    for (const std::size_t k : todo) {
      const Correction<S> found = correction(k, offset, shift);
      // Where two approaches collide they would push each other away by less than they are apart.
      const bool collides =
          size_of(found.alone) > 1e3 * size_of(found.among) || !std::isfinite(size_of(found.among));
      const S step =
          collides ? found.alone *
                         (0.3 + 0.1 * static_cast<double>((k + 7 * static_cast<std::size_t>(sweeps_)) % 5))
                   : found.among;
      const double size = size_of(step);
      if (!std::isfinite(size)) {
        failure_ = "the search for eigenvalues left the range of numbers";
        return false;
      }
      S next = offset[k] - step;
      if (!(size_of(next) > 0.0)) next = offset[k] * 0.5;
      offset[k] = next;
      const double relative = size / size_of(next);
      const std::size_t before = home_[k];
      settle_home(k, offset);
      shift[k] = S(poles_.between(k, home_[k])) - offset[k];
      const bool settled =
          !collides && (relative <= 4.0 * epsilon || (relative < nearly && relative > 0.25 * last[k]));
      if (!settled || home_[k] != before) left.push_back(k);
      last[k] = relative;
    }
    todo = std::move(left);
  }
  if (todo.empty()) return true;
  failure_ = "the search for eigenvalues did not settle";
  return false;
}

bool Spectrum::part_kinds(const std::vector<Complex>& offset) {
  struct Found {
    std::size_t home;
    Complex offset;
    double size;
  };
  std::vector<Found> above, below;
  std::vector<Found> flat;
  for (std::size_t k = 0; k < n_; ++k) {
    const Complex value = offset[k] + poles_.base[home_[k]];
    const Found f{home_[k], offset[k], size_of(value)};
    if (std::abs(f.offset.im) <= real_share * size_of(f.offset))
      flat.push_back(f);
    else
      (f.offset.im > 0.0 ? above : below).push_back(f);
  }
  if (above.size() != below.size()) return false;
  const auto by_place = [](const Found& a, const Found& b) {
    return a.size < b.size || (a.size == b.size && a.offset.re < b.offset.re);
  };
  for (std::vector<Found>* list : {&above, &below, &flat}) std::sort(list->begin(), list->end(), by_place);
  for (const Found& a : above) {
    const bool has_twin = std::any_of(below.begin(), below.end(), [&](const Found& b) {
      const Complex off = a.offset - Complex(b.offset.re, -b.offset.im) + poles_.between(a.home, b.home);
      return size_of(off) <= paired * size_of(a.offset);
    });
    if (!has_twin) return false;
    pairs_.home.push_back(a.home);
    pairs_.offset.push_back(a.offset);
  }
  for (const Found& f : flat) {
    real_.home.push_back(f.home);
    real_.offset.push_back(f.offset.re);
  }
  return true;
}

template <class S>
void Spectrum::find_vectors(Roots<S>& roots) {
  const std::size_t squares = rank_ * rank_;
  for (std::size_t k = 0; k < roots.size(); ++k) {
    const std::size_t home = roots.home[k];
    const S own = roots.offset[k];
    roots.value.push_back(own + (poles_.base[home] + poles_.tiny[home]));
    Local<S> local;
    local.first = group_begin_[home];
    local.count = group_end_[home] - local.first;
    for (std::size_t a = 0; a < rank_; ++a) local.g[a][a] = S(1.0);
    for (std::size_t i = 0; i < n_; ++i) {
      if (i >= local.first && i < local.first + local.count) continue;
      const S one = inverse(S(poles_.between(i, home)) - own);
      const double* term = terms_.data() + i * squares;
      for (std::size_t a = 0; a < rank_; ++a)
        for (std::size_t b = 0; b < rank_; ++b) local.g[a][b] += one * *term++;
    }
    const SmallLu<S> lu(local.g, rank_);
    group_matrix(lu, own, home, local);
    SmallVector<S> right{}, left{}, c{}, d{};  // of the group, and what they are outside
    SmallLu<S>(local.s, local.count).null_vectors(right, left);
    for (std::size_t j = 0; j < local.count; ++j)
      for (std::size_t a = 0; a < rank_; ++a) {
        const auto row = static_cast<Eigen::Index>(local.first + j), column = static_cast<Eigen::Index>(a);
        c[a] -= right[j] * v_(row, column);
        d[a] -= left[j] * u_(row, column);
      }
    c = lu.solve(c);
    d = lu.solve_transposed(d);
    double x_size = 0.0, y_size = 0.0;
    S product{};
    for (std::size_t i = 0; i < n_; ++i) {
      const S one = inverse(S(poles_.between(i, home)) - own);
      S x{}, y{};
      for (std::size_t a = 0; a < rank_; ++a) {
        x += c[a] * u_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(a));
        y += d[a] * v_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(a));
      }
      x *= one;
      y *= one;
      x_size = std::hypot(x_size, size_of(x));
      y_size = std::hypot(y_size, size_of(y));
      product += x * y;
    }
    condition_ = std::max(condition_, x_size * y_size / size_of(product));
    const S to_right = S(1.0 / x_size), to_left = inverse(product) * x_size;
    for (std::size_t a = 0; a < rank_; ++a) {
      roots.right.push_back(c[a] * to_right);
      roots.left.push_back(d[a] * to_left);
    }
  }
}

template <class S>
void Spectrum::project(const Roots<S>& roots, const Eigen::VectorXd& q, bool form, std::vector<S>& z) const {
  const std::size_t count = roots.size();
  z.assign(count, S(0.0));
  std::vector<double> base(count), tiny(count);
  for (std::size_t k = 0; k < count; ++k) {
    base[k] = poles_.base[roots.home[k]];
    tiny[k] = poles_.tiny[roots.home[k]];
  }
  const Eigen::MatrixXd& side = form ? u_ : v_;
  std::vector<S> sums(count * rank_, S(0.0)), one(count);
  for (std::size_t i = 0; i < n_; ++i) {
    const double entry = q[seen_[i]];
    if (entry == 0.0) continue;
    const double base_i = poles_.base[i], tiny_i = poles_.tiny[i];
    for (std::size_t k = 0; k < count; ++k)
      one[k] = inverse(S((base_i - base[k]) + (tiny_i - tiny[k])) - roots.offset[k]);
    for (std::size_t a = 0; a < rank_; ++a) {
      const double weight = entry * side(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(a));
      S* sum = sums.data() + a * count;
      for (std::size_t k = 0; k < count; ++k) sum[k] += one[k] * weight;
    }
  }
  const std::vector<S>& small = form ? roots.right : roots.left;
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t a = 0; a < rank_; ++a) z[k] += small[k * rank_ + a] * sums[a * count + k];
}

/// What the modes that are seen move of one that is not: -1/(D_j - l) U_j c a mode.
template <class S>
S Spectrum::moved(const Roots<S>& roots, std::size_t k, std::size_t j, double pole) const {
  S sum{};
  for (std::size_t a = 0; a < rank_; ++a)
    sum += roots.right[k * rank_ + a] * u_unseen_(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(a));
  if (!(size_of(sum) > 0.0)) return S(0.0);
  return sum * inverse(S(pole - poles_.base[roots.home[k]] - poles_.tiny[roots.home[k]]) - roots.offset[k]);
}

double Spectrum::moved_by_all(std::size_t j, const std::vector<double>& real,
                              const std::vector<Complex>& pair) const {
  double sum = 0.0;
  const double pole = unseen_poles_[j];
  for (std::size_t k = 0; k < real_.size(); ++k) sum += moved(real_, k, j, pole) * real[k];
  for (std::size_t k = 0; k < pairs_.size(); ++k) sum += whole(moved(pairs_, k, j, pole) * pair[k]);
  return sum;
}

void Spectrum::project(const Eigen::VectorXd& q, bool form, Amplitudes& z) const {
  if (rank_ == 0) {
    z.real.assign(q.data(), q.data() + q.size());
    z.pair.clear();
    return;
  }
  Eigen::VectorXd turned = q;
  for (const auto& [row, vectors] : turns_)
    turned.segment(row, vectors.rows()) = vectors.transpose() * q.segment(row, vectors.rows());
  std::vector<double> real;
  project(real_, turned, form, real);
  project(pairs_, turned, form, z.pair);
  if (!form) {
    const std::vector<double> mixed = real;
    for (const Close& pair : close_) real[pair.k] -= pair.product * mixed[pair.l];
  }
  if (form) {  // of a form, what is unseen is moved by all modes
    for (std::size_t j = 0; j < unseen_.size(); ++j)
      if (const double entry = turned[unseen_[j]]; entry != 0.0) {
        for (std::size_t k = 0; k < real_.size(); ++k)
          real[k] += entry * moved(real_, k, j, unseen_poles_[j]);
        for (std::size_t k = 0; k < pairs_.size(); ++k)
          z.pair[k] += moved(pairs_, k, j, unseen_poles_[j]) * entry;
      }
    for (const Eigen::Index i : unseen_) real.push_back(turned[i]);
  } else {
    const std::vector<double> seen = real;
    for (std::size_t j = 0; j < unseen_.size(); ++j)
      real.push_back(turned[unseen_[j]] - moved_by_all(j, seen, z.pair));
  }
  z.real.resize(order_.size());
  for (std::size_t p = 0; p < order_.size(); ++p) z.real[p] = real[order_[p]];
}

void Spectrum::from_modes(const std::vector<const Amplitudes*>& z,
                          const std::vector<Eigen::VectorXd*>& q) const {
  if (rank_ == 0) {
    for (std::size_t s = 0; s < z.size(); ++s)
      *q[s] =
          Eigen::Map<const Eigen::VectorXd>(z[s]->real.data(), static_cast<Eigen::Index>(z[s]->real.size()));
    return;
  }
  const auto n = static_cast<Eigen::Index>(n_), rank = static_cast<Eigen::Index>(rank_);
  std::vector<std::vector<double>> real(z.size(), std::vector<double>(order_.size()));
  for (std::size_t s = 0; s < z.size(); ++s)
    for (std::size_t p = 0; p < order_.size(); ++p) real[s][order_[p]] = z[s]->real[p];
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(n, rank * static_cast<Eigen::Index>(z.size()));
  std::vector<double> one(n_);
  for (std::size_t k = 0; k < real_.size(); ++k) {
    const double base = poles_.base[real_.home[k]], tiny = poles_.tiny[real_.home[k]], own = real_.offset[k];
    for (std::size_t i = 0; i < n_; ++i)
      one[i] = 1.0 / (((poles_.base[i] - base) + (poles_.tiny[i] - tiny)) - own);
    for (std::size_t s = 0; s < z.size(); ++s)
      for (std::size_t a = 0; a < rank_; ++a) {
        const double weight = real_.right[k * rank_ + a] * real[s][k];
        double* sum = sums.col(static_cast<Eigen::Index>(s * rank_ + a)).data();
        for (std::size_t i = 0; i < n_; ++i) sum[i] += weight * one[i];
      }
  }
  for (std::size_t k = 0; k < pairs_.size(); ++k)
    for (std::size_t i = 0; i < n_; ++i) {
      const Complex pole = inverse(Complex(poles_.between(i, pairs_.home[k])) - pairs_.offset[k]);
      for (std::size_t s = 0; s < z.size(); ++s)
        for (std::size_t a = 0; a < rank_; ++a)
          sums(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(s * rank_ + a)) +=
              whole(pairs_.right[k * rank_ + a] * z[s]->pair[k] * pole);
    }
  for (std::size_t s = 0; s < z.size(); ++s) {
    q[s]->resize(static_cast<Eigen::Index>(seen_.size() + unseen_.size()));
    (*q[s])(seen_) =
        u_.cwiseProduct(sums.middleCols(static_cast<Eigen::Index>(s) * rank, rank)).rowwise().sum();
    for (std::size_t j = 0; j < unseen_.size(); ++j)
      (*q[s])[unseen_[j]] = real[s][real_.size() + j] + moved_by_all(j, real[s], z[s]->pair);
    for (const auto& [row, vectors] : turns_)
      q[s]->segment(row, vectors.rows()) = (vectors * q[s]->segment(row, vectors.rows())).eval();
  }
}

/// Vectors of eigenvalues that nearly coincide are right but for each other: Y := (1 - E) Y with E = Y X
/// there.
void Spectrum::part_close_roots() {
  std::vector<std::size_t> order;
  for (const std::size_t k : order_)
    if (k < real_.size()) order.push_back(k);
  const auto vector = [&](const std::vector<double>& small, const Eigen::MatrixXd& side, std::size_t k) {
    Eigen::VectorXd x(static_cast<Eigen::Index>(n_));
    for (std::size_t i = 0; i < n_; ++i) {
      double sum = 0.0;
      for (std::size_t a = 0; a < rank_; ++a)
        sum += small[k * rank_ + a] * side(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(a));
      x[static_cast<Eigen::Index>(i)] = sum / (poles_.between(i, real_.home[k]) - real_.offset[k]);
    }
    return x;
  };
  for (std::size_t p = 0; p < order.size(); ++p) {
    const std::size_t k = order[p];
    for (std::size_t m = p + 1; m < std::min(order.size(), p + most_neighbours); ++m) {
      const std::size_t l = order[m];
      if (real_.value[l] - real_.value[k] > close_roots * real_.value[l]) break;
      close_.push_back({k, l, vector(real_.left, v_, k).dot(vector(real_.right, u_, l))});
      close_.push_back({l, k, vector(real_.left, v_, l).dot(vector(real_.right, u_, k))});
    }
  }
}

/// x^T x, of which the pole nearest to the root makes most.
void Spectrum::find_squares() {
  const auto square = [&](const auto& roots, std::size_t k) {
    using S = typename std::decay_t<decltype(roots.offset)>::value_type;
    S sum{};
    for (std::size_t i = 0; i < n_; ++i) {
      S entry{};
      for (std::size_t a = 0; a < rank_; ++a)
        entry += roots.right[k * rank_ + a] * u_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(a));
      entry *= inverse(S(poles_.between(i, roots.home[k])) - roots.offset[k]);
      sum += entry * entry;
    }
    for (std::size_t j = 0; j < unseen_.size(); ++j) {
      const S entry = moved(roots, k, j, unseen_poles_[j]);
      sum += entry * entry;
    }
    return sum;
  };
  for (const std::size_t k : order_) {
    const bool seen = k < real_.size();
    squares_.push_back(seen ? square(real_, k) : 1.0);
    value_base_.push_back(seen ? poles_.base[real_.home[k]] : unseen_poles_[k - real_.size()]);
    value_offset_.push_back(seen ? real_.offset[k] + poles_.tiny[real_.home[k]] : 0.0);
  }
  for (std::size_t k = 0; k < pairs_.size(); ++k) pair_squares_.push_back(square(pairs_, k));
}

double Spectrum::product(std::size_t k, std::size_t l, const std::vector<double>& c,
                         const std::vector<double>& h) const {
  const double difference = (value_base_[k] - value_base_[l]) + (value_offset_[k] - value_offset_[l]);
  double sum = 0.0;
  for (std::size_t a = 0; a < rank_; ++a)
    sum += h[k * rank_ + a] * c[l * rank_ + a] - c[k * rank_ + a] * h[l * rank_ + a];
  return sum == 0.0 ? 0.0 : sum / difference;
}

void Spectrum::products(std::vector<double>& c, std::vector<double>& h, std::vector<Complex>& c_pair,
                        std::vector<Complex>& h_pair) const {
  const auto fill = [&](const auto& roots, auto& left, auto& right) {
    using S = typename std::decay_t<decltype(left)>::value_type;
    left = roots.right;
    right.assign(roots.size() * rank_, S(0.0));
    for (std::size_t k = 0; k < roots.size(); ++k) {
      const auto add = [&](const S& entry, const Eigen::MatrixXd& u, Eigen::Index row) {
        for (std::size_t a = 0; a < rank_; ++a)
          right[k * rank_ + a] += entry * u(row, static_cast<Eigen::Index>(a));
      };
      for (std::size_t i = 0; i < n_; ++i) {
        S entry{};
        for (std::size_t a = 0; a < rank_; ++a)
          entry +=
              roots.right[k * rank_ + a] * u_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(a));
        add(entry * inverse(S(poles_.between(i, roots.home[k])) - roots.offset[k]), u_,
            static_cast<Eigen::Index>(i));
      }
      for (std::size_t j = 0; j < unseen_.size(); ++j)
        add(moved(roots, k, j, unseen_poles_[j]), u_unseen_, static_cast<Eigen::Index>(j));
    }
  };
  fill(pairs_, c_pair, h_pair);
  std::vector<double> c_seen, h_seen;
  fill(real_, c_seen, h_seen);
  // An unseen mode's shape is a unit vector: U c stands for one as the limit of a residue, and it meets
  // others in one entry only.
  c.assign(order_.size() * rank_, 0.0);
  h = c;
  for (std::size_t p = 0; p < order_.size(); ++p)
    if (order_[p] < real_.size())
      for (std::size_t a = 0; a < rank_; ++a) {
        c[p * rank_ + a] = c_seen[order_[p] * rank_ + a];
        h[p * rank_ + a] = h_seen[order_[p] * rank_ + a];
      }
    else
      for (std::size_t a = 0; a < rank_; ++a)
        h[p * rank_ + a] =
            u_unseen_(static_cast<Eigen::Index>(order_[p] - real_.size()), static_cast<Eigen::Index>(a));
}

void Spectrum::test() {
  Eigen::VectorXd q(static_cast<Eigen::Index>(order_.size() + 2 * pairs_.size())), back;
  double entry = 0.5;
  for (Eigen::Index i = 0; i < q.size(); ++i) {  // a logistic map: all modes, the same in every run
    entry = 3.99 * entry * (1.0 - entry) + 1e-3;
    q[i] = 2.0 * entry - 1.0;
  }
  Amplitudes z;
  to_modes(q, z);
  from_modes({&z}, {&back});
  round_trip_ = (back - q).cwiseAbs().maxCoeff();
  if (!(round_trip_ < worst_round_trip))
    failure_ = "the modes of the state do not give back what they are made of";
  if (!(condition_ < worst_condition)) failure_ = "the modes of the state are nearly parallel";
}

}  // namespace signorini
