// read_sensitivities(): reads the data for pictures.
#include <algorithm>
#include <cerrno>
#include <fstream>

#include "base/input_file.hpp"
#include "base/json.hpp"
#include "result/csv_read.hpp"
#include "result/units_json.hpp"
#include "signorini/error.hpp"
#include "study/sensitivity/sensitivity_files.hpp"

namespace signorini {

namespace fs = std::filesystem;

namespace {

double rate_in(const CsvReader& reader, std::size_t column) {
  return reader.cell(column).empty() ? EventRates::none : reader.number(column);
}

/// Index of the contact in s.contacts, to which a new name is added; -1 for the run itself.
int contact_numbered(Sensitivities& s, const std::string& name) {
  if (name.empty()) return -1;
  const auto found = std::find(s.contacts.begin(), s.contacts.end(), name);
  if (found == s.contacts.end()) s.contacts.push_back(name);
  return static_cast<int>(std::find(s.contacts.begin(), s.contacts.end(), name) - s.contacts.begin());
}

void read_parameters(const fs::path& file, Sensitivities& s, Sigmas& sigmas) {
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw FileError(file.string(), "cannot be read" + because(errno));
  try {
    const Json json = parse_json(stream);
    s.title = json.at("title");
    s.units = units_from(json.at("units"));
    for (const Json& row : json.at("parameters")) {
      Parameter& parameter = s.parameters.emplace_back();
      parameter.path = row.at("path");
      parameter.value = row.at("value");
      if (row.contains("sigma")) sigmas.push_back(row.at("sigma"));
    }
  } catch (const Json::exception& error) {
    throw FileError(file.string(), std::string("is not of sensitivities: ") + error.what());
  }
  if (s.parameters.empty() || (!sigmas.empty() && sigmas.size() != s.parameters.size()))
    throw FileError(file.string(), "expected parameters, all of them with a sigma or none");
}

}  // namespace

Sensitivities read_sensitivities(const fs::path& directory, Sigmas& sigmas) {
  Sensitivities s;
  sigmas.clear();
  read_parameters(directory / "sensitivity.json", s, sigmas);
  const std::size_t parameters = s.parameters.size();
  CsvReader figures(directory / "figures.csv");
  for (std::size_t row = 0; figures.next(); ++row) {
    if (row % parameters == 0) {
      Response& figure = s.responses.emplace_back();
      figure.name = figures.cell(figures.column("figure"));
      figure.contact = contact_numbered(s, figures.cell(figures.column("contact")));
      figure.value = figures.number(figures.column("value"));
      figure.rates.assign(parameters, EventRates::none);
    }
    s.responses.back().rates[row % parameters] = rate_in(figures, figures.column("dvalue_dp"));
  }
  CsvReader events(directory / "sensitivities.csv");
  for (std::size_t row = 0; events.next(); ++row) {
    if (row % parameters == 0) {
      Event& event = s.events.emplace_back();
      event.t = events.number(events.column("t"));
      event.contact = contact_numbered(s, events.cell(events.column("contact")));
      s.event_rates.emplace_back(parameters);
    }
    s.event_rates.back()[row % parameters].t = rate_in(events, events.column("dt_dp"));
  }
  return s;
}

}  // namespace signorini
