#include "ninebit/study/shadow_sweep.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "ninebit/shadow/ground_truth.h"
#include "src/shadow/ground_truth/judge.h"
#include "src/study/part/sweep_axes.h"
#include "src/study/shadows/shadow_sweep_report.h"
#include "src/study/shadows/wrong_pixel_traces.h"
#include "src/system/hashing/openssl.h"
#include "src/system/quoting.h"

namespace ninebit {
namespace {

constexpr std::array kFactors{0.0F, 0.5F, 1.0F, 1.125F, 1.5F, 2.0F, 4.0F};
constexpr std::array kUnits{0.0F, 1.0F, 16.0F, 64.0F, 256.0F, 1024.0F, 4096.0F, 16384.0F, 65536.0F};

constexpr std::array<OffsetArguments, kFactors.size() * kUnits.size()> search_grid() {
  std::array<OffsetArguments, kFactors.size() * kUnits.size()> grid{};
  for (std::size_t i = 0; i < grid.size(); ++i) grid[i] = {kFactors[i / kUnits.size()], kUnits[i % kUnits.size()]};
  return grid;
}
constexpr auto kOffsets = search_grid();

// The hash of the triangles, independent of the scene's file format.
std::string hash_of(const Scene& scene) {
  Sha256 hash;
  hash.add(scene.positions);
  hash.add(scene.triangles);
  hash.add(scene.triangle_object);
  return hash.finish();
}

constexpr double kLongestReason = 65536.0;

// A drawn point, compared with the ground truth.
struct Judged {
  Rendering rendering;
  GroundTruth truth;
};

class ShadowSweep final : public Study {
 public:
  ShadowSweep(StudyQuestion question, Scene scene, const Technique& technique, const RenderSettings& settings,
              SweptSettings known, TraceTexts traces, bool allow_outside)
      : question_(std::move(question)),
        scene_(std::move(scene)),
        technique_(technique),
        settings_(settings),
        known_(std::move(known)),
        traces_(std::move(traces)),
        allow_outside_(allow_outside) {
    settings_.evidence = true;
    question_.options.emplace_back("sha256 of the triangles", hash_of(scene_));
  }

  // The part of construction that can fail.
  Status prepare(const ShadowGrid& grid) {
    auto axes = axes_of(known_, grid);
    if (!axes) return axes.error();
    axes_ = std::move(axes).value();
    for (const ShadowAxis& axis : grid) texts_.push_back(axis.values);
    std::size_t points = 1;
    for (const SweepAxis& axis : axes_) {
      if (axis.values.size() > kMaxStudyUnits / points) {
        return Diagnostic{
            .message = fmt::format("the lists have more than {} combinations; expected fewer values", kMaxStudyUnits)};
      }
      points *= axis.values.size();
    }
    auto truth = GroundTruthScene::make(scene_);
    if (!truth) return truth.error();
    truth_.emplace(std::move(truth).value());
    return {};
  }

  [[nodiscard]] const StudyQuestion& question() const override { return question_; }
  [[nodiscard]] std::size_t units() const override {
    std::size_t points = 1;
    for (const SweepAxis& axis : axes_) points *= axis.values.size();
    return points;
  }

  [[nodiscard]] std::string unit_name(std::size_t unit) const override {
    std::vector<std::string> words;
    for (const auto& [name, value] : settings_fields(known_, settings_at(unit), nullptr)) {
      if (!std::holds_alternative<std::monostate>(value)) words.push_back(fmt::format("{} {}", name, text_of(value)));
    }
    return words.empty() ? std::string(technique_.name) : fmt::format("{}", fmt::join(words, ", "));
  }

  [[nodiscard]] Result<std::vector<StudyRow>> run(std::size_t unit, const GoOn& go_on) const override {
    const auto judged = judge(unit, go_on);
    if (!judged && judged.error().fault != Fault::invalid_input) return judged.error();
    return std::vector{row_of(unit, judged)};
  }

  [[nodiscard]] std::vector<RowRule> row_rules(std::size_t unit) const override {
    RowRule rule{.fields = {exactly("point", std::uint64_t{unit}), exactly("technique", std::string(technique_.name))}};
    for (auto& [name, value] : settings_fields(known_, settings_at(unit), nullptr)) {
      // The rendering chooses a setting without a value.
      const bool chosen = std::holds_alternative<std::monostate>(value);
      constexpr double kMost = std::numeric_limits<float>::max();
      rule.fields.push_back(chosen ? or_nothing(real_in(name, -kMost, kMost)) : exactly(name, std::move(value)));
    }
    const double pixels = static_cast<double>(settings_.width) * settings_.height;
    const auto add_count = [&](std::string name) {
      rule.fields.push_back(or_nothing(count_up_to(std::move(name), pixels)));
    };
    for (const char* name : {"lit", "shadowed", "false_lit", "false_shadowed", "wrong"}) add_count(name);
    rule.fields.push_back(or_nothing(real_in("wrong_share", 0.0, 1.0)));
    for (const ErrorCause cause : causes_of(known_)) add_count(std::string(name_of(cause)));
    if (known_.has_column("index-order"))
      rule.fields.push_back(or_nothing(text_up_to("index_order_reason", kLongestReason)));
    rule.fields.push_back(or_nothing(text_up_to("refused", kLongestReason)));
    return {rule};
  }

