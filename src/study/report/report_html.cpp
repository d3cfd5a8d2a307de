// The page: static text that is readable without its script. The script draws the plots and maps and sorts the tables.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ninebit/study/report_files.h"
#include "src/study/report/page_data.h"
#include "src/study/report/page_texts.h"
#include "src/study/report/report_text.h"
#include "src/system/hashing/openssl.h"

namespace ninebit {
namespace {

bool is_number(const StudyValue& value) {
  return !std::holds_alternative<std::string>(value) && !std::holds_alternative<std::monostate>(value);
}

std::string caption(std::string_view text) {
  return text.empty() ? "" : fmt::format("<p>{}</p>", escaped(text));
}

std::string file_line(const std::string& file) {
  return fmt::format("<p class=\"file\">{}.png</p>\n</figure>\n", escaped(file));
}

void append_table(std::string& out, const ReportTable& table);

std::string answers(const StudyReport& report) {
  const auto& sentences = report.headlines.empty() ? report.answers : report.headlines;
  if (sentences.empty()) return {};
  std::string out = "<section aria-label=\"Answers\">\n<ul class=\"answers\">\n";
  for (const std::string& answer : sentences) out += fmt::format("<li>{}</li>\n", escaped(answer));
  out += "</ul>\n";
  for (const ReportTable& table : report.summary) append_table(out, table);
  return out + "</section>\n";
}

// Command, profile, version, the question's facts about files, and hashes, which are the same on every machine.
std::string how_it_was_made(const StudyQuestion& question, std::string_view version, const StudyReport& report,
                            std::span<const StudyRow> rows) {
  std::string out = "<section class=\"made\" aria-labelledby=\"made\">\n<h2 id=\"made\">How it was made</h2>\n<dl>\n";
  const auto fact = [&](std::string_view name, std::string_view content) {
    out += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escaped(name), content);
  };
  fact("Command", fmt::format("<code>{}</code>", escaped(question.command())));
  fact("Profile", escaped(question.profile));
  fact("Version", fmt::format("ninebit {}", escaped(version)));
  for (const auto& [name, value] : question.options) {
    if (!name.starts_with('-')) fact(name, fmt::format("<span class=\"hash\">{}</span>", escaped(value)));
  }
  for (const auto& [table, text] : report_csv(report, rows)) {
    const auto is_in = [&name = table](const StudyRow& row) { return row.table == name; };
    const std::int64_t count =
        std::count_if(rows.begin(), rows.end(), is_in) + std::count_if(report.rows.begin(), report.rows.end(), is_in);
    fact(table + ".csv", fmt::format("{} {}, SHA-256 <span class=\"hash\">{}</span>", readable(count),
                                     count == 1 ? "row" : "rows", sha256(text)));
  }
  return out + "</dl>\n</section>\n";
}

struct Section {
  std::string_view id, title;
  std::string content;  // empty: the section is left out
};

std::string plots(const StudyReport& report) {
  std::string out;
  for (std::size_t i = 0; i < report.plots.size(); ++i) {
    const Plot& plot = report.plots[i];
    out += fmt::format(
        "<figure>\n<figcaption><h3>{0}</h3>{1}</figcaption>\n<div class=\"chart\"><canvas id=\"plot-{2}\" role=\"img\" "
        "aria-label=\"{0}\">{0}</canvas></div>\n</figure>\n",
        escaped(plot.title), caption(plot.caption), i);
  }
  return out;
}

// The labels along one side of a map: its ends around its name, or the coordinate of each column or row below or beside
// its name, if these are not evenly spaced.
std::string side_of_map(char side, const std::string& name, double first, double last,
                        const std::vector<double>& values) {
  const auto number = [](double value) { return fmt::format("<span>{:.6g}</span>", value); };
  const std::string title = fmt::format("<span class=\"name\">{}</span>", escaped(name));
  if (values.empty()) return fmt::format("<div class=\"{}\">{}{}{}</div>\n", side, number(first), title, number(last));
  std::string labels;
  for (const double value : values) labels += number(value);
  return fmt::format("<div class=\"{0} each\">{1}<div class=\"labels\">{2}</div></div>\n", side, title, labels);
}

std::string heat_maps(const StudyReport& report) {
  std::string out;
  for (std::size_t i = 0; i < report.heat_maps.size(); ++i) {
    const HeatMap& map = report.heat_maps[i];
    const auto end = [](double value) { return fmt::format("<span>{:.6g}</span>", value); };
    out += fmt::format("<figure id=\"map-{}\">\n<figcaption><h3>{}</h3>{}</figcaption>\n<div class=\"map\">\n", i,
                       escaped(map.title), caption(map.caption));
    out += side_of_map('y', map.y_label, map.y_first, map.y_last, map.y_values);
    out += fmt::format(
        "<div class=\"field\"><canvas tabindex=\"0\" role=\"img\" aria-label=\"{}; the arrow keys move through its "
        "values\"></canvas><div class=\"at\" hidden></div></div>\n",
        escaped(map.title));
    out += side_of_map('x', map.x_label, map.x_first, map.x_last, map.x_values) + "</div>\n";
    out +=
        "<output class=\"value\">Point at the map, or move through it with the arrow keys, to read a value.</output>\n";
    out += fmt::format("<div class=\"scale\">{}<canvas role=\"img\" aria-label=\"colour scale\"></canvas>{}</div>\n",
                       end(static_cast<double>(map.low)), end(static_cast<double>(map.high)));
    out += file_line(map.file);
  }
  return out;
}

Result<std::string> pictures(const StudyReport& report) {
  std::string out;
  for (std::size_t i = 0; i < report.pictures.size(); ++i) {
    const ReportPicture& picture = report.pictures[i];
    const auto png = encode_png(picture.image);
    if (!png) return png.error();
    out += fmt::format(
        "<figure id=\"picture-{5}\">\n<figcaption><h3>{0}</h3>{1}</figcaption>\n<img class=\"picture\" alt=\"{0}\" "
        "width=\"{2}\" height=\"{3}\" src=\"{4}\">\n",
        escaped(picture.title), caption(picture.caption), picture.image.width, picture.image.height, picture_url(*png),
        i);
    out += file_line(picture.file);
  }
  return out;
}

// "n" right-aligns a number; "kept" holds the column in view.
std::string class_attribute(bool number, bool kept) {
  if (!number && !kept) return {};
  return fmt::format(" class=\"{}{}{}\"", number ? "n" : "", number && kept ? " " : "", kept ? "kept" : "");
}

std::string cell(const StudyValue& value, bool number, bool kept) {
  const std::string classes = class_attribute(number, kept);
  if (!is_number(value)) return fmt::format("<td{}>{}</td>", classes, escaped(text_of(value)));
  const std::string exact = text_of(value), text = readable(value);
  if (exact == text) return fmt::format("<td{}>{}</td>", classes, text);
  return fmt::format("<td{0} data-v=\"{1}\" title=\"{1}\">{2}</td>", classes, exact, text);
}

void append_table(std::string& out, const ReportTable& table) {
  const auto is_kept = [&](std::size_t column) { return !table.kept.empty() && table.columns[column] == table.kept; };
  out += fmt::format(
      "<div class=\"table\">\n<h3>{0}</h3>{1}\n<div class=\"scroll\" role=\"region\" aria-label=\"{0}\" "
      "tabindex=\"0\">\n<table class=\"sorts\" aria-label=\"{0}\">\n<thead><tr>",
      escaped(table.title), caption(table.caption));
  std::vector<bool> numbers;  // columns with a number
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const bool number = std::any_of(table.rows.begin(), table.rows.end(),
                                    [c](const auto& row) { return c < row.size() && is_number(row[c]); });
    numbers.push_back(number);
    out += fmt::format("<th scope=\"col\"{} aria-sort=\"none\"><button type=\"button\">{}</button></th>",
                       class_attribute(number, is_kept(c)), escaped(table.columns[c]));
  }
  out += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) {
    out += "<tr>";
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      out += cell(c < row.size() ? row[c] : StudyValue(), numbers[c], is_kept(c));
    }
    out += "</tr>\n";
  }
  out += "</tbody>\n</table>\n</div>\n</div>\n";
}

}  // namespace

