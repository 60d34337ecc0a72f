#include "cli/study_text.hpp"

#include "study/speed/work_files.hpp"

namespace signorini::cli {

std::string study_table(const WorkReport& report, TableStyle style) {
  WorkTable content = work_table(report);
  Table table(std::move(content.header), std::move(content.right));
  for (auto& row : content.rows) table.row(std::move(row));
  return table.str(style);
}

std::string study_text(const WorkReport& report) {
  std::string text = report.title.empty() ? "" : report.title + "\n";
  text += work_circumstances(report) + "\n" + work_reference(report) + "\n\n";
  text += study_table(report, TableStyle::plain) + "\n";
  for (const std::string& sentence : work_conclusions(report)) text += sentence + "\n";
  for (const std::string& note : report.notes) text += "  note: " + note + "\n";
  for (const std::string& failure : work_failures(report)) text += "  " + failure + "\n";
  return text;
}

}  // namespace signorini::cli
