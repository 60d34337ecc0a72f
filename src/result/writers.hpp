// writers.hpp: the tables of a run, row by row as they come (docs/output.md).
//
//   events.csv    the columns of signorini/event.hpp
//   contacts.csv  t,contact,state,gap,ut,vt,slip,N,T        one row a time and contact
//   motion.csv    the same, contact by contact
//   history.csv   t, then the model's columns
//   response.csv  t, then the model's outputs
//   energy.csv    t, the columns of signorini/result.hpp, balance
//
// Each writer writes its header when it is made and keeps a reference to the model. Errors: FileError.
#pragma once

#include <filesystem>

#include "result/csv.hpp"
#include "signorini/result.hpp"

namespace signorini {

class EventWriter {
 public:
  EventWriter(const std::filesystem::path& path, const Model& model);
  void write(const Event& event);

 private:
  void cell(double value);
  void cell(const std::optional<double>& value);
  void cell(int contact);
  void cell(EventType type);
  void cell(State state);

  const Model& model_;
  CsvBlock block_;
  CsvFile file_;
};

/// contacts.csv and motion.csv.
class ContactWriter {
 public:
  ContactWriter(const std::filesystem::path& path, const Model& model);
  void write(const Sample& sample);
  void write(int contact, const std::vector<MotionRow>& rows);

 private:
  void row(double t, std::size_t contact, const ContactSample& sample);

  const Model& model_;
  CsvBlock block_;
  CsvFile file_;
};

class HistoryWriter {
 public:
  HistoryWriter(const std::filesystem::path& path, const Model& model);
  void write(const Sample& sample);

 private:
  const Model& model_;
  CsvBlock block_;
  CsvFile file_;
};

/// response.csv
class ResponseWriter {
 public:
  ResponseWriter(const std::filesystem::path& path, const Model& model);
  void write(double t, const std::vector<double>& values);

 private:
  CsvBlock block_;
  CsvFile file_;
};

class EnergyWriter {
 public:
  explicit EnergyWriter(const std::filesystem::path& path);
  void write(const Sample& sample);

 private:
  CsvBlock block_;
  CsvFile file_;
};

}  // namespace signorini
