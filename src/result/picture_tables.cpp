#include "result/picture_tables.hpp"

namespace signorini {

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

}  // namespace signorini
