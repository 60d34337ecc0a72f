#include "result/picture_tables.hpp"

#include <algorithm>
#include <vector>

#include "result/csv.hpp"

namespace signorini::result {

void PictureTables::motion(int contact, const std::vector<MotionRow>& rows) {
  if (!motion_) motion_ = std::make_unique<TableFile<ContactRow>>(directory_ / "motion.csv", contact_table());
  const Contact& of = model_.contacts[static_cast<std::size_t>(contact)];
  for (const MotionRow& row : rows) motion_->add({row.t, of, row.sample});
  motion_->flush();
}

void PictureTables::curves(const Curves& curves) {
  TableFile<CurveRow> file(directory_ / "curves.csv", curve_table());
  for (std::size_t i = 0; i < curves.names.size(); ++i)
    for (const CurvePoint& point : curves.points[i]) file.add({curves.names[i], point});
  file.flush();
}

namespace {

constexpr int pieces = 1200;                    // intervals of the time axis, about one per pixel
constexpr std::size_t max_breakpoints = 10000;  // limit; a picture cannot show more

/// Sign of a load: the acceleration a of the base acts as the load -M r a.
double sign_of(const Load& load) { return load.kind == LoadKind::base ? -1.0 : 1.0; }

}  // namespace

std::string load_table(const Model& model, double t_end) {
  std::vector<const Load*> loads;
  std::vector<double> breaks, times;
  for (const Load& load : model.loads) {
    if (load.history.is_constant()) continue;
    loads.push_back(&load);
    for (const Breakpoint& b : load.history.breakpoints())
      if (b.time > 0.0 && b.time < t_end && breaks.size() < max_breakpoints) breaks.push_back(b.time);
  }
  if (loads.empty() || !(t_end > 0.0)) return "";
  times = breaks;
  for (int i = 0; i <= pieces; ++i) times.push_back(t_end * i / static_cast<double>(pieces));
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  std::sort(breaks.begin(), breaks.end());

  CsvBlock block;
  block.text("t");
  for (const Load* load : loads) block.text(load->name);
  block.end_row();
  const auto row = [&](double t, bool before) {
    block.number(t);
    for (const Load* load : loads) {
      const Piece& piece = before ? load->history.piece_before(t) : load->history.piece(t);
      block.number(sign_of(*load) * piece.value(t));
    }
    block.end_row();
  };
  for (const double t : times) {
    if (std::binary_search(breaks.begin(), breaks.end(), t)) row(t, true);
    row(t, false);
  }
  return block.str();
}

}  // namespace signorini::result
