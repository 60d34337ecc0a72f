#include "run/curve_record.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "run/thinned.hpp"
#include "scene/quantities.hpp"

namespace signorini {
namespace {

constexpr std::size_t most_of_a_kind = 24;  // displacement's pictures name no more
constexpr double most_intervals = 8000.0;   // of the run: a tenth of a picture's point
constexpr std::size_t most_values = 100000, most_rows = 8000, fewest_rows = 1600;

}  // namespace

CurveRecord::CurveRecord(const Model& model, double t_end, const Recorder& recorder)
    : model_(model),
      t_end_(t_end),
      last_(recorder.wants_motion() ? 0.0 : std::numeric_limits<double>::infinity()),
      wanted_(recorder.wants_motion()) {
  if (!wanted_) return;
  std::map<std::string, std::size_t> of_kind;
  for (const Column& column : model.columns) {
    if (column.velocity || ++of_kind[column.name.substr(column.name.rfind('.') + 1)] > most_of_a_kind)
      continue;
    columns_.push_back(column);
    const bool turns =
        column.dof >= 0 && model.physical_dofs()[static_cast<std::size_t>(column.dof)].rotation;
    factors_.push_back(turns ? 1.0 : model.unit.length);
  }
  most_rows_ =
      std::clamp(most_values / (columns_.size() + energy_columns.size() + 2), fewest_rows, most_rows);
}

std::vector<int> CurveRecord::dofs() const {
  std::vector<int> list;
  for (const Column& column : columns_)
    if (column.dof >= 0) list.push_back(column.dof);
  return list;
}

bool CurveRecord::needs(double t) const { return t - last_ >= t_end_ / most_intervals || t >= t_end_; }

void CurveRecord::add(double t, const Vector& u, const Energy& energy) {
  if (!wanted()) return;
  last_ = t;
  Row row{t * model_.unit.time, {}};
  row.values.reserve(columns_.size() + energy_columns.size() + 1);
  const bool plain = !model_.reduction && !model_.basis;
  const Vector physical = plain ? Vector() : model_.physical(u);
  const Vector& shown = plain ? u : physical;
  for (std::size_t i = 0; i < columns_.size(); ++i)
    row.values.push_back(columns_[i].dof < 0 ? 0.0 : shown[columns_[i].dof] * factors_[i]);
  const double unit = factor_of(unit::energy, model_.unit);
  for (const EnergyColumn& column : energy_columns) row.values.push_back(energy.*column.value * unit);
  row.values.push_back(energy.balance() * unit);
  if (!rows_.empty() && rows_.back().t == row.t && rows_.back().values == row.values) return;
  rows_.push_back(std::move(row));
  if (rows_.size() > most_rows_) thin();
}

void CurveRecord::thin() {
  const double t_end = t_end_ * model_.unit.time;
  if (width_ == 0.0) width_ = t_end / static_cast<double>(most_rows_);
  // The balance, last, is rounding: its extremes would keep all.
  const std::size_t count = columns_.size() + energy_columns.size();
  const auto value = [](const Row& row, std::size_t i) { return row.values[i]; };
  rows_ = thinned(std::move(rows_), width_, count, value);
  while (rows_.size() > most_rows_ / 2) {
    width_ *= 2.0;
    rows_ = thinned(std::move(rows_), width_, count, value);
  }
}

void CurveRecord::write(Recorder& recorder) const {
  if (!wanted()) return;
  Curves curves;
  curves.names.emplace_back("t");
  for (const Column& column : columns_) curves.names.push_back(column.name);
  for (const EnergyColumn& column : energy_columns) curves.names.emplace_back(column.name);
  curves.names.emplace_back(balance_column);
  for (const Row& row : rows_) {
    curves.rows.push_back({row.t});
    curves.rows.back().insert(curves.rows.back().end(), row.values.begin(), row.values.end());
  }
  recorder.curves(curves);
}

}  // namespace signorini
