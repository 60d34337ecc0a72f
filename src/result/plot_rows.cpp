#include "result/plot_rows.hpp"

#include <algorithm>
#include <cmath>

#include "result/csv_read.hpp"
#include "signorini/error.hpp"

namespace signorini {

namespace fs = std::filesystem;

ContactNumbers contact_numbers(const RunFacts& facts) {
  ContactNumbers numbers;
  for (std::size_t k = 0; k < facts.contacts.size(); ++k) numbers[facts.contacts[k].name] = k;
  return numbers;
}

std::size_t number_of(const ContactNumbers& numbers, const std::string& contact, const fs::path& file) {
  const auto found = numbers.find(contact);
  if (found == numbers.end())
    throw FileError(file.string(),
                    "has a contact that summary.json has not: '" + contact.substr(0, 80) + "'");
  return found->second;
}

void read_motion(const fs::path& directory, const ContactNumbers& numbers, PlottedRun& run) {
  std::error_code error;
  run.motion.clear();
  if (!fs::is_regular_file(directory / "motion.csv", error)) return;
  run.motion.resize(numbers.size());
  CsvReader motion(directory / "motion.csv");
  const std::size_t name = motion.column("contact"), n = motion.column("N"), t = motion.column("T");
  for (std::size_t row = 0; motion.next(); ++row) {
    const std::size_t k = number_of(numbers, motion.cell(name), directory / "motion.csv");
    PlottedRun::Rows& rows = run.motion[k];
    if (rows.count == 0) rows.first = row;
    if (row != rows.first + rows.count)
      throw FileError((directory / "motion.csv").string(), "has rows of contacts that are not in order");
    ++rows.count;
    const double force = motion.number(n);
    run.greatest_compression[k] = std::max(run.greatest_compression[k], -force);
    run.greatest_force = std::max(run.greatest_force, std::hypot(force, motion.number(t)));
  }
}

void read_curves(const fs::path& directory, PlottedRun& run) {
  std::error_code error;
  run.curves.clear();
  if (!fs::is_regular_file(directory / "curves.csv", error)) return;
  CsvReader curves(directory / "curves.csv");
  const std::size_t name = curves.column("curve");
  for (std::size_t row = 0; curves.next(); ++row) {
    PlottedRun::Rows& rows = run.curves[curves.cell(name)];
    if (rows.count == 0) rows.first = row;
    if (row != rows.first + rows.count)
      throw FileError((directory / "curves.csv").string(), "has rows of curves that are not in order");
    ++rows.count;
  }
}

}  // namespace signorini
