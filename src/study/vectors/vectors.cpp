#include "ninebit/study/vectors.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "ninebit/combiner/program.h"
#include "src/study/vectors/vector_groups.h"
#include "src/study/vectors/vector_mistakes.h"
#include "src/study/vectors/vector_words.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

using vectors::Group;
using vectors::Maker;

bool shows_one_color(const VectorProgram& program) {
  return std::all_of(program.expected.begin(), program.expected.end(),
                     [&](const Bytes4& color) { return color == program.expected.front(); });
}

// A program of a group. One that shows the same colour for all fragments is drawn again, a few times.
Status make_program(const VectorPack& pack, const Group& group, std::uint64_t index, std::size_t number,
                    VectorProgram& program) {
  constexpr std::uint64_t kTries = 4;
  for (std::uint64_t attempt = 0; attempt < kTries; ++attempt) {
    Maker maker(pack.profile, pack.seed, index + (attempt << 32U), number);
    program.state = group.make(maker);
    // NV10's word of the number of stages has stage 1's outputs, too.
    const bool has_default = pack.chip == ChipClass::nv10 && program.state.num_general_combiners == 1 &&
                             program.state.general[1] == GeneralCombiner{};
    if (has_default) program.state.general[1] = vectors::idle_stage();
    const std::size_t first =
        group.inputs == vectors::Inputs::bytes || !vectors::is_nv20(pack.profile) ? 0 : vectors::kByteInputs;
    const auto places = static_cast<int>(vectors::kByteInputs - pack.fragments + 1);
    program.first_input = first + static_cast<std::size_t>(maker.random.below(places));
    auto words = vectors::words_of(pack, program.state);
    if (!words) return words.error();
    program.words = std::move(*words);
    program.expected = vectors::expected_colors(pack, program);
    if (pack.fragments == 1 || !shows_one_color(program)) break;
  }
  return {};
}

}  // namespace

int least_vector_programs(const HardwareProfile& profile) {
  return static_cast<int>(vectors::groups_of(profile).size());
}

Result<VectorPack> make_vector_pack(const HardwareProfile& profile, const VectorSettings& settings,
                                    const VectorProgress& go_on) {
  const std::vector<Group> groups = vectors::groups_of(profile);
  if (Status checked = vectors::check_settings(settings, groups.size(), profile); !checked) return checked.error();
  VectorPack pack;
  pack.profile = profile;
  pack.chip = vectors::is_nv20(profile) ? ChipClass::nv20 : ChipClass::nv10;
  pack.seed = settings.seed;
  pack.fragments = static_cast<std::size_t>(settings.fragments);
  pack.word_names = vectors::word_names(pack.chip);
  pack.inputs = vectors::vector_inputs(profile, settings.seed);
  if (Status made = vectors::make_programs(pack, groups, settings, go_on, &make_program); !made) return made.error();
  return pack;
}

std::vector<VectorMistake> vector_mistakes(const HardwareProfile& profile) {
  std::vector<VectorMistake> found;
  for (const vectors::Mistake& mistake : vectors::mistakes_of(profile)) {
    found.push_back({mistake.name, mistake.rules, mistake.group});
  }
  return found;
}

std::vector<std::vector<Bytes4>> mistaken_colors(const VectorPack& pack, const std::vector<std::size_t>& mistakes) {
  const std::vector<vectors::Mistake> known = vectors::mistakes_of(pack.profile);
  const vectors::Model model(pack.profile, known, mistakes);
  std::vector<std::size_t> programs(pack.programs.size());
  std::iota(programs.begin(), programs.end(), std::size_t{0});
  const vectors::ModelColors shown(pack, model, programs);
  std::vector<std::vector<Bytes4>> colors(pack.programs.size());
  (void)vectors::in_blocks(colors.size(), {}, [&](std::size_t i) { colors[i] = shown(i); });
  return colors;
}

}  // namespace ninebit
