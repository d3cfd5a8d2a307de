#include "src/tools/trace/trace_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/tools/input/eval_table.h"
#include "src/tools/input/host.h"

namespace ninebit::tools {
namespace {

constexpr std::array<std::string_view, 4> kChannels{"red", "green", "blue", "alpha"};
constexpr std::array<std::string_view, 7> kVariableLetters{"A", "B", "C", "D", "E", "F", "G"};

std::string spaced(std::string_view name) {
  std::string text(name);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string name_of_register(Register reg) {
  return reg == Register::e_times_f               ? "E·F"
         : reg == Register::spare0_plus_secondary ? "spare0 + secondary"
                                                  : std::string(short_name(reg));
}

// "tex0"; "tex0.alpha" or "tex0.blue" if that component is read instead of the channel's own.
std::string source_of(const CombinerInput& in) {
  std::string name = name_of_register(in.reg);
  if (in.reg == Register::zero || in.usage == ComponentUsage::rgb) return name;
  return name + (in.usage == ComponentUsage::alpha ? ".alpha" : ".blue");
}

std::string_view scale_text(Scale scale) {
  return scale == Scale::by_two ? "· 2" : scale == Scale::by_four ? "· 4" : scale == Scale::by_one_half ? "/ 2" : "";
}

bool is_plain_zero(const CombinerInput& in) {
  return in.reg == Register::zero && in.mapping == InputMapping::unsigned_identity;
}

class TextWriter {
 public:
  TextWriter(const Program& program, const Trace& trace, TraceLayout layout)
      : program_(program), d_(program.datapath), trace_(trace), table_(layout.colors, layout.columns) {}

  std::string run() {
    legend();
    registers();
    for (std::size_t i = 0; i < trace_.stage.size(); ++i) {
      const TracedStage& stage = trace_.stage[i];
      portion(fmt::format("stage {}, RGB portion", i), stage, stage.rgb);
      portion(fmt::format("stage {}, alpha portion", i), stage, stage.alpha);
    }
    final_rgb();
    final_alpha();
    const auto& b = trace_.bytes;
    table_.line("");
    table_.line(fmt::format("out: bytes {}, {}, {}, {}", b[0], b[1], b[2], b[3]), TraceEmphasis::result);
    return table_.text();
  }

 private:
  [[nodiscard]] bool integer() const { return d_.arithmetic == Arithmetic::integer; }

  void legend() {
    if (integer()) {
      table_.line(
          fmt::format("code: units of 1/{}, wide: units of 1/{}; real: the same as a number; ideal: in exact "
                      "arithmetic from the start",
                      d_.one, d_.one * d_.one));
    } else {
      table_.line(
          fmt::format("real: what is held, as {}; integer: the nearest unit of 1/{} (code) or 1/{} (wide); ideal: "
                      "in exact arithmetic",
                      d_.arithmetic == Arithmetic::exact ? "fractions" : "32-bit floats", d_.one, d_.one * d_.one));
    }
  }

  // The registers of the fragment that the program reads.
  void registers() {
    std::array<bool, kRegisterCount> read{};
    const auto mark = [&](Register reg) {
      if (reg > Register::constant1 && reg <= Register::texture3) read[static_cast<std::size_t>(reg)] = true;
    };
    for (const TracedStage& stage : trace_.stage) {
      for (const Portion* p : {&stage.rgb.state, &stage.alpha.state}) {
        for (const CombinerInput* in : {&p->a, &p->b, &p->c, &p->d}) mark(in->reg);
        if (p->out.mux_sum) mark(Register::spare0);
      }
    }
    const FinalCombiner& f = program_.final_combiner;
    for (const CombinerInput* in : {&f.a, &f.b, &f.c, &f.d, &f.e, &f.f, &f.g}) mark(in->reg);
    if (trace_.final_combiner.uses_color_sum) {
      mark(Register::spare0);
      mark(Register::secondary);
    }
    table_.line("");
    table_.line("registers at the start, codes of red, green, blue, alpha", TraceEmphasis::result);
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      if (!read[r]) continue;
      const Rgba9& v = trace_.before.codes.value[r];
      table_.line(
          fmt::format("  {:<24}{:>5}{:>5}{:>5}{:>5}", short_name(static_cast<Register>(r)), v[0], v[1], v[2], v[3]));
    }
  }

  // The variable as it is read and, if the mapping changes it, as it is mapped.
  void input(std::size_t variable, std::span<const TracedInput> channels) {
    const CombinerInput& in = channels.front().from;
    const std::string label = fmt::format("{} = {}", kVariableLetters[variable], source_of(in));
    const std::string mapping = spaced(name_of(in.mapping));
    TraceCells read, mapped;
    bool changes = false;
    for (const TracedInput& channel : channels) {
      read.emplace_back(channel.read);
      mapped.emplace_back(channel.mapped);
      changes = changes || channel.read.code != channel.mapped.code || channel.read.real != channel.mapped.real ||
                channel.read.ideal != channel.mapped.ideal;
    }
    table_.codes(label, read);
    if (changes) table_.codes("    " + mapping, mapped);
  }

  void portion(const std::string& title, const TracedStage& stage, const TracedPortion& portion) {
    const std::span<const TracedChannel> channels = portion.channel;
    if (channels.empty()) {
      table_.line("");
      table_.line(title + ": writes nothing");
      return;
    }
    const PortionOutput& out = portion.state.out;
    table_.begin(title, std::span(kChannels).subspan(static_cast<std::size_t>(channels[0].component), channels.size()));
    const auto variable = [&](std::size_t v) {
      std::vector<TracedInput> inputs;
      for (const TracedChannel& channel : channels) inputs.push_back(channel.input[v]);
      input(v, inputs);
    };
    const auto cells = [&](auto member) { return cells_of(channels, member); };
    if (portion.uses_ab) {
      variable(0);
      variable(1);
      table_.wide("A·B", cells(&TracedChannel::ab_product));
      if (out.ab_dot_product) table_.wide("dot(A, B)", cells(&TracedChannel::ab));
    }
    if (portion.uses_cd) {
      variable(2);
      variable(3);
      table_.wide("C·D", cells(&TracedChannel::cd_product));
      if (out.cd_dot_product) table_.wide("dot(C, D)", cells(&TracedChannel::cd));
    }
    if (out.sum != Register::discard) {
      if (out.mux_sum) mux(stage);
      table_.wide(out.mux_sum ? "mux" : "A·B + C·D", cells(&TracedChannel::third));
    }
    const char* const blue = ", blue also to its alpha";
    output(out.ab_dot_product ? "dot(A, B)" : "A·B", out, out.ab, channels, &TracedChannel::ab_output,
           out.ab_blue_to_alpha ? blue : "");
    output(out.cd_dot_product ? "dot(C, D)" : "C·D", out, out.cd, channels, &TracedChannel::cd_output,
           out.cd_blue_to_alpha ? blue : "");
    output(out.mux_sum ? "mux" : "A·B + C·D", out, out.sum, channels, &TracedChannel::third_output);
  }

  void mux(const TracedStage& stage) {
    const bool differs = stage.takes_cd != stage.ideal_takes_cd;
    const std::string choice = fmt::format(
        "  spare0.alpha is {} ({:.5f}, ideal {:.5f}): the mux{} takes {}{}", stage.spare0_alpha.code,
        stage.spare0_alpha.real, stage.spare0_alpha.ideal, stage.mux_by_lowest_bit ? ", by the lowest bit," : "",
        stage.takes_cd ? "C·D" : "A·B", differs ? stage.ideal_takes_cd ? ", the ideal C·D" : ", the ideal A·B" : "");
    table_.line(choice, differs ? TraceEmphasis::cut : TraceEmphasis::none);
  }

  void output(const std::string& what, const PortionOutput& state, Register to, std::span<const TracedChannel> channels,
              std::optional<TracedOutput> TracedChannel::*which, const char* more = "") {
    if (to == Register::discard) return;
    std::vector<TracedOutput> outputs;
    for (const TracedChannel& channel : channels) outputs.push_back(*(channel.*which));
    const auto cells = [&](auto member) { return cells_of(std::span<const TracedOutput>(outputs), member); };
    table_.line(fmt::format("  {} to {}{}", what, short_name(to), more));
    if (state.bias != Bias::none) table_.wide("  - 1/2", cells(&TracedOutput::biased));
    if (outputs[0].early) {
      TraceCells early;
      for (const TracedOutput& out : outputs) early.emplace_back(*out.early);
      table_.codes("  narrowed before scaling", early);
    }
    if (state.scale != Scale::none) {
      table_.wide(fmt::format("  {}", scale_text(state.scale)), cells(&TracedOutput::scaled));
    }
    if (integer()) {
      dropped(cells(&TracedOutput::dropped), cells(&TracedOutput::scaled), cells(&TracedOutput::narrowed));
    }
    cut(cells(&TracedOutput::cut));
    table_.codes("  " + std::string(short_name(to)), cells(&TracedOutput::written), TraceEmphasis::result);
  }

  // The part that narrowing dropped and the part that it kept, with a note if everything was dropped.
  void dropped(const TraceCells& dropped, const TraceCells& exact, const TraceCells& narrowed) {
    bool any = false, all = false;
    for (std::size_t c = 0; c < dropped.size(); ++c) {
      any = any || dropped[c].held != 0;
      all = all || (exact[c].held != 0 && narrowed[c].held == 0);
    }
    table_.wide("  dropped", dropped, any ? TraceEmphasis::loss : TraceEmphasis::none, all ? "everything" : "");
    table_.codes("  narrowed", narrowed);
  }

  void cut(const TraceCells& cells) {
    const bool any = std::any_of(cells.begin(), cells.end(), [](const TraceCell& c) { return c.real != 0; });
    const bool ideal = std::any_of(cells.begin(), cells.end(), [](const TraceCell& c) { return c.ideal != 0; });
    if (any || ideal) table_.codes("  cut by the clamp", cells, any ? TraceEmphasis::cut : TraceEmphasis::none);
  }

  template <class Channel, class Member>
  static TraceCells cells_of(std::span<const Channel> channels, Member Channel::*member) {
    TraceCells cells;
    for (const Channel& channel : channels) cells.emplace_back(channel.*member);
    return cells;
  }

  void final_rgb() {
    using F = TracedFinalChannel;
    const TracedFinal& f = trace_.final_combiner;
    const std::span<const F> channels = f.rgb;
    const auto cells = [&](auto member) { return cells_of(channels, member); };
    const auto variable = [&](std::size_t v) {
      const std::array<TracedInput, 3> inputs{channels[0].input[v], channels[1].input[v], channels[2].input[v]};
      input(v, inputs);
    };
    table_.begin("final combiner, RGB", std::span(kChannels).first(3));
    if (f.uses_e_times_f) {
      variable(4);
      variable(5);
      table_.wide("E·F", cells(&F::e_times_f_product));
      if (integer()) {
        dropped(cells(&F::e_times_f_dropped), cells(&F::e_times_f_product), cells(&F::e_times_f));
      }
    }
    if (f.uses_color_sum) {
      const char* const spare0 = program_.color_sum_invert_spare0 ? "(1 - spare0)" : "spare0";
      const char* const secondary = program_.color_sum_invert_secondary ? "(1 - secondary)" : "secondary";
      table_.codes(fmt::format("{} + {}", spare0, secondary), cells(&F::color_sum_unclamped));
      if (program_.color_sum_clamp) table_.codes("    clamped", cells(&F::color_sum));
    }
    const FinalCombiner& from = program_.final_combiner;
    if (is_plain_zero(from.a) && is_plain_zero(from.b) && is_plain_zero(from.c) && is_plain_zero(from.d)) {
      table_.line("  A, B, C, D = zero");
    } else {
      for (std::size_t v = 0; v < 3; ++v) variable(v);
      table_.wide("A·B", cells(&F::a_times_b));
      table_.wide("(1 - A)·C", cells(&F::one_minus_a_times_c));
      table_.wide("A·B + (1 - A)·C", cells(&F::mix));
      if (integer()) dropped(cells(&F::dropped), cells(&F::mix), cells(&F::narrowed));
      variable(3);
      if (!is_plain_zero(from.d)) table_.codes("+ D", cells(&F::sum));
      cut(cells(&F::cut));
    }
    table_.codes("rgb", cells(&F::written), TraceEmphasis::result);
  }

  void final_alpha() {
    const TracedFinal& f = trace_.final_combiner;
    table_.begin("final combiner, alpha", std::span(kChannels).last(1));
    input(6, std::span(&f.g, 1));
    cut({f.alpha_cut});
    table_.codes("alpha", {f.alpha}, TraceEmphasis::result);
  }

  const Program& program_;
  const Datapath& d_;
  const Trace& trace_;
  TraceTable table_;
};

}  // namespace

std::string trace_text(const Program& program, const Trace& trace, TraceLayout layout) {
  return TextWriter(program, trace, layout).run();
}

namespace {

constexpr int kLabelWidth = 27;  // with the indent; the unit follows
constexpr std::size_t kColumnWidth = 9;
constexpr int kLeastColumns = 80;
constexpr int kSideBySideColumns = 134;

std::string held_text(double v) {
  return v == std::floor(v) ? fmt::format("{}", static_cast<long long>(v)) : fmt::format("{:.1f}", v);
}

// Five decimals; a number that is too small for them has one digit and an exponent.
std::string real_text(double v) {
  constexpr double kLeast = 0.000005;
  if (v == 0) return "0";
  return std::abs(v) < kLeast ? fmt::format("{:.0e}", v) : fmt::format("{:.5f}", v);
}

std::string_view escape_of(TraceEmphasis emphasis) {
  switch (emphasis) {
    case TraceEmphasis::none:
      return "";
    case TraceEmphasis::result:
      return "\x1b[1m";
    case TraceEmphasis::loss:
      return "\x1b[33m";
    case TraceEmphasis::cut:
      return "\x1b[31m";
  }
  return "";
}

constexpr std::array<std::string_view, 3> kWays{"integer", "real", "ideal"};

}  // namespace

TraceTable::TraceTable(bool colors, int columns)
    : colors_(colors), columns_(std::max(columns, kLeastColumns)), side_by_side_(columns >= kSideBySideColumns) {}

void TraceTable::end_line(const std::string& line, TraceEmphasis emphasis) {
  const std::string_view escape = colors_ ? escape_of(emphasis) : "";
  const std::size_t end = line.find_last_not_of(' ') + 1;
  text_ += fmt::format("{}{}{}\n", escape, std::string_view(line).substr(0, end), escape.empty() ? "" : "\x1b[0m");
}

void TraceTable::begin(const std::string& title, std::span<const std::string_view> channels) {
  channels_.clear();
  for (const std::string_view channel : channels) channels_ += channel.front();
  text_ += '\n';
  if (!side_by_side_) {
    const std::string line =
        fmt::format("{:<{}}    {:>10}{:>9}{:>9}", title, kLabelWidth + 5, kWays[0], kWays[1], kWays[2]);
    end_line(line, TraceEmphasis::result);
    return;
  }
  const std::size_t width = channels.size() * kColumnWidth;
  std::string names = fmt::format("{:<{}}", "", kLabelWidth + 5), ways = fmt::format("{:<{}}", title, kLabelWidth + 5);
  for (const std::string_view way : kWays) {
    ways += fmt::format("  {:>{}}", way, width);
    names += "  ";
    for (const std::string_view channel : channels) names += fmt::format("{:>{}}", channel, kColumnWidth);
  }
  end_line(ways, TraceEmphasis::result);
  if (channels.size() > 1) end_line(names, TraceEmphasis::none);
}

void TraceTable::codes(const std::string& label, const TraceCells& cells, TraceEmphasis emphasis,
                       const std::string& note) {
  row({label, "code", cells, emphasis, note});
}

void TraceTable::wide(const std::string& label, const TraceCells& cells, TraceEmphasis emphasis,
                      const std::string& note) {
  row({label, "wide", cells, emphasis, note});
}

void TraceTable::line(const std::string& text, TraceEmphasis emphasis) {
  const std::string broken = wrapped(text, columns_);
  for (std::size_t from = 0; from <= broken.size();) {
    const std::size_t end = std::min(broken.find('\n', from), broken.size());
    end_line(broken.substr(from, end - from), text.empty() ? TraceEmphasis::none : emphasis);
    from = end + 1;
  }
}

void TraceTable::row(const Row& row) {
  side_by_side_ ? side_by_side(row) : line_by_channel(row);
}

void TraceTable::side_by_side(const Row& row) {
  std::string line = fmt::format("  {:<{}} {}", row.label, kLabelWidth - 2, row.unit);
  const auto columns = [&](auto text_of) {
    line += "  ";
    for (const TraceCell& cell : row.cells) line += fmt::format("{:>{}}", text_of(cell), kColumnWidth);
  };
  columns([](const TraceCell& cell) { return held_text(cell.held); });
  columns([](const TraceCell& cell) { return real_text(cell.real); });
  columns([](const TraceCell& cell) { return real_text(cell.ideal); });
  if (!row.note.empty()) line += "  <- " + row.note;
  end_line(line, row.emphasis);
}

// Neighbours with equal values share a line.
void TraceTable::line_by_channel(const Row& row) {
  const bool of_losses = row.emphasis == TraceEmphasis::loss || row.emphasis == TraceEmphasis::cut;
  std::string label = row.label, unit = row.unit, note = row.note.empty() ? "" : "  <- " + row.note;
  if (width_of(label) > kLabelWidth - 2) {
    line("  " + label);
    label.clear();
  }
  for (std::size_t first = 0, end = 0; first < row.cells.size(); first = end) {
    const TraceCell& cell = row.cells[first];
    while (end < row.cells.size() && row.cells[end] == cell) ++end;
    const std::string text = fmt::format("  {:<{}} {:<4} {:<3}{:>10}{:>9}{:>9}{}", label, kLabelWidth - 2, unit,
                                         channels_.substr(first, end - first), held_text(cell.held),
                                         real_text(cell.real), real_text(cell.ideal), note);
    end_line(text, of_losses && cell.real == 0 && cell.ideal == 0 ? TraceEmphasis::none : row.emphasis);
    for (std::string* const once : {&label, &unit, &note}) once->clear();
  }
}

}  // namespace ninebit::tools