Result<std::string> report_html(const StudyQuestion& question, std::string_view version, const StudyReport& report,
                                std::span<const StudyRow> rows) {
  const auto data = page_data(report);
  if (!data) return data.error();
  const auto images = pictures(report);
  if (!images) return images.error();
  std::string tables;
  for (const ReportTable& table : report.tables) append_table(tables, table);
  const Section sections[] = {{"plots", "Plots", plots(report)},
                              {"heat-maps", "Heat maps", heat_maps(report)},
                              {"pictures", "Pictures", *images},
                              {"tables", "Tables", std::move(tables)}};

  // The policy makes browsers refuse all external resources.
  std::string page = fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline'; "
      "style-src 'unsafe-inline'; img-src data:\">\n<link rel=\"icon\" href=\"data:,\">\n<title>{0} – ninebit</title>\n"
      "<style>\n{4}{1}{3}</style>\n</head>\n<body>\n<header>\n<p class=\"kind\">ninebit study {2}</p>\n<h1>{0}</h1>\n",
      escaped(report.title), kPageStyle, escaped(question.study), kPrintStyle, kReportLook);
  page += answers(report) + how_it_was_made(question, version, report, rows) + "<nav aria-label=\"Sections\"><ul>\n";
  for (const Section& section : sections) {
    if (!section.content.empty()) page += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", section.id, section.title);
  }
  page += "</ul></nav>\n</header>\n<main>\n";
  for (const Section& section : sections) {
    if (section.content.empty()) continue;
    page += fmt::format("<section aria-labelledby=\"{0}\">\n<h2 id=\"{0}\">{1}</h2>\n{2}</section>\n", section.id,
                        section.title, section.content);
  }
  page += fmt::format("</main>\n<script type=\"application/json\" id=\"data\">{}</script>\n<script>\n", *data);
  page += kChartScript;
  page += "</script>\n<script>\n";
  for (const std::string_view script : {kValuesScript, kPlotsScript, kPageScript}) page += script;
  const auto is_judged = [](const ReportPicture& picture) { return !picture.causes.pixels.empty(); };
  if (std::any_of(report.pictures.begin(), report.pictures.end(), is_judged)) {
    page += "</script>\n<script type=\"module\">\n";
    for (const std::string_view script : {kWrongPixels, kPictureProbe, kPicturesScript}) page += script;
  }
  return page + "</script>\n</body>\n</html>\n";
}

}  // namespace ninebit
