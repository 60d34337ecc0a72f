#include "result/certificate_files.hpp"

#include <fstream>

#include "base/text.hpp"
#include "result/table.hpp"
#include "signorini/error.hpp"

namespace signorini::result {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t much = 1 << 16;  // bytes per write

/// Adds the columns of the certificate to events.csv, row by row, because a long list of events needs much memory.
void add_columns(const fs::path& path, const Certificate& certificate) {
  std::ifstream old(path, std::ios::binary);
  std::string line;
  if (!old || !std::getline(old, line)) throw FileError(path.string(), "cannot be read again");
  fs::path draft = path;
  draft += ".part";
  std::error_code error;
  fs::remove(draft, error);  // draft of a killed run, or a symbolic link, which must not be followed
  {
    CsvFile file(draft);
    CsvBlock block;
    block.raw(line);
    for (const CertificateColumn& column : certificate_columns) block.text(column.name);
    block.end_row();
    for (std::size_t row = 0; row < certificate.t_errors.size() && std::getline(old, line); ++row) {
      const bool certain = certificate.certain(row);
      block.raw(line);
      block.number(certain ? std::optional(certificate.t_errors[row]) : std::nullopt);
      block.text(certain ? "1" : "0").end_row();
      if (block.str().size() > much) file.write(block);
    }
    file.write(block);
  }
  fs::rename(draft, path, error);
  if (error) throw FileError(path.string(), "cannot be written: " + error.message());
}

void write_errors(const fs::path& path, const Model& model, const HistoryErrors& errors) {
  CsvTable<std::size_t> table = {{"t", [&](std::size_t row) { return errors.t[row]; }}};
  for (std::size_t j = 0; j < model.columns.size(); ++j)
    table.add(model.columns[j].name, [&errors, j](std::size_t row) { return errors.at(row, j); });
  TableFile<std::size_t> file(path, std::move(table));
  for (std::size_t row = 0; row < errors.t.size(); ++row) file.add(row);
  file.flush();
}

}  // namespace

void write_certificate(const fs::path& directory, const Model& model, const Certificate& certificate) {
  add_columns(directory / "events.csv", certificate);
  write_errors(directory / "errors.csv", model, certificate.history);
}

base::Json certificate_json(const CertifiedReport& run) {
  if (!run.certificate) return nullptr;
  const Certificate& c = *run.certificate;
  base::Json json = {{"until", c.until},
                     {"complete", c.complete},
                     {"reason", c.reason},
                     {"companion", c.companion},
                     {"choice", c.choice},
                     {"factor", c.factor},
                     {"events", c.certain_events()},
                     {"unordered", c.unordered}};
  json["first_uncertain"] = c.first_uncertain ? base::Json(*c.first_uncertain + 1) : base::Json(nullptr);
  json["wall_time"] = c.wall_time;
  json["wait"] = c.wait;
  if (c.reduction)
    json["reduction"] = {{"displacement", c.reduction->displacement}, {"force", c.reduction->force}};
  return json;
}

base::Json peak_errors_json(const CertifiedReport& run, std::size_t k) {
  if (!run.certificate || k >= run.certificate->peaks.size() || !run.certificate->peaks[k]) return nullptr;
  const Peak& e = *run.certificate->peaks[k];
  return {{"tangential", e.tangential}, {"normal", e.normal}, {"N", e.N}, {"T", e.T}};
}

base::Json landing_errors_json(const CertifiedReport& run, std::size_t k, std::size_t landing) {
  if (!run.certificate || k >= run.certificate->landings.size()) return nullptr;
  const auto& list = run.certificate->landings[k];
  if (landing >= list.size() || !list[landing]) return nullptr;
  const Landing& e = *list[landing];
  return {{"start", e.start},
          {"duration", e.start + e.end},
          {"peak_force", e.peak_force},
          {"impulse", e.impulse}};
}

}  // namespace signorini::result
