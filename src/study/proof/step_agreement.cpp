#include "src/study/proof/step_agreement.h"

#include <algorithm>
#include <array>

#include "ninebit/combiner/initial_registers.h"
#include "ninebit/numerics/datapath.h"

namespace ninebit::proof {
namespace {

using HardwareProfiles = std::array<const HardwareProfile*, 2>;
using Datapaths = std::array<Datapath, 2>;

// The registers at the start of a fragment whose bytes are all the same.
RegisterFile registers_of_byte(const HardwareProfile& profile, std::uint8_t byte, int texture_off, bool fog) {
  FragmentInputs inputs;
  inputs.primary.fill(byte);
  inputs.secondary.fill(byte);
  inputs.fog_color.fill(byte);
  if (fog) inputs.fog_factor = byte;
  for (int unit = 0; unit < profile.texture_units.value; ++unit) {
    if (unit == texture_off) continue;
    inputs.texture[static_cast<std::size_t>(unit)] = Texel{.value = {byte, byte, byte, byte}};
  }
  return initial_registers(profile, inputs);
}

bool same_start(const HardwareProfiles& p, std::uint64_t& cases) {
  const int units = std::min(p[0]->texture_units.value, p[1]->texture_units.value);
  for (int byte = 0; byte < 256; ++byte) {
    for (int off = -1; off <= units; ++off) {  // `units`: fog is off
      ++cases;
      std::array<RegisterFile, 2> registers;
      for (std::size_t side = 0; side < 2; ++side) {
        registers[side] =
            registers_of_byte(*p[side], static_cast<std::uint8_t>(byte), off == units ? -1 : off, off != units);
        // Units that one of them alone has are no part of a program for both.
        for (int unit = units; unit < 4; ++unit) registers[side][texture_register(unit)] = {};
      }
      if (registers[0] != registers[1]) return false;
    }
  }
  return true;
}

bool same_final_combiner(const HardwareProfiles& p, const Datapaths& d, std::uint64_t& cases) {
  const int one = d[0].one;
  for (int code = 0; code <= one; ++code) {
    if (to_byte(*p[0], static_cast<s9>(code)) != to_byte(*p[1], static_cast<s9>(code))) return false;
  }
  // Mappings, colour sum and clamps contain nothing but `one`. E·F is narrowed as the mix is, of fewer values.
  const int most = 2 * one * one;
  cases += static_cast<std::uint64_t>(most + 1);
  for (int mix = 0; mix <= most; ++mix) {
    if (reference::narrow_mix(d[0], mix) != reference::narrow_mix(d[1], mix)) return false;
  }
  for (int e = 0; e <= one; ++e) {
    for (int f = 0; f <= one; ++f) {
      if (reference::e_times_f(d[0], e, f) != reference::e_times_f(d[1], e, f)) return false;
    }
  }
  cases += static_cast<std::uint64_t>((one + 1) * (one + 1));
  return true;
}

// Whether the mappings and the mux agree for codes in [low, one].
bool same_inputs(const Datapaths& d, int low, std::uint64_t& cases) {
  for (int code = low; code <= d[0].one; ++code) {
    for (const InputMapping mapping : kInputMappings) {
      ++cases;
      if (reference::map_input(d[0], mapping, code) != reference::map_input(d[1], mapping, code)) return false;
    }
    for (const bool by_lowest_bit : {false, true}) {
      ++cases;
      if (reference::mux(d[0], by_lowest_bit, code, 0, 1) != reference::mux(d[1], by_lowest_bit, code, 0, 1))
        return false;
    }
  }
  return true;
}

struct OutputAgreement {
  bool all = true;
  bool visible = true;  // as far as an output is above 0
};

// Whether a general combiner's output agrees for every wide value.
OutputAgreement same_outputs(const Datapaths& d, std::uint64_t& cases) {
  // A factor's magnitude is at most one + 1; a dot product has three products, a sum two.
  const int most = 3 * (d[0].one + 1) * (d[0].one + 1);
  OutputAgreement agree;
  for (const Bias bias : {Bias::none, Bias::by_negative_one_half}) {
    for (const Scale scale : {Scale::none, Scale::by_two, Scale::by_four, Scale::by_one_half}) {
      for (int wide = -most; wide <= most && agree.visible; ++wide) {
        ++cases;
        const int x = reference::combiner_output(d[0], scale, bias, wide),
                  y = reference::combiner_output(d[1], scale, bias, wide);
        agree.all = agree.all && x == y;
        agree.visible = std::max(x, 0) == std::max(y, 0);
      }
    }
  }
  agree.all = agree.all && agree.visible;
  return agree;
}

}  // namespace

StepAgreement compare_steps(const HardwareProfile& a, const HardwareProfile& b) {
  StepAgreement agreement;
  if (a.one.value != b.one.value) return agreement;  // other codes altogether
  const HardwareProfiles p{&a, &b};
  const Datapaths d{datapath_of(a), datapath_of(b)};
  std::uint64_t& cases = agreement.cases;
  agreement.start = same_start(p, cases);
  if (d[0] == d[1]) {
    agreement.final_combiner = agreement.byte_stage = agreement.any_stage = true;
    return agreement;
  }
  if (a.arithmetic != Arithmetic::integer || b.arithmetic != Arithmetic::integer) return agreement;
  agreement.final_combiner = same_final_combiner(p, d, cases);
  const OutputAgreement outputs = same_outputs(d, cases);
  agreement.byte_stage = same_inputs(d, 0, cases) && outputs.visible;
  // Registers hold initial codes, which are not negative, or outputs.
  const int low = std::min(d[0].lowest_output, d[1].lowest_output);
  agreement.any_stage = outputs.all && same_inputs(d, low, cases);
  return agreement;
}

}  // namespace ninebit::proof