  [[nodiscard]] Result<StudyReport> report(std::span<const StudyRow> rows, std::size_t done) const override {
    if (best_row(rows) == nullptr && !rows.empty()) {
      return Diagnostic{.message = fmt::format("no point can be drawn: {}", rows.front().text("refused"))};
    }
    StudyReport report = shadow_sweep_report(known_, axes_, rows, done, units());
    for (const auto& [name, unit] : shown_points(rows)) {
      const auto judged = judge(unit, {});
      if (!judged) return judged.error();
      auto traces = add_traces(name, unit, judged->truth, report);
      report.pictures.push_back({.file = fmt::format("error-{}", name),
                                 .title = fmt::format("The {} point: {}", name, unit_name(unit)),
                                 .image = error_picture(judged->rendering, judged->truth),
                                 .caption = "Orange: lit, and should be in shadow. Blue: the reverse.",
                                 .causes = cause_plane(judged->truth, settings_.width, settings_.height),
                                 .traces = std::move(traces)});
    }
    return report;
  }

  [[nodiscard]] Status draw(std::span<const StudyRow> rows, const DrawProgress& progress,
                            StudyReport& report) const override {
    if (!traces_) return {};
    const auto shown = shown_points(rows);
    for (std::size_t i = 0; i < shown.size(); ++i) {
      std::vector<PictureTrace>& traces = report.pictures[i].traces;
      if (traces.empty()) continue;
      const Progress step = [&](std::string_view, double done) {
        return !progress || progress((static_cast<double>(i) + done) / static_cast<double>(shown.size()));
      };
      if (!step("", 0.0)) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
      RenderSettings settings = settings_at(shown[i].second);
      for (const PictureTrace& one : traces) settings.pixels.emplace_back(one.x, settings.height - 1 - one.y);
      auto texts = traces_(settings, step);
      if (!texts) return texts.error();
      if (texts->size() != traces.size()) {
        return Diagnostic{.message = "there are " + std::to_string(texts->size()) + " texts of " +
                                     std::to_string(traces.size()) + " traced pixels"};
      }
      for (std::size_t t = 0; t < traces.size(); ++t) traces[t].text = std::move((*texts)[t]);
    }
    return {};
  }

 private:
  // The points whose pictures the report shows, in its order, with their names there.
  [[nodiscard]] static std::vector<std::pair<std::string_view, std::size_t>> shown_points(
      std::span<const StudyRow> rows) {
    std::vector<std::pair<std::string_view, std::size_t>> shown;
    for (const auto& [name, row] : {std::pair{"best", best_row(rows)}, std::pair{"worst", worst_row(rows)}}) {
      if (row == nullptr) continue;
      const std::size_t unit = row->count("point");
      if (shown.empty() || shown[0].second != unit) shown.emplace_back(name, unit);
    }
    return shown;
  }

  [[nodiscard]] RenderSettings settings_at(std::size_t unit) const {
    RenderSettings settings = settings_;
    for (auto axis = axes_.rbegin(); axis != axes_.rend(); ++axis) {
      axis->setting->set(settings, axis->values[unit % axis->values.size()]);
      unit /= axis->values.size();
    }
    return settings;
  }

  // `ninebit trace` of a pixel of a point, but for the pixel.
  [[nodiscard]] std::string trace_command(std::size_t unit) const {
    std::string command = fmt::format("ninebit trace --scene {}", shell_word(question_.arguments));
    if (allow_outside_) command += " --allow-outside";
    for (const auto& [flag, value] : question_.options) {
      const auto settings = technique_settings();
      const bool is_axis = flag == "--find-offset" ||
                           std::any_of(settings.begin(), settings.end(), [&flag = flag](const TechniqueSetting& s) {
                             return !s.axis.flag.empty() && flag == fmt::format("--{}", s.axis.flag);
                           });
      if (!flag.starts_with('-') || is_axis) continue;
      command += ' ' + flag;
      if (!value.empty()) command += ' ' + shell_word(value);
    }
    command += " --profile " + shell_word(question_.profile);
    std::string chosen;
    for (std::size_t a = axes_.size(); a-- > 0;) {
      const std::string& text = texts_[a][unit % texts_[a].size()];
      unit /= texts_[a].size();
      chosen.insert(0, fmt::format(" --{} {}", axes_[a].setting->name, shell_word(text)));
    }
    return command + chosen;
  }

