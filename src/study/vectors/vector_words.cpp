#include "src/study/vectors/vector_words.h"

#include <array>

#include "ninebit/combiner/initial_registers.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "src/language/register_words/register_words_layout.h"
#include "src/study/vectors/vector_groups.h"
#include "src/study/vectors/vector_mistakes.h"

namespace ninebit::vectors {

std::vector<std::string> word_names(ChipClass chip) {
  using words::Kind;
  std::vector<std::string> names;
  const auto put = [&](Kind kind, int index) {
    if (index < words::count_of(kind, chip)) names.push_back(words::canonical_name({kind, index}, chip));
  };
  put(Kind::enable, 0);
  put(Kind::final0, 0);
  put(Kind::final1, 0);
  put(Kind::color, 0);
  put(Kind::color, 1);
  for (int stage = 0; stage < words::stages_of(chip); ++stage) {
    for (const Kind kind :
         {Kind::in_rgb, Kind::out_rgb, Kind::in_alpha, Kind::out_alpha, Kind::stage_color0, Kind::stage_color1}) {
      put(kind, stage);
    }
  }
  return names;
}

namespace {

// NV20 class chips show spare0 where both words of the final combiner are 0: if the program does, they are made 0.
void leave_out_final_combiner(const VectorPack& pack, const CombinerState& state, std::vector<std::uint32_t>& values) {
  std::vector<std::uint32_t> shorter = values;
  for (const char* name : {"RC_FINAL0", "RC_FINAL1"}) {
    const auto at = std::find(pack.word_names.begin(), pack.word_names.end(), name);
    shorter[static_cast<std::size_t>(at - pack.word_names.begin())] = 0;
  }
  const auto read = state_of(pack, shorter);
  if (read && read->final_combiner == state.final_combiner) values = std::move(shorter);
}

}  // namespace

Result<std::vector<std::uint32_t>> words_of(const VectorPack& pack, const CombinerState& state) {
  const auto encoded = encode_register_words(state, pack.chip, pack.profile);
  if (!encoded) return encoded.error();
  std::vector<std::uint32_t> values(pack.word_names.size());
  for (const RegisterWord& word : *encoded) {
    const auto at = std::find(pack.word_names.begin(), pack.word_names.end(), word.name);
    values[static_cast<std::size_t>(at - pack.word_names.begin())] = word.value;
  }
  if (pack.chip == ChipClass::nv20) leave_out_final_combiner(pack, state, values);
  return values;
}

Result<CombinerState> state_of(const VectorPack& pack, const std::vector<std::uint32_t>& values) {
  std::vector<RegisterWord> given;
  for (std::size_t i = 0; i < values.size(); ++i) given.push_back({pack.word_names[i], values[i], {}});
  const Parsed<CombinerState> parsed = decode_register_words(given, "", pack.chip, pack.profile);
  if (!parsed) return Diagnostic{.message = parsed.faults().front().message};
  return *parsed;
}

std::vector<Bytes4> expected_colors(const VectorPack& pack, const VectorProgram& program) {
  const Program compiled = normalize(program.state, pack.profile);
  std::vector<Bytes4> colors;
  for (std::size_t i = 0; i < pack.fragments; ++i) {
    colors.push_back(bytes_of(pack.profile, evaluate(compiled, pack.inputs[program.first_input + i])));
  }
  return colors;
}

Status check_settings(const VectorSettings& settings, std::size_t groups, const HardwareProfile& profile) {
  if (settings.programs < static_cast<int>(groups) || settings.programs > kMostVectorPrograms) {
    return Diagnostic{.message = "a pack for " + std::string(profile.name) + " has at least " + std::to_string(groups) +
                                 " programs, one of each group, and at most " + std::to_string(kMostVectorPrograms)};
  }
  if (settings.fragments < 1 || settings.fragments > kMostVectorFragments) {
    return Diagnostic{.message = "a program has 1 to " + std::to_string(kMostVectorFragments) + " fragments"};
  }
  if (settings.programs > kMostVectorColors / settings.fragments) {
    return Diagnostic{.message = "a pack has at most " + std::to_string(kMostVectorColors) + " fragments together"};
  }
  return {};
}

std::vector<std::size_t> programs_by_group(const std::vector<int>& weights, std::size_t programs) {
  std::size_t all = 0, so_far = 0;
  for (const int weight : weights) all += static_cast<std::size_t>(weight);
  const std::size_t rest = programs - weights.size();
  std::vector<std::size_t> counts;
  for (const int weight : weights) {
    const std::size_t before = rest * so_far / all;
    so_far += static_cast<std::size_t>(weight);
    counts.push_back(1 + rest * so_far / all - before);
  }
  return counts;
}

namespace {

// A byte of a row: 255, 128 or 0 throughout in three rows of 16, all bytes in turn in the even rows, else a random
// byte, often at an edge.
std::uint8_t byte_of_row(std::size_t row, std::size_t component, VectorRandom& random) {
  constexpr std::array kEdges{0, 1, 2, 63, 64, 126, 127, 128, 129, 191, 253, 254, 255};
  const int edge = kEdges[static_cast<std::size_t>(random.below(static_cast<int>(kEdges.size())))];
  const int any = random.below(256);
  const bool at_edge = random.one_in(2);
  if (row % 16 == 1) return 255;
  if (row % 16 == 5) return 128;
  if (row % 16 == 9) return 0;
  // An odd factor goes through all bytes.
  if (row % 2 == 0) return static_cast<std::uint8_t>((row / 2) * (2 * component + 1) + 37 * component);
  return static_cast<std::uint8_t>(at_edge ? edge : any);
}

RegisterFile row_of(const HardwareProfile& profile, std::size_t row, bool is_signed, VectorRandom& random) {
  std::size_t component = 0;
  const auto next = [&] { return byte_of_row(row, component++, random); };
  FragmentInputs inputs;
  for (auto* const bytes : {&inputs.primary, &inputs.secondary}) {
    for (std::uint8_t& byte : *bytes) byte = next();
  }
  for (std::uint8_t& byte : inputs.fog_color) byte = next();
  inputs.fog_factor = next();
  for (int unit = 0; unit < profile.texture_units; ++unit) {
    Texel texel;
    for (std::uint8_t& byte : texel.value) byte = next();
    texel.is_signed = is_signed;
    inputs.texture[static_cast<std::size_t>(unit)] = texel;
  }
  return initial_registers(profile, inputs);
}

}  // namespace

std::vector<RegisterFile> vector_inputs(const HardwareProfile& profile, std::uint64_t seed) {
  std::vector<RegisterFile> rows;
  for (const bool is_signed : {false, true}) {
    if (is_signed && !is_nv20(profile)) break;
    for (std::size_t row = 0; row < kByteInputs; ++row) {
      VectorRandom random(seed ^ 0x1A9075, 2 * row + (is_signed ? 1 : 0));
      rows.push_back(row_of(profile, row, is_signed, random));
    }
  }
  return rows;
}

}  // namespace ninebit::vectors
