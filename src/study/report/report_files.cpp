// Writes a report's files, all or none.
#include "ninebit/study/report_files.h"

#include <fmt/format.h>

#include <set>

#include "ninebit/image/staged_files.h"
#include "src/image/output/faults.h"
#include "src/study/report/report_colors.h"

namespace ninebit {
namespace {

constexpr int kLeastMapSide = 512;

// Stages the files of one report and moves them into its folder.
class ReportFolder {
 public:
  ReportFolder(std::filesystem::path folder, StagedFiles staged)
      : folder_(std::move(folder)), staged_(std::move(staged)) {}

  [[nodiscard]] Status text(const std::string& name, std::string_view content) {
    return put(name, [&](const std::filesystem::path& path) {
      posix::CheckedFile file(path);
      file.write(content.data(), content.size());
      return image_detail::close_written(file);
    });
  }

  [[nodiscard]] Status picture(const std::string& name, const Result<Image8>& image) {
    if (!image) return image.error();
    return put(name + ".png", [&](const std::filesystem::path& path) { return write_png(path, *image); });
  }

  [[nodiscard]] Result<std::vector<std::filesystem::path>> commit() {
    if (Status status = staged_.commit(); !status) return status.error();
    return staged_.files();
  }

 private:
  template <class Write>
  Status put(const std::string& name, const Write& write) {
    const std::filesystem::path final_path = folder_ / name;
    Diagnostic fault;
    if (!names_.insert(name).second) {
      fault.message = "two files of the report would have this name";
    } else if (const Status status = write(staged_.stage(name)); !status) {
      fault = status.error();
    } else {
      return {};
    }
    fault.file = final_path.string();  // not the temporary name
    return fault;
  }

  std::filesystem::path folder_;
  StagedFiles staged_;
  std::set<std::string> names_;
};

}  // namespace

Result<std::vector<std::filesystem::path>> write_report(const std::filesystem::path& folder,
                                                        const StudyQuestion& question, std::string_view version,
                                                        const StudyReport& report, std::span<const StudyRow> rows) {
  const auto page = report_html(question, version, report, rows);
  if (!page) return page.error();
  auto staged = StagedFiles::open(folder);
  if (!staged) return staged.error();
  ReportFolder files(folder, std::move(*staged));

  if (Status status = files.text("report.html", *page); !status) return status.error();
  if (Status status = files.text("rows.json", report_json(question, version, rows)); !status) return status.error();
  for (const auto& [table, text] : report_csv(rows)) {
    if (Status status = files.text(table + ".csv", text); !status) return status.error();
  }
  for (const HeatMap& map : report.heat_maps) {
    if (Status status = files.picture(map.file, picture_of(map, kLeastMapSide)); !status) return status.error();
  }
  for (const ReportPicture& picture : report.pictures) {
    if (Status status = files.picture(picture.file, picture.image); !status) return status.error();
  }
  return files.commit();
}

}  // namespace ninebit
