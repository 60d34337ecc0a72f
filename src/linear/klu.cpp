#include "linear/klu.hpp"

#include <klu.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "base/rounding.hpp"

namespace signorini::linear {

// Reads the factors that KLU has computed.
//
//   FactorReader reader;  reader.read(symbolic, numeric, common, true, factors);   after klu_l_factor
//                         reader.read(symbolic, numeric, common, false, factors);  after klu_l_refactor
//
// After a refactorisation with kept pivots only values have changed, so the reader keeps all positions.

class FactorReader {
 public:
  /// pattern: true after a factorisation with fresh pivots; the indices are then read, too. Errors: runtime_error.
  void read(klu_l_symbolic* symbolic, klu_l_numeric* numeric, klu_l_common* common, bool pattern,
            TriangularFactors& factors);

 private:
  using Columns = TriangularFactors::Columns;
  using Long = SuiteSparse_long;
  /// One of KLU's factors in KLU's format.
  struct Raw {
    std::vector<Long> start, row;
    std::vector<double> value;
    std::vector<std::size_t> from;  // for each value of the packed columns: its index in `value`
    [[nodiscard]] std::size_t begin(std::size_t k) const { return static_cast<std::size_t>(start[k]); }
    void resize(std::size_t columns, Long entries);
  };
  void allocate_factors(const klu_l_symbolic& symbolic, const klu_l_numeric& numeric);
  void read_pattern(TriangularFactors& factors);
  void order(Raw& raw, bool lower, Columns& c) const;
  void sort_by_level(const std::vector<int>& level, bool backwards, std::vector<int>& columns) const;

