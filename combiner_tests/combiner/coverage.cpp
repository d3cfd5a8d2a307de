#include "combiner_tests/combiner/coverage.h"

#include <algorithm>
#include <sstream>

#include "ninebit/combiner/program.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::test {
namespace {

template <class Counts>
void count(Counts& counts, std::size_t value) {
  if (value < counts.size()) ++counts[value];
}

template <class Counts, class Enum>
void count_enum(Counts& counts, Enum value) {
  count(counts, static_cast<std::size_t>(value));
}

constexpr std::array kWritable{Register::discard,  Register::primary,  Register::secondary,
                               Register::spare0,   Register::spare1,   Register::texture0,
                               Register::texture1, Register::texture2, Register::texture3};

class Rows {
 public:
  std::vector<Coverage::Row> rows;

  void add(const std::string& field, std::string_view value, std::uint64_t seen) {
    rows.push_back({field, std::string(value), seen});
  }
  template <class Counts>
  void add_flag(const std::string& field, const Counts& counts) {
    add(field, "no", counts[0]);
    add(field, "yes", counts[1]);
  }
  template <class Counts, class Values>
  void add_named(const std::string& field, const Counts& counts, const Values& values) {
    for (const auto value : values) add(field, name_of(value), counts[static_cast<std::size_t>(value)]);
  }
};

std::vector<Register> registers_that_hold_values() {
  std::vector<Register> all;
  for (std::size_t r = 0; r < kRegisterCount; ++r) all.push_back(static_cast<Register>(r));
  return all;
}

constexpr std::string_view kLetters = "ABCDEFG";

}  // namespace

void Coverage::Input::add(const CombinerInput& in) {
  count_enum(reg, in.reg);
  count_enum(mapping, in.mapping);
  count_enum(usage, in.usage);
}

void Coverage::Writing::add(const Portion& portion) {
  const PortionOutput& out = portion.out;
  if (!is_live(out)) return;
  const std::array inputs{&portion.a, &portion.b, &portion.c, &portion.d};
  for (std::size_t v = 0; v < inputs.size(); ++v) input[v].add(*inputs[v]);
  const std::array targets{out.ab, out.cd, out.sum};
  for (std::size_t k = 0; k < targets.size(); ++k) count_enum(to[k], targets[k]);
  count_enum(option[static_cast<std::size_t>(out.scale)], out.bias);
  count_enum(flag[0], out.ab_dot_product);
  count_enum(flag[1], out.cd_dot_product);
  if (out.sum != Register::discard) count_enum(flag[2], out.mux_sum);
  if (out.ab != Register::discard) count_enum(flag[3], out.ab_blue_to_alpha);
  if (out.cd != Register::discard) count_enum(flag[4], out.cd_blue_to_alpha);
}

void Coverage::add(const CombinerState& state, const HardwareProfile& profile) {
  count(stages_, static_cast<std::size_t>(state.num_general_combiners));
  count_enum(color_sum_clamp_, state.color_sum_clamp);
  count_enum(per_stage_constants_, state.per_stage_constants);
  count_enum(mux_by_lowest_bit_, state.mux_by_lowest_bit);
  count_enum(color_sum_invert_spare0_, state.color_sum_invert_spare0);
  count_enum(color_sum_invert_secondary_, state.color_sum_invert_secondary);
  for (int i = 0; i < state.num_general_combiners; ++i) {
    rgb_.add(state.general[static_cast<std::size_t>(i)].rgb);
    alpha_.add(state.general[static_cast<std::size_t>(i)].alpha);
  }
  const FinalCombiner& f = state.final_combiner;
  const std::array inputs{&f.a, &f.b, &f.c, &f.d, &f.e, &f.f, &f.g};
  for (std::size_t v = 0; v < inputs.size(); ++v) final_[v].add(*inputs[v]);
  ++profiles_[std::string(profile.name)];
  count_enum(lowest_, profile.lowest != -profile.one);
  count_enum(lowest_output_, profile.lowest_output != -profile.one);
  count_enum(half_, profile.half != (profile.one + 1) / 2);
  count_enum(expand_offset_, profile.expand_offset != profile.one.value);
  count_enum(general_narrowing_, profile.general_narrowing.value);
  count_enum(narrowing_point_, profile.narrowing_point.value);
  count_enum(final_narrowing_, profile.final_narrowing.value);
  count(byte_shift_, static_cast<std::size_t>(profile.byte_shift.value));
}

