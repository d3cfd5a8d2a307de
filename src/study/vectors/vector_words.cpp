#include "src/study/vectors/vector_words.h"

#include "ninebit/combiner/program.h"
#include "src/language/register_words/register_words_layout.h"
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

Result<std::vector<std::uint32_t>> words_of(const VectorPack& pack, const CombinerState& state) {
  const auto encoded = encode_register_words(state, pack.chip, pack.profile);
  if (!encoded) return encoded.error();
  std::vector<std::uint32_t> values(pack.word_names.size());
  for (const RegisterWord& word : *encoded) {
    const auto at = std::find(pack.word_names.begin(), pack.word_names.end(), word.name);
    values[static_cast<std::size_t>(at - pack.word_names.begin())] = word.value;
  }
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

}  // namespace ninebit::vectors
