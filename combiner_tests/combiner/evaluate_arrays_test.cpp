// Samples in every layout give the bits of the reference, and nothing beside them is read or written.
#include "ninebit/combiner/evaluate_arrays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/combiner/simd_targets.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/normalize.h"

namespace ninebit::test {
namespace {

// Memory of exactly the samples of a register or of a colour, so that the sanitizer finds a step beside it.
struct Block {
  std::vector<std::byte> bytes{};

  std::byte* at(std::size_t byte) { return bytes.data() + byte; }
};

// How the four components of a register lie in memory: in planes, interleaved, apart with gaps, backwards.
struct Layout {
  ElementType type = ElementType::code;
  std::size_t components = 4;      // that are given, from red on
  std::size_t fragment_bytes = 0;  // 0: in planes
  std::size_t component_bytes = 0;
  bool backwards = false;
  std::size_t misplaced = 0;  // bytes before the first sample
};

Layout random_layout(Random& random) {
  const ElementType type = random.one_in(2) ? ElementType::byte : ElementType::code;
  const std::size_t size = type == ElementType::byte ? 1 : sizeof(s9);
  const auto gap = static_cast<std::size_t>(random.below(3));
  switch (random.below(5)) {
    case 0:
      return {type, 4, 0, size};
    case 1:
      return {type, 3, 3 * size, size};
    case 2:
      return {type, static_cast<std::size_t>(random.between(1, 4)), 4 * size + gap * size, size, random.one_in(2)};
    case 3:
      return {type, 4, 4 * size, size, false, random.one_in(2) ? size : 1};  // codes at odd addresses, too
    default:
      return {type, 4, 4 * size, size};
  }
}

std::size_t size_of(const Layout& layout, std::size_t count) {
  const std::size_t sample = layout.type == ElementType::byte ? 1 : sizeof(s9);
  if (layout.fragment_bytes == 0) return layout.misplaced + layout.components * count * sample;
  const std::size_t last = (count - 1) * layout.fragment_bytes + (layout.components - 1) * layout.component_bytes;
  return layout.misplaced + last + sample;
}

// Calls take(component, first, stride) for each component that the layout has.
template <class Take>
void place(const Layout& layout, std::size_t count, Block& block, const Take& take) {
  block.bytes.assign(size_of(layout, count), std::byte{0});
  for (std::size_t c = 0; c < layout.components; ++c) {
    const std::size_t step = layout.fragment_bytes == 0 ? layout.component_bytes : layout.fragment_bytes;
    const std::size_t first = layout.misplaced + (layout.fragment_bytes == 0 ? c * count * layout.component_bytes
                                                                             : c * layout.component_bytes);
    const auto stride = static_cast<std::ptrdiff_t>(step);
    if (layout.backwards) {
      take(c, block.at(first + (count - 1) * step), -stride);
    } else {
      take(c, block.at(first), stride);
    }
  }
}

void write(std::byte* at, ElementType type, s9 code) {
  if (type == ElementType::byte)
    *at = static_cast<std::byte>(code);
  else
    std::memcpy(at, &code, sizeof code);
}
s9 read(const void* at, ElementType type) {
  if (type == ElementType::byte) return static_cast<s9>(*static_cast<const std::byte*>(at));
  s9 code = 0;
  std::memcpy(&code, at, sizeof code);
  return code;
}

template <class Samples>
auto* nth(const Samples& samples, std::size_t i) {
  using Byte =
      std::conditional_t<std::is_const_v<std::remove_pointer_t<decltype(samples.first)>>, const std::byte, std::byte>;
  return static_cast<Byte*>(samples.first) + static_cast<std::ptrdiff_t>(i) * samples.stride;
}

// Fragments with random samples, and what each of their registers holds then.
struct Case {
  Case(Random& random, const HardwareProfile& profile, std::size_t fragments) {
    samples.count = fragments;
    samples.otherwise = random_registers(random, profile);
    files.assign(fragments, samples.otherwise);
    blocks.resize(2 * kRegisterCount + 1);
    for (std::size_t r = static_cast<std::size_t>(Register::fog); r < kRegisterCount; ++r) {
      if (random.one_in(3)) continue;
      const Layout layout = random_layout(random);
      place(layout, fragments, blocks[r], [&](std::size_t c, std::byte* first, std::ptrdiff_t stride) {
        const bool same = random.one_in(8);
        samples.input[r][c] = {first, same ? 0 : stride, layout.type};
        for (std::size_t i = 0; i < fragments; ++i) {
          s9 code = static_cast<s9>(random_code(random, profile));
          if (layout.type == ElementType::byte && code < 0) code = static_cast<s9>(std::min(255, -code));
          if (same && i > 0) code = files[0].value[r][c];
          files[i].value[r][c] = code;
          write(const_cast<std::byte*>(nth(samples.input[r][c], i)), layout.type, code);
        }
      });
    }
    colors(random, samples.color, blocks[kRegisterCount]);
  }

