// Writes a report's files, all or none.
#include "ninebit/study/report_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "ninebit/image/staged_files.h"
#include "src/image/output/faults.h"
#include "src/study/part/part_text.h"
#include "src/study/report/report_colors.h"
#include "src/study/report/report_svg.h"

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
  if (Status status = files.text("rows.json", report_json(question, version, report, rows)); !status)
    return status.error();
  for (const auto& [table, text] : report_csv(report, rows)) {
    if (Status status = files.text(table + ".csv", text); !status) return status.error();
  }
  for (const Plot& plot : report.plots) {
    if (Status status = files.text(plot.file + ".svg", svg_of(plot)); !status) return status.error();
  }
  for (const HeatMap& map : report.heat_maps) {
    if (Status status = files.picture(map.file, picture_of(map, kLeastMapSide)); !status) return status.error();
    const auto svg = svg_of(map);
    if (!svg) return svg.error();
    if (Status status = files.text(map.file + ".svg", *svg); !status) return status.error();
  }
  for (const ReportPicture& picture : report.pictures) {
    if (Status status = files.picture(picture.file, picture.image); !status) return status.error();
  }
  for (const ReportFile& file : report.files) {
    if (Status status = files.text(file.name, file.content); !status) return status.error();
  }
  return files.commit();
}

// Rows, and their machine-readable forms: JSON and CSV.

namespace {

using Json = nlohmann::ordered_json;

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

// RFC 4180: a field with a comma, a quotation mark or a line break is quoted, and its quotation marks are doubled.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

constexpr std::string_view kEndOfLine = "\r\n";  // required by RFC 4180

std::string csv_header(const StudyRow& row) {
  std::string line;
  for (const auto& [name, value] : row.fields) {
    if (!line.empty()) line += ',';
    line += csv_field(name);
  }
  return line += kEndOfLine;
}

void append_csv_line(std::string& out, const StudyRow& row) {
  bool first = true;
  for (const auto& [name, value] : row.fields) {
    if (!first) out += ',';
    out += csv_field(text_of(value));
    first = false;
  }
  out += kEndOfLine;
}

}  // namespace

std::string text_of(const StudyValue& value) {
  return std::visit(
      Overloaded{[](std::monostate) { return std::string(); }, [](const std::string& text) { return text; },
                 [](const auto& number) { return fmt::format("{}", number); }},
      value);
}

const StudyValue& StudyRow::operator[](std::string_view name) const {
  static const StudyValue nothing;
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const auto& field) { return field.first == name; });
  return found == fields.end() ? nothing : found->second;
}

double StudyRow::number(std::string_view name) const {
  return std::visit(Overloaded{[](std::monostate) { return 0.0; }, [](const std::string&) { return 0.0; },
                               [](const auto& number) { return static_cast<double>(number); }},
                    (*this)[name]);
}

std::uint64_t StudyRow::count(std::string_view name) const {
  const StudyValue& value = (*this)[name];
  if (const auto* whole = std::get_if<std::uint64_t>(&value)) return *whole;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return *whole > 0 ? static_cast<std::uint64_t>(*whole) : 0;
  const double real = number(name);
  if (!(real > 0.0)) return 0;
  constexpr double kBeyond = 18446744073709551616.0;  // 2^64
  return real < kBeyond ? static_cast<std::uint64_t>(real) : std::numeric_limits<std::uint64_t>::max();
}

std::string StudyRow::text(std::string_view name) const {
  return text_of((*this)[name]);
}

std::string report_json(const StudyQuestion& question, std::string_view version, const StudyReport& report,
                        std::span<const StudyRow> rows) {
  Json out{{"command", "study " + question.study},
           {"version", version},
           {"profile", question.profile},
           {"question", question.command()},
           {"rows", Json::array()}};
  for (const std::span<const StudyRow> part : {rows, std::span(report.rows)}) {
    for (const StudyRow& row : part) {
      Json object = Json::object();
      for (const auto& [name, value] : row.fields) object[name] = json_value(value);
      out[row.table].push_back(std::move(object));
    }
  }
  // A file name may not be UTF-8; invalid bytes become the replacement character.
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<std::pair<std::string, std::string>> report_csv(const StudyReport& report, std::span<const StudyRow> rows) {
  std::vector<std::pair<std::string, std::string>> tables;
  for (const std::span<const StudyRow> part : {rows, std::span(report.rows)}) {
    for (const StudyRow& row : part) {
      auto table = std::find_if(tables.begin(), tables.end(), [&](const auto& t) { return t.first == row.table; });
      if (table == tables.end()) table = tables.insert(tables.end(), {row.table, csv_header(row)});
      append_csv_line(table->second, row);
    }
  }
  return tables;
}

}  // namespace ninebit
