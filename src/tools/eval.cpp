// `ninebit eval`: evaluates a program on each row of a table of register codes.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "ninebit/combiner/normalize.h"
#include "src/system/process.h"
#include "src/system/stream.h"
#include "src/tools/common/output_file.h"
#include "src/tools/common/program_file.h"
#include "src/tools/eval/eval_engine.h"
#include "src/tools/eval/eval_pictures.h"
#include "src/tools/eval/eval_stages.h"
#include "src/tools/input/printable.h"

namespace ninebit::tools {
namespace {

struct EvalFlags {
  CommonFlags common;
  ProgramFlags program;
  std::string inputs;
  std::string output;
  bool registers = false;
  std::string engine = "simd";
  bool engine_given = false;  // on the command line
  UnitPictures textures{};
  std::vector<std::string> set;
};

// Writes the results as CSV or as the rows of the JSON answer.
class Writer {
 public:
  Writer(const EvalFlags& flags, const HardwareProfile& profile, OutputFile& to) : to_(&to) {
    json_ = flags.common.json && flags.output.empty();
    for (const char c : std::string_view("rgba")) names_.push_back(std::string("out.") + c);
    if (flags.registers) {
      columns_ = eval_columns(profile);
      for (const EvalColumn& column : columns_) names_.push_back(column.name());
    }
    if (json_) {
      const Json head{{"command", "eval"}, {"version", NINEBIT_VERSION}, {"profile", flags.common.profile}};
      text_ = head.dump();
      text_.pop_back();
      text_ += ",\"rows\":[";
      for (std::string& name : names_) name = '"' + name + "\":";
    } else {
      text_ = fmt::format("{}\n", fmt::join(names_, ","));
    }
  }

  void add(const EvalBatch& batch) {
    for (std::size_t row = 0; row < batch.count; ++row) {
      if (json_) text_ += first_row_ ? "\n{" : ",\n{";
      first_row_ = false;
      std::size_t k = 0;
      for (; k < 4; ++k) put(k, batch.out.plane[k][row]);
      for (const EvalColumn& column : columns_) put(k++, batch.registers(column.reg, column.component)[row]);
      text_ += json_ ? '}' : '\n';
    }
  }

  Status flush(bool all) {
    constexpr std::size_t kPiece = std::size_t{1} << 16;
    if (!all && text_.size() < kPiece) return {};
    Status status = to_->write(text_);
    text_.clear();
    return status;
  }

  Status finish() {
    if (json_) text_ += "\n]}\n";
    if (Status status = flush(true); !status) return status;
    return to_->finish();
  }

 private:
  void put(std::size_t k, int code) {
    if (k > 0) text_ += ',';
    if (json_) text_ += names_[k];
    std::array<char, 8> digits{};
    const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), code);
    text_.append(digits.data(), end);
  }

  OutputFile* to_;
  bool json_ = false;
  bool first_row_ = true;
  std::vector<EvalColumn> columns_;
  std::vector<std::string> names_;  // of all columns; for JSON, quoted and with a colon
  std::string text_;
};

// Reads, evaluates and writes batch by batch; returns the number of rows.
Result<std::size_t> stream(CsvLines& lines, const EvalRows& rows, EvalRunner& runner, Writer& writer,
                           ProgressLine& progress) {
  const auto batch = std::make_unique<EvalBatch>();
  std::size_t total = 0;
  for (std::size_t batches = 0;; ++batches) {
    rows.begin(*batch);
    while (batch->count < kBatchSize) {
      auto line = lines.next();
      if (!line) return line.error();
      if (!*line) break;
      if (Status added = rows.add(**line, lines.name(), *batch); !added) return added.error();
    }
    rows.end(*batch);
    runner.run(*batch);
    writer.add(*batch);
    if (Status written = writer.flush(false); !written) return written.error();
    total += batch->count;
    if (batch->count < kBatchSize) return total;
    constexpr std::size_t kBatchesPerStep = 512;
    const bool goes_on =
        batches % kBatchesPerStep == 0 ? progress.step(fmt::format("{} rows", total), 0.0) : !ProgressLine::stopped();
    if (!goes_on) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
  }
}

