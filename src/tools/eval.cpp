// `ninebit eval`: evaluates a program on each row of a table of register codes.
#include <fmt/format.h>

#include <charconv>
#include <memory>
#include <optional>
#include <utility>

#include "src/system/process.h"
#include "src/system/stream.h"
#include "src/tools/common/output_file.h"
#include "src/tools/common/program_file.h"
#include "src/tools/eval/eval_engine.h"

namespace ninebit::tools {
namespace {

struct EvalFlags {
  CommonFlags common;
  ProgramFlags program;
  std::string inputs;
  std::string output;
  bool registers = false;
  std::string engine = "simd";
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

Result<std::size_t> evaluate_table(const EvalFlags& flags, const CombinerState& state, ProgressLine& progress) {
  const HardwareProfile& profile = profile_of(flags.common);
  auto table = EvalTable::open(flags.inputs, profile);
  if (!table) return table.error();
  if (!flags.common.quiet) say_assumed_constants(flags.program.file, normalize(state, profile), table->columns);
  const EvalRows rows(table->columns, profile);
  EvalRunner runner(state, profile, rows, flags.engine == "simd" ? EvalEngine::simd : EvalEngine::reference);

  auto output = OutputFile::open(flags.output);
  if (!output) return output.error();
  Writer writer(flags, profile, *output);
  auto total = stream(table->lines, rows, runner, writer, progress);
  if (!total) return total;
  if (Status finished = writer.finish(); !finished) return finished.error();
  return total;
}

int run(const EvalFlags& flags) {
  if (flags.program.file == "-" && flags.inputs == "-") {
    say("ninebit: error: only one of PROGRAM and --inputs can be standard input (see: ninebit eval --help)\n");
    return kWrongUsage;
  }
  int exit_code = kDone;
  const auto state = load_program(flags.program, profile_of(flags.common), flags.common.quiet, exit_code);
  if (!state) return exit_code;

  std::optional<ProgressLine> progress(std::in_place, flags.common.quiet || posix::is_terminal(posix::kStandardOutput));
  const auto total = evaluate_table(flags, *state, *progress);
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
  CLI::App* verb = app.add_subcommand("eval", "Evaluate a program on a table of register codes");
  verb->footer(
      "The table has a header such as primary.r,tex0.a,const0.g,spare0.a; its rows are whole numbers. In most\n"
      "profiles, 255 is 1.0. Defaults for missing columns:\n"
      "  alpha of textures, fog      what the profile gives a unit that is off, and fog that is off\n"
      "  secondary.a                 1.0 where the profile's secondary_alpha is one, else 0\n"
      "  spare0.a                    the value of tex0.a\n"
      "  const0, const1              the program's own constants; 0, with a note, if it does not set them\n"
      "  all others                  0\n"
      "A column for a constant replaces the constant in every stage. Results are written to standard output as\n"
      "they are computed; if a row is invalid, the rows before it have already been written.\n"
      "Examples:\n"
      "  ninebit eval compare.gl --inputs codes.csv -o out.csv\n"
      "  ninebit eval compare.gl --inputs - --registers --engine reference < codes.csv");
  auto flags = std::make_shared<EvalFlags>();
  add_answer_flags(*verb, flags->common);
  add_profile_flag(*verb, flags->common);
  add_program_flags(*verb, flags->program);
  add_include_flag(*verb, flags->program.allow_outside);
  verb->add_option("--inputs", flags->inputs, "Table of register codes; - reads standard input")
      ->required()
      ->type_name("FILE.csv");
  verb->add_option("-o,--output", flags->output, "Write the results to this file instead of standard output")
      ->type_name("FILE.csv");
  verb->add_flag("--registers", flags->registers, "Also write every register after the last general combiner");
  verb->add_option("--engine", flags->engine, "Evaluator to use; both compute the same bits")
      ->capture_default_str()
      ->check(CLI::IsMember({"reference", "simd"}));
  verb->callback([flags, &exit_code] { exit_code = run(*flags); });
}

}  // namespace ninebit::tools
