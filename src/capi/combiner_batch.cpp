// Many fragments behind the header of the two C99 files: their program as one of the library's, run by SIMD.
#include <algorithm>
#include <cstddef>
#include <new>

#include "ninebit/combiner/batch_program.h"
#include "ninebit/combiner/evaluate_arrays.h"
#include "ninebit/combiner/program.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"
#include "src/combiner/c99/ninebit_combiner.h"

struct nbc_batch {
  ninebit::Program program;
  ninebit::BatchProgram batch;
};

namespace ninebit::capi {
namespace {

CombinerInput input_of(const nbc_input& in) {
  return {static_cast<Register>(in.reg), static_cast<InputMapping>(in.mapping), static_cast<ComponentUsage>(in.usage)};
}

Portion portion_of(const nbc_portion& p) {
  const nbc_output& out = p.out;
  return {input_of(p.a),
          input_of(p.b),
          input_of(p.c),
          input_of(p.d),
          {static_cast<Register>(out.ab), static_cast<Register>(out.cd), static_cast<Register>(out.sum),
           static_cast<Scale>(out.scale), static_cast<Bias>(out.bias), out.ab_dot_product, out.cd_dot_product,
           out.mux_sum, out.ab_blue_to_alpha, out.cd_blue_to_alpha}};
}

Rgba9 codes_of(const std::int16_t (&codes)[4]) {
  return {codes[0], codes[1], codes[2], codes[3]};
}

Datapath datapath_of(const nbc_profile& p) {
  Datapath datapath;
#define NINEBIT_COPY(member) datapath.member = static_cast<decltype(datapath.member)>(p.member);
  NBC_ARITHMETIC(NINEBIT_COPY)
#undef NINEBIT_COPY
  return datapath;
}

Program program_of(const nbc_program& c) {
  Program program;
  program.datapath = datapath_of(c.datapath);
  program.num_general_combiners = c.num_general_combiners;
  program.color_sum_clamp = c.color_sum_clamp;
  program.color_sum_invert_spare0 = c.color_sum_invert_spare0;
  program.color_sum_invert_secondary = c.color_sum_invert_secondary;
  for (std::size_t i = 0; i < program.general.size(); ++i) {
    const nbc_stage& from = c.general[i];
    program.general[i] = {
        portion_of(from.rgb),  portion_of(from.alpha), codes_of(from.constant0), codes_of(from.constant1), {},
        from.mux_by_lowest_bit};
  }
  const nbc_final& f = c.final_combiner;
  program.final_combiner = {input_of(f.a), input_of(f.b), input_of(f.c), input_of(f.d),
                            input_of(f.e), input_of(f.f), input_of(f.g)};
  program.constant0 = codes_of(c.constant0);
  program.constant1 = codes_of(c.constant1);
  return program;
}

}  // namespace
}  // namespace ninebit::capi

extern "C" {

NINEBIT_PUBLIC nbc_batch* nbc_batch_create(const nbc_program* program) {
  try {
    const ninebit::Program compiled = ninebit::capi::program_of(*program);
    return new nbc_batch{compiled, ninebit::BatchProgram(compiled)};
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

NINEBIT_PUBLIC bool nbc_batch_evaluate(const nbc_batch* batch, std::size_t count,
                                       const std::int16_t* const input[NBC_REGISTERS][4],
                                       std::int16_t* const color[4]) {
  try {
    ninebit::FragmentArrays samples{.count = count};
    constexpr std::ptrdiff_t kStride = sizeof(std::int16_t);
    for (std::size_t c = 0; c < 4; ++c) {
      for (std::size_t r = NBC_FOG; r < NBC_REGISTERS; ++r) samples.input[r][c] = {input[r][c], kStride};
      samples.color[c] = {color[c], kStride};
    }
    if (ninebit::find_code_out_of_range(batch->program, samples)) return false;
    ninebit::evaluate(batch->batch, samples, 0, count);
    return true;
  } catch (const std::bad_alloc&) {
    return false;
  }
}

NINEBIT_PUBLIC void nbc_batch_free(nbc_batch* batch) {
  delete batch;
}

}  // extern "C"