// The same for the registers that the table gives.
Result<std::size_t> evaluate_registers(const EvalFlags& flags, const TextProgram& program, EvalTable& table,
                                       ProgressLine& progress) {
  const HardwareProfile& profile = profile_of(flags.common);
  if (!flags.common.quiet) {
    say_assumed_constants(flags.program.file, normalize(program.state, profile), table.columns);
    if (!only_reads_textures(program.texture_shader)) {
      say(fmt::format(
          "ninebit: note: {}: the texture-shader stages are not run, as {} has no coordinates such as at1.s; "
          "tex0 to tex3 are inputs\n",
          printable(flags.program.file), printable(table.lines.name())));
    }
  }
  const EvalRows rows(table.columns, profile);
  EvalRunner runner(program.state, profile, rows, flags.engine == "simd" ? EvalEngine::simd : EvalEngine::reference);
  auto output = OutputFile::open(flags.output);
  if (!output) return output.error();
  Writer writer(flags, profile, *output);
  auto total = stream(table.lines, rows, runner, writer, progress);
  if (!total) return total;
  if (Status finished = writer.finish(); !finished) return finished.error();
  return total;
}

// A row's results as CSV, or as an object of the JSON answer, where a result that there is not is null.
std::string stage_row(const std::vector<std::string>& names, const std::vector<std::string>& values, bool is_json) {
  if (!is_json) return fmt::format("{}\n", fmt::join(values, ","));
  Json row = Json::object();
  for (std::size_t k = 0; k < names.size(); ++k) {
    const bool is_number = Json::accept(values[k]);  // "inf" and "nan" stay words
    row[names[k]] = values[k].empty() ? Json() : is_number ? Json::parse(values[k]) : Json(values[k]);
  }
  return row.dump();
}

// The stages run first, row by row.
Result<std::size_t> evaluate_stages(const EvalFlags& flags, const EvalStages& stages, CsvLines& lines,
                                    ProgressLine& progress) {
  auto output = OutputFile::open(flags.output);
  if (!output) return output.error();
  if (!flags.common.quiet) {
    for (const std::string& warning : stages.warnings()) {
      say(fmt::format("ninebit: note: {}: {}\n", printable(flags.program.file), warning));
    }
  }
  const bool is_json = flags.common.json && flags.output.empty();
  const std::vector<std::string> names = EvalStages::result_names();
  std::string text = fmt::format("{}\n", fmt::join(names, ","));
  if (is_json) {
    text = Json{{"command", "eval"}, {"version", NINEBIT_VERSION}, {"profile", flags.common.profile}}.dump();
    text.back() = ',';
    text += "\"rows\":[";
  }
  std::size_t total = 0;
  for (;; ++total) {
    auto line = lines.next();
    if (!line) return line.error();
    if (!*line) break;
    const auto values = stages.evaluate(**line, lines.name());
    if (!values) return values.error();
    if (is_json) text += total == 0 ? "\n" : ",\n";
    text += stage_row(names, *values, is_json);
    if (Status written = output->write(text); !written) return written.error();
    text.clear();
    const bool goes_on =
        total % 65536 == 0 ? progress.step(fmt::format("{} rows", total), 0.0) : !ProgressLine::stopped();
    if (!goes_on) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
  }
  if (is_json) text += "\n]}\n";
  if (Status written = output->write(text); !written) return written.error();
  if (Status finished = output->finish(); !finished) return finished.error();
  return total;
}

Result<std::size_t> evaluate_table(const EvalFlags& flags, const TextProgram& program, ProgressLine& progress) {
  const HardwareProfile& profile = profile_of(flags.common);
  auto input = InputFile::open(flags.inputs);
  if (!input) return input.error();
  CsvLines lines(std::move(*input));
  const auto header = header_line(lines);
  if (!header) return header.error();
  if (program.texture_shader.enabled && has_stage_columns(header->text)) {
    if (flags.registers) {
      return Diagnostic{.message = "--registers is for tables of registers; this one has coordinates or texels"};
    }
    if (flags.engine_given) {
      return Diagnostic{.message = "--engine is for tables of registers; stages have one evaluator"};
    }
    const auto stages = EvalStages::make(program, profile, *header, lines.name());
    if (!stages) return stages.error();
    return evaluate_stages(flags, *stages, lines, progress);
  }
  auto columns = read_header(*header, lines.name(), profile);
  if (!columns) return table_fault(lines, columns.error());
  EvalTable table{std::move(lines), *std::move(columns)};
  return evaluate_registers(flags, program, table, progress);
}