  void colors(Random& random, std::array<OutputArray, 4>& to, Block& block) {
    const Layout layout = random_layout(random);
    place(layout, samples.count, block, [&](std::size_t c, std::byte* first, std::ptrdiff_t stride) {
      to[c] = {first, stride, layout.type};
    });
  }

  FragmentArrays samples{};
  std::vector<RegisterFile> files{};
  std::vector<Block> blocks{};
};

std::vector<EvaluatedFragment> results_of(const Case& given, const Program& program) {
  std::vector<EvaluatedFragment> results;
  for (const RegisterFile& file : given.files) results.push_back(evaluate_fragment(program, file));
  return results;
}

void expect_results(const Case& given, const std::vector<EvaluatedFragment>& all) {
  const FragmentArrays& samples = given.samples;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const EvaluatedFragment& expected = all[i];
    for (std::size_t c = 0; c < 4; ++c) {
      if (samples.color[c].first == nullptr) continue;
      ASSERT_EQ(read(nth(samples.color[c], i), samples.color[c].type), expected.color[c]) << i << ' ' << c;
    }
    for (std::size_t r = 1; r < kRegisterCount; ++r) {
      for (std::size_t c = 0; c < 4; ++c) {
        const OutputArray& to = samples.after[r][c];
        if (to.first != nullptr) {
          ASSERT_EQ(read(nth(to, i), to.type), expected.registers.value[r][c]) << i << ' ' << r << ' ' << c;
        }
      }
    }
  }
}

TEST(EvaluateArrays, EveryLayoutGivesTheBitsOfTheReference) {
  for (int k = 0; k < (kSlowBuild ? 40 : 400); ++k) {
    SCOPED_TRACE(k);
    Random random(90210, static_cast<std::uint64_t>(k));
    const HardwareProfile& profile = random.one_in(2) ? profiles::geforce2 : profiles::nv2a;
    const Program program = normalize(random_state(random, profile), profile);
    Case given(random, profile, static_cast<std::size_t>(random.between(1, 700)));
    const bool registers = random.one_in(3);
    if (registers) {
      for (std::size_t r = 1; r < kRegisterCount; ++r) {
        if (random.one_in(2)) given.colors(random, given.samples.after[r], given.blocks[kRegisterCount + r]);
        // Registers may be negative, which bytes do not hold.
        for (OutputArray& to : given.samples.after[r]) {
          if (to.type == ElementType::byte) to = {};
        }
      }
    }
    const BatchProgram batch(program, {.registers = registers});
    ASSERT_FALSE(find_code_out_of_range(program, given.samples));
    const std::vector<EvaluatedFragment> expected = results_of(given, program);
    // Two parts, which meet anywhere.
    const auto middle = static_cast<std::size_t>(random.below(static_cast<int>(given.samples.count)));
    for (const std::int64_t target : simd_targets()) {
      const OnTarget on(target);
      for (std::size_t b = kRegisterCount; b < given.blocks.size(); ++b) {  // what another target wrote
        std::fill(given.blocks[b].bytes.begin(), given.blocks[b].bytes.end(), std::byte{0x5A});
      }
      evaluate(batch, given.samples, middle, given.samples.count);
      evaluate(batch, given.samples, 0, middle);
      expect_results(given, expected);
      ASSERT_FALSE(HasFatalFailure()) << simd_target_name(target);
    }
  }
}

TEST(EvaluateArrays, RealNumbersToo) {
  for (const HardwareProfile* const profile : {&profiles::ideal, &profiles::float_shader}) {
    Random random(7);
    const Program program = normalize(random_state(random, *profile), *profile);
    Case given(random, *profile, 300);
    evaluate(BatchProgram(program), given.samples, 0, 300);
    expect_results(given, results_of(given, program));
  }
}

TEST(EvaluateArrays, PicturesOfBytes) {
  const HardwareProfile& profile = profiles::geforce2;
  Random random(3);
  const Program program = normalize(random_state(random, profile), profile);
  std::vector<std::uint8_t> texture(4 * 1000), out(4 * 1000);
  for (std::uint8_t& byte : texture) byte = random.byte();
  FragmentArrays samples{.count = 1000};
  samples.read_rgba8(Register::texture0, texture.data());
  samples.write_rgba8(out.data());
  evaluate(BatchProgram(program, {}, {}, BatchInputs::not_negative), samples, 0, 1000);
  for (std::size_t i = 0; i < 1000; ++i) {
    RegisterFile file;
    for (std::size_t c = 0; c < 4; ++c) file[Register::texture0][c] = texture[4 * i + c];
    const Rgba9 expected = evaluate(program, file);
    for (std::size_t c = 0; c < 4; ++c) ASSERT_EQ(out[4 * i + c], expected[c]) << i;
  }
  // In place: the program's own results are its next input.
  const std::vector<std::uint8_t> before = texture;
  samples.write_rgba8(texture.data());
  evaluate(BatchProgram(program), samples, 0, 1000);
  EXPECT_EQ(texture, out);
  EXPECT_NE(before, out);
}

TEST(EvaluateArrays, AConstantThatVariesIsReadFromTheSamples) {
  CombinerState state;
  state.general[0].rgb.a.reg = Register::constant0;
  const Program program = normalize(state, profiles::geforce2);
  ComponentSet varying;
  for (int c = kRed; c <= kBlue; ++c) varying.add(Register::constant0, c);
  std::vector<std::uint8_t> constant(4 * 300), out(4 * 300);
  for (std::size_t i = 0; i < constant.size(); ++i) constant[i] = static_cast<std::uint8_t>(i * 7);
  FragmentArrays samples{.count = 300};
  samples.otherwise[Register::fog][kAlpha] = 255;  // no fog
  samples.read_rgba8(Register::constant0, constant.data());
  samples.write_rgba8(out.data());
  evaluate(BatchProgram(program, {}, varying), samples, 0, 300);
  for (std::size_t i = 0; i < 300; ++i) {
    EXPECT_EQ(out[4 * i], constant[4 * i]);
    EXPECT_EQ(out[4 * i + 2], constant[4 * i + 2]);
  }
}

TEST(EvaluateArrays, ACodeThatNoRegisterHoldsIsFoundWhereverItStands) {
  const Program program = normalize(CombinerState{}, profiles::geforce2);
  for (const int wrong : {256, -256, 32767, -32768}) {
    // The last one of vectors of each length and of what is left of them, too.
    for (const std::size_t where : {0U, 1U, 7U, 8U, 15U, 16U, 30U, 31U, 39U, 42U, 255U, 256U, 700U}) {
      const std::size_t count = where < 255 ? where + 1 : 701;
      std::vector<s9> codes(count, s9{-255});
      codes[where] = static_cast<s9>(wrong);
      FragmentArrays samples{.count = count};
      samples.input[static_cast<std::size_t>(Register::texture3)][kBlue] = {codes.data(), sizeof(s9)};
      const auto found = find_code_out_of_range(program, samples);
      ASSERT_TRUE(found) << wrong << ' ' << where;
      EXPECT_EQ(found->reg, Register::texture3);
      EXPECT_EQ(found->component, kBlue);
      EXPECT_EQ(found->code, wrong);
      codes[where] = 255;
      EXPECT_FALSE(find_code_out_of_range(program, samples));
    }
  }
}

}  // namespace
}  // namespace ninebit::test
