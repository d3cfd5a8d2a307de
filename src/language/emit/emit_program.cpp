#include "src/language/emit/emit_program.h"

#include <algorithm>

#include "src/language/emit/emit_comments.h"
#include "src/language/emit/emit_liveness.h"

namespace ninebit::emit {
namespace {

#define NINEBIT_RULE inline
#include "ninebit/numerics/combiner_rules.inl"
#undef NINEBIT_RULE

using Values = std::array<V, 4>;

// Every register component as a value of the graph.
class TextRegisters {
 public:
  V& operator()(Register r, int component) {
    return value_[static_cast<std::size_t>(r)][static_cast<std::size_t>(component)];
  }
  const V& operator()(Register r, int component) const {
    return value_[static_cast<std::size_t>(r)][static_cast<std::size_t>(component)];
  }

  // A component as a combiner input reads it.
  [[nodiscard]] V read(Register r, int component, const Rgba9& constant0, const Rgba9& constant1) const {
    const auto i = static_cast<std::size_t>(component);
    if (r == Register::zero) return set(0);
    if (r == Register::constant0) return set(constant0[i]);
    if (r == Register::constant1) return set(constant1[i]);
    return (*this)(r, component);
  }

 private:
  std::array<Values, kRegisterCount> value_{};
};

class Lister {
 public:
  Lister(const Program& program, Graph& graph, const InputText& input)
      : program_(program), d_(program.datapath), live_(live_after_stages(program)) {
    const Interval range{d_.lowest, d_.one};
    for (const Register r : {Register::fog, Register::primary, Register::secondary, Register::texture0,
                             Register::texture1, Register::texture2, Register::texture3}) {
      for (int c = 0; c < 4; ++c) registers_(r, c) = graph.input(input(r, c), range);
    }
    registers_(Register::spare0, kAlpha) = graph.input(input(Register::spare0, kAlpha), range);
  }

  Listing run() {
    Listing listing;
    for (int i = 0; i < program_.num_general_combiners; ++i) {
      // Both portions read before either writes (rule 12).
      const TextRegisters before = registers_;
      list_portion(i, PortionName::rgb, before, listing);
      list_portion(i, PortionName::alpha, before, listing);
    }
    listing.final_comments = comments_of_final(program_);
    listing.result = final_result();
    return listing;
  }

 private:
  void list_portion(int stage, PortionName portion_name, const TextRegisters& before, Listing& listing) {
    const ProgramStage& from = program_.general[static_cast<std::size_t>(stage)];
    const Portion& portion = portion_name == PortionName::rgb ? from.rgb : from.alpha;
    const int first = portion_name == PortionName::rgb ? kRed : kAlpha;
    const int channels = portion_name == PortionName::rgb ? 3 : 1;
    const LiveSet& after = live_[static_cast<std::size_t>(stage)];
    const PortionOutput& out = portion.out;
    if (!is_live(out)) return;

    const auto mapped = [&](const CombinerInput& in, int channel) {
      const int component = reference::component_of(in.usage, channel);
      return map_input(d_, in.mapping, before.read(in.reg, component, from.constant0, from.constant1));
    };
    const auto products = [&](const CombinerInput& x, const CombinerInput& y, bool dot, const char* name) {
      Values wide{};
      V total = set(0);
      for (int c = 0; c < channels; ++c) {
        wide[static_cast<std::size_t>(c)] = mul(mapped(x, c), mapped(y, c));
        total = add(total, wide[static_cast<std::size_t>(c)]);
      }
      if (dot) {
        Graph::name(total, "s" + std::to_string(stage) + name);
        wide.fill(total);
      }
      return wide;
    };
    const Values ab = products(portion.a, portion.b, out.ab_dot_product, "_dot_ab");
    const Values cd = products(portion.c, portion.d, out.cd_dot_product, "_dot_cd");

    Block block;
    const auto write_component = [&](Register to, int component, const auto& wide) {
      V& value = registers_(to, component);
      if (!after.has(to, component)) {
        value = set(0);  // not read before it is written again
        return false;
      }
      value = combiner_output(d_, out.scale, out.bias, wide());
      const char letter = kComponentLetters[static_cast<std::size_t>(component)];
      const std::string target(short_name_of(to));
      Line line{target + '.' + letter, "s" + std::to_string(stage) + '_' + target + '_' + letter, value};
      Graph::name(value, line.name);
      block.lines.push_back(std::move(line));
      return true;
    };
    const auto write = [&](Register to, bool blue_to_alpha, const auto& wide_of) {
      bool any = false;
      for (int c = 0; to != Register::discard && c < channels; ++c) {
        any = write_component(to, first + c, [&] { return wide_of(static_cast<std::size_t>(c)); }) || any;
      }
      return (blue_to_alpha && write_component(to, kAlpha, [&] { return wide_of(kBlue); })) || any;
    };
    LiveOutputs live;
    live.ab = write(out.ab, out.ab_blue_to_alpha, [&](std::size_t c) { return ab[c]; });
    live.cd = write(out.cd, out.cd_blue_to_alpha, [&](std::size_t c) { return cd[c]; });
    live.sum = write(out.sum, false, [&](std::size_t c) {
      return out.mux_sum ? mux(d_, from.mux_by_lowest_bit, before(Register::spare0, kAlpha), ab[c], cd[c])
                         : add(ab[c], cd[c]);
    });
    block.comments = comments_of(program_, stage, portion_name, live);
    listing.blocks.push_back(std::move(block));
  }

