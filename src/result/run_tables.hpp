// run_tables.hpp: the tables of a run (docs/output.md), as lists of columns.
//
//   events.csv    the columns of signorini/event.hpp
//   contacts.csv  t,contact,state,gap,ut,vt,slip,N,T,ratio  one row per time and contact
//   motion.csv    columns of contacts.csv; all rows of the first contact, then of the second, ...
//   history.csv   t, then the model's columns
//   response.csv  t, then the model's outputs
//   energy.csv    t, the columns of signorini/result.hpp, balance
//   curves.csv    curve,t,value
//   frames.csv, frame_contacts.csv                           deformed shapes, and the contacts in them
//
// Writers and pictures use these columns by name. A table that depends on a model must not outlive the model.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "result/table.hpp"
#include "signorini/result.hpp"
#include "signorini/scene.hpp"

namespace signorini::result {

/// Columns of events.csv.
[[nodiscard]] CsvTable<Event> event_table(const Model& model);

/// A contact at one time. Units: length, length/time, force.
struct ContactRow {
  double t;
  const Contact& contact;
  const ContactSample& sample;
};
/// |T| / |N|; nullopt without friction, for an open contact, and for N = 0.
[[nodiscard]] std::optional<double> friction_ratio(const Contact& contact, const ContactSample& sample);
/// Columns of contacts.csv and motion.csv.
[[nodiscard]] const CsvTable<ContactRow>& contact_table();

/// Columns of history.csv.
[[nodiscard]] CsvTable<Sample> history_table(const Model& model);

struct ResponseRow {
  double t;
  const std::vector<double>& values;  ///< one per output
};
/// Columns of response.csv.
[[nodiscard]] CsvTable<ResponseRow> response_table(const Model& model);

/// Columns of energy.csv.
[[nodiscard]] const CsvTable<Sample>& energy_table();

struct CurveRow {
  const std::string& curve;
  const CurvePoint& point;
};
/// Columns of curves.csv.
[[nodiscard]] const CsvTable<CurveRow>& curve_table();

/// A node of an element (`element` is its number, from 1), or a named node without element.
struct FrameRow {
  double t;
  const char* kind;
  std::optional<int> element;
  const DrawnNode& node;
  const Vector& u;
};
/// Columns of frames.csv.
[[nodiscard]] const CsvTable<FrameRow>& frame_table();

/// A contact at its node. Its columns x and y are the drawn position, undeformed.
struct FrameContactRow {
  double t;
  const Contact& contact;
  const DrawnContact& drawn;
  const DrawnNode& node;
  const ContactSample& sample;
  const Vector& u;
};
/// Columns of frame_contacts.csv.
[[nodiscard]] const CsvTable<FrameContactRow>& frame_contact_table();

// seams.csv: the resultants of seams at the output times.
//
//   N = sum N_k,   T = sum T_k,   moment = sum (x_k - x_m) x (-N_k n_k - T_k t_k),   x_m = sum D_k x_k / sum D_k
//   stick, slip, open: sums of D_k, the length of seam node k, over the contacts in this state
//
// Forces act on the slave. Units: force, force * length, length. Positions are undeformed.

struct SeamRow {
  double t = 0.0;
  std::string seam;
  double N = 0.0, T = 0.0, moment = 0.0;
  double stick = 0.0, slip = 0.0, open = 0.0;
};

/// Columns of seams.csv.
[[nodiscard]] const CsvTable<SeamRow>& seam_table();
/// Resultants of a seam. contacts: one sample per contact of the scene.
[[nodiscard]] SeamRow seam_row(const SeamSpec& seam, double t, const std::vector<ContactSample>& contacts);

}  // namespace signorini::result