// The first error in the flags of pictures; empty: none.
std::string complain_about_pictures(const EvalFlags& flags, const RegisterSettings& set) {
  if (flags.output.empty()) return "-o FILE.png is required with pictures";
  if (std::filesystem::path(flags.output).extension() != ".png") {
    return fmt::format("-o {}: expected the name of a .png file, as the inputs are pictures", printable(flags.output));
  }
  const int units = profile_of(flags.common).texture_units;
  for (int unit = 0; unit < 4; ++unit) {
    if (flags.textures[static_cast<std::size_t>(unit)].empty()) continue;
    if (unit >= units)
      return fmt::format("--tex{}: profile {} has {} texture units", unit, profile_of(flags.common).name, units);
    for (const EvalColumn& column : set.set) {
      if (column.reg == texture_register(unit)) {
        return fmt::format("--set {}: --tex{} gives its values", column.name(), unit);
      }
    }
  }
  return {};
}

int run_on_pictures(const EvalFlags& flags, const TextProgram& program) {
  const HardwareProfile& profile = profile_of(flags.common);
  const auto set = parse_register_settings(flags.set, profile);
  if (!set) return wrong_usage("eval", set.error().message);
  if (const std::string complaint = complain_about_pictures(flags, *set); !complaint.empty()) {
    return wrong_usage("eval", complaint);
  }
  if (!flags.common.quiet) {
    say_assumed_constants(flags.program.file, normalize(program.state, profile), set->set);
    if (!only_reads_textures(program.texture_shader)) {
      say(fmt::format("ninebit: note: {}: the texture-shader stages are not run; the pictures are tex0 to tex3\n",
                      printable(flags.program.file)));
    }
  }
  std::optional<ProgressLine> progress(std::in_place, flags.common.quiet);
  const auto picture = evaluate_pictures(program.state, profile, flags.textures, *set);
  progress.reset();
  if (!picture) return report(picture.error());
  const auto bytes = encode_png(*picture);
  if (!bytes) return report(bytes.error());
  if (Status written = write_output(flags.output, *bytes); !written) return report(written.error());
  if (!flags.common.quiet) say_written(flags.output);
  if (!flags.common.json) return kDone;
  return answer(Json{{"command", "eval"},
                     {"version", NINEBIT_VERSION},
                     {"profile", flags.common.profile},
                     {"size", {picture->width, picture->height}},
                     {"fragments", picture->pixels.size() / 4},
                     {"files", Json::array({flags.output})}});
}

int run(const EvalFlags& flags) {
  const bool on_pictures =
      std::any_of(flags.textures.begin(), flags.textures.end(), [](const std::string& file) { return !file.empty(); });
  if (!on_pictures && flags.inputs.empty())
    return wrong_usage("eval", "--inputs FILE.csv or --tex0 PICTURE is required");
  for (std::size_t unit = 0; unit < 4 && !flags.inputs.empty(); ++unit) {
    if (flags.textures[unit].empty()) continue;
    return wrong_usage("eval", fmt::format("--tex{} {}: --inputs is a table; expected a table or pictures", unit,
                                           printable(flags.textures[unit])));
  }
  if (!on_pictures && !flags.set.empty()) {
    return wrong_usage("eval", fmt::format("--set {}: expected it beside pictures; a table has columns", flags.set[0]));
  }
  if (on_pictures && flags.registers) return wrong_usage("eval", "--registers is for tables");
  if (on_pictures && flags.engine_given) return wrong_usage("eval", "--engine is for tables");
  if (flags.program.file == "-" && flags.inputs == "-") {
    return wrong_usage("eval", "only one of PROGRAM and --inputs can be standard input");
  }
  int exit_code = kDone;
  const auto program = load_text_program(flags.program, profile_of(flags.common), flags.common.quiet, exit_code);
  if (!program) return exit_code;
  if (on_pictures) return run_on_pictures(flags, *program);

  std::optional<ProgressLine> progress(std::in_place, flags.common.quiet || posix::is_terminal(posix::kStandardOutput));
  const auto total = evaluate_table(flags, *program, *progress);
  progress.reset();
  if (!total) return report(total.error());
  if (flags.output.empty()) return kDone;
  if (!flags.common.quiet) say_written(flags.output);
  if (!flags.common.json) return kDone;
  const Json out{{"command", "eval"},      {"version", NINEBIT_VERSION}, {"profile", flags.common.profile},
                 {"engine", flags.engine}, {"fragments", *total},        {"files", Json::array({flags.output})}};
  return answer(out);
}

}  // namespace