std::vector<Coverage::Row> Coverage::rows(Arithmetic arithmetic) const {
  Rows out;
  for (const HardwareProfile& profile : hardware_profiles()) {
    if (profile.arithmetic != arithmetic) continue;
    const auto found = profiles_.find(profile.name);
    out.add("profile", profile.name, found == profiles_.end() ? 0 : found->second);
  }
  if (arithmetic == Arithmetic::integer) {
    out.add_flag("profile: lowest is -one - 1", lowest_);
    out.add_flag("profile: lowest output is -one - 1", lowest_output_);
    out.add_flag("profile: half is one less", half_);
    out.add_flag("profile: expand is 2v - (one + 1)", expand_offset_);
    out.add_flag("profile: outputs to nearest", general_narrowing_);
    out.add_flag("profile: narrowed before the scale", narrowing_point_);
    out.add_flag("profile: final combiner to nearest", final_narrowing_);
    for (std::size_t i = 0; i < 2; ++i) out.add("profile: byte shift", std::to_string(i), byte_shift_[i]);
  } else {
    for (std::size_t i = 0; i < 5; ++i) out.add("profile: byte shift", std::to_string(i), byte_shift_[i]);
  }
  for (std::size_t i = 1; i < stages_.size(); ++i) out.add("stages", std::to_string(i), stages_[i]);
  out.add_flag("colour sum clamp", color_sum_clamp_);
  out.add_flag("constants per stage", per_stage_constants_);
  out.add_flag("mux by the lowest bit", mux_by_lowest_bit_);
  out.add_flag("colour sum: 1 - spare0", color_sum_invert_spare0_);
  out.add_flag("colour sum: 1 - secondary", color_sum_invert_secondary_);

  for (const Writing* const portion : {&rgb_, &alpha_}) {
    const std::string name = portion == &rgb_ ? "RGB " : "alpha ";
    for (std::size_t v = 0; v < 4; ++v) {
      const std::string variable = name + kLetters[v];
      const Input& in = portion->input[v];
      out.add_named(variable + " register", in.reg, registers_that_hold_values());
      out.add_named(variable + " mapping", in.mapping, kInputMappings);
      const ComponentUsage other = portion == &rgb_ ? ComponentUsage::rgb : ComponentUsage::blue;
      out.add_named(variable + " usage", in.usage, std::array{ComponentUsage::alpha, other});
    }
    const std::array<std::string, 3> outputs{"AB", "CD", "third"};
    for (std::size_t k = 0; k < 3; ++k) out.add_named(name + outputs[k] + " to", portion->to[k], kWritable);
    for (const Scale scale : {Scale::none, Scale::by_two, Scale::by_four, Scale::by_one_half}) {
      const auto& by_bias = portion->option[static_cast<std::size_t>(scale)];
      out.add(name + "option", std::string(name_of(scale)) + ", no bias", by_bias[0]);
      if (scale == Scale::none || scale == Scale::by_two) {
        out.add(name + "option", std::string(name_of(scale)) + ", bias", by_bias[1]);
      }
    }
    if (portion == &rgb_) out.add_flag(name + "AB dot product", portion->flag[0]);
    if (portion == &rgb_) out.add_flag(name + "CD dot product", portion->flag[1]);
    if (portion == &rgb_) out.add_flag(name + "AB blue to alpha", portion->flag[3]);
    if (portion == &rgb_) out.add_flag(name + "CD blue to alpha", portion->flag[4]);
    out.add_flag(name + "mux", portion->flag[2]);
  }

  for (std::size_t v = 0; v < 7; ++v) {
    const std::string variable = std::string("final ") + kLetters[v];
    const Input& in = final_[v];
    std::vector<Register> legal = registers_that_hold_values();
    if (v <= 3) legal.push_back(Register::e_times_f);
    if (v >= 1 && v <= 3) legal.push_back(Register::spare0_plus_secondary);
    out.add_named(variable + " register", in.reg, legal);
    out.add_named(variable + " mapping", in.mapping,
                  std::array{InputMapping::unsigned_identity, InputMapping::unsigned_invert});
    const ComponentUsage other = v == 6 ? ComponentUsage::blue : ComponentUsage::rgb;
    out.add_named(variable + " usage", in.usage, std::array{ComponentUsage::alpha, other});
  }
  return out.rows;
}

std::string Coverage::rarer_than(std::uint64_t least, const std::vector<Row>& rows) {
  std::ostringstream out;
  for (const Row& row : rows) {
    if (row.seen < least) out << row.field << " = " << row.value << ": " << row.seen << '\n';
  }
  return out.str();
}

std::string Coverage::table(const std::vector<Row>& rows) {
  std::ostringstream out;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i == 0 || rows[i].field != rows[i - 1].field) out << (i == 0 ? "" : "\n") << rows[i].field << ':';
    out << "  " << rows[i].value << ' ' << rows[i].seen;
  }
  return out.str() + '\n';
}

}  // namespace ninebit::test
