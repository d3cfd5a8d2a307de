#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "ninebit/language/trace_json.h"

namespace ninebit {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr std::string_view kComponents = "rgba";

std::string component_name(int component) {
  return {kComponents[static_cast<std::size_t>(component)]};
}

OrderedJson json_of(const TracedCode& v) {
  return {{"code", v.code}, {"real", v.real}, {"ideal", v.ideal}};
}

OrderedJson json_of(const TracedWide& v) {
  const bool whole = v.units == std::floor(v.units);
  return {{"units", whole ? OrderedJson(static_cast<std::int64_t>(v.units)) : OrderedJson(v.units)},
          {"real", v.real},
          {"ideal", v.ideal}};
}

OrderedJson json_of(const TracedInput& in) {
  return {{"register", short_name(in.from.reg)},
          {"component", component_name(in.component)},
          {"mapping", name_of(in.from.mapping)},
          {"read", json_of(in.read)},
          {"mapped", json_of(in.mapped)}};
}

OrderedJson json_of(const TracedOutput& out) {
  OrderedJson json{{"wide", json_of(out.wide)}, {"biased", json_of(out.biased)}};
  if (out.early) json["narrowed_before_scale"] = json_of(*out.early);
  json["scaled"] = json_of(out.scaled);
  json["dropped"] = json_of(out.dropped);
  json["narrowed"] = json_of(out.narrowed);
  json["cut"] = json_of(out.cut);
  json["written"] = json_of(out.written);
  return json;
}

// The registers of a fragment: all but zero and the constants.
OrderedJson json_of(const TracedRegisters& registers) {
  OrderedJson json = OrderedJson::object();
  for (std::size_t r = static_cast<std::size_t>(Register::fog); r < kRegisterCount; ++r) {
    json[std::string(short_name(static_cast<Register>(r)))] = {
        {"codes", registers.codes.value[r]}, {"real", registers.real.value[r]}, {"ideal", registers.ideal.value[r]}};
  }
  return json;
}

OrderedJson json_of(const TracedPortion& portion) {
  const PortionOutput& out = portion.state.out;
  OrderedJson channels = OrderedJson::array();
  for (const TracedChannel& channel : portion.channel) {
    OrderedJson json{{"channel", component_name(channel.component)}};
    if (portion.uses_ab) {
      json["a"] = json_of(channel.input[0]);
      json["b"] = json_of(channel.input[1]);
      json["ab_product"] = json_of(channel.ab_product);
      json["ab"] = json_of(channel.ab);
    }
    if (portion.uses_cd) {
      json["c"] = json_of(channel.input[2]);
      json["d"] = json_of(channel.input[3]);
      json["cd_product"] = json_of(channel.cd_product);
      json["cd"] = json_of(channel.cd);
    }
    OrderedJson outputs = OrderedJson::array();
    const auto add = [&](const char* name, Register to, const std::optional<TracedOutput>& output) {
      if (!output) return;
      OrderedJson one{{"output", name},
                      {"target", std::string(short_name(to)) + '.' + component_name(channel.component)}};
      one.update(json_of(*output));
      outputs.push_back(std::move(one));
    };
    add("ab", out.ab, channel.ab_output);
    add("cd", out.cd, channel.cd_output);
    add(out.mux_sum ? "mux" : "sum", out.sum, channel.third_output);
    json["outputs"] = std::move(outputs);
    channels.push_back(std::move(json));
  }
  return {{"writes", !portion.channel.empty()},
          {"scale", name_of(out.scale)},
          {"bias", name_of(out.bias)},
          {"ab_dot_product", out.ab_dot_product},
          {"cd_dot_product", out.cd_dot_product},
          {"ab_blue_to_alpha", out.ab_blue_to_alpha},
          {"cd_blue_to_alpha", out.cd_blue_to_alpha},
          {"channels", std::move(channels)}};
}

OrderedJson json_of(const TracedFinal& f) {
  OrderedJson rgb = OrderedJson::array();
  for (std::size_t c = 0; c < 3; ++c) {
    const TracedFinalChannel& from = f.rgb[c];
    OrderedJson json{{"channel", component_name(static_cast<int>(c))}};
    for (std::size_t v = 0; v < 6; ++v) {
      if (v < 4 || f.uses_e_times_f) json[std::string(1, "abcdef"[v])] = json_of(from.input[v]);
    }
    if (f.uses_e_times_f) {
      json["e_times_f"] = {{"product", json_of(from.e_times_f_product)},
                           {"dropped", json_of(from.e_times_f_dropped)},
                           {"narrowed", json_of(from.e_times_f)}};
    }
    if (f.uses_color_sum) {
      json["color_sum"] = {{"unclamped", json_of(from.color_sum_unclamped)}, {"clamped", json_of(from.color_sum)}};
    }
    json["ab"] = json_of(from.a_times_b);
    json["one_minus_a_times_c"] = json_of(from.one_minus_a_times_c);
    json["mix"] = json_of(from.mix);
    json["dropped"] = json_of(from.dropped);
    json["narrowed"] = json_of(from.narrowed);
    json["sum"] = json_of(from.sum);
    json["cut"] = json_of(from.cut);
    json["written"] = json_of(from.written);
    rgb.push_back(std::move(json));
  }
  return {{"rgb", std::move(rgb)},
          {"alpha", {{"g", json_of(f.g)}, {"cut", json_of(f.alpha_cut)}, {"written", json_of(f.alpha)}}}};
}

std::string_view name_of_arithmetic(Arithmetic arithmetic) {
  return arithmetic == Arithmetic::integer ? "integer" : arithmetic == Arithmetic::exact ? "exact" : "float32";
}

}  // namespace

std::string print_json_trace(const Program& program, const Trace& trace) {
  const auto product_name = [](bool cd) { return cd ? "cd" : "ab"; };
  OrderedJson stages = OrderedJson::array();
  for (std::size_t i = 0; i < trace.stage.size(); ++i) {
    const TracedStage& stage = trace.stage[i];
    stages.push_back({{"stage", i},
                      {"spare0_alpha", json_of(stage.spare0_alpha)},
                      {"mux_by_lowest_bit", stage.mux_by_lowest_bit},
                      {"mux_takes", product_name(stage.takes_cd)},
                      {"ideal_mux_takes", product_name(stage.ideal_takes_cd)},
                      {"rgb", json_of(stage.rgb)},
                      {"alpha", json_of(stage.alpha)},
                      {"after", json_of(stage.after)}});
  }
  const OrderedJson json{{"arithmetic", name_of_arithmetic(program.datapath.arithmetic)},
                         {"one", program.datapath.one},
                         {"before", json_of(trace.before)},
                         {"stages", std::move(stages)},
                         {"final", json_of(trace.final_combiner)},
                         {"out", {{"codes", trace.color}, {"bytes", trace.bytes}}}};
  return json.dump(2);
}

}  // namespace ninebit
