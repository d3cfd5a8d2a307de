#include "src/study/part/joined_study.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace ninebit {
namespace {

class JoinedStudy final : public Study {
 public:
  JoinedStudy(StudyQuestion question, std::vector<ProfileStudy> studies)
      : question_(std::move(question)), studies_(std::move(studies)) {}

  [[nodiscard]] const StudyQuestion& question() const override { return question_; }
  [[nodiscard]] std::size_t units() const override {
    std::size_t all = 0;
    for (const ProfileStudy& one : studies_) all += one.study->units();
    return all;
  }
  [[nodiscard]] std::string unit_name(std::size_t unit) const override {
    const Study& study = study_of(unit);
    return study.unit_name(unit);
  }
  [[nodiscard]] double weight(std::size_t unit) const override {
    const Study& study = study_of(unit);
    return study.weight(unit);
  }
  [[nodiscard]] Result<std::vector<StudyRow>> run(std::size_t unit, const GoOn& go_on) const override {
    const Study& study = study_of(unit);
    return study.run(unit, go_on);
  }
  [[nodiscard]] std::vector<RowRule> row_rules(std::size_t unit) const override {
    const Study& study = study_of(unit);
    return study.row_rules(unit);
  }

  [[nodiscard]] Result<StudyReport> report(std::span<const StudyRow> rows, std::size_t done) const override {
    StudyReport all;
    std::vector<Plot> shared;
    bool first = true;
    for (const ProfileStudy& one : studies_) {
      const std::vector<StudyRow> own = rows_about(one.profile, rows);
      const std::size_t own_done = std::min(done, one.study->units());
      done -= own_done;
      if (own.empty()) continue;
      auto report = one.study->report(own, own_done);
      if (!report) return report;
      all.title = report->title;
      if (first) shared = report->plots;
      share(one.profile, first, report->plots, shared);
      first = false;
      append(one.profile, std::move(*report), all);
    }
    const auto empty = [](const Plot& plot) { return plot.series.empty(); };
    shared.erase(std::remove_if(shared.begin(), shared.end(), empty), shared.end());
    if (studies_.size() > 1) all.plots.insert(all.plots.begin(), shared.begin(), shared.end());
    return all;
  }

  [[nodiscard]] Status draw(std::span<const StudyRow> rows, const DrawProgress& progress,
                            StudyReport& report) const override {
    double before = 0.0;
    for (const ProfileStudy& one : studies_) {
      const auto all = static_cast<double>(studies_.size());
      const auto share = [&](double done) { return !progress || progress((before + done) / all); };
      StudyReport drawn;
      if (Status status = one.study->draw(rows_about(one.profile, rows), share, drawn); !status) return status;
      append(one.profile, std::move(drawn), report);
      before += 1.0;
    }
    return {};
  }

 private:
  static std::vector<StudyRow> rows_about(const std::string& profile, std::span<const StudyRow> rows) {
    std::vector<StudyRow> own;
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(own),
                 [&](const StudyRow& row) { return row.text("profile") == profile; });
    return own;
  }

  // The study of a unit, whose number becomes that within the study.
  [[nodiscard]] const Study& study_of(std::size_t& unit) const {
    auto one = studies_.begin();
    for (; unit >= one->study->units(); ++one) unit -= one->study->units();
    return *one->study;
  }

  // Adds a profile's series to the plots of all profiles. Keeps only plots that every profile has over the same axis,
  // and only series that are not 0 everywhere.
  static void share(const std::string& profile, bool first, const std::vector<Plot>& plots, std::vector<Plot>& shared) {
    const auto is_zero = [](const PlotSeries& series) {
      return std::all_of(series.points.begin(), series.points.end(),
                         [](const auto& point) { return point.second == 0; });
    };
    for (auto to = shared.begin(); to != shared.end();) {
      const auto from = std::find_if(plots.begin(), plots.end(), [&](const Plot& one) { return one.file == to->file; });
      if (from == plots.end() || from->x_names != to->x_names) {
        to = shared.erase(to);
        continue;
      }
      if (first) {
        to->title += ", by profile";
        to->series.clear();
      }
      for (const PlotSeries& series : from->series) {
        if (!is_zero(series)) to->series.push_back({profile + ", " + series.name, series.points});
      }
      ++to;
    }
  }

  static void append(const std::string& profile, StudyReport&& report, StudyReport& all) {
    const auto add = [](auto& from, auto& to, const auto& name) {
      for (auto& one : from) {
        name(one);
        to.push_back(std::move(one));
      }
    };
    const auto sentence = [&](std::string& text) { text.insert(0, profile + ", "); };
    const auto titled = [&](auto& part) { part.title += ", " + profile; };
    const auto with_file = [&](auto& part) {
      titled(part);
      part.file.insert(0, profile + '-');
    };
    add(report.rows, all.rows, [&](StudyRow& row) { row.fields.insert(row.fields.begin(), {"profile", profile}); });
    add(report.answers, all.answers, sentence);
    add(report.headlines, all.headlines, sentence);
    add(report.summary, all.summary, titled);
    add(report.tables, all.tables, titled);
    add(report.plots, all.plots, with_file);
    add(report.heat_maps, all.heat_maps, with_file);
    add(report.pictures, all.pictures, with_file);
    add(report.files, all.files, [&](ReportFile& file) { file.name.insert(0, profile + '-'); });
  }

  StudyQuestion question_;
  std::vector<ProfileStudy> studies_;
};

}  // namespace

std::unique_ptr<Study> joined_study(StudyQuestion question, std::vector<ProfileStudy> studies) {
  return std::make_unique<JoinedStudy>(std::move(question), std::move(studies));
}

}  // namespace ninebit