  Values final_result() const {
    const FinalCombiner& f = program_.final_combiner;
    const auto plain = [&](const CombinerInput& in, int channel) {
      const int component = reference::component_of(in.usage, channel);
      return map_input(d_, in.mapping, registers_.read(in.reg, component, program_.constant0, program_.constant1));
    };
    const auto mapped = [&](const CombinerInput& in, int channel) {
      if (in.reg == Register::e_times_f) {
        return map_input(d_, in.mapping, e_times_f(d_, plain(f.e, channel), plain(f.f, channel)));
      }
      if (in.reg == Register::spare0_plus_secondary) {
        const V spare0 = registers_(Register::spare0, channel), secondary = registers_(Register::secondary, channel);
        const V sum =
            color_sum(d_, program_.color_sum_clamp, color_sum_part(d_, program_.color_sum_invert_spare0, spare0),
                      color_sum_part(d_, program_.color_sum_invert_secondary, secondary));
        return map_input(d_, in.mapping, sum);
      }
      return plain(in, channel);
    };
    Values result{};
    for (int c = 0; c < 3; ++c) {
      V& value = result[static_cast<std::size_t>(c)];
      value = final_rgb(d_, mapped(f.a, c), mapped(f.b, c), mapped(f.c, c), mapped(f.d, c));
      Graph::name(value, std::string("result_") + kComponentLetters[static_cast<std::size_t>(c)]);
    }
    result[kAlpha] = final_alpha(d_, mapped(f.g, kAlpha));
    Graph::name(result[kAlpha], "result_a");
    return result;
  }

  const Program& program_;
  const Datapath& d_;
  std::vector<LiveSet> live_;
  TextRegisters registers_;
};

bool is_usable_name(std::string_view name) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto is_rest = [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_'; };
  return !name.empty() && name.size() <= 200 && is_letter(name.front()) && name.back() != '_' &&
         std::all_of(name.begin(), name.end(), is_rest) && name.find("__") == std::string_view::npos &&
         name.substr(0, 3) != "gl_";
}

}  // namespace

std::string_view short_name_of(Register r) {
  constexpr std::array<std::string_view, kRegisterCount> names{"zero",     "constant0", "constant1", "fog",
                                                               "primary",  "secondary", "spare0",    "spare1",
                                                               "texture0", "texture1",  "texture2",  "texture3"};
  return names[static_cast<std::size_t>(r)];
}

Listing list_program(const Program& program, Graph& graph, const InputText& input) {
  return Lister(program, graph, input).run();
}

std::optional<Diagnostic> refusal(const Program& program, std::string_view function) {
  if (program.datapath.arithmetic != Arithmetic::integer) {
    return Diagnostic{.message = "only programs of integer profiles can be emitted as source"};
  }
  // The precondition of combiner_rules.inl: six products of the largest mapped values plus the bias do not exceed
  // eight.
  const Datapath& d = program.datapath;
  constexpr std::int64_t kMostOne = 1 << 15;
  const std::int64_t one = d.one, half = d.half, lowest = d.lowest, expand_offset = d.expand_offset;
  const std::int64_t most = std::max({one, -lowest, expand_offset, half});
  const bool usable = one > 0 && one <= kMostOne && lowest <= 0 && half >= 0 && expand_offset >= 0 && most <= 2 * one &&
                      6 * most * most + half * one <= 8 * one * one;
  if (!usable) return Diagnostic{.message = "the profile's codes are out of the datapath's range"};
  if (!is_usable_name(function)) {
    return Diagnostic{.message = "\"" + std::string(function) +
                                 "\" is not a valid function name in GLSL and C; expected a letter, then letters, "
                                 "digits and single underscores, not ending in an underscore or starting with gl_"};
  }
  return std::nullopt;
}

}  // namespace ninebit::emit
