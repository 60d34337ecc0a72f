#include "study/witness/told_row.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/excerpt.hpp"
#include "base/number.hpp"
#include "signorini/error.hpp"

namespace signorini {
namespace {

constexpr const char* heading[] = {"t", "contact", "state", "gap", "ut", "vt", "slip", "N", "T", "ratio"};

constexpr std::size_t columns = std::size(heading), ratio_column = columns - 1;

}  // namespace

ToldRowReader::ToldRowReader(const std::filesystem::path& file, const Model& model)
    : file_(file), names_(model), reader_(file) {
  const std::vector<std::string>& found = reader_.header();
  ratios_ = found.size() == columns;
  if ((!ratios_ && found.size() != ratio_column) ||
      !std::equal(found.begin(), found.end(), std::begin(heading)))
    throw FileError(file.string(), "line 1: expected t,contact,state,gap,ut,vt,slip,N,T,ratio");
}

double ToldRowReader::number(std::size_t column) const {
  const std::optional<double> value = parse_number(reader_.cell(column));
  if (!value || !std::isfinite(*value))
    throw FileError(file_.string(),
                    fmt::format("line {}: {}: found \"{}\", expected a number", reader_.line(),
                                heading[column], excerpt(reader_.cell(column))));
  return *value;
}

std::optional<ToldRow> ToldRowReader::next() {
  if (!reader_.next()) return std::nullopt;
  ToldRow row;
  row.t = number(0);
  row.contact = static_cast<std::size_t>(names_.at(reader_.cell(1), file_, reader_.line()));
  row.state = reader_.cell(2);
  if (!reader_.cell(3).empty()) row.gap = number(3);
  double* const numbers[] = {&row.ut, &row.vt, &row.slip, &row.N, &row.T};
  for (std::size_t i = 0; i < std::size(numbers); ++i) *numbers[i] = number(4 + i);
  if (ratios_ && !reader_.cell(ratio_column).empty()) row.ratio = number(ratio_column);
  return row;
}

void ToldRowReader::refuse_as_cut(const std::string& lacks) const {
  throw FileError(file_.string(), cut_at(reader_, lacks));
}

}  // namespace signorini