  Raw lower_, upper_, off_;
  std::vector<Long> rows_, columns_, blocks_;
  std::vector<double> scale_;
};

namespace {

static_assert(sizeof(SuiteSparse_long) == sizeof(std::int64_t));

// KLU only reads these arrays, but its interface lacks const.
SuiteSparse_long* raw(const std::vector<std::int64_t>& v) {
  return reinterpret_cast<SuiteSparse_long*>(const_cast<std::int64_t*>(v.data()));
}
double* raw(const std::vector<double>& v) { return const_cast<double*>(v.data()); }

// Smallest ratio of the reciprocal condition with kept pivots to that with fresh pivots; below it new pivots are chosen.
constexpr double min_rcond_ratio = 1e-3;

}  // namespace

struct Klu::Handles {
  klu_l_common common{};
  klu_l_symbolic* symbolic = nullptr;
  klu_l_numeric* numeric = nullptr;
  FactorReader reader;
  TriangularFactors factors;
  std::vector<double> work;
};

Klu::Klu(const std::vector<std::int64_t>& column_start, const std::vector<std::int64_t>& row)
    : h_(std::make_unique<Handles>()), column_start_(column_start), row_(row) {
  klu_l_defaults(&h_->common);
  const auto n = static_cast<SuiteSparse_long>(column_start.size()) - 1;
  h_->work.resize(column_start.size() - 1);
  h_->symbolic = klu_l_analyze(n, raw(column_start_), raw(row_), &h_->common);
  if (h_->symbolic == nullptr && h_->common.status != KLU_SINGULAR)
    throw std::runtime_error("the solver KLU cannot analyse the pattern of the system matrix");
}

Klu::~Klu() {
  klu_l_free_numeric(&h_->numeric, &h_->common);
  klu_l_free_symbolic(&h_->symbolic, &h_->common);
}

bool Klu::factor(const std::vector<double>& values) {
  ++factorisations;
  if (h_->symbolic == nullptr) return false;
  klu_l_free_numeric(&h_->numeric, &h_->common);
  h_->numeric = klu_l_factor(raw(column_start_), raw(row_), raw(values), h_->symbolic, &h_->common);
  if (h_->numeric == nullptr || h_->common.status == KLU_SINGULAR) return false;
  klu_l_rcond(h_->symbolic, h_->numeric, &h_->common);
  fresh_rcond_ = h_->common.rcond;
  h_->reader.read(h_->symbolic, h_->numeric, &h_->common, true, h_->factors);
  return fresh_rcond_ >= rounding::eps;
}

bool Klu::refactor(const std::vector<double>& values) {
  if (h_->numeric == nullptr) return factor(values);
  ++refactorisations;
  if (klu_l_refactor(raw(column_start_), raw(row_), raw(values), h_->symbolic, h_->numeric, &h_->common) ==
          0 ||
      h_->common.status == KLU_SINGULAR)
    return factor(values);
  klu_l_rcond(h_->symbolic, h_->numeric, &h_->common);
  if (h_->common.rcond < min_rcond_ratio * fresh_rcond_) return factor(values);
  h_->reader.read(h_->symbolic, h_->numeric, &h_->common, false, h_->factors);
  return true;
}

void Klu::solve(double* b) { h_->factors.solve(b, h_->work.data()); }

const TriangularFactors& Klu::factors() const { return h_->factors; }

void FactorReader::Raw::resize(std::size_t columns, Long entries) {
  start.resize(columns + 1);
  row.resize(static_cast<std::size_t>(entries) + 1);
  value.resize(static_cast<std::size_t>(entries) + 1);
}

/// Sorts the columns of each block by level. Columns of the same level do not depend on each other.
void FactorReader::sort_by_level(const std::vector<int>& level, bool backwards,
                                 std::vector<int>& columns) const {
  columns.resize(level.size());
  std::iota(columns.begin(), columns.end(), 0);
  for (std::size_t block = 0; block + 1 < blocks_.size(); ++block) {
    const auto begin = columns.begin() + blocks_[block], end = columns.begin() + blocks_[block + 1];
    if (backwards) std::reverse(begin, end);
    std::stable_sort(begin, end, [&](int a, int b) {
      return level[static_cast<std::size_t>(a)] < level[static_cast<std::size_t>(b)];
    });
  }
}

void FactorReader::order(Raw& raw, bool lower, Columns& c) const {
  // The diagonal is the first entry in a column of L and the last entry in a column of U.
  const std::size_t n = raw.start.size() - 1, first = lower ? 1 : 0, last = lower ? 0 : 1;
  std::vector<int> level(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t k = lower ? i : n - 1 - i;
    for (std::size_t p = raw.begin(k) + first; p + last < raw.begin(k + 1); ++p) {
      int& of_row = level[static_cast<std::size_t>(raw.row[p])];
      of_row = std::max(of_row, level[k] + 1);
    }
  }
  sort_by_level(level, !lower, c.column);
  c.end.clear();
  c.row.clear();
  raw.from.clear();
  for (const int column : c.column) {
    const auto k = static_cast<std::size_t>(column);
    for (std::size_t p = raw.begin(k) + first; p + last < raw.begin(k + 1); ++p) {
      c.row.push_back(static_cast<int>(raw.row[p]));
      raw.from.push_back(p);
    }
    c.end.push_back(static_cast<int>(c.row.size()));
  }
  c.value.resize(c.row.size());
}

void FactorReader::allocate_factors(const klu_l_symbolic& symbolic, const klu_l_numeric& numeric) {
  const auto n = static_cast<std::size_t>(symbolic.n);
  lower_.resize(n, numeric.lnz);
  upper_.resize(n, numeric.unz);
  off_.resize(n, numeric.nzoff);
  rows_.resize(n);
  columns_.resize(n);
  blocks_.resize(static_cast<std::size_t>(symbolic.nblocks) + 1);
  scale_.resize(n);
}

void FactorReader::read_pattern(TriangularFactors& factors) {
  factors.rows_.assign(rows_.begin(), rows_.end());
  factors.columns_.assign(columns_.begin(), columns_.end());
  factors.blocks_.assign(blocks_.begin(), blocks_.end());
  factors.inverse_scale_.resize(scale_.size());
  factors.inverse_pivot_.resize(scale_.size());
  order(lower_, true, factors.lower_);
  order(upper_, false, factors.upper_);
  factors.off_.end.assign(off_.start.begin() + 1, off_.start.end());
  factors.off_.row.assign(off_.row.begin(), off_.row.begin() + off_.start.back());
  factors.off_.value.resize(factors.off_.row.size());
}

void FactorReader::read(klu_l_symbolic* symbolic, klu_l_numeric* numeric, klu_l_common* common, bool pattern,
                        TriangularFactors& factors) {
  if (pattern) allocate_factors(*symbolic, *numeric);
  if (klu_l_extract(numeric, symbolic, lower_.start.data(), lower_.row.data(), lower_.value.data(),
                    upper_.start.data(), upper_.row.data(), upper_.value.data(), off_.start.data(),
                    off_.row.data(), off_.value.data(), rows_.data(), columns_.data(), scale_.data(),
                    blocks_.data(), common) == 0)
    throw std::runtime_error("the solver KLU does not return its factors of the system matrix");
  if (pattern) read_pattern(factors);
  for (std::size_t k = 0; k < scale_.size(); ++k) {
    factors.inverse_pivot_[k] = 1.0 / upper_.value[upper_.begin(k + 1) - 1];
    factors.inverse_scale_[k] = 1.0 / scale_[k];
  }
  Columns &lower = factors.lower_, &upper = factors.upper_, &off = factors.off_;
  for (std::size_t p = 0; p < lower.value.size(); ++p) lower.value[p] = lower_.value[lower_.from[p]];
  for (std::size_t p = 0; p < upper.value.size(); ++p)
    upper.value[p] =
        upper_.value[upper_.from[p]] * factors.inverse_pivot_[static_cast<std::size_t>(upper.row[p])];
  std::copy(off_.value.begin(), off_.value.begin() + static_cast<std::ptrdiff_t>(off.value.size()),
            off.value.begin());
}

std::size_t TriangularFactors::Columns::bytes() const {
  return sizeof(int) * (column.size() + end.size() + row.size()) + sizeof(double) * value.size();
}

std::size_t TriangularFactors::bytes() const {
  return lower_.bytes() + upper_.bytes() + off_.bytes() +
         sizeof(int) * (rows_.size() + columns_.size() + blocks_.size()) +
         sizeof(double) * (inverse_scale_.size() + inverse_pivot_.size());
}

/// x_row -= value x_column for columns [begin, end) in the order of the sweep.
void TriangularFactors::sweep(const Columns& c, std::size_t begin, std::size_t end, double* x) {
  auto p = static_cast<std::size_t>(begin == 0 ? 0 : c.end[begin - 1]);
  const int* row = c.row.data();
  const double* value = c.value.data();
  for (std::size_t i = begin; i < end; ++i) {
    const auto stop = static_cast<std::size_t>(c.end[i]);
    const double xk = x[c.column[i]];
    for (; p < stop; ++p) x[row[p]] -= value[p] * xk;
  }
}

void TriangularFactors::solve(double* b, double* x) const {
  const std::size_t n = rows_.size();
  for (std::size_t k = 0; k < n; ++k) x[k] = b[rows_[k]] * inverse_scale_[k];
  for (std::size_t block = blocks_.size() - 1; block-- > 0;) {
    const auto begin = static_cast<std::size_t>(blocks_[block]),
               end = static_cast<std::size_t>(blocks_[block + 1]);
    sweep(lower_, begin, end, x);
    for (std::size_t k = begin; k < end; ++k) x[k] *= inverse_pivot_[k];
    sweep(upper_, begin, end, x);
    if (block == 0 || off_.row.empty()) continue;
    auto p = static_cast<std::size_t>(off_.end[begin - 1]);
    for (std::size_t k = begin; k < end; ++k)
      for (; p < static_cast<std::size_t>(off_.end[k]); ++p) x[off_.row[p]] -= off_.value[p] * x[k];
  }
  for (std::size_t k = 0; k < n; ++k) b[columns_[k]] = x[k];
}

}  // namespace signorini::linear