void add_eval(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("eval", "Evaluate a program on a table of register codes, or on pictures");
  verb->footer(
      "The table has a header such as primary.r,tex0.a,const0.g,spare0.a; its rows are whole numbers. In most\n"
      "profiles, 255 is 1.0. Defaults for missing columns:\n"
      "  alpha of textures, fog      what the profile gives a unit that is off, and fog that is off\n"
      "  secondary.a                 1.0 where the profile's secondary_alpha is one, else 0\n"
      "  spare0.a                    the value of tex0.a\n"
      "  const0, const1              the program's own constants; 0, with a note, if it does not set them\n"
      "  all others                  0\n"
      "A program with texture-shader stages also takes coordinates, at0.s to at3.q (default 0, of q 1), and bytes of\n"
      "texels, texel0.r to texel3.a (default 0), which are read wherever a stage reads its texture. Its results are\n"
      "the colour, tex0 to tex3, whether the fragment is culled, its replaced depth, and where textures are read.\n"
      "A column for a constant replaces the constant in every stage. Results are written to standard output as\n"
      "they are computed; if a row is invalid, the rows before it have already been written.\n"
      "Pictures are read texel by texel, in any size, all in the same one; what no picture and no --set gives has the\n"
      "defaults above. The result has a picture's four bytes.\n"
      "Examples:\n"
      "  ninebit eval sepia.rc1 --tex0 photograph.png -o sepia.png\n"
      "  ninebit eval compare.gl --inputs codes.csv -o out.csv\n"
      "  ninebit eval compare.gl --inputs - --registers --engine reference < codes.csv");
  auto flags = std::make_shared<EvalFlags>();
  add_answer_flags(*verb, flags->common);
  add_profile_flag(*verb, flags->common);
  add_program_flags(*verb, flags->program);
  add_include_flag(*verb, flags->program.allow_outside);
  verb->add_option("--inputs", flags->inputs, "Table of register codes; - reads standard input")->type_name("FILE.csv");
  for (std::size_t unit = 0; unit < 4; ++unit) {
    verb->add_option(fmt::format("--tex{}", unit), flags->textures[unit],
                     fmt::format("Picture whose texels texture register {} holds", unit))
        ->type_name("PICTURE");
  }
  verb->add_option(
          "--set", flags->set,
          "With pictures: the codes of a register, REGISTER=R,G,B,A or REGISTER.COMPONENT=VALUE; repeat for more")
      ->type_name("REGISTER=CODES")
      ->allow_extra_args(false);
  verb->add_option("-o,--output", flags->output, "Write the results to this file instead of standard output")
      ->type_name("FILE");
  verb->add_flag("--registers", flags->registers, "Also write every register after the last general combiner");
  verb->add_option("--engine", flags->engine, "Evaluator to use; both compute the same bits")
      ->capture_default_str()
      ->check(CLI::IsMember({"reference", "simd"}));
  verb->callback([flags, verb, &exit_code] {
    flags->engine_given = verb->count("--engine") > 0;
    exit_code = run(*flags);
  });
}

}  // namespace ninebit::tools
