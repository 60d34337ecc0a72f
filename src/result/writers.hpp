// writers.hpp: the tables of a run, row by row as they come (docs/output.md).
//
//   events.csv t,contact,event,from,to,gap,N,T,N_after,T_after,vn,vn_after,vt,vt_after,impulse_n,impulse_t,
//                 guard_rate,t_uncertainty
//   contacts.csv  t,contact,state,gap,ut,vt,slip,N,T        one row a time and contact
//   history.csv   t, then the model's columns
//   energy.csv    t,kinetic,elastic,contact,damping,friction,impact,loads,surface,balance
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
  const Model& model_;
  CsvBlock block_;
  CsvFile file_;
};

class ContactWriter {
 public:
  ContactWriter(const std::filesystem::path& path, const Model& model);
  void write(const Sample& sample);

 private:
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

class EnergyWriter {
 public:
  explicit EnergyWriter(const std::filesystem::path& path);
  void write(const Sample& sample);

 private:
  CsvBlock block_;
  CsvFile file_;
};

}  // namespace signorini