  // Adds the wrong pixels of a point that are worth a look, with the commands that explain them, and returns these. A
  // scene without a file has none.
  std::vector<PictureTrace> add_traces(std::string_view name, std::size_t unit, const GroundTruth& truth,
                                       StudyReport& report) const {
    if (question_.arguments.empty()) return {};
    const auto worst = worst_traces(truth, settings_.width, settings_.height, trace_command(unit));
    if (worst.empty()) return {};
    for (const WrongPixelTrace& one : worst) {
      StudyRow row{.table = "worst", .fields = {{"point", std::uint64_t{unit}}}};
      for (auto& field : fields_of(one)) row.fields.push_back(std::move(field));
      report.rows.push_back(std::move(row));
    }
    ReportTable table{
        .title = fmt::format("Wrong pixels of the {} point", name), .columns = {"cause", "pixel", "why"}, .rows = {}};
    table.caption = "The middle of the largest patch of each cause; the command says why that pixel is wrong.";
    for (const WrongPixelTrace& one : first_of_causes(worst)) {
      const std::string cause(name_of(one.pixel.cause));
      table.rows.push_back({cause, fmt::format("{},{}", one.x, one.y), one.command});
      report.answers.push_back(fmt::format("A wrong pixel of the {} point, {}: {}", name, cause, one.command));
    }
    report.tables.push_back(std::move(table));
    return {worst.begin(), worst.end()};
  }

  [[nodiscard]] Result<Judged> judge(std::size_t unit, const GoOn& go_on) const {
    const RenderSettings settings = settings_at(unit);
    const Progress progress = [&](std::string_view, double) { return !go_on || go_on(); };
    auto rendering = technique_.render(scene_, settings, progress);
    if (!rendering) return rendering.error();
    auto truth = measure(*truth_, settings, *rendering, progress);
    if (!truth) return truth.error();
    return Judged{std::move(rendering).value(), std::move(truth).value()};
  }

  [[nodiscard]] StudyRow row_of(std::size_t unit, const Result<Judged>& judged) const {
    const Rendering* rendering = judged ? &judged->rendering : nullptr;
    StudyRow row{.fields = {{"point", std::uint64_t{unit}}, {"technique", std::string(technique_.name)}}};
    const auto count = [&](std::string name, auto of) {
      row.fields.emplace_back(std::move(name), judged ? StudyValue(of(*judged)) : StudyValue());
    };
    for (auto& field : settings_fields(known_, settings_at(unit), rendering)) row.fields.push_back(std::move(field));
    count("lit", [](const Judged& j) { return j.rendering.lit; });
    count("shadowed", [](const Judged& j) { return j.rendering.shadowed; });
    count("false_lit", [](const Judged& j) { return j.truth.false_lit; });
    count("false_shadowed", [](const Judged& j) { return j.truth.false_shadowed; });
    count("wrong", [](const Judged& j) { return j.truth.false_lit + j.truth.false_shadowed; });
    // The share of the pixels that show the scene.
    count("wrong_share", [](const Judged& j) {
      const std::uint64_t pixels = j.rendering.lit + j.rendering.shadowed;
      const std::uint64_t wrong = j.truth.false_lit + j.truth.false_shadowed;
      return pixels == 0 ? 0.0 : static_cast<double>(wrong) / static_cast<double>(pixels);
    });
    for (const ErrorCause cause : causes_of(known_)) {
      count(std::string(name_of(cause)),
            [&](const Judged& j) { return j.truth.by_cause[static_cast<std::size_t>(cause)]; });
    }
    if (known_.has_column("index-order")) {
      const std::string reason = judged ? rendering->index_order.reason : "";
      row.fields.emplace_back("index_order_reason", reason.empty() ? StudyValue() : StudyValue(reason));
    }
    row.fields.emplace_back("refused", judged ? StudyValue() : StudyValue(judged.error().message));
    return row;
  }

  StudyQuestion question_;
  Scene scene_;
  const Technique& technique_;
  RenderSettings settings_;
  SweptSettings known_;
  std::vector<SweepAxis> axes_;
  std::vector<std::vector<std::string>> texts_;  // the axes' values as in flags
  TraceTexts traces_;
  bool allow_outside_;
  std::optional<GroundTruthScene> truth_;
};

}  // namespace

std::span<const OffsetArguments> offsets_to_search() {
  return kOffsets;
}

Result<std::unique_ptr<Study>> make_shadow_sweep(StudyQuestion question, Scene scene, const Technique& technique,
                                                 const RenderSettings& settings, const ShadowGrid& grid,
                                                 TraceTexts traces, bool allow_outside) {
  const auto known = swept_settings(technique, settings, grid);
  if (!known) return known.error();
  auto sweep = std::make_unique<ShadowSweep>(std::move(question), std::move(scene), technique, settings, *known,
                                             std::move(traces), allow_outside);
  if (Status prepared = sweep->prepare(grid); !prepared) return prepared.error();
  return std::unique_ptr<Study>(std::move(sweep));
}

}  // namespace ninebit
