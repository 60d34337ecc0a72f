// run_tables.hpp: the tables of a run (docs/output.md), as lists of columns.
//
//   events.csv    the columns of signorini/event.hpp
//   contacts.csv  t,contact,state,gap,ut,vt,slip,N,T,ratio  one row per time and contact
//   motion.csv    the same, contact by contact
//   history.csv   t, then the model's columns
//   response.csv  t, then the model's outputs
//   energy.csv    t, the columns of signorini/result.hpp, balance
//   curves.csv    curve,t,value
//   frames.csv, frame_contacts.csv                           deformed shapes, and the contacts in them
//
// Writers and pictures use these columns, by name. A model is kept by reference.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "result/table.hpp"
#include "signorini/result.hpp"
#include "signorini/scene.hpp"

namespace signorini::result {

[[nodiscard]] CsvTable<Event> event_table(const Model& model);

/// Units: length, length/time, force.
struct ContactRow {
  double t;
  const Contact& contact;
  const ContactSample& sample;
};
/// |T| / |N|; nullopt without friction, for an open contact, and for N = 0.
[[nodiscard]] std::optional<double> friction_ratio(const Contact& contact, const ContactSample& sample);
/// Columns of contacts.csv and motion.csv.
[[nodiscard]] const CsvTable<ContactRow>& contact_table();

[[nodiscard]] CsvTable<Sample> history_table(const Model& model);

struct ResponseRow {
  double t;
  const std::vector<double>& values;  ///< one per output
};
[[nodiscard]] CsvTable<ResponseRow> response_table(const Model& model);

[[nodiscard]] const CsvTable<Sample>& energy_table();

struct CurveRow {
  const std::string& curve;
  const CurvePoint& point;
};
[[nodiscard]] const CsvTable<CurveRow>& curve_table();

/// A node of an element (`element` from 1), or a node of its own.
struct FrameRow {
  double t;
  const char* kind;
  std::optional<int> element;
  const DrawnNode& node;
  const Vector& u;
};
[[nodiscard]] const CsvTable<FrameRow>& frame_table();

/// A contact at its node; x, y: drawn position, undeformed.
struct FrameContactRow {
  double t;
  const Contact& contact;
  const DrawnContact& drawn;
  const DrawnNode& node;
  const ContactSample& sample;
  const Vector& u;
};
[[nodiscard]] const CsvTable<FrameContactRow>& frame_contact_table();

// Seams.csv, the resultants of seams at the output times.
//
//   N = sum N_k,   T = sum T_k,   moment = sum (x_k - x_m) x (-N_k n_k - T_k t_k),   x_m = sum D_k x_k / sum D_k
//   stick, slip, open: sums of D_k
//
// Forces act on the slave; units: force, force * length, length. Positions are undeformed.

struct SeamRow {
  double t = 0.0;
  std::string seam;
  double N = 0.0, T = 0.0, moment = 0.0;
  double stick = 0.0, slip = 0.0, open = 0.0;
};

[[nodiscard]] const CsvTable<SeamRow>& seam_table();
/// contacts: one per contact of the scene.
[[nodiscard]] SeamRow seam_row(const SeamSpec& seam, double t, const std::vector<ContactSample>& contacts);

}  // namespace signorini::result
